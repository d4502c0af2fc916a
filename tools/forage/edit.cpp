#include <forage/system.h>

#include "core/base/print.h"
#include "tools/api/edit/json_text.h"
#include "tools/api/open/sources.h"
#include "tools/forage/commands.h"
#include "tools/forage/options.h"

namespace forage::tool {
namespace {

struct EditOptions {
    std::string file;        ///< .iqr or .world
    std::string operations;  ///< JSON, or the name of a file with it
    std::string output;      ///< empty: the file itself
    std::vector<std::string> plugins;
};

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

}  // namespace

void add_edit(Program& program) {
    const auto [command, o] = program.add(
        "edit", "Edit a system or a world as the studio does; everything else in the file stays as it is",
        edit,
        "Example:\n"
        "  forage edit mine.iqr '{\"do\": \"parameter\", \"id\": \"light\", \"name\": \"threshold\", "
        "\"value\": 0.3}'\n"
        "docs/design/studio-protocol.md lists all operations, and the studio shows edits in this form.");
    add_value(command, "FILE", o.file, " ", "System or world (.iqr or .world)")->required();
    add_value(command, "OPERATIONS", o.operations, " ",
              "JSON: an operation or a list of them, or the name of a file with it")
        ->required();
    add_value(command, "-o,--output", o.output, "FILE", "File to write [FILE]")->check(named("file"));
    add_plugins(command, o.plugins);
}

}  // namespace forage::tool
