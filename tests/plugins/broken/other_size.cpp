// Writes a column of another size.
#include <forage/plugin.h>

struct OtherSize {
    double gain = 1;

    static void describe(forage::NeuronSpec<OtherSize>& s) {
        s.name("neuronOtherSize", "OtherSize").doc("Broken on purpose.").reads(forage::InputKind::excitatory);
        s.param("gain", &OtherSize::gain).doc("Factor.");
        s.output("act", "Activity");
    }
    void update(forage::NeuronColumns& c) const { c.state(0) = Eigen::ArrayXd::Zero(c.size() + 3); }
};

FORAGE_PLUGIN(OtherSize);
