#include <cctype>
#include <filesystem>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/output_files.h"
#include "core/base/print.h"
#include "tools/forage/commands.h"
#include "tools/forage/options.h"
#include "tools/forage/templates.h"

namespace forage::tool {
namespace {

struct NewOptions {
    std::string kind;    ///< system, neuron, synapse or module
    std::string name;    ///< empty: my_system
    bool robot = false;  ///< whether the system has a robot, and a world for it
};

/// "my_neuron" and "my-neuron" -> "MyNeuron".
std::string class_name(const std::string& name) {
    std::string out;
    bool begins = true;
    for (const char c : name) {
        if (c == '_' || c == '-') {
            begins = true;
            continue;
        }
        const auto letter = static_cast<unsigned char>(c);
        out += begins ? static_cast<char>(std::toupper(letter)) : c;
        begins = false;
    }
    return out;
}

/// Checks a name, which becomes the name of a C++ type, a CMake target and files.
bool usable(const std::string& name) {
    for (const char c : name)
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_' && c != '-') return false;
    return !name.empty() && std::isalpha(static_cast<unsigned char>(name.front()));
}

std::string filled(std::string text, const std::string& name, const std::string& kind) {
    const std::pair<std::string, std::string> values[] = {
        {"@NAME@", name}, {"@CLASS@", class_name(name)}, {"@TYPE@", kind + class_name(name)}};
    for (const auto& [what, value] : values)
        for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += value.size())
            text.replace(at, what.size(), value);
    return text;
}

/// Writes files, given by name and text, unless one of them exists.
int write_new(const std::vector<std::pair<std::string, std::string>>& files) {
    for (const auto& [file, text] : files)
        if (std::filesystem::exists(file))
            return refused(fmt::format("there is already a '{}' here", file), "take another name or folder");
    for (const auto& [file, text] : files) write_file(file, text);
    return fine;
}

/// Writes NAME.iqr; with a robot, NAME.world, too.
int new_system(const std::string& name, bool robot) {
    if (!usable(name))
        return refused(fmt::format("'{}' cannot be the name of a system", name),
                       "take a letter, then letters, digits, '_' and '-'");
    const auto text = [&](const char* source) { return filled(template_text(source), name, ""); };
    const int status =
        robot ? write_new({{name + ".iqr", text("robot.iqr")}, {name + ".world", text("robot.world")}})
              : write_new({{name + ".iqr", text("system.iqr")}});
    if (status != fine) return status;
    if (robot)
        print(
            "{0}.iqr: a robot that avoids walls and finds a light, in {0}.world. Next:\n"
            "  forage run {0}.iqr --world {0}.world --seconds 60\n",
            name);
    else
        print(
            "{0}.iqr: two groups and two connections. Next:\n"
            "  forage run {0}.iqr --seconds 4 --plot time:Brain/Cells\n",
            name);
    return fine;
}

/// Writes the project of a plugin into the folder `name`.
int new_project(const std::string& kind, const std::string& name) {
    if (!usable(name))
        return refused(fmt::format("'{}' cannot be the name of a type", name),
                       "take a letter, then letters, digits, '_' and '-'");
    if (std::filesystem::exists(name))
        return refused(fmt::format("there is already a '{}' here", name), "take another name or folder");
    make_directory(name);
    const std::pair<std::string, std::string> files[] = {
        {name + ".cpp", kind + ".cpp"}, {"CMakeLists.txt", "CMakeLists.txt"},
        {"example.iqr", kind + ".iqr"}, {"expected.csv", kind + ".csv"},
        {"test.cmake", "test.cmake"},   {name + "_test.cpp", kind + "_test.cpp"},
        {"README.md", "README.md"}};
    for (const auto& [file, source] : files)
        write_file(name + "/" + file, filled(template_text(source), name, kind));
    print(
        "{}: a plugin with the {} type {}{}. Next:\n"
        "  cd {}\n  cmake -B build && cmake --build build && ctest --test-dir build --output-on-failure\n"
        "  forage run example.iqr --plugin build/plugins --cycles 20 --record Example/Cells --plot "
        "time:Example/Cells\n",
        name, kind, kind, class_name(name), name);
    return fine;
}

int create(const NewOptions& o) {
    if (o.kind == "system") return new_system(o.name.empty() ? "my_system" : o.name, o.robot);
    if (o.robot) return refused("--robot is for systems", "forage new system NAME --robot");
    if (o.name.empty())
        return refused(fmt::format("which name has the {} type?", o.kind),
                       fmt::format("forage new {} NAME", o.kind));
    return new_project(o.kind, o.name);
}

}  // namespace

void add_new(Program& program) {
    const auto [command, o] =
        program.add("new", "Write the beginning of a system, or a small project with a type of your own",
                    create, "Example:\n  forage new system mine --robot\n  forage new neuron adaptive");
    add_value(command, "KIND", o.kind, " ", "system, neuron, synapse or module")
        ->required()
        ->check(one_of({"system", "neuron", "synapse", "module"}));
    add_value(command, "NAME", o.name, " ",
              "Name of the system, or of the folder and, after the kind, of the type");
    command.add_flag("--robot", o.robot, "A system with a robot, and a world for it");
}

}  // namespace forage::tool
