// Sessions and streams of the studio, without sockets.
#include "tools/studio/server/session.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <numeric>
#include <set>

#include <fmt/format.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include "bug_interface/simulation/world.h"
#include "core/base/output_files.h"
#include "core/base/text_file.h"
#include "tests/support/catch.h"
#include "tests/support/paths.h"
#include "tests/support/studio_protocol.h"
#include "tools/studio/server/requests.h"

namespace {

using namespace forage;
using namespace forage::studio;

/// A session whose pages are lists of messages.
struct Fixture {
    std::map<int, std::vector<json>> messages;
    std::map<int, std::vector<std::string>> frames;
    Session session{input(), [this](int client, bool binary, std::string data) {
                        if (binary) {
                            frames[client].push_back(std::move(data));
                        } else {
                            messages[client].push_back(json::parse(data));
                            test::check_message(messages[client].back());
                        }
                    }};

    static RunInput input() {
        RunInput out;
        out.system = FORAGE_SOURCE_DIR "/systems/reactive_foraging.iqr";
        out.world = FORAGE_SOURCE_DIR "/systems/worlds/basic_arena.world";
        return out;
    }
    json ask(const json& command, int client = 1) {
        const json reply = session.execute(client, command);
        test::check_reply(command, reply);
        return reply;
    }
    json result(const json& command, int client = 1) {
        const json reply = ask(command, client);
        INFO(reply.dump());
        REQUIRE(reply["ok"] == true);
        return reply.value("result", json());
    }
};

std::uint32_t number_at(const std::string& frame, std::size_t at) {
    std::uint32_t out;
    std::memcpy(&out, frame.data() + at, sizeof out);
    return out;
}

}  // namespace

TEST_CASE("a page knows whether it can end the program") {
    Fixture f;
    f.session.connect(1);
    f.session.quit = [] {};
    f.session.connect(2);
    const auto can_quit = [&](int client) {
        return std::ranges::count(f.messages[client].front()["capabilities"], json("quit"));
    };
    CHECK(can_quit(1) == 0);
    CHECK(can_quit(2) == 1);
}

TEST_CASE("a page has a credit of two frames, and acknowledges all up to a number") {
    Fixture f;
    f.session.connect(1);
    f.result({{"command", "subscribe"}, {"source", "Bug/Light"}});
    double now = 100;
    const auto step = [&] { f.result({{"command", "step"}}), f.session.work(now += 1); };
    for (int i = 0; i < 5; ++i) step();
    CHECK(f.frames[1].size() == 2);
    f.session.message(1, R"({"command": "ack", "seq": 99})");  // was never sent
    step();
    CHECK(f.frames[1].size() == 2);
    f.session.message(1, R"({"command": "ack", "seq": 2})");
    step();
    REQUIRE(f.frames[1].size() == 3);
    CHECK(number_at(f.frames[1][2], 8) == 3);
    CHECK(number_at(f.frames[1][2], 16) == 7);  // the newest cycle, not the third
}

TEST_CASE("frames come at most thirty times a second, and only when something has changed") {
    Fixture f;
    f.session.connect(1);
    f.result({{"command", "subscribe"}, {"source", "Bug/Light"}});
    f.session.work(10);
    CHECK(f.frames[1].size() == 1);
    f.session.work(20);
    CHECK(f.frames[1].size() == 1);  // nothing has changed
    f.result({{"command", "step"}});
    f.session.work(10.01);
    CHECK(f.frames[1].size() == 1);  // too early
}

TEST_CASE("what several pages watch is read once, and they get the same") {
    Fixture f;
    int reads = 0;
    const auto count = [&](Run&, std::span<double> out) { out[0] = ++reads, out[1] = -1; };
    SharedSource shared(f.session.run(), {1, 2, "count", count});
    for (std::uint64_t version = 1; version <= 3; ++version)
        for (int page = 0; page < 3; ++page) {
            CHECK(shared.numbers(version)[0] == static_cast<double>(version));
            CHECK(shared.chunk(version).highest == static_cast<float>(version));
        }
    CHECK(reads == 3);
    for (int client = 1; client <= 3; ++client) {
        f.session.connect(client);
        f.result({{"command", "subscribe"}, {"source", "world:camera"}}, client);
    }
    f.result({{"command", "step"}});
    f.session.work(10);
    REQUIRE(f.frames[1].size() == 1);
    CHECK(f.frames[1][0].size() > 1000);
    CHECK(f.frames[2] == f.frames[1]);
    CHECK(f.frames[3] == f.frames[1]);
}

TEST_CASE("a page that leaves gets nothing more") {
    Fixture f;
    f.session.connect(1), f.session.connect(2);
    f.result({{"command", "subscribe"}, {"source", "Bug/Light"}}, 1);
    f.session.disconnect(1);
    f.result({{"command", "step"}}, 2);
    f.session.work(10);
    CHECK(f.frames[1].empty());
}

