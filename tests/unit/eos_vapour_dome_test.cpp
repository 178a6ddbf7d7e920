// SPDX-License-Identifier: BSD-3-Clause
// Maxwell's construction on the fluid of van der Waals, in units of its critical point.
#include <gtest/gtest.h>

#include <cmath>

#include "eos/vapour_dome.hpp"

namespace whipple::eos {
namespace {

constexpr double R = 8.0 / 3.0, a = 3.0, b = 1.0 / 3.0;

/// Returns the fluid, with a bend of the isotherms: a free energy h(V) = height 256 (x (1 - x))^4, x from 0 to 1 between two
/// volumes.
VapourDome::Search bent(double height, double from, double to) {
  const auto bend = [=](double V) {  // h, h', h''
    const double w = to - from, x = (V - from) / w, y = x * (1.0 - x), d = 1.0 - 2.0 * x, c = 256.0 * height;
    struct Bend {
      double h = 0.0, first = 0.0, second = 0.0;
    };
    if (!(x > 0.0 && x < 1.0)) return Bend{};
    return Bend{c * std::pow(y, 4), c * 4.0 * std::pow(y, 3) * d / w,
                c * (12.0 * y * y * d * d - 8.0 * std::pow(y, 3)) / (w * w)};
  };
  VapourDome::Search search;
  search.fluid = [bend](double V, double T) {
    const auto of = bend(V);
    return FluidPoint{R * T / (V - b) - a / (V * V) - of.first, 1.5 * R * T - a / V + of.h,
                      R * std::log(V - b) + 1.5 * R * std::log(T)};
  };
  search.isotherm = [bend](double V, double T) {
    const auto of = bend(V);
    return IsothermPoint{R * T / (V - b) - a / (V * V) - of.first,
                         -R * T / ((V - b) * (V - b)) + 2.0 * a / (V * V * V) - of.second};
  };
  search.dense_volume = 0.34;
  search.loop_volume = 0.5;
  search.dilute_volume = 1e3;
  search.gas_constant = R;
  search.temperature_guess = 1.0;
  return search;
}

TEST(VapourDome, OfVanDerWaalsIsThePublishedOne) {
  // Lekner, Am. J. Phys. 50 (1982) 161: parametric solution; at y = 1 with f(y) = (y coth y - 1) / (sinh y cosh y - y).
  const double y = 1.0, sh = std::sinh(y), ch = std::cosh(y), f = (y * ch - sh) / (sh * ch - y),
               g = 1.0 + 2.0 * f * ch + f * f, T = 27.0 * f * (f + ch) / (4.0 * g * g);
  const double p = 27.0 * f * f * (1.0 - f * f) / (g * g);
  const Saturation found = saturation(bent(0.0, 0.7, 1.1), T, 1.0);
  EXPECT_NEAR(found.pressure, p, 1e-9);
}

TEST(VapourDome, ABendWithinItChangesNothing) {
  const double T = 0.7, from = 0.7, to = 1.1;
  const Saturation plain = saturation(bent(0.0, from, to), T, 1.0);
  ASSERT_LT(plain.liquid_volume, from);
  ASSERT_GT(plain.vapour_volume, to);
  // The first maximum of the bent isotherm with a positive pressure lies below the pressure of saturation.
  const VapourDome::Search search = bent(0.03, from, to);
  const double highest = search.isotherm(0.992, T).pressure;
  ASSERT_GT(highest, 0.0);
  ASSERT_LT(highest, plain.pressure);
  const Saturation found = saturation(search, T, 0.9);
  EXPECT_NEAR(found.pressure, plain.pressure, 1e-9);
  EXPECT_NEAR(found.liquid_volume, plain.liquid_volume, 1e-9);
  EXPECT_NEAR(found.vapour_volume, plain.vapour_volume, 1e-7);
}

}  // namespace
}  // namespace whipple::eos
