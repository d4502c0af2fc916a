#include "tools/api/edit/convert.h"

#include <cstdio>

#include <forage/system.h>
#include <unistd.h>

#include "core/base/output_files.h"
#include "core/base/print.h"
#include "tools/forage/commands.h"
#include "tools/forage/options.h"

namespace forage::tool {
namespace {

struct ConvertOptions : Conversion {
    std::string as_plugin;  ///< name of a declared type to write as the source of a plugin; empty: none
    bool lenient = false;
};

int convert(const ConvertOptions& options) {
    Diagnostics diagnostics;
    diagnostics.lenient = options.lenient;
    const bool prints = options.output == standard_output;
    if (!prints) check_output(options.output, "copy.iqr", diagnostics);
    std::string notes;
    std::string text;
    try {
        text = options.as_plugin.empty()
                   ? converted(options, notes, diagnostics)
                   : plugin_source(read_system(options.input, options.plugins), options.as_plugin);
    } catch (const InputError& e) {
        print(stderr, "{}", e.what());
        return bad_input;
    }
    print(stderr, "{}", format(diagnostics));
    if (diagnostics.failed()) return bad_input;
    if (!prints) write_file(options.output, text);
    if (prints && isatty(STDOUT_FILENO))
        print("{}", text);  // print() escapes the control characters that a terminal would act on
    else if (prints)
        std::fputs(text.c_str(), stdout);
    print(prints ? stderr : stdout, "{}", notes);
    return fine;
}

}  // namespace

void add_convert(Program& program) {
    const auto [command, o] =
        program.add("convert", "Read a system or process file and write it in the standard layout", convert,
                    "Example:\n"
                    "  forage convert systems/reactive_foraging.iqr bug.iqrProcess --extract Bug\n"
                    "  forage convert systems/models/oja.iqr oja.cpp --as-plugin oja");
    add_value(command, "IN", o.input, "FILE", "File to read (.iqr or .iqrProcess)")->required();
    add_value(command, "OUT", o.output, "FILE",
              "File to write (.iqr or .iqrProcess; .cpp with --as-plugin); may be the same, or - to print it")
        ->required()
        ->check(named("file"));
    repeated(command.add_option("--import", o.imports,
                                "Add a copy of a process from an .iqrProcess file; may be repeated"))
        ->option_text("FILE");
    add_value(command, "--extract", o.extract, "PROCESS",
              "Write this process alone, with the connections among its groups");
    add_value(command, "--as-plugin", o.as_plugin, "TYPE",
              "Write this type of the system as the source of a plugin that computes the same");
    add_plugins(command, o.plugins);
    command.add_flag("--embed", o.embed, "Write the content of linked processes instead of links");
    auto* terse = command.add_flag(
        "--terse", o.terse,
        "Leave out what is the same in most systems, and write sizes and weights as attributes");
    command.add_flag("--full", o.full, "Write what the file leaves out, and sizes and weights as elements")
        ->excludes(terse);
    command.add_flag("--original", o.original,
                     "Write plain numbers instead of constants and formulas, and what the file leaves out "
                     "and the original iqr requires: patterns, arborizations, "
                     "functions, places in the diagram");
    command.add_flag("--lenient", o.lenient,
                     "Unknown elements and attributes are warnings, and are not written");
}

}  // namespace forage::tool
