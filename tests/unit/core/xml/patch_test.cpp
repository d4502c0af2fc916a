// The text of a file stays its author's: an edit changes the lines of its item and nothing else.
#include "core/xml/patch.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <set>

#include "core/base/text_file.h"
#include "core/model/build.h"
#include "core/model/operations.h"
#include "core/xml/reader.h"
#include "core/xml/writer.h"
#include "neurons/neurons.h"
#include "synapses/synapses.h"
#include "tests/support/catch.h"
#include "tests/support/paths.h"

using namespace forage;
namespace fs = std::filesystem;

namespace {

std::vector<fs::path> all_systems() {
    std::vector<fs::path> out;
    for (const auto& folder : {test::source_dir() / "systems", test::shared_dir() / "original"})
        if (fs::exists(folder))
            for (const auto& entry : fs::recursive_directory_iterator(folder))
                if (entry.path().extension() == ".iqr") out.push_back(entry.path());
    std::ranges::sort(out);
    return out;
}

std::vector<std::string_view> lines(std::string_view text) {
    std::vector<std::string_view> out;
    while (!text.empty()) {
        const auto end = std::min(text.find('\n'), text.size() - 1);
        out.push_back(text.substr(0, end + 1));
        text.remove_prefix(end + 1);
    }
    return out;
}

bool is_subsequence(const std::vector<std::string_view>& part, const std::vector<std::string_view>& whole) {
    std::size_t i = 0;
    for (const auto& line : whole)
        if (i < part.size() && part[i] == line) ++i;
    return i == part.size();
}

/// Whether the texts differ only in the lines of the item.
bool only_in(const std::string& before, const std::string& after, const std::string& id) {
    const auto root = xml::scan(before);
    const auto place = xml::find_item(root, id);
    if (!place) return false;
    const std::size_t begin = xml::line_start(before, place->begin).begin;
    const auto end = std::min(before.find('\n', place->end), before.size());
    return after.starts_with(before.substr(0, begin)) && after.ends_with(before.substr(end)) &&
           after.size() >= begin + before.size() - end;
}

xml::Patch patch(const std::string& text, const model::System& before, const model::System& after,
                 const std::string& path = "test.iqr") {
    auto out = xml::patch(path, text, before, after);
    CHECK(out.extent == xml::Extent::least);
    REQUIRE(out.system);
    return out;
}

model::System read_text(const std::string& text, const std::string& path = "test.iqr") {
    Diagnostics diagnostics;
    auto out = xml::parse_system(path, text, diagnostics);
    INFO(format(diagnostics));
    REQUIRE(out);
    return *std::move(out);
}

std::string text_of(const std::string& text, const std::function<void(model::System&)>& edit) {
    const auto before = read_text(text);
    auto after = before;
    edit(after);
    return patch(text, before, after).text;
}

const std::string hand_written = R"(<?xml version="1.0"?>
<!-- by hand -->
<System name = 'Mine'   id="s">
  <!-- what it senses -->
  <Process name="Eye" id="p">
    <Group name='Light' id="g"><!-- nine cells -->
      <Topology>
        <!-- a row --> <TopologyRect vcount="01" hcount="9"/>
      </Topology>
      <Neuron name="neuronLinearThreshold">
        <Parameter value = "0.50" name = "threshold" /> <!-- from the paper -->
      </Neuron>
    </Group>
    <!-- what it does -->
    <Group id="h" name="Motor" color="#ff0000">
      <Topology><TopologyRect hcount="3" vcount="3"/></Topology><Neuron name="neuronRandomSpike"/>
    </Group>
  </Process>

  <Connection id="c" name="c" type="excitatory" source="g" target="h">
    <Pattern><PatternMapped/></Pattern>
    <Synapse name="synapseFixedWeight"/>
  </Connection>
</System>
)";

/// The edits of one item, each with a name.
struct Edit {
    std::string name;
    std::function<void(model::System&)> apply;
};

