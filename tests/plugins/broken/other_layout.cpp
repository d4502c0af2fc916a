// Says that its objects have other sizes.
#include <forage/plugin.h>

extern "C" __attribute__((visibility("default"))) const forage::PluginHeader forage_plugin;
const forage::PluginHeader forage_plugin = {forage::sdk_version, forage::detail::abi, 1, nullptr, 1};
