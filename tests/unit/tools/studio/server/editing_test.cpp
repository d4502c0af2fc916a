// Editing a system in the studio, without sockets.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>

#include <fmt/format.h>
#include <unistd.h>

#include "core/base/text_file.h"
#include "tests/support/catch.h"
#include "tests/support/studio_protocol.h"
#include "tools/studio/server/session.h"

namespace {

using namespace forage;
using namespace forage::studio;
namespace fs = std::filesystem;

/// A session that edits a copy of a system in a folder of its own.
struct Editor {
    fs::path folder = fs::temp_directory_path() / ("forage-editing-test-" + std::to_string(::getpid()));
    std::string file = (folder / "mine.iqr").string();
    std::map<std::string, json> last;  ///< the last message of each type
    std::optional<Session> session;

    explicit Editor(const std::string& system, const std::vector<std::string>& world_and_others) {
        open(system, world_and_others);
    }
    explicit Editor(const std::string& system = "reactive_foraging.iqr", bool world = true) {
        open(system, world ? std::vector<std::string>{FORAGE_SOURCE_DIR "/systems/worlds/basic_arena.world"}
                           : std::vector<std::string>());
    }
    /// Opens a copy of a system that comes with Forage, in a world if one is named first, with the systems
    /// that are named after it.
    void open(const std::string& system, const std::vector<std::string>& world_and_others) {
        fs::create_directories(folder);
        ::setenv("XDG_STATE_HOME", folder.c_str(), 1);
        fs::copy_file(FORAGE_SOURCE_DIR "/systems/" + system, file, fs::copy_options::overwrite_existing);
        if (system == "team_a.iqr")  // the brain of its robots
            fs::copy_file(FORAGE_SOURCE_DIR "/systems/team_robot.iqrProcess",
                          folder / "team_robot.iqrProcess", fs::copy_options::overwrite_existing);
        RunInput input;
        input.system = file;
        if (!world_and_others.empty()) {
            input.world = world_and_others.front();
            input.more.assign(world_and_others.begin() + 1, world_and_others.end());
        }
        session.emplace(input, [this](int, bool binary, std::string data) {
            if (binary) return;
            json message = json::parse(data);
            test::check_message(message);
            const auto type = message["type"].get<std::string>();
            last[type] = std::move(message);
        });
        session->connect(1);
    }
    ~Editor() { fs::remove_all(folder); }

    json ask(const json& command) {
        const json reply = session->execute(1, command);
        test::check_reply(command, reply);
        return reply;
    }
    json result(const json& command) {
        const json reply = ask(command);
        INFO(command.dump() << "\n" << reply.dump(1));
        REQUIRE(reply["ok"] == true);
        return reply.value("result", json());
    }
    json edit(const json& operations) {
        return result({{"command", "edit"}, {"operations", operations}})["ids"];
    }
    std::string text() { return result({{"command", "document"}})["text"]; }
    std::string content() const { return read_file(file); }
    json group(const std::string& id) {
        for (const auto& p : last["system"]["processes"])
            for (const auto& g : p["groups"])
                if (g["id"] == id) return g;
        return nullptr;
    }
};

}  // namespace

TEST_CASE("a system is edited, undone and saved, and its text stays its author's") {
    Editor e;
    const std::string before = e.content();
    CHECK(e.text() == before);
    CHECK(e.last["document"]["dirty"] == false);
    const auto process = e.last["system"]["processes"][0]["id"].get<std::string>();
    const auto other = e.last["system"]["processes"][0]["groups"][0]["id"].get<std::string>();

    const auto ids = e.edit({{{"do", "add_group"},
                              {"process", process},
                              {"name", "New"},
                              {"x", 10},
                              {"y", 20.4},
                              {"width", 3},
                              {"id", "new"}},
                             {{"do", "add_connection"},
                              {"source", "new"},
                              {"target", other},
                              {"kind", "inhibitory"},
                              {"source_anchor", 3},
                              {"vertices", {{1, 2}}}}});
    CHECK(ids[0] == "new");
    CHECK(e.group("new")["icon"]["y"] == 20);
    CHECK(e.group("new")["cells"] == 3);
    CHECK(e.last["document"]["dirty"] == true);
    CHECK(e.last["document"]["running_is_current"] == true);
    CHECK(e.last["action"]["title"] == "add New and 1 more");
    CHECK(e.content() == before);  // not saved yet

    e.edit({{{"do", "rename"}, {"id", "new"}, {"name", "Newer"}}});
    e.edit({{{"do", "place"}, {"id", "new"}, {"x", 100}, {"y", 100}}});
    CHECK(e.result({{"command", "read"}, {"source", e.group("new")["path"]}})["columns"] == 3);
    e.result({{"command", "save"}});
    CHECK(e.content() == e.text());
    CHECK(e.last["document"]["dirty"] == false);

    for (int i = 0; i < 3; ++i) e.result({{"command", "undo"}});
    CHECK(e.text() == before);
    CHECK(e.group("new").is_null());
    CHECK(e.last["document"]["dirty"] == true);
    CHECK(e.session->status()["undo"].is_null());
    e.result({{"command", "redo"}});
    CHECK(e.group("new")["name"] == "New");
    e.edit({{{"do", "remove"}, {"ids", {"new", ids[1]}}}});
    CHECK(e.text() == before);
}

TEST_CASE("steps of a drag join to one, and operations are done all or not at all") {
    Editor e;
    const auto before = e.text();
    const auto group = e.last["system"]["processes"][0]["groups"][0]["id"];
    for (int x = 0; x < 5; ++x)
        e.result({{"command", "edit"},
                  {"merge", "drag 1"},
                  {"operations", {{{"do", "place"}, {"id", group}, {"x", x}, {"y", 0}}}}});
    e.result({{"command", "undo"}});
    CHECK(e.text() == before);

    const json reply = e.ask({{"command", "edit"},
                              {"operations",
                               {{{"do", "rename"}, {"id", group}, {"name", "A"}},
                                {{"do", "rename"}, {"id", "nothing"}, {"name", "B"}}}}});
    CHECK(reply["ok"] == false);
    CHECK(reply["problems"][0]["message"] ==
          "there is no process, group or connection with the id 'nothing'");
    CHECK(e.text() == before);
    const json wrong =
        e.ask({{"command", "edit"},
               {"operations", {{{"do", "topology"}, {"id", group}, {"width", 0}, {"height", 1}}}}});
    CHECK(wrong["ok"] == false);
    CHECK(e.text() == before);
}

TEST_CASE("a parameter changes the run and the file, however it is set, and is undone in both") {
    Editor e;
    const auto before = e.text();
    const auto threshold = [&] {
        const json all = e.result({{"command", "parameters"}, {"item", "Bug/Light"}});
        for (const auto& p : all["parameters"])
            if (p["name"] == "threshold") return p;
        return json();
    };
    const double loaded = threshold()["value"];
    const auto id = e.result({{"command", "parameters"}, {"item", "Bug/Light"}})["id"];
    e.result({{"command", "set"}, {"assignments", {"Bug/Light.threshold=0.125"}}});
    CHECK(e.text().find("value=\"0.125\"") != std::string::npos);
    e.edit({{{"do", "parameter"}, {"id", id}, {"name", "threshold"}, {"value", "0.25"}}});
    CHECK(threshold()["value"] == 0.25);
    CHECK(threshold()["loaded"] == loaded);
    CHECK(e.last["action"]["command"] == "set");
    CHECK(e.last["action"]["values"]["Bug/Light.threshold"] == "0.25");
    e.result({{"command", "undo"}});
    CHECK(threshold()["value"] == 0.125);
    e.result({{"command", "undo"}});
    CHECK(threshold()["value"] == loaded);
    CHECK(e.text() == before);
    e.result({{"command", "redo"}}), e.result({{"command", "redo"}});
    CHECK(threshold()["value"] == 0.25);
    e.result({{"command", "stop"}});
    CHECK(threshold()["value"] == 0.25);
    e.result({{"command", "save"}});
    CHECK(threshold()["loaded"] == 0.25);
}

TEST_CASE("a parameter is edited and undone whatever its item and other items are called") {
    Editor e("team_a.iqr",
             {FORAGE_SOURCE_DIR "/systems/worlds/team_arena.world", FORAGE_SOURCE_DIR "/systems/team_b.iqr"});
    const auto check = [&](const std::string& id, const std::string& parameter, const std::string& value) {
        const auto now = [&] {
            const json run = e.result({{"command", "parameters"}, {"item", id}})["parameters"];
            const json file = e.result({{"command", "item"}, {"item", id}})["parameters"];
            for (std::size_t i = 0; i < run.size(); ++i) {
                CHECK(run[i]["assignment"] == file[i]["assignment"]);
                if (run[i]["name"] == parameter) return run[i];
            }
            return json();
        };
        const json before = now();
        INFO(before.dump());
        e.edit({{{"do", "parameter"}, {"id", id}, {"name", parameter}, {"value", value}}});
        CHECK(now()["value"].dump() == value);
        CHECK(e.last["action"]["command"] == "set");
        CHECK(e.last["action"]["values"][before["assignment"].get<std::string>()] == value);
        CHECK(e.session->status()["undo"].get<std::string>().find(parameter) != std::string::npos);
        const auto assignment =
            fmt::format("{}={}", before["assignment"].get<std::string>(), before["value"].dump());
        e.result({{"command", "set"}, {"assignments", {assignment}}});
        CHECK(now()["value"] == before["value"]);
        for (int i = 0; i < 2; ++i) e.result({{"command", "undo"}});
        CHECK(now()["value"] == before["value"]);
    };
    const auto rename = [&](const std::string& id, const std::string& name) {
        e.edit({{{"do", "rename"}, {"id", id}, {"name", name}}});
    };
    const auto process =
        e.edit({{{"do", "add_process"}, {"name", "P=1"}, {"x", 0}, {"y", 0}}})[0].get<std::string>();
    const auto group =
        e.edit({{{"do", "add_group"}, {"process", process}, {"name", "A=B"}, {"x", 0}, {"y", 0}}})[0]
            .get<std::string>();
    check(group, "excGain", "0.5");
    rename("a1.bug", "A=1"), check("a1.bug", "transSpeed", "0.5");
    rename("a1.bug", "A_1"), check("a1.bug", "transSpeed", "0.25");
    rename("a1.bug", "B_1 Bug"), check("a1.bug", "transSpeed", "0.25");
    rename("a1.c.head-homing", "B_1 Head to Homing"), check("a1.c.head-homing", "weight", "0.25");
}

