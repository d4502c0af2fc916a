// The contextual layer estimates distances and makes those of selectable segments exact. Its results must not
// depend on that.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <vector>

#include "modules/contextual_layer/contextual_layer.h"
#include "modules/contextual_layer/prototype_store.h"
#include "tests/support/catch.h"

using namespace forage::contextual;
using Eigen::ArrayXd;
using Eigen::ArrayXf;
using forage::Archive;

namespace {

/// Random prototypes from 0 to 1: some without activity, some with few active cells, some with tiny
/// activities.
class Drawn {
  public:
    explicit Drawn(unsigned seed) : random_(seed) {}
    Index below(Index n) { return static_cast<Index>(random_() % static_cast<unsigned>(n)); }
    double uniform() { return std::uniform_real_distribution<double>()(random_); }
    ArrayXf prototype(Index cells) {
        const auto present = below(5);  // of 4 cells
        ArrayXf out = ArrayXf::Zero(cells);
        for (auto& v : out)
            if (below(4) < present)
                v = static_cast<float>(std::ldexp(uniform(), below(3) ? 0 : -static_cast<int>(below(150))));
        return out;
    }

  private:
    std::mt19937 random_;
};

std::vector<float> exact_distances(const std::vector<ArrayXf>& stored, const ArrayXd& present) {
    const auto count = static_cast<Index>(stored.size());
    PrototypeStore store(count, count, present.size());
    for (Index key = 0; key < count; ++key) store.add(key, stored[static_cast<std::size_t>(key)]);
    std::vector<float> out(stored.size());
    store.compare(present, out.data());
    return out;
}

}  // namespace

TEST_CASE("Estimated distances have at most the stated error, and required ones are exact") {
    Drawn drawn(1);
    for (const Index cells : {1, 2, 48, 65, 400, 1023}) {
        const Index count = 300;
        PrototypeStore store(count, count, cells);
        std::vector<ArrayXf> stored;
        for (Index key = 0; key < count; ++key) store.add(key, stored.emplace_back(drawn.prototype(cells)));
        std::vector<float> distances(static_cast<std::size_t>(count));
        int estimated = 0, estimates = 0, beyond = 0, wrong = 0;
        for (int i = 0; i < 50; ++i) {
            const ArrayXd present = drawn.prototype(cells).cast<double>() * (i % 2 ? 1 : 1.1);
            const auto exact = exact_distances(stored, present);
            store.estimate(present, distances.data());
            const float error = store.error();
            estimated += error > 0;
            for (std::size_t key = 0; key < stored.size(); ++key) {
                beyond += !(std::abs(distances[key] - exact[key]) <= error);
                estimates += distances[key] != exact[key];
            }
            std::set<Index> needed;
            for (Index n = drawn.below(6); n > 0; --n) needed.insert(drawn.below(count));
            for (const Index key : needed) store.require(key);
            store.refine(distances.data());
            for (const Index key : needed)
                wrong += distances[static_cast<std::size_t>(key)] != exact[static_cast<std::size_t>(key)];
            for (std::size_t key = 0; key < stored.size(); ++key)
                beyond += !(std::abs(distances[key] - exact[key]) <= store.error());
            if (i % 2) continue;
            store.compare(present, distances.data());
            CHECK(store.error() == 0);
            CHECK(distances == exact);
        }
        INFO(cells << " cells");
        CHECK(beyond == 0);
        CHECK(wrong == 0);
        CHECK(estimated > 20);
        CHECK(estimates > 100);
    }
}

TEST_CASE("The error of estimates is small if estimates are made") {
    Drawn drawn(2);
    for (const Index cells : {48, 1023, 1024, 5000}) {
        PrototypeStore store(2, 2, cells);
        store.add(0, ArrayXf::Ones(cells));
        float distances[2];
        store.estimate(ArrayXd::Ones(cells), distances);
        CHECK(store.error() < (cells == 48 ? 0.001F : 0.02F));
        CHECK((store.error() == 0) == (cells > 1023));
    }
}

TEST_CASE("Estimates pause when most distances have to be made exact") {
    Drawn drawn(3);
    const Index cells = 48, count = 100;
    PrototypeStore store(count, count, cells);
    for (Index key = 0; key < count; ++key) store.add(key, ArrayXf::Constant(cells, 1));
    std::vector<float> distances(static_cast<std::size_t>(count));
    int estimates = 0;
    const auto compare = [&](Index needed) {
        ArrayXd present = ArrayXd::Constant(cells, drawn.uniform());
        present[0] = 1;
        store.estimate(present, distances.data());
        estimates += store.error() > 0;
        for (Index key = 0; store.error() > 0 && key < needed; ++key) store.require(key);
        store.refine(distances.data());
    };
    for (int i = 0; i < 1000; ++i) compare(count);
    CHECK(estimates > 20);
    CHECK(estimates < 100);
    for (int i = 0; i < 20; ++i) compare(1);
    estimates = 0;
    for (int i = 0; i < 100; ++i) compare(1);
    CHECK(estimates == 100);
}

