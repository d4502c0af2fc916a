// Warnings about world files that are well formed but most likely contain a mistake.
#include <string>
#include <utility>
#include <vector>

#include "tests/unit/bug_interface/world_diagnostics.h"

using namespace forage;
using namespace forage::bug;
using namespace forage::test;

namespace {

/// The text of the basic arena with `element` inserted as the last line before </world>.
std::string world_with(const std::string& element) { return edited("  </world>", element + "\n</world>"); }

/// The diagnostics of the basic arena with `element` inserted. They must be located at its line.
std::string said_with(const std::string& element) {
    const std::string text = world_with(element), line = line_of(text, "</world>");
    std::string said = diagnostics_of(text);
    const std::string here = std::to_string(std::stoi(line) - 1) + ": ";
    INFO(said);
    CHECK(said.starts_with(here));
    return said.starts_with(here) ? said.substr(here.size()) : said;
}

std::string model_element(const std::string& inside, bool fixed = true) {
    return std::string("<model name='m'>") + (fixed ? "<static>1</static>" : "") + inside + "</model>";
}

std::string sphere(const std::string& pose, bool fixed = false) {
    return model_element(
        "<pose>" + pose +
            "</pose><link name='l'><collision name='c'><geometry><sphere><radius>0.1</radius></sphere>"
            "</geometry></collision></link>",
        fixed);
}

/// A second robot, with this in its body, beside the first one.
std::string robot(const std::string& body, const std::string& rest = {}) {
    return model_element(
        "<pose>1 -1 0 0 0 0</pose><link name='bug'><pose>0 0 0.1 0 0 0</pose><collision name='c'>"
        "<geometry><cylinder><radius>0.2</radius><length>0.2</length></cylinder></geometry></collision>" +
            body + "</link><plugin name='v' filename='libvel_plugin.so'/>" + rest,
        false);
}

std::string ray(const std::string& name, const std::string& type = "ray") {
    return "<sensor name='" + name + "' type='" + type +
           "'><ray><scan><horizontal><samples>4</samples></horizontal></scan><range><min>0.1</min><max>1</"
           "max>"
           "</range></ray></sensor>";
}

std::string game(const std::string& rules) {
    return "<plugin name='game' filename='libforage_game.so'>" + rules + "</plugin>";
}

std::string joint(const std::string& type, const std::string& axis) {
    return robot("", "<link name='a'/><joint name='j' type='" + type +
                         "'><parent>bug</parent><child>a</child>" + axis + "</joint>");
}

}  // namespace

TEST_CASE("Models at positions that are most likely a mistake give a warning at their line") {
    CHECK(said_with(sphere("0 3 0.1 0 0 0")) ==
          "warning: 'm' starts inside another object and may be stuck | change its <pose>\n");
    CHECK(said_with(sphere("0.1 -2 0.1 0 0 0")) ==  // in the robot
          "warning: 'm' starts inside another object and may be stuck | change its <pose>\n");
    const char* heights = " | the third number of a <pose> is the height in m; the floor is at 0\n";
    CHECK(
        said_with(sphere("1 0 3 0 0 0")) ==
        std::string("warning: 'm' is 2.9 to 3.1 m above the floor: nothing touches it and no ray meets it") +
            heights);
    CHECK(said_with(sphere("1 0 -3 0 0 0")) ==
          std::string(
              "warning: 'm' is -3.1 to -2.9 m above the floor: nothing touches it and no ray meets it") +
              heights);
    CHECK(
        said_with(sphere("1 0 3 0 0 0", true)) ==
        std::string("warning: 'm' is 2.9 to 3.1 m above the floor: nothing touches it and no ray meets it") +
            heights);
    CHECK(said_with("<include><name>T</name><uri>model://target</uri><pose>0 8 0 0 0 0</pose></include>") ==
          "warning: no robot can reach the target at (0, 8): it is reset before | the bounds are x -2.5 to "
          "2.5, "
          "y -2.5 to 2.5\n");
    const std::string outside = edited("<pose>0 -2 0 0 0 1.57079</pose>", "<pose>0 -4 0 0 0 1.57079</pose>");
    CHECK(diagnostics_of(outside) ==
          "55: warning: robot 'Bug' starts outside the bounds and is reset at once | the bounds are x -2.5 "
          "to 2.5, y -2.5 to 2.5\n");
    const std::string twice = world_with(
        "<include><name>B</name><uri>model://forage_bug</uri><pose>0 -1.7 0 0 0 0</pose></include>");
    CHECK(diagnostics_of(twice) ==
          "55: warning: robot 'Bug' starts inside another object and may be stuck | change its <pose>\n"
          "90: warning: robot 'B' starts inside another object and may be stuck | change its <pose>\n");
}

TEST_CASE("Movable objects that overlap each other give no warning") {
    CHECK(diagnostics_of(
              world_with(sphere("1 0 0.1 0 0 0") + "<model name='n'>" + sphere("1.1 0 0.1 0 0 0").substr(16)))
              .empty());
}