TEST_CASE("a parameter of a module that is switched off is edited without a run of it") {
    Editor e("team_a.iqr", std::vector<std::string>{FORAGE_SOURCE_DIR "/systems/worlds/team_arena.world"});
    e.edit({{{"do", "set"}, {"id", "a1.bug"}, {"property", "enabled"}, {"value", false}}});
    e.edit({{{"do", "parameter"}, {"id", "a1.bug"}, {"name", "transSpeed"}, {"value", "0.5"}}});
    CHECK(e.last["document"]["running_is_current"] == true);
    e.edit({{{"do", "set"}, {"id", "a1.bug"}, {"property", "enabled"}, {"value", true}}});
    CHECK(e.result({{"command", "parameters"}, {"item", "a1.bug"}}).dump().find("\"value\":0.5") !=
          std::string::npos);
}

TEST_CASE("a system that cannot run is edited on, and the last run that could continues") {
    Editor e;
    const auto cells = e.last["system"]["processes"][0]["groups"][0];
    e.edit({{{"do", "type"}, {"id", cells["id"]}, {"part", "neuron"}, {"type", "neuronRandomSpike"}},
            {{"do", "parameter"}, {"id", cells["id"]}, {"name", "probabilty"}, {"value", "0.5"}}});
    CHECK(e.last["document"]["running_is_current"] == false);
    REQUIRE(e.last["document"]["problems"].size() >= 1);
    const json problem = e.last["document"]["problems"][0];
    CHECK(problem["item"] == cells["id"]);
    CHECK(problem["severity"] == "error");
    CHECK(problem["line"].get<int>() > 1);
    e.result({{"command", "step"}});
    e.edit({{{"do", "parameter"}, {"id", cells["id"]}, {"name", "probabilty"}, {"value", nullptr}}});
    CHECK(e.last["document"]["running_is_current"] == true);
}

TEST_CASE("a constant changes the run and the file, and is undone in both") {
    Editor e;
    std::string text = e.content();
    text.insert(text.find('<', text.find("<System") + 1), "<Constant name=\"gain\" value=\"2\"/>\n  ");
    const std::string light = "<Neuron name=\"neuronLinearThreshold\"";
    const auto at = text.find(light, text.find("id=\"bug.light\""));
    text.replace(at, text.find('>', at) + 1 - at,
                 light + "><Parameter name=\"excGain\" value=\"{gain / 2}\"/></Neuron>");
    std::ofstream(e.file) << text;
    e.result({{"command", "open"},
              {"system", e.file},
              {"world", FORAGE_SOURCE_DIR "/systems/worlds/basic_arena.world"}});
    REQUIRE(e.last["document"]["running_is_current"] == true);
    const auto gain = [&] {
        const json all = e.result({{"command", "parameters"}, {"item", "Bug/Light"}});
        for (const auto& p : all["parameters"])
            if (p["name"] == "excGain") return p["value"];
        return json();
    };
    const auto before = e.text();
    CHECK(gain() == 1);
    e.result({{"command", "step"}});
    e.result({{"command", "set"}, {"assignments", {"gain=3"}}});
    CHECK(gain() == 1.5);
    CHECK(e.text().find("name=\"gain\" value=\"3\"") != std::string::npos);
    CHECK(e.text().find("{gain / 2}") != std::string::npos);
    CHECK(e.ask({{"command", "set"}, {"assignments", {"gain=much"}}})["ok"] == false);
    e.result({{"command", "undo"}});
    CHECK(gain() == 1);
    CHECK(e.text() == before);
}

TEST_CASE("forms have the constants, equations and weights that the file declares") {
    Editor e;
    const std::string text = R"(<System id="s" name="S" cylesPerSecond="10">
  <Constant name="n" value="3"/>
  <Constant name="rate" value="2" minimum="0" maximum="4" unit="1/s" doc="How fast."/>
  <Constant name="half" value="{rate / 2}"/>
  <NeuronType name="leaky" doc="Leaks.">
    <Equations>
      u = exc - x             # the input
      dx/dt = rate * (u
                      + 0)
      when x' &lt; 0: x' = 0, y' = 1
      output x
    </Equations>
  </NeuronType>
  <SynapseType name="fading"><Equations>weight' = 0.5 * weight; output psp = weight' * pre'</Equations></SynapseType>
  <Process id="p" name="P">
    <Constant name="own" value="5"/>
    <Group id="a" name="A"><Topology><TopologyRect hcount="{n}" vcount="1"/></Topology><Neuron name="leaky"/></Group>
    <Group id="b" name="B"><Topology><TopologyRect hcount="300" vcount="1"/></Topology><Neuron name="neuronNumeric"/></Group>
  </Process>
  <Connection id="c" name="C" source="a" target="a"><Weights>1 nan 3
    nan nan nan
    4 5 -6</Weights></Connection>
  <Connection id="d" name="D" source="b" target="b">
    <Weights form="list">0 0 -1
      1 1 3
      299 0 7</Weights>
    <Synapse name="fading"/></Connection>
</System>)";
    std::ofstream(e.file) << text;
    e.result({{"command", "open"}, {"system", e.file}});
    REQUIRE(e.last["document"]["running_is_current"] == true);

    const auto constant = [&](const std::string& name) {
        const json form = e.result({{"command", "item"}, {"item", "system"}});
        for (const auto& c : form["constants"])
            if (c["name"] == name) return c;
        return json();
    };
    CHECK(constant("rate")["high"] == 4);
    CHECK(constant("rate")["value"] == 2);
    CHECK(constant("half")["formula"] == "{rate / 2}");
    CHECK(constant("P.own")["value"] == 5);
    CHECK(e.result({{"command", "item"}, {"item", "p"}})["constants"].size() == 1);
    e.result({{"command", "set"}, {"assignments", {"rate=3"}}});
    CHECK(constant("rate")["loaded"] == 2);
    CHECK(constant("half")["value"] == 1.5);
    CHECK(constant("half")["loaded"] == "{rate / 2}");
    e.result({{"command", "set"}, {"assignments", {"half={rate / 4}"}}});
    CHECK(constant("half")["value"] == 0.75);
    CHECK(e.ask({{"command", "set"}, {"assignments", {"n=4"}}})["problems"][0]["message"] ==
          "'n=4': more than parameters depends on this constant");

    const json group = e.result({{"command", "item"}, {"item", "a"}});
    CHECK(group["parameters"][0]["formula"] == "{rate}");
    CHECK(group["parameters"][0]["value"] == 3);
    const json& equations = group["declaration"]["equations"];
    REQUIRE(equations.size() == 5);
    CHECK(group["declaration"]["doc"] == "Leaks.");
    CHECK(equations[0]["text"] == "u = exc - x             # the input");
    CHECK(equations[1]["computes"] == json{"x"});
    CHECK(equations[1]["line"] == 8);
    CHECK(equations[2]["computes"].empty());
    CHECK(equations[3]["text"] == "when x' < 0: x' = 0, y' = 1");
    CHECK(equations[3]["computes"] == json{"x", "y"});
    CHECK(e.result({{"command", "item"}, {"item", "b"}})["declaration"].is_null());

    CHECK(e.last["system"]["connections"][0]["fixed_weights"] == true);
    CHECK(e.last["system"]["connections"][1]["fixed_weights"] == false);
    const auto sampled = [&](const char* source) {  // as a page reads it
        return json::parse(e.result({{"command", "read"}, {"source", source}}).dump());
    };
    const json matrix = sampled("sampled(C)");
    CHECK(matrix["rows"] == 3);
    CHECK(matrix["values"] == json{1, nullptr, 3, nullptr, nullptr, nullptr, 4, 5, -6});
    const json large = sampled("sampled(D:weight)");
    CHECK(large["rows"] == 150);
    CHECK(large["columns"] == 150);
    CHECK(large["values"][0] == 1);
    CHECK(large["values"][1].is_null());
    CHECK(large["values"][149] == 7);
    CHECK(sampled("sampled(D)")["values"] == large["values"]);
    for (const char* wrong : {"sampled(P/A)", "sampled(E)", "sampled(D:none)"})
        CHECK(e.ask({{"command", "read"}, {"source", wrong}})["ok"] == false);
}

TEST_CASE("a file whose system cannot run is opened to be corrected") {
    Editor e;
    std::string text = e.content();
    const auto at = text.find("\"neuronLinearThreshold\"");
    std::ofstream(e.file) << text.replace(at, 23, "\"neuronLinearTreshold\"");
    e.result({{"command", "open"},
              {"system", e.file},
              {"world", FORAGE_SOURCE_DIR "/systems/worlds/basic_arena.world"}});
    CHECK(e.last["document"]["running_is_current"] == false);
    const json problem = e.last["document"]["problems"][0];
    CHECK(problem["item"] == "bug.motor");
    CHECK(e.last["system"]["processes"].size() == 3);
    e.result({{"command", "step"}});
    e.edit(
        {{{"do", "type"}, {"id", problem["item"]}, {"part", "neuron"}, {"type", "neuronLinearThreshold"}}});
    CHECK(e.last["document"]["running_is_current"] == true);
    CHECK(e.last["document"]["opened_with_mistakes"] == false);
    CHECK(e.last["world"]["robots"].size() == 1);
}

