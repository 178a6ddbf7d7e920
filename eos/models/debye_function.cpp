// SPDX-License-Identifier: BSD-3-Clause
#include "eos/models/debye_function.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "eos/hermite_table.hpp"

namespace whipple::eos {
namespace {

constexpr double table_end = 40.0;
constexpr int intervals = 1600;

double integrand(double t) { return t == 0 ? 0.0 : t * t * t / std::expm1(t); }

/// Returns D, D', D'' from the Bernoulli series D = 1 - 3y/8 + 3 sum B_2k y^2k/((2k+3) (2k)!), for y < 0.5.
HermiteTable::Node series(double y) {
  // B_2k/(2k)!
  constexpr double coefficients[] = {1.0 / 12,         -1.0 / 720,     1.0 / 30240,
                                     -1.0 / 1209600,   1.0 / 47900160, -691.0 / 1307674368000,
                                     1.0 / 74724249600};
  HermiteTable::Node node{1 - 0.375 * y, -0.375, 0};
  double power = 1;  // y^(2k-2)
  int k = 1;
  for (const double c : coefficients) {
    const double factor = 3 * c / (2 * k + 3) * power;
    node.value += factor * y * y;
    node.slope += factor * 2 * k * y;
    node.curvature += factor * 2 * k * (2 * k - 1);
    power *= y * y;
    ++k;
  }
  return node;
}

HermiteTable tabulate() {
  const double step = table_end / intervals;
  std::vector<HermiteTable::Node> nodes;
  double integral = 0;
  for (int i = 0; i <= intervals; ++i) {
    const double y = i * step;
    if (i > 0) integral += boost::math::quadrature::gauss<double, 15>::integrate(integrand, y - step, y);
    if (y < 0.5) {
      nodes.push_back(series(y));
      continue;
    }
    // y D' = 3 b - 3 D with b = y/(e^y - 1), differentiated once more with respect to y.
    const double value = 3 * integral / (y * y * y), exponential = std::expm1(y), b = y / exponential;
    const double b_slope = (1 - b * (exponential + 1)) / exponential;
    const double slope = 3 * (b - value) / y;
    nodes.push_back({value, slope, (3 * b_slope - 4 * slope) / y});
  }
  return {0.0, step, std::move(nodes)};
}

}  // namespace

double debye_function(double y) {
  static const HermiteTable table = tabulate();
  if (y < table_end) return table(y);
  constexpr double pi = std::numbers::pi;
  return pi * pi * pi * pi / (5 * y * y * y);
}

}  // namespace whipple::eos
