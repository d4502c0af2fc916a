// The commands of remote control: the original's text protocol.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/model/edit.h"

namespace forage {

/// The longest datagram that can be a command, bytes.
constexpr std::size_t longest_remote_command = 4096;

/// A command, as one datagram holds it:
///
///     cmd:start   cmd:stop   cmd:quit   cmd:startsampler   cmd:stopsampler
///     cmd:param;itemType:GROUP;itemName:Light;paramName:threshold;value:0.5
///     cmd:plot;itemType:GROUP;itemID:L-1-2-3
///
/// The fields are in any order and end with ';', which the last one may leave out. itemType is GROUP or
/// NEURON (a group and its neuron), CONNECTION or SYNAPSE, PROCESS or MODULE. paramID and paramName mean the
/// same.
struct RemoteCommand {
    enum class Kind { start, stop, quit, start_sampler, stop_sampler, set_parameter, plot };
    using Item = model::Assignment::Owner;

    Kind kind = Kind::start;
    Item item = Item::group;
    std::string name;       ///< the name or the id of the item
    bool by_id = false;     ///< whether `name` is an id; otherwise it means every item of that name
    std::string parameter;  ///< the name or the label of a parameter; for a plot, a state, or empty
    std::string value;
};

/// Reads a datagram. Empty when it is not a command; `problem` says why, in text that a terminal can show.
std::optional<RemoteCommand> parse_remote_command(std::string_view datagram, std::string& problem);

}  // namespace forage