TEST_CASE("a file that is not even XML is opened, corrected in its text, and runs") {
    Editor e;
    const std::string sound = e.content();
    const auto at = sound.find("</Group>");
    const std::string broken = sound.substr(0, at) + "</Grup>" + sound.substr(at + 8);
    std::ofstream(e.file) << broken;
    e.result({{"command", "open"},
              {"system", e.file},
              {"world", FORAGE_SOURCE_DIR "/systems/worlds/basic_arena.world"}});
    CHECK(e.last["document"]["readable"] == false);
    CHECK(e.last["document"]["opened_with_mistakes"] == true);
    CHECK(e.last["document"]["running_is_current"] == false);
    CHECK(e.last["document"]["dirty"] == false);
    CHECK(e.last["system"]["processes"].empty());
    REQUIRE(e.last["document"]["problems"].size() == 1);
    const json problem = e.last["document"]["problems"][0];
    CHECK(problem["line"] == 1 + std::count(broken.begin(), broken.begin() + static_cast<long>(at), '\n'));
    CHECK(problem["file"] == e.file);
    CHECK(e.text() == broken);

    // What is not the text is refused, and nothing stops.
    for (const json& command :
         {json{{"command", "edit"}, {"operations", {{{"do", "system"}, {"name", "x"}}}}},
          json{{"command", "item_text"}, {"item", "bug"}, {"text", "<Process/>"}},
          json{{"command", "item_check"}, {"item", "bug"}, {"text", "<Process/>"}},
          json{{"command", "export"}, {"process", "bug"}, {"file", (e.folder / "x.iqrProcess").string()}}}) {
        const json reply = e.ask(command);
        INFO(command.dump());
        CHECK(reply["ok"] == false);
        CHECK(reply["problems"][0]["hint"].get<std::string>().find("correct") != std::string::npos);
    }
    e.result({{"command", "step"}, {"cycles", 3}});
    e.result({{"command", "stop"}});

    // A text that is still wrong is saved as its author wrote it.
    const auto write = [&](const std::string& text) {
        e.result({{"command", "text_edit"}, {"text", text}, {"merge", "m"}});
    };
    write(broken + "<!-- mine -->\n");
    CHECK(e.last["document"]["problems"][0] == problem);
    e.result({{"command", "save"}});
    CHECK(e.content() == broken + "<!-- mine -->\n");
    e.result({{"command", "stop"}});

    write(sound + "<!-- mine -->\n");
    CHECK(e.last["document"]["problems"].empty());
    CHECK(e.last["document"]["running_is_current"] == true);
    CHECK(e.last["document"]["opened_with_mistakes"] == false);
    CHECK(e.last["system"]["processes"].size() == 3);
    CHECK(e.last["world"]["robots"].size() == 1);
    e.session->work(10);
    CHECK(e.last["status"]["cycle"] == 0);
    e.result({{"command", "step"}});
    e.result({{"command", "stop"}});
    CHECK(e.last["system"]["processes"].size() == 3);
    e.result({{"command", "save"}});
    CHECK(e.content() == sound + "<!-- mine -->\n");

    // Both texts were one step, which is undone and done again; the run of the sound text continues
    // meanwhile.
    e.result({{"command", "undo"}});
    CHECK(e.text() == broken);
    CHECK(e.last["document"]["readable"] == false);
    CHECK(e.last["document"]["opened_with_mistakes"] == false);
    CHECK(e.last["system"]["processes"].size() == 3);
    e.result({{"command", "step"}});
    e.result({{"command", "save"}});
    e.result({{"command", "stop"}});  // the file has mistakes now; what runs has none
    CHECK(e.last["system"]["processes"].size() == 3);
    e.result({{"command", "redo"}});
    CHECK(e.text() == sound + "<!-- mine -->\n");
    CHECK(e.last["document"]["running_is_current"] == true);
}

TEST_CASE("a session begins with a file that has mistakes, and keeps what it was asked for") {
    Editor e;
    const std::string sound = e.content();
    std::ofstream(e.file) << "<System \xff";
    e.session.reset();
    RunInput input;
    input.system = e.file;
    input.world = FORAGE_SOURCE_DIR "/systems/worlds/basic_arena.world";
    input.settings.push_back({"Bug/Motor.threshold=0.25"});
    const auto send = [&](int, bool binary, const std::string& data) {
        if (binary) return;
        json message = json::parse(data);
        e.last[message["type"].get<std::string>()] = message;
    };
    e.session.emplace(input, send);
    CHECK(e.session->mistakes().errors() == 1);
    e.session->keep();
    e.session->connect(1);
    e.result({{"command", "text_edit"}, {"text", "<System"}});
    CHECK(e.last["document"]["opened_with_mistakes"] == true);
    e.session->work(100), e.session->work(200);

    // It is killed, and continues as it was.
    e.session.reset();
    e.session.emplace(input, send);
    e.session->keep();
    e.session->connect(1);
    e.session->recover();
    CHECK(e.text() == "<System");
    e.result({{"command", "text_edit"}, {"text", sound}});
    CHECK(e.last["document"]["running_is_current"] == true);
    CHECK(e.session->mistakes().errors() == 0);
    const json parameters = e.result({{"command", "parameters"}, {"item", "Bug/Motor"}})["parameters"];
    const auto threshold =
        std::ranges::find_if(parameters, [](const json& p) { return p["name"] == "threshold"; });
    CHECK((*threshold)["value"] == 0.25);
    e.session->end();

    // What cannot be corrected in the text is an error, as before.
    std::ofstream(e.file) << sound;
    input.settings = {{"Bug/Nothing.threshold=0.25"}};
    CHECK_THROWS_AS(Session(input, send), InputError);
    input.settings.clear();
    input.system = (e.folder / "none.iqr").string();
    CHECK_THROWS_AS(Session(input, send), InputError);
    input.system = e.file, input.world = (e.folder / "none.world").string();
    CHECK_THROWS_AS(Session(input, send), InputError);
}

TEST_CASE("a system that is corrected shows the plots that it was begun with") {
    Editor e;
    const std::string sound = e.content();
    std::ofstream(e.file) << "<System";
    const std::string plots = (e.folder / "mine.conf").string();
    std::ofstream(plots) << R"(<iqrDataManagerConfiguration><DataClient type="PlotTypeGroup" ID="x">
<Position x="1" y="1"/><StateVariableDisplay><StateVariableDisplays ID="1" itemID="bug.motor" indices="">
<Average>false</Average><SelectedStates>act;</SelectedStates></StateVariableDisplays></StateVariableDisplay>
</DataClient></iqrDataManagerConfiguration>
)";
    e.session.reset();
    RunInput input;
    input.system = e.file;
    input.world = FORAGE_SOURCE_DIR "/systems/worlds/basic_arena.world";
    const auto send = [&](int, bool binary, const std::string& data) {
        if (binary) return;
        json message = json::parse(data);
        e.last[message["type"].get<std::string>()] = message;
    };
    e.session.emplace(input, send, plots);
    e.session->connect(1);
    CHECK(e.last["hello"]["layout"]["plots"].empty());
    e.result({{"command", "text_edit"}, {"text", sound}});
    CHECK(e.last["document"]["running_is_current"] == true);
    e.session->connect(2);
    REQUIRE(e.last["hello"]["layout"]["plots"].size() == 1);
    CHECK(e.last["hello"]["layout"]["plots"][0]["item"] == "Bug/Motor");
}

TEST_CASE("a system that is corrected runs in the world and with the seed that were chosen meanwhile") {
    Editor e;
    const std::string sound = e.content();
    std::ofstream(e.file) << "<System";
    e.result({{"command", "open"},
              {"system", e.file},
              {"world", FORAGE_SOURCE_DIR "/systems/worlds/basic_arena.world"}});
    const std::string world = (e.folder / "mine.world").string();
    ::setenv("FORAGE_MODEL_PATH", FORAGE_SOURCE_DIR "/systems/worlds/models", 1);
    e.result({{"command", "world_edit"},
              {"operations", {{{"do", "add"}, {"kind", "pillar"}, {"x", 1}, {"y", 1}}}}});
    e.result({{"command", "world_save"}, {"file", world}});
    e.result({{"command", "restart"}, {"seed", 7}});
    e.result({{"command", "text_edit"}, {"text", sound}});
    CHECK(e.last["document"]["running_is_current"] == true);
    CHECK(e.last["world"]["file"] == world);
    e.result({{"command", "stop"}});
    e.session->work(10);
    CHECK(e.last["status"]["seed"] == 7);
}

TEST_CASE("a text that was begun before another system was opened does not replace this one") {
    Editor e;
    const json begun = e.result({{"command", "document"}});
    const std::string other = (e.folder / "other.iqr").string();
    fs::copy_file(FORAGE_SOURCE_DIR "/systems/dac_foraging.iqr", other);
    e.result({{"command", "open"},
              {"system", other},
              {"world", FORAGE_SOURCE_DIR "/systems/worlds/basic_arena.world"}});
    const std::string text = e.text();
    const json reply = e.ask({{"command", "text_edit"},
                              {"text", begun["text"].get<std::string>() + "<!-- more -->"},
                              {"generation", begun["generation"]}});
    CHECK(reply["ok"] == false);
    CHECK(reply["conflict"] == true);
    CHECK(e.text() == text);
}

TEST_CASE("the text of an item is checked as it is written, line by line") {
    Editor e;
    const auto item = e.result({{"command", "item"}, {"item", "bug.motor"}});
    const auto text = item["text"].get<std::string>();
    const auto check = [&](const std::string& draft) {
        return e.result({{"command", "item_check"}, {"item", "bug.motor"}, {"text", draft}})["problems"];
    };
    const auto with = [&](const std::string& old, const std::string& now) {
        std::string draft = text;
        return draft.replace(draft.find(old), old.size(), now);
    };
    CHECK(check(text).empty());
    const auto wrong = check(with("neuronLinearThreshold", "neuronLinearTreshold"));
    REQUIRE(wrong.size() == 1);
    const auto before = text.substr(0, text.find("\"neuronLinearThreshold"));
    CHECK(wrong[0]["line"] == 1 + std::count(before.begin(), before.end(), '\n'));
    CHECK(wrong[0]["column"] == static_cast<int>(before.size() - before.rfind('\n') - 1) + 2);
    CHECK(wrong[0]["hint"] == "did you mean 'neuronLinearThreshold'?");
    CHECK(check(with("name=\"Motor\"", "nam=\"Motor\""))[0]["line"] == 1);
    // The first line does not begin at the left.
    CHECK(check(with("name=\"Motor\"", "nam=\"Motor\""))[0]["column"].get<int>() < 60);
    // What becomes wrong elsewhere has no place in this text.
    const auto elsewhere = check(with("\"bug.motor\"", "\"bug.engine\""));
    REQUIRE(!elsewhere.empty());
    CHECK(elsewhere[0]["line"] == 0);
    CHECK(e.text() == e.content());
    CHECK(e.ask({{"command", "item_check"}, {"item", "nothing"}, {"text", ""}})["ok"] == false);
}

