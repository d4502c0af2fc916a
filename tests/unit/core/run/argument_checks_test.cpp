#include "core/run/argument_checks.h"

#include <array>
#include <cmath>
#include <limits>

#include "core/run/input_error.h"
#include "tests/support/catch.h"

using namespace forage;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::string mistake(RunLength length) {
    Diagnostics diagnostics;
    length.in_code = true;
    const bool fine = check_length(length, diagnostics);
    CHECK(fine == !diagnostics.failed());
    return diagnostics.failed() ? diagnostics.all().front().message : "";
}

}  // namespace

TEST_CASE("A length is one number that a run can reach") {
    CHECK(mistake({}).empty());
    CHECK(mistake({.cycles = 0}).empty());
    CHECK(mistake({.seconds = 0}).empty());
    CHECK(mistake({.trials = 3, .until = {"cycle > 3"}}).empty());
    for (const double s : {-1.0, -0.001, std::nan(""), infinity, -infinity, 1e300})
        CHECK_THAT(mistake({.seconds = s}), StartsWith("seconds: "));
    for (const double s : {-1.0, 0.0, std::nan(""), infinity})
        CHECK_THAT(mistake({.trials = 1, .trial_timeout = s}), StartsWith("trial_timeout: "));
    CHECK(mistake({.cycles = std::numeric_limits<std::uint64_t>::max()}) ==
          "cycles: 18446744073709551615 is too many");
    const std::string several = "cycles, seconds, trials: a run has only one length";
    CHECK(mistake({.cycles = 1, .seconds = 1}) == several);
    CHECK(mistake({.seconds = 1, .trials = 1}) == several);
    CHECK(mistake({.cycles = 1, .trials = 1}) == several);
}

TEST_CASE("Messages about the command line name options") {
    Diagnostics diagnostics;
    CHECK_FALSE(check_length({.seconds = -1}, diagnostics));
    CHECK(diagnostics.all().front().message == "--seconds: -1 is not a length of time");
}

TEST_CASE("Numbers and poses are finite, and threads are counted from 1") {
    const std::array<double, 3> numbers = {1, infinity, 2};
    CHECK_NOTHROW(check_finite({}, "P/A"));
    CHECK_NOTHROW(check_finite(std::span(numbers).first(1), "P/A"));
    CHECK_THROWS_WITH(check_finite(numbers, "P/A"), ContainsSubstring("P/A: inf is not a finite number"));
    CHECK_NOTHROW(check_pose(-1e4, 1e4, 100));
    for (const double wrong : {std::nan(""), infinity, -infinity, 1.1e4})
        CHECK_THROWS_AS(check_pose(0, wrong), InputError);
    CHECK_THROWS_AS(check_pose(0, 0, std::nan("")), InputError);
    Diagnostics diagnostics;
    CHECK((check_threads(1, diagnostics) && check_threads(1024, diagnostics)));
    CHECK_FALSE((check_threads(0, diagnostics) || check_threads(-1, diagnostics) ||
                 check_threads(1025, diagnostics)));
    CHECK(diagnostics.errors() == 3);
}
