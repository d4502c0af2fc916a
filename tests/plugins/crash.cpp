// A module that crashes in cycle 3.
#include <forage/plugin.h>

using namespace forage;

struct Falls {
    static void describe(ModuleSpec<Falls>& s) { s.name("moduleFalls", "Falls").input("in", "Any group"); }
    void update(ModuleFrame& f) {
        volatile int* volatile nowhere = nullptr;
        if (f.cycle() == 3) *nowhere = 1;
    }
};
FORAGE_PLUGIN(Falls);
