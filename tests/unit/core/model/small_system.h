// A process with two groups and a connection, for the tests of edits.
#pragma once

#include <string>
#include <vector>

#include "core/model/build.h"
#include "core/model/operations.h"
#include "neurons/neurons.h"
#include "synapses/synapses.h"

namespace forage::model {

struct Small {
    System system;
    Registry registry;
    std::string p = add_process(system, "P", "p"),
                a = add_group(system, p, "A", 3, 1, "neuronLinearThreshold", "a"),
                b = add_group(system, p, "B", 3, 1, "neuronLinearThreshold", "b"),
                c = add_connection(system, a, b, InputKind::excitatory, "synapseFixedWeight", "c");
    Small() {
        add_neurons(registry), add_synapses(registry);
        place(system, a, 10, 20), place(system, b, 110, 20);
        set_line(system, c, {3, 12, std::vector<Point>{{60, 40, {}}}});
    }
};

}  // namespace forage::model
