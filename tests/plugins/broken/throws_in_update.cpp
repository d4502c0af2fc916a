// Throws in the 7th cycle.
#include <stdexcept>

#include <forage/plugin.h>

struct ThrowingUpdate {
    double gain = 1;

    struct Cell {
        double act = 0;
    };

    static void describe(forage::NeuronSpec<ThrowingUpdate>& s) {
        s.name("neuronThrowingUpdate", "ThrowingUpdate")
            .doc("Broken on purpose.")
            .reads(forage::InputKind::excitatory);
        s.param("gain", &ThrowingUpdate::gain).doc("Factor.");
        s.output("act", &Cell::act, "Activity");
    }
    void update(Cell& c, const forage::Input&) const {
        if (c.act == 7) throw std::runtime_error("out of range");
        c.act += 1;
    }
};

FORAGE_PLUGIN(ThrowingUpdate);
