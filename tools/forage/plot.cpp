#include <cstdio>
#include <optional>

#include "core/base/named_file.h"
#include "core/base/print.h"
#include "tools/api/experiment/results.h"
#include "tools/forage/commands.h"
#include "tools/forage/options.h"

namespace forage::tool {
namespace {

struct PlotOptions {
    std::string source;              ///< a directory of results, a recording, or a system
    std::vector<std::string> plots;  ///< the pictures to draw
    std::vector<std::string> where;  ///< which runs of an experiment to draw: "PARAMETER=VALUE"
    std::string directory;           ///< empty: beside the source; for a system, the working directory
    std::string plot_format = "png";
    std::string layout;  ///< "ROWSxCOLUMNS" of the panels of one figure; empty: a file per plot
    std::string width;   ///< "85mm" or "600px"; empty: that of each picture
};

int plot(const PlotOptions& o) {
    Diagnostics diagnostics;
    std::optional<Results> results;
    try {
        results = open_results(o.source);
    } catch (const FileError& e) {
        report(e, diagnostics);
    } catch (const std::exception& e) {
        diagnostics.error(
            {}, e.what(),
            "name a directory of results, a recording (.csv, .npy, .npz, .h5) or a system (.iqr)");
    }
    std::optional<plot::FigureLayout> layout;
    if (results && !o.layout.empty()) layout = plot::parse_layout(o.layout, diagnostics);
    std::optional<plot::FigureWidth> width;
    if (results && !o.width.empty()) width = plot::parse_width(o.width, diagnostics);
    if (results && !diagnostics.failed())
        for (const auto& file : draw(*results, o.plots, o.directory, *plot::format_of("x." + o.plot_format),
                                     diagnostics, o.where, layout, width))
            print("{}\n", file);
    print(stderr, "{}", format(diagnostics));
    return diagnostics.failed() ? bad_input : fine;
}

}  // namespace

void add_plot(Program& program) {
    const auto [command, o] = program.add(
        "plot", "Draw pictures of results, of a recording or of a system", plot,
        "Plots:\n"
        "  time:SOURCE                     cells over time; 'time:mean(SOURCE)' for their mean\n"
        "  space:SOURCE@100,200            the group as a picture at these cycles; without '@' at the last "
        "one\n"
        "  space:SOURCE@0..1000/100        at every 100th cycle; ';blocks=9x1' at the end divides the group\n"
        "  movie:SOURCE@0..500/5           the same as an animated GIF\n"
        "  connection:NAME                 the synapses between two groups, with strength and delay\n"
        "  wiring:NAME                     the receptive field of each cell of a small group\n"
        "  connection:NAME@0,100           weights that are learned, at these cycles; also "
        "'wiring:NAME@0,100'\n"
        "  diagram, diagram:PROCESS        the diagram of the system or of one process\n"
        "  trajectory, trajectory@1..50    the robot's paths, or those of these trials\n"
        "  curve:MEASURE, heat:MEASURE     a measure of an experiment over one or two swept parameters\n"
        "  learning, learning:COLUMN       targets, or a column of trials.csv, over the trials\n"
        "  occupancy                       where the robot was in all trials, and its mean paths, by "
        "condition\n"
        "A source is 'Process/Group:state(x1..x2,y1..y2)'; state and cells are optional. 'NAME:weight(3,1)'\n"
        "is the synapse of a connection from the third cell of its source to the first of its target. See\n"
        "docs/reference/expressions.md.\n"
        "Example:\n"
        "  forage plot systems/reactive_foraging.iqr diagram 'connection:US to Approach' --plot-format svg");
    add_value(command, "FROM", o.source, "DIR|FILE",
              "Directory of results, recording (.csv, .npy, .npz, .h5) or system (.iqr)")
        ->required();
    add_value(command, "PLOT", o.plots, "PLOT...", "Plots to draw; without any, all that are possible");
    repeated(
        command.add_option("--where", o.where,
                           "Of an experiment, draw only the runs with this value of a swept parameter or "
                           "of the seed: 'threshold=0.5', 'seed=1'; may be repeated"))
        ->option_text("NAME=VALUE");
    add_value(command, "-o,--output", o.directory, "DIR", "Directory for pictures [beside FROM]")
        ->check(named("directory"));
    add_value(command, "--layout", o.layout, "ROWSxCOLUMNS",
              "Draw the plots as panels a, b, c, ... of one figure, row by row: '2x3' are "
              "two rows of three panels");
    add_value(command, "--width", o.width, "WIDTH",
              "Width of each picture: '600px', or in mm, such as 85 or 180 for one or two columns of a "
              "paper; PNG then has 300 dots per inch [that which suits its content]")
        ->check(named("width"));
    add_plot_format(command, o.plot_format);
}

}  // namespace forage::tool
