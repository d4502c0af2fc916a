// The adaptive layer of DAC: it learns the association of stimuli with responses, and a compressed
// representation of the stimuli.
#pragma once

#include <span>

#include <Eigen/Core>

#include "core/base/archive.h"

namespace forage::adaptive {

using Eigen::Index;
using Values = Eigen::Ref<const Eigen::ArrayXd>;

/// The parameters of an update, all dimensionless. They may change between updates.
struct Rates {
    double learning = 0.1;  ///< eta, 0..10: learning rate; the weights diverge when it is large
    double balance = 0;     ///< zeta, -1..1: -1 learns only from the stimuli, 1 only from the given responses
    double correction = 0;  ///< rho, 0..100: gain of the error between the given and the own responses
    double discrepancy = 0.001;  ///< tau, 0..1: weight of the newest sample in the running discrepancy
};

/// Correlative subspace learning with N stimulus cells x (conditioned stimulus, CS) and K given responses r
/// (unconditioned response, UR). An update is one step:
///
///     y = W' x                        own responses (conditioned response, CR), K
///     e = W y                         prototype: the stimulus that y stands for, N
///     W <- W + eta [ (x - e) ((1 - zeta) y + (1 + zeta) r)' + rho e (r - y)' ]
///
/// y and e are computed with the weights before the step. zeta = -1, rho = 0 is Oja's subspace rule (E. Oja,
/// "Neural networks, principal components, and subspaces", Int. J. Neural Systems 1, 1989) with gain 2 eta.
/// The weights are rounded to single precision; everything else is double. Sums are added in ascending order
/// of the cells, so that the results have the same bits as the original. Nothing is clipped: with a large eta
/// the weights grow without bound.
class AdaptiveLayer {
  public:
    AdaptiveLayer() = default;
    AdaptiveLayer(Index stimuli, Index responses);

    /// Initialises the weights in [-range, range): W(i, k) = (u - 1/2) 2 range, with u = uniform[i K + k] in
    /// [0, 1). Sets the responses and the prototype to 0 and the discrepancy to 1.
    void start(std::span<const double> uniform, double range);
    /// Sets the weights to `weights` (N x K), rounded to single precision.
    void set_weights(const Eigen::Ref<const Eigen::MatrixXd>& weights);

    /// Computes one step. `stimulus` has N values, `response` has K values, of any sign. Does not allocate
    /// memory. Returns false when no weight has changed: without a stimulus, y = e = 0 and nothing is
    /// learned.
    bool update(const Values& stimulus, const Values& response, const Rates& rates);

    const Eigen::ArrayXd& response() const { return y_; }   ///< y of the last step, K
    const Eigen::ArrayXd& prototype() const { return e_; }  ///< e of the last step, N
    /// Running mean of the distance between x and e, each divided by its maximum:
    /// D <- (1 - tau) D + tau sum_i |x_i / max x - e_i / max e| / N. It starts at 1 and keeps its value while
    /// a maximum is at most 1e-5. It is in 0..1 when x and e are not negative.
    double discrepancy() const { return discrepancy_; }
    const Eigen::MatrixXd& weights() const { return w_; }  ///< W, N x K, after the last step

    void checkpoint(Archive& archive) { archive(w_, y_, e_, discrepancy_, finite_); }

  private:
    void respond(const Values& x);
    void learn(const Values& x, const Values& r, const Rates& rates);
    void compare(const Values& x, double rate);

    Eigen::MatrixXd w_;  ///< single-precision numbers, stored as double
    Eigen::ArrayXd y_, e_;
    Eigen::ArrayXd scratch_, pull_;  ///< N
    double discrepancy_ = 1;
    bool finite_ = true;  ///< whether all weights are finite
};

}  // namespace forage::adaptive
