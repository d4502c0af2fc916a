// Figures of the run, as 'forage plot' makes them from its results.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <memory>

#include <fmt/format.h>

#include "core/base/shell_word.h"
#include "core/base/text_file.h"
#include "core/model/changes.h"
#include "core/run/path_recorder.h"
#include "core/run/recordings.h"
#include "core/run/trial_recorder.h"
#include "tools/api/experiment/results.h"
#include "tools/studio/server/base64.h"
#include "tools/studio/server/commands/shared.h"

namespace forage::studio {
namespace {

namespace fs = std::filesystem;

/// A folder that is removed with its files.
struct TemporaryFolder {
    std::string path = (fs::temp_directory_path() / "forage-XXXXXX").string();
    TemporaryFolder() {
        if (!mkdtemp(path.data())) throw std::runtime_error("there is no temporary folder for the figure");
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
};

/// What a figure needs of the run.
struct FigureNeeds {
    std::vector<std::string> sources;  ///< to record
    bool paths = false, trials = false;
    std::uint64_t from = 0;  ///< the first recorded cycle

    bool run() const { return paths || trials || !sources.empty(); }
};

FigureNeeds needs_of(Session& s, const Request& r) {
    Diagnostics diagnostics;
    FigureNeeds out;
    const auto plots = r.texts("plots").size();
    if (plots == 0 || (plots > 1 && r.text("layout").empty()))
        throw InputError("a figure is one file", "several plots need a layout, such as 2x1");
    for (const auto& text : r.texts("plots"))
        if (const auto spec = plot::parse_plot(text, "plot", diagnostics)) {
            if (spec->of_cells())
                for (const auto& source : spec->sources())
                    if (std::ranges::find(out.sources, source) == out.sources.end())
                        out.sources.push_back(source);
            out.paths = out.paths || spec->kind == plot::PlotSpec::Kind::trajectory ||
                        spec->kind == plot::PlotSpec::Kind::occupancy;
            out.trials = out.trials || spec->kind == plot::PlotSpec::Kind::learning;
        }
    throw_errors(diagnostics);
    const auto now = s.run().cycle();
    if (out.run() && now == 0)
        throw InputError("there is nothing to draw yet", "run the system before you export a figure");
    const auto* world = s.run().environment();
    if ((out.paths || out.trials) && (!world || world->robot_names().size() != 1))
        throw InputError("paths and trials are drawn of a world with one robot",
                         "use forage run and forage plot");
    if (r.has("from") && out.sources.empty())
        throw InputError("'from' is for plots of sources", "leave it out");
    out.from = r.has("from") ? r.whole("from") : 0;
    if (!out.sources.empty() && out.from >= now)
        throw InputError(fmt::format("cycle {} has not been computed", out.from),
                         fmt::format("the last one was {}", now - 1));
    return out;
}

/// The most cycles that a figure repeats; more would stop the studio for long.
constexpr std::uint64_t max_repeated = 1'000'000;

/// Repeats the past of the run up to now, and writes the results that the figure needs into a folder.
Results results_of_past(Session& s, const FigureNeeds& needs, const std::string& folder) {
    const std::uint64_t now = s.run().cycle(), first = s.live.history.first();
    const std::uint64_t begin = std::max(needs.paths             ? first
                                         : needs.sources.empty() ? now
                                                                 : needs.from,
                                         first);
    if (now - begin > max_repeated)
        throw InputError(fmt::format("the figure needs {} cycles of the past", now - begin),
                         "begin it later, or use forage run and forage plot");
    FinishedRun out;
    Course copy = s.copy_at(begin);
    Run& run = *copy.run;
    std::vector<model::RecordingSpec> recordings;
    for (const auto& source : needs.sources) recordings.push_back({{source}, 1});
    RecordOptions options;
    options.from = needs.from;
    Diagnostics diagnostics;
    auto files = checked(diagnostics, recorded_files(recordings, options, run.layout(), diagnostics));
    ResultFiles written(folder);
    if (!files.empty())
        run.add(std::make_unique<Recordings>(std::move(files), options, folder,
                                             std::vector<std::pair<std::string, std::string>>()))
            .begin_files(written);
    // Plots over time show trials.
    if (const auto* world = run.environment(); world && world->robot_names().size() == 1) {
        run.add(std::make_unique<TrialRecorder>(*world, 0, run.layout(), "trials.csv"));
        if (needs.paths) run.add(std::make_unique<PathRecorder>(*world, 0, "trajectory.csv"));
    }
    while (run.cycle() < now) copy.repeat_actions(), run.step();
    run.finish(written);
    if (!written.problems().empty()) throw InputError(written.problems().front());
    out.seconds_per_cycle = run.seconds_per_cycle(), out.recordings = written.recordings();
    out.input = s.live.begun;
    return results_of(folder, std::move(out));
}

/// What the run began with that its file does not say; empty when this is more than parameters.
std::optional<std::vector<model::Assignment>> unsaved_parameters(const Session& s) {
    const auto& run = *s.live.run;
    return model::parameter_changes(s.edited.document->saved_system(), run.system(), run.registry());
}

bool sets_parameters(const History::Action& action) { return action.command.at("command") == "set"; }

/// The options for parameters that pages set, before the run began and during it.
std::string options_of_parameters(Session& s) {
    std::string out;
    const auto& settings = s.live.begun.settings;
    for (const auto& a : unsaved_parameters(s).value_or(std::vector<model::Assignment>()))
        if (std::ranges::find(settings, a.text, &model::Expression::text) == settings.end())
            out += ' ' + of_assignments({a.text}, 0).shell;
    for (const auto& action : s.live.history.actions())
        if (sets_parameters(action) && action.cycle < s.live.run->cycle())
            for (const auto& text : action.command.at("assignments"))
                if (!waits_for_start(s, text)) out += ' ' + of_assignments({text}, action.cycle).shell;
    return out;
}

/// The lines of a shell that make the same file.
std::string commands_of(Session& s, const Request& r, const FigureNeeds& needs) {
    const RunInput& input = s.live.begun;
    std::string out, from = shell_word(input.system);
    if (needs.run()) {
        out = "forage run " + from;
        for (const auto& system : input.more) out += ' ' + shell_word(system);
        if (!input.world.empty()) out += " --world " + shell_word(input.world);
        for (const auto& robot : input.robots) out += " --robot " + shell_word(robot.text);
        if (input.lenient) out += " --lenient";
        for (const auto& plugin : input.plugins) out += " --plugin " + shell_word(plugin);
        for (const auto& setting : input.settings) out += " --set " + shell_word(setting.text);
        out += options_of_parameters(s);
        out += fmt::format(" --seed {} --cycles {}", input.seed, s.run().cycle());
        for (const auto& source : needs.sources) out += " --record " + shell_word(source);
        if (!needs.sources.empty() && needs.from > 0) out += fmt::format(" --record-from {}", needs.from);
        out += '\n', from = "forage-out";
    }
    out += "forage plot " + from;
    for (const auto& plot : r.texts("plots")) out += ' ' + shell_word(plot);
    for (const char* option : {"layout", "width"})
        if (const auto& value = r.text(option); !value.empty())
            out += fmt::format(" --{} {}", option, shell_word(value));
    return out + " --plot-format " + r.text("format");
}

/// Why these lines alone may give another figure; empty when they give the same.
std::string difference_of(const Session& s, const FigureNeeds& needs) {
    std::string out;
    if (s.edited.document->dirty() && (!needs.run() || !unsaved_parameters(s)))
        out = "Save the system first: its file is older than what runs. ";
    if (!needs.run()) return out;
    const auto& history = s.live.history;
    if (history.first() > 0)
        out += fmt::format("The system was edited at cycle {}; these lines begin with it at cycle 0. ",
                           history.first());
    const auto now = s.live.run->cycle();
    if (!s.live.manipulations->groups().empty() ||
        std::ranges::any_of(history.actions(), [&](const auto& action) {
            return action.cycle < now && !sets_parameters(action);
        }))
        out += "Add the options of the Log: the run was changed while it lasted.";
    return out;
}

json draw_figure(Session& s, const Request& r) {
    const auto needs = needs_of(s, r);
    Diagnostics diagnostics;
    std::optional<plot::FigureLayout> layout;
    if (const auto& text = r.text("layout"); !text.empty()) layout = plot::parse_layout(text, diagnostics);
    std::optional<plot::FigureWidth> width;
    if (const auto& text = r.text("width"); !text.empty()) width = plot::parse_width(text, diagnostics);
    throw_errors(diagnostics);
    const TemporaryFolder folder;
    Results results;
    if (needs.run()) {
        results = results_of_past(s, needs, folder.path);
    } else {
        results.path = results.input.system = s.live.begun.system, results.input.text = s.live.begun.text;
        results.input.plugins = s.live.begun.plugins;
        results.context.run = fs::path(results.path).filename().string();
    }
    const auto files = draw(results, r.texts("plots"), folder.path, *plot::format_of("x." + r.text("format")),
                            diagnostics, {}, layout, width);
    throw_errors(diagnostics);
    if (files.size() != 1)
        throw InputError("a figure is one file", "several plots need a layout, such as 2x1");
    std::ifstream in = open_file(files.front());
    const std::string content{std::istreambuf_iterator<char>(in), {}};
    return {{"file", fs::path(files.front()).filename().string()},
            {"content", base64(content)},
            {"shell", commands_of(s, r, needs)},
            {"note", difference_of(s, needs)}};
}

}  // namespace

std::vector<Command> figure_commands() {
    return {
        {.name = "figure",
         .doc = "Draws a figure of the run, as `forage plot` does from its results. Sources are recorded by "
                "repeating the past. Returns the content of the file in base64, the lines of a shell that "
                "make the same file, and why they may give another one.",
         .arguments = {{"plots", texts(), "as those of `forage plot`"},
                       optional("format", choice({"png", "svg", "pdf"}), "png"),
                       optional("layout", text(), "", "panels of several plots: `2x1`"),
                       optional("width", text(), "", "`85mm` or `600px`; by default that of the content"),
                       optional("from", whole(), nullptr, "the first cycle; by default 0")},
         .result = "{ file: string; content: string; shell: string; note: string }",
         .apply = draw_figure},
    };
}

}  // namespace forage::studio
