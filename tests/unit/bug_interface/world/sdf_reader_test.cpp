// Mistakes in world files.
#include "bug_interface/world/sdf_reader.h"

#include <filesystem>

#include <fmt/format.h>

#include "core/base/installation.h"
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
    CHECK_THAT(said("<uri>model://quux</uri>"), ContainsSubstring("the models are desert_walls, "));
}

TEST_CASE("Models that are not found give one error with a hint") {
    const std::string said = diagnostics_of(edited("</world>", "</world>"), false);
    if (std::filesystem::exists(installation() / "share/forage/systems/worlds/models")) {
        CHECK(said.empty());  // those that come with Forage are found last
        return;
    }
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
    const std::string wrong = "71: error: <pose> = '";
    CHECK(said("<pose>a b c</pose>") == wrong + "a' is not a number" + pose + wrong + "b' is not a number" +
                                            pose + wrong + "c' is not a number" + pose);
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

TEST_CASE("An angle of more than a turn and a quaternion in degrees give a warning") {
    const auto said = [](const char* yaw) {
        return diagnostics_of(
            edited("<pose>0 -2 0 0 0 1.57079</pose>", std::string("<pose>0 -2 0 0 0 ") + yaw + "</pose>"));
    };
    CHECK(said("90") ==
          "58: warning: an angle of 90 in a <pose>: radians, not degrees? | 90 degrees are 1.5708 rad\n");
    CHECK(said("-6.28").empty());
    CHECK(diagnostics_of(edited("<pose>0 -2 0 0 0 1.57079</pose>",
                                "<pose rotation_format=\"quat_xyzw\" degrees=\"true\">0 -2 0 0 0 0.7071 "
                                "0.7071</pose>")) ==
          "58: warning: degrees have no effect on a quaternion | remove this attribute, or give three "
          "angles\n");
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

namespace {

/// A world with this content, and its diagnostics, one "message | hint" per line.
struct ReadWorld {
    std::optional<WorldDescription> world;
    std::string said;
};
ReadWorld read_inside(const Scratch& scratch, const std::string& inside) {
    ReadWorld out;
    Diagnostics diagnostics;
    out.world = read_world(
        scratch.write("worlds/a.world", "<sdf version='1.9'><world name='w'>" + inside + "</world></sdf>"),
        diagnostics);
    for (const auto& d : diagnostics.all()) out.said += d.message + " | " + d.hint + "\n";
    return out;
}
void write_model(const Scratch& scratch, const std::string& folder, const std::string& model) {
    scratch.write(folder + "/model.config", "<model><sdf version='1.4'>model.sdf</sdf></model>");
    scratch.write(folder + "/model.sdf", "<sdf version='1.4'>" + model + "</sdf>");
}

const std::string shape =
    "<collision name='c'><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>";

}  // namespace

TEST_CASE("<state> says where the models of a saved world are") {
    const Scratch scratch;
    const auto in = read_inside(
        scratch,
        "<model name='Box'><pose>1 0 0 0 0 0</pose><link name='l'><pose>0.5 0 0 0 0 0</pose>" + shape +
            "</link></model><state world_name='w'><sim_time>1 0</sim_time><model name='Box'>"
            "<pose frame=''>2 3 0 0 0 0</pose><scale>1 1 1</scale><link name='l'>"
            "<pose frame=''>2.5 3 0 0 0 0</pose><velocity>0 0 0 0 -0 0</velocity></link></model></state>");
    REQUIRE(in.world);
    CHECK(in.said.empty());
    CHECK(in.world->models[0].pose.translation() == Eigen::Vector3d(2, 3, 0));
    const auto other = read_inside(
        scratch, "<model name='Box'><link name='l'>" + shape +
                     "</link></model><state world_name='w'><insertions><model name='x'/></insertions>"
                     "<model name='Bx'/><model name='Box'><link name='l'><pose>1 0 0 0 0 0</pose>"
                     "</link></model></state>");
    CHECK_THAT(other.said, ContainsSubstring("<insertions> in <state> has no effect"));
    CHECK_THAT(other.said,
               ContainsSubstring("a model 'Bx' that the world does not have | did you mean 'Box'?"));
    CHECK_THAT(other.said, ContainsSubstring("<state> moves 'l', a part of 'Box'"));
    const auto inner = read_inside(
        scratch, "<model name='Cart'><model name='m'><pose>1 0 0 0 0 0</pose><link name='l'>" + shape +
                     "</link></model></model><state world_name='w'><model name='Cart'>"
                     "<pose>2 0 0 0 0 0</pose><scale>2 1 1</scale><model name='m'><pose>3 0 0 0 0 0"
                     "</pose><link name='l'><pose>3 1 0 0 0 0</pose></link></model></model></state>");
    CHECK_THAT(inner.said, ContainsSubstring("<scale> in <model> has no effect"));
    CHECK_THAT(inner.said, ContainsSubstring("<state> moves 'l', a part of 'Cart'"));
}

TEST_CASE("A saved light is turned as <state> says") {
    const Scratch scratch;
    const auto in =
        read_inside(scratch,
                    "<light name='sun' type='directional'><pose>0 0 9 0 0 0</pose>"
                    "<direction>0 0 -1</direction></light><state world_name='w'><light name='sun'>"
                    "<pose frame=''>0 0 9 1.5707963267948966 0 0</pose></light></state>");
    REQUIRE(in.world);
    CHECK(in.said.empty());
    REQUIRE(in.world->sun);
    CHECK((*in.world->sun - Eigen::Vector3d(0, -1, 0)).norm() < 1e-9);
}

TEST_CASE("A <pose> may be relative to a frame, link, joint or model beside it") {
    const Scratch scratch;
    write_model(scratch, "models/m", "<model name='m'><link name='l'>" + shape + "</link></model>");
    const auto in = read_inside(
        scratch,
        "<model name='A'><pose relative_to='turned'>1 0 0 0 0 0</pose><link name='l'>"
        "<pose relative_to='tip'>0 0 1 0 0 0</pose><collision name='c'><pose relative_to='tip'>0 0 2 0 0 0"
        "</pose><geometry><sphere><radius>0.1</radius></sphere></geometry></collision></link>"
        "<frame name='tip' attached_to='k'><pose>0 0 0.5 0 0 0</pose></frame>"
        "<link name='k'><pose>0 3 0 0 0 0</pose>" +
            shape +
            "</link></model><frame name='turned' attached_to='In'>"
            "<pose degrees='true'>0 0 0 0 0 90</pose></frame><include><name>In</name><uri>model://m</uri>"
            "<pose relative_to='world'>5 0 0 0 0 0</pose></include>"
            "<model name='B'><pose relative_to='A'>1 0 0 0 0 0</pose><link name='l'/></model>");
    CHECK(in.said.empty());
    REQUIRE(in.world);
    const auto& models = in.world->models;
    const auto is_at = [](const Pose& pose, double x, double y, double z) {
        return (pose.translation() - Eigen::Vector3d(x, y, z)).norm() < 1e-9;
    };
    CHECK(is_at(models[0].pose, 5, 1, 0));
    CHECK(is_at(models[0].links[0].pose, 0, 3, 1.5));
    CHECK(is_at(models[0].links[0].collisions[0].pose, 0, 0, 1));
    CHECK(is_at(models[2].pose, 5, 2, 0));
}

TEST_CASE("A merged model's links become those of the model that includes it") {
    const Scratch scratch;
    write_model(scratch, "models/m",
                "<model name='m'><pose>1 0 0 0 0 0</pose><link name='l'>" + shape +
                    "</link><plugin name='p' filename='libvel_plugin.so'/></model>");
    const auto in = read_inside(scratch,
                                "<model name='Cart'><pose>5 0 0 0 0 0</pose><include merge='true'>"
                                "<uri>model://m</uri></include></model>");
    REQUIRE(in.world);
    CHECK(in.said.empty());
    const Model& cart = in.world->models[0];
    CHECK(cart.models.empty());
    REQUIRE(cart.links.size() == 1);
    CHECK(cart.links[0].pose.translation().x() == 1);
    CHECK(cart.plugins.size() == 1);
    write_model(scratch, "models/s", "<model name='s'><static>1</static><link name='l'/></model>");
    const auto include = [&](const std::string& inside) {
        return "<include merge='true'>" + inside + "<uri>model://s</uri></include>";
    };
    CHECK_THAT(read_inside(scratch, "<model name='Cart'>" + include("<name>n</name>") + "</model>").said,
               ContainsSubstring("the merged model is static, but 'Cart' is not") &&
                   ContainsSubstring("the <name> of a merged model has no effect"));
    CHECK_THAT(read_inside(scratch, include("")).said, ContainsSubstring("no effect directly in <world>"));
    CHECK_THAT(read_inside(scratch, "<model name='Cart'><link name='l'/>" + include("") + "</model>").said,
               ContainsSubstring("two links are called 'l'"));
}

TEST_CASE("A path in <uri> is relative to its file, then to the folders of models") {
    const Scratch scratch;
    const std::string model = "<model name='m'><link name='l'>" + shape + "</link></model>";
    write_model(scratch, "worlds/own/m", model);
    write_model(scratch, "models/n", model);
    write_model(scratch, "models/a b", model);
    write_model(scratch, "models/outer", "<model name='o'><include><uri>../n</uri></include></model>");
    for (const char* uri :
         {"own/m", "./own/m/model.sdf", "file:own/m", "file://own/m", "n", "file://n", "model://outer",
          "outer/model.sdf", "model://a%20b", "model://a b", "own/m%2Fmodel.sdf"}) {
        INFO(uri);
        const auto in = read_inside(scratch, std::string("<include><uri>") + uri + "</uri></include>");
        CHECK(in.world);
        CHECK(in.said.empty());
    }
    const auto absolute = "file://" + (scratch.path / "models/n").string();
    CHECK(read_inside(scratch, "<include><uri>" + absolute + "</uri></include>").world);
    for (const char* uri : {"model://../worlds/own/m", "model://%2e%2e/worlds/own/m", "model:///etc/passwd"})
        CHECK_THAT(read_inside(scratch, std::string("<include><uri>") + uri + "</uri></include>").said,
                   ContainsSubstring("there is no model"));
    write_model(scratch, "models/cycle", "<model name='o'><include><uri>../cycle</uri></include></model>");
    CHECK_THAT(read_inside(scratch, "<include><uri>model://cycle</uri></include>").said,
               ContainsSubstring("includes itself"));
}

TEST_CASE("The file of a model is in its folder, and no text of other files is shown") {
    const Scratch scratch;
    scratch.write("secret", "password\n");
    scratch.write("models/m/model.config", "<model><sdf version='1.4'>../../secret</sdf></model>");
    CHECK_THAT(read_inside(scratch, "<include><uri>model://m</uri></include>").said,
               ContainsSubstring("is not in the folder of its model"));
    std::filesystem::create_symlink("../../secret", scratch.path / "models/m/link");
    scratch.write("models/m/model.config", "<model><sdf version='1.4'>link</sdf></model>");
    CHECK_THAT(read_inside(scratch, "<include><uri>model://m</uri></include>").said,
               ContainsSubstring("is not in the folder of its model"));
    Diagnostics diagnostics;
    const auto file = scratch.write("a.world",
                                    "<sdf version='1.4'><world name='w'><include><uri>secret</uri>"
                                    "</include></world></sdf>");
    CHECK_FALSE(read_world(file, diagnostics));
    CHECK_THAT(format(diagnostics), !ContainsSubstring("password"));
}

TEST_CASE("The reader warns of what is probably not meant") {
    const Scratch scratch;
    const auto said = [&](const std::string& inside) { return read_inside(scratch, inside).said; };
    const std::string box = "<model name='Box'><link name='l'>" + shape + "</link></model>";
    CHECK_THAT(said(box + box), ContainsSubstring("two models are called 'Box'"));
    write_model(scratch, "models/post",
                "<model name='Box'><static>1</static><link name='l'>" + shape + shape +
                    "</link><link name='l'/></model>");
    const std::string post = "<include><uri>model://post</uri></include>";
    CHECK(said(box + post + post).empty());  // static models may have the name of their file
    CHECK_THAT(said(post + box), ContainsSubstring("two models are called 'Box'"));
    CHECK_THAT(said(box + "<include><name>Box</name><uri>model://post</uri></include>"),
               ContainsSubstring("two models are called 'Box'"));
    const std::string robot =
        "<model name='r'><link name='bug'/><plugin name='p' filename='libvel_plugin.so'/>"
        "</model>";
    CHECK(said(robot + robot).empty());  // an error, which is reported when the world is built
    CHECK_THAT(said("<model name='m'><link name='l'/><link name='l'/></model>"),
               ContainsSubstring("two links are called 'l'"));
    const std::string joint =
        "<joint name='j' type='revolute'><parent>a</parent><child>b</child><axis><limit>"
        "<lower>0</lower><upper>1</upper></limit></axis></joint>";
    CHECK_THAT(said("<model name='m'><link name='a'/><link name='b'/>" + joint + joint + "</model>"),
               ContainsSubstring("two joints are called 'j'"));
    write_model(scratch, "models/lamp", "<light name='sun' type='directional'/>");
    CHECK_THAT(said("<model name='m'><link name='l'/><include><uri>model://lamp</uri></include></model>"),
               ContainsSubstring("a light in a model has no effect"));
    CHECK_THAT(said("<model name='m'><link name='l'/><model name='Post'><static>1</static></model></model>"),
               ContainsSubstring("'Post' is static, but a part of 'm'"));
    CHECK(said("<model name='m'><static>1</static><model name='Post'><static>1</static></model></model>")
              .empty());
    CHECK_THAT(said("<model name='m'><link name='l'><visual name='v'><geometry><mesh><uri>a.dae</uri></mesh>"
                    "</geometry></visual></link></model>"),
               ContainsSubstring("<mesh> in <geometry> has no effect | this visual is not drawn"));
    CHECK_THAT(
        said("<model name='m'><link name='l'><sensor name='laser' type='ray'><ray><scan><horizontal>"
             "<samples>9</samples><min_angle>-90</min_angle><max_angle>90</max_angle></horizontal></scan>"
             "<range><min>0</min><max>1</max></range></ray></sensor></link></model>"),
        ContainsSubstring("scans from -90 to 90, which is more than a turn"));
    CHECK(said("<model name='m'><pose relative_to='world'>1 0 0 0 0 0</pose><link name='l'>"
               "<pose relative_to='__model__'>1 0 0 0 0 0</pose></link></model>")
              .empty());
    for (const char* lost : {"Absent", "m"})  // which is not there, and itself
        CHECK_THAT(
            said(fmt::format("<model name='m'><pose relative_to='{}'>1 0 0 0 0 0</pose></model>", lost)),
            ContainsSubstring(fmt::format("this <pose> is relative to '{}', which has no place here", lost)));
    CHECK_THAT(said("<frame name='a' attached_to='b'/><frame name='b' attached_to='a'/>"
                    "<model name='m'><pose relative_to='a'>1 0 0 0 0 0</pose></model>"),
               ContainsSubstring("relative to 'a', which has no place here"));
}
