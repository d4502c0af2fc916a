// The elements and attributes of system and process files, with the original's spellings.
#include "core/model/system.h"
#include "core/xml/rules.h"

namespace forage::xml {
namespace {

AttributeRule direction() {
    return otherwise(
        "RF", choice("direction", "RF: around the source cell; PF: around the target cell", {"RF", "PF"}));
}
AttributeRule probability() {
    return otherwise("1", number("initialization_probability",
                                 "probability that a point of the arborization becomes a synapse", 0, 1));
}
AttributeRule cells(std::string name, std::string doc, double low = 1) {
    return in("cells", required(whole(std::move(name), std::move(doc), low, 1e5)));
}
AttributeRule decisive(AttributeRule rule) {
    rule.value.decisive = true;
    return rule;
}
AttributeRule coordinate(std::string name, std::string doc) {
    return required(
        whole(std::move(name), std::move(doc), -model::farthest_coordinate, model::farthest_coordinate));
}
AttributeRule id() { return required(text("id", "unique in the file")); }
AttributeRule name() { return required(text("name", "as shown to people")); }
AttributeRule name_of(Names what, std::string doc) {
    return naming(what, required(text("name", std::move(doc))));
}
AttributeRule port() { return text("port", "port of the original's remote control; without effect"); }
AttributeRule color() { return text("color", "#RRGGBB, a colour of the original's diagram; without effect"); }

std::vector<ElementRule> elements() {
    constexpr std::string_view functions = "FunUniform FunLinear FunGaussian FunBlock FunRandom",
                               populations = "All Region List";
    const std::vector<AttributeRule> rect{cells("width", "its extent along x"),
                                          cells("height", "its extent along y"), direction(), probability()};
    const std::vector<AttributeRule> window{cells("innerwidth", "the hole's extent along x", 0),
                                            cells("innerheight", "the hole's extent along y", 0),
                                            cells("outerwidth", "the extent along x"),
                                            cells("outerheight", "the extent along y"),
                                            direction(),
                                            probability()};
    const AttributeRule min = required(number("min", "value at distance 0")),
                        max = required(number("max", "value at the largest distance"));
    return {
        {"System",
         "a brain model: processes and the connections between their groups",
         "Note? Process Connection",
         {id(), name(), text("author", "the author"), text("date", "when it was made"),
          in("cycles/s",
             otherwise("25",
                       number("cylesPerSecond",
                              "cycles in a second of the clock; 0 (unthrottled in the original) counts as 25",
                              0, 1e6))),
          otherwise("false", flag("syncPlots", "plots follow every cycle; without effect")), port()}},
        {"iqrEntity",
         "a part of a system in a file of its own",
         "Process! Connection",
         {required(choice("type", "what the part is", {"Process"}))}},
        {"Process",
         "a part of the system: groups, and possibly the module that ties them to the outside",
         "Module? Note? DiagramIcon? Group",
         {id(), name(), text("hostname", "without effect"), port(),
          otherwise("true", flag("enableModule", "whether the module runs")),
          text("path", "file of a linked process, relative to this file; empty: not linked"), color()}},
        {"Module",
         "what ties the process to the outside",
         "Parameter XRefHolder Note?",
         {name_of(Names::module, "the module type")}},
        {"Parameter",
         "a parameter of a type",
         "",
         {name_of(Names::parameter, "as the type declares it"),
          naming(Names::value, required(text("value", "its value")))}},
        {"XRefHolder",
         "a list of cross references",
         "XRef",
         {required(
             decisive(choice("name", "InputFromGroup and OutputToGroup in a module, Freedback in a synapse",
                             {"InputFromGroup", "OutputToGroup", "Freedback"})))}},
        {"XRef",
         "a port of the type and what is connected to it",
         "",
         {name_of(Names::port, "as the type declares it"),
          naming(
              Names::target,
              required(text("target", "id of a group, or a state of the target's neuron; empty: unset")))}},
        {"Note", "a text for people", ":text"},
        {"DiagramIcon",
         "place of an icon in the diagram",
         "",
         {in("pixels", coordinate("x", "its left edge")), in("pixels", coordinate("y", "its upper edge")),
          in("pixels", otherwise("50", whole("width", "of the icon", 0))),
          in("pixels", otherwise("50", whole("height", "of the icon", 0)))}},
        {"Group",
         "cells of one neuron type",
         "Topology! Neuron! Note? DiagramIcon?",
         {id(), name(), color()}},
        {"Topology", "the cells of a group", "TopologyRect TopologySparse", {}, 1},
        {"TopologyRect",
         "a rectangle of cells",
         "",
         {decisive(cells("hcount", "cells in a row")), decisive(cells("vcount", "cells in a column")),
          otherwise("false", flag("cylinderHor", "the upper edge meets the lower one")),
          otherwise("false", flag("cylinderVert", "the left edge meets the right one"))}},
        {"TopologySparse", "single cells", "Point+"},
        {"Point",
         "a cell, or a vertex of a line",
         "",
         {decisive(coordinate("x", "column of a cell, from 1; of a vertex: pixels")),
          decisive(coordinate("y", "row of a cell, from 1; of a vertex: pixels"))}},
        {"Neuron",
         "the type of a group's cells",
         "Parameter Note?",
         {name_of(Names::neuron, "the neuron type")}},
        {"Connection",
         "synapses from one group to another",
         "Pattern? Arborization? AttenuationFunction? DelayFunction? Synapse? Note? DiagramLine?",
         {id(), name(), naming(Names::group, required(text("source", "id of a group"))),
          naming(Names::group, required(text("target", "id of a group"))),
          otherwise("excitatory", choice("type", "how it acts on its target",
                                         {"excitatory", "inhibitory", "modulatory"}))}},
        {"Pattern", "which cells are paired", "PatternMapped PatternForeach PatternTuples", {}, 1},
        {"PatternMapped",
         "the smaller population laid over the larger",
         populations,
         {otherwise("center",
                    choice("type", "pair with the centre of the projection, or with all cells under it",
                           {"center", "all"}))},
         2,
         true},
        {"PatternForeach", "every source cell with every target cell", populations, {}, 2, true},
        {"PatternTuples", "cell by cell", "Tuple+"},
        {"Tuple", "every source of it with every target of it", "SourceList! TargetList!"},
        {"SourceList", "cells of the source", "Point+"},
        {"TargetList", "cells of the target", "Point+"},
        {"All", "every cell"},
        {"Region",
         "a rectangle of cells",
         "",
         {cells("xstart", "its leftmost column"), cells("ystart", "its uppermost row"),
          cells("width", "its columns"), cells("height", "its rows")}},
        {"List", "single cells", "Point+"},
        {"Arborization",
         "how a pair spreads into synapses",
         "ArbRect ArbEllipse ArbRectWindow ArbEllipseWindow ArbAll ArbRandom",
         {},
         1},
        {"ArbRect", "a rectangle", "", rect},
        {"ArbEllipse", "an ellipse", "", rect},
        {"ArbRectWindow", "a rectangle with a hole", "", window},
        {"ArbEllipseWindow", "an ellipse with a hole", "", window},
        {"ArbAll", "every cell", "", {direction(), probability()}},
        {"ArbRandom",
         "cells chosen at random",
         "",
         {cells("count", "how many for each pair", 0), direction(), probability()}},
        {"AttenuationFunction", "what is lost over the distance", functions, {}, 1},
        {"DelayFunction", "cycles lost over the distance", functions, {}, 1},
        {"FunUniform",
         "the same everywhere",
         "",
         {required(number("value", "attenuation, or delay in cycles"))}},
        {"FunLinear", "rises with the distance", "", {min, max}},
        {"FunGaussian",
         "rises with the distance like a Gaussian upside down",
         "",
         {min, max, in("cells", required(number("sigma", "its width in cells")))}},
        {"FunBlock",
         "min near, max far",
         "",
         {min, max, in("cells", required(whole("width", "diameter of what is near, in cells", 0))),
          otherwise("0", whole("height", "without effect", 0))}},
        {"FunRandom", "random between 0 and max", "", {max}},
        {"Synapse",
         "the type of a connection's synapses",
         "Parameter XRefHolder Note?",
         {name_of(Names::synapse, "the synapse type")}},
        {"DiagramLine",
         "the line that draws a connection",
         "Point",
         {otherwise("0", whole("APSource", "where it leaves the source's icon, 16 points around it", 0, 15)),
          otherwise("0", whole("APTarget", "where it meets the target's icon", 0, 15))}},
    };
}

Format format(std::string_view name, std::string_view beginning, std::string_view root) {
    return Format{.name = name,
                  .beginning = beginning,
                  .roots = {root},
                  .where_texts_stand = "write a text in a <Note>, and a remark in <!-- -->",
                  .values = {{"text", {}}},
                  .elements = elements()}
        .link();
}

}  // namespace

const Format& system_format() {
    static const Format table = format("a system file", "<System ...>", "System");
    return table;
}

const Format& process_format() {
    static const Format table = format("a process file", "<iqrEntity ...>", "iqrEntity");
    return table;
}

}  // namespace forage::xml
