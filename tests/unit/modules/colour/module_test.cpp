#include "modules/colour/module.h"

#include <limits>

#include "tests/support/catch.h"
#include "tests/support/module_bench.h"

using namespace forage;
using namespace forage::test;
using colour::HueBins;
using Eigen::ArrayXd;

TEST_CASE("A pixel's value appears in exactly the bins that contain its hue") {
    for (const Index n : {1, 2, 3, 7, 12, 13, 360}) {
        const HueBins bins(n);
        std::vector<double> hues{-1, -1e-9, 0, 1, 1 + 1e-9, 2, 0.5, std::numeric_limits<double>::quiet_NaN()};
        for (Index k = 0; k <= 4 * n; ++k) {
            const double limit = static_cast<double>(k) / static_cast<double>(4 * n);
            for (const double offset : {0.0, 1e-9, -1e-9, 3e-8, -3e-8, 1e-7, -1e-7, 1e-5, -1e-5})
                hues.push_back(limit + offset);
            hues.push_back(static_cast<float>(limit));
        }
        const ArrayXd hue = Eigen::Map<ArrayXd>(hues.data(), static_cast<Index>(hues.size()));
        const ArrayXd value = ArrayXd::LinSpaced(hue.size(), -1, 1);
        ArrayXd planes = ArrayXd::Constant(n * hue.size(), 99);
        bins.separate(hue, value, planes);
        Index wrong = 0;
        for (Index b = 0; b < n; ++b)
            for (Index i = 0; i < hue.size(); ++i)
                wrong += planes[b * hue.size() + i] != (bins.contains(b, hue[i]) ? value[i] : 0);
        CHECK(wrong == 0);
    }
}

TEST_CASE("Bins are centred on their colour, include their upper limit, and the first one wraps around") {
    const HueBins bins(12);
    for (Index b = 0; b < 12; ++b)
        for (Index other = 0; other < 12; ++other)
            CHECK(bins.contains(other, static_cast<double>(b) / 12) == (b == other));
    CHECK(bins.contains(0, 0.99));
    CHECK(bins.contains(0, static_cast<float>(0.5 / 12)));
    CHECK_FALSE(bins.contains(1, static_cast<float>(0.5 / 12)));
    for (const double outside : {-0.5, 1.5})
        for (Index b = 0; b < 12; ++b) CHECK(bins.contains(b, outside) == (b == 0));
}

TEST_CASE("A hue at a limit of two bins can be in both or in none, as in the original") {
    const HueBins bins(12);
    const auto places = [&](double hue) {
        int count = 0;
        for (Index b = 0; b < 12; ++b) count += bins.contains(b, hue);
        return count;
    };
    int in_none = 0, in_two = 0;
    for (int k = 1; k < 24; k += 2)
        for (const float step : {0.0F, 2.0F}) {
            const int n = places(std::nextafter(static_cast<float>(k / 24.0), step));
            in_none += n == 0, in_two += n == 2;
            in_none += places(static_cast<float>(k / 24.0)) == 0,
                in_two += places(static_cast<float>(k / 24.0)) == 2;
        }
    CHECK(in_none > 0);
    CHECK(in_two > 0);
}

TEST_CASE("moduleColor writes each new picture, and keeps it until the next one") {
    ModuleBench b(module_type<colour::ColourModule>());
    b.in("_hue", 2, 1).in("_value", 2, 1).out("_color", 2, 3);
    CHECK(b.problems().empty());
    b.start();
    b.inputs[0] << 0.0, 0.34;
    b.inputs[1] << 0.7, 0.8;
    const auto expect = [&](std::array<double, 6> cells) {
        b.update();
        CHECK(std::equal(cells.begin(), cells.end(), b.outputs[0].begin()));
    };
    expect({0.7, 0, 0, 0.8, 0, 0});
    expect({0.7, 0, 0, 0.8, 0, 0});
    b.inputs[1][0] = 0.2;
    expect({0.2, 0, 0, 0.8, 0, 0});
    b.inputs[0][1] = 0.67;
    expect({0.2, 0, 0, 0, 0, 0.8});
    b.start();
    b.update();
    CHECK(b.outputs[0].isZero());
}

TEST_CASE("moduleColor reports groups of the wrong size") {
    const auto problem = [](int value_h, int w, int h) {
        ModuleBench b(module_type<colour::ColourModule>());
        b.in("_hue", 4, 3).in("_value", 4, value_h).out("_color", w, h);
        const auto all = b.problems();
        return all.size() == 1 ? all[0].port + ": " + all[0].message + " | " + all[0].hint
                               : std::to_string(all.size()) + " problems";
    };
    CHECK(problem(3, 4, 36) == "0 problems");
    CHECK(
        problem(9, 4, 3) ==
        "_value: '_value' needs the size of '_hue'; 'P/_value' is 4 x 9, 'P/_hue' 4 x 3 | make the group 4 x "
        "3; --lenient accepts it, as the original does");
    CHECK_THAT(problem(3, 5, 36),
               ContainsSubstring("_color: ") && ContainsSubstring("'P/_color' is 5 x 36, 'P/_hue' 4 x 3"));
    CHECK_THAT(problem(3, 4, 35), ContainsSubstring("multiple of its height"));
    CHECK_THAT(problem(2, 4, 36), ContainsSubstring("_value: ") && ContainsSubstring("is 4 x 2") &&
                                      !ContainsSubstring("lenient"));
}