TEST_CASE("the vocabulary has every element of the check, and names what its texts refer to") {
    Editor e;
    const json vocabulary = e.result({{"command", "vocabulary"}});
    CHECK(vocabulary["root"] == "System");
    const auto element = [&](const std::string& name) {
        const auto& all = vocabulary["elements"];
        const auto it = std::ranges::find_if(all, [&](const json& v) { return v["name"] == name; });
        REQUIRE(it != all.end());
        return *it;
    };
    const json group = element("Group");
    CHECK(group["children"][0] == json{{"name", "Topology"}, {"several", false}, {"required", false}});
    CHECK(element("Topology")["choose"] == 1);
    CHECK(element("Note")["text"] == true);
    const json width = element("TopologyRect")["attributes"][0];
    CHECK(width["name"] == "hcount");
    CHECK(width["low"] == 1);
    CHECK(width["unit"] == "cells");
    for (const auto& [name, attribute, names] :
         {std::tuple("Neuron", 0, "neuron"), std::tuple("Parameter", 0, "parameter"),
          std::tuple("Parameter", 1, "value"), std::tuple("Connection", 3, "group"),
          std::tuple("XRef", 0, "port"), std::tuple("XRef", 1, "target")})
        CHECK(element(name)["attributes"][static_cast<std::size_t>(attribute)]["names"] == names);
    for (const auto& e1 : vocabulary["elements"])
        for (const auto& c : e1["children"]) element(c["name"].get<std::string>());
}

TEST_CASE("the places of a sparse group are those of its cells, row by row") {
    Editor e;
    const auto id = e.last["system"]["processes"][0]["groups"][0]["id"].get<std::string>();
    e.edit({{{"do", "topology"}, {"id", id}, {"points", {{2, 3}, {3, 1}, {2, 3}, {1, 1}}}}});
    const json group = e.group(id);
    CHECK(group["cells"] == 3);
    CHECK(group["places"] == json({{0, 0}, {2, 0}, {1, 2}}));
}

TEST_CASE("a new system is built from nothing, saved under a name, and opened again") {
    Editor e;
    e.result({{"command", "new"}, {"name", "Nothing yet"}});
    CHECK(e.last["system"]["processes"].empty());
    CHECK(e.last["document"]["file"] == "");
    CHECK(e.ask({{"command", "save"}})["ok"] == false);
    e.result({{"command", "step"}});
    const auto p = e.edit({{{"do", "add_process"}, {"name", "P"}, {"x", 1}, {"y", 2}}})[0];
    const auto g = e.edit({{{"do", "add_group"},
                            {"process", p},
                            {"name", "G"},
                            {"x", 1},
                            {"y", 2},
                            {"neuron", "neuronRandomSpike"}}})[0];
    const auto h = e.edit({{{"do", "add_group"}, {"process", p}, {"name", "H"}, {"x", 90}, {"y", 2}}})[0];
    e.edit({{{"do", "add_connection"}, {"source", g}, {"target", h}, {"kind", "excitatory"}}});
    CHECK(e.last["document"]["running_is_current"] == true);
    CHECK(e.last["system"]["connections"][0]["synapses"] == 1);
    CHECK(e.last["system"]["connections"][0]["states"] == json::array());  // one weight for all synapses
    const auto file = (e.folder / "new.iqr").string();
    e.result({{"command", "save"}, {"file", file}});
    CHECK(e.last["document"]["file"] == file);
    CHECK(e.result({{"command", "recent"}})["files"][0]["file"] == fs::canonical(file).string());
    e.result({{"command", "open"}, {"system", file}});
    CHECK(e.last["system"]["connections"].size() == 1);
    CHECK(e.last["status"]["seed"] == 1);
    e.result({{"command", "restart"}, {"seed", 7}});
    e.result({{"command", "save"}});
    CHECK(e.result({{"command", "recent"}})["files"][0]["seed"] == 7);
    e.result({{"command", "open"},
              {"system", e.file},
              {"world", FORAGE_SOURCE_DIR "/systems/worlds/basic_arena.world"}});
    CHECK(e.session->run().seed() == 1);
    e.result({{"command", "open"}, {"system", file}});
    CHECK(e.session->run().seed() == 7);  // a system has its own seed
    const auto listed = e.result({{"command", "files"}, {"folder", e.folder.string()}})["files"];
    CHECK(std::ranges::count(listed, "new.iqr") == 1);
}

TEST_CASE("a connection is wired by plain words, and says by which") {
    Editor e("reactive_foraging.iqr");
    const auto p = e.edit({{{"do", "add_process"}, {"name", "P"}}})[0];
    const auto group = [&](const char* name, int width, int height) {
        return e.edit(
            {{{"do", "add_group"}, {"process", p}, {"name", name}, {"width", width}, {"height", height}}})[0];
    };
    const auto row = group("Row", 32, 1), square = group("Square", 9, 9), one = group("One", 1, 1),
               other = group("Other", 32, 1);
    const auto connect = [&](const json& from, const json& to) {
        return e.edit(
            {{{"do", "add_connection"}, {"source", from}, {"target", to}, {"wiring", "fitting"}}})[0];
    };
    const auto item = [&](const json& id) { return e.result({{"command", "item"}, {"item", id}}); };
    CHECK(item(connect(row, other))["wiring"] == "one to one");
    CHECK(item(connect(row, one))["synapses"] == 32);
    const auto c = connect(row, square);
    CHECK(item(c)["wiring"] == "all to all");
    CHECK(item(c)["synapses"] == 32 * 81);
    for (const char* wiring : {"nearest", "one to one"}) {
        e.edit({{{"do", "wiring"}, {"id", c}, {"wiring", wiring}}});
        CHECK(item(c)["wiring"] == wiring);
    }
    CHECK(item(c)["synapses"] == 32);
    e.edit({{{"do", "wiring"}, {"id", c}, {"wiring", "nearest"}}});
    const auto pairs = e.result({{"command", "preview"}, {"connection", c}});
    for (const auto& [side, cells] : {std::pair("source", 32u), std::pair("target", 81u)}) {
        const auto used = pairs[side].get<std::vector<int>>();
        CHECK(std::set<int>(used.begin(), used.end()).size() == cells);  // none is left out
    }
    CHECK(e.ask({{"command", "edit"},
                 {"operations", {{{"do", "wiring"}, {"id", c}, {"wiring", "some"}}}}})["ok"] == false);
}

TEST_CASE("a robot is one step, and a port gets a group of the size that it needs") {
    Editor e("reactive_foraging.iqr");
    e.result({{"command", "new"},
              {"name", "Mine"},
              {"world", FORAGE_SOURCE_DIR "/systems/worlds/basic_arena.world"}});
    const auto undriven = [&] {
        const json started = e.result({{"command", "run"}});
        e.result({{"command", "pause"}});
        return started["undriven_robots"];
    };
    CHECK(undriven() == json{{{"robot", "Bug"}, {"text", "no module drives the robot Bug"}}});
    const auto robot = e.edit({{{"do", "add_robot"}, {"name", "Bug"}}})[0];
    CHECK(undriven() == json::array());
    CHECK(e.last["document"]["problems"] == json::array());
    const auto groups = e.last["system"]["processes"][0]["groups"];
    REQUIRE(groups.size() == 3);
    CHECK(groups[0]["width"] == 32);
    CHECK(groups[2]["width"] == 9);
    CHECK(groups[0]["icon"]["x"] < groups[2]["icon"]["x"]);
    e.edit({{{"do", "remove"}, {"ids", {groups[2]["id"]}}}});
    CHECK(e.last["document"]["problems"][0]["size"] == json({9, 9}));
    e.edit({{{"do", "port_groups"}, {"id", robot}, {"ports", {"_motor"}}}});
    CHECK(e.last["document"]["problems"] == json::array());
    CHECK(e.ask({{"command", "edit"},
                 {"operations", {{{"do", "port_groups"}, {"id", robot}, {"ports", {"_motor"}}}}}})["ok"] ==
          false);
}

TEST_CASE("an edit keeps what a run waits for, or pauses it when that is gone") {
    Editor e("reactive_foraging.iqr");
    e.result({{"command", "speed"}, {"mode", "free"}});
    e.result({{"command", "run_until"}, {"condition", "max(Selection/Motor In) < -1 or cycle > 1000000"}});
    e.session->work(100);
    const auto id = [&](const std::string& process, const std::string& group) -> std::string {
        for (const auto& p : e.last["system"]["processes"])
            for (const auto& g : p["groups"])
                if (p["name"] == process && g["name"] == group) return g["id"];
        return "";
    };
    e.edit({{{"do", "remove"}, {"ids", {id("Reactive Layer", "US")}}}});
    CHECK(e.session->live.pace.running);
    e.session->work(101);
    e.edit({{{"do", "remove"}, {"ids", {id("Selection", "Motor In")}}}});
    CHECK_FALSE(e.session->live.pace.running);
    CHECK(e.ask({{"command", "run_until"}, {"condition", "cycle >= 0"}})["ok"] == false);
}

