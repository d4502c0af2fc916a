// Runs one module alone: arrays stand for groups, and the test stands for the engine.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/types/module.h"
#include "tests/support/catch.h"

namespace forage::test {

class ModuleBench {
  public:
    explicit ModuleBench(ModuleType type) : type_(std::move(type)), module_(type_.make()) {
        ports_.process = "P";
    }
    ModuleBench(const ModuleBench&) = delete;
    ModuleBench& operator=(const ModuleBench&) = delete;

    /// Binds a group of width x height cells to a port; `cells` is smaller for a sparse group, and 0 for an
    /// unset port.
    ModuleBench& bind(const std::string& port, bool is_output, int width, int height, int cells = -1) {
        for (const auto& p : type_.ports)
            if (p.name == port && p.is_output == is_output) {
                auto& all = is_output ? ports_.outputs : ports_.inputs;
                const GroupShape shape{width, height, cells < 0 ? width * height : cells};
                all.push_back({port, shape.cells > 0 ? "P/" + port : "", shape});
                return *this;
            }
        throw std::runtime_error("no port " + port);
    }
    ModuleBench& in(const std::string& port, int width, int height) {
        return bind(port, false, width, height);
    }
    ModuleBench& out(const std::string& port, int width, int height) {
        return bind(port, true, width, height);
    }
    ModuleBench& seed(std::uint64_t seed) { return ports_.random = RandomStream(seed, "module"), *this; }

    ModuleBench& set(const std::string& name, const std::string& value) {
        for (const auto& p : type_.parameters)
            if (p.name == name) {
                const auto parsed = parse_parameter(p.kind, value);
                if (!parsed) throw std::runtime_error(name + " = " + value);
                p.set(module_->parameters(), *parsed);
                return *this;
            }
        throw std::runtime_error("no parameter " + name);
    }

    std::vector<Diagnostic> problems() {
        Diagnostics diagnostics;
        check_sizes(type_, ports_, module_->parameters(), diagnostics);
        if (!diagnostics.failed()) module_->check(ports_, diagnostics);
        return diagnostics.all();
    }
    /// Starts the module with outputs of 0, as in a run. The groups must have been bound before, in order of
    /// declaration.
    void start() {
        inputs.clear(), outputs.clear();
        for (const auto& g : ports_.inputs) inputs.emplace_back(Eigen::ArrayXd::Zero(g.shape.cells));
        for (const auto& g : ports_.outputs) outputs.emplace_back(Eigen::ArrayXd::Zero(g.shape.cells));
        see_arrays();
        ModuleFrame frame(0, in_, out_);
        module_->start(ports_, frame);
    }
    void update() {
        see_arrays();
        ModuleFrame frame(cycle_++, in_, out_);
        module_->update(frame);
    }
    /// The module itself; T is its struct.
    template <class T>
    T& module() {
        return *static_cast<T*>(module_->parameters());
    }
    const ModulePorts& ports() const { return ports_; }

    std::vector<Eigen::ArrayXd> inputs, outputs;  ///< in order of binding

  private:
    /// An assigned array may have moved.
    void see_arrays() {
        in_.clear(), out_.clear();
        for (auto& a : inputs) in_.emplace_back(a.data(), a.size());
        for (auto& a : outputs) out_.emplace_back(a.data(), a.size());
    }

    ModuleType type_;
    std::unique_ptr<ModuleInstance> module_;
    ModulePorts ports_;
    std::vector<ConstColumn> in_;
    std::vector<Column> out_;
    std::uint64_t cycle_ = 0;
};

/// The message, the hint and the place of the only problem of a module.
inline std::string only_problem(ModuleBench& b) {
    const auto all = b.problems();
    REQUIRE(all.size() == 1);
    return all[0].message + " | " + all[0].hint + " | " + all[0].port + all[0].parameter;
}

}  // namespace forage::test
