#include "modules/contextual_layer/prototype_store.h"

#include <cmath>
#include <map>
#include <random>
#include <vector>

#include "tests/support/catch.h"

using namespace forage::contextual;
using Eigen::ArrayXd;
using Eigen::ArrayXf;

namespace {

/// The definition of the distance, without optimisations.
float defined_distance(const ArrayXf& stored, const ArrayXd& present) {
    const float stored_peak = std::max(0.0F, stored.maxCoeff());
    const double present_peak = static_cast<float>(std::max(0.0, present.maxCoeff()));
    if (!(stored_peak > 0) || !(present_peak > 0)) return 1;
    const float share = 1.0F / static_cast<float>(stored.size());
    float sum = 0;
    for (Index i = 0; i < stored.size(); ++i) {
        const float quotient = stored[i] / stored_peak;
        sum = static_cast<float>(sum +
                                 std::abs(quotient - present[i] / present_peak) * static_cast<double>(share));
    }
    return sum;
}

}  // namespace

TEST_CASE("Distances have the same bits as the definition, whatever was added and removed before") {
    std::mt19937 random(1);
    std::normal_distribution<float> normal;
    const Index keys = 90, capacity = 60, cells = 11;
    PrototypeStore store(keys, capacity, cells);
    std::map<Index, ArrayXf> stored;
    const auto drawn = [&] {
        ArrayXf out(cells);
        for (auto& v : out)
            v = random() % 3 ? 0 : normal(random);  // often 0, sometimes without a cell above 0
        return out;
    };
    std::vector<float> distances(keys, -1);
    for (int step = 0; step < 3000; ++step) {
        const Index key = static_cast<Index>(random() % keys);
        if (stored.count(key)) {
            store.remove(key);
            stored.erase(key);
        } else if (stored.size() < capacity) {
            store.add(key, stored[key] = drawn());
        }
        if (step % 3) continue;
        const ArrayXd present = drawn().cast<double>() * 1.1;
        store.compare(present, distances.data());
        REQUIRE(store.size() == static_cast<Index>(stored.size()));
        for (const auto& [k, prototype] : stored)
            if (distances[static_cast<std::size_t>(k)] != defined_distance(prototype, present))
                FAIL("step " << step << ", key " << k);
    }
}

TEST_CASE("Distances have the same bits as the definition for any number of prototypes and cells") {
    std::mt19937 random(2);
    std::uniform_real_distribution<float> uniform;
    const auto drawn = [&](Index cells) {
        const bool silent = random() % 8 == 0;
        const auto present = random() % 4 + 1;  // of 4 cells
        ArrayXf out = ArrayXf::Zero(cells);
        for (auto& v : out)
            if (!silent && random() % 4 < present)
                v = std::ldexp(uniform(random), random() % 3 ? 0 : -static_cast<int>(random() % 150));
        return out;
    };
    for (const Index cells : {1, 2, 48, 63, 64, 65, 130})
        for (const Index count : {1, 15, 16, 17, 31, 32, 33, 100}) {
            PrototypeStore store(count, count, cells);
            std::vector<ArrayXf> stored;
            std::vector<float> distances(static_cast<std::size_t>(count));
            for (Index key = 0; key < count; ++key) store.add(key, stored.emplace_back(drawn(cells)));
            int wrong = 0;
            for (int i = 0; i < 8; ++i) {
                const ArrayXd present = drawn(cells).cast<double>() * (i % 2 ? 1 : 1.1);
                store.compare(present, distances.data());
                for (std::size_t key = 0; key < stored.size(); ++key)
                    wrong += distances[key] != defined_distance(stored[key], present);
            }
            INFO(count << " prototypes of " << cells << " cells");
            CHECK(wrong == 0);
        }
}

TEST_CASE("A prototype has a distance near 0 to itself, at any strength, and at most 1 to others") {
    PrototypeStore store(3, 3, 4);
    const ArrayXf a = (ArrayXf(4) << 0.1F, 0.7F, 0, 0.3F).finished(),
                  b = (ArrayXf(4) << 0, 0, 1, 0).finished();
    store.add(0, a);
    store.add(1, b);
    store.add(2, 5 * a);
    float d[3];
    store.compare(3 * a.cast<double>(), d);
    CHECK(d[0] < 1e-6F);
    CHECK(d[2] < 1e-6F);
    CHECK(d[1] > 0.5F);
    CHECK(d[1] <= 1);
    store.compare(ArrayXd::Zero(4), d);
    CHECK((d[0] == 1 && d[1] == 1 && d[2] == 1));
    store.compare(ArrayXd::Constant(4, -1), d);
    CHECK((d[0] == 1 && d[1] == 1 && d[2] == 1));
}

TEST_CASE("Distances have the same bits as the definition when each prototype has few active cells") {
    std::mt19937 random(3);
    for (const Index cells : {40, 64, 150}) {
        const Index capacity = 100;
        PrototypeStore store(capacity, capacity, cells);
        std::map<Index, ArrayXf> stored;
        const auto drawn = [&] {
            ArrayXf out = ArrayXf::Zero(cells);
            for (auto n = random() % 3 + 1; n-- > 0;)
                out[static_cast<Index>(random() % static_cast<unsigned>(cells))] =
                    std::uniform_real_distribution<float>(0.1F, 1)(random);
            return out;
        };
        std::vector<float> distances(static_cast<std::size_t>(capacity));
        int wrong = 0;
        for (int step = 0; step < 1000; ++step) {
            const auto most = static_cast<std::size_t>(step / 100 % 2 ? 3 : capacity);  // fills, and empties
            const Index key = static_cast<Index>(random() % static_cast<unsigned>(capacity));
            if (stored.count(key) && (stored.size() > most || random() % 3 == 0)) {
                store.remove(key);
                stored.erase(key);
            } else if (!stored.count(key) && stored.size() < most) {
                store.add(key, stored[key] = drawn());
            }
            const ArrayXd present = drawn().cast<double>();
            store.compare(present, distances.data());
            for (const auto& [k, prototype] : stored)
                wrong += distances[static_cast<std::size_t>(k)] != defined_distance(prototype, present);
        }
        CHECK(wrong == 0);
    }
}
