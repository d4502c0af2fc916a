// A test in a process of its own.
#pragma once

#include <functional>
#include <string>

namespace forage::plugin {

/// Runs `test`, which updates objects of a plugin, in a child process. Returns its result, or in words that
/// the update has crashed or did not return within 10 s: "its update() does not return". Nothing that the
/// test changes, prints to stdout or destroys is seen in this process. Where no process can be started, the
/// test runs in this one.
std::string in_child(const std::function<std::string()>& test);

}  // namespace forage::plugin
