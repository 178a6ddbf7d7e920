// SPDX-License-Identifier: BSD-3-Clause
#include "src/material/strength/johnson_cook.hpp"

#include <array>
#include <cmath>
#include <cstdint>

#include "src/core/base/simd.hpp"
#include "src/core/base/vector_math.hpp"
#include "src/material/strength/johnson_cook_formulas.hpp"

namespace whipple::strength {
namespace {

using formulas::least_strain;

/// Computes (1 + t)^n for 0 <= t <= 0.01 by its series; the neglected terms are below 1e-16.
class Binomial {
 public:
  explicit Binomial(double n) {
    c_[0] = 1.0;
    for (std::size_t k = 1; k < c_.size(); ++k) {
      c_[k] = c_[k - 1] * (n - static_cast<double>(k - 1)) / static_cast<double>(k);
    }
  }
  [[nodiscard]] double operator()(double t) const {
    const double t2 = t * t;
    return (c_[0] + c_[1] * t) +
           t2 * ((c_[2] + c_[3] * t) + t2 * ((c_[4] + c_[5] * t) + t2 * (c_[6] + c_[7] * t)));
  }

 private:
  std::array<double, 8> c_;
};

/// Constants of the law in a step.
struct Constants {
  double A, B;         ///< Pa
  double C, exponent;  ///< exponent: n
  double least;        ///< increment of the plastic strain at the reference rate
  double per_least;    ///< 1 / least
};

/// Holds the work arrays of the solution for unfinished points.
struct Work {
  std::size_t size = 0;
  std::array<std::size_t, batch_size> point;
  BatchValues trial, strain, power, softening, stiffness, lower, upper;
  BatchValues x;       ///< current increment
  BatchValues raised;  ///< (strain + x)^n
  BatchValues rate;    ///< ln of the ratio of x to that of the reference rate, at least 0
  std::array<std::uint64_t, batch_size> active;
};

/// Replaces the first values by x^n; 0 for values that are too small.
void raise(BatchValues& values, std::size_t size, double n) {
  BatchValues base;
  for (std::size_t k = 0; k < size; ++k) {
    base[k] = values[k];
    values[k] = std::max(values[k], least_strain);
  }
  logarithms(values.data(), size);
  for (std::size_t k = 0; k < size; ++k) values[k] *= n;
  exponentials(values.data(), size);
  for (std::size_t k = 0; k < size; ++k) values[k] = base[k] > least_strain ? values[k] : 0.0;
}

/// Raises the strains to the power n, by the binomial series where the increment is small compared with the
/// strain, otherwise directly.
void raise_strains(Work& w, double n, const Binomial& binomial) {
  std::array<std::size_t, batch_size> large;
  std::size_t count = 0;
  for (std::size_t k = 0; k < w.size; ++k) {
    w.raised[k] = w.power[k] * binomial(w.x[k] / std::max(w.strain[k], 100.0 * w.x[k]));
  }
  for (std::size_t k = 0; k < w.size; ++k) {
    large[count] = k;
    count += 100.0 * w.x[k] < w.strain[k] ? 0 : 1;
  }
  if (count == 0) return;
  BatchValues values;
  for (std::size_t k = 0; k < count; ++k) values[k] = w.strain[large[k]] + w.x[large[k]];
  const std::size_t size = material::padded(count);
  std::fill(values.begin() + count, values.begin() + size, 1.0);
  raise(values, size, n);
  for (std::size_t k = 0; k < count; ++k) w.raised[large[k]] = values[k];
}

/// Stores the increments of all points and removes the finished ones.
void drop_solved(Work& w, YieldingPoints& points) {
  std::array<std::size_t, batch_size> left;
  std::size_t count = 0;
  for (std::size_t k = 0; k < w.size; ++k) {
    points.increment[w.point[k]] = w.x[k];
    left[count] = k;
    count += w.active[k] != 0 ? 1 : 0;
  }
  if (count == w.size) return;
  w.size = material::padded(count);
  const auto keep = [&](auto& values) {
    for (std::size_t k = 0; k < count; ++k) values[k] = values[left[k]];
    for (std::size_t k = count; k < w.size; ++k) values[k] = values[count - 1];  // padding
  };
  keep(w.point), keep(w.trial), keep(w.strain), keep(w.power), keep(w.softening), keep(w.stiffness);
  keep(w.lower), keep(w.upper), keep(w.x);
}

/// Takes over the points: trial stresses, strains with their powers, and solid fractions times 1 - T*^m.
void take_over(Work& w, const JohnsonCook& law, const YieldingPoints& points) {
  const std::size_t n = w.size = points.size;
  BatchValues thermal;
  const double per_span = 1.0 / (law.melting_temperature - law.reference_temperature);
  for (std::size_t k = 0; k < n; ++k) {
    const double homologous = (points.temperature[k] - law.reference_temperature) * per_span;
    thermal[k] = homologous > 0.0 ? std::min(homologous, 1.0) : 1.0;
  }
  logarithms(thermal.data(), n);
  for (std::size_t k = 0; k < n; ++k) thermal[k] *= law.thermal_exponent;
  exponentials(thermal.data(), n);
  for (std::size_t k = 0; k < n; ++k) {
    const bool warm = points.temperature[k] > law.reference_temperature;
    w.softening[k] = points.solid[k] * (warm ? 1.0 - thermal[k] : 1.0);
    w.power[k] = w.strain[k] = std::max(points.plastic_strain[k], 0.0);
    w.trial[k] = points.trial[k];
    w.point[k] = k;
  }
  if (law.hardening_coefficient > 0.0) {
    raise(w.power, n, law.hardening_exponent);
  } else {
    std::fill_n(w.power.begin(), n, 0.0);
  }
}

/// Linear hardening with rate effect: x is the root of S x + a ln(x/l) = b with b = q - w Y(ep, 0, T), a = C w Y and l
/// the increment at the reference rate, x = z a/S with z + ln z = b/a - ln(a/(S l)).
struct LinearHardening {
  BatchValues slope;  ///< S, Pa
  BatchValues scale;  ///< a/S
  BatchValues ratio;  ///< b/a
};

/// Brackets the roots; x becomes the root for linear hardening without rate effect.
void bracket(Work& w, LinearHardening& linear, const Constants& law, const YieldingPoints& points) {
  for (std::size_t k = 0; k < w.size; ++k) {
    const double yield = w.softening[k] * (law.A + law.B * w.power[k]);
    const double excess = w.trial[k] - yield;
    const bool yields = excess > 0.0;
    w.stiffness[k] = 3.0 * points.modulus[k];
    w.active[k] = yields ? 1 : 0;
    w.lower[k] = 0.0;
    w.upper[k] = excess / w.stiffness[k];
    linear.slope[k] = w.stiffness[k] + w.softening[k] * (law.B * law.exponent) * w.power[k] /
                                           std::max(w.strain[k], w.upper[k]);
    w.x[k] = yields ? excess / linear.slope[k] : 0.0;
    const double a = std::max(law.C * yield, 1e-9 * excess);
    linear.scale[k] = yields ? a / linear.slope[k] : 1.0;
    linear.ratio[k] = yields ? excess / a : 1.0;
  }
}

/// Replaces x by the root with the rate effect for linear hardening, corrected for the contribution of the rate to the
/// hardening.
void include_rate(Work& w, const LinearHardening& linear, const Constants& law) {
  BatchValues logarithm, argument, start;
  for (std::size_t k = 0; k < w.size; ++k) {
    logarithm[k] = rough_log(linear.scale[k] * law.per_least);
    argument[k] = linear.ratio[k] - logarithm[k];
    start[k] = std::min(argument[k], 1.0);
  }
  exponentials(start.data(), w.size);
  for (std::size_t k = 0; k < w.size; ++k) {
    double z = formulas::omega(argument[k], start[k]);
    const double rate_logarithm = argument[k] - z + logarithm[k];
    z -=
        z * z / (1.0 + z) * ((linear.slope[k] - w.stiffness[k]) / linear.slope[k] * (law.C * rate_logarithm));
    w.x[k] = std::min(w.x[k], std::max(linear.scale[k] * z, law.least));
  }
}

/// Computes hardening and rate of the current increments.
void evaluate(Work& w, const Constants& law, const Binomial& binomial) {
  if (law.B > 0.0) {
    raise_strains(w, law.exponent, binomial);
  } else {
    std::fill_n(w.raised.begin(), w.size, 0.0);
  }
  for (std::size_t k = 0; k < w.size; ++k) w.rate[k] = std::max(w.x[k] * law.per_least, 1.0);
  if (law.C > 0.0) logarithms(w.rate.data(), w.size);
}

/// Increments that an iteration offers.
struct Candidates {
  BatchValues halley;  ///< of Halley's method
  BatchValues newton;  ///< change of ln x by Newton's method
};

/// Narrows the brackets by the residuals of the current increments and computes the next ones. Points whose residual
/// has vanished are no longer active.
void iterate(Work& w, Candidates& next, const Constants& law) {
  for (std::size_t k = 0; k < w.size; ++k) {
    const double x = w.x[k], strain = w.strain[k] + x, raised = w.raised[k];
    const double rate_factor = law.C > 0.0 ? 1.0 + law.C * w.rate[k] : 1.0;
    const double hardening = law.A + law.B * raised;
    const double residual = w.trial[k] - w.stiffness[k] * x - w.softening[k] * hardening * rate_factor;
    const bool open = std::abs(residual) > 1e-11 * w.trial[k], left = residual > 0.0;
    w.lower[k] = open && left ? x : w.lower[k];
    w.upper[k] = open && !left ? x : w.upper[k];
    const double inverse = 1.0 / (strain * x), per_strain = inverse * x, per_x = inverse * strain;
    const double work_hardening = (law.B * law.exponent) * raised * per_strain;
    const double rate_hardening = x > law.least ? law.C * per_x : 0.0;
    const double steepness =
        w.stiffness[k] + w.softening[k] * (work_hardening * rate_factor + hardening * rate_hardening);
    const double curvature =
        w.softening[k] * ((law.exponent - 1.0) * per_strain * work_hardening * rate_factor +
                          rate_hardening * (2.0 * work_hardening - hardening * per_x));
    next.newton[k] = residual / (steepness * x);
    next.halley[k] = x + 2.0 * residual * steepness / (2.0 * steepness * steepness + residual * curvature);
    w.active[k] = open ? 1 : 0;
  }
}

/// Takes the step of Halley's method where it stays inside the bracket, otherwise one of Newton's method in ln x, or
/// half of the bracket. Points whose next residual would vanish are no longer active.
void advance(Work& w, Candidates& next) {
  std::uint64_t left_bracket = 0;
  for (std::size_t k = 0; k < w.size; ++k) {
    const bool inside = next.halley[k] > w.lower[k] && next.halley[k] < w.upper[k];
    left_bracket |= inside ? 0 : w.active[k];
  }
  if (left_bracket != 0) exponentials(next.newton.data(), w.size);
  for (std::size_t k = 0; k < w.size; ++k) {
    const bool open = w.active[k] != 0, inside = next.halley[k] > w.lower[k] && next.halley[k] < w.upper[k];
    const double instead = w.lower[k] > 0.0 ? 0.5 * (w.lower[k] + w.upper[k]) : w.x[k] * next.newton[k];
    // The error after a step of Halley's method is at most about a third of the cube of the previous one.
    const bool near = inside && std::abs(next.halley[k] - w.x[k]) <= 3e-4 * w.x[k];
    w.x[k] = open ? (inside ? next.halley[k] : instead) : w.x[k];
    w.active[k] = open && !near && w.upper[k] - w.lower[k] > 1e-15 * w.upper[k] ? 1 : 0;
  }
}

}  // namespace

/// Solves f(x) = q - 3 G x - w Y(ep + x, x/dt, T) = 0. f decreases monotonically from f(0) > 0 to f((q - w Y(ep, 0, T))
/// / 3G) <= 0, which brackets the root. Halley's method starts from the root for linear hardening; where a step leaves
/// the bracket (the logarithm is steep for small increments), it is replaced by a Newton step in ln x, which approaches
/// from the right, and by bisection at the kink of the reference rate. Usually one evaluation suffices. The iteration
/// of a point does not depend on the other points.
WHIPPLE_KERNEL void JohnsonCook::solve(YieldingPoints& points, double dt) const {
  const double least = reference_rate * dt;
  const Constants law = {yield_stress, hardening_coefficient, rate_coefficient, hardening_exponent, least,
                         1.0 / least};
  Work w;
  take_over(w, *this, points);
  LinearHardening linear;
  bracket(w, linear, law, points);
  if (law.C > 0.0) include_rate(w, linear, law);
  for (std::size_t k = 0; k < w.size; ++k) w.x[k] = w.active[k] != 0 ? w.x[k] : 0.0;
  drop_solved(w, points);

  const Binomial binomial(law.exponent);
  for (int iteration = 0; iteration < 30 && w.size > 0; ++iteration) {
    evaluate(w, law, binomial);
    Candidates next;
    iterate(w, next, law);
    advance(w, next);
    drop_solved(w, points);
  }
}

}  // namespace whipple::strength