std::vector<Edit> edits_of_group(const std::string& id, const Registry& registry) {
    using namespace model;
    return {
        {"rename", [=](System& s) { rename(s, id, "A \"new\" <name> & more"); }},
        {"place", [=](System& s) { place(s, id, 17, -4); }},
        {"colour", [=](System& s) { set_color(s, id, "#123456"); }},
        {"note", [=](System& s) { set_note(s, id, "one line\nand <another>"); }},
        {"no note", [=](System& s) { set_note(s, id, ""); }},
        {"type",
         [=, &registry](System& s) { set_type(s, registry, id, Part::neuron, "neuronIntegrateFire"); }},
        {"parameter", [=](System& s) { set_parameter(s, id, "clip", "true"); }},
        {"new parameter", [=](System& s) { set_parameter(s, id, "another", "0.25"); }},
        {"defaults", [=](System& s) { find_group(s, id)->neuron.settings.clear(); }},
        {"rectangle",
         [=](System& s) {
             editable_group(s, id).topology = RectTopology{7, 5, true, false};
         }},
        {"sparse",
         [=](System& s) {
             editable_group(s, id).topology = SparseTopology{{{1, 1, {}}, {3, 2, {}}}};
         }},
        {"initial values",
         [=](System& s) {
             editable_group(s, id).neuron.initial = {{"act", "normal(0, 1)"}, {"vm", "", "cells.csv", "v"}};
         }},
    };
}

std::vector<Edit> edits_of_connection(const std::string& id, const Registry& registry) {
    using namespace model;
    const Region region{1, 1, 2, 1, {}};
    const List list{{{1, 1, {}}, {2, 1, {}}}, {}};
    return {
        {"rename", [=](System& s) { rename(s, id, "other"); }},
        {"kind", [=](System& s) { editable_connection(s, id).kind = InputKind::modulatory; }},
        {"line",
         [=](System& s) {
             set_line(s, id, {3, 12, std::vector<Point>{{10, 20, {}}, {30, 40, {}}}});
         }},
        {"straight",
         [=](System& s) {
             set_line(s, id, {{}, {}, std::vector<Point>{}});
         }},
        {"note", [=](System& s) { set_note(s, id, "why"); }},
        {"type",
         [=, &registry](System& s) { set_type(s, registry, id, Part::synapse, "synapseApicalShunt"); }},
        {"parameter", [=](System& s) { set_parameter(s, id, "weight", "0.125"); }},
        {"foreach",
         [=](System& s) {
             editable_connection(s, id).pattern = ForeachPattern{region, list};
         }},
        {"mapped",
         [=](System& s) {
             editable_connection(s, id).pattern = MappedPattern{true, All{}, region};
         }},
        {"mapped by default", [=](System& s) { editable_connection(s, id).pattern = MappedPattern{}; }},
        {"tuples",
         [=](System& s) {
             editable_connection(s, id).pattern = TuplesPattern{{{list.points, {{1, 1, {}}}}}};
         }},
        {"another tuple",
         [=](System& s) {
             auto& pattern = find_connection(s, id)->pattern;
             if (auto* tuples = std::get_if<TuplesPattern>(&pattern))
                 tuples->tuples.insert(tuples->tuples.begin() + 1, {list.points, {{1, 1, {}}}});
         }},
        {"weights",
         [=](System& s) {
             editable_connection(s, id).pattern = Weights{"w.csv", true};
         }},
        {"rows of weights",
         [=](System& s) {
             editable_connection(s, id).pattern = Weights{"", false, "1 2\n3 4\n"};
         }},
        {"ellipse",
         [=](System& s) {
             editable_connection(s, id).arborization = {EllipseArbor{3, 2}, Direction::projective, 0.5, {}};
         }},
        {"window",
         [=](System& s) {
             editable_connection(s, id).arborization = {RectWindowArbor{1, 1, 3, 3}, {}, 1, {}};
         }},
        {"random",
         [=](System& s) {
             editable_connection(s, id).arborization = {RandomArbor{2}, {}, 1, {}};
         }},
        {"attenuation",
         [=](System& s) {
             editable_connection(s, id).attenuation = {GaussianFunction{0, 1, 2}, {}};
         }},
        {"delay",
         [=](System& s) {
             editable_connection(s, id).delay = {UniformFunction{3}, {}};
         }},
        {"no delay", [=](System& s) { editable_connection(s, id).delay = {}; }},
    };
}

std::vector<Edit> edits_of_process(const std::string& id) {
    using namespace model;
    return {
        {"rename", [=](System& s) { rename(s, id, "other"); }},
        {"place", [=](System& s) { place(s, id, 5, 6); }},
        {"note", [=](System& s) { set_note(s, id, "why"); }},
        {"enabled",
         [=](System& s) { editable_process(s, id).module_enabled = !find_process(s, id)->module_enabled; }},
        {"module",
         [=](System& s) {
             find_process(s, id)->module =
                 ModuleUse{{"moduleX", {{"a", "1", {}, {}}}, {}, {}}, {{"in", "", {}}}, {}};
         }},
        {"no module", [=](System& s) { find_process(s, id)->module.reset(); }},
        {"no ports",
         [=](System& s) {
             if (auto& m = find_process(s, id)->module) m->inputs.clear(), m->outputs.clear();
         }},
    };
}

}  // namespace

