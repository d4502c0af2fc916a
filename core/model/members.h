// The members of the structs of a model, each listed once. Comparing, merging and testing models visit these
// lists. A list that lacks a member does not compile.
#pragma once

#include <concepts>
#include <cstddef>
#include <tuple>

#include "core/base/member_count.h"
#include "core/model/system.h"

namespace forage::model {

/// What a change of a member means for a system that runs.
enum class Effect {
    none,        ///< only people and other programs see the member
    parameters,  ///< the run takes over the new values
    rebuild,     ///< the run must be rebuilt
};

template <class Struct, class T>
struct Member {
    T Struct::*member;
    const char* label;  ///< in messages: "the colour"; null for the id by which the struct is found
    Effect effect;
};
template <class Struct, class T>
Member(T Struct::*, const char*, Effect) -> Member<Struct, T>;

template <class Struct>
inline constexpr std::tuple<> members_of;

template <>
inline constexpr auto members_of<TypeUse> = std::tuple{
    Member{&TypeUse::type, "the type", Effect::rebuild},
    Member{&TypeUse::settings, "the parameters", Effect::parameters},
    Member{&TypeUse::initial, "the initial values", Effect::rebuild},
    Member{&TypeUse::note, "the note of the type", Effect::none},
    Member{&TypeUse::at, "the location", Effect::none},
    Member{&TypeUse::defaults, "the constants of the type", Effect::none},
};
template <>
inline constexpr auto members_of<SynapseUse> = std::tuple_cat(
    members_of<TypeUse>, std::tuple{Member{&SynapseUse::feedback, "the feedback", Effect::rebuild}});
template <>
inline constexpr auto members_of<ModuleUse> = std::tuple_cat(
    members_of<TypeUse>, std::tuple{
                             Member{&ModuleUse::inputs, "the inputs of the module", Effect::rebuild},
                             Member{&ModuleUse::outputs, "the outputs of the module", Effect::rebuild},
                         });

template <>
inline constexpr auto members_of<CanvasComment> = std::tuple{
    Member{&CanvasComment::id, nullptr, Effect::none},
    Member{&CanvasComment::text, "the text", Effect::none},
    Member{&CanvasComment::color, "the colour", Effect::none},
    Member{&CanvasComment::box, "the place", Effect::none},
    Member{&CanvasComment::at, "the location", Effect::none},
};
template <>
inline constexpr auto members_of<Group> = std::tuple{
    Member{&Group::id, nullptr, Effect::rebuild},
    Member{&Group::name, "the name", Effect::rebuild},
    Member{&Group::color, "the colour", Effect::none},
    Member{&Group::topology, "the topology", Effect::rebuild},
    Member{&Group::neuron, "the neuron", Effect::rebuild},
    Member{&Group::note, "the note", Effect::none},
    Member{&Group::icon, "the place", Effect::none},
    Member{&Group::comments, "the comments", Effect::none},
    Member{&Group::terse, "the omission of defaults", Effect::none},
    Member{&Group::at, "the location", Effect::none},
};

template <>
inline constexpr auto members_of<Process> = std::tuple{
    Member{&Process::id, nullptr, Effect::rebuild},
    Member{&Process::name, "the name", Effect::rebuild},
    Member{&Process::color, "the colour", Effect::none},
    Member{&Process::hostname, "the host", Effect::none},
    Member{&Process::port, "the port", Effect::none},
    Member{&Process::path, "the link", Effect::none},
    Member{&Process::module_enabled, "the enabling of the module", Effect::rebuild},
    Member{&Process::module, "the module", Effect::rebuild},
    Member{&Process::note, "the note", Effect::none},
    Member{&Process::icon, "the place", Effect::none},
    Member{&Process::comments, "the comments", Effect::none},
    Member{&Process::canvas_comments, "the comments on the page", Effect::none},
    Member{&Process::phantoms, "the phantoms", Effect::none},
    Member{&Process::constants, "the constants", Effect::parameters},
    Member{&Process::ports, "the ports", Effect::none},
    Member{&Process::within, "the file", Effect::none},
    Member{&Process::groups, "the groups", Effect::rebuild},
    Member{&Process::placeholder, "the link", Effect::none},
    Member{&Process::at, "the location", Effect::none},
    Member{&Process::path_at, "the location", Effect::none},
};

template <>
inline constexpr auto members_of<Connection> = std::tuple{
    Member{&Connection::id, nullptr, Effect::rebuild},
    Member{&Connection::name, "the name", Effect::rebuild},
    Member{&Connection::source, "the source", Effect::rebuild},
    Member{&Connection::target, "the target", Effect::rebuild},
    Member{&Connection::kind, "the kind", Effect::rebuild},
    Member{&Connection::input, "the input", Effect::rebuild},
    Member{&Connection::state, "the state", Effect::rebuild},
    Member{&Connection::pattern, "the pattern", Effect::rebuild},
    Member{&Connection::arborization, "the arborization", Effect::rebuild},
    Member{&Connection::attenuation, "the attenuation", Effect::rebuild},
    Member{&Connection::delay, "the delay", Effect::rebuild},
    Member{&Connection::synapse, "the synapse", Effect::rebuild},
    Member{&Connection::note, "the note", Effect::none},
    Member{&Connection::line, "the line", Effect::none},
    Member{&Connection::comments, "the comments", Effect::none},
    Member{&Connection::linked, "the file", Effect::none},
    Member{&Connection::terse, "the omission of defaults", Effect::none},
    Member{&Connection::terse_synapse, "the omission of defaults", Effect::none},
    Member{&Connection::at, "the location", Effect::none},
    Member{&Connection::source_at, "the location", Effect::none},
    Member{&Connection::target_at, "the location", Effect::none},
    Member{&Connection::input_at, "the location", Effect::none},
    Member{&Connection::state_at, "the location", Effect::none},
};

template <>
inline constexpr auto members_of<System> = std::tuple{
    Member{&System::instructions, "the instructions before it", Effect::none},
    Member{&System::id, "the id", Effect::rebuild},
    Member{&System::name, "the name", Effect::rebuild},
    Member{&System::author, "the author", Effect::none},
    Member{&System::date, "the date", Effect::none},
    Member{&System::port, "the port", Effect::none},
    Member{&System::cycles_per_second, "the cycles per second", Effect::rebuild},
    Member{&System::sync_plots, "the synchronisation of plots", Effect::none},
    Member{&System::note, "the note", Effect::none},
    Member{&System::processes, "the processes", Effect::rebuild},
    Member{&System::connections, "the connections", Effect::rebuild},
    Member{&System::comments, "the comments", Effect::none},
    Member{&System::canvas_comments, "the comments on the page", Effect::none},
    Member{&System::constants, "the constants", Effect::parameters},
    Member{&System::neuron_types, "the neuron types", Effect::rebuild},
    Member{&System::synapse_types, "the synapse types", Effect::rebuild},
    Member{&System::formulas, "the formulas", Effect::none},
    Member{&System::at, "the location", Effect::none},
};

template <class Struct>
inline constexpr std::size_t listed_members = std::tuple_size_v<decltype(members_of<Struct>)>;

/// Whether a type is a struct whose members are listed.
template <class T>
concept HasMembers = (listed_members<T> != 0);

/// Calls f(member) with each Member of a struct.
template <HasMembers Struct, class F>
void each_member(F f) {
    constexpr bool derived = std::derived_from<Struct, TypeUse> && !std::same_as<Struct, TypeUse>;
    static_assert(
        listed_members<Struct> == member_count<Struct>() + (derived ? listed_members<TypeUse> - 1 : 0),
        "add the new member to the list of its struct above, with its name and effect");
    std::apply([&](const auto&... members) { (f(members), ...); }, members_of<Struct>);
}

}  // namespace forage::model
