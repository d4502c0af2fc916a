#include "core/run/result_files.h"

#include <stdexcept>

#include "tests/support/catch.h"

using namespace forage;

TEST_CASE("A file that cannot be made is a problem, also when its text is kept") {
    ResultFiles files("", "kept.csv");
    files.write("kept.csv", []() -> std::string { throw std::runtime_error("cannot"); });
    CHECK(files.problems() == std::vector<std::string>{"cannot"});
    files.write("kept.csv", [] { return "text"; });
    CHECK(files.kept() == "text");
    CHECK(files.names().empty());
}
