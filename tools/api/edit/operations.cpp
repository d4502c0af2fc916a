#include "tools/api/edit/operations.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/model/build.h"
#include "core/model/lookup.h"
#include "core/model/operations.h"
#include "core/model/parts.h"
#include "core/run/input_error.h"
#include "core/types/registry.h"
#include "core/xml/reader.h"
#include "tools/api/edit/forms.h"
#include "tools/api/edit/part_operations.h"
#include "tools/api/edit/robots.h"
#include "tools/api/edit/wiring.h"

namespace forage::editing {

using namespace model;
using Strings = std::map<std::string, std::string>;

struct SystemEdit {
    System& system;
    const Registry& registry;
    EditFiles& files;
    json o = {};  ///< the operation

    std::string text(const char* member) const { return o.at(member).get<std::string>(); }
    std::string id() const {
        const auto given = text("id");
        return given == "system" ? system.id : given;
    }
    const json* member(const char* name) const {
        const auto it = o.find(name);
        return it == o.end() || it->is_null() ? nullptr : &*it;
    }

    static InputKind kind(const std::string& name) {
        const auto it = std::ranges::find(input_kind_names, name);
        if (it == input_kind_names.end())
            throw InputError(fmt::format("'{}' is not a kind of connection", name),
                             "excitatory, inhibitory or modulatory");
        return static_cast<InputKind>(it - input_kind_names.begin());
    }

