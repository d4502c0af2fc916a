#include "bug_interface/module/gazebo_bug.h"

#include <algorithm>
#include <map>
#include <numbers>

#include <fmt/format.h>

#include "core/types/registry.h"
#include "tests/unit/bug_interface/worlds.h"

using namespace forage;
using namespace forage::bug;

namespace {

GroupShape shape(int width, int height) { return {width, height, width * height}; }

/// Runs the module with groups at its ports, as the engine does.
struct Bench {
    ModuleType type;
    std::unique_ptr<ModuleInstance> module;
    ModulePorts ports;
    std::vector<std::vector<double>> in_cells, out_cells;
    std::vector<ConstColumn> in;
    std::vector<Column> out;

    explicit Bench(World* world) : type(gazebo_bug_type()), module(type.make()) {
        ports.environment = world;
        for (const ModulePort& p : type.ports) {
            const std::map<std::string_view, GroupShape> sensors = {
                {"_proximity", shape(32, 1)}, {"_target", shape(32, 1)}, {"_gps", shape(3, 1)}};
            const auto it = sensors.find(p.name);
            (p.is_output ? ports.outputs : ports.inputs)
                .push_back({p.name, "Bug/" + p.name, it == sensors.end() ? GroupShape{} : it->second});
        }
        group("_motor") = shape(9, 9);
        set("device_name", std::string("Bug"));
    }
    GroupShape& group(const std::string& port) {
        for (auto* side : {&ports.inputs, &ports.outputs})
            for (auto& g : *side)
                if (g.port == port) return g.shape;
        FAIL("no port " << port);
        throw;
    }
    std::vector<double>& output(const std::string& port) {
        for (std::size_t i = 0; i < ports.outputs.size(); ++i)
            if (ports.outputs[i].port == port) return out_cells[i];
        FAIL("no port " << port);
        throw;
    }
    void set(const std::string& name, const ParameterValue& value) {
        for (const Parameter& p : type.parameters)
            if (p.name == name) return p.set(module->parameters(), value);
        FAIL("no parameter " << name);
    }
    std::string problem(bool lenient = false) {
        Diagnostics diagnostics;
        diagnostics.lenient = lenient;
        check_sizes(type, ports, module->parameters(), diagnostics);
        if (!diagnostics.failed()) module->check(ports, diagnostics);
        if (diagnostics.all().empty()) return {};
        CHECK(diagnostics.all().size() == 1);
        const auto& p = diagnostics.all().front();
        return p.message + (p.hint.empty() ? "" : " | " + p.hint) + (p.port.empty() ? "" : " @" + p.port) +
               (p.parameter.empty() ? "" : " @" + p.parameter);
    }
    void start() {
        for (const auto& g : ports.inputs) in_cells.emplace_back(static_cast<std::size_t>(g.shape.cells));
        for (const auto& g : ports.outputs) out_cells.emplace_back(static_cast<std::size_t>(g.shape.cells));
        for (auto& c : in_cells) in.emplace_back(c.data(), static_cast<Index>(c.size()));
        for (auto& c : out_cells) out.emplace_back(c.data(), static_cast<Index>(c.size()));
        ModuleFrame frame(0, in, out);
        module->start(ports, frame);
    }
    void update(std::uint64_t cycle = 0) {
        ModuleFrame frame(cycle, in, out);
        module->update(frame);
    }
};

void all_groups(Bench& b) {
    b.group("_image_RH") = b.group("_image_GS") = b.group("_image_BV") = shape(28, 28);
    b.group("placeCell") = shape(20, 20);
    b.group("headCell") = shape(16, 1);
    b.group("_audio_in") = b.group("_audio_out") = shape(36, 1);
    b.group("_gripper") = shape(1, 1);
    b.group("_proximityGripper") = shape(16, 1);
}

}  // namespace

TEST_CASE("The module type has the original's names and defaults") {
    const ModuleType type = gazebo_bug_type();
    CHECK(type.name == "moduleGazeboBug");
    std::map<std::string, std::string> defaults;
    for (const auto& p : type.parameters) defaults[p.name] = to_text(p.default_value);
    CHECK(defaults == std::map<std::string, std::string>{{"device_name", "iqrGazebo"},
                                                         {"cps", "25"},
                                                         {"comkey", ""},
                                                         {"gripper", "true"},
                                                         {"grayscale", "false"},
                                                         {"hsv", "false"},
                                                         {"transSpeed", "1"},
                                                         {"rotSpeed", "0.1"},
                                                         {"placeXOffset", "0"},
                                                         {"placeYOffset", "0"},
                                                         {"placeXMax", "10"},
                                                         {"placeYMax", "10"},
                                                         {"placeSigma", "0.2"},
                                                         {"headSigma", "0.2"}});
    Registry registry;
    registry.add(type);
    CHECK(registry.module("moduleGazeboBug"));
}