TEST_CASE("rows of several cycles have the extremes and the mean of every cycle") {
    Fixture f;
    SourcePool pool;
    const auto stream = [&](std::uint64_t of) {
        return pool.stream(f.session.run(), nullptr, "Bug/Light", Delivery::append, of);
    };
    Stream every = stream(1), tenth = stream(10), other = stream(10);
    const auto run_to = [&](std::uint64_t& cycle, std::uint64_t end) {
        for (; cycle < end; ++cycle) f.session.run().step(), pool.after_cycle(cycle, cycle);
    };
    std::uint64_t cycle = 0;
    run_to(cycle, 35);
    CHECK(other.take(34).rows == 7);
    Stream late = stream(10);
    run_to(cycle, 105);
    const Chunk all = every.take(105), joined = tenth.take(105);
    REQUIRE(all.rows == 105);
    // Those of the beginning are no longer than what was before.
    const std::vector<std::size_t> begins{0, 1, 2, 4, 8, 10, 20, 30, 40, 50, 60, 70, 80, 90, 100};
    REQUIRE(joined.rows == begins.size() - 1);
    // Pages that fetch at other times, or began later, share the rows.
    CHECK(other.take(105).rows == 7);
    CHECK(late.take(105).rows == 7);
    CHECK(joined.joined);
    REQUIRE(joined.columns == 2 + 3 * (all.columns - 1));
    const auto numbers = [](const Chunk& c) {
        std::vector<double> out(c.bytes.size() / sizeof(double));
        std::memcpy(out.data(), c.bytes.data(), c.bytes.size());
        return out;
    };
    const auto a = numbers(all), j = numbers(joined);
    for (std::size_t row = 0; row < joined.rows; ++row) {
        const std::size_t from = begins[row], to = begins[row + 1];
        const auto* in_row = j.data() + row * joined.columns;
        CHECK(static_cast<std::size_t>(in_row[0]) == from);
        CHECK(static_cast<std::size_t>(in_row[1]) == to - from);
        for (std::size_t i = 1; i < all.columns; ++i) {
            std::vector<double> each;
            for (std::size_t k = from; k < to; ++k) each.push_back(a[k * all.columns + i]);
            const auto low = std::ranges::min_element(each), high = std::ranges::max_element(each);
            const auto* of = in_row + 3 * i - 1;
            CHECK(of[0] == (high < low ? *high : *low));
            CHECK(of[1] == (high < low ? *low : *high));
            CHECK(of[2] == Approx(std::reduce(each.begin(), each.end()) / static_cast<double>(each.size())));
        }
    }
    CHECK(every.take(106).rows == 0);
}

TEST_CASE("a run is paced by the clock, and does not catch up a long pause") {
    Fixture f;
    f.result({{"command", "speed"}, {"mode", "cycles"}, {"value", 10}});
    f.result({{"command", "run"}});
    f.session.work(50);
    CHECK(f.session.run().cycle() == 1);
    f.session.work(50.21);
    CHECK(f.session.run().cycle() == 3);
    f.session.work(90);
    CHECK(f.session.run().cycle() <= 5);
}

TEST_CASE("a run of some trials pauses at the end of the last of them") {
    Fixture f;
    f.result({{"command", "speed"}, {"mode", "free"}});
    f.result({{"command", "run_until"}, {"trials", 2}});
    for (double now = 100; f.session.live.pace.running && now < 1e5; ++now) f.session.work(now);
    CHECK(f.session.run().environment()->trials(0).size() == 2);
    CHECK_FALSE(f.session.live.pace.running);
}

TEST_CASE("hits are counted among all trials, the last and those since a cycle, also after going back") {
    Fixture f;
    f.session.connect(1);
    f.result({{"command", "speed"}, {"mode", "free"}});
    CHECK(f.result({{"command", "learning"}})["all"]["share"] == nullptr);
    f.result({{"command", "run_until"}, {"trials", 4}});
    for (double now = 100; f.session.live.pace.running && now < 1e5; ++now) f.session.work(now);
    const json all = f.result({{"command", "trials"}})["trials"];
    REQUIRE(all.size() == 4);
    const auto third = all[2]["first_cycle"].get<std::uint64_t>();
    const json learned = f.result({{"command", "learning"}, {"last", 1}, {"since", third}, {"points", 2}});
    CHECK(learned["all"]["trials"] == 4);
    CHECK(learned["all"]["hits"] == f.session.status()["trials"]["reached"]);
    CHECK(learned["last"]["hits"] == (all[3]["reached_target"] == true ? 1 : 0));
    CHECK(learned["since"]["trials"] == 2);
    CHECK(learned["curve"]["trial"] == json{2, 4});
    CHECK(learned["curve"]["share"][1] == learned["all"]["share"]);
    CHECK(f.result({{"command", "trials"}, {"since", third}, {"count", 1}})["trials"] ==
          json::array({all[2]}));

    f.result({{"command", "seek"}, {"cycle", third}});
    CHECK(f.result({{"command", "learning"}})["all"]["trials"] == 2);
}

TEST_CASE("a run pauses when a condition holds, as that of the command line does") {
    Fixture f;
    f.session.connect(1);
    f.result({{"command", "speed"}, {"mode", "free"}});
    f.result({{"command", "run_until"}, {"trials", 3}, {"condition", "trial 2 and cycle > 40"}});
    const auto go = [&] {
        for (double now = 100; f.session.live.pace.running && now < 1e5; ++now) f.session.work(now);
        return f.session.run().cycle();
    };
    const auto run = open_run(Fixture::input()).run;
    run->until({.trials = 3, .until = {"trial 2 and cycle > 40"}, .in_code = true});
    CHECK(go() == run->cycle());
    const auto logged = std::ranges::find(f.messages[1], "action", [](const json& m) { return m["type"]; });
    REQUIRE(logged != f.messages[1].end());
    CHECK((*logged)["shell"] == "--trials 3 --until 'trial 2 and cycle > 40'");
    CHECK((*logged)["python"] == "run.run_until(\"trial 2 and cycle > 40\", trials=3)");
    for (const json& wrong :
         {json{{"command", "run_until"}}, json{{"command", "run_until"}, {"condition", "trail 2"}}})
        CHECK(f.ask(wrong)["ok"] == false);
    CHECK_FALSE(f.session.live.pace.running);
}

TEST_CASE("a run of some seconds pauses after them, from where it is") {
    Fixture f;
    f.session.connect(1);
    f.result({{"command", "speed"}, {"mode", "free"}});
    for (const std::uint64_t cycles : {50U, 100U}) {
        f.result({{"command", "run_until"}, {"seconds", 50 * f.session.run().seconds_per_cycle()}});
        for (double now = 100; f.session.live.pace.running && now < 1e5; ++now) f.session.work(now);
        CHECK(f.session.run().cycle() == cycles);
    }
    std::vector<std::pair<json, json>> scripts;
    for (const json& m : f.messages[1])
        if (m["type"] == "action") scripts.emplace_back(m["shell"], m["python"]);
    const double seconds = 50 * f.session.run().seconds_per_cycle();
    CHECK(scripts ==
          std::vector<std::pair<json, json>>{
              {fmt::format("--seconds {}", seconds), fmt::format("run.run(seconds={})", seconds)},
              {fmt::format("--seconds {}", 2 * seconds), fmt::format("run.run(seconds={})", seconds)}});
}

