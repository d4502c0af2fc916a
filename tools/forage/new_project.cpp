#include <cctype>
#include <filesystem>

#include <fmt/format.h>

#include "core/base/output_files.h"
#include "tools/forage/commands.h"
#include "tools/forage/templates.h"

namespace forage::tool {
namespace {

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

}  // namespace

int new_project(const std::string& kind, const std::string& name) {
    const auto refuse = [](const std::string& what, const std::string& hint) {
        fmt::print(stderr, "error: {}\n  hint: {}\n", what, hint);
        return bad_input;
    };
    if (!usable(name))
        return refuse(fmt::format("'{}' cannot be the name of a type", name),
                      "take a letter, then letters, digits, '_' and '-'");
    if (std::filesystem::exists(name))
        return refuse(fmt::format("there is already a '{}' here", name), "take another name or folder");
    make_directory(name);
    const std::pair<std::string, std::string> files[] = {
        {name + ".cpp", kind + ".cpp"},  {"CMakeLists.txt", "CMakeLists.txt"}, {"example.iqr", kind + ".iqr"},
        {"expected.csv", kind + ".csv"}, {"test.cmake", "test.cmake"},         {"README.md", "README.md"}};
    for (const auto& [file, source] : files)
        write_file(name + "/" + file, filled(template_text(source), name, kind));
    fmt::print(
        "{}: a plugin with the {} type {}{}. Next:\n"
        "  cd {}\n  cmake -B build && cmake --build build && ctest --test-dir build\n"
        "  forage run example.iqr --plugin build/plugins\n",
        name, kind, kind, class_name(name), name);
    return fine;
}

}  // namespace forage::tool
