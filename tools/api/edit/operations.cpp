#include "tools/api/edit/operations.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/model/build.h"
#include "core/model/lookup.h"
#include "core/model/operations.h"
#include "core/run/input_error.h"
#include "core/types/registry.h"
#include "core/xml/reader.h"
#include "core/xml/writer.h"
#include "tools/api/edit/forms.h"

namespace forage::editing {
namespace {

using namespace model;
using Strings = std::map<std::string, std::string>;

/// An operation with what it works on.
struct Operation {
    const json& o;
    System& system;
    const Registry& registry;
    const std::string& path;

    std::string text(const char* member) const { return o.at(member).get<std::string>(); }
    std::string text(const char* member, const char* otherwise) const {
        const auto it = o.find(member);
        return it == o.end() || it->is_null() ? otherwise : it->get<std::string>();
    }
    std::string id() const {
        const auto given = text("id");
        return given == "system" ? system.id : given;
    }
    const json* member(const char* name) const {
        const auto it = o.find(name);
        return it == o.end() || it->is_null() ? nullptr : &*it;
    }

    InputKind kind(const std::string& name) const {
        const Strings known{{"excitatory", ""}, {"inhibitory", ""}, {"modulatory", ""}};
        if (!known.contains(name))
            throw InputError(fmt::format("'{}' is not a kind of connection", name),
                             "excitatory, inhibitory or modulatory");
        return name == "excitatory"   ? InputKind::excitatory
               : name == "inhibitory" ? InputKind::inhibitory
                                      : InputKind::modulatory;
    }