TEST_CASE("The cells of its groups have names: what they command, and where they look") {
    const auto world = test::make_world(test::description("basic_arena"));
    Bench bench(world.get());
    const auto names = [&](const std::string& port, GroupShape shape) {
        for (const auto& p : bench.type.ports)
            if (p.name == port) return p.names(bench.module->parameters(), bench.ports, shape);
        return CellNames();
    };
    const auto motor = names("_motor", shape(9, 9));
    CHECK(motor.of(5, 1) == "ahead 100 %, straight");
    CHECK(motor.of(1, 4) == "ahead 25 %, left 100 %");
    CHECK(motor.of(9, 5) == "on the spot, right 100 %");
    CHECK(motor.of(7, 9) == "back 100 %, right 50 %");
    const auto light = names("_target", shape(32, 1));
    CHECK(light.columns.size() == 32);
    CHECK(light.of(1, 1).starts_with("left 1"));
    CHECK(light.of(32, 1).starts_with("right 1"));
    CHECK(names("_gps", shape(3, 1)).of(2, 1) == "y + 10 m");
    CHECK(names("headCell", shape(8, 1)).of(3, 1) == "south");
    bench.ports.environment = nullptr;
    CHECK_FALSE(names("_target", shape(32, 1)).any());
}

TEST_CASE("The module accepts the groups of the tutorials") {
    const auto world = test::make_world(test::description("basic_arena"));
    Bench bench(world.get());
    CHECK(bench.problem().empty());
    all_groups(bench);
    CHECK(bench.problem() ==
          "robot 'Bug' has no gripper | set 'gripper' to false, or use a robot with a gripper @gripper");
    bench.set("gripper", false);
    CHECK(bench.problem().empty());
    bench.group("_gripper") = shape(3, 1);
    CHECK(bench.problem().empty());
    CHECK(Bench(nullptr).problem().empty());
}

TEST_CASE("The module reports errors of its groups and parameters") {
    const auto world = test::make_world(test::description("basic_arena"));
    {
        Bench b(world.get());
        b.group("_motor") = shape(9, 5);
        CHECK(
            b.problem() ==
            "'_motor' needs a square with an odd number of rows, at least 3, such as 9 x 9; 'Bug/_motor' is "
            "9 x 5 | make the group 9 x 9 @_motor");
        CHECK_THAT(b.problem(true), ContainsSubstring("is 9 x 5"));
    }
    {
        Bench b(world.get());
        b.group("_motor") = shape(1, 1);
        CHECK_FALSE(b.problem(true).empty());
    }
    {
        Bench b(world.get());
        b.group("_motor") = shape(10, 10);  // without a middle cell; the original accepts it
        CHECK_THAT(b.problem(), ContainsSubstring("| make the group 9 x 9; --lenient accepts it"));
        CHECK_THAT(b.problem(true), ContainsSubstring("is 10 x 10 | make the group 9 x 9 @_motor"));
    }
    {
        Bench b(world.get());  // the green channel is unset
        b.group("_image_RH") = shape(28, 28), b.group("_image_BV") = shape(28, 27);
        CHECK_THAT(b.problem(), ContainsSubstring("'Bug/_image_BV' is 28 x 27, 'Bug/_image_RH' 28 x 28"));
    }
    {
        Bench b(world.get());
        b.set("device_name", std::string("Bugg"));
        CHECK(b.problem().find("there is no robot 'Bugg' in the world") == 0);
        CHECK(b.problem().find("did you mean 'Bug'? @device_name") != std::string::npos);
    }
    {
        Bench b(world.get());
        all_groups(b);
        b.set("gripper", false);
        b.group("_image_GS") = shape(28, 27);
        b.group("_image_BV") = {};
        CHECK(b.problem() ==
              "'_image_GS' needs a full rectangle of at most 32 x 28 cells, the same for all image groups; "
              "'Bug/_image_GS' is 28 x 27, 'Bug/_image_RH' 28 x 28 | make the group 28 x 28 @_image_GS");
    }
    {
        Bench b(world.get());
        b.group("_image_RH") = shape(33, 28);
        CHECK_THAT(b.problem(),
                   ContainsSubstring("at most 32 x 28 cells") && ContainsSubstring("is 33 x 28"));
    }
    {
        Bench b(world.get());
        b.group("_gripper") = shape(2, 1);
        CHECK_THAT(b.problem(), ContainsSubstring("'_gripper' needs 1 cell if 'gripper' is true"));
    }
    {
        Bench b(world.get());
        b.set("placeSigma", 0.0);
        CHECK(b.problem().find("must be above 0 @placeSigma") != std::string::npos);
    }
    for (const char* speed : {"transSpeed", "rotSpeed"})
        for (const double value : {-1e300, 1e38, 1001.0}) {
            Bench b(world.get());
            b.set(speed, value);
            CHECK_THAT(
                b.problem(),
                ContainsSubstring(fmt::format(
                    "{0} is more than 1000 | in m/s and rad/s; a robot drives at about 1 @{0}", speed)));
        }
}