TEST_CASE("whether a condition holds is said at any time") {
    Fixture f;
    CHECK(f.result({{"command", "holds"}, {"condition", "cycle < 1"}})["holds"] == true);
    CHECK(f.result({{"command", "holds"}, {"condition", "cycle > 1 and max(Bug/Motor) > 0"}})["holds"] ==
          false);
    CHECK(f.ask({{"command", "holds"}, {"condition", "cycles"}})["ok"] == false);
}

TEST_CASE("the examples have small pictures: of a world, or of the diagram") {
    const std::string systems = FORAGE_SOURCE_DIR "/systems";
    Session session(
        Fixture::input(), [](int, bool, const std::string&) {}, {}, systems);
    for (const json& one : {json{{"system", "cookbook/oscillator.iqr"}},
                            json{{"system", "sec_maze.iqr"}, {"world", "worlds/double_t_maze.world"}}}) {
        json command = one;
        command["command"] = "example_picture";
        const json reply = session.execute(-1, command);
        INFO(reply.dump());
        test::check_reply(command, reply);
        REQUIRE(reply["ok"] == true);
        CHECK(reply["result"]["content"].get<std::string>().starts_with("iVBORw0KGgo"));  // a PNG file
    }
    CHECK(session.execute(-1, {{"command", "example_picture"}, {"system", "../x.iqr"}})["ok"] == false);
}

TEST_CASE("every system that comes with Forage to begin with has a sentence, and a world if it has a robot") {
    const std::string systems = FORAGE_SOURCE_DIR "/systems";
    Session session(
        Fixture::input(), [](int, bool, const std::string&) {}, {}, systems);
    const json reply = session.execute(-1, {{"command", "shipped"}});
    test::check_reply({{"command", "shipped"}}, reply);
    std::set<std::string> files;
    for (const json& system : reply["result"]["systems"]) {
        INFO(system.dump());
        const auto file = system["file"].get<std::string>();
        files.insert(file);
        CHECK(system["about"].get<std::string>().size() > 10);
        const bool robot = read_file(systems + "/" + file).find("moduleGazeboBug") != std::string::npos;
        CHECK((system["world"] != "") == robot);
        if (robot) CHECK(std::filesystem::exists(system["world"].get<std::string>()));
    }
    CHECK(files.size() == json::parse(read_file(systems + "/examples.json")).size());
    for (const char* folder : {"cookbook", "templates", "models"})
        for (const auto& entry : std::filesystem::directory_iterator(systems + "/" + folder))
            if (entry.path().extension() == ".iqr")
                CHECK(files.contains(folder + ("/" + entry.path().filename().string())));
}

TEST_CASE("a page hears of the world before it hears of the system that is opened in it") {
    Fixture f;
    f.session.connect(1);
    f.messages.clear();
    const RunInput input = Fixture::input();
    f.result({{"command", "open"}, {"system", input.system}, {"world", input.world}});
    std::vector<std::string> order;
    for (const auto& m : f.messages[1])
        if (m["type"] == "system" || m["type"] == "world") order.push_back(m["type"]);
    CHECK(order == std::vector<std::string>{"world", "system"});
}

TEST_CASE("stop goes back to the first cycle and keeps parameters and manipulations") {
    Fixture f;
    const std::string first = f.session.run().digest();
    f.result({{"command", "step"}, {"cycles", 50}});
    CHECK(f.session.run().digest() != first);
    f.result({{"command", "stop"}});
    CHECK(f.session.run().cycle() == 0);
    CHECK(f.session.run().digest() == first);
    f.result({{"command", "restart"}, {"seed", 7}});
    CHECK(f.session.run().seed() == 7);
}

TEST_CASE("the past is the same however it is reached") {
    Fixture f;
    f.result({{"command", "step"}, {"cycles", 700}});
    const std::string at_700 = f.session.run().digest();
    const std::uint64_t cycle = GENERATE(0u, 1u, 249u, 250u, 251u, 500u, 699u);
    f.result({{"command", "seek"}, {"cycle", cycle}});
    CHECK(f.session.run().cycle() == cycle);
    Fixture fresh;
    if (cycle > 0) fresh.result({{"command", "step"}, {"cycles", cycle}});
    CHECK(f.session.run().digest() == fresh.session.run().digest());
    f.result({{"command", "seek"}, {"cycle", 700}});
    CHECK(f.session.run().digest() == at_700);
    CHECK(f.ask({{"command", "seek"}, {"cycle", 701}})["ok"] == false);
}

TEST_CASE("an action in the past forgets what came later") {
    Fixture f;
    f.result({{"command", "step"}, {"cycles", 600}});
    const json found = f.result({{"command", "parameters"}, {"item", "Bug/Light"}});
    std::string name;
    for (const auto& p : found["parameters"])
        if (p["kind"] == "real") name = p["assignment"];
    f.result({{"command", "seek"}, {"cycle", 300}});
    f.result({{"command", "set"}, {"assignments", {name + "=0.75"}}});
    CHECK(f.session.run().cycle() == 300);
    const json history = f.result({{"command", "history"}});
    CHECK(history["last"] == 300);
    CHECK(history["actions"].size() == 1);
    f.result({{"command", "seek"}, {"cycle", 0}});
    f.result({{"command", "seek"}, {"cycle", 300}});
    f.result({{"command", "step"}});
    CHECK(std::get<double>(f.session.run().parameter(name)) == 0.75);
}

