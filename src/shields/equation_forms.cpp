// SPDX-License-Identifier: BSD-3-Clause
#include "src/shields/equation_forms.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/core/base/units.hpp"

namespace whipple::shields::forms {
namespace {

/// Returns the cosine of the angle; more oblique impacts count as 65 degrees (NASA/TM-2009-214785).
double capped_cosine(const Input& in) {
  return std::cos(std::min(in.angle, 65.0) * std::numbers::pi / 180.0);
}

double cosine(const Input& in) { return std::cos(in.angle * std::numbers::pi / 180.0); }

/// Returns low(V) up to a speed, high(V) from another one on, and between them the straight line.
template <class Low, class High>
double joined(const Input& in, double v_low, double v_high, const Low& low, const High& high) {
  if (in.v <= v_low) return low(in);
  if (in.v >= v_high) return high(in);
  const double lower = low(in.at(v_low)), upper = high(in.at(v_high));
  return lower + (upper - lower) / (v_high - v_low) * (in.v - v_low);
}

/// Returns x > 0 where a function that rises through zero once does so, by bisection.
template <class Function>
double root(const Function& rises, double lower, double upper) {
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (lower + upper);
    (rises(middle) < 0.0 ? lower : upper) = middle;
  }
  return 0.5 * (lower + upper);
}

double nno_low(const Input& in) {
  const double resistance = in.t_w * std::sqrt(in.sigma / 40.0) + in.t_b;
  return std::pow(resistance / (0.6 * std::pow(capped_cosine(in), 5.0 / 3.0) * std::sqrt(in.rho_p) *
                                std::pow(in.v, 2.0 / 3.0)),
                  18.0 / 19.0);
}

double nno_high(const Input& in) {
  return 3.918 * std::pow(in.t_w, 2.0 / 3.0) * std::cbrt(in.spacing) * std::cbrt(in.sigma / 70.0) /
         (std::cbrt(in.rho_p) * std::pow(in.rho_b, 1.0 / 9.0) *
          std::pow(in.v * capped_cosine(in), 2.0 / 3.0));
}

/// Returns the factor of the wall's thickness that a thin bumper costs.
double thin_bumper(const Input& in, double d) {
  const double proper = in.spacing / d >= 30.0 ? 0.20 : 0.25;
  const double y = in.t_b / d / proper;
  if (y >= 1.0) return 1.0;
  const double c = capped_cosine(in), v = 7.0 / c;
  const double without = 0.6 * std::pow(d, 19.0 / 18.0) * std::pow(c, 5.0 / 3.0) * std::sqrt(in.rho_p) *
                         std::pow(v, 2.0 / 3.0) / std::sqrt(in.sigma / 40.0);
  const double mass = std::numbers::pi / 6.0 * d * d * d * in.rho_p;
  const double with = 0.16 * std::sqrt(d) * std::pow(in.rho_p * in.rho_b, 1.0 / 6.0) * std::cbrt(mass) * 7.0 /
                      std::sqrt(in.spacing) * std::sqrt(70.0 / in.sigma);
  const double r = without / with;
  return r - 2.0 * y * (r - 1.0) + y * y * (r - 1.0);
}

double jsc_high(const Input& in) {
  const double proper = nno_high(in);
  const auto excess = [&](double d) { return d - std::pow(thin_bumper(in, d), -2.0 / 3.0) * proper; };
  return root(excess, 1e-6 * proper, 100.0 * proper);
}

/// Returns the speed below which the sphere is not shattered, km/s along the normal. For very thin bumpers the formula
/// passes the 7 km/s above which the high branch holds (bumper over sphere below about 0.009): it ends there.
double jsc_border(const Input& in) {
  constexpr double thick = 2.60, thin_ratio = 0.16, hypervelocity = 7.0;
  const auto ratio = [&](double v_n) { return in.t_b / nno_low(in.at(v_n)); };
  if (ratio(thick) >= thin_ratio) return thick;
  const auto excess = [&](double v_n) { return v_n - 1.436 / std::cbrt(ratio(v_n)); };
  return excess(hypervelocity) < 0.0 ? hypervelocity : root(excess, thick, hypervelocity);
}

}  // namespace

Input input_of(const Impact& impact) {
  const auto cm = [](double length) { return 100.0 * length; };
  const auto g_cm3 = [](double density) { return 1e-3 * density; };
  const Shield& shield = impact.shield;
  Input in{.v = 1e-3 * impact.projectile.velocity,
           .angle = impact.projectile.angle * 180.0 / std::numbers::pi,
           .rho_p = g_cm3(impact.projectile.density),
           .t_w = cm(shield.wall.thickness),
           .rho_w = g_cm3(shield.wall.density),
           .sigma = units::convert(shield.wall.yield, "Pa", "ksi"),
           .hardness = shield.wall.hardness,
           .ad_stuffing = 0.1 * shield.stuffing.areal_density,
           .rho_foam = g_cm3(shield.foam.density)};
  if (!shield.bumpers.empty()) {
    in.t_b = cm(shield.bumpers[0].sheet.thickness);
    in.rho_b = g_cm3(shield.bumpers[0].sheet.density);
    in.spacing = cm(shield.bumpers[0].spacing);
  }
  if (shield.bumpers.size() > 1) {
    in.t_b2 = cm(shield.bumpers[1].sheet.thickness);
    in.rho_b2 = g_cm3(shield.bumpers[1].sheet.density);
    in.spacing_2 = cm(shield.bumpers[1].spacing);
  }
  return in;
}