    json add_process() {
        const auto made = model::add_process(system, text("name"), text("id", ""));
        if (member("x")) model::place(system, made, whole_from(o["x"]), whole_from(o["y"]));
        return made;
    }
    int side(const char* name) const {
        const auto* given = member(name);
        return given ? whole_from(*given, model::most_cells) : 1;
    }
    json add_group() {
        const auto made =
            model::add_group(system, text("process"), text("name"), side("width"), side("height"),
                             text("neuron", "neuronLinearThreshold"), text("id", ""));
        if (member("x")) model::place(system, made, whole_from(o["x"]), whole_from(o["y"]));
        return made;
    }
    LineChange line_change() const {
        LineChange out;
        if (const auto* a = member("source_anchor")) out.source_anchor = whole_from(*a);
        if (const auto* a = member("target_anchor")) out.target_anchor = whole_from(*a);
        if (const auto* v = member("vertices")) out.vertices = points_from(*v);
        if (const auto* v = member("source_vertices")) out.source_vertices = points_from(*v);
        if (const auto* v = member("target_vertices")) out.target_vertices = points_from(*v);
        return out;
    }
    json add_connection() {
        const auto made =
            model::add_connection(system, text("source"), text("target"), kind(text("kind", "excitatory")),
                                  text("synapse", "synapseFixedWeight"), text("id", ""));
        if (const auto name = text("name", ""); !name.empty()) model::rename(system, made, name);
        model::set_line(system, made, line_change());
        return made;
    }
    CommentChange comment_change() const {
        CommentChange out;
        if (const auto* v = member("text")) out.text = v->get<std::string>();
        if (const auto* v = member("color")) out.color = v->get<std::string>();
        const auto number = [&](const char* name, std::optional<int>& to) {
            if (const auto* v = member(name)) to = whole_from(*v);
        };
        number("x", out.x), number("y", out.y), number("width", out.width), number("height", out.height);
        return out;
    }
    json add_comment() {
        CanvasComment comment;
        comment.id = text("id", "");
        const auto made = add_canvas_comment(system, text("process", ""), std::move(comment));
        set_comment(system, made, comment_change());
        return made;
    }
    json comment() { return set_comment(system, id(), comment_change()), nullptr; }
    json phantom() {
        place_phantom(system, text("process"), text("group"), whole_from(o.at("x")), whole_from(o.at("y")));
        return nullptr;
    }
    bool exists(const std::string& each) {
        return find_process(system, each) || find_group(system, each) || find_connection(system, each) ||
               find_canvas_comment(system, each);
    }
    json remove() {
        const auto ids = o.at("ids").get<std::vector<std::string>>();
        for (const auto& each : ids)
            if (!exists(each)) throw InputError(fmt::format("there is no item with the id '{}'", each));
        for (const auto& each : ids)
            if (exists(each)) model::remove(system, each);  // else it went with another one
        return nullptr;
    }
    json rename() { return model::rename(system, id(), text("name")), nullptr; }
    json place() { return model::place(system, id(), whole_from(o.at("x")), whole_from(o.at("y"))), nullptr; }
    json line() { return model::set_line(system, id(), line_change()), nullptr; }
    json reroute() { return model::reroute(system, id(), text("source", ""), text("target", "")), nullptr; }
    json set() {
        const auto property = text("property");
        const json& value = o.at("value");
        if (property == "color")
            set_color(system, id(), value.get<std::string>());
        else if (property == "note")
            set_note(system, id(), value.get<std::string>());
        else if (property == "kind")
            set_kind(system, id(), kind(value.get<std::string>()));
        else if (property == "enabled")
            set_enabled(system, id(), value.get<bool>());
        else if (property == "feedback")
            set_feedback(system, id(), value.get<Strings>());
        else
            throw InputError(fmt::format("there is no property '{}'", property),
                             "color, note, kind, enabled or feedback");
        return nullptr;
    }
    json type() {
        const auto part = text("part");
        const std::map<std::string, Part> parts{
            {"neuron", Part::neuron}, {"synapse", Part::synapse}, {"module", Part::module}};
        const auto it = parts.find(part);
        if (it == parts.end())
            throw InputError(fmt::format("there is no part '{}'", part), "neuron, synapse or module");
        return set_type(system, registry, id(), it->second, text("type")), nullptr;
    }
    json parameter() {
        const auto* value = member("value");
        std::optional<std::string> written;
        if (value) written = value->is_string() ? value->get<std::string>() : value->dump();
        return set_parameter(system, id(), text("name"), written), nullptr;
    }
    json topology() { return set_topology(system, id(), topology_from(o)), nullptr; }
    json pattern() { return set_pattern(system, id(), pattern_from(o.at("pattern"))), nullptr; }
    json arborization() {
        return set_arborization(system, id(), arborization_from(o.at("arborization"))), nullptr;
    }
    const json& function(const char* name) const { return o.contains(name) ? o.at(name) : o.at("function"); }
    json attenuation() {
        return set_attenuation(system, id(), function_from(function("attenuation"))), nullptr;
    }
    json delay() { return set_delay(system, id(), function_from(function("delay"))), nullptr; }
    json ports() {
        const json none = json::object();
        const auto side = [&](const char* name) {
            return (member(name) ? *member(name) : none).get<Strings>();
        };
        return set_ports(system, id(), side("inputs"), side("outputs")), nullptr;
    }
    json paste() {
        Diagnostics diagnostics;
        auto content = xml::parse_system("clipboard", text("text"), diagnostics);
        if (!content) throw InputError(std::move(diagnostics));
        return model::paste(system, *std::move(content), text("process", ""), whole_from(o.at("x")),
                            whole_from(o.at("y")));
    }
    json import() {
        Diagnostics diagnostics;
        auto file = xml::read_process(text("file"), diagnostics);
        throw_errors(diagnostics);
        return import_process(system, std::move(*file));
    }
    json system_properties() {
        if (const auto* v = member("name")) {
            if (model::trim(v->get_ref<const std::string&>()).empty())
                throw InputError("a name cannot be empty", "write at least one letter or digit");
            system.name = *v;
        }
        if (const auto* v = member("author")) system.author = v->get<std::string>();
        if (const auto* v = member("date")) system.date = v->get<std::string>();
        if (const auto* v = member("note")) set_note(system, system.id, v->get<std::string>());
        if (const auto* v = member("port")) system.port = v->get<std::string>();
        if (const auto* v = member("sync_plots")) system.sync_plots = v->get<bool>();
        if (const auto* v = member("cycles_per_second")) system.cycles_per_second = v->get<double>();
        return nullptr;
    }
};

const std::map<std::string, json (Operation::*)()>& operations_by_name() {
    static const std::map<std::string, json (Operation::*)()> operations = {
        {"add_process", &Operation::add_process},
        {"add_group", &Operation::add_group},
        {"add_connection", &Operation::add_connection},
        {"add_comment", &Operation::add_comment},
        {"comment", &Operation::comment},
        {"phantom", &Operation::phantom},
        {"remove", &Operation::remove},
        {"rename", &Operation::rename},
        {"place", &Operation::place},
        {"line", &Operation::line},
        {"reroute", &Operation::reroute},
        {"set", &Operation::set},
        {"type", &Operation::type},
        {"parameter", &Operation::parameter},
        {"topology", &Operation::topology},
        {"pattern", &Operation::pattern},
        {"arborization", &Operation::arborization},
        {"attenuation", &Operation::attenuation},
        {"delay", &Operation::delay},
        {"ports", &Operation::ports},
        {"paste", &Operation::paste},
        {"import", &Operation::import},
        {"system", &Operation::system_properties},
    };
    return operations;
}

/// Throws InputError for a text with a character that XML cannot hold.
void check_characters(const std::string& text) {
    const bool control = std::ranges::any_of(text, [](char c) {
        return static_cast<unsigned char>(c) < ' ' && c != '\t' && c != '\n' && c != '\r';
    });
    if (control || text.find("\xef\xbf\xbe") != text.npos || text.find("\xef\xbf\xbf") != text.npos)
        throw InputError("a text has a control character, which XML cannot hold");
}

void check_characters(const json& value) {
    if (value.is_string()) check_characters(value.get_ref<const std::string&>());
    if (value.is_array())
        for (const auto& each : value) check_characters(each);
    if (value.is_object())
        for (const auto& [name, each] : value.items()) check_characters(name), check_characters(each);
}

std::string name_of(const System& system, const std::string& id) {
    for (const auto& p : system.processes) {
        if (p.id == id) return std::string(trim(p.name));
        for (const auto& g : p.groups)
            if (g.id == id) return path(system, p, g);
    }
    for (const auto& c : system.connections)
        if (c.id == id) return std::string(trim(c.name));
    const auto title = [&](const std::vector<CanvasComment>& comments) {
        const auto it = std::ranges::find(comments, id, &CanvasComment::id);
        return it == comments.end() ? std::string() : fmt::format("comment '{}'", first_words(it->text));
    };
    for (const auto& p : system.processes)
        if (auto out = title(p.canvas_comments); !out.empty()) return out;
    if (auto out = title(system.canvas_comments); !out.empty()) return out;
    return "the system";
}

}  // namespace

json carry_out(const json& operation, System& system, const Registry& registry, const std::string& path) {
    check_characters(operation);
    const auto what = operation.at("do").get<std::string>();
    const auto it = operations_by_name().find(what);
    if (it == operations_by_name().end()) {
        std::vector<std::string> known;
        for (const auto& [name, function] : operations_by_name()) known.push_back(name);
        throw InputError(fmt::format("there is no operation '{}'", what), suggest(what, known));
    }
    Operation one{operation, system, registry, path};
    return (one.*it->second)();
}

std::string title_of(const json& o, const System& system) {
    const auto what = o.value("do", "");
    const auto name = name_of(system, o.value("id", ""));
    if (what.starts_with("add_")) return fmt::format("add {}", o.value("name", what.substr(4)));
    if (what == "remove") {
        const auto ids = o.value("ids", std::vector<std::string>());
        return ids.size() == 1 ? "remove " + name_of(system, ids.front())
                               : fmt::format("remove {} items", ids.size());
    }
    if (what == "parameter") {
        const json value = o.value("value", json());
        return fmt::format("{}.{} = {}", name, o.value("name", ""),
                           value.is_string() ? value.get<std::string>()
                           : value.is_null() ? "its default"
                                             : value.dump());
    }
    if (what == "place") return "move " + name;
    if (what == "phantom") return "move the phantom of " + name_of(system, o.value("group", ""));
    if (what == "comment") return "change " + name;
    if (what == "rename") return fmt::format("rename {} to {}", name, o.value("name", ""));
    if (what == "set") return fmt::format("{} of {}", o.value("property", "property"), name);
    if (what == "paste") return "paste";
    if (what == "system") return "properties of the system";
    return fmt::format("{} of {}", what, name);
}

}  // namespace forage::editing
