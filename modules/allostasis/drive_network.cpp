#include "modules/allostasis/drive_network.h"

#include <cmath>

namespace forage::allostasis {

double sigmoid(double x, const NetworkSettings& s) {
    return s.maximum / (1 + std::exp(-s.slope * (x - s.threshold)));
}

void step(Eigen::ArrayXd& rates, const Eigen::ArrayXd& input, const Eigen::ArrayXd& z,
          const NetworkSettings& s) {
    const double total = rates.sum();
    const double pool = sigmoid(total, s);
    for (Eigen::Index i = 0; i < rates.size(); ++i) {
        const double u = rates[i];
        const double x = s.self_excitation * u - s.mutual_share * s.mutual * (total - u) -
                         (1 - s.mutual_share) * s.shared * pool + input[i];
        rates[i] = std::max(0.0, u + s.dt / s.tau * (-u + sigmoid(x, s) + s.noise * z[i]));
    }
}

}  // namespace forage::allostasis
