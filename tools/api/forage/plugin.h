// What a plugin includes: the SDK for neuron, synapse and module types. docs/how-to/write-a-neuron.md.
#pragma once

#include "core/types/plugin.h"
