// Plugins: types in a shared object. A plugin consists of one or more source files. One of them has
//
//     FORAGE_PLUGIN(MyNeuron, MySynapse)
//
// at its end, with all types that the plugin contains. docs/how-to/write-a-neuron.md explains it step by
// step.
#pragma once

#include <string>
#include <typeinfo>
#include <vector>

#include "core/types/membrane.h"
#include "core/types/module.h"
#include "core/types/neuron.h"
#include "core/types/synapse.h"

#ifdef __FAST_MATH__
#error "Forage needs the arithmetic of IEEE 754: compile without -ffast-math and -Ofast"
#endif

namespace forage {

/// The version of the SDK. It grows whenever a declaration that types see changes, so that plugins that were
/// built before can no longer be used.
inline constexpr int sdk_version = 13;

/// The types that a plugin declares.
struct PluginTypes {
    std::vector<NeuronType> neurons;
    std::vector<SynapseType> synapses;
    std::vector<ModuleType> modules;
};

namespace detail {

#define FORAGE_TEXT_OF(x) #x
#define FORAGE_TEXT(x) FORAGE_TEXT_OF(x)
#if defined(_LIBCPP_VERSION)
#define FORAGE_ABI_LIBRARY "libc++"
#elif defined(_GLIBCXX_DEBUG)
#define FORAGE_ABI_LIBRARY "libstdc++ in debug mode (_GLIBCXX_DEBUG)"
#elif defined(_GLIBCXX_USE_CXX11_ABI) && !_GLIBCXX_USE_CXX11_ABI
#define FORAGE_ABI_LIBRARY "libstdc++ with the old strings (_GLIBCXX_USE_CXX11_ABI=0)"
#else
#define FORAGE_ABI_LIBRARY "libstdc++"
#endif
#if defined(__x86_64__)
#define FORAGE_ABI_PROCESSOR "x86-64"
#elif defined(__aarch64__)
#define FORAGE_ABI_PROCESSOR "aarch64"
#else
#define FORAGE_ABI_PROCESSOR "another processor"
#endif

/// What a program and its plugins must have in common to use each other's objects, in words.
inline constexpr const char* abi = FORAGE_ABI_PROCESSOR
    ", " FORAGE_ABI_LIBRARY ", Eigen " FORAGE_TEXT(EIGEN_WORLD_VERSION) "." FORAGE_TEXT(EIGEN_MAJOR_VERSION);

/// A hash of the sizes of all types that a program and its plugins exchange.
inline constexpr unsigned long long layout = [] {
    unsigned long long hash = 0xcbf29ce484222325u;
    for (const std::size_t size :
         {sizeof(NeuronType),     sizeof(SynapseType),       sizeof(ModuleType),
          sizeof(Parameter),      sizeof(StateInfo),         sizeof(SynapseStateInfo),
          sizeof(FeedbackInfo),   sizeof(ModulePort),        sizeof(NeuronColumns),
          sizeof(SynapseColumns), sizeof(ModuleFrame),       sizeof(ModulePorts),
          sizeof(Diagnostic),     sizeof(Diagnostics),       sizeof(RandomStream),
          sizeof(Column),         sizeof(Archive),           sizeof(NeuronColumns::State),
          sizeof(std::string),    sizeof(std::vector<char>), alignof(std::max_align_t),
          sizeof(long double)})
        hash = (hash ^ size) * 0x100000001b3u;
    return hash;
}();

template <class T>
void declare(PluginTypes& out) {
    constexpr bool neuron = requires(NeuronSpec<T> & s) { T::describe(s); };
    constexpr bool synapse = requires(SynapseSpec<T> & s) { T::describe(s); };
    constexpr bool module = requires(ModuleSpec<T> & s) { T::describe(s); };
    static_assert(neuron + synapse + module == 1,
                  "a type in FORAGE_PLUGIN() needs one public static void describe(NeuronSpec<T>&), "
                  "describe(SynapseSpec<T>&) or describe(ModuleSpec<T>&), T being the type itself");
    if constexpr (neuron)
        out.neurons.push_back(neuron_type<T>());
    else if constexpr (synapse)
        out.synapses.push_back(synapse_type<T>());
    else if constexpr (module)
        out.modules.push_back(module_type<T>());
}

struct PluginEntry {
    const char* (*name)();  ///< the mangled name of the C++ type
    void (*declare)(PluginTypes&);
};

template <class... T>
inline constexpr PluginEntry plugin_entries[] = {
    {[] { return typeid(T).name(); }, [](PluginTypes& out) { declare<T>(out); }}...};

}  // namespace detail

/// The only symbol of a plugin. The first three members never change, so that plugins of any version can be
/// identified. The others are read only when the first three fit.
struct PluginHeader {
    int sdk_version;
    const char* abi;
    unsigned long long layout;
    const detail::PluginEntry* types;
    std::size_t count;
};

namespace detail {

template <class... T>
constexpr PluginHeader plugin_header() {
    static_assert(sizeof...(T) > 0, "FORAGE_PLUGIN() needs the types that the plugin holds");
    return {forage::sdk_version, abi, layout, plugin_entries<T...>, sizeof...(T)};
}

}  // namespace detail
}  // namespace forage

/// Declares all types of a plugin. It is used once in a plugin, outside any namespace.
#define FORAGE_PLUGIN(...)                                                                        \
    extern "C" __attribute__((visibility("default"))) const ::forage::PluginHeader forage_plugin; \
    constinit const ::forage::PluginHeader forage_plugin = ::forage::detail::plugin_header<__VA_ARGS__>()
