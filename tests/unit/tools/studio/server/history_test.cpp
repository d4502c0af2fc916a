#include "tools/studio/server/history.h"

#include <algorithm>
#include <string>

#include "tests/support/catch.h"
#include "tests/support/paths.h"
#include "tools/studio/server/session.h"

namespace {

using namespace forage;
using namespace forage::studio;

RunInput input() {
    RunInput out;
    out.system = FORAGE_SOURCE_DIR "/systems/reactive_foraging.iqr";
    out.world = FORAGE_SOURCE_DIR "/systems/worlds/basic_arena.world";
    return out;
}

}  // namespace

TEST_CASE("the past of a long run stays within its memory, and is what was") {
    const Session::Send no_page = [](int, bool, const std::string&) {};
    Session session(input(), no_page), again(input(), no_page);
    History first;
    first.begin(session.run());
    const std::size_t limit = 3 * first.bytes();
    History past(limit);
    past.begin(session.run());
    std::size_t largest = 0;
    while (session.run().cycle() < 20'000) {
        session.run().step();
        past.after_cycle(session.run());
        largest = std::max(largest, past.bytes());
    }
    CHECK(largest <= limit);
    CHECK(past.first() == 0);
    CHECK(past.last() == 20'000);
    for (const std::uint64_t cycle : past.cycles()) {
        while (again.run().cycle() < cycle) again.run().step();
        past.restore(session.run(), cycle);
        CHECK(session.run().cycle() == cycle);
        CHECK(session.run().digest() == again.run().digest());
    }
}