TEST_CASE("a robot and an object are moved to free places only") {
    Fixture f;
    f.result({{"command", "step"}});
    const auto robot = f.session.run().environment()->robot_names().front();
    f.result({{"command", "move"}, {"robot", robot}, {"x", 0.5}, {"y", -0.5}, {"heading", 1}});
    const Pose2 pose = f.session.run().environment()->pose(0);
    CHECK(pose.x == Approx(0.5));
    CHECK(pose.yaw == Approx(1));
    const auto before = f.session.edited.generation;
    CHECK(f.ask({{"command", "move"}, {"robot", robot}, {"x", 1e5}, {"y", 0}})["ok"] == false);
    f.session.connect(1);
    const json solids = f.messages[1][2]["solids"];
    const auto wall = std::find_if(solids.begin(), solids.end(), [](const json& d) {
        return d["kind"] == "box" && d["size"][2].get<double>() > 0.2 && d["z"].get<double>() < 1;
    });
    REQUIRE(wall != solids.end());
    CHECK(f.ask({{"command", "move"}, {"robot", robot}, {"x", (*wall)["x"]}, {"y", (*wall)["y"]}})["ok"] ==
          false);
    CHECK(f.session.run().environment()->pose(0).x == Approx(0.5));
    CHECK(f.ask({{"command", "move"}, {"robot", "Nobug"}, {"x", 0}, {"y", 0}})["ok"] == false);
    CHECK(f.session.edited.generation == before);
}

TEST_CASE("requests come from here, and pages begin with the token") {
    CHECK(is_from_here("127.0.0.1:80", "", 80));
    CHECK(is_from_here("localhost:80", "http://localhost:80", 80));
    for (const char* host :
         {"", "127.0.0.1", "127.0.0.1:81", "127.0.0.1:80.evil", "evil:80", "127.0.0.1.evil:80"})
        CHECK_FALSE(is_from_here(host, "", 80));
    for (const char* origin :
         {"null", "http://127.0.0.1:81", "https://127.0.0.1:80", "http://127.0.0.1:80.evil"})
        CHECK_FALSE(is_from_here("127.0.0.1:80", origin, 80));
    CHECK(query_value("/?a=1&token=x%20y", "token") == "x y");
    CHECK(query_value("/?tokens=1", "token").empty());
    CHECK(query_value("/?token", "token").empty());
    CHECK(token_in(R"({"token": "t"})") == "t");
    for (const char* other : {"", "{", "[]", "7", R"({"token": 7})", R"({"command": "run"})"})
        CHECK(token_in(other).empty());
}

TEST_CASE("panels and sets of parameters are written and read back, in the form of the original") {
    Fixture f;
    const auto folder = test::temporary_path("forage-studio-test");
    std::filesystem::create_directories(folder);
    const std::string panel = (folder / "a.hconf").string(), values = (folder / "a.pconf").string();
    const json found = f.result({{"command", "parameters"}, {"item", "Bug/Light"}})["parameters"];
    const auto real =
        std::find_if(found.begin(), found.end(), [](const json& p) { return p["kind"] == "real"; });
    REQUIRE(real != found.end());
    json row = {{"item", "Bug/Light"}, {"parameter", (*real)["name"]}};
    const json rows = json::array({row});
    f.result({{"command", "panel_write"}, {"file", panel}, {"rows", rows}});
    CHECK(f.result({{"command", "panel_read"}, {"file", panel}})["rows"][0]["assignment"] ==
          (*real)["assignment"]);
    f.result({{"command", "parameters_write"}, {"file", values}});
    const std::string name = (*real)["assignment"];
    f.result({{"command", "set"}, {"assignments", {name + "=0.625"}}});
    f.result({{"command", "parameters_read"}, {"file", values}});
    CHECK(std::get<double>(f.session.run().parameter(name)) == (*real)["value"].get<double>());
    f.result({{"command", "undo"}});
    CHECK(std::get<double>(f.session.run().parameter(name)) == 0.625);
    CHECK(f.ask({{"command", "panel_read"}, {"file", values}})["ok"] == false);
    // A file is replaced only when the command says so.
    for (json again : {json{{"command", "panel_write"}, {"file", panel}, {"rows", rows}},
                       json{{"command", "parameters_write"}, {"file", values}, {"rows", rows}}}) {
        const json refused = f.ask(again);
        CHECK(refused["ok"] == false);
        CHECK(refused.dump().find("overwrite it") != std::string::npos);
        again["overwrite"] = true;
        f.result(again);
    }
    // It now has the values of the rows alone; what the system does not have is reported, the rest is set.
    CHECK(f.result({{"command", "parameters_read"}, {"file", values}})["set"] == 1);
    std::string text = read_file(values);
    const std::string one =
        text.substr(text.find("<Parameter"), text.find("/>") + 2 - text.find("<Parameter"));
    std::string other = one;
    other.replace(other.find("itemID=\"") + 8, 1, "no-");
    write_file(values, text.replace(text.find(one), one.size(), one + other));
    const json partly = f.result({{"command", "parameters_read"}, {"file", values}});
    CHECK(partly["set"] == 1);
    CHECK(partly["missing"].size() == 1);
    write_file(values, text.replace(text.find(one), one.size(), ""));
    CHECK(f.ask({{"command", "parameters_read"}, {"file", values}})["ok"] == false);
    CHECK(f.ask({{"command", "panel_write"}, {"file", "/etc/passwd"}, {"rows", rows}})["ok"] == false);
    std::filesystem::remove_all(folder);
}

