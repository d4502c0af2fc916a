// The separation of a picture (hue and value) into one picture per colour.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace forage::colour {

using Eigen::Index;

/// Divides the circle of hues, 0..1, into bins. Bin b has its centre at b / bins; its lower limit is
/// excluded, its upper limit included. Hues below 0 or above 1 are in bin 0. The limits are single-precision
/// numbers, as in the original. Therefore neighbours may overlap, or leave a gap, by a rounding error, and a
/// hue at a limit can be in both bins or in none.
class HueBins {
  public:
    HueBins() = default;
    explicit HueBins(Index bins);

    Index bins() const { return static_cast<Index>(above_.size()); }
    bool contains(Index bin, double hue) const;

    /// planes[b P + i] = value[i] when hue[i] is in bin b, else 0, for each of the P pixels i. The size of
    /// `planes` is bins() P.
    void separate(const Eigen::Ref<const Eigen::ArrayXd>& hue, const Eigen::Ref<const Eigen::ArrayXd>& value,
                  Eigen::Ref<Eigen::ArrayXd> planes) const;

  private:
    /// The limits of each bin. Bin 0 contains the hues above above_[0] and those up to up_to_[0].
    std::vector<double> above_, up_to_;
};

}  // namespace forage::colour
