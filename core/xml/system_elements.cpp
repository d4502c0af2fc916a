#include "core/xml/system_elements.h"

namespace forage::xml {
namespace {

AttributeRule id() { return required(text("id", "unique in the file")); }
AttributeRule name() { return required(text("name", "as shown to people")); }
AttributeRule name_of(Names what, std::string_view doc) { return naming(what, required(text("name", doc))); }
AttributeRule group(std::string_view name) {
    return naming(Names::group, required(text(name, "id of a group")));
}
AttributeRule port() {
    return omit_default(text("port", "port of the original's remote control; without effect"));
}
AttributeRule color() {
    return omit_default(text("color", "#RRGGBB, a colour of the original's diagram; without effect"));
}
AttributeRule cells(std::string_view name, std::string_view doc, double low = 1) {
    return in("cells", required(whole(name, doc, low, 1e5)));
}
AttributeRule min() { return called("At distance 0", required(number("min", "value at distance 0"))); }
AttributeRule max() {
    return called("At the largest distance", required(number("max", "value at the largest distance")));
}

template <class Shape>
std::vector<BoundAttribute> extent() {
    return attributes_of<Shape>({{&Shape::width, cells("width", "its extent along x")},
                                 {&Shape::height, cells("height", "its extent along y")}});
}
template <class Shape>
std::vector<BoundAttribute> window() {
    return attributes_of<Shape>(
        {{&Shape::inner_width,
          called("Width of the hole", cells("innerwidth", "the hole's extent along x", 0))},
         {&Shape::inner_height,
          called("Height of the hole", cells("innerheight", "the hole's extent along y", 0))},
         {&Shape::outer_width, called("Width", cells("outerwidth", "the extent along x"))},
         {&Shape::outer_height, called("Height", cells("outerheight", "the extent along y"))}});
}

std::vector<ElementRow> system_rows() {
    using namespace model;
    constexpr const char *functions = "FunUniform FunLinear FunGaussian FunBlock FunRandom",
                         *populations = "All Region List";
    // The attributes that the elements of all shapes have.
    const auto spread = element<Arborization>(
        {},
        {{&Arborization::direction,
          called("Around",
                 choice("direction", "RF: around the source cell; PF: around the target cell", {"RF", "PF"}),
                 {"the source cell", "the target cell"})},
         {&Arborization::probability,
          called("Probability of a synapse",
                 number("initialization_probability",
                        "probability that a point of the arborization becomes a synapse", 0, 1))}});
    const auto declaration = element<TypeDeclaration>(
        {"NeuronType", "a neuron type of this file", "Constant State Equations!"},
        {{&TypeDeclaration::name, required(text("name", "what groups or connections call it")),
          &TypeDeclaration::name_at},
         {&TypeDeclaration::doc, omit_default(text("doc", "what it is, in a sentence"))}});
    const auto rectangle = element<RectTopology>(
        {"TopologyRect", "a rectangle of cells", ""},
        {{&RectTopology::width, decisive(cells("hcount", "cells in a row"))},
         {&RectTopology::height, decisive(cells("vcount", "cells in a column"))},
         {&RectTopology::wrap_y, flag("cylinderHor", "the upper edge meets the lower one")},
         {&RectTopology::wrap_x, flag("cylinderVert", "the left edge meets the right one")}});
    auto short_rectangle = rectangle.rule.attributes;
    for (auto& rule : short_rectangle) {
        rule.value.doc += "; short for <TopologyRect>";
        if (std::exchange(rule.required, false)) rule.value.otherwise = "1";
    }
    auto weight = omit_default(number("weight", "of synapses with a fixed weight; short for <Synapse>"));
    weight.value.formula = true, weight.value.otherwise = "1";
    return {
        element<System>(
            {"System", "a brain model: processes and the connections between their groups",
             "Constant NeuronType SynapseType Note? Process Connection"},
            {{&System::id, id()},
             {&System::name, name()},
             {&System::author, text("author", "the author")},
             {&System::date, text("date", "when it was made")},
             {&System::cycles_per_second,
              in("cycles/s",
                 number("cylesPerSecond",
                        "cycles in a second of the clock; 0 (unthrottled in the original) counts as 25", 0,
                        1e6))},
             {&System::sync_plots, flag("syncPlots", "plots follow every cycle; without effect")},
             {&System::port, port()}}),
        ElementRule{"iqrEntity",
                    "a part of a system in a file of its own",
                    "NeuronType SynapseType Process+ Connection",
                    {required(choice("type", "what the part is", {"Process"}))}},
        element<Process>(
            {"Process", "a part of the system: groups, and possibly the module that ties them to the outside",
             "Constant Port Module? Note? DiagramIcon? Group"},
            {{&Process::id, id()},
             {&Process::name, name()},
             {&Process::hostname, omit_default(text("hostname", "without effect"))},
             {&Process::port, port()},
             {&Process::module_enabled, flag("enableModule", "whether the module runs")},
             {&Process::path,
              omit_default(
                  text("path", "file of a linked process, relative to this file; empty: not linked")),
              &Process::path_at},
             {&Process::color, color()}}),
        element<Port>(
            {"Port",
             "a group of a process file that other processes connect to, or one of theirs that it reads", ""},
            {{&Port::name, required(text("name", "after the id of the process: source=\"left.name\"")),
              &Port::name_at},
             {&Port::group,
              omit_default(text("group", "id of a group; empty: each use of the file gives one of its own")),
              &Port::group_at}}),
        element<Constant>(
            {"Constant", "a number with a name, which formulas in braces use", ""},
            {{&Constant::name, required(text("name", "letters, digits and _")), &Constant::name_at},
             {&Constant::value, required(text("value", "a number, or a formula in braces")),
              &Constant::value_at},
             {&Constant::minimum, omit_default(number("minimum", "smallest value"))},
             {&Constant::maximum, omit_default(number("maximum", "largest value"))},
             {&Constant::unit, omit_default(text("unit", "of the value; without effect"))},
             {&Constant::doc, omit_default(text("doc", "what it means"))}}),
        declaration,
        ElementRule{"SynapseType", "a synapse type of this file", declaration.rule.content,
                    declaration.rule.attributes},
        element<DeclaredState>(
            {"State", "a state of a type, which is recorded under its name", ""},
            {{&DeclaredState::name, required(text("name", "letters, digits and _")), &DeclaredState::name_at},
             {&DeclaredState::value,
              omit_default(
                  text("value", "before the first cycle: a number, or a formula in braces; empty: 0")),
              &DeclaredState::value_at},
             {&DeclaredState::unit, omit_default(text("unit", "of the value; without effect"))},
             {&DeclaredState::doc, omit_default(text("doc", "what it means"))}}),
        ElementRule{"Equations", "what a type computes in a cycle", ":text"},
        element<ModuleUse>({"Module", "what ties the process to the outside", "Parameter XRefHolder Note?"},
                           {{&ModuleUse::type, name_of(Names::module, "the module type"), &ModuleUse::at}}),
        element<Setting>(
            {"Parameter", "a parameter of a type", ""},
            {{&Setting::name, name_of(Names::parameter, "as the type declares it"), &Setting::name_at},
             {&Setting::value, naming(Names::value, required(text("value", "its value"))),
              &Setting::value_at}}),
        element<Initial>(
            {"Initial", "with what a state of all cells or synapses begins", ""},
            {{&Initial::state, required(text("state", "as the type declares it")), &Initial::state_at},
             {&Initial::value,
              omit_default(text(
                  "value", "a number, a formula in braces, normal(mean, deviation) or uniform(low, high)")),
              &Initial::value_at},
             {&Initial::file,
              omit_default(text("file",
                                "a .npy or CSV file, relative to this file: a number per cell; of "
                                "synapses, a row per target cell and a column per source cell")),
              &Initial::file_at},
             {&Initial::column,
              omit_default(text("column", "of a CSV file whose first row names its columns")),
              &Initial::column_at}}),
        ElementRule{"XRefHolder",
                    "a list of cross references",
                    "XRef",
                    {required(decisive(
                        choice("name", "InputFromGroup and OutputToGroup in a module, Freedback in a synapse",
                               {"InputFromGroup", "OutputToGroup", "Freedback"})))}},
        element<CrossReference>(
            {"XRef", "a port of the type and what is connected to it", ""},
            {{&CrossReference::name, name_of(Names::port, "as the type declares it")},
             {&CrossReference::target,
              naming(Names::target, required(text("target",
                                                  "id of a group, or a state of the target's "
                                                  "neuron; empty: unset")))}}),
        ElementRule{"Note", "a text for people", ":text"},
        element<Icon>({"DiagramIcon", "place of an icon in the diagram", ""},
                      {{&Icon::x, in("pixels", coordinate("x", "its left edge"))},
                       {&Icon::y, in("pixels", coordinate("y", "its upper edge"))},
                       {&Icon::width, in("pixels", whole("width", "of the icon", 0))},
                       {&Icon::height, in("pixels", whole("height", "of the icon", 0))}}),
        element<Group>({"Group", "cells of one neuron type", "Topology? Neuron! Note? DiagramIcon?"},
                       {{&Group::id, id()}, {&Group::name, name()}, {&Group::color, color()}},
                       short_rectangle),
        ElementRule{"Topology", "the cells of a group", "TopologyRect TopologySparse", {}, 1},
        rectangle,
        ElementRule{"TopologySparse", "single cells", "Point+"},
        element<Point>(
            {"Point", "a cell, or a vertex of a line", ""},
            {{&Point::x, decisive(coordinate("x", "column of a cell, from 1; of a vertex: pixels"))},
             {&Point::y, decisive(coordinate("y", "row of a cell, from 1; of a vertex: pixels"))}}),
        element<TypeUse>({"Neuron", "the type of a group's cells", "Parameter Initial Note?"},
                         {{&TypeUse::type, name_of(Names::neuron, "the neuron type"), &TypeUse::at}}),
        element<Connection>(
            {"Connection", "synapses from one group to another",
             "Pattern? Weights? Arborization? AttenuationFunction? DelayFunction? Synapse? Note? "
             "DiagramLine?"},
            {{&Connection::id, id()},
             {&Connection::name, name()},
             {&Connection::kind, choice("type", "how it acts on its target",
                                        {input_kind_names.begin(), input_kind_names.end()})},
             {&Connection::source, group("source"), &Connection::source_at},
             {&Connection::target, group("target"), &Connection::target_at},
             {&Connection::input,
              omit_default(
                  text("input", "in place of a type: a further input that the target's type declares")),
              &Connection::input_at},
             {&Connection::state,
              omit_default(text("state", "of the source, which it transmits; empty: the output")),
              &Connection::state_at}},
            {weight}),
        element<Weights>(
            {"Weights", "in place of a pattern: the weight of each synapse, in a file or as rows of numbers",
             ":text"},
            {{&Weights::file,
              omit_default(
                  text("file", "a .npy or CSV file, relative to this file; empty: the element's text")),
              &Weights::file_at},
             {&Weights::is_list,
              omit_default(
                  choice("form",
                         "a row per target cell and a column per source cell, or a row source, target, "
                         "weight, perhaps delay per synapse, with cells from 0",
                         {"matrix", "list"}))}}),
        ElementRule{"Pattern", "which cells are paired", "PatternMapped PatternForeach PatternTuples", {}, 1},
        element<MappedPattern>(
            {"PatternMapped", "the smaller population laid over the larger", populations, {}, 2, true},
            {{&MappedPattern::all,
              choice("type", "pair with the centre of the projection, or with all cells under it",
                     {"center", "all"})}}),
        ElementRule{"PatternForeach", "every source cell with every target cell", populations, {}, 2, true},
        ElementRule{"PatternTuples", "cell by cell", "Tuple+"},
        ElementRule{"Tuple", "every source of it with every target of it", "SourceList! TargetList!"},
        ElementRule{"SourceList", "cells of the source", "Point+"},
        ElementRule{"TargetList", "cells of the target", "Point+"},
        ElementRule{"All", "every cell"},
        element<Region>({"Region", "a rectangle of cells", ""},
                        {{&Region::x, cells("xstart", "its leftmost column")},
                         {&Region::y, cells("ystart", "its uppermost row")},
                         {&Region::width, cells("width", "its columns")},
                         {&Region::height, cells("height", "its rows")}}),
        ElementRule{"List", "single cells", "Point+"},
        ElementRule{"Arborization",
                    "how a pair spreads into synapses",
                    "ArbRect ArbEllipse ArbRectWindow ArbEllipseWindow ArbAll ArbRandom",
                    {},
                    1},
        spread,
        element<RectArbor>({"ArbRect", "a rectangle", ""}, extent<RectArbor>(), spread.rule.attributes),
        element<EllipseArbor>({"ArbEllipse", "an ellipse", ""}, extent<EllipseArbor>(),
                              spread.rule.attributes),
        element<RectWindowArbor>({"ArbRectWindow", "a rectangle with a hole", ""}, window<RectWindowArbor>(),
                                 spread.rule.attributes),
        element<EllipseWindowArbor>({"ArbEllipseWindow", "an ellipse with a hole", ""},
                                    window<EllipseWindowArbor>(), spread.rule.attributes),
        element<AllArbor>({"ArbAll", "every cell", ""}, {}, spread.rule.attributes),
        element<RandomArbor>(
            {"ArbRandom", "cells chosen at random", ""},
            {{&RandomArbor::count, called("Cells per pair", cells("count", "how many for each pair", 0))}},
            spread.rule.attributes),
        ElementRule{"AttenuationFunction", "what is lost over the distance", functions, {}, 1},
        ElementRule{"DelayFunction", "cycles lost over the distance", functions, {}, 1},
        element<UniformFunction>(
            {"FunUniform", "the same everywhere", ""},
            {{&UniformFunction::value, required(number("value", "attenuation, or delay in cycles"))}}),
        element<LinearFunction>({"FunLinear", "rises with the distance", ""},
                                {{&LinearFunction::min, min()}, {&LinearFunction::max, max()}}),
        element<GaussianFunction>({"FunGaussian", "rises with the distance like a Gaussian upside down", ""},
                                  {{&GaussianFunction::min, min()},
                                   {&GaussianFunction::max, max()},
                                   {&GaussianFunction::sigma,
                                    called("Width of the Gaussian",
                                           in("cells", required(number("sigma", "its width in cells"))))}}),
        element<BlockFunction>(
            {"FunBlock", "min near, max far", ""},
            {{&BlockFunction::min, min()},
             {&BlockFunction::max, max()},
             {&BlockFunction::width,
              in("cells", required(whole("width", "diameter of what is near, in cells", 0)))},
             {&BlockFunction::height, omit_default(whole("height", "without effect", 0))}}),
        element<RandomFunction>(
            {"FunRandom", "random between 0 and max", ""},
            {{&RandomFunction::max, called("Largest value", required(number("max", "largest value")))}}),
        element<SynapseUse>(
            {"Synapse", "the type of a connection's synapses", "Parameter Initial XRefHolder Note?"},
            {{&SynapseUse::type, name_of(Names::synapse, "the synapse type"), &SynapseUse::at}}),
        element<Line>(
            {"DiagramLine", "the line that draws a connection", "Point"},
            {{&Line::source_anchor,
              whole("APSource", "where it leaves the source's icon, 16 points around it", 0, 15)},
             {&Line::target_anchor, whole("APTarget", "where it meets the target's icon", 0, 15)}})};
}

}  // namespace

AttributeRule coordinate(std::string_view name, std::string_view doc) {
    return required(whole(name, doc, -model::farthest_coordinate, model::farthest_coordinate));
}

const std::vector<ElementRow>& system_elements() {
    static const auto elements = system_rows();
    return elements;
}

const ElementRow& row_of(std::type_index type) {
    return *std::ranges::find(system_elements(), type, &ElementRow::type);
}

}  // namespace forage::xml