TEST_CASE("lists of patterns are written and read back, and played as they are asked to") {
    Fixture f;
    f.session.connect(1);
    const std::filesystem::path file = test::temporary_path("forage-studio-patterns").string() + ".txt";
    std::filesystem::remove(file);
    std::vector<std::vector<double>> patterns(3, std::vector<double>(81));
    for (std::size_t i = 0; i < 3; ++i) patterns[i][i] = 0.1 * static_cast<double>(i + 1);
    const json write = {{"command", "patterns_write"},
                        {"group", "Bug/Motor"},
                        {"file", file.string()},
                        {"patterns", patterns}};
    f.result(write);
    CHECK(f.ask(write)["ok"] == false);  // it exists
    CHECK(f.result(
              {{"command", "patterns_read"}, {"group", "Bug/Motor"}, {"file", file.string()}})["patterns"] ==
          patterns);
    std::filesystem::remove(file);
    f.result({{"command", "manipulate"},
              {"group", "Bug/Motor"},
              {"patterns", patterns},
              {"step", 2},
              {"times", 1},
              {"backwards", true}});
    const json action = f.messages[1].back()["type"] == "action" ? f.messages[1].back()
                                                                 : f.messages[1][f.messages[1].size() - 2];
    CHECK(action["shell"].get<std::string>().find("; step 2; times 1; backwards") != std::string::npos);
    CHECK(action["python"].get<std::string>().find("[::-1][::2], times=1)") != std::string::npos);
    const auto cell = [&](std::size_t i) {
        f.result({{"command", "step"}});
        return f.result({{"command", "read"}, {"source", "Bug/Motor"}})["values"][i].get<double>();
    };
    CHECK(cell(2) == Approx(0.3));
    CHECK(cell(0) == Approx(0.1));
}

TEST_CASE("a robot that was moved is put back by undo, a series of steps of keys at once") {
    Fixture f;
    f.session.connect(1);
    const auto robot = f.session.run().environment()->robot_names().front();
    const auto at = [&] { return f.session.run().environment()->pose(0); };
    const auto before = at();
    const auto to = [&](double x, const char* merge) {
        f.result({{"command", "move"}, {"robot", robot}, {"x", x}, {"y", 0}, {"merge", merge}});
    };
    to(0.5, ""), to(0.6, "keys 1"), to(0.7, "keys 1"), to(0.8, "keys 2");
    f.result({{"command", "undo"}});
    CHECK(at().x == Approx(0.7));
    f.result({{"command", "undo"}});
    CHECK(at().x == Approx(0.5));
    f.result({{"command", "undo"}});
    CHECK(at().x == Approx(before.x));
    CHECK(at().y == Approx(before.y));
    CHECK(at().yaw == Approx(before.yaw));
    f.result({{"command", "redo"}}), f.result({{"command", "redo"}});
    CHECK(at().x == Approx(0.7));
}

TEST_CASE("a light is moved while the run goes: robot, weights and cycle stay, and undo puts it back") {
    Fixture f;
    f.session.connect(1);
    f.result({{"command", "step"}, {"cycles", 40}});
    const auto world = [&] { return dynamic_cast<const bug::World*>(f.session.run().environment()); };
    const auto robot = f.session.run().environment()->pose(0);
    const auto light = world()->targets().front();
    const json items = f.result({{"command", "world_document"}})["items"];
    const auto item = std::ranges::find_if(items, [](const json& i) { return i["kind"] == "light"; });
    REQUIRE(item != items.end());
    const auto edit = [&](double x) -> json {
        return {{"command", "world_edit"},
                {"operations", {{{"do", "move"}, {"id", (*item)["id"]}, {"x", x}, {"y", light.y()}}}},
                {"run", true}};
    };
    f.result(edit(light.x() + 0.5));
    CHECK(f.session.run().cycle() == 40);
    CHECK(f.session.run().environment()->pose(0).x == robot.x);
    CHECK(world()->targets().front().x() == Approx(light.x() + 0.5));
    const auto& action = *std::find_if(f.messages[1].rbegin(), f.messages[1].rend(),
                                       [](const json& m) { return m["type"] == "action"; });
    CHECK(action["ended"] == json::array({"past"}));
    f.result({{"command", "stop"}});  // the light stays where it was put
    CHECK(world()->targets().front().x() == Approx(light.x() + 0.5));
    f.result({{"command", "undo"}});
    CHECK(world()->targets().front().x() == Approx(light.x()));
    CHECK(f.result({{"command", "world_document"}})["dirty"] == false);
    const auto name = f.session.run().environment()->robot_names().front();
    CHECK(f.ask({{"command", "world_edit"},
                 {"operations", {{{"do", "remove"}, {"id", name}}}},
                 {"run", true}})["ok"] == false);
    CHECK(world()->bugs() == 1);  // only what is moved gets into the run at once
}

TEST_CASE("a light that is moved does not take along what else was edited on the map") {
    Fixture f;
    const auto world = [&] { return dynamic_cast<const bug::World*>(f.session.run().environment()); };
    const auto light = world()->targets().front();
    const json items = f.result({{"command", "world_document"}})["items"];
    const auto item = std::ranges::find_if(items, [](const json& i) { return i["kind"] == "light"; });
    REQUIRE(item != items.end());
    const auto to = [&](double x) -> json {
        return {{"command", "world_edit"},
                {"operations", {{{"do", "move"}, {"id", (*item)["id"]}, {"x", x}, {"y", light.y()}}}},
                {"run", true}};
    };
    // Before the first cycle, a robot stays where it was put.
    const auto name = f.session.run().environment()->robot_names().front();
    f.result({{"command", "move"}, {"robot", name}, {"x", 0.5}, {"y", 0.25}});
    f.result(to(light.x() + 0.25));
    CHECK(world()->targets().front().x() == Approx(light.x() + 0.25));
    CHECK(f.session.run().environment()->pose(0).x == Approx(0.5));
    // A ball that was added on the map waits until the world is saved.
    f.result({{"command", "step"}, {"cycles", 40}});
    const auto moving = world()->body_poses().bodies.size();
    f.result(
        {{"command", "world_edit"}, {"operations", {{{"do", "add"}, {"kind", "ball"}, {"x", 1}, {"y", 1}}}}});
    f.result(to(light.x() + 0.5));
    CHECK(f.session.run().cycle() == 40);
    CHECK(world()->body_poses().bodies.size() == moving);
    f.result({{"command", "undo"}}), f.result({{"command", "undo"}}), f.result({{"command", "undo"}});
    CHECK(world()->targets().front().x() == Approx(light.x()));
    CHECK(f.result({{"command", "world_document"}})["dirty"] == false);
}