TEST_CASE("a text without a change keeps its bytes") {
    for (const auto& file : all_systems()) {
        INFO(file.string());
        const auto text = read_file(file.string());
        const auto system = read_text(text, file.string());
        CHECK(xml::patched(text, system, system) == text);
        CHECK(xml::scan(text).whole.end <= text.size());
    }
}

TEST_CASE("an edit changes the lines of its item only, in every file", "[long]") {
    Registry registry;
    add_neurons(registry), add_synapses(registry);
    if (!test::absent(test::shared_dir() / "original")) CHECK(all_systems().size() > 15);
    for (const auto& file : all_systems()) {
        const auto text = read_file(file.string());
        const auto before = read_text(text, file.string());
        const auto attempt = [&](const std::string& id, const Edit& edit) {
            auto after = before;
            try {
                edit.apply(after);
            } catch (const std::invalid_argument& e) {  // a connection with weights may have no <Synapse>
                CHECK(std::string(e.what()).ends_with("has no synapse"));
                return;
            }
            const auto made = xml::patch(file.string(), text, before, after);
            if (made.extent == xml::Extent::least && only_in(text, made.text, id)) return;
            INFO(file.string() << " " << id << " " << edit.name << "\n" << format(made.diagnostics));
            CHECK(made.extent == xml::Extent::least);
            CHECK(only_in(text, made.text, id));
        };
        std::set<std::string> seen;  // one of each form is enough
        int left = 4;
        for (const auto& p : before.processes) {
            if (p.linked()) continue;
            for (const auto& e : edits_of_process(p.id)) attempt(p.id, e);
            for (const auto& g : p.groups)
                if (seen.insert(g.neuron.type).second || --left > 0)
                    for (const auto& e : edits_of_group(g.id, registry)) attempt(g.id, e);
        }
        for (const auto& c : before.connections)
            if (!c.linked &&
                (seen.insert(std::to_string(c.pattern.index()) + (c.synapse ? c.synapse->type : "")).second))
                for (const auto& e : edits_of_connection(c.id, registry)) attempt(c.id, e);
    }
}

TEST_CASE("what is added stands between lines that stay, and what is removed goes with its lines") {
    for (const auto& file : all_systems()) {
        INFO(file.string());
        const auto text = read_file(file.string());
        const auto before = read_text(text, file.string());
        const auto own = std::ranges::find_if(before.processes,
                                              [](const auto& p) { return !p.linked() && !p.groups.empty(); });
        if (own == before.processes.end()) continue;
        auto after = before;
        const auto p = model::add_process(after, "New");
        const auto g = model::add_group(after, p, "A", 2, 2, "neuronLinearThreshold");
        const auto h = model::add_group(after, own->id, "B", 2, 2, "neuronLinearThreshold");
        const auto c = model::add_connection(after, g, h, InputKind::inhibitory, "synapseFixedWeight");
        const auto more = patch(text, before, after, file.string());
        CHECK(is_subsequence(lines(text), lines(more.text)));
        const auto root = xml::scan(more.text);
        const auto of_c = *xml::find_item(root, c), of_h = *xml::find_item(root, h);
        CHECK(xml::item_around(root, of_c) == c);
        CHECK(xml::item_around(root, {of_c.begin + 1, of_c.begin + 2}) == c);
        CHECK(xml::item_around(root, {of_h.begin - 1, of_h.end}) == own->id);
        CHECK(xml::item_around(root, {of_h.begin, of_c.end}).empty());

        auto again = *more.system;
        for (const auto& id : {p, h}) model::remove(again, id);
        CHECK(patch(more.text, *more.system, again, file.string()).text == text);

        for (const auto& process : before.processes) {
            auto less = before;
            if (process.linked()) continue;
            model::remove(less, process.groups.empty() ? process.id : process.groups.front().id);
            const auto made = patch(text, before, less, file.string());
            // Cross references of a module to the group become empty, so their lines change.
            if (std::ranges::none_of(before.processes, [](const auto& q) { return q.module.has_value(); }))
                CHECK(is_subsequence(lines(made.text), lines(text)));
        }
    }
}

