// A type whose update never returns.
#include <chrono>
#include <thread>

#include <forage/plugin.h>

using namespace forage;

struct Endless {
    struct Cell {
        double act = 0;
    };
    static void describe(NeuronSpec<Endless>& s) {
        s.name("neuronEndless", "Endless").output("act", &Cell::act, "Activity");
    }
    void update(Cell&, const Input&) const {
        for (;;)
            std::this_thread::sleep_for(std::chrono::hours(1));  // what runs beside it keeps the processor
    }
};
FORAGE_PLUGIN(Endless);
