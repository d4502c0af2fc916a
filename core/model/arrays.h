// Arrays in a model: weights of connections, and the values with which states begin.
#pragma once

#include <cstddef>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/base/diagnostic.h"
#include "core/base/random.h"
#include "core/model/constants.h"
#include "core/model/system.h"
#include "core/types/registry.h"

namespace forage::model {

/// Calls f(weights) and f(initial) for everything that may have a file of numbers.
template <class F>
void each_array(auto&& processes, auto&& connections, F f) {
    for (auto& p : processes)
        for (auto& g : p.groups)
            for (auto& i : g.neuron.initial) f(i);
    for (auto& c : connections) {
        if (auto* weights = std::get_if<Weights>(&c.pattern)) f(*weights);
        if (c.synapse)
            for (auto& i : c.synapse->initial) f(i);
    }
}

/// Reads the files and texts of all arrays that are not read yet, each file once. What is wrong with them is
/// in Array::faults(), which validate() reports.
void load_arrays(System& system);
/// The paths of all files of arrays.
std::set<std::string> array_files(const System& system);

/// Reports what is wrong with arrays, and with each file once.
class ArrayCheck {
  public:
    ArrayCheck(Constants& constants, Diagnostics& out) : constants_(constants), out_(out) {}

    /// The weights of a connection between groups of so many cells. `type` is that of its synapses, null when
    /// it is not known.
    void weights(const Connection& connection, const SynapseType* type, int sources, int targets);
    /// The values with which the states of a use of a type begin. A file has `rows` x `columns` numbers:
    /// cells x 1, or target cells x source cells.
    void initial(const TypeUse& use, const std::vector<std::string>& states,
                 const std::vector<std::string>& parameters, const Process* scope, std::size_t rows,
                 std::size_t columns);

  private:
    bool is_sound(const std::string& file, const Location& file_at, const ArrayHandle& array);
    void shape(const Array& array, const Location& at, std::size_t rows, std::size_t columns);
    void list(const Array& array, int sources, int targets);
    void value(const Initial& initial, const Process* scope);

    Constants& constants_;
    Diagnostics& out_;
    std::set<const Array*> reported_;
};

/// The values with which a state begins. `index` has the place in the file of each value: target * sources +
/// source, for synapses; when it is empty, all values follow each other. Random ones are of `stream`. The
/// system has been validated.
std::vector<double> initial_values(const Initial& initial, Constants& constants, const Process* scope,
                                   const RandomStream& stream, std::size_t count,
                                   std::span<const std::size_t> index = {});

/// Whether these values are random.
bool is_drawn(const Initial& initial, Constants& constants, const Process* scope);

/// Writes out the formulas of an initial value as the numbers that they have.
void write_out(Initial& initial, Constants& constants, const Process* scope);

/// Reports the arrays of a system, which plain iqr cannot say.
void refuse_extensions(const System& system, Diagnostics& diagnostics);

}  // namespace forage::model