TEST_CASE("Prototypes that are not in 0..1 are compared exactly") {
    const Index cells = 3;
    PrototypeStore store(20, 20, cells);
    for (Index key = 0; key < 20; ++key) store.add(key, ArrayXf::Constant(cells, 1));
    const ArrayXd present = (ArrayXd(cells) << 0.2, 0.7, 1).finished();
    float distances[20];
    store.estimate(present, distances);
    CHECK(store.error() > 0);
    const float infinity = std::numeric_limits<float>::infinity();
    for (const float odd : {-1.0F, -1e-30F, infinity}) {
        for (const Index key : {0, 19}) {
            store.remove(key);
            store.add(key, (ArrayXf(cells) << odd, 1, 0.5).finished());
        }
        store.estimate(present, distances);
        CHECK(store.error() == 0);
        store.remove(19);
        store.estimate(present, distances);
        CHECK(store.error() == 0);
        store.remove(0);
        store.estimate(present, distances);
        CHECK(store.error() > 0);
        for (const Index key : {0, 19}) store.add(key, ArrayXf::Constant(cells, 1));
    }
    store.estimate((ArrayXd(cells) << -0.1, 0.5, 1).finished(), distances);
    CHECK(store.error() == 0);
}

namespace {

template <class Array>
bool same(const Array& a, const Array& b) {
    return (a == b || (a.isNaN() && b.isNaN())).all();
}

/// Two layers with the same inputs: in one all distances are exact, in the other only those of selectable
/// segments.
struct Two {
    Index cells, actions = 4;
    ContextualLayer exact, estimating;
    Settings settings{0.5, 0.95, 1.1, 0.005, 0.1};

    Two(Index height, Index width, Index of_cells)
        : cells(of_cells),
          exact(height, width, of_cells, actions),
          estimating(height, width, of_cells, actions) {}

    void step(const ArrayXd& prototype, Index action, bool goal) {
        ArrayXd acted = ArrayXd::Zero(actions);
        acted[action] = 1;
        const ContextualLayer::Inputs in{acted, prototype, goal ? 0.3 : 0, 0, 0.05};
        exact.update(in, settings);
        estimating.update(in, settings, ContextualLayer::Exact::selectable);
    }
    bool agree() const {
        const auto &a = exact.memory(), &b = estimating.memory();
        return same(a.selected(), b.selected()) && same(a.trigger(), b.trigger()) &&
               same(exact.action(), estimating.action());
    }
    Index inexact() const { return (exact.memory().distance() != estimating.memory().distance()).count(); }
};

std::string bytes_of(ContextualLayer& layer) {
    Archive out;
    layer.checkpoint(out);
    return out.bytes();
}

}  // namespace

TEST_CASE("A layer with estimates selects the same segments and has the same action as one without") {
    struct Of {
        Index height, width, cells;
    };
    Index selected = 0, inexact = 0, on_the_edge = 0;
    for (const Of of : {Of{12, 20, 48}, Of{30, 30, 5}, Of{6, 40, 400}, Of{4, 4, 1100}}) {
        Drawn drawn(static_cast<unsigned>(of.cells));
        Two two(of.height, of.width, of.cells);
        // Few similar patches: many candidates are nearly as good as the best one.
        std::vector<ArrayXd> patches;
        const ArrayXd all = drawn.prototype(of.cells).cast<double>() + 0.2;
        for (int p = 0; p < 6; ++p) patches.push_back(all + 0.01 * drawn.prototype(of.cells).cast<double>());
        const int steps = of.cells == 1100 ? 300 : 3000;
        int wrong = 0;
        ArrayXd seen = patches[0];
        for (int i = 0; i < steps; ++i) {
            if (drawn.below(3)) {  // else it stays in view
                seen = patches[static_cast<std::size_t>(drawn.below(6))] * (1 + drawn.uniform());
                if (drawn.below(4) == 0) seen += 1e-3 * drawn.prototype(of.cells).cast<double>();
                if (drawn.below(10) == 0) seen.setZero();
                if (drawn.below(40) == 0) seen[0] = -0.1;
            }
            // Thresholds that are equal to a collector.
            if (i % 5 == 0) {
                two.settings.memory_threshold = 0.5 + 0.6 * drawn.uniform();
                const auto& c = two.exact.memory().collector();
                const float edge = c(drawn.below(c.rows()), drawn.below(c.cols()));
                if (edge > 0 && drawn.below(2)) {
                    two.settings.memory_threshold = edge;
                    ++on_the_edge;
                }
                two.settings.winner_share =
                    drawn.below(3) ? 0.9 + 0.1 * drawn.uniform() : 0.5 * static_cast<double>(drawn.below(4));
                two.settings.trigger_reset = drawn.below(4) ? 1.1 : 2 * drawn.uniform();
                two.settings.trigger_decay = drawn.below(2) ? 0.005 : 2 * drawn.uniform();
            }
            two.step(seen, drawn.below(4), drawn.below(12) == 0);
            wrong += !two.agree();
            selected += static_cast<Index>(two.exact.memory().selected().sum());
            inexact += two.inexact();
        }
        INFO(of.height << " x " << of.width << " segments of " << of.cells << " cells");
        CHECK(wrong == 0);
    }
    CHECK(selected > 10000);
    CHECK(inexact > 3000);
    CHECK(on_the_edge > 200);
}

