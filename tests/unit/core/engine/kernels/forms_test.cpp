// Lists of synapses in slices, panels and blocks, or laid out by source, give the numbers of the plain list,
// to the bit.
#include "core/engine/kernels/forms.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "tests/support/catch.h"

using namespace forage;
using namespace forage::engine;

namespace {

struct Gain final : SynapseInstance {
    void* parameters() override { return nullptr; }
    void update(SynapseColumns&) const override {}
    double gain() const override { return 1.3; }
};

enum class Order { ascending, shuffled, columns };
enum class Numbers { ordinary, extreme, sparse };  // sparse: extreme, and most activities are 0 or -0

/// Zeros, denormal numbers, numbers that overflow, infinities and NaNs, of both signs. Most numbers are
/// ordinary, so that not every sum is a NaN.
double extreme(std::mt19937& random, double ordinary) {
    using Limits = std::numeric_limits<double>;
    const double sign = random() % 2 ? 1 : -1;
    const auto kind = random() % 600;
    if (kind > 60) return ordinary;
    if (kind > 30) return sign * 0.0;
    if (kind > 3) return sign * static_cast<double>(kind) * Limits::denorm_min();
    return std::copysign(kind == 0   ? Limits::quiet_NaN()
                         : kind == 1 ? Limits::infinity()
                                     : Limits::max(),
                         sign);
}

struct Shape {
    int sources, targets, most;  ///< synapses of a target
};

/// Targets with 0 to `most` synapses, some of them from the same source.
connectivity::Synapses random_list(const Shape& shape, Order order, int delays, bool same,
                                   Numbers numbers = Numbers::ordinary) {
    std::mt19937 random(1);
    const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    connectivity::Synapses out;
    for (int t = 0; t < shape.targets; ++t) {
        std::vector<int> sources(static_cast<std::size_t>(below(8) == 0 ? 0 : below(shape.most + 1)));
        for (int& s : sources) s = below(shape.sources);
        if (sources.size() > 2) sources[1] = sources[0];
        if (order == Order::ascending) std::sort(sources.begin(), sources.end());
        for (const int s : sources) {
            out.pre.push_back(s), out.post.push_back(t), out.distance.push_back(0);
            out.delay.push_back(3 * below(delays));
            const double factor = same ? 0.3 : 1e-3 * below(1000);
            out.attenuation.push_back(numbers == Numbers::extreme && !same ? extreme(random, factor)
                                                                           : factor);
        }
    }
    return out;
}

struct Activity {
    static constexpr int depth = 10;
    std::vector<double> rows;
    int cells;
    Activity(int n, Numbers numbers) : rows(static_cast<std::size_t>(n * depth)), cells(n) {
        std::mt19937 random(2);
        for (double& v : rows) {
            v = std::uniform_real_distribution(-1.0, 1.0)(random);
            if (numbers != Numbers::ordinary) v = extreme(random, v);
            if (numbers == Numbers::sparse && random() % 4 != 0) v = random() % 2 ? 0.0 : -0.0;
        }
    }
    KernelInput at(std::uint64_t cycle, Workspace* workspace) const {
        static const Gain synapse;
        const Ring ring{rows.data(), depth, cells};
        return {ring.ago(cycle, 0), ring, cycle, synapse, {}, nullptr, workspace};
    }
};

/// The input that cells with these sums receive.
std::vector<double> begin(int targets) {
    std::vector<double> out(static_cast<std::size_t>(targets), -0.0);
    for (std::size_t i = 0; i < out.size(); i += 3) out[i] = 0.1;
    return out;
}

/// Compares the bits; all NaNs are equal.
bool same_numbers(const std::vector<double>& a, const std::vector<double>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double one, double other) {
        return std::isnan(one) ? std::isnan(other)
                               : std::bit_cast<std::uint64_t>(one) == std::bit_cast<std::uint64_t>(other);
    });
}

bool is_infinite(double v) { return std::isinf(v); }
bool is_nan(double v) { return std::isnan(v); }

