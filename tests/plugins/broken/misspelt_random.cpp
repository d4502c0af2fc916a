#include <forage/plugin.h>

using namespace forage;

struct MisspeltRandom {
    static constexpr int randomNumbers = 1;
    struct Cell {
        double act = 0;
    };
    static void describe(NeuronSpec<MisspeltRandom>& s) {
        s.name("neuronMisspeltRandom", "Misspelt random").output("act", &Cell::act, "Activity");
    }
    void update(Cell& cell, const Input& in) const { cell.act = in.random[0] < 0.5; }
};
FORAGE_PLUGIN(MisspeltRandom);