TEST_CASE("a backup is listed under its file, opened, and not written") {
    Editor e("reactive_foraging.iqr");
    const auto backup = e.result({{"command", "backup"}})["file"].get<std::string>();
    const std::string older = e.file + ",1999-12-31_23-59-58", kept = e.content();
    fs::copy_file(e.file, older);
    for (const char* no : {",1999-12-31_23-59-5", ",1999-12-31-23-59-58", ",autosave", "~"})
        fs::copy_file(e.file, e.file + no);
    const json listed = e.result({{"command", "files"}});
    CHECK(listed["files"] == json({"mine.iqr"}));
    REQUIRE(listed["backups"].size() == 2);  // the latest first
    CHECK(listed["backups"][0]["file"] == fs::path(backup).filename().string());
    CHECK(listed["backups"][1] == json({{"file", "mine.iqr,1999-12-31_23-59-58"},
                                        {"system", "mine.iqr"},
                                        {"time", "1999-12-31T23:59:58"}}));
    CHECK(e.last["document"]["backup_of"].is_null());

    e.result({{"command", "open"}, {"system", older}, {"world", e.session->edited.input.world}});
    CHECK(e.last["document"]["backup_of"] == e.file);
    e.edit({{{"do", "rename"}, {"id", "selection.ur"}, {"name", "Other"}}});
    CHECK(e.ask({{"command", "save"}}).dump().find("is a backup and stays as it is") != std::string::npos);
    CHECK(e.ask({{"command", "save"}, {"overwrite", true}})["ok"] == false);
    CHECK(read_file(older) == kept);
    CHECK(e.ask({{"command", "save"}, {"file", e.file}})["ok"] == false);  // it asks before
    CHECK(e.content() == kept);
    // A backup of the backup is one of the system; within a second they have one name.
    fs::remove(backup);
    CHECK(e.result({{"command", "backup"}})["file"].get<std::string>().find("mine.iqr,1999") ==
          std::string::npos);
    e.result({{"command", "save"}, {"file", e.file}, {"overwrite", true}});
    CHECK(e.last["document"]["backup_of"].is_null());
    CHECK(e.content() != kept);
}

TEST_CASE("a backup with mistakes is opened to be corrected") {
    Editor e;
    const std::string backup = e.file + ",1999-12-31_23-59-58";
    std::ofstream(backup) << "<System";
    e.result({{"command", "open"}, {"system", backup}, {"world", e.session->edited.input.world}});
    CHECK(e.last["document"]["opened_with_mistakes"] == true);
}

TEST_CASE("a file that changes outside is noticed, and both changes are merged") {
    Editor e;
    const auto group = e.last["system"]["processes"][0]["groups"][0]["id"];
    e.edit({{{"do", "set"}, {"id", group}, {"property", "note"}, {"value", "mine"}}});
    std::string theirs = e.content();
    theirs.insert(theirs.find("<Process"), "<!-- theirs -->\n    ");
    std::ofstream(e.file) << theirs;
    e.session->work(1000);
    CHECK(e.last["document"]["outside"] == "changed");
    const json refused = e.ask({{"command", "save"}});
    CHECK(refused["ok"] == false);
    CHECK(e.content() == theirs);
    e.result({{"command", "reload"}, {"keep", "merge"}});
    CHECK(e.last["document"]["outside"].is_null());
    CHECK(e.text().find("<!-- theirs -->") != std::string::npos);
    CHECK(e.text().find("<Note>mine</Note>") != std::string::npos);
    e.result({{"command", "save"}});
    CHECK(e.content() == e.text());
}

TEST_CASE("another type outside and another parameter here are a conflict, and both are kept") {
    Editor e;
    const std::string group = e.last["system"]["processes"][1]["groups"][0]["id"],
                      type = "neuronLinearThreshold";
    e.edit({{{"do", "parameter"}, {"id", group}, {"name", "excGain"}, {"value", "0.25"}}});
    std::string theirs = e.content();
    const auto element = theirs.find("<Group id=\"" + group);
    REQUIRE(element != std::string::npos);
    theirs.replace(theirs.find(type, element), type.size(), "neuronSigmoid");
    std::ofstream(e.file) << theirs;
    e.session->work(1000);
    const std::string mine = e.text();
    const json refused = e.ask({{"command", "reload"}, {"keep", "merge"}});
    CHECK(refused["ok"] == false);
    CHECK(refused.dump().find("both have changed the type of group") != std::string::npos);
    CHECK(e.text() == mine);
    CHECK(e.content() == theirs);
    CHECK(e.last["document"]["outside"] == "changed");
}

TEST_CASE("comments, phantoms and lines between processes are edited without rebuilding the run") {
    Editor e;
    const std::string before = e.content();
    const std::string page = e.last["system"]["processes"][2]["id"];
    const auto ids = e.edit({{{"do", "add_comment"},
                              {"process", page},
                              {"x", 1},
                              {"y", 2.4},
                              {"width", 90},
                              {"height", 30},
                              {"text", "Why"}},
                             {{"do", "add_comment"}, {"text", "All"}}});
    const auto comments = [&] { return e.last["system"]["processes"][2]["comments"]; };
    CHECK(comments()[0] == json({{"id", ids[0]},
                                 {"text", "Why"},
                                 {"color", ""},
                                 {"icon", {{"x", 1}, {"y", 2}, {"width", 90}, {"height", 30}}}}));
    CHECK(e.last["system"]["comments"][0]["text"] == "All");
    CHECK(e.last["document"]["running_is_current"] == true);
    e.edit({{{"do", "comment"}, {"id", ids[0]}, {"text", "Why not"}, {"width", 40}}});
    CHECK(e.last["action"]["title"] == "change comment 'Why'");
    e.edit({{{"do", "place"}, {"id", ids[0]}, {"x", 7}, {"y", 8}},
            {{"do", "set"}, {"id", ids[0]}, {"property", "color"}, {"value", "#FFFFFF"}}});
    CHECK(comments()[0]["icon"] == json({{"x", 7}, {"y", 8}, {"width", 40}, {"height", 30}}));
    const json item = e.result({{"command", "item"}, {"item", ids[0]}});
    CHECK((item["kind"] == "comment" && item["content"] == "Why not" && item["color"] == "#FFFFFF"));
    CHECK(item["text"].get<std::string>().starts_with("<!-- forage:comment id="));
    const json copied = e.result({{"command", "copy"}, {"ids", {ids[0]}}});
    e.edit({{{"do", "paste"}, {"text", copied["text"]}, {"process", page}, {"x", 0}, {"y", 0}}});
    CHECK(comments().size() == 2);

    json across;
    for (const auto& c : e.last["system"]["connections"])
        if (c["name"] == "Reactive Approach to Approach") across = c;
    e.edit({{{"do", "phantom"}, {"process", page}, {"group", across["source"]}, {"x", -5}, {"y", 6}},
            {{"do", "line"},
             {"id", across["id"]},
             {"vertices", {{1, 2}}},
             {"target_vertices", {{3, 4}, {5, 6}}}}});
    CHECK(e.last["action"]["title"] == "move the phantom of Reactive Layer/Approach and 1 more");
    CHECK(e.last["system"]["processes"][2]["phantoms"] ==
          json::array({{{"group", across["source"]}, {"x", -5}, {"y", 6}}}));
    for (const auto& c : e.last["system"]["connections"])
        if (c["id"] == across["id"]) {
            CHECK(c["line"]["vertices"] == json::array({{1, 2}}));
            CHECK(c["line"]["target_vertices"] == json::array({{3, 4}, {5, 6}}));
        }
    CHECK(e.last["document"]["problems"] == json::array());
    CHECK(e.ask({{"command", "edit"}, {"operations", {{{"do", "comment"}, {"id", "none"}}}}})["ok"] == false);
    e.edit({{{"do", "remove"}, {"ids", {ids[0]}}}});
    CHECK(comments().size() == 1);
    for (int i = 0; i < 6; ++i) e.result({{"command", "undo"}});
    CHECK(e.text() == before);
}

TEST_CASE("items say what their forms show, and the synapses of a pattern are counted before it is set") {
    Editor e;
    const auto connection = e.last["system"]["connections"][0];
    const json item = e.result({{"command", "item"}, {"item", connection["id"]}});
    CHECK(item["kind"] == "connection");
    CHECK(item["synapses"] == connection["synapses"]);
    CHECK(item["text"].get<std::string>().starts_with("<Connection"));
    const json all = {{"form", "foreach"}};
    const json made = e.result({{"command", "preview"},
                                {"connection", connection["id"]},
                                {"pattern", all},
                                {"arborization", nullptr}});
    const auto n =
        e.group(connection["source"])["cells"].get<int>() * e.group(connection["target"])["cells"].get<int>();
    CHECK(made["synapses"] == n);
    CHECK(e.last["document"]["dirty"] == false);
    e.edit({{{"do", "pattern"}, {"id", connection["id"]}, {"pattern", all}}});
    CHECK(e.result({{"command", "item"}, {"item", connection["id"]}})["pattern"]["form"] == "foreach");

    const json types = e.result({{"command", "types"}});
    CHECK(types["neurons"].size() > 3);
    CHECK(types["arborizations"].size() == 6);
    CHECK(types["arborizations"][0]["parameters"][0]["name"] == "width");
    CHECK(e.result({{"command", "item"}, {"item", "system"}})["kind"] == "system");
    for (const auto& p : e.last["system"]["processes"]) {
        CHECK(e.result({{"command", "item"}, {"item", p["id"]}})["kind"] == "process");
        for (const auto& g : p["groups"])
            CHECK(e.result({{"command", "item"}, {"item", g["id"]}})["kind"] == "group");
    }
    const json copied =
        e.result({{"command", "copy"}, {"ids", {connection["source"], connection["target"]}}});
    const auto count = e.last["system"]["connections"].size();
    const auto ids = e.edit({{{"do", "paste"},
                              {"text", copied["text"]},
                              {"process", e.last["system"]["processes"][0]["id"]},
                              {"x", 0},
                              {"y", 0}}})[0];
    CHECK(ids.size() >= 3);
    CHECK(e.last["system"]["connections"].size() > count);
    CHECK(e.result({{"command", "difference"}})["text"].get<std::string>().find("\n+") != std::string::npos);
    const auto text = e.result({{"command", "item"}, {"item", connection["id"]}})["text"].get<std::string>();
    CHECK(e.ask({{"command", "item_text"}, {"item", connection["id"]}, {"text", text + "<"}})["ok"] == false);
}

