// Properties of every input, which crash the fuzzer when they do not hold.
#pragma once

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "core/base/diagnostic.h"

namespace forage::test {

inline void holds(bool condition, const char* what) {
    if (condition) return;
    std::fprintf(stderr, "does not hold: %s\n", what);
    std::abort();
}

/// Every diagnostic has a message that a terminal can show, and a place that exists in the text.
inline void sensible(const Diagnostics& diagnostics, const std::string& text) {
    const auto lines = 1 + std::count(text.begin(), text.end(), '\n');
    for (const auto& d : diagnostics.all()) {
        holds(!d.message.empty(), "a diagnostic says something");
        holds(d.where.line >= 0 && d.where.line <= lines && d.where.column >= 0,
              "a diagnostic lies in its file");
    }
    const std::string said = format(diagnostics);
    holds(said.empty() == diagnostics.all().empty(), "what is wrong is said");
    holds(std::none_of(said.begin(), said.end(), [](char c) { return c != '\n' && c >= 0 && c < ' '; }),
          "no control characters reach the terminal");
}

}  // namespace forage::test
