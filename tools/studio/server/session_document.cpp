// The document of a session, and the run that follows it.
#include <algorithm>
#include <chrono>
#include <filesystem>

#include <fmt/format.h>

#include "core/model/build.h"
#include "core/model/changes.h"
#include "core/model/operations.h"
#include "core/xml/writer.h"
#include "tools/api/describe/describe_json.h"
#include "tools/api/open/sources.h"
#include "tools/studio/server/backups.h"
#include "tools/studio/server/document_problems.h"
#include "tools/studio/server/session.h"

namespace forage::studio {
namespace {

bool has_errors(const std::vector<Document::Problem>& problems) {
    return std::ranges::any_of(problems,
                               [](const auto& p) { return p.diagnostic.severity == Severity::error; });
}

/// Whether an error is in the file of a system, or in one that it links.
bool is_in_system(const Diagnostics& diagnostics, const std::string& system) {
    const auto backup = backup_of(system);
    const auto ending = std::filesystem::path(backup ? backup->system : system).extension();
    if (ending != ".iqr" && ending != ".xml") return false;
    return std::ranges::any_of(diagnostics.all(), [&](const Diagnostic& d) {
        return d.severity == Severity::error && d.where.file &&
               (d.where.file->path == system || d.where.file->path.ends_with(".iqrProcess"));
    });
}

}  // namespace

void Session::begin_document(const RunInput& input) {
    if (std::filesystem::path(input.system).extension() == ".iqrProcess")
        document_ = Document::unsaved({}, xml::write_system(run_->system()), input.lenient);
    else if (!input.text.empty())
        document_ = Document::unsaved(input.system, input.text, input.lenient);
    else
        document_ = Document::open(input.system, input.lenient);
    others_.clear();
    if (!input.more.empty()) {
        Diagnostics known;  // they have been read before
        others_ = read_sources(input, known).more;
    }
    world_text_.reset();
    built_ = document_->system();
    current_ = true, outside_ = false;
    problems_ = document_->problems(run_->registry(), run_->environment());
    changed_.clear(), undo_.clear(), redo_.clear();
}

void Session::open_any(const RunInput& input) {
    try {
        open(input);
        begin_document(input_);
        wanted_.reset(), mistakes_ = {};
    } catch (const InputError& e) {
        if (!input.text.empty() || !is_in_system(e.diagnostics(), input.system)) throw;
        open_with_mistakes(input, e.diagnostics());
    }
}

void Session::open_with_mistakes(const RunInput& input, const Diagnostics& found) {
    Document document;
    try {
        document = Document::open_text(input.system, input.lenient);
    } catch (const InputError&) {
        throw InputError(found);
    }
    RunInput nothing = input;
    nothing.more.clear(), nothing.settings.clear(), nothing.robots.clear(), nothing.replay.clear();
    model::System empty;
    empty.id = document.system().id, empty.name = document.system().name;
    empty.cycles_per_second = document.system().cycles_per_second;
    nothing.text = xml::write_system(empty);
    try {
        open(nothing);
    } catch (const InputError&) {  // the world is wrong, too
        throw InputError(found);
    }
    begin_document(nothing);
    document_ = std::move(document);
    current_ = false;
    problems_ = document_->located(found);
    wanted_ = input, mistakes_ = found;
}

void Session::open_document(const RunInput& input) {
    open_any(input);
    note_opening();
    ++generation_;  // what pages write of the system before does not get into this one
    sampler_waits_ = nullptr;
    if (kept_) keep_anew();
    // The page arranges its panels when it has the system, and an arena is one of them.
    tell(world_message()), tell(system_message()), tell_document();
}

void Session::note_opening() {
    using namespace std::chrono;
    const auto now = duration_cast<milliseconds>(system_clock::now().time_since_epoch()).count();
    opened_ = std::max<std::int64_t>(opened_ + 1, now);
}

void Session::add_undo(Undo step) {
    undo_.push_back(std::move(step));
    redo_.clear();
    trim_undo();
}

std::size_t Session::Undo::bytes() const {
    std::size_t out = 0;
    for (const auto* command : {&undo, &redo})
        if (command->is_object())
            for (const char* text : {"text", "run"})
                if (const auto it = command->find(text); it != command->end() && it->is_string())
                    out += it->get_ref<const std::string&>().size();
    return out;
}

void Session::trim_undo() {
    constexpr std::size_t most_undone = 500;
    if (undo_.size() > most_undone) undo_.erase(undo_.begin(), undo_.end() - most_undone);
    // Steps of the world hold its text before and after them; the document bounds its own steps.
    constexpr std::size_t most_bytes = 8u << 20;
    std::size_t bytes = 0;
    for (auto it = undo_.rbegin(); it != undo_.rend(); ++it)
        if ((bytes += it->bytes()) > most_bytes && it != undo_.rbegin()) {
            undo_.erase(undo_.begin(), it.base());
            break;
        }
    // A step of the document can be undone while the document has it.
    std::size_t steps = document_->steps();
    for (auto it = undo_.rbegin(); it != undo_.rend(); ++it)
        if (it->document && steps-- == 0) {
            undo_.erase(undo_.begin(), it.base());
            break;
        }
}

bool Session::comes_with_forage(const std::string& path) const {
    if (shipped_.empty() || path.empty()) return false;
    const auto folder = std::filesystem::absolute(shipped_).lexically_normal();
    const auto inside = std::filesystem::absolute(path).lexically_normal().lexically_relative(folder);
    return !inside.empty() && *inside.begin() != "..";
}

model::System Session::shown_system() const {
    model::System out = document_->system();
    for (const auto& other : others_) model::join(out, other);
    return out;
}

json Session::document_message() const {
    const auto title = [](const std::vector<Undo>& steps) {
        return steps.empty() ? json(nullptr) : json(steps.back().title);
    };
    const auto backup = backup_of(document_->path());
    return {{"type", "document"},
            {"file", document_->path()},
            {"backup_of", backup ? json(backup->system) : json(nullptr)},
            {"shipped", comes_with_forage(document_->path())},
            {"name", document_->system().name},
            {"dirty", document_->dirty()},
            {"readable", document_->readable()},
            {"opened_with_mistakes", wanted_.has_value()},
            {"problems", problems_of(problems_, document_->system(), run_->registry())},
            {"outside", outside_ ? json("changed") : json(nullptr)},
            {"undo", title(undo_)},
            {"redo", title(redo_)},
            {"running_is_current", current_}};
}

EditedFile Session::edited_file(const std::string& path) const {
    if (backup_of(path)) return {};
    if (comes_with_forage(path)) return {std::filesystem::path(path).filename().string(), input_.plugins};
    return {path, input_.plugins};
}

void Session::tell_document() {
    status_due_ = true;
    tell(document_message());
}

void Session::look_outside() {
    const bool outside = document_->changed_outside();
    if (outside == outside_) return;
    outside_ = outside;
    tell_document();
}

std::vector<model::Assignment> Session::assignments_in(const model::System& system,
                                                       const std::vector<std::string>& texts) const {
    std::vector<model::Assignment> out;
    for (const auto& text : texts) {
        Diagnostics ignored;  // other systems that run have other items
        if (auto a = model::parse_assignment(system, run_->registry(), text, "set", ignored))
            out.push_back(std::move(*a));
    }
    return out;
}

bool Session::set_in_document(const std::vector<std::string>& assignments, const std::string& title) {
    const auto changes = assignments_in(document_->system(), assignments);
    const bool step = document_->edit(
        [&](model::System& system) {
            for (const auto& a : changes) model::set(system, a);
        },
        title);
    note_parameters(assignments);
    return step;
}

void Session::note_parameters(const std::vector<std::string>& assignments) {
    if (current_) {
        input_.text = document_->text(), built_ = document_->system();
        return;
    }
    for (const auto& a : assignments_in(built_, assignments)) {
        const auto* use = a.parameter ? model::find_use(document_->system(), a.id) : nullptr;
        if (!use) {
            model::set(built_, a);
            continue;
        }
        const auto it = std::ranges::find(use->settings, a.parameter->name, &model::Setting::name);
        model::set_parameter(built_, a.id, a.parameter->name,
                             it == use->settings.end() ? std::nullopt : std::optional(it->value));
    }
}

void Session::follow_document(const std::string& title, const Equivalent& script) {
    const auto& now = document_->system();
    const auto changes = model::parameter_changes(built_, now, run_->registry());
    const auto before = generation_;
    const bool waited = wanted_.has_value();
    json ended = json::array();
    if (!document_->readable()) {
        problems_ = document_->problems(run_->registry(), run_->environment());
        current_ = false;
    } else if (changes && !wanted_) {
        problems_ = document_->problems(run_->registry(), run_->environment());
        current_ = !has_errors(problems_);
        if (current_) {
            std::vector<std::string> assignments;
            json values = json::object();
            for (const auto& a : *changes) {
                model::set_as_in(now, built_, a);
                assignments.push_back(a.text);
                values[a.text.substr(0, a.text.find('='))] = a.text.substr(a.text.find('=') + 1);
            }
            built_ = now;
            if (!assignments.empty()) {
                const auto set = of_assignments(assignments, run_->cycle());
                const auto with = [](const std::string& a, const std::string& b) {
                    return b.empty() ? a : a + '\n' + b;
                };
                act({{"command", "set"}, {"assignments", assignments}}, std::nullopt,
                    {{"title", title},
                     {"values", values},
                     {"shell", with(set.shell, script.shell)},
                     {"python", with(set.python, script.python)}});
            }
        }
    } else {
        const auto lost = lost_by_rebuild();
        current_ = rebuild();
        if (current_) built_ = now, ended = lost;
    }
    if (current_) input_.text = document_->text();
    if (generation_ == before) {
        ++generation_, ++version_;
        tell({{"type", "action"},
              {"generation", generation_},
              {"cycle", run_->cycle()},
              {"command", "edit"},
              {"title", title},
              {"shell", script.shell},
              {"python", script.python},
              {"undoable", true},
              {"ended", std::move(ended)}});
    }
    status_due_ = true;
    tell(system_message());
    if (waited && !wanted_) tell(world_message());
}

std::vector<std::string> Session::lost_by_rebuild() const {
    std::vector<std::string> out;
    if (history_.last() > history_.first()) out.emplace_back("past");
    if (reference_) out.emplace_back("comparison");
    if (sampler_) out.emplace_back("recording");
    return out;
}

bool Session::rebuild(bool goes_on) {
    RunInput input = wanted_ ? *wanted_ : input_;
    // What was chosen while the system waited for its corrections.
    if (wanted_) input.world = input_.world, input.seed = input_.seed;
    input.text = document_->text();
    RunInput set = input;
    set_beside_document(set);
    Diagnostics diagnostics = document_->reading();
    const Sources sources = read_sources(set, document_->system(), diagnostics);
    std::optional<Run> run;
    Touches* touches = nullptr;
    const auto build = [&](bool go_on) {
        run.reset();
        auto loaded = assemble(sources, set, diagnostics);
        if (!loaded) return;
        run = Run::make(std::move(loaded->system), std::move(loaded->registry), std::move(loaded->world),
                        {.seed = run_->seed()}, diagnostics);
        if (!run) return;
        touches = &run->add(std::make_unique<Touches>());
        if (!run->start(diagnostics))
            run.reset();
        else if (go_on)
            run->adopt(*run_);
    };
    try {
        try {
            build(failed_.empty() && (goes_on || run_->cycle() > 0) && !wanted_);
        } catch (const ArchiveError&) {  // other modules sense the world in another way: it begins anew
            diagnostics = document_->reading();
            build(false);
        }
        if (run && wanted_) read_plot_config(*run);
    } catch (const InputError& e) {
        for (const auto& d : e.diagnostics().all()) diagnostics.add(d);
        run.reset();
    } catch (const std::exception& e) {
        diagnostics.error({}, e.what());
        run.reset();
    }
    problems_ = document_->located(diagnostics);
    if (!run) return false;
    close_sampler();
    end_reference();
    for (const auto& [number, manipulation] : touches_->groups()) {
        auto settings = manipulation.settings();
        const auto& id = run_->layout().groups[static_cast<std::size_t>(number)].id;
        const auto& groups = run->layout().groups;
        const auto it = std::ranges::find_if(groups, [&](const auto& g) {
            return g.id == id && !settings.patterns.empty() &&
                   static_cast<int>(settings.patterns[0].size()) == g.shape.cells;
        });
        if (it == groups.end()) continue;
        settings.group = static_cast<int>(it - groups.begin());
        touches->put(std::move(settings));
    }
    const bool anew = run->cycle() != run_->cycle();
    run->title = run_->title;
    run_ = std::make_unique<Run>(std::move(*run));
    touches_ = touches;
    failed_.clear();
    files_ = digest_of_files(set, sources);
    if (wanted_) {
        input_ = input, others_ = sources.more;
        wanted_.reset(), mistakes_ = {};
    }
    begun_ = std::move(set);
    history_.begin(*run_);
    if (anew) rewound();  // a run that has failed does not go on
    rebind();
    return true;
}

bool Session::saved_values(json& described) const {
    const auto id = described.at("id").get<std::string>();
    const auto* here = model::find_use(document_->system(), id);
    if (!here) return false;
    const auto* saved = model::find_use(document_->saved_system(), id);
    const auto value = [](const model::TypeUse& use, const json& p) {
        const auto it = std::ranges::find(use.settings, p["name"].get<std::string>(), &model::Setting::name);
        if (it == use.settings.end()) return p["default"];
        if (p["kind"] == "text") return json(it->value);
        const json parsed = json::parse(it->value, nullptr, false);
        return parsed.is_discarded() ? json(it->value) : parsed;
    };
    for (auto& p : described["parameters"]) {
        if (saved && saved->type == here->type) p["loaded"] = value(*saved, p);
        if (p["at_start"]) p["value"] = value(*here, p);
    }
    return true;
}

}  // namespace forage::studio
