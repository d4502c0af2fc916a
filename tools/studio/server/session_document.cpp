// The document of a session, and the run that follows it.
#include <algorithm>
#include <chrono>
#include <filesystem>

#include <fmt/format.h>

#include "core/base/archive.h"
#include "core/base/sequence.h"
#include "core/model/build.h"
#include "core/model/changes.h"
#include "core/model/expression.h"
#include "core/model/operations.h"
#include "core/xml/writer.h"
#include "tools/api/open/sources.h"
#include "tools/studio/server/backups.h"
#include "tools/studio/server/document_problems.h"
#include "tools/studio/server/page_paths.h"
#include "tools/studio/server/session.h"

namespace forage::studio {
namespace {

bool has_errors(const std::vector<Document::Problem>& problems) {
    return std::ranges::any_of(problems,
                               [](const auto& p) { return p.diagnostic.severity == Severity::error; });
}

/// Whether two systems differ in names of processes and groups alone. They change no number, unless a module
/// plays a table, whose rows are named after them.
bool differ_in_names(model::System before, const model::System& after, const Registry& registry) {
    for (auto& p : before.processes) {
        const auto* now = find_by(after.processes, p.id, &model::Process::id);
        if (!now || (p.module && p.module->type == "moduleReplay")) return false;
        p.name = now->name;
        for (auto& g : p.groups)
            if (const auto* same = find_by(now->groups, g.id, &model::Group::id)) g.name = same->name;
    }
    const auto changes = model::parameter_changes(before, after, registry);
    return changes && changes->empty();
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

/// The changes as assignments that the run takes between two cycles; empty when it does not take all of them.
std::optional<std::vector<std::string>> live_assignments(const Run& run,
                                                         const std::vector<model::Assignment>& changes) {
    std::vector<std::string> out;
    std::vector<model::Assignment> before_next_cycle;
    Diagnostics refused;
    for (const auto& a : changes) {
        out.push_back(model::assignment_text(run.system(), a));
        auto read = model::parse_assignment(run.system(), run.registry(), out.back(), "set", refused);
        if (!read || read->id != a.id || read->value != a.value) return std::nullopt;
        if (!a.parameter->at_start) before_next_cycle.push_back(std::move(*read));
    }
    run.simulation().check(before_next_cycle, refused);
    if (refused.failed()) return std::nullopt;
    return out;
}

}  // namespace

std::vector<Document::Problem> Session::find_problems() const {
    Diagnostics files = edited.document->reading();
    if (!check_system_files(edited.document->system(), live.run->registry(), files))
        return edited.document->located(files);
    return edited.document->problems(live.run->registry(), live.run->environment());
}

void Session::begin_document(const RunInput& input) {
    if (std::filesystem::path(input.system).extension() == ".iqrProcess")
        edited.document = Document::unsaved({}, xml::write_system(live.run->system()), input.lenient);
    else if (!input.text.empty())
        edited.document = Document::unsaved(input.system, input.text, input.lenient);
    else
        edited.document = Document::open(input.system, input.lenient);
    edited.others.clear();
    if (!input.more.empty()) {
        Diagnostics known;  // they have been read before
        edited.others = read_sources(input, known).more;
    }
    edited.world_text.reset();
    edited.built = edited.document->system();
    edited.current = true, edited.outside = false;
    edited.problems = find_problems();
    live.changed.clear(), edited.steps.clear();
}

void Session::open_any(const RunInput& input) {
    try {
        open(input);
        begin_document(edited.input);
        edited.wanted.reset(), edited.mistakes = {};
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
    edited.document = std::move(document);
    edited.current = false;
    edited.problems = edited.document->located(found);
    edited.wanted = input, edited.mistakes = found;
}

void Session::open_document(const RunInput& input) {
    open_any(input);
    note_opening();
    ++edited.generation;  // what pages write of the system before does not get into this one
    live.waiting_sampler.reset();
    pages.panels = nullptr;  // those of the system before
    if (recovery.files) restart_autosave();
    // The page arranges its panels when it has the system, and an arena is one of them.
    pages.broadcast(world_message()), pages.broadcast(system_message()), broadcast_document();
}

void Session::note_opening() {
    using namespace std::chrono;
    const auto now = duration_cast<milliseconds>(system_clock::now().time_since_epoch()).count();
    edited.opened = std::max<std::int64_t>(edited.opened + 1, now);
}

bool Session::comes_with_forage(const std::string& path) const {
    if (shipped_.empty() || path.empty()) return false;
    // In a build folder, the systems are a link to those of the sources.
    const auto place = [](const std::string& p) {
        std::error_code none;
        return std::filesystem::weakly_canonical(std::filesystem::absolute(p), none);
    };
    const auto inside = place(path).lexically_relative(place(shipped_));
    return !inside.empty() && *inside.begin() != "..";
}

model::System Session::shown_system() const {
    model::System out = edited.document->system();
    for (const auto& other : edited.others) model::join(out, other);
    return out;
}

json Session::document_message() const {
    const auto backup = backup_of(edited.document->path());
    return {{"type", "document"},
            {"file", edited.document->path()},
            {"backup_of", backup ? json(backup->system) : json(nullptr)},
            {"shipped", comes_with_forage(edited.document->path())},
            {"name", edited.document->system().name},
            {"dirty", edited.document->dirty()},
            {"readable", edited.document->readable()},
            {"opened_with_mistakes", edited.wanted.has_value()},
            {"problems", problems_of(edited.problems, edited.document->system(), live.run->registry())},
            {"outside", edited.outside ? json("changed") : json(nullptr)},
            {"running_is_current", edited.current}};
}

EditedFile Session::edited_file(const std::string& path) const {
    if (backup_of(path)) return {};
    if (comes_with_forage(path))
        return {std::filesystem::path(path).filename().string(), edited.input.plugins};
    return {path, edited.input.plugins};
}

void Session::broadcast_document() {
    pages.status_due = true;
    pages.broadcast(document_message());
}

void Session::check_file_on_disk() {
    const bool outside = edited.document->changed_outside();
    if (outside == edited.outside) return;
    edited.outside = outside;
    broadcast_document();
}

std::vector<model::Assignment> Session::assignments_in(const model::System& system,
                                                       const std::vector<std::string>& texts) const {
    std::vector<model::Assignment> out;
    for (const auto& text : texts) {
        Diagnostics ignored;  // other systems that run have other items
        if (auto a = model::parse_assignment(system, live.run->registry(), text, "set", ignored))
            out.push_back(std::move(*a));
    }
    return out;
}

bool Session::set_in_document(const std::vector<std::string>& assignments) {
    const auto changes = assignments_in(edited.document->system(), assignments);
    const bool changed = edited.document->edit([&](model::System& system) {
        for (const auto& a : changes) model::set(system, a);
    });
    note_parameters(assignments);
    return changed;
}

void Session::note_parameters(const std::vector<std::string>& assignments) {
    if (edited.current) {
        edited.input.text = edited.document->text(), edited.built = edited.document->system();
        return;
    }
    for (const auto& a : assignments_in(edited.built, assignments)) {
        const auto* use = a.parameter ? model::find_use(edited.document->system(), a.id) : nullptr;
        if (!use) {
            model::set(edited.built, a);
            continue;
        }
        const auto it = std::ranges::find(use->settings, a.parameter->name, &model::Setting::name);
        model::set_parameter(edited.built, a.id, a.parameter->name,
                             it == use->settings.end() ? std::nullopt : std::optional(it->value));
    }
}

void Session::follow_document(const std::string& title, const Equivalent& script) {
    const auto& now = edited.document->system();
    auto changes = model::parameter_changes(edited.built, now, live.run->registry());
    const auto before = edited.generation;
    const bool waited = edited.wanted.has_value();
    std::vector<std::string> ended;
    const auto rebuild_run = [&] {
        // Actions of the past have the names of before.
        const bool keeps_past = !waited && live.history.actions().empty() &&
                                differ_in_names(edited.built, now, live.run->registry());
        auto lost = lost_by_rebuild();
        const auto cycle = live.run->cycle();
        edited.current = rebuild(false, keeps_past);
        if (keeps_past && live.run->cycle() == cycle) std::erase(lost, "past");
        if (edited.current) edited.built = now, ended = std::move(lost);
    };
    if (!edited.document->readable()) {
        edited.problems = find_problems();
        edited.current = false;
    } else if (changes && !edited.wanted) {
        edited.problems = find_problems();
        edited.current = !has_errors(edited.problems);
        std::erase_if(*changes, [&](const auto& a) {  // a disabled module has no parameters in the run
            return a.owner == model::Assignment::Owner::process &&
                   !find_by(now.processes, a.id, &model::Process::id)->module_enabled;
        });
        const auto assignments = live_assignments(*live.run, *changes);
        if (edited.current && !assignments) {
            rebuild_run();
        } else if (edited.current) {
            json values = json::object();
            for (const auto& text : *assignments) {
                const auto [name, value] = expression::split_assignment(text);
                values[std::string(name)] = value;
            }
            if (!assignments->empty())
                act({{"command", "set"}, {"assignments", *assignments}},
                    {.title = title, .scripts = script, .values = values});
            edited.built = now;
        }
    } else {
        rebuild_run();
    }
    if (edited.current) edited.input.text = edited.document->text();
    if (edited.generation == before) {
        ++edited.generation, ++live.version;
        log({.command = "edit", .title = title, .scripts = script, .ended = ended});
    }
    pages.status_due = true;
    pages.broadcast(system_message());
    if (waited && !edited.wanted) pages.broadcast(world_message());
}

std::vector<std::string> Session::lost_by_rebuild() const {
    std::vector<std::string> out;
    if (live.history.last() > live.history.first()) out.emplace_back("past");
    if (live.reference) out.emplace_back("comparison");
    if (live.sampler) out.emplace_back("recording");
    return out;
}

bool Session::rebuild(bool continues, bool keeps_past) {
    RunInput input = edited.wanted ? *edited.wanted : edited.input;
    // What was chosen while the system waited for its corrections.
    if (edited.wanted) input.world = edited.input.world, input.seed = edited.input.seed;
    input.text = edited.document->text();
    RunInput set = input;
    set_beside_document(set);
    Diagnostics diagnostics = edited.document->reading();
    const Sources sources = read_sources(set, edited.document->system(), diagnostics);
    std::optional<Course> built;
    const auto build = [&](bool adopts) {
        built.reset();  // two runs do not open the same device
        built = build_run(sources, set, live.run->seed(), diagnostics);
        if (!built || !adopts) return;
        if (!keeps_past) return built->run->adopt(*live.run);
        Archive out;  // all of it, also random numbers
        live.run->checkpoint(out);
        Archive in{std::string_view(out.bytes())};
        built->run->checkpoint(in);
    };
    try {
        try {
            build(live.failed.empty() && (continues || live.run->cycle() > 0) && !edited.wanted);
        } catch (const ArchiveError&) {  // other modules sense the world in another way: the run restarts
            diagnostics = edited.document->reading();
            build(false);
        }
        if (built && edited.wanted) read_plot_config(*built->run);
    } catch (const InputError& e) {
        for (const auto& d : e.diagnostics().all()) diagnostics.add(d);
        built.reset();
    } catch (const std::exception& e) {
        diagnostics.error({}, e.what());
        built.reset();
    }
    edited.problems = edited.document->located(diagnostics);
    if (!built) return false;
    Run& run = *built->run;
    const bool restarted = run.cycle() != live.run->cycle();
    close_sampler();
    end_reference();
    for (const auto& [number, manipulation] : live.manipulations->groups()) {
        if (keeps_past && !restarted) break;  // they are part of its state
        auto settings = manipulation.settings();
        const auto& id = live.run->layout().groups[static_cast<std::size_t>(number)].id;
        const auto& groups = run.layout().groups;
        const auto it = std::ranges::find_if(groups, [&](const auto& g) {
            return g.id == id && !settings.patterns.empty() &&
                   static_cast<int>(settings.patterns[0].size()) == g.shape.cells;
        });
        if (it == groups.end()) continue;
        settings.group = static_cast<int>(it - groups.begin());
        built->manipulations->put(std::move(settings));
    }
    run.title = live.run->title;
    live.take_run(std::move(*built));
    if (auto& pause = live.pause_when) {
        Diagnostics unknown;
        pause->condition =
            StopCondition::make(pause->length, *live.run, unknown);  // groups have other numbers
        if (restarted) pause->since = {};
        if (unknown.failed()) pause.reset(), live.pace.running = false;
    }
    live.failed.clear();
    live.files = digest_of_files(set, sources);
    if (edited.wanted) {
        edited.input = input, edited.others = sources.more;
        edited.wanted.reset(), edited.mistakes = {};
    }
    live.begun = std::move(set);
    if (restarted || !keeps_past) live.history.begin(*live.run);
    if (restarted) rewound();  // a run that has failed does not continue
    pages.rebind(*live.run);
    return true;
}

bool Session::saved_values(json& described) const {
    const auto id = described.at("id").get<std::string>();
    const auto* here = model::find_use(edited.document->system(), id);
    if (!here) return false;
    const auto* saved = model::find_use(edited.document->saved_system(), id);
    const auto value = [](const model::TypeUse& use, const json& p) {
        const auto it = std::ranges::find(use.settings, p["name"].get<std::string>(), &model::Setting::name);
        if (it == use.settings.end()) return p["default"];
        if (p["kind"] == "text") return json(it->value);
        const json parsed = json::parse(it->in_force(ParameterKind::real), nullptr, false);
        return parsed.is_primitive() ? parsed : json(it->value);  // a mistake may be any text
    };
    for (auto& p : described["parameters"]) {
        if (saved && saved->type == here->type) p["loaded"] = value(*saved, p);
        if (p["at_start"]) p["value"] = value(*here, p);
    }
    return true;
}

}  // namespace forage::studio