TEST_CASE("a world that comes with Forage is not written") {
    const std::string world = Fixture::input().world;
    const auto before = read_file(world);
    Session session(
        Fixture::input(), [](int, bool, const std::string&) {}, {}, FORAGE_SOURCE_DIR "/systems");
    const json listed = session.execute(-1, {{"command", "shipped"}})["result"]["worlds"];
    CHECK(std::ranges::find(listed, json(world)) != listed.end());
    const json refused =
        session.execute(-1, {{"command", "world_save"}, {"file", world}, {"overwrite", true}});
    CHECK(refused["ok"] == false);
    CHECK(refused.dump().find("stays as it is") != std::string::npos);
    CHECK(read_file(world) == before);
    // Also under the name by which a link of its folder leads to it.
    const auto link = test::temporary_path("forage-studio-shipped");
    std::filesystem::remove(link);
    std::filesystem::create_directory_symlink(FORAGE_SOURCE_DIR "/systems", link);
    Session linked(
        Fixture::input(), [](int, bool, const std::string&) {}, {}, link.string());
    CHECK(linked.comes_with_forage(world));
    CHECK(linked.comes_with_forage((link / "worlds/own.world").string()));
    CHECK_FALSE(linked.comes_with_forage((link.parent_path() / "own.world").string()));
    std::filesystem::remove(link);
}

TEST_CASE("a restart tells its seed, and how to do it without the studio") {
    Fixture f;
    f.session.connect(1);
    f.result({{"command", "restart"}, {"seed", 7}});
    const auto& sent = f.messages[1];
    const auto action = std::ranges::find_if(sent, [](const json& m) { return m["type"] == "action"; });
    REQUIRE(action != sent.end());
    CHECK((*action)["shell"] == "--seed 7");
    CHECK((*action)["python"].get<std::string>().find("seed=7)") != std::string::npos);
}

TEST_CASE("a recording that begins with each run is one of a sequence, unless it says otherwise") {
    Fixture f;
    const auto folder = test::temporary_path("forage-studio-sequence");
    std::filesystem::remove_all(folder), std::filesystem::create_directories(folder);
    json command = {{"command", "sample"},
                    {"file", (folder / "t.csv").string()},
                    {"sources", {"Bug/Light"}},
                    {"automatic", true}};
    command["mode"] = "new";
    CHECK(f.ask(command)["ok"] == false);
    command.erase("mode");
    f.result(command);
    for (int i = 0; i < 2; ++i) f.result({{"command", "step"}}), f.result({{"command", "stop"}});
    CHECK(std::filesystem::exists(folder / "t_001.csv"));
    CHECK(std::filesystem::exists(folder / "t_002.csv"));
    std::filesystem::remove_all(folder);
}

TEST_CASE("a recording that waits for a run is appended to one of the same sources only") {
    Fixture f;
    const auto folder = test::temporary_path("forage-studio-append");
    std::filesystem::remove_all(folder), std::filesystem::create_directories(folder);
    const auto file = (folder / "t.csv").string();
    json command = {{"command", "sample"}, {"file", file}, {"sources", {"Bug/Light"}}};
    f.result(command), f.result({{"command", "step"}}), f.result({{"command", "stop"}});
    const auto before = read_file(file);
    command["automatic"] = true, command["mode"] = "append", command["sources"] = {"Bug/Motor"};
    const json answer = f.ask(command);
    CHECK(answer["ok"] == false);
    CHECK(answer.dump().find("does not hold the same sources") != std::string::npos);
    f.result({{"command", "step"}}), f.result({{"command", "stop"}});
    CHECK(read_file(file) == before);
    command["sources"] = {"Bug/Light"};
    f.result(command), f.result({{"command", "step"}}), f.result({{"command", "stop"}});
    CHECK(read_file(file).size() > before.size());
    CHECK(std::ranges::distance(std::filesystem::directory_iterator(folder)) == 1);
    std::filesystem::remove_all(folder);
}

TEST_CASE("the open system moves to another world, with its edits") {
    Fixture f;
    f.session.connect(1);
    f.result({{"command", "set"}, {"assignments", {"Bug/Light.threshold=0.5"}}});
    const std::string world = FORAGE_SOURCE_DIR "/systems/worlds/open_arena.world";
    f.result({{"command", "step"}});
    f.result({{"command", "world_open"}, {"world", world}});
    CHECK(f.session.run().cycle() == 0);
    CHECK(f.session.edited.input.world == world);
    CHECK(std::get<double>(f.session.run().parameter("Bug/Light.threshold")) == 0.5);
    CHECK(f.result({{"command", "world_document"}})["file"] == world);
    CHECK(f.ask({{"command", "world_open"}, {"world", "/no.world"}})["ok"] == false);
    CHECK(f.session.edited.input.world == world);
}

TEST_CASE("the time between two savings of a session is set, and holds for the next studio") {
    const auto folder = test::temporary_path("forage-studio-settings");
    std::filesystem::remove_all(folder);
    setenv("XDG_STATE_HOME", folder.c_str(), 1);
    std::uint64_t cycle = 0;
    {
        Fixture f;
        CHECK(f.result({{"command", "settings"}})["save_interval"] == 20);
        CHECK(f.result({{"command", "settings"}, {"save_interval", 5}})["save_interval"] == 5);
        for (const double refused : {4.9, 61.})
            CHECK(f.ask({{"command", "settings"}, {"save_interval", refused}})["ok"] == false);
        f.session.keep();
        f.result({{"command", "speed"}, {"mode", "free"}});
        f.result({{"command", "run"}});
        f.session.work(1000);
        f.session.work(1006);
        cycle = f.session.run().cycle();
        f.session.work(1007);
    }  // without end()
    Fixture next;
    CHECK(next.result({{"command", "settings"}})["save_interval"] == 5);
    next.session.keep();
    CHECK(next.session.killed().at("cycle") == cycle);
    std::filesystem::remove_all(folder);
}

