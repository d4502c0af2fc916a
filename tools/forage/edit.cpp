#include <forage/system.h>

#include "core/base/print.h"
#include "tools/api/edit/json_text.h"
#include "tools/api/open/sources.h"
#include "tools/forage/commands.h"

namespace forage::tool {

int edit(const EditOptions& o) try {
    const auto first = o.operations.find_first_not_of(" \t\r\n");
    const bool is_json =
        first != std::string::npos && (o.operations[first] == '[' || o.operations[first] == '{');
    const auto operations = is_json ? o.operations : read_input_file(o.operations);
    if (!is_json) check_json(operations, o.operations);  // mistakes are in this file
    Diagnostics diagnostics;
    const auto made = edit_file(o.file, operations, o.output, o.plugins, &diagnostics);
    print(stderr, "{}", format(diagnostics));
    for (const auto& ids : elements_of(made)) print("{}\n", ids);
    return fine;
} catch (const InputError& e) {
    print(stderr, "{}", e.what());
    return bad_input;
}

}  // namespace forage::tool
