#include "core/plugin/plugin.h"

#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "core/base/exception_message.h"
#include "core/base/shell_word.h"
#include "core/plugin/child.h"
#include "core/plugin/contract.h"
#include "core/plugin/declarations.h"
#include "core/plugin/shared_object.h"
#include "core/plugin/trust.h"

namespace forage::plugin {
namespace {

/// The mistake in a header; empty when there is none. Only its first members can be trusted.
std::string mismatch(const PluginHeader& header) {
    if (header.sdk_version != sdk_version)
        return fmt::format("was built with version {} of the SDK, this program has version {}",
                           header.sdk_version, sdk_version);
    const std::string_view theirs = header.abi;
    if (theirs != detail::abi)
        return fmt::format("was built for {}, this program for {}", theirs, detail::abi);
    if (header.layout != detail::layout)
        return fmt::format(
            "was built with other compiler settings than this program (both say {}, but the "
            "sizes of objects differ)",
            theirs);
    return {};
}

class Loader {
  public:
    Loader(Use use, const Registry& shipped, Diagnostics& diagnostics)
        : use_(use), known_(shipped), diagnostics_(diagnostics) {}

    /// Decides what is done with a file. All plugins come through here.
    std::optional<Plugin> take(const File& file) {
        if (file.named || (use_ == Use::run && (is_loaded(file.path) || is_trusted(folder_of(file.path)))))
            return load(file.path);
        if (use_ == Use::read) return declared(file.path);
        return Plugin{
            file.path,
            {},
            false,
            fmt::format("a plugin is a program: if you trust those of this folder, 'forage trust {}'",
                        shell_word(folder_of(file.path)))};
    }

  private:
    std::optional<Plugin> declared(const std::string& path) {
        Plugin out{path, {}, false};
        auto types = read_declarations(path);
        if (!types) {
            out.hint =
                "reading a system loads no plugins beside it: 'forage build-plugin' writes their types to "
                "NAME.so.json, and --plugin loads one";
            return out;
        }
        accept_all(out, *types);
        return out;
    }

    std::optional<Plugin> load(const std::string& path) {
        const auto* header =
            static_cast<const PluginHeader*>(load_symbol(path, "forage_plugin", diagnostics_));
        if (!header) return std::nullopt;
        if (const std::string what = mismatch(*header); !what.empty()) {
            error(path, what, "build the plugin again, with the compiler and the SDK of this Forage");
            return std::nullopt;
        }
        Plugin out{path, {}};
        const int errors_before = diagnostics_.errors();
        for (std::size_t i = 0; i < header->count; ++i) declare(out, header->types[i]);
        if (diagnostics_.errors() > errors_before) return std::nullopt;
        return out;
    }

    void error(const std::string& path, const std::string& what, std::string hint = {}) {
        diagnostics_.error({}, fmt::format("plugin '{}' {}", path, what), std::move(hint));
    }

    void declare(Plugin& out, const detail::PluginEntry& entry) {
        PluginTypes one;
        try {
            entry.declare(one);
        } catch (const TypeError& e) {
            return error(out.path, fmt::format("has a type {} that does not work: {}",
                                               demangled(entry.name()), e.what()));
        } catch (...) {
            return error(out.path,
                         fmt::format("fails: its type {} throws in its constructor or describe(): {}",
                                     demangled(entry.name()), current_exception_message()),
                         "describe() and the constructor run before any system is loaded: what can fail "
                         "belongs into update(), or a module's start()");
        }
        accept_all(out, one);
    }

    void accept_all(Plugin& out, PluginTypes& all) {
        for (auto& t : all.neurons) accept(out, t, "neuron", known_.neuron(t.name), out.types.neurons);
        for (auto& t : all.synapses) accept(out, t, "synapse", known_.synapse(t.name), out.types.synapses);
        for (auto& t : all.modules) accept(out, t, "module", known_.module(t.name), out.types.modules);
    }

    template <class Type>
    void accept(Plugin& out, Type& type, std::string_view kind, const Type* same, std::vector<Type>& types) {
        if (same) {
            const auto owner = owners_.find(fmt::format("{} {}", kind, type.name));
            return error(out.path,
                         fmt::format("has a {} type '{}', and so has {}", kind, type.name,
                                     owner == owners_.end()      ? "Forage itself"
                                     : owner->second == out.path ? "the same plugin once more"
                                                                 : fmt::format("plugin '{}'", owner->second)),
                         "give one of them another name in describe()");
        }
        if (const std::string what = out.loaded ? fault(type) : ""; !what.empty())
            return error(out.path,
                         fmt::format("has a {} type '{}' that does not work: {}", kind, type.name, what));
        try {
            known_.add(type);
        } catch (const std::invalid_argument& e) {
            return error(out.path,
                         fmt::format("has a {} type with an inconsistent declaration: {}", kind, e.what()));
        }
        owners_[fmt::format("{} {}", kind, type.name)] = out.path;
        types.push_back(std::move(type));
    }

    /// The mistake that is found when a type is created and updated; empty when there is none.
    template <class Type>
    static std::string fault(const Type& type) {
        try {
            type.make();
        } catch (...) {
            return fmt::format("its constructor throws: {}", current_exception_message());
        }
        for (const auto& p : type.parameters)
            if (outside(p.default_value, p.range))
                return fmt::format("its parameter '{}' is {} by default, outside its own range {} to {}",
                                   p.name, to_text(p.default_value), p.range->low, p.range->high);
        if constexpr (std::is_same_v<Type, NeuronType>)
            for (const auto& s : type.states)
                if (s.history < 1)
                    return fmt::format("state '{}' has a history of {}, the least is 1", s.name, s.history);
        if constexpr (!std::is_same_v<Type, ModuleType>)
            if (type.output() >= 0) return in_child([&] { return contract_violation(type); });
        return {};
    }

    Use use_;
    Registry known_;
    std::map<std::string, std::string> owners_;  ///< plugins by kind and name of a type
    Diagnostics& diagnostics_;
};

}  // namespace

std::vector<Plugin> load(const std::vector<File>& files, Use use, const Registry& shipped,
                         Diagnostics& diagnostics) {
    std::vector<Plugin> out;
    Loader loader(use, shipped, diagnostics);
    for (const auto& file : files)
        if (auto plugin = loader.take(file)) out.push_back(std::move(*plugin));
    return out;
}

void add(const std::vector<Plugin>& plugins, Registry& registry) {
    for (const auto& p : plugins) {
        for (const auto& t : p.types.neurons) registry.add(t);
        for (const auto& t : p.types.synapses) registry.add(t);
        for (const auto& t : p.types.modules) registry.add(t);
        if (!p.hint.empty())
            registry.unloaded.push_back({std::filesystem::path(p.path).parent_path().string(), p.hint});
    }
}

}  // namespace forage::plugin
