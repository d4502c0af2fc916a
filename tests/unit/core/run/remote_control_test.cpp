// Remote control: the texts of commands, sockets, and what commands do to a run.
#include "core/run/remote_control.h"

#include "core/model/build.h"
#include "core/run/run.h"
#include "neurons/neurons.h"
#include "synapses/synapses.h"
#include "tests/support/catch.h"

using namespace forage;

namespace {

using Kind = RemoteCommand::Kind;
using Item = RemoteCommand::Item;

std::string problem_of(std::string_view text) {
    std::string problem;
    CHECK_FALSE(parse_remote_command(text, problem));
    return problem;
}

RemoteCommand command_of(std::string_view text) {
    std::string problem;
    const auto command = parse_remote_command(text, problem);
    INFO(problem);
    REQUIRE(command);
    return *command;
}

}  // namespace

TEST_CASE("Commands of one word, with and without an end") {
    for (const std::string end : {"", ";", ";\n", "\r\n"}) {
        CHECK(command_of("cmd:start" + end).kind == Kind::start);
        CHECK(command_of("cmd:stop" + end).kind == Kind::stop);
        CHECK(command_of("cmd:quit" + end).kind == Kind::quit);
        CHECK(command_of("cmd:startsampler" + end).kind == Kind::start_sampler);
        CHECK(command_of("cmd:stopsampler" + end).kind == Kind::stop_sampler);
    }
}

TEST_CASE("A command names a parameter of an item by name or by id, and values may have any text") {
    const auto by_name =
        command_of("cmd:param;itemType:NEURON;itemName:Light ;paramName:threshold;value:0.5;");
    CHECK(by_name.kind == Kind::set_parameter);
    CHECK(by_name.item == Item::group);
    CHECK(by_name.name == "Light ");
    CHECK_FALSE(by_name.by_id);
    CHECK(by_name.parameter == "threshold");
    CHECK(by_name.value == "0.5");
    const auto by_id =
        command_of("cmd:param;itemtype:connection;itemID:L-1;paramID:weight;value:a:b=\xc3\xa9");
    CHECK(by_id.item == Item::connection);
    CHECK(by_id.by_id);
    CHECK(by_id.value == "a:b=\xc3\xa9");
    CHECK(command_of("value:1;paramName:eta;itemName:P;itemType:MODULE;cmd:param").item == Item::process);
    CHECK(command_of("cmd:plot;itemType:GROUP;itemID:L-1").parameter.empty());
}

TEST_CASE("What is not a command is refused with the reason") {
    CHECK(problem_of("") == "it has no field cmd");
    CHECK(problem_of("start") == "'start' has no ':'");
    CHECK(problem_of("cmd:run") ==
          "cmd:run is none of start, stop, quit, startsampler, stopsampler, param, plot");
    CHECK(problem_of("cmd:stop;value:1") == "cmd:stop has no other fields");
    CHECK(problem_of("cmd:stop;cmd:start") == "cmd is given twice");
    CHECK(problem_of("cmd:param;paramName:a;paramID:b") == "paramID is given twice");
    CHECK(problem_of("cmd:param;colour:red") ==
          "'colour' is none of cmd, itemType, itemName, itemID, paramName, paramID, value");
    CHECK(problem_of("cmd:param") == "it has no field itemType");
    CHECK(problem_of("cmd:param;itemType:ROBOT") ==
          "itemType:ROBOT is none of GROUP, NEURON, CONNECTION, CONN, SYNAPSE, PROCESS, MODULE");
    CHECK(problem_of("cmd:param;itemType:GROUP") == "it needs one of the fields itemName and itemID");
    CHECK(problem_of("cmd:param;itemType:GROUP;itemName:a;itemID:b") ==
          "it needs one of the fields itemName and itemID");
    CHECK(problem_of("cmd:param;itemType:GROUP;itemName:") == "the name of the item is empty");
    CHECK(problem_of("cmd:param;itemType:GROUP;itemName:a;value:1") ==
          "it has no field paramName or paramID");
    CHECK(problem_of("cmd:param;itemType:GROUP;itemName:a;paramName:b") == "it has no field value");
    CHECK(problem_of("cmd:plot;itemType:PROCESS;itemName:a") == "a process has no plot");
    CHECK(problem_of("cmd:stop\x1b[2J") == "it is not UTF-8 without control characters");
    CHECK(problem_of("cmd:stop;value:\xff") == "it is not UTF-8 without control characters");
    CHECK(problem_of("cmd:" + std::string(5000, 'a')) == "it has more than 4096 bytes");
}

TEST_CASE("Endpoints") {
    CHECK(parse_endpoint("54923")->text() == "127.0.0.1:54923");
    CHECK(parse_endpoint("0.0.0.0:1")->text() == "0.0.0.0:1");
    CHECK(parse_endpoint("lab-3.example:65535")->text() == "lab-3.example:65535");
    for (const auto* text : {"", ":", ":1", "a:", "65536", "-1", "+1", "a b:1", "a:1:", "1.5", "::1:5"})
        CHECK_FALSE(parse_endpoint(text));
}