TEST_CASE("a session that is killed while it runs continues where it was kept, byte by byte") {
    const auto folder = test::temporary_path("forage-studio-states");
    std::filesystem::remove_all(folder);
    setenv("XDG_STATE_HOME", folder.c_str(), 1);
    std::uint64_t kept = 0;
    {
        Fixture f;
        f.session.keep();
        f.result({{"command", "speed"}, {"mode", "free"}});
        f.result({{"command", "run"}});
        f.session.work(1000);
        f.result({{"command", "set"}, {"assignments", {"Bug/Light.threshold=0.25"}}});
        f.session.work(1010);  // too early to be kept again
        f.session.work(1021);
        kept = f.session.run().cycle();
        f.session.work(1030);
        CHECK(f.session.run().cycle() > kept);
    }  // without end()
    Fixture f, undisturbed;
    f.session.keep();
    REQUIRE(f.session.killed().at("cycle") == kept);
    f.session.recover();
    CHECK(f.session.run().cycle() == kept);
    json actions = f.result({{"command", "history"}})["actions"];
    REQUIRE(actions.size() == 1);
    undisturbed.result({{"command", "step"}, {"cycles", actions[0]["cycle"]}});
    undisturbed.result({{"command", "set"}, {"assignments", {"Bug/Light.threshold=0.25"}}});
    undisturbed.result(
        {{"command", "step"}, {"cycles", kept + 100 - actions[0]["cycle"].get<std::uint64_t>()}});
    f.result({{"command", "step"}, {"cycles", 100}});
    CHECK(f.session.run().digest() == undisturbed.session.run().digest());
    f.session.end();
    CHECK(std::filesystem::is_empty(folder / "forage/studio"));
    std::filesystem::remove_all(folder);
}

TEST_CASE("a light that was moved is where it was put after a crash, too") {
    const auto folder = test::temporary_path("forage-studio-lights");
    std::filesystem::remove_all(folder);
    setenv("XDG_STATE_HOME", folder.c_str(), 1);
    const auto light = [](Fixture& f) {
        return dynamic_cast<const bug::World&>(*f.session.run().environment()).targets().front().x();
    };
    double moved = 0;
    std::string digest;
    {
        Fixture f;
        f.session.keep();
        f.result({{"command", "step"}, {"cycles", 20}});
        const json items = f.result({{"command", "world_document"}})["items"];
        const auto item = std::ranges::find_if(items, [](const json& i) { return i["kind"] == "light"; });
        REQUIRE(item != items.end());
        moved = light(f) + 0.5;
        f.result(
            {{"command", "world_edit"},
             {"operations", {{{"do", "move"}, {"id", (*item)["id"]}, {"x", moved}, {"y", (*item)["y"]}}}},
             {"run", true}});
        f.result({{"command", "step"}, {"cycles", 20}});
        f.session.work(1000);
        digest = f.session.run().digest();
    }  // without end()
    Fixture f;
    f.session.keep();
    REQUIRE(f.session.killed().at("cycle") == 40);
    f.session.recover();
    CHECK(light(f) == Approx(moved));
    CHECK(f.session.run().digest() == digest);
    CHECK(f.result({{"command", "world_document"}})["dirty"] == true);
    f.session.end();
    std::filesystem::remove_all(folder);
}

TEST_CASE("a comparison continues after a crash, bit by bit") {
    const auto folder = test::temporary_path("forage-studio-compares");
    std::filesystem::remove_all(folder);
    setenv("XDG_STATE_HOME", folder.c_str(), 1);
    const auto at = [](Fixture& x, const char* source) {
        return x.result({{"command", "read"}, {"source", source}})["values"];
    };
    json now, beside;
    {
        Fixture f;
        f.session.keep();
        f.result({{"command", "step"}, {"cycles", 50}});
        f.result({{"command", "set"}, {"assignments", {"Bug/Light.excGain=0.5"}}});
        f.result({{"command", "step"}, {"cycles", 250}});
        f.result({{"command", "compare"}, {"cycle", 100}, {"assignments", {"Bug/Light.threshold=0.9"}}});
        f.result({{"command", "step"}, {"cycles", 100}});
        f.session.work(1000);  // is kept
        f.result({{"command", "step"}, {"cycles", 300}});
        now = at(f, "world:poses"), beside = at(f, "reference:world:poses");
    }  // without end()
    REQUIRE(now != beside);
    Fixture f;
    f.session.connect(1);
    f.session.keep();
    f.session.recover();
    CHECK(f.session.run().cycle() == 200);
    f.session.work(1000);
    CHECK(f.messages[1].back()["compare"]["from"] == 100);
    f.result({{"command", "step"}, {"cycles", 300}});
    CHECK(at(f, "world:poses") == now);
    CHECK(at(f, "reference:world:poses") == beside);
    f.result({{"command", "seek"}, {"cycle", 150}});  // both go back
    f.result({{"command", "step"}, {"cycles", 350}});
    CHECK(at(f, "reference:world:poses") == beside);
    f.session.end();
    std::filesystem::remove_all(folder);
}

TEST_CASE("a comparison that begins or ends while the run rests is kept") {
    const auto folder = test::temporary_path("forage-studio-rests");
    std::filesystem::remove_all(folder);
    setenv("XDG_STATE_HOME", folder.c_str(), 1);
    {
        Fixture f;
        f.session.keep();
        f.result({{"command", "step"}, {"cycles", 7}});
        f.session.work(1000);
        f.result({{"command", "compare"}});
        f.session.work(2000);
    }  // without end()
    {
        Fixture f;
        f.session.keep(), f.session.recover();
        CHECK(f.session.status()["compare"]["from"] == 7);
        f.session.work(1000);
        f.result({{"command", "compare_end"}});
        f.session.work(2000);
    }
    Fixture f;
    f.session.keep(), f.session.recover();
    CHECK(f.session.run().cycle() == 7);
    CHECK(f.session.status()["compare"].is_null());
    f.session.end();
    std::filesystem::remove_all(folder);
}

