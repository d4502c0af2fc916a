#include <cstdio>
#include <optional>

#include "core/base/named_file.h"
#include "core/base/print.h"
#include "tools/api/experiment/results.h"
#include "tools/forage/commands.h"

namespace forage::tool {

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

}  // namespace forage::tool
