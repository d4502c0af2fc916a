#include "tools/studio/server/equivalents.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "core/base/shell_word.h"
#include "core/model/expression.h"
#include "core/types/parameter.h"

namespace forage::studio {
namespace {

/// A string of Python.
std::string literal(const std::string& text) {
    return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// A value of JSON.
std::string in_python(const nlohmann::json& value) {
    if (value.is_null()) return "None";
    if (value.is_boolean()) return value.get<bool>() ? "True" : "False";
    std::vector<std::string> parts;
    if (value.is_array()) {
        for (const auto& each : value) parts.push_back(in_python(each));
        return fmt::format("[{}]", fmt::join(parts, ", "));
    }
    if (!value.is_object()) return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    for (const auto& [name, each] : value.items()) parts.push_back(literal(name) + ": " + in_python(each));
    return fmt::format("{{{}}}", fmt::join(parts, ", "));
}

std::string value_in_python(const std::string& text) {
    if (text == "true") return "True";
    if (text == "false") return "False";
    return parse_parameter(ParameterKind::real, text) ? text : literal(text);
}

}  // namespace

Equivalent operator+(const Equivalent& first, const Equivalent& second) {
    const auto both = [](const std::string& a, const std::string& b) {
        return a.empty() || b.empty() ? a + b : a + '\n' + b;
    };
    return {both(first.shell, second.shell), both(first.python, second.python)};
}

Equivalent of_assignments(const std::vector<std::string>& assignments, std::uint64_t cycle) {
    Equivalent out;
    for (const std::string& a : assignments) {
        const auto [name, value] = expression::split_assignment(a);
        if (!out.shell.empty()) out.shell += ' ', out.python += '\n';
        out.shell += cycle == 0 ? "--set " + shell_word(a)
                                : "--schedule " + shell_word(fmt::format("cycle {}: {}", cycle, a));
        out.python += fmt::format("run.params[{}] = {}", literal(std::string(name)),
                                  value_in_python(std::string(value)));
    }
    return out;
}

namespace {

/// The option of `forage run` for a manipulation, between two cycles.
std::string manipulation_option(const DrivenGroup& driven, const std::string& when) {
    std::string pace;
    if (driven.every > 1) pace += fmt::format("; every {}", driven.every);
    if (driven.step > 1) pace += fmt::format("; step {}", driven.step);
    if (driven.times) pace += fmt::format("; times {}", *driven.times);
    if (driven.backwards) pace += "; backwards";
    std::string what = driven.group + "=patterns.txt";
    const double neutral = driven.mode == "multiply" ? 1 : 0;
    if (driven.patterns.size() == 1) {
        const auto& p = driven.patterns.front();
        const auto width = static_cast<std::size_t>(driven.width);
        std::string cells;
        for (std::size_t i = 0; i < p.size(); ++i)
            if (p[i] != neutral)
                cells +=
                    fmt::format("{}({},{})={}", cells.empty() ? "" : " ", i % width + 1, i / width + 1, p[i]);
        if (std::ranges::all_of(p, [&](double v) { return v == p.front(); }))
            what = fmt::format("{}={}", driven.group, p.front());
        else if (cells.size() < 200)
            what = driven.group + cells;
    }
    return fmt::format("--{} {}", driven.mode, shell_word(what + pace + when));
}

/// A name of Python for what drives a group.
std::string variable(const std::string& group) {
    std::string out;
    for (const char c : group)
        out += std::isalnum(static_cast<unsigned char>(c))
                   ? static_cast<char>(std::tolower(static_cast<unsigned char>(c)))
                   : '_';
    return "driven_" + out;
}

std::string from(std::uint64_t cycle) { return cycle > 0 ? fmt::format("; from cycle {}", cycle) : ""; }

}  // namespace

Equivalent of_manipulation(const DrivenGroup& driven, std::uint64_t cycle) {
    std::vector<std::string> rows;
    const auto width = static_cast<std::size_t>(driven.width);
    for (const auto& p : driven.patterns) {
        std::vector<std::string> lines;
        for (std::size_t i = 0; i < p.size(); i += width)
            lines.push_back(fmt::format(
                "[{}]",
                fmt::join(p.begin() + static_cast<std::ptrdiff_t>(i),
                          p.begin() + static_cast<std::ptrdiff_t>(std::min(p.size(), i + width)), ", ")));
        rows.push_back(fmt::format("[{}]", fmt::join(lines, ", ")));
    }
    std::string values = rows.size() == 1 ? rows[0] : fmt::format("[{}]", fmt::join(rows, ", "));
    if (rows.size() > 1 && driven.backwards) values += "[::-1]";
    if (rows.size() > 1 && driven.step > 1) values += fmt::format("[::{}]", driven.step);
    std::string pace;
    if (driven.every > 1) pace += fmt::format(", every={}", driven.every);
    if (driven.times) pace += fmt::format(", times={}", *driven.times);
    return {manipulation_option(driven, from(cycle)),
            fmt::format("{} = run[{}].{}({}{})", variable(driven.group), literal(driven.group), driven.mode,
                        values, pace)};
}

Equivalent of_end(const DrivenGroup& driven, std::uint64_t begun, std::uint64_t cycle) {
    return {manipulation_option(driven, from(begun) + fmt::format("; until cycle {}", cycle)),
            variable(driven.group) + ".remove()"};
}

namespace {

std::string text_of(const nlohmann::json& operations) {
    return operations.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

bool is_short(const nlohmann::json& operations) {
    constexpr std::size_t max_size = 100'000;  // bytes; Linux takes 128 KiB of an argument
    return text_of(operations).size() <= max_size;
}

std::string command_of(const EditedFile& file, const nlohmann::json& operations) {
    if (file.path.empty() || !is_short(operations)) return {};
    std::string out =
        fmt::format("forage edit {} {}", shell_word(file.path), shell_word(text_of(operations)));
    for (const auto& p : file.plugins) out += " --plugin " + shell_word(p);
    return out;
}

/// A call with a list of operations.
std::string call_of(const std::string& begin, const nlohmann::json& operations) {
    if (!is_short(operations)) return {};
    std::vector<std::string> lines;
    for (const auto& o : operations) lines.push_back(in_python(o));
    return fmt::format("{}[{}])", begin, fmt::join(lines, ",\n" + std::string(begin.size() + 1, ' ')));
}

}  // namespace

Equivalent of_edit(const EditedFile& file, const nlohmann::json& operations) {
    return {command_of(file, operations), call_of("system.edit(", operations)};
}

Equivalent of_save(const EditedFile& file, const std::string& to) {
    auto shell = to == file.path ? "" : command_of(file, nlohmann::json::array());
    if (!shell.empty()) shell += " -o " + shell_word(to);
    return {shell, fmt::format("system.save({})", literal(to))};
}

Equivalent of_world_edit(const EditedFile& file, const nlohmann::json& operations) {
    return {command_of(file, operations),
            call_of(fmt::format("forage.edit_file({}, ", literal(file.path)), operations)};
}

Equivalent of_world_copy(const EditedFile& file, const nlohmann::json& operations, const std::string& to) {
    const std::string edits = shell_word(text_of(operations));
    std::vector<std::string> calls;
    for (const auto& o : operations) calls.push_back(in_python(o));
    return {fmt::format("forage edit {} {} -o {}", shell_word(file.path), edits, shell_word(to)),
            fmt::format("forage.edit_file({}, [{}], save_as={})", literal(file.path), fmt::join(calls, ", "),
                        literal(to))};
}

Equivalent of_move(const std::string& name, double x, double y, double heading, std::uint64_t cycle) {
    return {"--schedule " + shell_word(fmt::format("cycle {}: move {}={},{},{}", cycle, name, x, y, heading)),
            fmt::format("run.move({}, x={}, y={}, heading={})", literal(name), x, y, heading)};
}

Equivalent of_trial(const std::string& robot, int start, std::uint64_t cycle) {
    const std::string where = start < 0 ? "" : fmt::format("start={}, ", start);
    const std::string at = start < 0 ? "" : fmt::format("={}", start);
    const bool ambiguous = start < 0 && robot.find('=') != robot.npos;
    return {ambiguous
                ? ""
                : "--schedule " + shell_word(fmt::format("cycle {}: begin_trial {}{}", cycle, robot, at)),
            fmt::format("run.begin_trial({}robot={})", where, literal(robot))};
}

namespace {

std::string opened_in_python(const Opened& o) {
    const std::string in = o.world.empty() ? "" : ", world=" + literal(o.world);
    return fmt::format("run = forage.open({}{}, seed={})", o.edited ? "system" : literal(o.system), in,
                       o.seed);
}

}  // namespace

Equivalent of_run(const RunLength& length, const RunLength& from_start) {
    std::string count, shell;
    if (length.trials)
        count = fmt::format("trials={}", *length.trials),
        shell = fmt::format("--trials {}", *from_start.trials);
    if (length.seconds)
        count = fmt::format("seconds={}", *length.seconds),
        shell = fmt::format("--seconds {}", *from_start.seconds);
    const std::string& condition = length.until.text;
    if (condition.empty()) return {shell, fmt::format("run.run({})", count)};
    if (!shell.empty()) shell += ' ';
    return {shell + "--until " + shell_word(condition),
            fmt::format("run.run_until({}{}{})", literal(condition), count.empty() ? "" : ", ", count)};
}

Equivalent of_restart(const Opened& o) { return {fmt::format("--seed {}", o.seed), opened_in_python(o)}; }

Equivalent of_world(const Opened& o) {
    return {o.world.empty() ? "" : "--world " + shell_word(o.world), opened_in_python(o)};
}

namespace {

std::string recording_options(const Sampled& s) {
    const std::filesystem::path file = s.file;
    std::string out;
    for (const auto& source : s.sources)
        out += fmt::format("--record {} ", shell_word(source + "=" + file.filename().string()));
    if (s.every > 1) out += fmt::format("--record-every {} ", s.every);
    // A row is written at multiples of the interval; options count it from the first one.
    if (s.from > 0) out += fmt::format("--record-from {} ", (s.from + s.every - 1) / s.every * s.every);
    if (s.until) out += fmt::format("--record-until {} ", *s.until);
    return out + "-o " + shell_word(file.has_parent_path() ? file.parent_path().string() : ".");
}

}  // namespace

Equivalent of_sampling(const Sampled& s) {
    std::vector<std::string> probes;
    for (const auto& source : s.sources)
        probes.push_back(fmt::format("run.probe({}{})", literal(source),
                                     s.every > 1 ? fmt::format(", every={}", s.every) : ""));
    return {recording_options(s), fmt::format("probes = [{}]", fmt::join(probes, ", "))};
}

Equivalent of_sampling_end(const Sampled& s) {
    return {s.until ? recording_options(s) : "",
            "recorded = [probe.take() for probe in probes]\nfor probe in probes: probe.remove()"};
}

}  // namespace forage::studio
