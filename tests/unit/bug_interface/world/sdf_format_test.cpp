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
            CHECK((child.value || child.rule->name == child.name));
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

TEST_CASE("Elements of other programs, and elements without effect, are not checked") {
    CHECK(diagnostics_inside(
              "<sdf version='1.9' xmlns:x='y'><world name='w'><x:a b='c'>d</x:a><wind>fresh<fog/></wind>"
              "<model name='m' canonical_link='l'/></world></sdf>")
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