TEST_CASE("A trigger that is NaN does not hide the errors of others", "[long]") {
    const Index cells = 100;
    int wrong = 0, not_numbers = 0;
    for (unsigned world = 0; world < 5000; ++world) {
        Drawn drawn(world);
        const auto prototype = [&] {
            ArrayXd out(cells);
            for (auto& v : out) v = 0.2 * drawn.uniform();
            out[0] = 1;
            return out;
        };
        Two two(20, 20, cells);
        const ArrayXd known = prototype();
        for (int i = 0; i < 20; ++i) two.step(i == 18 ? known : prototype(), drawn.below(4), i == 19);
        two.settings = {0.999, 0.99, 1e39, 1, 0.1};  // the next trigger will be infinite in single precision
        two.step(known, 0, false);
        two.settings.memory_threshold = 0.1;
        two.settings.winner_share = 1;
        two.step(prototype(), 0, false);  // infinity times 1 - 1
        not_numbers += two.exact.memory().trigger().hasNaN();
        wrong += !two.agree();
    }
    CHECK(wrong == 0);
    CHECK(not_numbers > 4000);
}

TEST_CASE("The selection is the same when the errors of estimates are as large as possible", "[long]") {
    // All cells of a prototype except one are equal, so that all are rounded in the same direction.
    Drawn drawn(7);
    const Index cells = 400;
    const auto even = [&] {
        ArrayXd out = ArrayXd::Constant(cells, drawn.uniform());
        out[0] = 1;
        return out;
    };
    Two two(10, 30, cells);
    int wrong = 0;
    Index inexact = 0;
    for (int i = 0; i < 20000; ++i) {
        const bool learns = i % 2000 < 300;
        auto& s = two.settings;
        // The threshold is decided by the share only, or is equal to a collector.
        s.memory_threshold = 0.1;
        s.winner_share = 1 - 0.01 * static_cast<double>(drawn.below(4));
        s.trigger_reset = 1.9;
        if (drawn.below(2)) {
            const auto& c = two.exact.memory().collector();
            s.memory_threshold = c(drawn.below(c.rows()), drawn.below(c.cols()));
            s.winner_share = 0.5;
        }
        const ArrayXd seen = even();
        const Index steps = 1 + drawn.below(2);  // the second time the edge is one of this very comparison
        for (Index k = 0; k < steps; ++k) {
            two.step(seen, drawn.below(4), learns && drawn.below(12) == 0);
            wrong += !two.agree();
            inexact += two.inexact();
            const auto& c = two.exact.memory().collector();
            if (s.winner_share == 0.5) s.memory_threshold = c(drawn.below(c.rows()), drawn.below(c.cols()));
        }
    }
    CHECK(wrong == 0);
    CHECK(inexact > 50000);
}

TEST_CASE("A layer continues from a checkpoint with the same results, whichever distances are exact") {
    Drawn drawn(5);
    Two two(8, 8, 20);
    for (int i = 0; i < 400; ++i) {
        if (drawn.below(2)) {  // else nothing changes, and what is estimated stays so
            const ArrayXd seen = drawn.prototype(20).cast<double>();
            two.step(seen, drawn.below(4), drawn.below(8) == 0);
        }
        if (i % 7) continue;
        ContextualLayer read(8, 8, 20, 4);
        const std::string written = bytes_of(two.estimating);
        Archive in{std::string_view(written)};
        read.checkpoint(in);
        CHECK((bytes_of(read) == written));
        ContextualLayer one = two.estimating;
        for (int k = 0; k < 5; ++k) {
            const ArrayXd seen = drawn.prototype(20).cast<double>();
            const ContextualLayer::Inputs same{ArrayXd::Ones(4), seen, k == 3 ? 0.3 : 0, 0, 0.05};
            one.update(same, two.settings, ContextualLayer::Exact::selectable);
            read.update(same, two.settings, ContextualLayer::Exact::selectable);
        }
        CHECK((bytes_of(one) == bytes_of(read)));
    }
}
