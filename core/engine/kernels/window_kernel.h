// A window of synapses round every cell, the same everywhere: no weights are moved but the window's own.
#pragma once

#include "core/connectivity/regular.h"
#include "core/engine/kernels/kernel.h"
#include "core/engine/kernels/window_columns.h"

namespace forage::engine {

/// Sums the window's taps for many target cells at a time, each cell in synapse order. The source is copied
/// into a frame of zeros, once per delay, so that a window may reach out of the group: what it finds there
/// adds nothing.
class WindowKernel final : public Kernel {
  public:
    WindowKernel(const connectivity::Regular& regular, const SynapseInstance& synapse);
    void deliver(const History& source, double* target) override;
    std::string_view form() const override { return "window"; }
    double cost() const override {
        return 0.07 * static_cast<double>(taps_.size()) * static_cast<double>(width_ * height_);
    }
    bool divides() const override { return true; }
    void prepare(const History& source, int part, int parts) override;
    void add(const History& source, double* target, int part, int parts) override;

    struct Tap {
        const double* source;  ///< what target cell 0 reads
        double factor;
    };

  private:
    void find_columns();

    const SynapseInstance& synapse_;
    Index width_, height_, left_, top_, stride_;
    std::vector<int> delays_;                  ///< those that occur
    std::vector<std::vector<double>> framed_;  ///< by delay: gain times activity in a frame
    std::vector<Tap> taps_;
    std::vector<TapColumn> columns_;  ///< the same taps; empty when few of them follow each other downwards
    std::vector<double> factors_;     ///< of the taps
    bool same_factor_ = false;        ///< `framed_` holds the products with it
};

}  // namespace forage::engine
