#include "core/run/remote_control.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/exception_message.h"
#include "core/model/edit.h"
#include "core/model/lookup.h"
#include "core/run/recordings.h"
#include "core/run/result_files.h"
#include "core/run/run.h"

namespace forage {
namespace {

using Owner = model::Assignment::Owner;

constexpr double max_per_second = 100;
constexpr int max_per_cycle = 64;
constexpr std::size_t max_kept = 1000;
constexpr int wait_ms = 100;

/// An item that a command means, and its use of a type; null for an item without one.
struct Meant {
    Owner owner;
    const std::string* id;
    const model::TypeUse* use;
};

std::vector<Meant> items_of(const RemoteCommand& command, const Run& run) {
    std::vector<Meant> out;
    const auto meant = [&](const auto& item) {
        return command.by_id ? item.id == command.name : model::trim(item.name) == model::trim(command.name);
    };
    model::each_item(run.system(), [&](Owner owner, const auto& item, const model::TypeUse* use) {
        if (owner == command.item && meant(item)) out.push_back({owner, &item.id, use});
    });
    return out;
}

/// The parameter of an item with this name or, when none has it, this label.
const Parameter* find_parameter(const Meant& item, const Registry& types, const std::string& name) {
    const auto* all = item.use ? model::parameters_of(types, item.owner, item.use->type) : nullptr;
    if (!all) return nullptr;
    for (const auto member : {&Parameter::name, &Parameter::label})
        for (const auto& p : *all)
            if (p.*member == name) return &p;
    return nullptr;
}

}  // namespace

void RemoteControl::set_parameter(const RemoteCommand& command, Run& run, Diagnostics& diagnostics) const {
    const auto items = items_of(command, run);
    if (items.empty())
        return diagnostics.error({}, fmt::format("nothing of this type is called '{}'", command.name));
    std::vector<model::Assignment> changes;
    for (const auto& item : items) {
        const Parameter* p = find_parameter(item, run.registry(), command.parameter);
        if (!p) {
            diagnostics.error({}, fmt::format("'{}' has no parameter '{}'", command.name, command.parameter));
            continue;
        }
        if (p->is_path) {  // a command must not decide which files this program reads and writes
            diagnostics.error({}, fmt::format("'{}' names a file: set it before the run", p->name));
            continue;
        }
        const auto value = parse_parameter(p->kind, command.value);
        if (!value) {
            diagnostics.error({},
                              fmt::format("{} = '{}' is not {}", p->name, command.value, describe(p->kind)));
            continue;
        }
        if (outside(*value, p->range))
            diagnostics.warning({},
                                fmt::format("{} = {} is outside its usual range", p->name, command.value));
        changes.push_back({item.owner,
                           *item.id,
                           p,
                           *value,
                           fmt::format("{}.{}={}", command.name, p->name, command.value),
                           {}});
    }
    if (!diagnostics.failed()) run.simulation().check(changes, diagnostics);
    if (diagnostics.failed()) return;  // all items change, or none
    for (const auto& change : changes) run.simulation().set(change);
}

void RemoteControl::carry_out(const RemoteCommand& command, Run& run, Diagnostics& diagnostics) {
    using Kind = RemoteCommand::Kind;
    switch (command.kind) {
        case Kind::start:
            paused_ = false;
            break;
        case Kind::stop:
            paused_ = true;
            break;
        case Kind::quit:
            quit_ = true;
            break;
        case Kind::start_sampler:
        case Kind::stop_sampler: {
            bool any = false;
            for (const auto& o : run.observers())
                if (auto* recordings = dynamic_cast<Recordings*>(o.get()))
                    recordings->pause(command.kind == Kind::stop_sampler),
                        any = any || !recordings->file_names().empty();
            if (!any) diagnostics.error({}, "this run records nothing; --record says what");
            break;
        }
        case Kind::set_parameter:
            set_parameter(command, run, diagnostics);
            break;
        case Kind::plot: {
            const auto items = items_of(command, run);
            if (items.empty())
                diagnostics.error({}, fmt::format("nothing of this type is called '{}'", command.name));
            else if (!plot)
                diagnostics.error({}, "this run writes no pictures");
            else if (pictures_.size() >= max_kept)
                diagnostics.error({}, fmt::format("this run has {} pictures already", max_kept));
            else
                for (const auto& item : items) pictures_.push_back(plot(command, *item.id, run));
        }
    }
}

/// Whether one more command may be carried out now. The allowance grows with the clock.
bool RemoteControl::may_act() {
    const auto now = std::chrono::steady_clock::now();
    tokens_ = std::min(max_per_second,
                       tokens_ + max_per_second * std::chrono::duration<double>(now - filled_).count());
    filled_ = now;
    if (tokens_ < 1) {
        log_rejected(dropped_,
                     fmt::format("a datagram is dropped: at most {} a second are read", max_per_second));
        return false;
    }
    tokens_ -= 1;
    return true;
}

/// Logs one more datagram of a kind.
void RemoteControl::log_rejected(std::uint64_t& count, const std::string& line) const {
    std::uint64_t power = ++count;
    while (power % 10 == 0) power /= 10;
    if (!log || (count > 10 && power != 1)) return;
    log(count < 10 ? line : fmt::format("{} ({} datagrams so far)", line, count));
}

void RemoteControl::execute_pending(Run& run) {
    for (int i = 0; i < max_per_cycle; ++i) {
        const auto datagram = socket_.receive(longest_remote_command + 1);
        if (!datagram) return;
        if (!may_act()) continue;
        std::string problem;
        const auto command = parse_remote_command(*datagram, problem);
        if (!command) {
            log_rejected(refused_, "a datagram is not a command: " + problem);
            continue;
        }
        const std::string text(datagram->substr(0, datagram->find_first_of(std::string_view("\r\n\0", 3))));
        Diagnostics diagnostics;
        try {
            carry_out(*command, run, diagnostics);
        } catch (...) {
            diagnostics.error({}, current_exception_message());
        }
        if (diagnostics.failed()) {
            const auto first = std::ranges::find(diagnostics.all(), Severity::error, &Diagnostic::severity);
            log_rejected(refused_, fmt::format("refused {}: {}", text, first->message));
            continue;
        }
        if (executed_.size() == max_kept) continue;
        executed_.push_back({run.cycle(), text});
        if (!log) continue;
        log(fmt::format("cycle {}: {}", run.cycle(), text));
        for (const auto& d : diagnostics.all()) log(fmt::format("{}: {}", text, d.message));
    }
}

void RemoteControl::finish(RunView&, ResultFiles& files) {
    for (const auto& name : pictures_) files.add(name);
}

void RemoteControl::wait() {
    const auto begun = std::chrono::steady_clock::now();
    socket_.wait(wait_ms);
    waited_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
}

}  // namespace forage
