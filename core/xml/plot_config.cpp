#include "core/xml/plot_config.h"

#include <map>

#include <fmt/format.h>

#include "core/base/number.h"
#include "core/xml/document.h"

namespace forage::xml {
namespace {

/// The pieces of a list with semicolons or commas between them, or blanks.
std::vector<std::string> pieces(std::string_view text) {
    std::vector<std::string> out;
    while (!text.empty()) {
        const auto end = std::min(text.find_first_of(";, \t\n"), text.size());
        if (end > 0) out.emplace_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return out;
}

/// A whole number of at least 0. Reports another text.
std::optional<int> count_in(std::string_view text, const Location& at, std::string_view what,
                            Diagnostics& diagnostics) {
    if (const auto out = parse_number<int>(text); out && *out >= 0) return out;
    diagnostics.error(at, fmt::format("{} is a whole number, not '{}'", what, text));
    return std::nullopt;
}

PlotSource source_of(const Element& display, Diagnostics& diagnostics) {
    PlotSource out;
    out.id = display["itemID"].text(), out.at = display.where();
    if (out.id.empty())
        diagnostics.error(display.where(), fmt::format("<{}> needs itemID", display.name()),
                          "the id of a group or connection");
    const Value indices = display["indices"];
    for (const auto& piece : pieces(indices.view))
        if (const auto cell = count_in(piece, indices.where(), "the number of a cell", diagnostics))
            out.cells.push_back(*cell);
    for (const Element& setting : display.children()) {
        const Value value = setting.value();
        if (setting.name() == "SelectedStates")
            out.states = pieces(value.view);
        else if (setting.name() == "Average")
            out.average = value.flag(false);
        else if (setting.name() != "Live")
            diagnostics.warning(setting.where(), fmt::format("<{}> is left out", setting.name()),
                                "it is not known what it sets");
    }
    return out;
}

/// A setting of a window, with the numbers that the original gives its choices.
void read_setting(const Element& setting, PlotWindow& window, Diagnostics& diagnostics) {
    const Value value = setting.value();
    const auto name = setting.name();
    const auto number = [&] { return count_in(value.view, value.where(), name, diagnostics); };
    if (window.kind == PlotWindow::Kind::connection && name == "ConnectionID") {
        window.connection = value.text();
    } else if (window.kind == PlotWindow::Kind::sampler && name == "AutoStart") {
        window.sampler.automatic = value.flag(false);
    } else if (window.kind == PlotWindow::Kind::sampler && name == "FileName") {
        window.sampler.file = value.text();
    } else if (window.kind == PlotWindow::Kind::sampler && name == "SamplingRate") {
        if (const auto every = number()) window.sampler.every = std::max(*every, 1);
    } else if (window.kind == PlotWindow::Kind::sampler && name == "Amount") {
        window.sampler.rows = number();
    } else if (window.kind == PlotWindow::Kind::sampler && name == "TARGET_MODE") {
        constexpr const char* modes[] = {"overwrite", "append", "sequence"};  // 4, 5, 6
        if (const auto mode = number()) {
            if (*mode >= 4 && *mode <= 6)
                window.sampler.mode = modes[*mode - 4];
            else
                diagnostics.warning(value.where(), fmt::format("there is no way {} to write a file", *mode),
                                    "4 overwrites it, 5 appends to it, 6 numbers the files");
        }
    } else if (!(window.kind == PlotWindow::Kind::connection && name == "Type")) {
        diagnostics.warning(setting.where(), fmt::format("<{}> is left out", name),
                            "it is not known what it sets");
    }
}

std::optional<PlotWindow> window_of(const Element& client, Diagnostics& diagnostics) {
    using Kind = PlotWindow::Kind;
    static const std::map<std::string_view, Kind> kinds = {{"PlotTypeGroup", Kind::space},
                                                           {"PlotTypeTime", Kind::time},
                                                           {"PlotTypeConnection", Kind::connection},
                                                           {"DataSampler", Kind::sampler}};
    const Value type = client["type"];
    const auto kind = kinds.find(type.view);
    if (kind == kinds.end()) {
        diagnostics.warning(type ? type.where() : client.where(),
                            fmt::format("there is no window of type '{}'; it is left out", type.view),
                            "PlotTypeGroup, PlotTypeTime, PlotTypeConnection or DataSampler");
        return std::nullopt;
    }
    PlotWindow out;
    out.kind = kind->second, out.at = client.where();
    bool steps = false;
    for (const Element& part : client.children()) {
        if (part.name() == "Position" || part.name() == "Geometry") continue;  // of another screen
        if (part.name() == "ACQ_MODE") {
            steps = part.value().view == "2";  // a number of steps
        } else if (part.name() == "StateVariableDisplay") {
            for (const Element& display : part.children())
                if (display.name() == "StateVariableDisplays")
                    out.sources.push_back(source_of(display, diagnostics));
                else
                    diagnostics.warning(display.where(), fmt::format("<{}> is left out", display.name()),
                                        "here are <StateVariableDisplays>");
        } else {
            read_setting(part, out, diagnostics);
        }
    }
    if (!steps) out.sampler.rows.reset();
    return out;
}

}  // namespace

std::vector<PlotWindow> parse_plot_config(const std::string& path, const std::string& text,
                                          Diagnostics& diagnostics) {
    std::vector<PlotWindow> out;
    const auto document =
        Document::parse({path, text}, "<iqrDataManagerConfiguration>", 100'000, diagnostics);
    if (!document) return out;
    const Element root = document->root();
    if (root.name() != "iqrDataManagerConfiguration") {
        diagnostics.error(root.where(), fmt::format("<{}> is no configuration of plots", root.name()),
                          "it begins with <iqrDataManagerConfiguration>");
        return out;
    }
    for (const Element& client : root.children()) {
        if (client.name() != "DataClient") {
            diagnostics.warning(client.where(), fmt::format("<{}> is left out", client.name()),
                                "here are windows: <DataClient>");
            continue;
        }
        if (auto window = window_of(client, diagnostics)) out.push_back(std::move(*window));
    }
    return out;
}

}  // namespace forage::xml
