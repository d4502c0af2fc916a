#include "core/plugin/shared_object.h"

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string_view>

#include <cxxabi.h>
#include <dlfcn.h>
#include <fmt/format.h>

#include "core/plugin/elf.h"
#include "core/plugin/trust.h"

namespace forage::plugin {
namespace {

namespace fs = std::filesystem;

bool is_source(const std::string& path) {
    const auto extension = fs::path(path).extension();
    return extension == ".cpp" || extension == ".cc" || extension == ".cxx";
}

/// The word that follows `what` in a message of the loader; empty when `what` is not in `text`.
std::string behind(const std::string& text, std::string_view what) {
    const auto at = text.find(what);
    return at == std::string::npos ? "" : text.substr(at + what.size());
}

void report(const std::string& path, const std::string& text, Diagnostics& diagnostics) {
    std::string symbol = behind(text, "undefined symbol: ");
    symbol = symbol.substr(0, symbol.find_first_of(", \t\n"));
    if (!symbol.empty())
        return diagnostics.error(
            {}, fmt::format("plugin '{}' uses '{}', which is defined nowhere", path, demangled(symbol)),
            "add the source file that defines it to forage_add_plugin(), or link the library that does");
    constexpr std::string_view missing = ": cannot open shared object file";
    if (const auto at = text.find(missing); at != std::string::npos && !text.starts_with(path))
        return diagnostics.error(
            {},
            fmt::format("plugin '{}' needs the library '{}', which is not found", path, text.substr(0, at)),
            "install it, or name its folder in LD_LIBRARY_PATH");
    diagnostics.error({}, fmt::format("plugin '{}' cannot be loaded: {}", path, text),
                      "build it on this machine: 'forage build-plugin FILE.cpp'");
}

}  // namespace

std::string demangled(const std::string& name) {
    int status = 0;
    const std::unique_ptr<char, decltype(&std::free)> text(
        abi::__cxa_demangle(name.c_str(), nullptr, nullptr, &status), &std::free);
    return status == 0 && text ? text.get() : name;
}

bool is_loaded(const std::string& path) {
    if (std::error_code none; !fs::is_regular_file(path, none)) return false;
    void* handle = dlopen(fs::absolute(path).c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NOLOAD);
    if (handle) dlclose(handle);
    return handle != nullptr;
}

const void* load_symbol(const std::string& path, const char* symbol, Diagnostics& diagnostics) {
    std::error_code ignored;
    if (!fs::exists(path, ignored)) {
        diagnostics.error({}, fmt::format("there is no plugin '{}'", path),
                          "a plugin is a shared object (.so), or a folder of them");
        return nullptr;
    }
    if (auto why = insecure_plugin(path)) {
        why->message = fmt::format("plugin '{}' is not loaded: {}", path, why->message);
        diagnostics.add(std::move(*why));
        return nullptr;
    }
    if (const std::string why = why_not_loadable(path); !why.empty()) {
        diagnostics.error({}, fmt::format("plugin '{}' {}", path, why),
                          is_source(path) ? fmt::format("compile it first: 'forage build-plugin {}'", path)
                                          : "'forage build-plugin FILE.cpp' makes one from a source file");
        return nullptr;
    }
    // All symbols are resolved now, so that a missing one is found here and not in the middle of a run. The
    // loader would search a path without a slash among the system's libraries.
    void* handle = dlopen(fs::absolute(path).c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (!handle) {
        const char* text = dlerror();
        report(path, text ? text : "the loader does not say why", diagnostics);
        return nullptr;
    }
    const void* found = dlsym(handle, symbol);
    if (!found)
        diagnostics.error(
            {},
            fmt::format("plugin '{}' is a shared object, but no plugin: it does not say FORAGE_PLUGIN", path),
            "put FORAGE_PLUGIN(YourType); at the end of its source file");
    return found;
}

}  // namespace forage::plugin
