// describe() throws a value that is not a std::exception.
#include <forage/plugin.h>

struct ThrowingDescribe {
    double gain = 1;

    struct Cell {
        double act = 0;
    };

    static void describe(forage::NeuronSpec<ThrowingDescribe>& s) {
        s.name("neuronThrowingDescribe", "ThrowingDescribe")
            .doc("Broken on purpose.")
            .reads(forage::InputKind::excitatory);
        s.param("gain", &ThrowingDescribe::gain).doc("Factor.");
        s.output("act", &Cell::act, "Activity");
        throw 42;
    }
    void update(Cell& c, const forage::Input& in) const { c.act = in.excitation; }
};

FORAGE_PLUGIN(ThrowingDescribe);
