// Says that it was built with another version of the SDK.
#include <forage/plugin.h>

extern "C" __attribute__((visibility("default"))) const forage::PluginHeader forage_plugin;
const forage::PluginHeader forage_plugin = {forage::sdk_version + 1, "of the future", 0, nullptr, 0};
