// moduleEcho of the recorded cases: writes each input group's activity into the output of the same place.
#pragma once

#include "core/types/module.h"

namespace forage::test {

struct Echo {
    static void describe(ModuleSpec<Echo>& s) { s.name("moduleEcho", "Echo").any_ports(); }
    void update(ModuleFrame& frame) {
        for (std::size_t i = 0; i < frame.outputs(); ++i)
            if (i < frame.inputs() && frame.input(i).size() == frame.output_size(i))
                frame.output(i) = frame.input(i);
    }
};

}  // namespace forage::test
