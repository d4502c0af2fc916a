#include <cstdio>

#include "core/base/print.h"
#include "tools/api/describe/system_description.h"
#include "tools/forage/commands.h"

namespace forage::tool {

int describe(const DescribeOptions& options) {
    Diagnostics diagnostics;
    const auto loaded = load(options.input, diagnostics);
    const auto compiled = compile(loaded, options.input.seed, diagnostics);
    print(stderr, "{}", format(diagnostics));
    if (!compiled) return bad_input;
    print("{}", in_format(forage::describe(loaded->system, loaded->registry, &*compiled), options.format));
    return fine;
}

}  // namespace forage::tool
