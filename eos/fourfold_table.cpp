// SPDX-License-Identifier: BSD-3-Clause
#include "eos/fourfold_table.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace whipple::eos {

FourfoldTable::FourfoldTable(const Functions& below, const Functions& above, double begin, double kink,
                             double end, const Values& scale, double tolerance, int most_cells) {
  // Use long double: the powers of t lose digits compared with the polynomial.
  std::array<long double, terms> nodes{};
  for (std::size_t i = 0; i < terms; ++i)
    nodes[i] = -0.5L * std::cos(std::numbers::pi_v<long double> * static_cast<long double>(i) / (terms - 1));
  for (int lower = 8;; lower *= 2) {
    // Slightly wider than necessary, with one cell more at the end, so that `begin` and `end` are not on an edge.
    const double width = (kink - begin) / lower * (1 + 1e-9);
    const int n = lower + static_cast<int>((end - kink) / width) + 1;
    cells_.assign(static_cast<std::size_t>(n), {});
    per_width_ = 1 / width;
    first_ = kink - (lower - 0.5) * width;
    double worst = 0;
    for (int cell = 0; cell < n; ++cell) {
      Cell& result = cells_[static_cast<std::size_t>(cell)];
      const auto functions = [&](double t) {
        const double x = kink + (cell - lower + 0.5 + t) * width;
        return cell < lower ? below(x) : above(x);
      };
      std::array<Values, terms> samples;
      for (std::size_t i = 0; i < terms; ++i) samples[i] = functions(static_cast<double>(nodes[i]));
      for (std::size_t k = 0; k < 4; ++k) {
        // Newton's divided differences, then the powers of t.
        std::array<long double, terms> c{};
        for (std::size_t i = 0; i < terms; ++i) c[i] = samples[i][k];
        for (std::size_t order = 1; order < terms; ++order) {
          for (std::size_t i = terms; i-- > order;) c[i] = (c[i] - c[i - 1]) / (nodes[i] - nodes[i - order]);
        }
        for (std::size_t j = terms - 1; j-- > 0;) {
          for (std::size_t i = j; i < terms - 1; ++i) c[i] -= nodes[j] * c[i + 1];
        }
        for (std::size_t i = 0; i < terms; ++i) result[i][k] = static_cast<double>(c[i]);
      }
      for (const double between : {-0.39, 0.0, 0.39}) {
        const Values exact = functions(between);
        const Lanes found = at(result, broadcast(between));
        for (std::size_t k = 0; k < 4; ++k)
          worst = std::max(worst, std::abs(found[k] - exact[k]) / (std::abs(exact[k]) + scale[k]));
      }
    }
    if (worst < tolerance || 2 * n > most_cells) return;
  }
}

}  // namespace whipple::eos
