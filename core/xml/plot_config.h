// The original's files of plots (.conf): which windows were open, on what, and the settings of the data
// sampler.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/diagnostic.h"

namespace forage::xml {

/// What a window shows of a group, or of the synapses of a connection.
struct PlotSource {
    std::string id;                   ///< of the item
    std::vector<std::string> states;  ///< their names; empty: none was chosen
    std::vector<int> cells;           ///< numbers of cells, from 0, row by row; empty: all
    bool average = false;
    Location at;
};

/// The settings of the data sampler.
struct SamplerSettings {
    std::string file;
    std::string mode = "overwrite";  ///< overwrite, append or sequence
    int every = 1;                   ///< cycles between two rows
    std::optional<int> rows;         ///< empty: until it is stopped
    bool automatic = false;          ///< whether it begins with the run
};

struct PlotWindow {
    enum class Kind { space, time, connection, sampler };
    Kind kind = Kind::space;
    std::string connection;  ///< id of the connection that it shows
    std::vector<PlotSource> sources;
    SamplerSettings sampler;  ///< of a sampler only
    Location at;
};

/// Reads <iqrDataManagerConfiguration> from a text with the name `path`. Windows and elements that are not
/// known are left out with a warning; reports mistakes with their places.
std::vector<PlotWindow> parse_plot_config(const std::string& path, const std::string& text,
                                          Diagnostics& diagnostics);

}  // namespace forage::xml