TEST_CASE("values, comments and blanks of what was not touched stay") {
    using namespace model;
    CHECK(text_of(hand_written, [](System& s) { set_parameter(s, "g", "threshold", "0.75"); }) == [] {
        auto t = hand_written;
        return t.replace(t.find("0.50"), 4, "0.75");
    }());
    const auto wrapped = text_of(hand_written, [](System& s) {
        editable_group(s, "g").topology = RectTopology{9, 1, true, false};
    });
    CHECK(wrapped.find(R"(<TopologyRect vcount="01" cylinderVert="true" hcount="9"/>)") != wrapped.npos);

    const auto removed = text_of(hand_written, [](System& s) { remove(s, "h"); });
    CHECK(removed.find("what it does") == removed.npos);  // the comment before it goes with it
    CHECK(removed.find("what it senses") != removed.npos);
    CHECK(removed.find("<Connection") == removed.npos);
    CHECK(removed.find("    </Group>\n  </Process>\n\n</System>") != removed.npos);

    const auto sparse = text_of(hand_written, [](System& s) {
        editable_group(s, "g").topology = SparseTopology{{{2, 1, {}}}};
    });
    CHECK(sparse.find("        <!-- a row --> <TopologySparse><Point x=\"2\" y=\"1\"/></TopologySparse>\n") !=
          sparse.npos);

    const auto added = text_of(hand_written, [](System& s) { add_group(s, "p", "New", 1, 1, "n", "new"); });
    CHECK(added.find(
              "    </Group>\n    <Group id=\"new\" name=\"New\">\n      <Topology>\n        <TopologyRect") !=
          added.npos);

    const auto unset =
        text_of(hand_written, [](System& s) { set_parameter(s, "g", "threshold", std::nullopt); });
    CHECK(unset.find("from the paper") != unset.npos);
    const auto synapse = text_of(hand_written, [](System& s) { set_parameter(s, "c", "weight", "2"); });
    CHECK(synapse.find("    <Synapse name=\"synapseFixedWeight\">\n      <Parameter name=\"weight\" "
                       "value=\"2\"/>\n    </Synapse>\n") != synapse.npos);
    const auto delayed = text_of(hand_written, [](System& s) {
        editable_connection(s, "c").delay = {UniformFunction{2}, {}};
    });
    CHECK(delayed.find("    <Pattern><PatternMapped/></Pattern>\n    <DelayFunction>\n") != delayed.npos);
}

TEST_CASE("line ends of Windows and files on one line stay what they are") {
    using namespace model;
    std::string windows;
    for (const char c : hand_written) windows += c == '\n' ? "\r\n" : std::string(1, c);
    const auto added = text_of(windows, [](System& s) { add_group(s, "p", "New", 1, 1, "n", "new"); });
    for (std::size_t i = 0; i < added.size(); ++i)
        if (added[i] == '\n') CHECK(added[i - 1] == '\r');

    const std::string one = R"(<System id="s" name="s"><Process id="p" name="P"/></System>)";
    const auto group = text_of(one, [](System& s) { add_group(s, "p", "G", 1, 1, "n", "g"); });
    CHECK(std::ranges::count(group, '\n') == 0);
    CHECK(read_text(group).processes.front().groups.size() == 1);
    const auto first =
        text_of("<System id=\"s\" name=\"s\"/>\n", [](System& s) { add_process(s, "P", "p"); });
    CHECK(first.starts_with(
        "<System id=\"s\" name=\"s\">\n    <Process id=\"p\" name=\"P\" enableModule=\"true\"/>\n</System>"));
}

TEST_CASE("a comment at the end of a line belongs to what stands before it there") {
    const std::string text = R"(<System id="s" name="s"> <!-- of the system -->
    <Process id="p" name="P"/> <!-- of P -->
    <!-- of Q -->
    <Process id="q" name="Q"/>
</System>
)";
    const auto without = [&](const char* id) {
        return text_of(text, [&](model::System& s) { model::remove(s, id); });
    };
    CHECK(without("q") ==
          "<System id=\"s\" name=\"s\"> <!-- of the system -->\n    <Process id=\"p\" name=\"P\"/> <!-- of P "
          "-->\n</System>\n");
    CHECK(without("p").find("<!-- of the system -->") != std::string::npos);
}

