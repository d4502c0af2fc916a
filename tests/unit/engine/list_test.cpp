// Lists of synapses in slices, panels and blocks give the numbers of the plain list, to the bit.
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "core/engine/kernels/forms.h"
#include "tests/support/catch.h"

using namespace forage;
using namespace forage::engine;

namespace {

struct Gain final : SynapseInstance {
    void* parameters() override { return nullptr; }
    void update(SynapseColumns&) const override {}
    double gain() const override { return 1.3; }
};

enum class Order { ascending, shuffled };
enum class Numbers { ordinary, extreme };

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
            if (numbers == Numbers::extreme) v = extreme(random, v);
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

void compare(const Shape& shape, Order order, int delays, bool same, Numbers numbers) {
    const auto list = random_list(shape, order, delays, same, numbers);
    const auto general = make_kernel(list, shape.sources, shape.targets, Forms::general),
               fastest = make_kernel(list, shape.sources, shape.targets, Forms::fastest);
    REQUIRE(general->form() == "list");
    // Targets that return to a block need all sources in one, of places with 16 bits.
    auto* shared = dynamic_cast<const SharedKernel*>(fastest.get());
    if (order == Order::shuffled && shape.sources * delays > 65535) {
        CHECK(!shared);
        return;
    }
    REQUIRE(fastest->form() == "sliced");
    REQUIRE(shared);
    const Activity activity(shape.sources, numbers);
    const auto workspace = fastest->make_workspace();
    for (const std::uint64_t cycle : {11, 14}) {
        const auto in = activity.at(cycle, workspace.get());
        auto expected = begin(shape.targets), whole = expected;
        general->deliver(in, expected.data(), false);
        CHECK_FALSE(same_numbers(expected, whole));
        if (numbers == Numbers::extreme && shape.sources > 1000) {
            CHECK(std::any_of(expected.begin(), expected.end(), is_nan));
            CHECK(std::any_of(expected.begin(), expected.end(), is_infinite));
        }
        fastest->deliver(in, whole.data(), false);
        CHECK(same_numbers(whole, expected));
        for (const int parts : {2, 3, 13}) {
            auto divided = begin(shape.targets);
            for (int part = parts; part-- > 0;) shared->prepare(in, {part, parts});
            for (int part = parts; part-- > 0;) shared->add(*workspace, divided.data(), {part, parts});
            CHECK(same_numbers(divided, expected));
        }
        auto first = begin(shape.targets), alone = first;
        general->deliver(in, first.data(), true);
        fastest->deliver(in, alone.data(), true);
        CHECK(same_numbers(first, alone));
    }
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
    compare(shape, order, delays, same, numbers);
}

TEST_CASE("Targets of very different numbers of synapses stay a plain list") {
    connectivity::Synapses s;
    for (int i = 0; i < 3000; ++i) {
        s.pre.push_back(i % 100), s.post.push_back(i < 2990 ? 5 : i % 10), s.delay.push_back(0);
        s.distance.push_back(0), s.attenuation.push_back(0);
    }
    CHECK(make_kernel(s, 100, 10, Forms::fastest)->form() == "list");
}
