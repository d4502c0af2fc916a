#include "core/base/estimate.h"

#include <cmath>

#include "tests/support/catch.h"

using namespace forage;

TEST_CASE("An estimate is a mean with the 95 % interval of Student's t") {
    CHECK_FALSE(estimate({}));
    CHECK(estimate({3})->low == 3);
    const auto three = *estimate({1, 2, 3});  // 2 +- 4.303 / sqrt(3)
    CHECK(three.mean == 2);
    CHECK(three.high - 2 == Approx(4.303 / std::sqrt(3)));
    CHECK(2 - three.low == Approx(three.high - 2));
    std::vector<double> many(31);  // t = 2.0423 for 30 degrees of freedom
    for (std::size_t i = 0; i < many.size(); ++i) many[i] = i % 2 == 0 ? 1 : -1;
    const auto e = *estimate(many);
    double squares = 0;
    for (const double v : many) squares += (v - e.mean) * (v - e.mean);
    CHECK(e.high - e.mean == Approx(2.0423 * std::sqrt(squares / 30 / 31)).epsilon(2e-4));
}

TEST_CASE("The width of an interval has the quantiles of Student's t in printed tables") {
    // The 97.5 % quantiles, by degrees of freedom.
    const std::pair<std::size_t, double> quantiles[] = {{1, 12.706}, {2, 4.303},  {4, 2.776},   {9, 2.262},
                                                        {10, 2.228}, {11, 2.201}, {14, 2.145},  {19, 2.093},
                                                        {29, 2.045}, {59, 2.001}, {119, 1.980}, {999, 1.962}};
    for (const auto& [degrees, t] : quantiles) {
        CAPTURE(degrees);
        const std::size_t n = degrees + 1;
        CHECK(half_width(9, n) == Approx(t * 3 / std::sqrt(n)).margin(0.0006 * 3 / std::sqrt(n)));
    }
}

TEST_CASE("A share has Wilson's interval, within 0 and 1") {
    const Estimate e = share(15, 17);  // of Wilson's score, by hand
    CHECK(e.mean == Approx(15. / 17));
    CHECK(e.low == Approx(0.6566).margin(0.0001));
    CHECK(e.high == Approx(0.9671).margin(0.0001));
    CHECK(share(0, 3).low == Approx(0).margin(1e-12));
    CHECK(share(3, 3).high == Approx(1));
}