TEST_CASE("two runs go side by side from any moment: one as it was, one with another parameter") {
    Fixture f, before;
    const auto both = [](Fixture& x) {
        x.result({{"command", "step"}, {"cycles", 300}});
        x.result({{"command", "manipulate"},
                  {"group", "Bug/Motor"},
                  {"patterns", {std::vector<double>(81, 0.2)}}});
        x.result({{"command", "step"}, {"cycles", 300}});
    };
    both(f), both(before);
    const auto at = [](Fixture& x, const char* source) {
        return x.result({{"command", "read"}, {"source", source}})["values"];
    };
    const auto earlier = at(before, "world:poses");

    f.session.connect(1);
    f.result({{"command", "compare"}, {"cycle", 200}, {"assignments", {"Bug/Light.threshold=0.9"}}});
    CHECK(f.session.run().cycle() == 200);
    CHECK(at(f, "reference:world:poses") == at(f, "world:poses"));
    const auto stream =
        f.result({{"command", "subscribe"}, {"source", "reference:mean(Bug/Motor)"}, {"delivery", "append"}});
    CHECK(stream["rows"] == 1);
    f.result({{"command", "step"}, {"cycles", 400}});
    CHECK(at(f, "reference:world:poses") == earlier);  // with what was done at cycle 300
    CHECK(at(f, "world:poses") != earlier);
    CHECK(f.result({{"command", "parameters"}, {"item", "Bug/Light"}}).dump().find("0.9") !=
          std::string::npos);

    f.result({{"command", "seek"}, {"cycle", 250}});  // both go back
    f.result({{"command", "step"}, {"cycles", 350}});
    CHECK(at(f, "reference:world:poses") == earlier);
    f.result({{"command", "seek"}, {"cycle", 100}});  // before they differ, there is one run
    CHECK(f.ask({{"command", "read"}, {"source", "reference:world:poses"}})["ok"] == false);

    Fixture alone;
    alone.result({{"command", "step"}, {"cycles", 200}});
    alone.result({{"command", "set"}, {"assignments", {"Bug/Light.threshold=0.9"}}});
    alone.result({{"command", "step"}, {"cycles", 100}});
    f.result({{"command", "seek"}, {"cycle", 300}});
    CHECK(f.session.run().digest() ==
          alone.session.run().digest());  // the reference changes no bit of the run
}

namespace {

/// Lets the process write at most so many bytes into a file, as a full disk does.
class FileLimit {
  public:
    explicit FileLimit(rlim_t bytes) {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        ::signal(SIGXFSZ, SIG_IGN);
        const rlimit now = {bytes, before_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &now);
    }
    ~FileLimit() { ::setrlimit(RLIMIT_FSIZE, &before_); }
    FileLimit(const FileLimit&) = delete;
    FileLimit& operator=(const FileLimit&) = delete;

  private:
    rlimit before_{};
};

}  // namespace

TEST_CASE("a recording whose disk is full ends with its reason, and the run continues") {
    Fixture f;
    f.session.connect(1);
    const auto file =
        std::filesystem::temp_directory_path() / fmt::format("forage-full-disk-{}.csv", ::getpid());
    const auto sample = [&] {
        f.result({{"command", "sample"},
                  {"file", file.string()},
                  {"sources", {"Bug/Place Cells"}},
                  {"mode", "overwrite"}});
    };
    const auto reason = [&] {
        for (const auto& m : f.messages[1])
            if (m["type"] == "action" && m["command"] == "sample_stop") return m.value("failed", "");
        return std::string("still recording");
    };
    sample();
    {
        const FileLimit full(20'000);
        f.result({{"command", "step"}, {"cycles", 2000}});
    }
    CHECK(f.session.run().cycle() == 2000);
    CHECK(f.session.live.failed.empty());
    CHECK(!f.session.live.sampler);
    CHECK(reason().starts_with("the recording into '" + file.string() + "' has failed: "));
    f.result({{"command", "step"}});

    f.messages[1].clear();
    sample();
    f.result({{"command", "step"}, {"cycles", 10}});
    {
        const FileLimit full(0);  // the rows are still in memory
        CHECK(f.ask({{"command", "sample_stop"}})["ok"] == false);
    }
    CHECK(!reason().empty());
    f.result({{"command", "step"}});
    std::filesystem::remove(file), std::filesystem::remove(partial(file.string()));
}

TEST_CASE("a cycle that cannot be computed is noted however it was asked for") {
    struct Failing final : Observer {
        void before_cycle(RunView& run) override {
            if (run.time.cycle == 5) throw std::runtime_error("cycle 5 is cursed");
        }
    };
    const auto begin = [](Fixture& f) { f.session.run().add(std::make_unique<Failing>()); };
    const auto check = [](Fixture& f) {
        CHECK(f.session.live.failed == "cycle 5 is cursed");
        CHECK(!f.session.live.pace.running);
        CHECK(f.ask({{"command", "run"}})["ok"] == false);
        CHECK(f.result({{"command", "seek"}, {"cycle", 0}})["cycle"] == 0);
        CHECK(f.session.live.failed.empty());
    };
    {
        Fixture f;
        begin(f);
        CHECK(f.ask({{"command", "step"}, {"cycles", 10}})["ok"] == false);
        check(f);
    }
    {
        Fixture f;
        begin(f);
        f.result({{"command", "speed"}, {"mode", "free"}});
        f.result({{"command", "run"}});
        for (double now = 1; f.session.live.pace.running; ++now) f.session.work(now);
        check(f);
    }
    {
        Fixture f;
        f.result({{"command", "step"}, {"cycles", 10}});
        f.result({{"command", "seek"}, {"cycle", 3}});
        begin(f);
        CHECK(f.ask({{"command", "seek"}, {"cycle", 8}})["ok"] == false);
        check(f);
    }
}