TEST_CASE(
    "A module without a world can be checked but not started, and a robot is driven by one module only") {
    Bench lonely(nullptr);
    CHECK_THROWS_WITH(lonely.start(), ContainsSubstring("--world"));
    const auto world = test::make_world(test::description("basic_arena"));
    auto first = std::make_unique<Bench>(world.get());
    first->start();
    Bench second(world.get());
    CHECK_THROWS_WITH(second.start(), ContainsSubstring("two modules drive the robot 'Bug'"));
    first.reset();
    second.start();
}

TEST_CASE("The motor group drives the robot in the cycle in which it is active") {
    WorldOptions options;
    options.noise = false;
    const auto world = test::make_world(test::description("basic_arena"), options);
    Bench bench(world.get());
    bench.start();
    bench.in_cells[0][4] = 1;  // (5, 1): straight on
    bench.update();
    CHECK(world->pose(0).y == -2);
    CHECK(bench.output("_gps")[1] == 8);
    world->step();
    CHECK(world->pose(0).y == Approx(-1.92));
    CHECK(bench.output("_gps")[1] == 8);  // until the next update
    bench.update(1);
    CHECK(bench.output("_gps")[1] == Approx(8.08));
}

TEST_CASE("The outputs have the robot's snapshot") {
    WorldOptions options;
    options.noise = false;
    auto arena = test::description("basic_arena");
    test::find_model(arena, "Bug")->pose = in_space({-1.5, 1.3, std::numbers::pi / 2});
    const auto world = test::make_world(arena, options);
    Bench bench(world.get());
    all_groups(bench);
    bench.start();
    bench.update();
    CHECK(bench.output("_gps") == std::vector<double>{8.5, 11.3, std::numbers::pi / 2 + std::numbers::pi});
    CHECK(bench.output("_proximity") == world->snapshot(0).proximity);
    CHECK(bench.output("_target") == world->snapshot(0).target);
    CHECK(*std::max_element(bench.output("_target").begin(), bench.output("_target").end()) > 0.3);
    const auto &red = bench.output("_image_RH"), &green = bench.output("_image_GS");
    CHECK(std::count_if(red.begin(), red.end(), [](double v) { return v > 0.9; }) == Approx(743).margin(25));
    CHECK(*std::max_element(green.begin(), green.end()) < 0.1);
    const auto& head = bench.output("headCell");
    CHECK(std::max_element(head.begin(), head.end()) - head.begin() == 12);  // the heading is +y
    CHECK(*std::max_element(bench.output("placeCell").begin(), bench.output("placeCell").end()) == 1);
    CHECK(bench.output("_audio_in") == std::vector<double>(36, 0));
    CHECK(bench.output("_proximityGripper") == std::vector<double>(16, 0));
}

TEST_CASE("Offsets move the area of the place cells but not the GPS; extents shift both") {
    WorldOptions options;
    options.noise = false;
    const auto world = test::make_world(test::description("basic_arena"), options);  // the robot at (0, -2)
    Bench bench(world.get());
    all_groups(bench);
    bench.set("placeXOffset", 1.0), bench.set("placeYOffset", -3.0);
    bench.set("placeXMax", 5.0), bench.set("placeYMax", 2.0);
    bench.start();
    bench.update();
    CHECK((bench.output("_gps")[0] == 5 && bench.output("_gps")[1] == 0));
    const auto& place = bench.output("placeCell");  // 20 x 20: half a side is 10 cells; (-0.2, 0.5) of it
    CHECK(std::max_element(place.begin(), place.end()) - place.begin() == 5 * 20 + 8);
}

TEST_CASE("The gripper closes above 0.5, and opens at 0.5 and below") {
    const auto world = test::make_world(test::description("team_arena"));
    Bench bench(world.get());
    all_groups(bench);
    bench.set("device_name", std::string("A_1"));
    bench.start();
    std::vector<double> angles;
    for (const double activity : {0.5, 0.51, 1.0, 0.0}) {
        bench.in_cells[1][0] = activity;
        for (int cycle = 0; cycle < 25; ++cycle) bench.update(), world->step();
        angles.push_back(world->gripper_angle(world->find("A_1").value(), 0));
    }
    CHECK(angles[0] == Approx(-0.2));
    CHECK(angles[1] == Approx(0.45));
    CHECK(angles[2] == Approx(0.45));
    CHECK(angles[3] == Approx(-0.2));
}

TEST_CASE("The trial group reports a target once, and the reset while it lasts") {
    auto arena = test::description("basic_arena");
    arena.trials.emplace();
    const auto world = test::make_world(arena);
    Bench bench(world.get());
    bench.group("_trial") = shape(2, 1);
    CHECK(bench.problem().empty());
    bench.start();
    bench.in_cells[0][4] = 1;  // straight on, from (0, -2) to the target
    int reached = 0, between = 0;
    for (std::uint64_t cycle = 0; cycle < 100; ++cycle) {
        bench.update(cycle);
        reached += bench.output("_trial")[0] > 0;
        between += bench.output("_trial")[1] > 0;
        world->step();
    }
    CHECK(reached == 1);
    CHECK(between == Approx(1.001 / world->seconds_per_cycle()).margin(1.1));
}
