#include "core/base/program.h"

#include <cerrno>

#include "tests/support/catch.h"

using namespace forage;

namespace {

int status_of(const std::string& script, const Streams& streams = {}) {
    int id = 0;
    REQUIRE(start_program(id, {"sh", "-c", script}, streams, true) == 0);
    return exit_status(id);
}

}  // namespace

TEST_CASE("A program is searched in PATH, and its exit status is returned") {
    CHECK(status_of("exit 3") == 3);
    CHECK(status_of("kill -KILL $$") == -1);
    int id = 0;
    CHECK(start_program(id, {"no-such-program"}, {}, false) == ENOENT);
}

TEST_CASE("The standard streams of a program are files or nothing") {
    CHECK(status_of("read line", {.in = Streams::nothing}) == 1);
    int ends[2];
    REQUIRE(pipe(ends) == 0);
    CHECK(status_of("echo said; echo wrong >&2", {.out = Streams::nothing, .error = ends[1]}) == 0);
    char text[20];
    CHECK(std::string(text, static_cast<std::size_t>(read(ends[0], text, sizeof text))) == "wrong\n");
    close(ends[0]), close(ends[1]);
}
