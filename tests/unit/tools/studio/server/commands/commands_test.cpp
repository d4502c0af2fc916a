// The arguments of commands: which are accepted, and what is said of others.
#include <fmt/format.h>

#include "tests/support/catch.h"
#include "tests/support/paths.h"
#include "tools/studio/server/commands/command.h"

namespace {

using namespace forage;
using namespace forage::studio;

RunInput small_system() {
    RunInput out;
    out.system = FORAGE_SOURCE_DIR "/tests/diagnostics/sound/system.iqr";
    return out;
}

json sample(const ValueType& type) {
    switch (type.kind) {
        case ValueType::Kind::any:
            return 0;
        case ValueType::Kind::boolean:
            return true;
        case ValueType::Kind::whole:
        case ValueType::Kind::number:
            return static_cast<std::int64_t>(std::max(type.low, 0.));
        case ValueType::Kind::text:
        case ValueType::Kind::path:
            return "x";
        case ValueType::Kind::choice:
            return type.choices.front();
        case ValueType::Kind::list:
            return json::array({sample(type.element[0])});
        case ValueType::Kind::record:
            break;
    }
    json out = json::object();
    for (const auto& m : type.members) out[m.name] = sample(m.type);
    return out;
}

/// The message and the hint of a rejected command.
std::string refusal(Session& session, const json& command) {
    const json reply = session.execute(-1, command);
    INFO(command.dump() << reply.dump());
    REQUIRE(reply["ok"] == false);
    REQUIRE(reply["problems"].size() == 1);
    return reply["problems"][0]["message"].get<std::string>() + " | " +
           reply["problems"][0]["hint"].get<std::string>();
}

}  // namespace

TEST_CASE("a wrong argument is named, with its value and what is allowed") {
    Session session(small_system(), [](int, bool, const std::string&) {});
    const auto said = [&](const char* command) { return refusal(session, json::parse(command)); };
    CHECK(said(R"({"command": "step", "cycles": -3})") ==
          "command 'step': 'cycles' is -3 | a whole number from 1 to 1000000");
    CHECK(said(R"({"command": "step", "cycle": 3})") ==
          "command 'step': 'cycle' is not a member | did you mean 'cycles'?");
    CHECK(said(R"({"command": "pause", "cycles": 3})") ==
          "command 'pause': 'cycles' is not a member | it has no members");
    CHECK(said(R"({"command": "set"})") ==
          "command 'set': 'assignments' is missing | a list of at most 10000, each element a text");
    CHECK(said(R"({"command": "set", "assignments": ["a.b=1", 2]})") ==
          "command 'set': 'assignments[1]' is 2 | a text");
    CHECK(said(R"({"command": "panel_write", "file": "x", "rows": [{"item": "x"}]})") ==
          "command 'panel_write': 'rows[0].parameter' is missing | a text");
    CHECK(said(R"({"command": "speed", "mode": "fast"})") ==
          "command 'speed': 'mode' is \"fast\" | real, times, cycles or free");
    CHECK(said(R"({"command": "set", "assignments": [], "generation": "x"})") ==
          "command 'set': 'generation' is \"x\" | a whole number of at least 0");
    CHECK(said(R"({"command": "set", "assignments": [], "generation": null})")
              .starts_with("there is nothing to set"));
    CHECK(said(R"({"command": "read", "source": "x", "generation": 1})") ==
          "command 'read': 'generation' is not a member | there is 'source'");
    // The checks of an ending would see another name than the system does.
    CHECK(said(R"({"command": "open", "system": "/etc/shadow\u0000.iqr"})") ==
          "command 'open': 'system' is \"/etc/shadow\\u0000.iqr\" | a path without control characters");
    CHECK(said(R"({"command": "stpe"})") == "there is no command 'stpe' | did you mean 'step'?");
}

TEST_CASE("a list of more than 10,000 texts is refused at once") {
    Session session(small_system(), [](int, bool, const std::string&) {});
    for (const auto& [command, member] : {std::pair{"set", "assignments"}, {"copy", "ids"}}) {
        json message = {{"command", command}, {member, json(std::size_t{10'001}, json("x"))}};
        CHECK(refusal(session, message) ==
              fmt::format(
                  "command '{}': '{}' has 10001 elements | a list of at most 10000, each element a text",
                  command, member));
        message[member].erase(0);
        CHECK(session.execute(-1, message).dump().find("10001") == std::string::npos);
    }
}

TEST_CASE("a null stands for an argument with a default") {
    Session session(small_system(), [](int, bool, const std::string&) {});
    const json reply = session.execute(-1, {{"command", "step"}, {"cycles", nullptr}});
    CHECK(reply["result"]["cycle"] == 1);
    CHECK(refusal(session, {{"command", "set"}, {"assignments", nullptr}}) ==
          "command 'set': 'assignments' is null | a list of at most 10000, each element a text");
}

TEST_CASE("no command accepts an argument of another type, or one that it does not know") {
    Session session(small_system(), [](int, bool, const std::string&) {});
    const auto before = session.run().digest();
    const json values[] = {-2, 0.5, 1e300, "?", true, json::array({json::object()}), {{"?", 1}}};
    for (const auto& command : commands()) {
        json right = {{"command", command.name}};
        for (const auto& m : command.arguments) right[m.name] = sample(m.type);
        for (const auto& m : command.arguments)
            for (const auto& value : values) {
                if (!mismatch(value, m.type)) continue;
                json wrong = right;
                wrong[m.name] = value;
                CHECK(refusal(session, wrong).starts_with("command '" + command.name + "': '" + m.name));
            }
        right["unknown"] = 1;
        CHECK(refusal(session, right).find("'unknown' is not a member") != std::string::npos);
    }
    CHECK(session.run().digest() == before);
}
