#include <forage/plugin.h>

using namespace forage;

// One number is declared, two are used.
struct UndeclaredRandom {
    double noise = 0;
    static constexpr int random_numbers = 1;
    struct Cell {
        double act = 0;
    };
    static void describe(NeuronSpec<UndeclaredRandom>& s) {
        s.name("neuronUndeclaredRandom", "Undeclared random")
            .reads(InputKind::excitatory)
            .output("act", &Cell::act, "Activity");
        s.param("noise", &UndeclaredRandom::noise).range(0, 1);  // without noise by default
    }
    void update(Cell& cell, const Input& in) const {
        cell.act = in.excitation + noise * normal(in.random[0], in.random[1]);
    }
};
FORAGE_PLUGIN(UndeclaredRandom);