TEST_CASE("a comment before an item that is pasted or removed belongs to it") {
    const auto before = read_text(hand_written);
    const auto copied = model::copy(before, std::vector<std::string>{"h"});
    auto after = before;
    const auto ids = model::paste(after, read_text(xml::write_system(copied)), "p", 5, 5);
    REQUIRE(ids.size() == 1);
    const auto made = patch(hand_written, before, after);
    CHECK(made.text.find("<!-- what it does -->\n    <Group id=\"" + ids.front() + "\"") != made.text.npos);
    CHECK(is_subsequence(lines(hand_written), lines(made.text)));
}

TEST_CASE("comments on a page come, change and go without another byte") {
    using namespace model;
    const auto before = read_text(hand_written);
    auto after = before;
    const auto id = add_canvas_comment(after, "p", {"", "two\nlines", "", {1, 2, 30, 40}, {}});
    const auto of_system = add_canvas_comment(after, {}, {"", "all", "", {5, 6, 30, 40}, {}});
    const auto added = patch(hand_written, before, after);
    INFO(added.text);
    CHECK(is_subsequence(lines(hand_written), lines(added.text)));
    CHECK(added.text.find(
              "    </Group>\n    <!-- forage:comment id=\"" + id +
              "\" x=\"1\" y=\"2\" width=\"30\" height=\"40\" text=\"two\nlines\" -->\n  </Process>") !=
          std::string::npos);

    // What its author wrote in another way keeps that, apart from what changes.
    std::string mine = hand_written;
    mine.insert(
        mine.find("    <Group id=\"h\""),
        "    <!--forage:comment text='old &amp; good'\n   id='x' x = '1'\ty='2' height='4' width='3'-->\n");
    const auto moved = text_of(mine, [](System& s) { place(s, "x", 7, 2); });
    CHECK(moved == std::string(mine).replace(mine.find("x = '1'"), 7, "x = '7'"));
    const auto coloured = text_of(mine, [](System& s) { set_color(s, "x", "#ff0000"); });
    std::string wanted = mine;
    CHECK(coloured == wanted.insert(wanted.find("height='4'") + 10, " color=\"#ff0000\""));
    const auto said = text_of(mine, [](System& s) { set_comment(s, "x", {.text = "it's new"}); });
    CHECK(read_text(said).processes[0].canvas_comments[0].text == "it's new");
    CHECK(text_of(mine, [](System& s) { remove(s, "x"); }) == hand_written);
    // It is not a remark about the group after it.
    CHECK(text_of(mine, [](System& s) { remove(s, "h"); }).find("forage:comment") != std::string::npos);

    auto less = *added.system;
    remove(less, id), remove(less, of_system);
    CHECK(patch(added.text, *added.system, less).text == hand_written);
}

TEST_CASE("phantoms are placed and lines bent on each page without another byte") {
    using namespace model;
    auto base = read_text(hand_written);
    const auto before_q = base;
    const auto q = add_process(base, "Q");
    const auto g = add_group(base, q, "G", 1, 1, "neuronLinearThreshold");
    const auto c = add_connection(base, g, "h", InputKind::excitatory, "synapseFixedWeight");
    const auto start = patch(hand_written, before_q, base);
    auto after = *start.system;
    place_phantom(after, "p", g, 3, -4);
    set_line(after, c,
             {.vertices = std::vector<Point>{{1, 1, {}}},
              .target_vertices = std::vector<Point>{{2, 2, {}}, {3, 3, {}}}});
    const auto placed = patch(start.text, *start.system, after);
    CHECK(placed.text.find("<!-- forage:phantom group=\"" + g + "\" x=\"3\" y=\"-4\" -->") !=
          std::string::npos);
    CHECK(placed.text.find("<!-- forage:vertices page=\"target\" points=\"2,2 3,3\" -->") !=
          std::string::npos);
    auto moved = *placed.system;
    place_phantom(moved, "p", g, 30, -4);
    set_line(moved, c, {.source_vertices = std::vector<Point>{{9, 9, {}}}});
    const auto there = patch(placed.text, *placed.system, moved);
    CHECK(there.text.find("x=\"30\" y=\"-4\"") != std::string::npos);
    auto back = *there.system;
    place_phantom(back, "p", g, 3, -4);
    set_line(back, c, {.source_vertices = std::vector<Point>{}});
    CHECK(patch(there.text, *there.system, back).text == placed.text);
    remove(back, c);  // with it, the phantom is not shown any more
    CHECK(back.processes[0].phantoms.empty());
}
