#include "core/connectivity/distance_functions.h"

#include <cmath>

#include "tests/unit/core/connectivity/wiring.h"

using namespace forage;
using namespace forage::connectivity;

TEST_CASE("Uniform, Linear, Gaussian and Block attenuate as the original does") {
    const std::vector<double> d{0, 1, 2, 3};
    const auto of = [&](auto form) { return attenuation({form, {}}, d, RandomStream(1, "c")); };
    CHECK(of(model::UniformFunction{0.3}).values == std::vector<double>{0.3, 0.3, 0.3, 0.3});
    CHECK(of(model::UniformFunction{-1}).values == std::vector<double>{0, 0, 0, 0});
    CHECK(of(model::UniformFunction{1.5}).reference == 1);  // a factor below 0
    const auto linear = of(model::LinearFunction{0.25, 1});
    CHECK(linear.values == std::vector<double>{0.25, 0.5, 0.75, 1});
    CHECK(linear.reference == 1);
    CHECK(of(model::LinearFunction{0.75, 0.25}).reference == 0.75);
    CHECK(of(model::BlockFunction{0.1, 0.7, 3, 0}).values ==
          std::vector<double>{0.1, 0.1, 0.7, 0.7});  // half of 3, as a whole number
    CHECK(of(model::BlockFunction{0.1, 0.7, 3, 0}).reference == 0.7);
    const auto gaussian = of(model::GaussianFunction{0, 1, 2});
    for (std::size_t i = 0; i < d.size(); ++i)
        CHECK(gaussian.values[i] == Approx(1 - std::exp(-d[i] * d[i] / 8)).margin(1e-15));
    CHECK(gaussian.reference == gaussian.values[3]);  // the largest that occurs
    CHECK(of(model::GaussianFunction{0, 1, 0}).values == std::vector<double>{0, 1, 1, 1});
    CHECK(attenuation({model::GaussianFunction{}, {}}, {}, RandomStream(1, "c")).values.empty());
}

TEST_CASE("Linear divides 0 by 0 when all distances are 0, and a warning reports it") {
    Wiring w;
    w.attenuation.form = model::LinearFunction{0, 1};
    const auto built = w.build();
    CHECK(std::isnan(built.synapses.attenuation[0]));
    CHECK(built.said() == "the attenuation of connection 'C' is not a number: 0 / 0");
    w.delay.form = model::LinearFunction{0, 5};
    CHECK(w.build().synapses.delay[0] == 0);  // and not the cast of a NaN
}

TEST_CASE(
    "Delays are whole: truncated for Uniform and Block, half away from zero for the others, and never "
    "negative") {
    const std::vector<double> d{0, 1, 2};
    const auto of = [&](auto form) { return delays({form, {}}, d, RandomStream(1, "c")); };
    CHECK(of(model::UniformFunction{2.9}) == std::vector<int>{2, 2, 2});
    CHECK(of(model::UniformFunction{-3}) == std::vector<int>{0, 0, 0});
    CHECK(of(model::LinearFunction{0, 5}) == std::vector<int>{0, 3, 5});      // 2.5
    CHECK(of(model::LinearFunction{2, 7}) == std::vector<int>{2, 5, 7});      // 4.5
    CHECK(of(model::LinearFunction{1.9, 3.9}) == std::vector<int>{1, 2, 3});  // bounds are whole numbers
    CHECK(of(model::LinearFunction{5, -5}) == std::vector<int>{5, 0, 0});
    CHECK(of(model::BlockFunction{1, 4, 2, 0}) == std::vector<int>{1, 1, 4});
    for (const int v : of(model::RandomFunction{3})) CHECK((v >= 0 && v <= 3));
}

TEST_CASE("Parameters of functions pass through a text with six digits") {
    CHECK(six_digits(1.23456789) == 1.23457);
    CHECK(six_digits(0.123456789) == 0.123457);
    CHECK(six_digits(1234567) == 1.23457e6);
    CHECK(six_digits(1e-10 / 3) == 3.33333e-11);
    CHECK(six_digits(0.5) == 0.5);
    CHECK(six_digits(-2) == -2);
    CHECK(six_digits(1e300) == 1e300);
}
