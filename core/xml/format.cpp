#include "core/xml/format.h"

#include <algorithm>

namespace forage::xml {
namespace {

AttributeRule text(std::string name, std::string doc, bool required = false) {
    return {std::move(name), ValueKind::text, required, std::move(doc), -1e300, 1e300, {}};
}
AttributeRule flag(std::string name, std::string doc, bool required = false) {
    return {std::move(name), ValueKind::boolean, required, std::move(doc), -1e300, 1e300, {}};
}
AttributeRule whole(std::string name, std::string doc, double low, double high = 1e6, bool required = true) {
    return {std::move(name), ValueKind::whole, required, std::move(doc), low, high, {}};
}
AttributeRule number(std::string name, std::string doc, double low = -1e300, double high = 1e300,
                     bool required = true) {
    return {std::move(name), ValueKind::number, required, std::move(doc), low, high, {}};
}
AttributeRule choice(std::string name, std::string doc, std::vector<std::string> choices,
                     bool required = true) {
    return {std::move(name), ValueKind::choice, required, std::move(doc), -1e300, 1e300, std::move(choices)};
}

AttributeRule direction() {
    return choice("direction", "RF: around the source cell; PF: around the target cell", {"RF", "PF"}, false);
}
AttributeRule probability() {
    return number("initialization_probability", "chance that a point of the arborization becomes a synapse",
                  0, 1);
}
AttributeRule cells(std::string name, double low = 1, std::string doc = "a number of cells") {
    return whole(std::move(name), std::move(doc), low, 1e5);
}
AttributeRule coordinate(std::string name) {
    return whole(std::move(name), "in the units of the diagram, or a cell from 1", -1e6, 1e6);
}
AttributeRule port() { return text("port", "port of the original's remote control"); }

constexpr int many = any_number;

Format make_table() {
    const std::vector<ChildRule> functions{
        {"FunUniform"}, {"FunLinear"}, {"FunGaussian"}, {"FunBlock"}, {"FunRandom"}};
    const std::vector<ChildRule> populations{{"All", 0, 2}, {"Region", 0, 2}, {"List", 0, 2}};
    const std::vector<AttributeRule> rect{cells("width"), cells("height"), direction(), probability()};
    const std::vector<AttributeRule> window{cells("innerwidth", 0),
                                            cells("innerheight", 0),
                                            cells("outerwidth"),
                                            cells("outerheight"),
                                            direction(),
                                            probability()};
    const AttributeRule min = number("min", "value at distance 0"),
                        max = number("max", "value at the largest distance");
    return {
        {"System",
         "a brain model: processes and the connections between their groups",
         {text("id", "unique in the file", true), text("name", "as shown to people", true),
          text("author", "who made it"), text("date", "when it was made"),
          number("cylesPerSecond", "pace of the simulation, in cycles per second; 0: unthrottled", 0, 1e6),
          flag("syncPlots", "plots follow every cycle"), port()},
         {{"Note"}, {"Process", 0, many}, {"Connection", 0, many}}},
        {"iqrEntity",
         "a part of a system in a file of its own",
         {choice("type", "what the part is", {"Process"})},
         {{"Process", 1, 1}, {"Connection", 0, many}}},
        {"Process",
         "a part of the system: groups, and possibly the module that ties them to the outside",
         {text("id", "unique in the file", true), text("name", "as shown to people", true),
          text("hostname", "unused"), port(), flag("enableModule", "whether the module runs"),
          text("path", "file of a linked process"), text("color", "#RRGGBB")},
         {{"Module"}, {"Note"}, {"DiagramIcon"}, {"Group", 0, many}}},
        {"Module",
         "what ties the process to the outside",
         {text("name", "the module type", true)},
         {{"Parameter", 0, many}, {"XRefHolder", 0, many}, {"Note"}}},
        {"Parameter",
         "a parameter of a type",
         {text("name", "as the type declares it", true), text("value", "its value", true)},
         {}},
        {"XRefHolder",
         "a list of cross references",
         {choice("name", "InputFromGroup and OutputToGroup in a module, Freedback in a synapse",
                 {"InputFromGroup", "OutputToGroup", "Freedback"})},
         {{"XRef", 0, many}}},
        {"XRef",
         "a named place and what stands in it",
         {text("name", "as the type declares it", true),
          text("target", "id of a group, or a state of the target's neuron; empty: unset", true)},
         {}},
        {"Note", "a text for people", {}, {}, true},
        {"DiagramIcon",
         "place of an icon in the diagram",
         {coordinate("x"), coordinate("y"), whole("width", "of the icon", 0, 1e6, false),
          whole("height", "of the icon", 0, 1e6, false)},
         {}},
        {"Group",
         "cells of one neuron type",
         {text("id", "unique in the file", true), text("name", "as shown to people", true),
          text("color", "#RRGGBB")},
         {{"Topology", 1, 1}, {"Neuron", 1, 1}, {"Note"}, {"DiagramIcon"}}},
        {"Topology", "the cells of a group", {}, {{"TopologyRect"}, {"TopologySparse"}}, false, 1},
        {"TopologyRect",
         "a rectangle of cells",
         {cells("hcount", 1, "cells in a row"), cells("vcount", 1, "cells in a column"),
          flag("cylinderHor", "the upper edge meets the lower one"),
          flag("cylinderVert", "the left edge meets the right one")},
         {}},
        {"TopologySparse", "single cells", {}, {{"Point", 1, many}}},
        {"Point", "a cell, or a vertex of a line", {coordinate("x"), coordinate("y")}, {}},
        {"Neuron",
         "the type of a group's cells",
         {text("name", "the neuron type", true)},
         {{"Parameter", 0, many}, {"Note"}}},
        {"Connection",
         "synapses from one group to another",
         {text("id", "unique in the file", true), text("name", "as shown to people", true),
          text("source", "id of a group", true), text("target", "id of a group", true),
          choice("type", "how it acts on its target", {"excitatory", "inhibitory", "modulatory"}, false)},
         {{"Pattern", 1, 1},
          {"Arborization", 1, 1},
          {"AttenuationFunction", 1, 1},
          {"DelayFunction", 1, 1},
          {"Synapse"},
          {"Note"},
          {"DiagramLine"}}},
        {"Pattern",
         "which cells are paired",
         {},
         {{"PatternMapped"}, {"PatternForeach"}, {"PatternTuples"}},
         false,
         1},
        {"PatternMapped",
         "the smaller population laid over the larger",
         {choice("type", "pair with the centre of the projection, or with all cells under it",
                 {"center", "all"}, false)},
         populations,
         false,
         2},
        {"PatternForeach", "every source cell with every target cell", {}, populations, false, 2},
        {"PatternTuples", "cell by cell", {}, {{"Tuple", 1, many}}},
        {"Tuple",
         "every source of it with every target of it",
         {},
         {{"SourceList", 1, 1}, {"TargetList", 1, 1}}},
        {"SourceList", "cells of the source", {}, {{"Point", 1, many}}},
        {"TargetList", "cells of the target", {}, {{"Point", 1, many}}},
        {"All", "every cell", {}, {}},
        {"Region",
         "a rectangle of cells",
         {cells("xstart", 1, "its leftmost column"), cells("ystart", 1, "its uppermost row"),
          cells("width", 1, "its columns"), cells("height", 1, "its rows")},
         {}},
        {"List", "single cells", {}, {{"Point", 1, many}}},
        {"Arborization",
         "how a pair spreads into synapses",
         {},
         {{"ArbRect"}, {"ArbEllipse"}, {"ArbRectWindow"}, {"ArbEllipseWindow"}, {"ArbAll"}, {"ArbRandom"}},
         false,
         1},
        {"ArbRect", "a rectangle", rect, {}},
        {"ArbEllipse", "an ellipse", rect, {}},
        {"ArbRectWindow", "a rectangle with a hole", window, {}},
        {"ArbEllipseWindow", "an ellipse with a hole", window, {}},
        {"ArbAll", "every cell", {direction(), probability()}, {}},
        {"ArbRandom", "cells chosen at random", {cells("count", 0), direction(), probability()}, {}},
        {"AttenuationFunction", "what is lost over the distance", {}, functions, false, 1},
        {"DelayFunction", "cycles lost over the distance", {}, functions, false, 1},
        {"FunUniform", "the same everywhere", {number("value", "attenuation, or delay in cycles")}, {}},
        {"FunLinear", "rises with the distance", {min, max}, {}},
        {"FunGaussian",
         "rises with the distance like a Gaussian upside down",
         {min, max, number("sigma", "its width in cells")},
         {}},
        {"FunBlock",
         "min near, max far",
         {min, max, whole("width", "diameter of what is near, in cells", 0),
          whole("height", "without effect", 0, 1e6, false)},
         {}},
        {"FunRandom", "random between 0 and max", {max}, {}},
        {"Synapse",
         "the type of a connection's synapses",
         {text("name", "the synapse type", true)},
         {{"Parameter", 0, many}, {"XRefHolder", 0, many}, {"Note"}}},
        {"DiagramLine",
         "the line that draws a connection",
         {whole("APSource", "where it leaves the source's icon, 16 points around it", 0, 15, false),
          whole("APTarget", "where it meets the target's icon", 0, 15, false)},
         {{"Point", 0, many}}},
    };
}

}  // namespace

const AttributeRule* ElementRule::attribute(std::string_view wanted) const {
    const auto it =
        std::find_if(attributes.begin(), attributes.end(), [&](const auto& a) { return a.name == wanted; });
    return it == attributes.end() ? nullptr : &*it;
}

const Format& format_table() {
    static const Format table = make_table();
    return table;
}

const ElementRule* find_element(std::string_view name, const Format& format) {
    const auto it = std::find_if(format.begin(), format.end(), [&](const auto& e) { return e.name == name; });
    return it == format.end() ? nullptr : &*it;
}

}  // namespace forage::xml
