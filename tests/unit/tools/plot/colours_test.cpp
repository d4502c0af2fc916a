#include "tools/plot/colours.h"

#include <cmath>

#include "tests/support/catch.h"

using namespace forage::plot;

namespace {

/// Distance in CIE L*, the perceived brightness.
double lightness(const Colour& c) {
    const auto linear = [](double v) {
        return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    };
    const double y = 0.2126 * linear(c.r) + 0.7152 * linear(c.g) + 0.0722 * linear(c.b);
    return y > 0.008856 ? 116 * std::cbrt(y) - 16 : 903.3 * y;
}

}  // namespace

TEST_CASE("Even steps of a value are even steps of brightness") {
    double last = lightness(sequential(0));
    for (int i = 1; i <= 20; ++i) {
        const double now = lightness(sequential(i / 20.0));
        CHECK(now - last > 2);
        CHECK(now - last < 6);
        last = now;
    }
    for (const double v : {0.3, 0.6, 1.0})
        CHECK(lightness(diverging(v)) == Approx(lightness(diverging(-v))).margin(9));
}

TEST_CASE("All lines of a time plot have different colours") {
    for (std::size_t a = 0; a < 10; ++a)
        for (std::size_t b = 0; b < a; ++b) {
            const Colour x = category(a), y = category(b);
            CHECK(std::abs(x.r - y.r) + std::abs(x.g - y.g) + std::abs(x.b - y.b) > 0.2);
        }
}
