#include "core/base/random.h"

#include <algorithm>
#include <cmath>
#include <limits>
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

TEST_CASE("Two draws of one cycle are independent, and the first draw is the default") {
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

TEST_CASE("Uniform numbers are the upper 53 of the raw bits, whatever their number") {
    const RandomStream stream(5, "group");
    for (const std::size_t size : {1, 2, 15, 16, 17, 100, 1000}) {
        std::vector<std::uint64_t> bits(size);
        stream.bits(3, bits);
        for (std::size_t i = 0; i < size; ++i)
            REQUIRE(static_cast<double>(bits[i] >> 11) * 0x1p-53 ==
                    stream.uniform(3, static_cast<std::uint32_t>(i)));
    }
}

TEST_CASE("Events have the given probability, and those of a cell do not depend on the number of cells") {
    const RandomStream stream(3, "group");
    const double probability = GENERATE(0.0, 1e-3, 0.3, 0.5, 1 - 1e-3, 1.0);
    std::vector<double> all(200'001), few(77), other(all.size());
    stream.events(4, probability, all, 2.5);
    stream.events(4, probability, few, 2.5);
    stream.events(5, probability, other, 2.5);
    double count = 0, both = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        REQUIRE((all[i] == 0 || all[i] == 2.5));
        count += all[i] > 0, both += all[i] > 0 && other[i] > 0;
    }
    for (std::size_t i = 0; i < few.size(); ++i) REQUIRE(few[i] == all[i]);
    const auto n = static_cast<double>(all.size());
    const auto off = [n](double p) { return 4 * std::sqrt(p * (1 - p) / n); };
    CHECK(std::abs(count / n - probability) <= off(probability));
    CHECK(std::abs(both / n - probability * probability) <= off(probability * probability));
}

TEST_CASE("Events of probability 0 never occur, and those of a probability above 1 always do") {
    const RandomStream stream(3, "group");
    const auto active = [&](double probability) {
        std::vector<double> all(70'000);  // some have ties
        stream.events(4, probability, all);
        return std::count(all.begin(), all.end(), 1.0);
    };
    using Limits = std::numeric_limits<double>;
    CHECK(active(Limits::quiet_NaN()) == 0);
    CHECK(active(-Limits::infinity()) == 0);
    CHECK(active(-0.5) == 0);
    CHECK(active(1.5) == 70'000);
    CHECK(active(Limits::infinity()) == 70'000);
}

TEST_CASE("A cell that is active at a probability is active at every higher one") {
    // Each of the 65536 steps is a tie for about one cell in a thousand: ties are decided by other code.
    const RandomStream stream(9, "group");
    std::vector<double> now(64), before(64, 0.0);
    int switched = 0;
    for (int step = 0; step <= 65536; ++step, before = now) {
        stream.events(1, step / 65536.0, now);
        for (std::size_t i = 0; i < now.size(); ++i) {
            REQUIRE(now[i] >= before[i]);
            switched += now[i] > before[i];
        }
    }
    CHECK(switched == 64);
}

TEST_CASE("A column of random numbers has the same numbers when it is computed in parts") {
    const RandomStream stream(9, "group");
    constexpr std::size_t size = 333;
    std::vector<double> uniform(size), events(size), part(size);
    stream.uniform(5, uniform, 2);
    stream.events(5, 0.4, events, 2.5, 1);
    for (const std::size_t first : {64, 128, 320}) {
        part.resize(size - first);
        stream.uniform(5, part, 2, first);
        CHECK(std::equal(part.begin(), part.end(), uniform.begin() + static_cast<std::ptrdiff_t>(first)));
        stream.events(5, 0.4, part, 2.5, 1, first);
        CHECK(std::equal(part.begin(), part.end(), events.begin() + static_cast<std::ptrdiff_t>(first)));
    }
}

TEST_CASE("A number of a column is the one that its index has alone, for columns of any size") {
    const RandomStream stream(7, "item");
    for (const std::size_t size : {1, 15, 16, 17, 64, 65, 1000, 70'000}) {  // 70,000 cells have ties
        std::vector<double> uniform(size);
        stream.uniform(77, uniform, 2);
        for (std::uint32_t i = 0; i < size; ++i) REQUIRE(uniform[i] == stream.uniform(77, i, 2));
        for (const double probability : {0.0, 0.3, 0x1p-16, 1.0}) {
            std::vector<double> events(size), batch(64);
            stream.events(77, probability, events, 3, 2);
            for (std::size_t i = 0; i < size; ++i) {
                if (i % 64 == 0) stream.events(77, probability, batch, 3, 2, i);
                REQUIRE(events[i] == batch[i % 64]);
            }
        }
    }
}
