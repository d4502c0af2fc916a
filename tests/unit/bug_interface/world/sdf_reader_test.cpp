// Mistakes in world files.
#include "bug_interface/world/sdf_reader.h"

#include "tests/unit/bug_interface/world_diagnostics.h"

using namespace forage;
using namespace forage::bug;
using namespace forage::test;

TEST_CASE("An unknown element is a warning at its line, with the nearest name") {
    const std::string target = "<pose>0 2.5 0 0 0 0</pose>",
                      text = edited(target, "<psoe>0 2.5 0 0 0 0</psoe>");
    CHECK(diagnostics_of(text) ==
          line_of(text, "<psoe>") +
              ": warning: <psoe> is not known in <include> and has no effect | did you mean "
              "'pose'?\n");
    const std::string model = diagnostics_of(edited(
        "<include>",
        "<model name='m'><satic>1</satic><static>1</static><link name='l'><collision name='c'><geometry>"
        "<box><sze>1 1 1</sze></box></geometry><surfce/></collision><visual name='v'><geometry><sphere/>"
        "</geometry><materal/></visual><sensor type='ray' "
        "name='s'><ray><scan><horizontl/><horizontal/></scan>"
        "<range/></ray></sensor></link></model><lihgt/><include>"));
    for (const char* what :
         {"<satic> is not known in <model> and has no effect | did you mean 'static'?",
          "<sze> is not known in <box> and has no effect | did you mean 'size'?",
          "<surfce> is not known in <collision> and has no effect | did you mean 'surface'?",
          "<materal> is not known in <visual> and has no effect | did you mean 'material'?",
          "<horizontl> is not known in <scan> and has no effect | did you mean 'horizontal'?",
          "<lihgt> is not known in <world> and has no effect | did you mean 'light'?"})
        CHECK_THAT(model, ContainsSubstring(what));
}

TEST_CASE("An incomplete or wrong include gives an error with a hint") {
    const std::string uri = "<uri>model://wall_straight</uri>";
    const auto said = [&](const std::string& instead) {
        const std::string text = edited(uri, instead), out = diagnostics_of(text);
        CHECK_THAT(out, StartsWith(std::string("64: error: ")) || StartsWith(std::string("62: error: ")));
        CHECK(std::count(out.begin(), out.end(), '\n') == 1);
        return out.substr(out.find("error: ") + 7);
    };
    CHECK(said("") == "<include> needs the element <uri> | <uri>: what is included, model://NAME\n");
    CHECK(said("<uri></uri>") == "<uri> is empty | write <uri>model://NAME</uri>\n");
    CHECK(said("<uri>model://wall</uri>") ==
          "there is no model 'model://wall' | did you mean 'model://wall_straight'?\n");
    CHECK(said("<uri>model://wal_strait</uri>") ==
          "there is no model 'model://wal_strait' | did you mean 'model://wall_straight'?\n");
    CHECK(said("<uri>model://floor</uri>") ==
          "there is no model 'model://floor' | did you mean 'model://floor_ambiguous' or "
          "'model://floor_basic' or 'model://floor_maze' or "
          "'model://floor_open'?\n");
    CHECK(said("<uri>target</uri>") == "there is no model 'target' | write model://target\n");
    CHECK_THAT(said("<uri>model://quux</uri>"), ContainsSubstring("the models are desert_walls, "));
}

TEST_CASE("Models that are not found give one error with a hint") {
    const std::string said = diagnostics_of(edited("</world>", "</world>"), false);
    CHECK(
        said ==
        "46: error: model 'model://floor_basic' not found: there is no folder of models | put models into a "
        "folder 'models' beside the world file or up to two above, or name their folder in "
        "FORAGE_MODEL_PATH\n");
}