double single_wall(const Input& in, double k) {
  constexpr double sound_speed = 5.1;
  const double ratio = in.rho_p / in.rho_w;
  const double crater = 5.24 * std::pow(in.hardness, -0.25) * std::pow(ratio, ratio < 1.5 ? 0.5 : 2.0 / 3.0) *
                        std::pow(in.v * cosine(in) / sound_speed, 2.0 / 3.0);
  return std::pow(in.t_w / (k * crater), 18.0 / 19.0);
}

double nno_1993(const Input& in) {
  const double c = capped_cosine(in);
  return joined(in, 3.0 / c, 7.0 / c, nno_low, nno_high);
}

double nno_2001(const Input& in) {
  const double c = capped_cosine(in);
  const auto low = [c](const Input& at) {
    return 1.9 * (at.t_w * std::sqrt(at.sigma / 40.0) + 0.37 * at.t_b * at.rho_b) /
           (std::pow(c, 11.0 / 6.0) * std::sqrt(at.rho_p) * std::pow(at.v, 2.0 / 3.0));
  };
  const auto high = [c](const Input& at) {
    const double x = at.t_b / (std::pow(at.t_w, 2.0 / 3.0) * std::cbrt(at.spacing));
    const double k = x < 0.126 ? 1.35 : 7.451 * x + 0.411;
    return k * std::pow(at.t_w * at.rho_w, 2.0 / 3.0) * std::sqrt(at.spacing) * std::cbrt(at.sigma / 70.0) /
           (std::cbrt(at.rho_p) * std::pow(at.rho_b, 1.0 / 9.0) * std::pow(at.v * c, 2.0 / 3.0));
  };
  return joined(in, 3.0 / std::pow(c, 1.5), 7.0 / c, low, high);
}

double jsc_2011(const Input& in) {
  const double c = capped_cosine(in);
  return joined(in, jsc_border(in) / c, 7.0 / c, nno_low, jsc_high);
}

double srl_2008(const Input& in) {
  const double c = capped_cosine(in);
  const bool steep = in.angle <= 45.0 || in.angle >= 65.0;
  const double delta = steep ? 4.0 / 3.0 : 5.0 / 4.0, epsilon = steep ? 8.0 / 3.0 : 5.0 / 2.0;
  const auto low = [=](const Input& at) {
    const double resistance = (std::sqrt(at.t_w) + at.t_b2) / 1.4 * std::sqrt(at.sigma / 40.0) + at.t_b;
    return std::pow(resistance / (0.6 * std::pow(c, delta) * std::sqrt(at.rho_p) * std::pow(at.v, 2.0 / 3.0)),
                    18.0 / 19.0);
  };
  const auto high = [=](const Input& at) {
    const double spread = std::cbrt(at.spacing) * std::pow(at.t_b2 + 1.5 * at.t_w, 2.0 / 3.0) +
                          0.1 * std::pow(at.spacing_2, 2.0 / 3.0) * std::cbrt(at.t_w) * std::pow(c, -epsilon);
    return 1.155 * spread * std::cbrt(at.sigma / 70.0) /
           (std::pow(0.4, 2.0 / 3.0) * std::cbrt(at.rho_p) * std::pow(at.rho_b2, 1.0 / 9.0) *
            std::pow(at.v, 2.0 / 3.0) * std::pow(c, delta));
  };
  return joined(in, 3.0 / c, 7.0 / c, low, high);
}

double stuffed_2001(const Input& in) {
  const double c = cosine(in);
  const double front = in.t_b * in.rho_b + in.ad_stuffing, all = front + in.t_w * in.rho_w;
  const double share = in.ad_stuffing / all;
  const double k = share >= 0.10 && share <= 0.15 ? 0.45 : 0.6;
  const auto low = [=](const Input& at) {
    return 2.35 * (at.t_w * std::sqrt(at.sigma / 40.0) + 0.37 * front) /
           (std::pow(c, 4.0 / 3.0) * std::sqrt(at.rho_p) * std::pow(at.v, 2.0 / 3.0));
  };
  const auto high = [=](const Input& at) {
    return k * std::cbrt(at.t_w * at.rho_w) * std::pow(at.spacing, 2.0 / 3.0) *
           std::pow(at.sigma / 40.0, 1.0 / 6.0) / (std::cbrt(at.rho_p * at.v) * std::sqrt(c));
  };
  return joined(in, 2.6 / std::sqrt(c), 6.5 / std::pow(c, 0.75), low, high);
}

double foam_2009(const Input& in) {
  const double c = cosine(in), oblique = std::pow(c, 0.8);
  const auto low = [=](const Input& at) {
    const double resistance =
        at.t_b + at.t_w * std::sqrt(at.sigma / 40.0) + std::pow(at.spacing, 1.1) * at.rho_foam / at.rho_w;
    return 1.83 * resistance /
           std::pow(std::sqrt(at.rho_p) * std::pow(at.v, 2.0 / 3.0) * oblique, 18.0 / 19.0);
  };
  const auto high = [=](const Input& at) {
    const double wall = at.t_w + 0.5 * at.rho_foam * at.spacing / at.rho_w;
    return 2.152 * std::pow(wall, 2.0 / 3.0) * 0.89 * std::pow(at.spacing, 0.45) *
           std::cbrt(at.sigma / 70.0) /
           (std::cbrt(at.rho_p) * std::pow(at.rho_b, 1.0 / 9.0) * std::pow(at.v, 0.4) * oblique);
  };
  return joined(in, 2.25 / std::cbrt(c), 4.0 / std::cbrt(c), low, high);
}

}  // namespace whipple::shields::forms
