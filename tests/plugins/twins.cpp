// The types that ship with Forage, to compare bits and speed.
#include <forage/plugin.h>

#include "modules/difference/difference.h"
#include "neurons/linear_threshold.h"
#include "neurons/random_spike.h"
#include "synapses/hebbian.h"

FORAGE_PLUGIN(forage::LinearThreshold, forage::RandomSpike, forage::Hebbian, forage::goal::DifferenceModule);