void compare(const connectivity::Synapses& list, GroupShape source, GroupShape target, std::string_view form,
             Numbers numbers) {
    const auto general = make_kernel(list, source, target, Forms::general),
               fastest = make_kernel(list, source, target, Forms::fastest);
    REQUIRE(general->form() == "list");
    REQUIRE(fastest->form() == form);
    auto* shared = dynamic_cast<const SharedKernel*>(fastest.get());
    if (!shared) return;
    const Activity activity(source.cells, numbers);
    const auto workspace = fastest->make_workspace();
    for (const std::uint64_t cycle : {11, 14}) {
        const auto in = activity.at(cycle, workspace.get());
        auto expected = begin(target.cells), whole = expected;
        general->deliver(in, expected.data(), false);
        CHECK_FALSE(same_numbers(expected, whole));
        if (numbers == Numbers::extreme && form == "sliced" && source.cells > 1000) {
            CHECK(std::any_of(expected.begin(), expected.end(), is_nan));
            CHECK(std::any_of(expected.begin(), expected.end(), is_infinite));
        }
        fastest->deliver(in, whole.data(), false);
        CHECK(same_numbers(whole, expected));
        for (const int parts : {2, 3, 13}) {
            auto divided = begin(target.cells);
            for (int part = parts; part-- > 0;) shared->prepare(in, {part, parts});
            for (int part = parts; part-- > 0;) shared->add(*workspace, divided.data(), {part, parts});
            CHECK(same_numbers(divided, expected));
        }
        auto first = begin(target.cells), alone = first;
        general->deliver(in, first.data(), true);
        fastest->deliver(in, alone.data(), true);
        CHECK(same_numbers(first, alone));
    }
}

GroupShape row_of(int cells) { return {cells, 1, cells}; }

/// Adds a synapse with a finite weight.
void add_synapse(connectivity::Synapses& s, int pre, int post, std::mt19937& random) {
    const double ordinary = 1e-3 * static_cast<double>(random() % 1000), weight = extreme(random, ordinary);
    s.pre.push_back(pre), s.post.push_back(post), s.distance.push_back(0), s.delay.push_back(3);
    s.attenuation.push_back(std::isfinite(weight) ? weight : ordinary);
}

/// From all cells, except for `missing` of 1,000 synapses.
connectivity::Synapses dense_list(GroupShape source, GroupShape target, Order order, unsigned missing) {
    std::mt19937 random(3);
    connectivity::Synapses out;
    for (int t = 0; t < target.cells; ++t)
        for (int i = 0; i < source.cells; ++i) {
            const bool columns = order == Order::columns;
            const int pre = columns ? i % source.height * source.width + i / source.height : i;
            if (random() % 1000 >= missing) add_synapse(out, pre, t, random);
        }
    return out;
}

/// From the cells `across` columns to the left and right, and `down` rows above and below.
connectivity::Synapses window_list(GroupShape g, int across, int down, Order order) {
    std::mt19937 random(4);
    connectivity::Synapses out;
    for (int t = 0; t < g.cells; ++t) {
        std::vector<std::pair<int, int>> from;
        for (int y = t / g.width - down; y <= t / g.width + down; ++y)
            for (int x = t % g.width - across; x <= t % g.width + across; ++x)
                if (x >= 0 && x < g.width && y >= 0 && y < g.height) from.emplace_back(x, y);
        if (order == Order::columns) std::sort(from.begin(), from.end());
        for (const auto& [x, y] : from) add_synapse(out, y * g.width + x, t, random);
    }
    return out;
}

std::string_view form_of(const connectivity::Synapses& list, GroupShape source, GroupShape target) {
    return make_kernel(list, source, target, Forms::fastest)->form();
}

}  // namespace

