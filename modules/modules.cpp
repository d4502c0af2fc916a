#include "modules/modules.h"

#include "modules/adaptive_layer/module.h"
#include "modules/allostasis/module.h"
#include "modules/allostasis/walk_module.h"
#include "modules/colour/module.h"
#include "modules/contextual_layer/module.h"
#include "modules/difference/difference.h"
#include "modules/direction/direction.h"
#include "modules/explore/explore.h"
#include "modules/q_learner/q_learner.h"
#include "modules/sequential_episodic_control/module.h"

namespace forage {

void add_modules(Registry& registry) {
    registry.add(module_type<adaptive::AdaptiveLayerModule>());
    registry.add(module_type<allostasis::AllostasisModule>());
    registry.add(module_type<allostasis::WalkModule>());
    registry.add(module_type<colour::ColourModule>());
    registry.add(module_type<contextual::ContextualLayerModule>());
    registry.add(module_type<goal::DifferenceModule>());
    registry.add(module_type<goal::DirectionModule>());
    registry.add(module_type<explore::ExploreModule>());
    registry.add(module_type<q_learner::QLearnerModule>());
    registry.add(module_type<sec::SequentialControlModule>());
}

}  // namespace forage
