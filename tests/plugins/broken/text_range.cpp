#include <forage/plugin.h>

using namespace forage;

struct TextRange {
    std::string mode = "fast";
    struct Cell {
        double act = 0;
    };
    static void describe(NeuronSpec<TextRange>& s) {
        s.name("neuronTextRange", "Text range").output("act", &Cell::act, "Activity");
        s.param("mode", &TextRange::mode).range(0, 1);
    }
    void update(Cell&, const Input&) const {}
};
FORAGE_PLUGIN(TextRange);
