#include "modules/adaptive_layer/adaptive_layer.h"

#include <limits>

#include "core/base/random.h"
#include "tests/support/catch.h"

using namespace forage;
using namespace forage::adaptive;
using Eigen::ArrayXd;
using Eigen::MatrixXd;

namespace {

constexpr Index stimuli = 6, responses = 3;

/// A layer with initial weights below `range`.
AdaptiveLayer layer(double range = 0.1, std::uint64_t seed = 1) {
    std::vector<double> uniform(stimuli * responses);
    RandomStream(seed, "layer").uniform(0, uniform);
    AdaptiveLayer out(stimuli, responses);
    out.start(uniform, range);
    return out;
}

ArrayXd cells(Index size, std::initializer_list<Index> active) {
    ArrayXd out = ArrayXd::Zero(size);
    for (const Index i : active) out[i] = 1;
    return out;
}

const ArrayXd no_response = ArrayXd::Zero(responses);

bool is_single(const MatrixXd& w) { return w == w.cast<float>().cast<double>(); }

}  // namespace

TEST_CASE(
    "Initial weights are single-precision numbers within the range, in order of stimulus, then response") {
    std::vector<double> uniform(stimuli * responses, 0.5);
    uniform[1 * responses + 2] = 0.75;
    AdaptiveLayer l(stimuli, responses);
    l.start(uniform, 0.1);
    CHECK(l.weights()(1, 2) == static_cast<double>(0.05F));
    CHECK(l.weights().cwiseAbs().sum() == l.weights()(1, 2));
    CHECK(layer().weights().cwiseAbs().maxCoeff() <= 0.1);
    CHECK(is_single(layer().weights()));
    CHECK(layer(0.1, 1).weights() != layer(0.1, 2).weights());
}

TEST_CASE(
    "The response is the stimulus times the weights, and the prototype is the response times the weights") {
    auto l = layer();
    const MatrixXd w = l.weights();
    const ArrayXd x = ArrayXd::LinSpaced(stimuli, -1, 2);
    l.update(x, no_response, {});
    CHECK(l.response().matrix().isApprox(w.transpose() * x.matrix()));
    CHECK(l.prototype().matrix().isApprox(w * (w.transpose() * x.matrix())));
}

TEST_CASE("A step changes the weights by the learning rule") {
    const Rates rates{0.05, 0.3, 2.5, 0.1};
    auto l = layer(0.5);
    const MatrixXd w = l.weights();
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(stimuli, -1, 2),
                          r = Eigen::VectorXd::LinSpaced(responses, 0, 1);
    l.update(x.array(), r.array(), rates);
    const Eigen::VectorXd y = w.transpose() * x, e = w * y;
    const MatrixXd expected =
        w + 0.05 * ((x - e) * (0.7 * y + 1.3 * r).transpose() + 2.5 * e * (r - y).transpose());
    CHECK((l.weights() - expected).cwiseAbs().maxCoeff() < 1e-7);
    CHECK(is_single(l.weights()));
}

TEST_CASE("Without a stimulus there is no response, no learning and no change of the discrepancy") {
    auto l = layer();
    l.update(cells(stimuli, {1}), cells(responses, {0}), {0.1, 0, 0, 0.5});
    const MatrixXd w = l.weights();
    const double discrepancy = l.discrepancy();
    CHECK_FALSE(l.update(ArrayXd::Zero(stimuli), cells(responses, {2}), {1, 0.5, 10, 0.5}));
    CHECK((l.response() == 0).all());
    CHECK((l.prototype() == 0).all());
    CHECK(l.weights() == w);
    CHECK(l.discrepancy() == discrepancy);
}

TEST_CASE("With a learning rate of 0, the layer responds and updates the discrepancy, but does not learn") {
    auto l = layer();
    const MatrixXd w = l.weights();
    CHECK(l.update(cells(stimuli, {0, 3}), cells(responses, {1}), {0, 0.97, 6, 0.5}));
    CHECK(l.weights() == w);
    CHECK(l.response().abs().maxCoeff() > 0);
}

