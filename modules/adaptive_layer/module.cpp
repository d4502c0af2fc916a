#include "modules/adaptive_layer/module.h"

#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "core/base/text_file.h"
#include "modules/adaptive_layer/weights_file.h"

namespace forage::adaptive {
namespace {

enum In : std::size_t { input, condition };
enum Out : std::size_t { prototype, output, discrepancy, display };

bool is_rectangle(const GroupShape& s) { return s.cells == s.width * s.height; }

std::string size(const GroupShape& s) { return fmt::format("{} x {}", s.width, s.height); }

void require(const ModulePorts::Group& group, int width, int height, const std::string& why,
             Diagnostics& diagnostics) {
    if (group.shape == GroupShape{width, height, width * height}) return;
    diagnostics.error(
        at_port(group.port),
        fmt::format("'{}' needs {} x {} cells, {}; '{}' has {}", group.port, width, height, why, group.path,
                    is_rectangle(group.shape) ? size(group.shape) : "another number"),
        fmt::format("make the group {} x {}", width, height));
}

}  // namespace

void AdaptiveLayerModule::describe(ModuleSpec<AdaptiveLayerModule>& s) {
    using T = AdaptiveLayerModule;
    s.name("moduleAL", "Adaptive Layer")
        .doc(
            "Learns the conditioned response (CR) to stimuli (CS) that occur together with an unconditioned "
            "response (UR).");
    s.param("eta", &T::eta)
        .label("learning rate (eta)")
        .range(0, 10)
        .doc("Learning rate; with 0 the weights are constant.");
    s.param("zeta", &T::zeta)
        .label("balance (zeta)")
        .range(-1, 1)
        .doc(
            "Balance of learning: -1 learns only from the stimuli, 1 only from the unconditioned responses.");
    s.param("rho", &T::rho)
        .label("correction (rho)")
        .range(0, 100)
        .doc("Gain of the error between the unconditioned and the conditioned response.");
    s.param("init", &T::init)
        .label("init value weights")
        .range(0, 1)
        .at_start()
        .doc("The initial weights are uniformly distributed between plus and minus this value.");
    s.param("discTime", &T::disc_time)
        .label("discrepancy time constant")
        .range(0, 1)
        .doc("Weight of the newest sample in the running average of the discrepancy.");
    s.param("File Name", &T::file_name).label("File name").path().doc("Path of the file with the weights.");
    s.param("write", &T::write)
        .label("Write Weight File")
        .doc("Writes the weights to the file at the end of the next update.");
    s.param("read", &T::read)
        .label("Read Weight File")
        .doc("Reads the weights from the file at the end of the next update.");
    s.input("input", "Input");
    s.input("condition", "Condition");
    s.output("prototype", "Prototype");
    s.output("output", "Output");
    s.output("descripancy", "Descripancy");
    s.output("weight display", "Weight Display").optional();
}

void AdaptiveLayerModule::check(const ModulePorts& ports, Diagnostics& diagnostics) const {
    const auto& cs = ports.inputs[input];
    const auto& ur = ports.inputs[condition];
    for (const auto* group : {&cs, &ur})
        if (!is_rectangle(group->shape))
            diagnostics.error(
                at_port(group->port),
                fmt::format("'{}' needs a rectangular group; '{}' is sparse", group->port, group->path),
                "give the group a TopologyRect");
    if (diagnostics.failed()) return;
    require(ports.outputs[prototype], cs.shape.width, cs.shape.height,
            fmt::format("the size of '{}' ({})", cs.port, cs.path), diagnostics);
    const auto& picture = ports.outputs[display];
    if (picture.shape.cells > 0)
        require(picture, ur.shape.cells * cs.shape.width, cs.shape.height,
                fmt::format("one {} picture of '{}' for each of the {} cells of '{}', side by side",
                            size(cs.shape), cs.port, ur.shape.cells, ur.port),
                diagnostics);
    require(ports.outputs[output], ur.shape.width, ur.shape.height,
            fmt::format("the size of '{}' ({})", ur.port, ur.path), diagnostics);
    if ((read || write) && file_name.empty())
        diagnostics.error(at_parameter("File Name"),
                          fmt::format("'{}' is set, but 'File Name' is empty", read ? "read" : "write"),
                          "set it to the path of the file with the weights");
    else if (read) {
        try {
            read_weights(file_name, cs.shape.cells, ur.shape.cells);
        } catch (const FileError& e) {
            auto errors = e.errors();
            for (auto& error : errors)
                if (error.hint.empty())
                    error.hint = "the weights are read in the first cycle, because 'read' is set";
            throw FileError(e.file(), std::move(errors));
        }
    }
}

void AdaptiveLayerModule::start(const ModulePorts& ports) {
    const auto stimuli = ports.inputs[input].shape.cells, responses = ports.inputs[condition].shape.cells;
    width_ = ports.inputs[input].shape.width;
    std::vector<double> uniform(static_cast<std::size_t>(stimuli) * static_cast<std::size_t>(responses));
    ports.random.uniform(0, uniform);
    layer_ = AdaptiveLayer(stimuli, responses);
    layer_.start(uniform, init);
    display_outdated_ = true;
}

void AdaptiveLayerModule::update(ModuleFrame& frame) {
    display_outdated_ |=
        layer_.update(frame.input(input), frame.input(condition), {eta, zeta, rho, disc_time});
    if (frame.is_read(prototype)) frame.output(prototype) = layer_.prototype();
    frame.output(output) = layer_.response();
    frame.output(discrepancy)[0] = layer_.discrepancy();
    if (display_outdated_ && frame.is_read(display)) {
        show_weights(frame.output(display));
        display_outdated_ = false;
    }
    // Weights from a file take effect, and are displayed, from the next cycle on.
    if (read) {
        read = false;
        layer_.set_weights(read_weights(file_name, layer_.weights().rows(), layer_.weights().cols()));
        display_outdated_ = true;
    }
    if (write) {
        write = false;
        write_weights(file_name, layer_.weights());
    }
}

/// Writes W(q w + c, k) to the cell in column k w + c and row q.
void AdaptiveLayerModule::show_weights(Column cells) const {
    const auto& w = layer_.weights();
    const Index rows = w.rows() / width_, row_size = w.cols() * width_;
    for (Index k = 0; k < w.cols(); ++k) {
        const double* from = w.col(k).data();
        double* to = cells.data() + k * width_;
        for (Index q = 0; q < rows; ++q, from += width_, to += row_size)
            for (Index c = 0; c < width_; ++c) to[c] = from[c];
    }
}

}  // namespace forage::adaptive
