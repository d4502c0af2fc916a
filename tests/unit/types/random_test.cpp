#include "core/types/random.h"

#include <cmath>
#include <vector>

#include "tests/support/catch.h"

using forage::RandomStream;

TEST_CASE("A random number depends only on seed, item, stream, cycle and index") {
    const RandomStream stream(1, "group");
    std::vector<double> block(101);
    stream.uniform(7, block);
    for (std::uint32_t i = 0; i < block.size(); ++i) REQUIRE(stream.uniform(7, i) == block[i]);
    CHECK(stream.uniform(7, 0) != RandomStream(2, "group").uniform(7, 0));
    CHECK(stream.uniform(7, 0) != RandomStream(1, "other").uniform(7, 0));
    CHECK(stream.uniform(7, 0) != RandomStream(1, "group", 1).uniform(7, 0));
    CHECK(stream.uniform(7, 0) != stream.uniform(8, 0));
}

TEST_CASE("Two draws of one cycle are independent, and the first is what no draw gives") {
    const RandomStream stream(3, "group");
    std::vector<double> plain(100001), first(plain.size()), second(plain.size());
    stream.uniform(7, plain);
    stream.uniform(7, first, 0);
    stream.uniform(7, second, 1);
    CHECK(plain == first);
    CHECK(stream.uniform(7, 0) == Approx(0.3643410400112328).epsilon(0));  // as in every version
    double covariance = 0;
    for (std::size_t i = 0; i < first.size(); ++i) {
        REQUIRE(first[i] != second[i]);
        REQUIRE(stream.uniform(7, static_cast<std::uint32_t>(i), 1) == second[i]);
        covariance += (first[i] - 0.5) * (second[i] - 0.5);
    }
    const auto n = static_cast<double>(first.size());
    CHECK(std::abs(covariance / n) < 4 / 12.0 / std::sqrt(n));  // the product's standard deviation is 1/12
}

TEST_CASE("Uniform numbers fill [0, 1) evenly and normal numbers have mean 0 and variance 1") {
    const RandomStream stream(3, "group");
    std::vector<double> u(100001), z(100001);
    stream.uniform(0, u);
    stream.normal(1, z);
    double sum_u = 0, sum_z = 0, sum_zz = 0;
    for (const double v : u) {
        REQUIRE((v >= 0 && v < 1));
        sum_u += v;
    }
    for (const double v : z) sum_z += v, sum_zz += v * v;
    const auto n = static_cast<double>(u.size());
    CHECK(std::abs(sum_u / n - 0.5) < 4 * std::sqrt(1 / 12.0 / n));
    CHECK(std::abs(sum_z / n) < 4 / std::sqrt(n));
    CHECK(std::abs(sum_zz / n - 1) < 4 * std::sqrt(2 / n));
}
