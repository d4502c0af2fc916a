// The header for plugins: the SDK for neuron, synapse and module types. docs/how-to/write-a-neuron.md
// explains it.
#pragma once

#include "core/types/plugin.h"