    /// The id `made` of a new item, which the operation may place.
    json placed(const std::string& made) {
        const auto *x = member("x"), *y = member("y");
        if ((x == nullptr) != (y == nullptr))
            throw InputError("'x' and 'y' belong together", "give both, or none");
        if (x) model::place(system, made, whole_from(*x), whole_from(*y));
        return made;
    }
    json add_process() { return placed(model::add_process(system, text("name"), text("id"))); }
    json add_group() {
        return placed(model::add_group(system, text("process"), text("name"), o.at("width"), o.at("height"),
                                       text("neuron"), text("id")));
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
        const auto made = model::add_connection(system, text("source"), text("target"), kind(text("kind")),
                                                text("synapse"), text("id"));
        if (const auto name = text("name"); !name.empty()) model::rename(system, made, name);
        model::set_line(system, made, line_change());
        if (const auto how = text("wiring"); !how.empty()) wire(*find_connection(system, made), how);
        return made;
    }
    void wire(Connection& c, const std::string& how) {
        const auto *source = find_group(system, c.source), *target = find_group(system, c.target);
        if (!source || !target)
            throw InputError("the connection leads from or to a group that does not exist");
        c.pattern = wiring_pattern(how, source->topology, target->topology), c.arborization = {};
    }
    json wiring() { return wire(editable_connection(system, id()), text("wiring")), nullptr; }
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
        comment.id = text("id");
        const auto made = add_canvas_comment(system, text("process"), std::move(comment));
        set_comment(system, made, comment_change());
        return made;
    }
    json comment() { return set_comment(system, id(), comment_change()), nullptr; }
    json phantom() {
        place_phantom(system, text("process"), text("group"), whole_from(o.at("x")), whole_from(o.at("y")));
        return nullptr;
    }
    bool exists(const std::string& each) const {
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
    json reroute() { return model::reroute(system, id(), text("source"), text("target")), nullptr; }
    json set() {
        const auto property = text("property");
        const json& value = o.at("value");
        if (property == "color")
            set_color(system, id(), value.get<std::string>());
        else if (property == "note")
            set_note(system, id(), value.get<std::string>());
        else if (property == "kind")
            editable_connection(system, id()).kind = kind(value.get<std::string>());
        else if (property == "enabled")
            editable_process(system, id()).module_enabled = value.get<bool>();
        else
            set_feedback(system, id(), value.get<Strings>());
        return nullptr;
    }
    json type() {
        const std::map<std::string, Part> parts{
            {"neuron", Part::neuron}, {"synapse", Part::synapse}, {"module", Part::module}};
        return set_type(system, registry, id(), parts.at(text("part")), text("type")), nullptr;
    }
    json parameter() {
        const auto* value = member("value");
        std::optional<std::string> written;
        if (value) written = value->is_string() ? value->get<std::string>() : value->dump();
        return set_parameter(system, id(), text("name"), written), nullptr;
    }
    json add_robot() { return placed(editing::add_robot(system, registry, text("name"), text("id"))); }
    json port_groups() {
        return add_port_groups(system, registry, id(), o.at("ports").get<std::vector<std::string>>());
    }
    json topology() { return editable_group(system, id()).topology = topology_from(o), nullptr; }
    json pattern() {
        auto& c = editable_connection(system, id());
        c.pattern = pattern_from(o.at("pattern"));
        if (std::holds_alternative<model::Weights>(c.pattern)) c.arborization = {}, c.attenuation = {};
        return nullptr;
    }
    json arborization() {
        return editable_connection(system, id()).arborization = arborization_from(o.at("arborization")),
                                           nullptr;
    }
    json attenuation() {
        return editable_connection(system, id()).attenuation = function_from(o.at("attenuation")), nullptr;
    }
    json delay() { return editable_connection(system, id()).delay = function_from(o.at("delay")), nullptr; }
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
        return model::paste(system, *std::move(content), text("process"), whole_from(o.at("x")),
                            whole_from(o.at("y")));
    }
    json import() {
        Diagnostics diagnostics;
        auto file = checked(diagnostics, xml::read_process(text("file"), diagnostics));
        return import_process(system, std::move(*file));
    }
    json use_part() {
        return placed(editing::use_part(system, text("file"), text("name"), text("id"), files));
    }
    json make_part() {
        const auto renamed = editing::make_part(system, registry, text("id"), text("file"),
                                                o.at("overwrite").get<bool>(), files);
        return renamed.empty() ? json() : json(renamed);
    }
    json dissolve() { return model::dissolve(system, text("id")), nullptr; }
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

const std::vector<Operation<SystemEdit>>& system_operations() {
    using namespace schema;
    static const std::vector<Operation<SystemEdit>> all = [] {
        const auto place = [](const char* name) { return Member{name, number()}; };
        const auto placed = [](const char* name) { return optional(name, number()); };
        const auto size = [](const char* name) { return optional(name, number(1)); };
        const auto cells = [](const char* name, json otherwise = json(json::value_t::discarded)) {
            return Member{name, whole(1, model::max_extent), {}, std::move(otherwise)};
        };
        const auto with = [](std::vector<Member> first, const std::vector<Member>& more) {
            first.insert(first.end(), more.begin(), more.end());
            return first;
        };
        const ValueType points = list(list(number()));
        const ValueType kind = choice({input_kind_names.begin(), input_kind_names.end()});
        const Member id{"id", text(), "an id"}, any_id{"id", text(), "an id, or `system`"};
        const Member name{"name", text()};
        const Member made = optional("id", text(), "", "of what is made");
        const std::vector<Member> line = {
            optional("source_anchor", whole(0, 15)), optional("target_anchor", whole(0, 15)),
            optional("vertices", points, nullptr, "`[[x, y], ...]`"), optional("source_vertices", points),
            optional("target_vertices", points)};
        const std::vector<Member> comment = {
            optional("text", text()), placed("x"), placed("y"), size("width"), size("height"),
            optional("color", text())};
        return std::vector<Operation<SystemEdit>>{
            {"add_process",
             "Adds a process.",
             {name, placed("x"), placed("y"), made},
             &SystemEdit::add_process},
            {"add_group",
             "Adds a group.",
             {{"process", text()},
              name,
              placed("x"),
              placed("y"),
              cells("width", 1),
              cells("height", 1),
              optional("neuron", text(), "neuronLinearThreshold"),
              made},
             &SystemEdit::add_group},
            {"add_robot",
             "Adds a process for a robot of the world, with groups that drive it and that receive its "
             "proximity and its light sensors.",
             {{"name", text(), "of the robot"}, placed("x"), placed("y"), made},
             &SystemEdit::add_robot},
            {"add_connection", "Adds a connection.",
             with({{"source", text()},
                   {"target", text()},
                   optional("kind", kind, "excitatory"),
                   optional("synapse", text(), "synapseFixedWeight"),
                   optional("name", text(), ""),
                   optional("wiring", text(), "", "as of `wiring`; by default that of the file format"),
                   made},
                  line),
             &SystemEdit::add_connection},
            {"add_comment", "Adds a comment.",
             with({optional("process", text(), "", "by default the page of the system"), made}, comment),
             &SystemEdit::add_comment},
            {"comment", "Changes a comment. What is absent stays.", with({id}, comment),
             &SystemEdit::comment},
            {"phantom",
             "Sets the place of the phantom of a group on the page of another process.",
             {{"process", text()}, {"group", text()}, place("x"), place("y")},
             &SystemEdit::phantom},
            {"remove",
             "Removes items. Connections of removed groups go with them, and ports that name them become "
             "empty.",
             {{"ids", list(text())}},
             &SystemEdit::remove},
            {"rename",
             "Gives an item another name, with at least one character that is not blank.",
             {any_id, name},
             &SystemEdit::rename},
            {"place", "Moves an item, or a comment.", {id, place("x"), place("y")}, &SystemEdit::place},
            {"line",
             "Changes the line of a connection. What is absent stays. Between processes, `vertices` are on "
             "the page of the system, and the others on the pages of the source's and the target's process.",
             with({id}, line), &SystemEdit::line},
            {"reroute",
             "Gives a connection another source or target. Vertices on a page that the line leaves are "
             "removed.",
             {id, optional("source", text(), ""), optional("target", text(), "")},
             &SystemEdit::reroute},
            {"set",
             "Sets a property of an item.",
             {any_id,
              {"property", choice({"color", "note", "kind", "enabled", "feedback"})},
              {"value", any()}},
             &SystemEdit::set},
            {"type",
             "Gives an item another type; an empty one removes a module. Parameters that the new type has, "
             "too, stay.",
             {id, {"part", choice({"neuron", "synapse", "module"})}, {"type", text()}},
             &SystemEdit::type},
            {"parameter",
             "Sets a parameter in the file.",
             {id, name, optional("value", any(), nullptr, "by default that of the type")},
             &SystemEdit::parameter},
            {"topology",
             "Makes a group a rectangle, or a group of single cells.",
             {id, optional("width", whole(1, model::max_extent)),
              optional("height", whole(1, model::max_extent)), optional("wrap_x", boolean(), false),
              optional("wrap_y", boolean(), false),
              optional("points", points, nullptr, "`[[x, y], ...]` of single cells")},
             &SystemEdit::topology},
            {"pattern",
             "Sets the pattern of a connection.",
             {id,
              {"pattern", any(),
               R"(`{"form": "mapped", "mapping": "center"}` or `"all"`, `{"form": "foreach"}`, each with )"
               R"(`source` and `target`; `{"form": "tuples", "tuples": [{"source": [[x, y]], "target": )"
               R"([[x, y]]}]}`; or `{"form": "weights", "file": "w.npy"}` with `list` and `text`)"}},
             &SystemEdit::pattern},
            {"wiring",
             "Sets which cells a connection joins, in plain words; its arborization becomes the default.",
             {id,
              {"wiring", text(),
               "`one to one`: the k-th cells of both groups; `all to all`; `nearest`: cells at the same "
               "relative places; `fitting`: `one to one` between groups of one shape, else `all to all`, or "
               "`nearest` for more than a million pairs"}},
             &SystemEdit::wiring},
            {"arborization",
             "Sets the arborization of a connection.",
             {id,
              {"arborization", any(),
               R"(`{"type": "ArbRect", "values": {"width": 3, "height": 3}}`, with the names of the file; )"
               "null is the default"}},
             &SystemEdit::arborization},
            {"attenuation",
             "Sets the attenuation of a connection.",
             {id, {"attenuation", any(), "as an arborization"}},
             &SystemEdit::attenuation},
            {"delay",
             "Sets the delay of a connection.",
             {id, {"delay", any(), "as an arborization"}},
             &SystemEdit::delay},
            {"port_groups",
             "Adds groups of the sizes that ports of the module of a process need, and leads the ports to "
             "them. Returns their ids.",
             {id, {"ports", list(text())}},
             &SystemEdit::port_groups},
            {"ports",
             "Leads ports of the module of a process to groups.",
             {id, optional("inputs", any(), nullptr, R"(`{"port": "id of a group"}`)"),
              optional("outputs", any())},
             &SystemEdit::ports},
            {"paste",
             "Adds what the command `copy` has returned.",
             {{"text", text()},
              optional("process", text(), "", "for groups and comments"),
              {"x", number(), "of the upper left corner"},
              place("y")},
             &SystemEdit::paste},
            {"import",
             "Adds a copy of the process of a file, under new ids.",
             {{"file", path(), "`.iqrProcess`"}},
             &SystemEdit::import},
            {"use_part",
             "Adds a process that uses a file. Its groups are those of the file, and are changed there.",
             {{"file", path(), "`.iqrProcess`"},
              optional("name", text(), "", "by default that in the file"),
              placed("x"),
              placed("y"),
              made},
             &SystemEdit::use_part},
            {"make_part",
             "Writes a process into a file, with ports for the groups that connections to other processes "
             "reach, and makes the system use the file. Runs give the same numbers if the ids of the "
             "process's groups and connections begin with that of the process and a point; the others get "
             "such ids, and are returned. Undo takes the use back, and leaves the file.",
             {id, {"file", path(), "`.iqrProcess`"}, optional("overwrite", boolean(), false)},
             &SystemEdit::make_part},
            {"dissolve",
             "Makes the content of a process that uses a file, and of the files that it uses, groups and "
             "connections of the system. Ids and numbers stay.",
             {id},
             &SystemEdit::dissolve},
            {"system",
             "Changes properties of the system.",
             {optional("name", text()), optional("author", text()), optional("date", text()),
              optional("note", text()), optional("port", text()), optional("sync_plots", boolean()),
              optional("cycles_per_second", number())},
             &SystemEdit::system_properties},
        };
    }();
    return all;
}

namespace {

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

}  // namespace

json carry_out(const json& operation, System& system, const Registry& registry, EditFiles& files) {
    check_characters(operation);
    return carry_out(system_operations(), operation, SystemEdit{system, registry, files});
}

}  // namespace forage::editing
