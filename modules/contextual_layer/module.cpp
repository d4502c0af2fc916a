#include "modules/contextual_layer/module.h"

#include <cstring>

#include <fmt/format.h>

#include "modules/contextual_layer/display.h"

namespace forage::contextual {
namespace {

enum In : std::size_t { action_in, prototype, stats, discrepancy_in };
enum Out : std::size_t { action_out, empty, collector, distance, selected, trigger };

/// Whether the memory may have this width or height.
bool possible(double extent) { return extent >= 1 && extent < 1e6; }

}  // namespace

void ContextualLayerModule::describe(ModuleSpec<ContextualLayerModule>& s) {
    using T = ContextualLayerModule;
    s.name("moduleCL", "Contextual Layer")
        .doc(
            "Remembers the sequences of prototypes and actions that led to a goal, and repeats the actions "
            "when the prototypes recur.");
    s.param("Memory Height", &T::height)
        .label("Memory height")
        .range(0, 1000)
        .at_start()
        .doc("Number of sequences, and the maximum number of segments of a sequence.");
    s.param("Memory Width", &T::width)
        .label("Memory width")
        .range(0, 1000)
        .at_start()
        .doc(
            "Number of segments per sequence that the pictures of the memory show, and the maximum of a "
            "sequence.");
    s.param("Memory Threshold", &T::threshold)
        .label("Memory threshold")
        .range(0, 2)
        .doc("A segment is selected only if its collector is above this value.");
    s.param("%-WTA", &T::share)
        .range(0, 1)
        .doc(
            "A segment is selected only if its collector is at least this fraction (0 to 1) of the largest "
            "one.");
    s.param("Trigger Reset", &T::reset)
        .range(0, 2)
        .doc("Trigger of the segment that follows a selected one; values above 1 favour it.");
    s.param("Trigger Decay", &T::decay)
        .range(0, 2)
        .doc("Fraction of the difference to 1 by which a trigger decays in a cycle.");
    s.param("Discrepancy Threshold", &T::discrepancy)
        .range(0, 2)
        .doc("The layer opens, permanently, when the discrepancy is between 1e-6 and this value.");
    s.input("action", "Action").doc("The action of this cycle, which the memory stores.");
    s.input("prototype", "Prototype")
        .doc("The prototype of this cycle, which the memory stores and compares.");
    s.input("stats", "Stats")
        .size("at least 2 cells",
              [](const auto&, PortSizes&, const GroupShape& given) {
                  return given.cells >= 2 ? given : rectangle(2, 1);
              })
        .names([](const auto&, const ModulePorts&, const GroupShape& shape) {
            return shape.height > 1 ? CellNames{.rows = {"success", "failure"}}
                                    : CellNames{.columns = {"success", "failure"}};
        })
        .doc(
            "Cell 1 is active when a positive goal is reached, cell 2 when a negative one is; others have no "
            "effect.");
    s.input("discrepancy", "Discrepancy")
        .cells(1)
        .tolerate([](PortSizes&, const GroupShape&) { return true; })
        .doc("The discrepancy that opens the layer; other cells have no effect.");
    s.output("action", "Action")
        .size("at most as many cells as the input 'action'",
              [](const auto&, PortSizes& of, const GroupShape& given) {
                  const auto action = of["action"];
                  return given.cells <= action.cells ? given : action;
              })
        .doc("The sum of the actions of the selected segments; a smaller group gets the first cells.");
    const auto picture = [&](const char* name, const char* label, const char* doc, bool larger) {
        s.output(name, label)
            .optional()
            .size(larger ? "at least 'Memory Width' x 'Memory Height' cells"
                         : "'Memory Width' x 'Memory Height' cells",
                  [larger](const auto& m, PortSizes&, const GroupShape& given) {
                      if (!possible(m.width) || !possible(m.height)) return given;  // check() reports it
                      const auto memory =
                          rectangle(static_cast<std::int64_t>(m.width), static_cast<std::int64_t>(m.height));
                      const bool fits = given.cells == memory.cells || (larger && given.cells > memory.cells);
                      return fits ? given : memory;
                  })
            .names([](const auto&, const ModulePorts&, const GroupShape&) {
                return CellNames{.column = "segment", .row = "sequence"};
            })
            .doc(std::string(doc) + " Row: sequence; column: segment, the last before the goal first.");
    };
    picture("empty", "Empty", "1 for each unused segment of the memory.", true);
    picture("collector", "Collector", "How well each segment matches, times its trigger.", false);
    picture("distance", "Distance", "The distance of each segment to the prototype, 0 to 1.", true);
    picture("selected", "Selected", "1 for each selected segment.", true);
    picture("trigger", "Trigger", "The trigger of each segment.", true);
}

void ContextualLayerModule::check(const ModulePorts&, Diagnostics& diagnostics) const {
    for (const auto& [name, value] : {std::pair{"Memory Height", height}, std::pair{"Memory Width", width}})
        if (!possible(value))
            diagnostics.error(
                at_parameter(name),
                fmt::format("'{}' is {}, which is not a possible size of the memory", name, value),
                "use 1 to 1000");
}

void ContextualLayerModule::start(const ModulePorts& ports) {
    layer_ = ContextualLayer(static_cast<Index>(height), static_cast<Index>(width),
                             ports.inputs[prototype].shape.cells, ports.inputs[action_in].shape.cells);
    displayed_ = false;
    for (auto& numbers : shown_) numbers = layer_.memory().distance();
}

void ContextualLayerModule::update(ModuleFrame& frame) {
    const auto& goals = frame.input(stats);
    if (!layer_.update({frame.input(action_in), frame.input(prototype), goals[0], goals[1],
                        frame.input(discrepancy_in)[0]},
                       {threshold, share, reset, decay, discrepancy}))
        return;
    Column action = frame.output(action_out);
    action = layer_.action().head(action.size()).cast<double>();
    // An unchanged picture is not written, so that its group stays quiescent.
    const auto picture = [&](Out port, const SegmentArray& numbers) {
        SegmentArray& shown = shown_[port - collector];
        const auto bytes = static_cast<std::size_t>(numbers.size()) * sizeof(float);
        if (!frame.is_read(port) || (displayed_ && std::memcmp(shown.data(), numbers.data(), bytes) == 0))
            return;
        show(layer_, numbers, !displayed_, frame.output(port));
        shown = numbers;
    };
    if (frame.is_read(empty) && (!displayed_ || layer_.stored_row() >= 0))
        show_empty(layer_, !displayed_, frame.output(empty));
    picture(collector, layer_.memory().collector());
    picture(distance, layer_.memory().distance());
    picture(selected, layer_.memory().selected());
    picture(trigger, layer_.memory().trigger());
    displayed_ = true;
}

}  // namespace forage::contextual
