// A module that writes to an output that it does not declare.
#include <forage/plugin.h>

struct Loud {
    static void describe(forage::ModuleSpec<Loud>& s) {
        s.name("moduleLoud", "Loud").doc("Broken on purpose.");
        s.output("out", "Output").optional();
    }
    void update(forage::ModuleFrame& f) { f.output(1)[0] = 1; }
};

FORAGE_PLUGIN(Loud);
