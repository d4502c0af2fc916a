#include <forage/plugin.h>

using namespace forage;

struct FifthRandom {
    static constexpr int random_numbers = 4;
    struct Cell {
        double act = 0;
    };
    static void describe(NeuronSpec<FifthRandom>& s) {
        s.name("neuronFifthRandom", "Fifth random").output("act", &Cell::act, "Activity");
    }
    void update(Cell& cell, const Input& in) const { cell.act = in.random[4]; }
};
FORAGE_PLUGIN(FifthRandom);
