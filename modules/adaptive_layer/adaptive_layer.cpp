#include "modules/adaptive_layer/adaptive_layer.h"

namespace forage::adaptive {
namespace {

double single(double value) { return static_cast<double>(static_cast<float>(value)); }

}  // namespace

AdaptiveLayer::AdaptiveLayer(Index stimuli, Index responses)
    : w_(Eigen::MatrixXd::Zero(stimuli, responses)),
      y_(Eigen::ArrayXd::Zero(responses)),
      e_(Eigen::ArrayXd::Zero(stimuli)),
      scratch_(stimuli),
      pull_(stimuli) {}

void AdaptiveLayer::start(std::span<const double> uniform, double range) {
    std::size_t next = 0;
    for (Index i = 0; i < w_.rows(); ++i)
        for (Index k = 0; k < w_.cols(); ++k) w_(i, k) = single((uniform[next++] - 0.5) * 2 * range);
    y_.setZero();
    e_.setZero();
    discrepancy_ = 1;
    finite_ = w_.allFinite();
}

void AdaptiveLayer::set_weights(const Eigen::Ref<const Eigen::MatrixXd>& weights) {
    w_ = weights.unaryExpr(&single);
    finite_ = w_.allFinite();
}

bool AdaptiveLayer::update(const Values& stimulus, const Values& response, const Rates& rates) {
    // Without a stimulus every term is 0, unless an infinite number makes it NaN.
    if (finite_ && (stimulus == 0).all() && response.allFinite()) {
        y_.setZero();
        e_.setZero();
        return false;
    }
    respond(stimulus);
    learn(stimulus, response, rates);
    compare(stimulus, rates.discrepancy);
    return true;
}

void AdaptiveLayer::respond(const Values& x) {
    const Index cells = w_.rows();
    for (Index k = 0; k < w_.cols(); ++k) {
        const double* column = w_.col(k).data();
        double sum = 0;  // Eigen's matrix product would add in another order
        for (Index i = 0; i < cells; ++i) sum += column[i] * x[i];
        y_[k] = sum;
    }
    e_.setZero();
    for (Index k = 0; k < w_.cols(); ++k) e_ += w_.col(k).array() * y_[k];
}

void AdaptiveLayer::learn(const Values& x, const Values& r, const Rates& rates) {
    scratch_ = x - e_;
    pull_ = rates.correction * e_;
    double spread = 0;
    for (Index k = 0; k < w_.cols(); ++k) {
        const double drive = (1 - rates.balance) * y_[k] + (1 + rates.balance) * r[k];
        const double error = r[k] - y_[k];
        auto column = w_.col(k).array();
        column = (column + rates.learning * (scratch_ * drive + pull_ * error)).cast<float>().cast<double>();
        spread += (column - column).sum();  // 0, or NaN once a weight is not finite
    }
    finite_ = spread == 0;
}

void AdaptiveLayer::compare(const Values& x, double rate) {
    const double largest_x = single(x.maxCoeff()), largest_e = single(e_.maxCoeff());
    if (!(largest_x > 1e-5 && largest_e > 1e-5)) return;
    scratch_ = (x / largest_x - e_ / largest_e).abs();
    double sum = 0;
    for (Index i = 0; i < scratch_.size(); ++i) sum += scratch_[i];
    const double distance = sum / static_cast<double>(scratch_.size());
    discrepancy_ = (1 - rate) * discrepancy_ + rate * distance;
}

}  // namespace forage::adaptive
