// Weights of the synapses of a connection, to read and to set in a run.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "core/connectivity/connect.h"
#include "core/run/run.h"

namespace forage {

/// The number of the connection with this name or id in the layout of a run. Throws InputError.
int find_connection(const Run& run, std::string_view name);
/// Whether `name` is that of a connection, and not that of a group.
bool is_connection(const Run& run, std::string_view name);

/// The weight of each synapse: a row per target cell with a number per source cell, NaN where there is no
/// synapse. It is the state "weight" of the type; where the type multiplies by a constant, it is the number
/// of <Weights>, or 1 less what is attenuated, and the type's own factor comes on top. Where several synapses
/// connect two cells, it is their sum. Throws InputError for a type without weights, and for states that the
/// run does not compute.
std::vector<double> weights(Run& run, int connection);
/// Other weights for a connection, checked.
struct NewWeights {
    int connection = 0;
    int state = -1;  ///< of the type; -1 when it multiplies by a constant
    connectivity::Synapses synapses;
    std::vector<double> values;  ///< one per synapse
};
/// Throws InputError when `values` does not have a finite number for each synapse and NaN elsewhere, for
/// several synapses between two cells, and when nothing that the run computes depends on the connection.
NewWeights check_weights(Run& run, int connection, std::span<const double> values);
/// Sets them from the next delivery on, in this run only.
void set_weights(Run& run, NewWeights&& weights);

}  // namespace forage
