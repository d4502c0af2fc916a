// The table of SDF's elements, and the check that uses it.
#include "bug_interface/world/sdf_format.h"

#include "core/xml/check.h"
#include "tests/support/catch.h"

using namespace forage;

namespace {

/// All diagnostics of a world with this content, one "column severity message | hint" per line.
std::string diagnostics_inside(const std::string& inside) {
    Diagnostics diagnostics;
    const auto document = xml::open("test.world", inside, bug::sdf_format(), diagnostics);
    if (document) xml::check(*document, bug::sdf_format(), diagnostics);
    std::string out;
    for (const auto& d : diagnostics.all())
        out += std::to_string(d.where.column) + (d.severity == Severity::error ? " error " : " warning ") +
               d.message + (d.hint.empty() ? "" : " | " + d.hint) + "\n";
    return out;
}

}  // namespace

TEST_CASE(
    "Every element with children has a row in the table of SDF, and every row belongs to such an element") {
    const xml::Format& format = bug::sdf_format();
    for (const auto& e : format.elements) {
        INFO(e.name);
        bool held = e.name == "sdf";
        for (const auto& other : format.elements)
            for (const auto& child : other.children) held |= child.rule == &e;
        CHECK(held);
        for (const auto& child : e.children) {
            INFO(child.name);
            CHECK((child.value || child.inert || !child.rule->name.empty()));
        }
    }
}

TEST_CASE("All mistakes in a world are reported at once, those without effect as warnings") {
    CHECK(diagnostics_inside(
              "<sdf version='1.4'><world name='w'><gravity>0 0 x</gravity><model name='m'><static>on</static>"
              "</model><physics/></world></sdf>") ==
          "49 error <gravity> = 'x' is not a number | gravity: three numbers with blanks between them\n"
          "84 error <static> = 'on' is not true or false | did you mean 'true'?\n"
          "103 error <physics> needs the attribute 'type' | <physics type=\"...\">\n");
    CHECK(
        diagnostics_inside("<sdf version='1.4'><world name='w'>text<modell/><geometry/></world></sdf>") ==
        "40 warning <modell> is not known in <world> and has no effect | did you mean 'model'?\n"
        "49 warning <geometry> is not known in <world> and has no effect | there are 'actor', 'atmosphere', "
        "'audio', 'frame', 'gravity', 'gui', 'include', 'light', 'magnetic_field', 'model', 'physics', "
        "'plugin' and 6 more\n");
}

TEST_CASE("Elements of other programs and those that say what holds anyway give no warning") {
    CHECK(diagnostics_inside(
              "<sdf version='1.9' xmlns:x='y'><world name='w'><x:a b='c'>d</x:a><gui full='1'><fog/></gui>"
              "<wind/><gravity>0 0 -9.81</gravity><model name='m' canonical_link='l'/></world></sdf>")
              .empty());
}

TEST_CASE("Values of SDF may have a plus, capitals, 0 and 1; a pose may be empty, or a quaternion") {
    const auto model = [](const std::string& inside) {
        return diagnostics_inside("<sdf version='1.4'><model name='m'>" + inside + "</model></sdf>");
    };
    for (const char* right :
         {"<static>TRUE</static>", "<static>0</static>", "<pose/>", "<pose>+1 2 3\n4 5 6</pose>",
          "<pose rotation_format='quat_xyzw'>1 2 3 0 0 0 1</pose>"}) {
        INFO(right);
        CHECK(model(right).empty());
    }
    CHECK(model("<pose>1 2 3 0 0 0 1</pose>") ==
          "36 error <pose> has 7 numbers instead of 6 | pose: six numbers x y z roll pitch yaw, in m and "
          "rad\n");
    CHECK(model("<pose rotation_format='quat_xyzw'>1 2 3 0 0 0</pose>") ==
          "36 error <pose> has 6 numbers instead of 7 | pose: seven numbers x y z qx qy qz qw\n");
    CHECK(model("<static/>") == "36 warning <static> is empty and has no effect\n");
}

TEST_CASE("What is not read is named in a warning, once for a name, with a count") {
    CHECK(
        diagnostics_inside(
            "<sdf version='1.9'><world name='w'><wind>fresh</wind><road name='r'/><road name='s'/>"
            "<gravity>0 0 0</gravity><model name='m' static='true'><pose degree='true'>0 0 0 0 0 0</pose>"
            "<pose>0 0 0 0 0 1</pose></model></world></sdf>") ==
        "178 warning <model> holds several <pose> | the first one counts\n"
        "86 warning <gravity> in <world> has no effect\n"
        "126 warning <model> has no attribute 'static': it has no effect | write <static>true</static> in "
        "<model>\n"
        "146 warning <pose> has no attribute 'degree': it has no effect | did you mean 'degrees'?\n"
        "54 warning <road> in <world> has no effect (2 times in this file) | draw it into the picture of the "
        "floor\n"
        "36 warning <wind> in <world> has no effect\n");
}

TEST_CASE("An element that nothing reads may say what holds anyway, in several ways") {
    const auto link = [](const std::string& inside) {
        return diagnostics_inside(
            "<sdf version='1.9'><world name='w'><gravity>0 0 -9.81</gravity><wind>"
            "<linear_velocity>0 0 0</linear_velocity></wind><model name='m'><link name='l'>" +
            inside + "</link></model></world></sdf>");
    };
    const auto surface = [&](const std::string& inside) {
        return link("<collision name='c'><geometry><sphere><radius>1</radius></sphere></geometry><surface>" +
                    inside + "</surface></collision>");
    };
    CHECK(link("<gravity>true</gravity><self_collide>0</self_collide><enable_wind>False</enable_wind>")
              .empty());
    CHECK(
        surface("<contact><ode><kp>1e9</kp></ode><collide_bitmask>0xffff</collide_bitmask></contact><bounce/>"
                "<friction><ode><mu>1</mu><mu2>9</mu2></ode><torsional><ode/></torsional></friction>")
            .empty());
    CHECK_THAT(
        diagnostics_inside("<sdf version='1.9'><world name='w'><model name='m' Static='1'/></world></sdf>"),
        Catch::Matchers::ContainsSubstring("write <static>1</static> in <model>"));
    CHECK_THAT(link("<gravity>0</gravity>"),
               Catch::Matchers::ContainsSubstring("<gravity> in <link> has no effect"));
    CHECK_THAT(surface("<bounce><restitution_coefficient>0.5</restitution_coefficient></bounce>"),
               Catch::Matchers::ContainsSubstring("<restitution_coefficient> in <bounce> has no effect"));
    CHECK_THAT(surface("<contact><collide_bitmask>2</collide_bitmask></contact>"),
               Catch::Matchers::ContainsSubstring("<collide_bitmask> in <contact> has no effect"));
    CHECK_THAT(link("<pose rotation_format='quat'>0 0 0 0 0 0</pose>"),
               Catch::Matchers::ContainsSubstring("'quat' is not one of euler_rpy, quat_xyzw"));
}