TEST_CASE("With perceptual learning, a stimulus that is repeated becomes its own prototype") {
    auto l = layer();
    const ArrayXd x = cells(stimuli, {0, 2});
    for (int i = 0; i < 2000; ++i) l.update(x, no_response, {0.02, -1, 0, 0.01});
    CHECK((l.prototype() - x).abs().maxCoeff() < 1e-3);
    CHECK(l.discrepancy() < 0.01);
}

TEST_CASE("With behavioural learning, stimuli evoke the responses that occurred with them") {
    auto l = layer(0.01);
    for (int i = 0; i < 4000; ++i) {
        const Index which = i % 2;
        l.update(cells(stimuli, {which}), cells(responses, {2 - which}), {0.005, 0.97, 6, 0.01});
    }
    l.update(cells(stimuli, {0}), no_response, {0, 0, 0, 0});
    CHECK(l.response()[2] > 0.5);
    CHECK(std::abs(l.response()[0]) < 0.1);
    l.update(cells(stimuli, {1}), no_response, {0, 0, 0, 0});
    CHECK(l.response()[1] > 0.5);
}

TEST_CASE(
    "The discrepancy starts at 1, changes by its rate, and does not depend on the strength of the stimulus") {
    auto slow = layer(), fast = layer(), frozen = layer(), strong = layer();
    CHECK(slow.discrepancy() == 1);
    const ArrayXd x = cells(stimuli, {1, 4});
    MatrixXd w = MatrixXd::Constant(stimuli, responses, 0.1);
    w(0, 0) = 0.3;
    for (auto* l : {&slow, &fast, &frozen, &strong}) l->set_weights(w);
    slow.update(x, no_response, {0, 0, 0, 0.25});
    fast.update(x, no_response, {0, 0, 0, 1});
    frozen.update(x, no_response, {0, 0, 0, 0});
    strong.update(8 * x, no_response, {0, 0, 0, 1});
    CHECK(fast.discrepancy() > 0);
    CHECK(fast.discrepancy() < 1);
    CHECK(slow.discrepancy() == Approx(0.75 + 0.25 * fast.discrepancy()));
    CHECK(frozen.discrepancy() == 1);
    CHECK(strong.discrepancy() == Approx(fast.discrepancy()));
}

TEST_CASE("The discrepancy is constant while the stimulus or the prototype is at most 1e-5") {
    auto l = layer();
    l.set_weights(MatrixXd::Constant(stimuli, responses, 1));
    l.update(cells(stimuli, {1}) * 1e-5, no_response, {0, 0, 0, 1});
    CHECK(l.discrepancy() == 1);
    l.update(cells(stimuli, {1}) * -3, no_response, {0, 0, 0, 1});
    CHECK(l.discrepancy() == 1);
    l.update(cells(stimuli, {1}) * 1.1e-5, no_response, {0, 0, 0, 1});
    CHECK(l.discrepancy() < 1);
}

TEST_CASE("set_weights() rounds to single precision and changes nothing else") {
    auto l = layer();
    l.set_weights(MatrixXd::Constant(stimuli, responses, 0.1));
    CHECK(l.weights()(3, 1) == static_cast<double>(0.1F));
    CHECK(l.discrepancy() == 1);
}

TEST_CASE("Infinite weights propagate, also without a stimulus, as in the original") {
    auto l = layer();
    MatrixXd w = MatrixXd::Zero(stimuli, responses);
    w(2, 1) = std::numeric_limits<double>::infinity();
    l.set_weights(w);
    l.update(ArrayXd::Zero(stimuli), no_response, {0.1, 0, 0, 0.1});
    CHECK(std::isnan(l.response()[1]));
}

TEST_CASE("Learning with too large a rate diverges without an error") {
    auto l = layer();
    for (int i = 0; i < 200; ++i)
        l.update(ArrayXd::Constant(stimuli, 2), cells(responses, {0}), {10, 0, 50, 0.1});
    CHECK_FALSE(l.weights().allFinite());
}

TEST_CASE("A layer with one stimulus cell and one response cell learns") {
    AdaptiveLayer l(1, 1);
    l.start(std::vector{0.9}, 0.1);
    for (int i = 0; i < 500; ++i) l.update(ArrayXd::Ones(1), ArrayXd::Ones(1), {0.05, 0, 0, 1});
    CHECK(l.response()[0] == Approx(1).margin(0.01));
    CHECK(l.discrepancy() == Approx(0).margin(1e-6));
}