TEST_CASE("Lists of any shape, order, delays and factors give the numbers of the plain list") {
    const auto order = GENERATE(Order::ascending, Order::shuffled);
    const int delays = GENERATE(1, 3);
    const bool same = GENERATE(false, true);
    const auto numbers = GENERATE(Numbers::ordinary, Numbers::extreme);
    // One block of sources; several, and panels; one panel that is not full; more sources than 16 bits tell
    // apart, with delays.
    const auto shape = GENERATE(Shape{50, 100, 30}, Shape{7000, 700, 60}, Shape{3073, 300, 90},
                                Shape{10'000, 40, 1000}, Shape{40'000, 1500, 120});
    INFO(shape.sources << " sources, " << shape.targets << " targets");
    // Targets that return to a block need all sources in one, of places with 16 bits.
    const bool sliced = order == Order::ascending || shape.sources * delays <= 65535;
    compare(random_list(shape, order, delays, same, numbers), row_of(shape.sources), row_of(shape.targets),
            sliced ? "sliced" : "list", numbers);
}

TEST_CASE("Weights of nearly all cells give the numbers of the plain list, in rows or columns of sources") {
    const auto order = GENERATE(Order::ascending, Order::columns);
    const auto numbers = GENERATE(Numbers::ordinary, Numbers::extreme, Numbers::sparse);
    const unsigned missing = GENERATE(0u, 100u);
    // Not multiples of a vector; more sources than are looked at together; more targets than are summed
    // together.
    const auto [source, target] = GENERATE(table<GroupShape, GroupShape>({{{5, 5, 25}, {9, 1, 9}},
                                                                          {{7, 3, 21}, {11, 13, 143}},
                                                                          {{31, 17, 527}, {8, 7, 56}},
                                                                          {{13, 2, 26}, {5001, 1, 5001}}}));
    INFO(source.cells << " sources, " << target.cells << " targets");
    compare(dense_list(source, target, order, missing), source, target, "by source", numbers);
}

TEST_CASE("Windows of different weights give the numbers of the plain list, in rows or columns of sources") {
    const auto order = GENERATE(Order::ascending, Order::columns);
    const auto numbers = GENERATE(Numbers::ordinary, Numbers::extreme, Numbers::sparse);
    const auto [across, down] = GENERATE(table<int, int>({{5, 5}, {3, 3}, {7, 5}}));
    const auto group =
        GENERATE(GroupShape{30, 33, 990}, GroupShape{270, 19, 5130}, GroupShape{18, 301, 5418});
    INFO(2 * across + 1 << " x " << 2 * down + 1 << " on " << group.width << " x " << group.height);
    compare(window_list(group, across, down, order), group, group, "by source", numbers);
}

TEST_CASE("Weights are laid out by source only where that changes no sum") {
    const GroupShape source{8, 4, 32}, target = row_of(20);
    const auto list = dense_list(source, target, Order::ascending, 0);
    CHECK(form_of(list, source, target) == "by source");
    CHECK(form_of(dense_list(source, target, Order::ascending, 500), source, target) != "by source");
    const auto with = [&](auto change) {
        auto changed = list;
        change(changed);
        return form_of(changed, source, target);
    };
    // 0 times such a weight is no 0, synapses of a source have one place for each target and one delay.
    CHECK(with([](auto& s) { s.attenuation[7] = INFINITY; }) == "sliced");
    CHECK(with([](auto& s) { s.attenuation[7] = NAN; }) == "sliced");
    CHECK(with([](auto& s) { s.pre[8] = s.pre[7]; }) == "sliced");
    CHECK(with([](auto& s) { s.delay[7] = 1; }) == "sliced");
    CHECK(with([](auto& s) { std::swap(s.pre[7], s.pre[8]); }) == "sliced");
    CHECK(with([](auto& s) { s.attenuation.assign(s.size(), 0.3); }) == "broadcast");
}

TEST_CASE("Targets of very different numbers of synapses stay a plain list") {
    connectivity::Synapses s;
    for (int i = 0; i < 3000; ++i) {
        s.pre.push_back(i % 100), s.post.push_back(i < 2990 ? 5 : i % 10), s.delay.push_back(0);
        s.distance.push_back(0), s.attenuation.push_back(0);
    }
    CHECK(form_of(s, row_of(100), row_of(10)) == "list");
}
