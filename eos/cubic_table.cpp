// SPDX-License-Identifier: BSD-3-Clause
#include "eos/cubic_table.hpp"

namespace whipple::eos {

CubicTable::CubicTable(const std::function<double(double)>& function, double end, double scale,
                       double tolerance, int most_intervals) {
  for (int n = 64;; n *= 2) {
    const double step = end / n;
    inverse_step_ = 1 / step;
    last_interval_ = n - 1;
    pieces_.assign(static_cast<std::size_t>(n), {});
    double worst = 0;
    for (int i = 0; i < n; ++i) {
      // Interpolate at t = 0, 1/4, 3/4, 1 by divided differences.
      const auto at = [&](double t) { return function((i + t) * step); };
      const double f0 = at(0), f1 = at(0.25), f2 = at(0.75), f3 = at(1);
      const double d01 = (f1 - f0) / 0.25, d12 = (f2 - f1) / 0.5, d23 = (f3 - f2) / 0.25;
      const double d012 = (d12 - d01) / 0.75, d123 = (d23 - d12) / 0.75, d0123 = d123 - d012;
      // f0 + t (d01 + (t - 1/4) (d012 + (t - 3/4) d0123))
      pieces_[static_cast<std::size_t>(i)] = {{f0, d01 - 0.25 * (d012 - 0.75 * d0123), d012 - d0123, d0123}};
      const double between = at(0.5);
      worst = std::max(
          worst, std::abs((*this)(broadcast((i + 0.5) * step))[0] - between) / (std::abs(between) + scale));
    }
    if (worst < tolerance || 2 * n > most_intervals) return;
  }
}

}  // namespace whipple::eos