TEST_CASE("A malformed value gives an error at its line") {
    const std::string target = "<pose>0 2.5 0 0 0 0</pose>";
    const auto said = [&](const std::string& instead) { return diagnostics_of(edited(target, instead)); };
    const std::string pose = " | pose: six numbers x y z roll pitch yaw, in m and rad\n";
    CHECK(said("<pose>a b c</pose>") == "71: error: <pose> = 'a' is not a number" + pose);
    CHECK(said("<pose>1 2 3</pose>") == "71: error: <pose> has 3 numbers instead of 6" + pose);
    CHECK(said("<static>maybe</static>") ==
          "71: error: <static> = 'maybe' is not true or false | static: true or false\n");
    CHECK(said("</include><model><link name='l'/></model><include><uri>model://target</uri>") ==
          "71: error: <model> needs the attribute 'name' | <model name=\"...\">\n");
    CHECK(diagnostics_of(edited("<sdf version=\"1.4\">", "<sdf>")) ==
          "24: error: <sdf> needs the attribute 'version' | version: of the format, such as 1.4\n");
    CHECK(diagnostics_of(edited("<max_step_size>0.001<", "<max_step_size>fast<")) ==
          "32: error: <max_step_size> = 'fast' is not a number | max_step_size: in s, usually 0.001, from "
          "1e-06 "
          "to 1\n");
}

TEST_CASE("An angle of more than a turn gives a warning") {
    const auto said = [](const char* yaw) {
        return diagnostics_of(
            edited("<pose>0 -2 0 0 0 1.57079</pose>", std::string("<pose>0 -2 0 0 0 ") + yaw + "</pose>"));
    };
    CHECK(said("90") ==
          "58: warning: an angle of 90 in a <pose>: radians, not degrees? | 90 degrees are 1.5708 rad\n");
    CHECK(said("-6.28").empty());
}

TEST_CASE("Errors of an included model's pose are reported at the include") {
    std::string said =
        diagnostics_of(edited("<pose>1.5 -2 0 0 0 1.57079</pose>", "<pose>1.5 -7 0 0 0 1.57079</pose>"));
    CHECK_THAT(said, StartsWith("85: error: 'Reset_2' at (1.5, -7) is not inside the bounds"));
    said = diagnostics_of(edited("<name>GroundPlane</name>", "<name>Ground</name>"));
    CHECK_THAT(said,
               StartsWith("75: error: there is a start pose 'Reset_0', but no model named GroundPlane"));
    said = diagnostics_of(
        edited("</world>", "<include><name>Bug</name><uri>model://forage_bug</uri></include></world>"));
    CHECK_THAT(said, ContainsSubstring("error: there are two robots named 'Bug'"));
}

TEST_CASE("A file that is not a world gives an error that says what it is") {
    const auto said = [](const std::filesystem::path& path) {
        Diagnostics diagnostics;
        CHECK_FALSE(read_world(path.string(), diagnostics));
        REQUIRE(diagnostics.all().size() == 1);
        return diagnostics.all().front().message;
    };
    const auto systems = source_dir() / "systems";
    const Scratch scratch;
    CHECK(said(systems / "reactive_foraging.iqr") ==
          "the file begins with <System>, a world or model file with <sdf>");
    CHECK_THAT(said(systems / "worlds"), ContainsSubstring("is a folder, not a world file"));
    CHECK_THAT(said(systems / "worlds/models/floor_open/materials/floor_open.png"),
               ContainsSubstring("the byte 0x89 is not UTF-8"));
    CHECK_THAT(said(scratch.write("a.world", std::string("a\0b", 3))),
               ContainsSubstring("the byte 0x00 does not occur in a text"));
    CHECK_THAT(said(scratch.write("a.world", " \n")), ContainsSubstring("is empty"));
    CHECK(said(scratch.write("a.world", "hello")) == "there is text before the first element");
    CHECK(said(scratch.write("a.world", "<!-- <sdf> --><sfd/>")) ==
          "the file begins with <sfd>, a world or model file with <sdf>");
}

