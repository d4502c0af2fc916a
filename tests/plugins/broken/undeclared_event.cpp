#include <forage/plugin.h>

using namespace forage;

struct UndeclaredEvent {
    double probability = 0.5;
    struct Cell {
        double act = 0;
    };
    static void describe(NeuronSpec<UndeclaredEvent>& s) {
        s.name("neuronUndeclaredEvent", "Undeclared event").output("act", &Cell::act, "Activity");
        s.param("probability", &UndeclaredEvent::probability).range(0, 1);
    }
    double eventProbability() const { return probability; }
    void update(Cell& cell, const Input& in) const { cell.act = in.event; }
};
FORAGE_PLUGIN(UndeclaredEvent);