TEST_CASE("a linked process and what it holds have forms that only read") {
    Editor e;
    const auto bug = e.last["system"]["processes"][0]["id"];
    const std::string file = (e.folder / "Part.iqrProcess").string();
    e.result({{"command", "export"}, {"process", bug}, {"file", file}});
    std::string without_ports = read_file(file);
    for (std::size_t at; (at = without_ports.find("<Port ")) != std::string::npos;)
        without_ports.erase(at, without_ports.find("/>", at) + 2 - at);
    const std::string plain = (e.folder / "Plain.iqrProcess").string();
    std::ofstream(plain) << without_ports;
    const json taken = e.ask({{"command", "import"}, {"file", plain}, {"link", true}});
    CHECK(taken["ok"] == false);
    CHECK(taken["problems"][0]["hint"] == "import the process instead: it gets ids of its own");
    e.result({{"command", "new"}, {"name", "Empty"}, {"world", ""}});
    const auto id = e.result({{"command", "import"}, {"file", file}, {"link", true}})["id"];
    const json process = e.result({{"command", "item"}, {"item", id}});
    CHECK(process["kind"] == "process");
    CHECK(process["linked"] == true);
    CHECK(process["path"] == file);
    CHECK(process["module"] == "moduleGazeboBug");
    CHECK(!process["inputs"].empty());
    CHECK(!process["parameters"].empty());
    CHECK(process["text"] == "");
    const json groups = e.last["system"]["processes"][0]["groups"];
    REQUIRE(!groups.empty());
    const json group = e.result({{"command", "item"}, {"item", groups[0]["id"]}});
    CHECK(group["linked"] == true);
    CHECK(group["text"] == "");
}

TEST_CASE("a problem about a port names it, and an empty name is refused with a hint") {
    Editor e;
    json bug;
    for (const auto& p : e.last["system"]["processes"])
        if (!p["module"].is_null()) bug = p;
    e.edit({{{"do", "ports"}, {"id", bug["id"]}, {"outputs", json::object()}, {"inputs", {{"_motor", ""}}}}});
    const json problems = e.last["document"]["problems"];
    REQUIRE(problems.size() == 1);
    CHECK(problems[0]["port"] == "_motor");
    CHECK(problems[0]["item"] == bug["id"]);
    CHECK(problems[0]["unset"] == true);
    CHECK(e.last["document"]["running_is_current"] == false);
    // A port that leads to a group with which it cannot work has another problem.
    e.edit({{{"do", "ports"}, {"id", bug["id"]}, {"inputs", {{"_motor", bug["groups"][1]["id"]}}}}});
    const json wrong = e.last["document"]["problems"];
    REQUIRE(wrong.size() == 1);
    CHECK(wrong[0]["port"] == "_motor");
    CHECK_FALSE(wrong[0].contains("unset"));
    const auto before = e.text();
    const json refused =
        e.ask({{"command", "edit"}, {"operations", {{{"do", "rename"}, {"id", bug["id"]}, {"name", " "}}}}});
    CHECK(refused["ok"] == false);
    CHECK(refused["problems"][0]["message"] == "a name cannot be empty");
    CHECK(refused["problems"][0]["hint"] != "");
    CHECK(e.text() == before);
}

TEST_CASE("the form of the system keeps what only the original needs") {
    Editor e;
    CHECK(e.result({{"command", "item"}, {"item", "system"}})["port"] == "");
    e.edit({{{"do", "system"}, {"port", "54923"}, {"sync_plots", true}}});
    const json item = e.result({{"command", "item"}, {"item", "system"}});
    CHECK(item["port"] == "54923");
    CHECK(item["sync_plots"] == true);
    CHECK(e.text().find("syncPlots=\"true\"") != std::string::npos);
}

TEST_CASE("items of a second system have forms, and are not edited") {
    const std::string arena = FORAGE_SOURCE_DIR "/systems/worlds/team_arena.world";
    Editor e("team_a.iqr", {arena, FORAGE_SOURCE_DIR "/systems/team_b.iqr"});
    const json own = e.last["system"]["processes"].front(), other = e.last["system"]["processes"].back();
    CHECK(!e.result({{"command", "item"}, {"item", own["id"]}}).contains("other_system"));
    const json process = e.result({{"command", "item"}, {"item", other["id"]}});
    CHECK(process["other_system"] == true);
    CHECK(process["text"] == "");
    const auto group = other["groups"][0]["id"];
    const json parameters = e.result({{"command", "item"}, {"item", group}})["parameters"];
    CHECK(parameters == e.result({{"command", "parameters"}, {"item", group}})["parameters"]);
    REQUIRE(!parameters.empty());
    const auto before = e.text();
    const auto name = parameters[0]["assignment"].get<std::string>();
    e.result({{"command", "set"}, {"assignments", {name + "=0.5"}}});
    CHECK(e.result({{"command", "item"}, {"item", group}})["parameters"][0]["value"] == 0.5);
    CHECK(e.text() == before);
    const json refused =
        e.ask({{"command", "edit"}, {"operations", {{{"do", "rename"}, {"id", group}, {"name", "New"}}}}});
    CHECK(refused["ok"] == false);
    CHECK(e.ask({{"command", "item"}, {"item", "nothing"}})["ok"] == false);
}

TEST_CASE("an edit of the structure keeps the cycle, the states and the manipulations of the rest") {
    Editor e, undisturbed("reactive_foraging.iqr");
    const auto clamp = json{
        {"command", "manipulate"}, {"group", "Bug/Motor"}, {"patterns", {std::vector<double>(81, 0.25)}}};
    e.result({{"command", "step"}, {"cycles", 60}}),
        undisturbed.result({{"command", "step"}, {"cycles", 60}});
    e.result(clamp), undisturbed.result(clamp);
    e.edit({{{"do", "add_group"},
             {"process", e.last["system"]["processes"][1]["id"]},
             {"name", "New"},
             {"x", 1},
             {"y", 1},
             {"width", 4},
             {"id", "!new"}}});
    CHECK(e.session->run().cycle() == 60);
    e.result({{"command", "step"}, {"cycles", 40}}),
        undisturbed.result({{"command", "step"}, {"cycles", 40}});
    for (const char* source : {"Bug/Light", "Bug/Motor", "Selection/Motor In", "Bug/GPS"})
        CHECK(e.result({{"command", "read"}, {"source", source}}) ==
              undisturbed.result({{"command", "read"}, {"source", source}}));
    e.result({{"command", "seek"}, {"cycle", 70}});  // the past since the edit is there
    e.result({{"command", "stop"}});
    CHECK(e.session->run().cycle() == 0);
    CHECK_FALSE(e.group("!new").is_null());
}

TEST_CASE("every page knows a system that is opened from an edit of the one before") {
    Editor e;
    std::vector<std::int64_t> seen;
    const auto opened = [&] {
        const auto now = e.last["system"]["opened"].get<std::int64_t>();
        if (!seen.empty()) CHECK(now >= seen.back());
        seen.push_back(now);
        return seen.size() < 2 || seen[seen.size() - 2] != now;
    };
    opened();
    e.edit({{{"do", "rename"}, {"id", "selection.ur"}, {"name", "Other"}}});
    CHECK_FALSE(opened());
    e.result({{"command", "undo"}});
    CHECK_FALSE(opened());
    e.result({{"command", "save"}, {"file", (e.folder / "copy.iqr").string()}});
    CHECK_FALSE(opened());
    for (int i = 0; i < 2; ++i) {  // the same ids, and then the same file
        e.result({{"command", "open"}, {"system", e.file}, {"world", e.session->edited.input.world}});
        CHECK(opened());
    }
    for (int i = 0; i < 2; ++i) {  // the same name
        e.result({{"command", "new"}, {"name", "Mine"}});
        CHECK(opened());
    }
}

TEST_CASE("another name keeps the past, unless there are actions in it, which have the name of before") {
    Editor e;
    const auto rename = [&](const char* id, const char* name) {
        e.edit({{{"do", "rename"}, {"id", id}, {"name", name}}});
        return e.last["action"]["ended"];
    };
    const auto digest = [&] { return e.result({{"command", "digest"}})["digest"]; };
    const auto state_at_20 = [&] {
        e.result({{"command", "seek"}, {"cycle", 20}});
        return digest();
    };
    e.result({{"command", "step"}, {"cycles", 40}});
    const auto now = digest();
    const auto before = state_at_20();
    e.result({{"command", "seek"}, {"cycle", 40}});
    CHECK(rename("bug.light", "Lamp") == json::array());
    CHECK(digest() == now);
    CHECK(state_at_20() == before);
    e.result({{"command", "seek"}, {"cycle", 40}});
    CHECK(rename("bug", "Beetle") == json::array());
    CHECK(e.session->status()["history"] == json{{"first", 0}, {"last", 40}});
    CHECK(digest() == now);
    e.result({{"command", "set"}, {"assignments", {"Beetle/Lamp.threshold=0.3"}}});
    e.result({{"command", "step"}, {"cycles", 2}});
    CHECK(rename("bug.light", "Light") == json({"past"}));
    CHECK(e.session->status()["history"] == json{{"first", 42}, {"last", 42}});
}

TEST_CASE("another name ends the past where a module plays a table, whose rows have names") {
    Editor e;
    const std::string table = (e.folder / "rows.csv").string();
    std::ofstream(table) << "0,*,out,1\n";
    const auto p = e.edit({{{"do", "add_process"}, {"name", "Tape"}}})[0];
    const auto g = e.edit({{{"do", "add_group"}, {"process", p}, {"name", "G"}, {"x", 1}, {"y", 2}}})[0];
    e.edit({{{"do", "topology"}, {"id", g}, {"width", 1}, {"height", 1}}});
    e.edit({{{"do", "type"}, {"id", p}, {"part", "module"}, {"type", "moduleReplay"}},
            {{"do", "parameter"}, {"id", p}, {"name", "file"}, {"value", table}},
            {{"do", "ports"}, {"id", p}, {"outputs", {{"out", g}}}}});
    REQUIRE(e.last["document"]["problems"] == json::array());
    e.result({{"command", "step"}, {"cycles", 40}});
    e.edit({{{"do", "rename"}, {"id", "bug.light"}, {"name", "Lamp"}}});
    CHECK(e.last["action"]["ended"] == json({"past"}));
}

