// What a file gets that names a type of the original that Forage does not have.
#include "core/model/original_types.h"

#include "core/base/text_file.h"
#include "core/model/validate.h"
#include "tests/support/model_text.h"
#include "tests/support/paths.h"

using namespace forage;
using test::replaced;

TEST_CASE("A module of the original that Forage does not have is refused with a reason and a hint") {
    const auto text = replaced(test::small_system, "enableModule=\"false\"", "enableModule=\"true\"");
    for (const auto& type : model::missing_original_types()) {
        const std::string name(type.name);
        Diagnostics diagnostics;
        model::validate(test::system_of(replaced(text, "moduleTest", name)), test::few_types(), diagnostics);
        INFO(format(diagnostics));
        REQUIRE(diagnostics.errors() == 1);
        const auto& d = diagnostics.all().front();
        CHECK(d.message == "Forage does not have the original's " + name + ": " + std::string(type.reason));
        CHECK(d.hint == type.hint);
        CHECK(d.where.line > 0);
    }
}

TEST_CASE("A disabled module of such a type is a warning") {
    Diagnostics diagnostics;
    model::validate(test::system_of(replaced(test::small_system, "moduleTest", "moduleKhepera")),
                    test::few_types(), diagnostics);
    CHECK(diagnostics.errors() == 0);
    REQUIRE(diagnostics.warnings() > 0);
    CHECK(diagnostics.all().front().message ==
          "Forage does not have the original's moduleKhepera: it drives a Khepera robot over a serial line; "
          "the module is disabled");
}

TEST_CASE("The page on compatibility lists all types that are refused") {
    const std::string page = read_file((test::source_dir() / "docs/reference/compatibility.md").string());
    for (const auto& type : model::missing_original_types()) {
        INFO(type.name);
        CHECK(page.find("| " + std::string(type.name) + " |") != std::string::npos);
    }
}
