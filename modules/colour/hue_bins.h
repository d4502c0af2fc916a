// A picture in hue and value, taken apart into one picture per colour.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace forage::colour {

using Eigen::Index;

/// `bins` ranges of hue, 0..1 and round: bin b is centred on b / bins, open below and closed above; hue below
/// 0 or above 1 is in bin 0. The limits are single-precision numbers, as in the original: two neighbours may
/// overlap, or leave a gap, of one such step, so that a hue at a limit can be in both bins or in none.
class HueBins {
  public:
    HueBins() = default;
    explicit HueBins(Index bins);

    Index bins() const { return static_cast<Index>(above_.size()); }
    bool contains(Index bin, double hue) const;

    /// planes[b P + i] = value[i] if hue[i] is in bin b, else 0; for P pixels i, `planes` being bins() P
    /// long.
    void separate(const Eigen::Ref<const Eigen::ArrayXd>& hue, const Eigen::Ref<const Eigen::ArrayXd>& value,
                  Eigen::Ref<Eigen::ArrayXd> planes) const;

  private:
    std::vector<double> above_,
        up_to_;  ///< limits of each bin; of bin 0: in it are those above_ or not above up_to_
};

}  // namespace forage::colour