TEST_CASE("an edit of the structure says what it ends: the past, a comparison, a recording") {
    Editor e;
    const auto add = [&](const std::string& id) {
        e.edit({{{"do", "add_group"},
                 {"process", e.last["system"]["processes"][1]["id"]},
                 {"name", id},
                 {"x", 1},
                 {"y", 1},
                 {"id", id}}});
        return e.last["action"]["ended"];
    };
    CHECK(add("new1") == json::array());  // there is no past yet
    e.result({{"command", "step"}, {"cycles", 20}});
    CHECK(add("new2") == json({"past"}));
    CHECK(add("new3") == json::array());
    e.result({{"command", "step"}, {"cycles", 5}});
    e.result({{"command", "compare"}, {"cycle", 22}});
    e.result({{"command", "sample"}, {"file", (e.folder / "a.csv").string()}, {"sources", {"Bug/Light"}}});
    e.edit({{{"do", "place"}, {"id", "new3"}, {"x", 50}, {"y", 50}}});  // nothing of the run
    CHECK(e.last["action"]["ended"] == json::array());
    CHECK(add("new4") == json({"past", "comparison", "recording"}));
    CHECK(e.session->run().cycle() == 22);
}

TEST_CASE("what is edited is shown for the run, for the system, or for both") {
    Editor e("reactive_foraging.iqr");
    const auto forms = [&](const json& operations) {
        e.edit(operations);
        return std::pair(e.last["action"]["shell"].get<std::string>(),
                         e.last["action"]["python"].get<std::string>());
    };
    const json parameter = {
        {"do", "parameter"}, {"id", "bug.light"}, {"name", "threshold"}, {"value", "0.50"}};
    const json note = {{"do", "set"}, {"id", "bug.light"}, {"property", "note"}, {"value", "dim"}};
    const auto of_run = forms(json::array({parameter}));  // however the file spells it
    CHECK(of_run.first == "--set 'Bug/Light.threshold=0.5'");
    CHECK(of_run.second == "run.params[\"Bug/Light.threshold\"] = 0.5");
    e.result({{"command", "undo"}});
    CHECK(e.last["action"]["python"] == "run.params[\"Bug/Light.threshold\"] = 0");
    CHECK(forms(json::array({note})).second.starts_with("system.edit([{"));
    auto other = parameter, longer = note;
    other["value"] = 0.25, longer["value"] = std::string(101000, 'x');
    const auto [shell, python] =
        forms({other, {{"do", "set"}, {"id", "bug.light"}, {"property", "note"}, {"value", "bright"}}});
    CHECK(shell.starts_with("--set 'Bug/Light.threshold=0.25'\nforage edit '" + e.file + "' '[{"));
    CHECK(python.starts_with("run.params[\"Bug/Light.threshold\"] = 0.25\nsystem.edit([{"));
    other["value"] = 0.75;
    CHECK(forms(json::array({other, longer})) ==
          std::pair<std::string, std::string>("--set 'Bug/Light.threshold=0.75'",
                                              "run.params[\"Bug/Light.threshold\"] = 0.75"));
}

TEST_CASE("names are one word in the commands that are shown, and carry nothing out") {
    Editor e("reactive_foraging.iqr");
    const auto shown = [&](const std::string& name, const char* value) {
        e.edit({{{"do", "rename"}, {"id", "bug.light"}, {"name", name}}});
        e.edit({{{"do", "parameter"}, {"id", "bug.light"}, {"name", "threshold"}, {"value", value}}});
        return e.last["action"]["shell"].get<std::string>();
    };
    CHECK(shown("it's $(reboot)", "0.5") == "--set 'Bug/it'\\''s $(reboot).threshold=0.5'");
    CHECK(shown("a\u202e\u2028b", "0.25") == "--set $'Bug/a\\342\\200\\256\\342\\200\\250b.threshold=0.25'");
}

TEST_CASE("a message that is too deep has an answer") {
    Editor e;
    json deep = 1;
    for (int i = 0; i < 200; ++i) deep = json::array({deep});
    e.session->message(1, json{{"id", 7}, {"command", "edit"}, {"operations", deep}}.dump());
    CHECK(e.last["reply"]["id"] == 7);
    CHECK(e.last["reply"]["ok"] == false);
}

TEST_CASE("actions that restart the run say what they end, and how to do it without the studio") {
    Editor e;
    int recordings = 0;
    const auto action = [&](const json& command) {
        e.result({{"command", "step"}, {"cycles", 5}});
        e.result({{"command", "compare"}, {"cycle", 3}});
        e.result({{"command", "sample"},
                  {"file", (e.folder / fmt::format("{}.csv", ++recordings)).string()},
                  {"sources", {"Bug/Light"}}});
        e.result(command);
        CHECK(e.session->run().cycle() == 0);
        CHECK(e.last["action"]["command"] == command["command"]);
        CHECK(e.last["action"]["ended"] == json({"past", "comparison", "recording"}));
        return e.last["action"];
    };
    const std::string open = "run = forage.open(\"" + e.file + "\", world=\"";
    json reported = action({{"command", "restart"}, {"seed", 7}});
    CHECK(reported["shell"] == "--seed 7");
    e.result({{"command", "restart"}, {"seed", 8}});
    CHECK(e.last["action"]["ended"] == json::array());  // there was nothing

    const std::string arena = FORAGE_SOURCE_DIR "/systems/worlds/open_arena.world";
    reported = action({{"command", "world_open"}, {"world", arena}});
    CHECK(reported["title"] == "restart in open_arena.world");
    CHECK(reported["shell"] == "--world '" + arena + "'");
    CHECK(reported["python"] == open + arena + "\", seed=8)");

    ::setenv("FORAGE_MODEL_PATH", FORAGE_SOURCE_DIR "/systems/worlds/models", 1);
    const std::string mine = (e.folder / "mine.world").string();
    reported = action({{"command", "world_save"}, {"file", mine}});
    const std::string renamed =
        R"([{"do":"set","id":"open_arena","property":"name","value":"mine"}])";  // as its file is called
    CHECK(reported["shell"] ==
          "forage edit '" + arena + "' '" + renamed + "' -o '" + mine + "'\n--world '" + mine + "'");
    CHECK(e.last["world_document"]["items"][0]["name"] == "mine");
    CHECK(reported["python"] ==
          "forage.edit_file(\"" + arena +
              R"(", [{"do": "set", "id": "open_arena", "property": "name", "value": "mine"}], save_as=")" +
              mine + "\")\n" + open + mine + "\", seed=8)");
    reported = action({{"command", "world_save"}});
    CHECK(reported["shell"] == "--world '" + mine + "'");
}

TEST_CASE("a system without a robot leaves its world") {
    Editor e("cookbook/winner_take_all.iqr",
             std::vector<std::string>{FORAGE_SOURCE_DIR "/systems/worlds/basic_arena.world"});
    e.result({{"command", "world_open"}, {"world", ""}});
    CHECK(e.last["action"]["title"] == "restart without a world");
    CHECK(e.last["action"]["shell"] == "");
    CHECK(e.last["action"]["python"] == "run = forage.open(\"" + e.file + "\", seed=1)");
    CHECK(e.last["world"]["file"].is_null());
}

TEST_CASE("what is wrong with a world is said while it is edited") {
    ::setenv("FORAGE_MODEL_PATH", FORAGE_SOURCE_DIR "/systems/worlds/models", 1);
    Editor e;
    const auto problems = [&](json operations) {
        e.result({{"command", "world_edit"}, {"operations", std::move(operations)}});
        return e.last["world_document"]["problems"];
    };
    CHECK(problems({{{"do", "add"}, {"kind", "trials"}, {"x", 0}, {"y", 0}}}).empty());
    const json outside = problems({{{"do", "move"}, {"id", "Reset_0"}, {"x", 30}, {"y", 0}}});
    REQUIRE(outside.size() == 1);
    CHECK(outside[0]["severity"] == "error");
    CHECK(outside[0]["message"].get<std::string>().starts_with("'Reset_0' at (30, 0) is not inside"));
    json removals = json::array();
    for (const char* start : {"Reset_0", "Reset_1", "Reset_2"})
        removals.push_back({{"do", "remove"}, {"id", start}});
    const json none = problems(removals);
    REQUIRE(none.size() == 1);
    CHECK(none[0]["severity"] == "warning");
    CHECK(none[0]["message"] == "there are rules of trials, but no start poses, so no trials");
}

TEST_CASE("a world is edited, undone, saved, and the run restarts in it") {
    ::setenv("FORAGE_MODEL_PATH", FORAGE_SOURCE_DIR "/systems/worlds/models", 1);
    Editor e;
    CHECK(e.result({{"command", "world_document"}})["dirty"] == false);
    std::ofstream(e.file)
        << "<System";  // the system is changed outside, and the run is that of the text before
    const auto ids = e.result({{"command", "world_edit"},
                               {"operations",
                                {{{"do", "add"}, {"kind", "wall"}, {"x", 1}, {"y", 1}, {"width", 2}},
                                 {{"do", "move"}, {"id", "Bug"}, {"x", 0.25}, {"y", -1.5}}}}})["ids"];
    CHECK(ids[0] == "Wall_2");
    CHECK(e.last["world_document"]["dirty"] == true);
    CHECK(e.session->status()["undo"] == "add in the world");
    e.result({{"command", "undo"}});
    CHECK(e.last["world_document"]["dirty"] == false);
    e.result({{"command", "redo"}});
    const auto file = (e.folder / "mine.world").string();
    e.result({{"command", "world_save"}, {"file", file}});
    CHECK(e.last["world"]["file"] == file);
    CHECK(e.session->run().environment()->pose(0).x == Approx(0.25));
    CHECK(e.result({{"command", "read"}, {"source", "Bug/Light"}}).is_object());
    CHECK(e.ask({{"command", "world_edit"},
                 {"operations", {{{"do", "move"}, {"id", "Nothing"}, {"x", 0}, {"y", 0}}}}})["ok"] == false);
}

