// A cell with a number that is not declared as a state.
#include <forage/plugin.h>

struct UndeclaredState {
    struct Cell {
        double vm = 0, act = 0;
    };

    static void describe(forage::NeuronSpec<UndeclaredState>& s) {
        s.name("neuronUndeclaredState", "UndeclaredState").doc("Broken on purpose.");
        s.reads(forage::InputKind::excitatory).output("act", &Cell::act, "Activity");
    }
    void update(Cell& c, const forage::Input& in) const { c.act = c.vm = in.excitation; }
};

FORAGE_PLUGIN(UndeclaredState);
