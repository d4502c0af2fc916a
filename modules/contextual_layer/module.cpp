#include "modules/contextual_layer/module.h"

#include <cstring>

#include <fmt/format.h>

#include "modules/contextual_layer/display.h"

namespace forage::contextual {
namespace {

enum In : std::size_t { action_in, prototype, stats, discrepancy_in };
enum Out : std::size_t { action_out, empty, collector, distance, selected, trigger };

}  // namespace

void ContextualLayerModule::describe(ModuleSpec<ContextualLayerModule>& s) {
    using T = ContextualLayerModule;
    s.name("moduleCL", "Contextual Layer")
        .doc(
            "Remembers the sequences of prototypes and actions that led to a goal, and repeats the actions "
            "when "
            "the prototypes recur.");
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
        .label("%-WTA")
        .range(0, 1)
        .doc(
            "A segment is selected only if its collector is at least this fraction (0 to 1) of the largest "
            "one.");
    s.param("Trigger Reset", &T::reset)
        .label("Trigger Reset")
        .range(0, 2)
        .doc("Trigger of the segment that follows a selected one; values above 1 favour it.");
    s.param("Trigger Decay", &T::decay)
        .label("Trigger Decay")
        .range(0, 2)
        .doc("Fraction of the difference to 1 by which a trigger decays in a cycle.");
    s.param("Discrepancy Threshold", &T::discrepancy)
        .label("Discrepancy Threshold")
        .range(0, 2)
        .doc("The layer opens, permanently, when the discrepancy is between 1e-6 and this value.");
    s.input("action", "Action");
    s.input("prototype", "Prototype");
    s.input("stats", "Stats");
    s.input("discrepancy", "Discrepancy");
    s.output("action", "Action");
    s.output("empty", "Empty").optional();
    s.output("collector", "Collector").optional();
    s.output("distance", "Distance").optional();
    s.output("selected", "Selected").optional();
    s.output("trigger", "Trigger").optional();
}

void ContextualLayerModule::check(const ModulePorts& ports, Diagnostics& diagnostics) const {
    const auto report = [&](const ModulePorts::Group& group, std::string message, std::string hint) {
        diagnostics.error(at_port(group.port), std::move(message), std::move(hint));
    };
    bool sized = true;
    for (const auto& [name, value] : {std::pair{"Memory Height", height}, std::pair{"Memory Width", width}})
        if (!(value >= 1 && value < 1e6)) {
            diagnostics.error(at_parameter(name),
                              fmt::format("'{}' is {}, which is not a possible size of the memory", name, value),
                              "use 1 to 1000");
            sized = false;
        }
    if (sized) {
        const auto rows = static_cast<std::int64_t>(height), columns = static_cast<std::int64_t>(width);
        for (std::size_t i = empty; i <= trigger; ++i) {
            const auto& group = ports.outputs[i];
            const std::int64_t cells = group.shape.cells;
            if (cells == 0 || cells == rows * columns || (cells > rows * columns && i != collector)) continue;
            report(group,
                   fmt::format("'{}' shows a memory of {} x {} segments, but '{}' has {} cells", group.port,
                               columns, rows, group.path, cells),
                   fmt::format("make the group {} x {}, or change 'Memory Width' and 'Memory Height'",
                               columns, rows));
        }
    }
    const auto& source = ports.inputs[action_in];
    const auto& target = ports.outputs[action_out];
    if (target.shape.cells > source.shape.cells)
        report(target,
               fmt::format("output 'action' receives the {} cells of input 'action' ({}), but '{}' has {}",
                           source.shape.cells, source.path, target.path, target.shape.cells),
               "give both groups the same size");
    if (const auto& goals = ports.inputs[stats]; goals.shape.cells < 2)
        report(goals,
               fmt::format("'stats' needs 2 cells, for the positive and the negative goal; '{}' has {}",
                           goals.path, goals.shape.cells),
               "make the group 2 x 1");
}

void ContextualLayerModule::start(const ModulePorts& ports) {
    layer_ = ContextualLayer(static_cast<Index>(height), static_cast<Index>(width),
                             ports.inputs[prototype].shape.cells, ports.inputs[action_in].shape.cells);
    displayed_ = false;
    for (auto& numbers : shown_) numbers = layer_.memory().distance();
}

void ContextualLayerModule::update(ModuleFrame& frame) {
    const auto& goals = frame.input(stats);
    const bool exact = frame.is_read(distance) || frame.is_read(collector);
    if (!layer_.update({frame.input(action_in), frame.input(prototype), goals[0], goals[1],
                        frame.input(discrepancy_in)[0]},
                       {threshold, share, reset, decay, discrepancy},
                       exact ? ContextualLayer::Exact::all : ContextualLayer::Exact::selectable))
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