TEST_CASE("A command changes every item of its name between two cycles, or none of them") {
    model::System system;
    const auto p = model::add_process(system, "P");
    model::add_group(system, p, "A", 2, 1, "neuronLinearThreshold");
    const auto b = model::add_group(system, p, "B", 2, 1, "neuronLinearThreshold");
    model::add_group(system, model::add_process(system, "Q"), "A", 1, 1, "neuronRandomSpike");
    Registry registry;
    add_neurons(registry);
    add_synapses(registry);
    Diagnostics diagnostics;
    auto run = Run::make(system, registry, nullptr, {}, diagnostics);
    REQUIRE(run);
    std::vector<std::string> lines;
    auto& remote = run->add(std::make_unique<RemoteControl>(Endpoint{}));
    remote.log = [&](const std::string& line) { lines.push_back(line); };
    auto sender = UdpSocket::connect(*parse_endpoint(remote.address()));
    const auto execute = [&](std::string_view text) {
        sender.send(text);
        remote.wait();
        remote.execute_pending(*run);
    };
    run->step();
    execute("cmd:param;itemType:GROUP;itemName:A;paramName:probability;value:0.25");
    CHECK(run->parameter("P/A.probability") == ParameterValue(0.25));
    CHECK(run->parameter("Q/A.probability") == ParameterValue(0.25));
    CHECK(run->parameter("P/B.probability") == ParameterValue(1.0));
    execute("cmd:param;itemType:GROUP;itemName:A;paramName:threshold;value:0.25");  // Q/A has none
    CHECK(run->parameter("P/A.threshold") == ParameterValue(0.0));
    execute("cmd:param;itemType:NEURON;itemID:" + b + ";paramID:Threshold potential;value:0.75;");
    CHECK(run->parameter("P/B.threshold") == ParameterValue(0.75));
    execute("cmd:param;itemType:GROUP;itemName:A;paramName:probability;value:much");
    execute("cmd:param;itemType:GROUP;itemName:C;paramName:probability;value:1");
    execute("cmd:startsampler");
    execute("nonsense");
    REQUIRE(remote.executed().size() == 2);
    CHECK(remote.executed()[0].cycle == 1);
    CAPTURE(lines);
    REQUIRE(lines.size() == 7);
    CHECK(lines[0] == "cycle 1: cmd:param;itemType:GROUP;itemName:A;paramName:probability;value:0.25");
    CHECK(lines[1].ends_with(": 'A' has no parameter 'threshold'"));
    CHECK(lines[3].ends_with(": probability = 'much' is not a number"));
    CHECK(lines[4].ends_with(": nothing of this type is called 'C'"));
    CHECK(lines[5] == "refused cmd:startsampler: this run records nothing; --record says what");
    CHECK(lines[6] == "a datagram is not a command: 'nonsense' has no ':'");
    execute("cmd:stop");
    CHECK(remote.paused());
    execute("cmd:start");
    CHECK_FALSE(remote.paused());
    execute("cmd:quit");
    CHECK(remote.quit());
}

namespace {

/// A run with remote control, and a socket that sends to it.
struct Remote {
    Remote() {
        model::System system;
        model::add_group(system, model::add_process(system, "P"), "A", 1, 1, "neuronLinearThreshold");
        Registry registry;
        add_neurons(registry);
        Diagnostics diagnostics;
        run = Run::make(system, registry, nullptr, {}, diagnostics);
        REQUIRE(run);
        control = &run->add(std::make_unique<RemoteControl>(Endpoint{}));
        control->log = [this](const std::string& line) { lines.push_back(line); };
        run->step();
    }
    std::optional<Run> run;
    RemoteControl* control = nullptr;
    std::vector<std::string> lines;
};

}  // namespace

TEST_CASE("Garbage is reported ten times, then at the 100th datagram, the 1000th, and so on") {
    Remote here;
    auto sender = UdpSocket::connect(*parse_endpoint(here.control->address()));
    const std::string refused = "cmd:param;itemType:GROUP;itemName:B;paramName:x;value:";
    for (int i = 0; i < 3000; ++i) {
        sender.send(i % 2 ? "\x1b[2J" : refused + std::to_string(i));
        if (i % 25 == 0) here.control->execute_pending(*here.run);
    }
    CAPTURE(here.lines);
    const auto dropped = std::ranges::count_if(
        here.lines, [](const auto& line) { return line.starts_with("a datagram is dropped"); });
    CHECK(dropped <= 13);
    CHECK(here.lines.size() - static_cast<std::size_t>(dropped) <= 12);
    CHECK(here.lines[9].ends_with("(10 datagrams so far)"));
}

TEST_CASE("More than a hundred commands at once are dropped") {
    Remote here;
    auto& run = here.run;
    auto& remote = *here.control;
    auto sender = UdpSocket::connect(*parse_endpoint(remote.address()));
    for (int i = 0; i < 10000; ++i) {
        sender.send("cmd:start");
        if (i % 50 == 0) remote.execute_pending(*run);
    }
    // The allowance grows by 100 a second; on a machine that takes seconds for this loop, more commands fit.
    CHECK(remote.executed().size() >= 100);
    CHECK(remote.executed().size() < 1000);
}
