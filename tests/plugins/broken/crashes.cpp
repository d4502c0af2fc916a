#include <csignal>

#include <forage/plugin.h>

using namespace forage;

struct Crashes {
    struct Cell {
        double act = 0;
    };
    static void describe(NeuronSpec<Crashes>& s) {
        s.name("neuronCrashes", "Crashes").output("act", &Cell::act, "Activity");
    }
    void update(Cell&, const Input&) const { std::raise(SIGSEGV); }
};
FORAGE_PLUGIN(Crashes);
