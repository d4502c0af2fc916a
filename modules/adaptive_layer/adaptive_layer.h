// The adaptive layer of DAC: learns which stimuli go with which responses, and compresses the stimuli on the
// way.
#pragma once

#include <span>

#include <Eigen/Core>

#include "core/base/archive.h"

namespace forage::adaptive {

using Eigen::Index;
using Values = Eigen::Ref<const Eigen::ArrayXd>;

/// What an update depends on beside its inputs; may change from one update to the next. All dimensionless.
struct Rates {
    double learning = 0.1;  ///< eta, 0..10: share of the change that is made per update; large ones diverge
    double balance = 0;  ///< zeta, -1..1: -1 learns from the stimuli alone, 1 from the given responses alone
    double correction = 0;       ///< rho, 0..100: gain of the error between given and own responses
    double discrepancy = 0.001;  ///< tau, 0..1: weight of the newest sample in the running discrepancy
};

/// Correlative subspace learning between N stimulus cells x (CS) and K response cells r (UR), one step per
/// update:
///
///     y = W' x                        own responses (CR), K
///     e = W y                         prototype: the stimulus that the responses stand for, N
///     W <- W + eta [ (x - e) ((1 - zeta) y + (1 + zeta) r)' + rho e (r - y)' ]
///
/// with y and e from the weights before the step. zeta = -1, rho = 0 is Oja's subspace rule (E. Oja, "Neural
/// networks, principal components, and subspaces", Int. J. Neural Systems 1, 1989) with gain 2 eta. Every
/// weight is a single-precision number; all else is double. Sums run in ascending order of cells, so that the
/// numbers are those of the original to the last bit. Nothing is clipped: with a large eta the weights grow
/// without bound.
class AdaptiveLayer {
  public:
    AdaptiveLayer() = default;
    AdaptiveLayer(Index stimuli, Index responses);

    /// Weights uniform in [-range, range): W(i, k) = (u - 1/2) 2 range, with u = uniform[i K + k] in [0, 1).
    /// Starts anew: the discrepancy is 1.
    void start(std::span<const double> uniform, double range);
    /// Takes `weights`, N x K, rounded to single precision; all else stays.
    void set_weights(const Eigen::Ref<const Eigen::MatrixXd>& weights);

    /// One step. `stimulus` has N values, `response` K, of any sign. Allocates nothing. False when no weight
    /// can have changed: without a stimulus, y = e = 0 and nothing is learned.
    bool update(const Values& stimulus, const Values& response, const Rates& rates);

    const Eigen::ArrayXd& response() const { return y_; }   ///< y of the last step, K
    const Eigen::ArrayXd& prototype() const { return e_; }  ///< e of the last step, N
    /// Running mean of the distance between x and e, each divided by its maximum:
    /// D <- (1 - tau) D + tau sum_i |x_i / max x - e_i / max e| / N. Keeps its value while a maximum is at
    /// most 1e-5. 1 at start; below 1 once it runs, when x and e are not negative.
    double discrepancy() const { return discrepancy_; }
    const Eigen::MatrixXd& weights() const { return w_; }  ///< W, N x K, after the last step

    void checkpoint(Archive& archive) { archive(w_, y_, e_, discrepancy_, finite_); }

  private:
    void respond(const Values& x);
    void learn(const Values& x, const Values& r, const Rates& rates);
    void compare(const Values& x, double rate);

    Eigen::MatrixXd w_;  ///< doubles that hold single-precision numbers
    Eigen::ArrayXd y_, e_;
    Eigen::ArrayXd scratch_, pull_;  ///< N
    double discrepancy_ = 1;
    bool finite_ = true;  ///< all weights are
};

}  // namespace forage::adaptive