TEST_CASE(
    "An include has the name, pose, <static> and plugins of the world, and everything else of the model") {
    const Scratch scratch;
    const std::string config =
        "<?xml version='1.0'?><model><name>m</name><sdf version='1.4'>model.sdf</sdf></model>";
    scratch.write("models/inner/model.config", config);
    scratch.write(
        "models/inner/model.sdf",
        "<sdf version='1.4'><model name='inner'><pose>1 0 0 0 0 0</pose><link name='i'/></model></sdf>");
    scratch.write("models/outer/model.config", config);
    scratch.write("models/outer/model.sdf",
                  "<sdf version='1.4'><model name='outer'><pose>2 0 0 0 0 0</pose><link name='o'/>"
                  "<include><uri>model://inner</uri></include></model></sdf>");
    const std::string file = scratch.write(
        "a.world",
        "<sdf version='1.4'><world name='w'><include><uri>model://outer</uri></include>\n<model name='own'>"
        "<link name='l'/></model>\n<include><name>second</name><pose>0 3 0 0 0 0</pose><static>1</static>"
        "<uri>model://outer</uri><plugin name='p' filename='libvel_plugin.so'/></include></world></sdf>");
    Diagnostics diagnostics;
    const auto world = read_world(file, diagnostics);
    INFO(format(diagnostics));
    REQUIRE(world);
    REQUIRE(world->models.size() == 3);
    const auto &first = world->models[0], &second = world->models[2];
    CHECK(first.name == "outer");
    CHECK(first.pose.translation().x() == 2);
    CHECK_FALSE(first.is_static);
    CHECK(world->models[1].name == "own");
    CHECK(second.name == "second");
    CHECK(second.pose.translation() == Eigen::Vector3d(0, 3, 0));
    CHECK(second.is_static);
    CHECK(second.where.line == 3);
    REQUIRE(second.plugins.size() == 1);
    REQUIRE(second.models.size() == 1);
    CHECK(second.models[0].name == "inner");
    CHECK(second.models[0].pose.translation().x() == 1);
    REQUIRE(second.links.size() == 1);
    CHECK(second.links[0].name == "o");
}

TEST_CASE("An error in a model's file is reported there, and only once") {
    const Scratch scratch;
    scratch.write("models/m/model.config",
                  "<?xml version='1.0'?><model><name>m</name><sdf version='1.4'>model.sdf</sdf></model>");
    const std::string model = scratch.write(
        "models/m/model.sdf",
        "<sdf version='1.4'><model name='m'>\n<link name='l'><psoe/><pose>1 2</pose></link></model></sdf>");
    const std::string include = "<include><uri>model://m</uri></include>";
    Diagnostics diagnostics;
    CHECK_FALSE(read_world(scratch.write("a.world", "<sdf version='1.4'><world name='w'>" + include +
                                                        include + "</world></sdf>"),
                           diagnostics));
    REQUIRE(diagnostics.all().size() == 2);
    for (const auto& d : diagnostics.all()) {
        CHECK(std::filesystem::equivalent(d.where.file->path, model));
        CHECK(d.where.line == 2);
    }
    CHECK(diagnostics.errors() == 1);
}

TEST_CASE("A model that includes itself is an error, not an endless recursion") {
    const Scratch scratch;
    scratch.write("models/m/model.config",
                  "<?xml version='1.0'?><model><name>m</name><sdf version='1.4'>model.sdf</sdf></model>");
    scratch.write("models/m/model.sdf",
                  "<sdf version='1.4'><model name='m'><include><uri>model://m</uri></include></model></sdf>");
    Diagnostics diagnostics;
    CHECK_FALSE(read_world(scratch.write("a.world",
                                         "<sdf version='1.4'><world name='w'><include>"
                                         "<uri>model://m</uri></include></world></sdf>"),
                           diagnostics));
    REQUIRE(diagnostics.errors() == 1);
    CHECK(diagnostics.all()[0].message == "'model://m' includes itself");
}
