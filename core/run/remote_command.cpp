#include "core/run/remote_command.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "core/base/printable.h"

namespace forage {
namespace {

constexpr std::array<std::pair<std::string_view, RemoteCommand::Kind>, 7> commands = {
    {{"start", RemoteCommand::Kind::start},
     {"stop", RemoteCommand::Kind::stop},
     {"quit", RemoteCommand::Kind::quit},
     {"startsampler", RemoteCommand::Kind::start_sampler},
     {"stopsampler", RemoteCommand::Kind::stop_sampler},
     {"param", RemoteCommand::Kind::set_parameter},
     {"plot", RemoteCommand::Kind::plot}}};
/// CONN is what a script of the original writes.
constexpr std::array<std::pair<std::string_view, RemoteCommand::Item>, 7> item_types = {
    {{"GROUP", RemoteCommand::Item::group},
     {"NEURON", RemoteCommand::Item::group},
     {"CONNECTION", RemoteCommand::Item::connection},
     {"CONN", RemoteCommand::Item::connection},
     {"SYNAPSE", RemoteCommand::Item::connection},
     {"PROCESS", RemoteCommand::Item::process},
     {"MODULE", RemoteCommand::Item::process}}};

/// Whether a terminal can show the text: UTF-8 without control characters.
bool is_printable(std::string_view text) {
    return !any_character(text, [](bool sound, unsigned c) { return !sound || is_control(c); });
}

bool same_word(std::string_view a, std::string_view b) {
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [&](char x, char y) { return lower(x) == lower(y); });
}

template <class Table>
auto find_word(const Table& table, std::string_view word) {
    return std::ranges::find_if(table, [&](const auto& entry) { return same_word(entry.first, word); });
}

template <class Table>
std::string list_of(const Table& table) {
    std::string out;
    for (const auto& [word, meaning] : table) out += fmt::format("{}{}", out.empty() ? "" : ", ", word);
    return out;
}

/// The fields of a command; null when one is absent.
struct Fields {
    std::optional<std::string_view> cmd, type, name, id, parameter, value;
};

/// Returns what is wrong with the fields; empty when nothing is.
std::string read_fields(std::string_view text, Fields& out) {
    const std::array<std::pair<std::string_view, std::optional<std::string_view>*>, 7> known = {
        {{"cmd", &out.cmd},
         {"itemType", &out.type},
         {"itemName", &out.name},
         {"itemID", &out.id},
         {"paramName", &out.parameter},
         {"paramID", &out.parameter},
         {"value", &out.value}}};
    while (!text.empty()) {
        const auto end = text.find(';');
        const std::string_view field = text.substr(0, end);
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        if (field.empty()) continue;
        const auto colon = field.find(':');
        if (colon == std::string_view::npos) return fmt::format("'{}' has no ':'", field);
        const auto key = find_word(known, field.substr(0, colon));
        if (key == known.end())
            return fmt::format("'{}' is none of {}", field.substr(0, colon), list_of(known));
        if (*key->second) return fmt::format("{} is given twice", key->first);
        *key->second = field.substr(colon + 1);
    }
    return {};
}

std::string read_command(std::string_view text, RemoteCommand& out) {
    Fields f;
    if (auto problem = read_fields(text, f); !problem.empty()) return problem;
    if (!f.cmd) return "it has no field cmd";
    const auto kind = find_word(commands, *f.cmd);
    if (kind == commands.end()) return fmt::format("cmd:{} is none of {}", *f.cmd, list_of(commands));
    out.kind = kind->second;
    const bool plots = out.kind == RemoteCommand::Kind::plot;
    if (out.kind != RemoteCommand::Kind::set_parameter && !plots) {
        if (f.type || f.name || f.id || f.parameter || f.value)
            return fmt::format("cmd:{} has no other fields", *f.cmd);
        return {};
    }
    if (!f.type) return "it has no field itemType";
    const auto item = find_word(item_types, *f.type);
    if (item == item_types.end())
        return fmt::format("itemType:{} is none of {}", *f.type, list_of(item_types));
    out.item = item->second;
    if (f.name.has_value() == f.id.has_value()) return "it needs one of the fields itemName and itemID";
    out.by_id = f.id.has_value();
    out.name = out.by_id ? *f.id : *f.name;
    if (out.name.empty()) return "the name of the item is empty";
    out.parameter = f.parameter.value_or("");
    if (plots) {
        if (f.value) return "cmd:plot has no value";
        if (out.item == RemoteCommand::Item::process) return "a process has no plot";
        return {};
    }
    if (out.parameter.empty()) return "it has no field paramName or paramID";
    if (!f.value) return "it has no field value";
    out.value = *f.value;
    return {};
}

}  // namespace

std::optional<RemoteCommand> parse_remote_command(std::string_view datagram, std::string& problem) {
    RemoteCommand out;
    while (datagram.ends_with('\n') || datagram.ends_with('\r') || datagram.ends_with('\0'))
        datagram.remove_suffix(1);
    if (datagram.size() > longest_remote_command)
        problem = fmt::format("it has more than {} bytes", longest_remote_command);
    else if (!is_printable(datagram))
        problem = "it is not UTF-8 without control characters";
    else
        problem = read_command(datagram, out);
    if (!problem.empty()) return std::nullopt;
    return out;
}

}  // namespace forage
