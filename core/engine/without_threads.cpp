// Takes the place of core/engine/parallel in a build without threads.
#include "core/engine/executor.h"
#include "core/engine/simulation.h"

namespace forage::engine {

bool has_threads() { return false; }

std::unique_ptr<Executor> make_executor(const Plan&, Cycle&, int, double, double) { return nullptr; }

}  // namespace forage::engine
