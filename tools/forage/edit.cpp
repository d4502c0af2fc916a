#include <fmt/format.h>
#include <forage/system.h>
#include <nlohmann/json.hpp>

#include "tools/api/sources.h"
#include "tools/forage/commands.h"

namespace forage::tool {

int edit(const EditOptions& o) try {
    const auto first = o.operations.find_first_not_of(" \t\r\n");
    const bool written_out =
        first != std::string::npos && (o.operations[first] == '[' || o.operations[first] == '{');
    const std::string operations = written_out ? o.operations : read_input_file(o.operations);
    const auto made = nlohmann::json::parse(edit_file(o.file, operations, o.output, o.plugins));
    for (const auto& ids : made)
        if (!ids.is_null()) fmt::print("{}\n", ids.is_string() ? ids.get<std::string>() : ids.dump());
    return fine;
} catch (const InputError& e) {
    fmt::print(stderr, "{}", e.what());
    return bad_input;
}

}  // namespace forage::tool
