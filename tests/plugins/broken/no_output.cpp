// No output.
#include <forage/plugin.h>

struct NoOutput {
    double gain = 1;

    static void describe(forage::NeuronSpec<NoOutput>& s) {
        s.name("neuronNoOutput", "NoOutput").doc("Broken on purpose.").reads(forage::InputKind::excitatory);
        s.param("gain", &NoOutput::gain).doc("Factor.");
        s.state("vm", "Potential");
    }
    void update(forage::NeuronColumns& c) const { c.state(0) = c.excitation(); }
};

FORAGE_PLUGIN(NoOutput);
