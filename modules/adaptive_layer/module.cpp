#include "modules/adaptive_layer/module.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "core/base/text_file.h"
#include "modules/adaptive_layer/weights_file.h"

namespace forage::adaptive {
namespace {

enum In : std::size_t { input, condition };
enum Out : std::size_t { prototype, output, discrepancy, display };

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
    s.input("input", "Input").full_rectangle().doc("The conditioned stimuli (CS).");
    s.input("condition", "Condition").full_rectangle().doc("The unconditioned response (UR).");
    s.output("prototype", "Prototype")
        .same_size_as("input")
        .doc("The estimate of the stimuli that is computed from the conditioned response.");
    s.output("output", "Output").same_size_as("condition").doc("The conditioned response (CR).");
    s.output("descripancy", "Discrepancy")
        .cells(1)
        .tolerate([](PortSizes&, const GroupShape&) { return true; })
        .doc("The running average of the difference between stimuli and prototype; other cells stay 0.");
    s.output("weight display", "Weight Display")
        .optional()
        .size("one picture of 'input' for each cell of 'condition', side by side",
              [](const auto&, PortSizes& of, const GroupShape&) {
                  const auto cs = of["input"], ur = of["condition"];
                  return rectangle(static_cast<std::int64_t>(ur.cells) * cs.width, cs.height);
              })
        .pictures("input", "output")
        .doc("The k-th picture shows the weights from the stimuli to cell k of the response.");
}

void AdaptiveLayerModule::check(const ModulePorts& ports, Diagnostics& diagnostics) const {
    if ((read || write) && file_name.empty())
        diagnostics.error(at_parameter("File Name"),
                          fmt::format("'{}' is set, but 'File Name' is empty", read ? "read" : "write"),
                          "set it to the path of the file with the weights");
    else if (read) {
        try {
            read_weights(file_name, ports.inputs[input].shape.cells, ports.inputs[condition].shape.cells);
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
