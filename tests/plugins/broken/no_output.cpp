// No output.
#include <forage/plugin.h>

struct NoOutput {
    double gain = 1;

    struct Cell {
        double vm = 0;
    };

    static void describe(forage::NeuronSpec<NoOutput>& s) {
        s.name("neuronNoOutput", "NoOutput").doc("Broken on purpose.").reads(forage::InputKind::excitatory);
        s.param("gain", &NoOutput::gain).doc("Factor.");
        s.state("vm", &Cell::vm, "Potential");
    }
    void update(Cell& c, const forage::Input& in) const { c.vm = in.excitation; }
};

FORAGE_PLUGIN(NoOutput);