TEST_CASE("Plugins that have no effect or are misspelt give a warning with a hint") {
    CHECK(said_with(sphere("1 0 0.1 0 0 0").insert(16, "<plugin name='p' filename='libreset_plugin.so'/>")) ==
          "warning: 'm' is not a robot and is never reset | libreset_plugin.so has an effect only in "
          "robots\n");
    CHECK(
        said_with(
            sphere("1 0 0.1 0 0 0", true).insert(16, "<plugin name='p' filename='libtarget_plugin.so'/>")) ==
        "warning: 'm' is static and does not count at a home | a resource is a model that can be pushed\n");
    CHECK(
        said_with(robot("", "<plugin name='p' filename='libtarget_plugin.so'/>")) ==
        "warning: 'm' is a robot and does not count at a home | a resource is a model that can be pushed\n");
    CHECK(said_with(sphere("1 0 0.1 0 0 0").insert(16, "<plugin name='p' filename='libvel_plugin.so'/>")) ==
          "error: 'm' has no link 'bug' that could be driven | name the link of the robot's body 'bug'\n");
    std::string misspelt = robot("");
    misspelt.replace(misspelt.find("libvel"), 6, "libvell");
    const std::string said = said_with(misspelt);
    CHECK_THAT(said,
               ContainsSubstring("plugin 'libvell_plugin.so' is not known and has no effect | did you mean "
                                 "libvel_plugin.so?"));
    CHECK_THAT(said, ContainsSubstring("'m' has a link 'bug', but no plugin that drives it"));
}

TEST_CASE("Sensors that have no effect give a warning") {
    CHECK(said_with(robot(ray("lazer"))) ==
          "warning: no group gets what a ray sensor called 'lazer' sees | did you mean 'laser'?\n");
    CHECK(said_with(robot(ray("laser", "sonar"))) ==
          "warning: a sensor of type 'sonar' has no effect here | type=\"ray\" and type=\"camera\" have\n");
    CHECK(said_with(robot(ray("laser") + ray("laser"))) ==
          "warning: there are two ray sensors 'laser'; the first one is used | give each a name of its own: "
          "laser, "
          "laser_target, laser_gripper\n");
    const std::string camera =
        "<sensor name='eye' "
        "type='camera'><camera><image><width>8</width><height>8</height></image></camera></sensor>";
    CHECK(said_with(robot(camera + camera)) ==
          "warning: camera 'eye' is the second one of its link | robots see with the first one\n");
    CHECK(said_with(robot("", "<link name='head'>" + ray("laser") + "</link>")) ==
          "warning: sensor 'laser' of 'm' has no effect in the link 'head' | the sensors of a robot belong "
          "in its link 'bug'\n");
}

TEST_CASE("Joints that do not turn, or turn without a limit, give a warning") {
    CHECK(said_with(joint("prismatic", "<axis><xyz>0 0 1</xyz></axis>")) ==
          "warning: joint 'j' does not turn here | only joints of type=\"revolute\" do, about z\n");
    CHECK(said_with(joint("revolute", "")) == "warning: joint 'j' does not turn here | give it an <axis>\n");
    CHECK(said_with(joint("revolute", "<axis><xyz>0 0 1</xyz></axis>")) ==
          "warning: joint 'j' turns by more than a turn | give its <axis> a <limit> with <lower> and "
          "<upper>, in "
          "rad\n");
    CHECK(said_with(joint("revolute",
                          "<axis><xyz>0 0 1</xyz><limit><lower>1</lower><upper>-1</upper></limit></axis>")) ==
          "error: joint 'j' has its lower limit above the upper one | they are 1 and -1 rad\n");
    CHECK(diagnostics_of(world_with(joint("fixed", ""))).empty());
}

TEST_CASE("A game with inconsistent rules gives a warning") {
    CHECK_THAT(said_with(game("")),
               ContainsSubstring("no models are named Home_A and Home_B | the homes are assumed "
                                 "to be at (-10, 10) and (10, -10)"));
    CHECK_THAT(said_with(game("<stale_after>60</stale_after>")),
               ContainsSubstring("resources dissolve before they turn yellow | <stale_after> is 60 s, "
                                 "<dissolves_after> 50 s"));
    CHECK_THAT(said_with(game("<site>0 3 0.1</site>")),
               ContainsSubstring("the site (0, 3) is occupied | resources appear at free positions within "
                                 "0.5 m"));
}

TEST_CASE("Start poses that no robot uses give a warning") {
    const std::string text = edited("<uri>model://forage_bug</uri>", "<uri>model://team_a_bug</uri>");
    CHECK_THAT(diagnostics_of(text),
               ContainsSubstring("75: warning: there are start poses, but no robot is ever reset"));
}

TEST_CASE("The worlds in the repository give no diagnostics") {
    for (const auto& entry : std::filesystem::directory_iterator(source_dir() / "systems" / "worlds")) {
        if (entry.path().extension() != ".world") continue;
        INFO(entry.path());
        CHECK(diagnostics_of(text_of(entry.path())).empty());
    }
}