TEST_CASE("items of a world are described as forms, and take what is written there") {
    ::setenv("FORAGE_MODEL_PATH", FORAGE_SOURCE_DIR "/systems/worlds/models", 1);
    Editor e;
    const auto set = [&](const char* id, const char* property, const json& value) {
        return e.result(
            {{"command", "world_edit"},
             {"operations",
              {{{"do", "set"}, {"id", id}, {"property", property}, {"value", value}}}}})["ids"][0];
    };
    const auto property = [&](const char* id, const char* name) {
        const json document = e.result({{"command", "world_document"}});
        for (const auto& item : document["items"])
            if (item["id"] == id)
                for (const auto& p : item["properties"])
                    if (p["name"] == name) return p;
        return json();
    };
    CHECK(property("Wall", "width")["value"] == 8);
    CHECK(set("Wall", "width", 6) == "Wall");
    CHECK(property("Wall", "width")["value"] == 6);
    CHECK(property("Bug", "color")["value"] == "#ff0000");
    set("Bug", "color", "#00ff00");
    CHECK(property("Bug", "color")["value"] == "#00ff00");
    CHECK(set("Bug", "name", "Beetle") == "Beetle");
    set("Wall", "movable", true);
    CHECK(property("Wall", "movable")["value"] == true);
    CHECK(property("basic_arena", "rate")["value"] == 2000);
    set("basic_arena", "ambient", 0.6);
    for (int i = 0; i < 5; ++i) e.result({{"command", "undo"}});
    CHECK(e.last["world_document"]["dirty"] == false);
}

TEST_CASE("a world that cannot run is not saved, and the error names the place") {
    ::setenv("FORAGE_MODEL_PATH", FORAGE_SOURCE_DIR "/systems/worlds/models", 1);
    Editor e;
    const auto cycle = [&] { return e.session->run().cycle(); };
    e.result({{"command", "step"}, {"cycles", 5}});
    REQUIRE(cycle() == 5);
    e.result({{"command", "world_edit"},
              {"operations",
               {{{"do", "set"}, {"id", "Bug"}, {"property", "model"}, {"value", "model://no_bug"}}}}});
    const auto file = e.folder / "mine.world";
    const auto refused = e.ask({{"command", "world_save"}, {"file", file.string()}});
    REQUIRE(refused["ok"] == false);
    INFO(refused.dump(1));
    const auto& problem = refused["problems"][0];
    CHECK(problem["file"] == file.string());
    CHECK(problem["line"].get<int>() > 1);
    CHECK(problem["message"].get<std::string>().find("no_bug") != std::string::npos);
    for (const auto& entry : fs::directory_iterator(e.folder)) CHECK(entry.path().extension() != ".world");
    CHECK(cycle() == 5);  // the run continues in the old world
    CHECK(e.result({{"command", "world_document"}})["dirty"] == true);
    e.result({{"command", "undo"}});
    // A world without the robot of the system cannot run, either, and an older file keeps its content.
    e.result({{"command", "world_save"}, {"file", file.string()}});
    const auto before = read_file(file.string());
    e.result({{"command", "world_edit"}, {"operations", {{{"do", "remove"}, {"id", "Bug"}}}}});
    CHECK(e.ask({{"command", "world_save"}})["ok"] == false);
    CHECK(read_file(file.string()) == before);
    CHECK(e.last["world"]["file"] == file.string());
}

namespace {

/// A program ffmpeg that plays a camera, in front of PATH while the object exists. It notes when it is
/// started while another one runs: most cameras can be opened once only. With a file `once`, it ends then.
struct FakeCamera {
    fs::path folder = fs::temp_directory_path() / ("forage-camera-test-" + std::to_string(::getpid()));
    std::string path = std::getenv("PATH");

    FakeCamera() {
        fs::create_directories(folder / "bin");
        write("video0", "");
        const auto program = folder / "bin/ffmpeg";
        write("bin/ffmpeg", "#!/bin/sh\n[ \"$1\" = -version ] && exit 0\ncd " + folder.string() + R"(
for other in running.*; do
  [ -e "$other" ] && kill -0 "${other##*.}" 2>/dev/null && echo >>twice && [ -e once ] && exit 1
done
: >running.$$
echo >>opened
while printf 'P6\n1 1\n255\nabc'; do sleep 0.01; done
)");
        fs::permissions(program, fs::perms::owner_all);
        ::setenv("PATH", ((folder / "bin").string() + ":" + path).c_str(), 1);
    }
    ~FakeCamera() {
        ::setenv("PATH", path.c_str(), 1);
        fs::remove_all(folder);
    }
    void write(const char* name, const std::string& text) const { std::ofstream(folder / name) << text; }
    /// A system that looks through it.
    void write_system(const std::string& file) const {
        std::ofstream(file)
            << "<System id=\"s\" name=\"Seeing\" cylesPerSecond=\"25\"><Process id=\"p\" name=\"P\">"
               "<Module name=\"moduleVideo\"><Parameter name=\"DeviceName\" value=\""
            << (folder / "video0").string()
            << "\"/><XRefHolder name=\"OutputToGroup\"><XRef name=\"videoOutputRed\" target=\"g\"/>"
               "</XRefHolder></Module><Group id=\"g\" name=\"G\"><Topology><TopologyRect "
               "hcount=\"1\" vcount=\"1\"/></Topology><Neuron name=\"neuronNumeric\"/></Group>"
               "</Process></System>\n";
    }
    std::size_t lines(const char* name) const {
        return fs::exists(folder / name) ? read_file((folder / name).string()).size() : 0;
    }
};

}  // namespace

TEST_CASE("a camera is open once at a time when a system is edited") {
    const FakeCamera camera;
    Editor e;
    camera.write_system(e.file);
    e.result({{"command", "open"}, {"system", e.file}});
    CHECK(camera.lines("opened") == 0);
    const auto seen = [&] {
        e.result({{"command", "step"}, {"cycles", 3}});
        return e.result({{"command", "read"}, {"source", "P/G"}})["values"][0].get<double>();
    };
    CHECK(seen() > 0);
    CHECK(camera.lines("opened") == 1);
    e.edit({{{"do", "add_group"}, {"process", "p"}, {"name", "Another"}}});
    CHECK(seen() > 0);
    CHECK(camera.lines("opened") == 2);
    e.result({{"command", "stop"}});
    CHECK(seen() > 0);
    CHECK(camera.lines("opened") == 3);
    CHECK(camera.lines("twice") == 0);
}

TEST_CASE("a comparison that cannot begin leaves the run as it is") {
    const FakeCamera camera;
    camera.write("once", "");
    Editor e;
    camera.write_system(e.file);
    e.result({{"command", "open"}, {"system", e.file}});
    e.result({{"command", "step"}, {"cycles", 3}});
    const auto* run = &e.session->run();
    CHECK(e.ask({{"command", "compare"}})["ok"] == false);  // the second run cannot open the camera
    CHECK(&e.session->run() == run);
    CHECK(e.session->run().cycle() == 3);
    e.session->work(10);
    CHECK(e.last["status"]["compare"].is_null());
    e.result({{"command", "step"}, {"cycles", 3}});
    CHECK(e.result({{"command", "read"}, {"source", "P/G"}})["values"][0].get<double>() > 0);
}

TEST_CASE("edits of a world that were not saved survive the death of the program") {
    ::setenv("FORAGE_MODEL_PATH", FORAGE_SOURCE_DIR "/systems/worlds/models", 1);
    Editor e;
    e.session->keep();
    e.session->work(1000);
    json ids;
    for (const char* kind : {"goal", "home", "site", "disc", "resource", "trials"})
        ids.push_back(
            e.result({{"command", "world_edit"},
                      {"operations", {{{"do", "add"}, {"kind", kind}, {"x", 1}, {"y", 1}}}}})["ids"][0]);
    e.result(
        {{"command", "world_edit"},
         {"operations", {{{"do", "set"}, {"id", ids[0]}, {"property", "color"}, {"value", "#123456"}}}}});
    const auto before = e.result({{"command", "world_document"}});
    CHECK(before["items"].dump().find("#123456") != std::string::npos);
    e.session->work(1031);  // it keeps what has changed, and dies without end()
    RunInput input = e.session->edited.input;
    input.text.clear();
    e.session.emplace(input, [](int, bool, const std::string&) {});
    e.session->keep();
    REQUIRE_FALSE(e.session->killed().is_null());
    e.session->recover();
    CHECK(e.result({{"command", "world_document"}}) == before);
    e.result({{"command", "undo"}});
    CHECK(e.result({{"command", "world_document"}})["items"].dump().find("#123456") == std::string::npos);
}

TEST_CASE("a process becomes a part, which is used again and dissolved, each in one step") {
    Editor e;
    const std::string before = e.text();
    const json process = e.last["system"]["processes"][0];
    const auto id = process["id"].get<std::string>();
    const std::string file = (e.folder / "mine.iqrProcess").string();
    const json make = {{"do", "make_part"}, {"id", id}, {"file", file}};
    CHECK(e.ask({{"command", "edit"},
                 {"operations",
                  {{{"do", "make_part"}, {"id", id}, {"file", e.folder / "mine.txt"}}}}})["ok"] == false);
    // An edit that fails leaves no file.
    CHECK(e.ask({{"command", "edit"}, {"operations", {make, {{"do", "grow"}}}}})["ok"] == false);
    CHECK_FALSE(fs::exists(file));
    const json made = e.result({{"command", "edit"}, {"operations", {make}}});
    CHECK(made["warnings"].size() == (made["ids"][0].empty() ? 0 : 1));
    json part = e.last["system"]["processes"][0];
    CHECK(part["linked"] == true);
    CHECK(part["file"] == "mine.iqrProcess");
    CHECK(!part["ports"].empty());
    CHECK(e.last["document"]["running_is_current"] == true);
    const json exists = e.ask({{"command", "edit"}, {"operations", {make}}});
    CHECK(exists["reason"] == "file_exists");

    const json parts = e.result({{"command", "parts"}})["parts"];
    REQUIRE(parts.size() == 1);
    CHECK(parts[0]["file"] == file);
    CHECK(parts[0]["ports"].size() == part["ports"].size());
    const auto again = e.edit({{{"do", "use_part"}, {"file", file}, {"x", 300}, {"y", 20}}})[0];
    CHECK(e.last["system"]["processes"].back()["id"] == again);
    CHECK(e.last["system"]["processes"].back()["icon"]["x"] == 300);
    e.result({{"command", "undo"}});

    const std::string with_part = e.text();
    e.edit({{{"do", "dissolve"}, {"id", id}}});
    CHECK(e.last["system"]["processes"][0]["linked"] == false);
    CHECK(e.last["system"]["processes"][0]["groups"].size() == process["groups"].size());
    e.result({{"command", "undo"}});
    CHECK(e.text() == with_part);
    e.result({{"command", "undo"}});
    CHECK(e.text() == before);
    CHECK(fs::exists(file));
}
