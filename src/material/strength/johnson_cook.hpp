// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "src/base/parameter_table.hpp"
#include "src/base/vector_math.hpp"
#include "src/material/strength/elastic_constants.hpp"
#include "src/material/strength/flow_law_model.hpp"

namespace whipple::strength {

/// Johnson-Cook flow stress
///   Y = (A + B ep^n) (1 + C ln max(1, rate / rate_0)) (1 - T*^m),   T* = (T - T_r) / (T_m - T_r) in [0, 1].
/// The rate factor is 1 below the reference rate: the logarithm would otherwise soften slow flow without
/// bound. T_m is the melting temperature of the fit (0.1 MPa): under shock pressure the model loses its
/// strength before the equation of state melts. Source: G. R. Johnson, W. H. Cook, Proc. 7th Int. Symp.
/// Ballistics, The Hague (1983) 541-547.
struct JohnsonCook : ElasticConstants {
  double yield_stress = 0.0;           ///< A, Pa
  double hardening_coefficient = 0.0;  ///< B, Pa
  double hardening_exponent = 1.0;     ///< n
  double rate_coefficient = 0.0;       ///< C
  double reference_rate = 1.0;         ///< 1/s
  double thermal_exponent = 1.0;       ///< m
  double reference_temperature = 0.0;  ///< T_r, K
  double melting_temperature = 0.0;    ///< T_m, K

  static ParameterTable<JohnsonCook> parameters() {
    using P = JohnsonCook;
    return ElasticConstants::parameters<P>(
        {real("yield_stress", &P::yield_stress, "Pa", range::positive(), "A"),
         real("hardening_coefficient", &P::hardening_coefficient, "Pa", range::non_negative(), "B"),
         real("hardening_exponent", &P::hardening_exponent, "", range::positive(), "n"),
         real("rate_coefficient", &P::rate_coefficient, "", range::non_negative(), "C"),
         real("reference_rate", &P::reference_rate, "1/s", range::positive(),
              "plastic strain rate at and below which the rate factor is 1")
             .optional(),
         real("thermal_exponent", &P::thermal_exponent, "", range::positive(), "m"),
         real("reference_temperature", &P::reference_temperature, "K", range::positive(),
              "T_r: no softening at and below it"),
         real("melting_temperature", &P::melting_temperature, "K", range::positive(),
              "T_m: no strength at and above it")});
  }
  static constexpr const char* name = "johnson_cook";
  static constexpr const char* summary = "Johnson-Cook: hardening, strain rate and thermal softening";
  static constexpr const char* theory =
      "Y = (A + B ep^n) (1 + C ln max(1, rate/reference_rate)) (1 - T*^m), T* = (T - T_r)/(T_m - T_r) in [0, "
      "1],\n"
      "times the solid fraction; shear modulus G times the solid fraction. The yield condition holds at the "
      "end of the\n"
      "step with its hardening and rate.\n"
      "Source: Johnson and Cook, Proc. 7th Int. Symp. Ballistics (1983) 541-547.";

  /// @throws InputError if the constants contradict one another
  void require_consistent() const {
    if (melting_temperature <= reference_temperature) {
      throw InputError("'melting_temperature' must be above 'reference_temperature'");
    }
  }
  /// 1 - T*^m; an equation of state without temperature (NaN) does not soften.
  [[nodiscard]] double thermal_factor(double temperature) const {
    const double homologous =
        (temperature - reference_temperature) / (melting_temperature - reference_temperature);
    if (!(homologous > 0.0)) return 1.0;
    return homologous >= 1.0 ? 0.0 : 1.0 - std::pow(homologous, thermal_exponent);
  }
  [[nodiscard]] double flow_stress(double plastic_strain, double rate, double temperature) const {
    const double hardening =
        hardening_coefficient * std::pow(std::max(plastic_strain, 0.0), hardening_exponent);
    const double rate_factor = 1.0 + rate_coefficient * std::log(std::max(1.0, rate / reference_rate));
    return (yield_stress + hardening) * rate_factor * thermal_factor(temperature);
  }

  /// False where a point stays elastic whatever its hardening: spares the powers of most elastic points.
  [[nodiscard]] LanesMask may_yield(Lanes trial, Lanes temperature, Lanes solid) const {
    const double per_span = 1.0 / (melting_temperature - reference_temperature);  // the same for all points
    const Lanes homologous = (temperature - reference_temperature) * per_span;
    // T*^m <= T* for m >= 1
    const Lanes least = thermal_exponent >= 1.0 ? maximum(1.0 - homologous, Lanes{}) : Lanes{};
    return trial > solid * yield_stress * select(homologous > 0.0, least, broadcast(1.0));
  }

  /// The return of four points, and what it works with.
  struct Return {
    Lanes trial, plastic_strain, temperature, modulus, solid;
    Lanes increment;  ///< x, the result
    Lanes softening, power, stiffness, slope, logarithmic, logarithm, argument, lower, upper;
    LanesMask active;
  };

  /// Root of f(x) = q - 3 G x - w Y(ep + x, x/dt, T). f falls monotonically from f(0) > 0 to
  /// f((q - w Y(ep, 0, T)) / 3G) <= 0, which brackets it. Halley's method from the root for linear hardening;
  /// where a step leaves the bracket (the logarithm is steep for small increments), Newton in ln x, which
  /// approaches from the right, replaces it, and bisection at the kink of the reference rate. Mostly one
  /// evaluation. Every point takes the steps that it would take alone. All groups pass through one stage
  /// after the other: what bounds a single one is the latency of its logarithms and powers.
  void solve(std::span<Return> groups, double dt) const {
    const double least = reference_rate * dt, per_least = 1.0 / least;
    for (Return& r : groups) r.softening = r.solid * thermal_factor(r.temperature);
    for (Return& r : groups) {
      r.plastic_strain = maximum(r.plastic_strain, Lanes{});
      r.power = power(r.plastic_strain);
    }
    for (Return& r : groups) begin(r, per_least);
    if (rate_coefficient > 0.0) {
      for (Return& r : groups) guess(r, least);
    }
    const Binomial binomial(hardening_exponent);
    bool active = true;
    for (int iteration = 0; iteration < 30 && active; ++iteration) {
      active = false;
      for (Return& r : groups) {
        if (!any(r.active)) continue;
        iterate(r, least, per_least, binomial);
        active = true;
      }
    }
  }
  [[nodiscard]] double increment(double trial, double plastic_strain, double temperature, double modulus,
                                 double solid, double dt) const {
    Return one{};
    one.trial = broadcast(trial);
    one.plastic_strain = broadcast(plastic_strain);
    one.temperature = broadcast(temperature);
    one.modulus = broadcast(modulus);
    one.solid = broadcast(solid);
    solve({&one, 1}, dt);
    return one.increment[0];
  }

 private:
  /// 1 - T*^m
  [[nodiscard]] Lanes thermal_factor(Lanes temperature) const {
    const Lanes homologous =
        (temperature - reference_temperature) / (melting_temperature - reference_temperature);
    const LanesMask warm = homologous > 0.0;
    const Lanes base = minimum(select(warm, homologous, broadcast(1.0)), broadcast(1.0));
    return select(warm, 1.0 - exp(thermal_exponent * natural_log(base)), broadcast(1.0));
  }
  /// strain^n for strain >= 0
  [[nodiscard]] Lanes power(Lanes strain) const {
    if (hardening_coefficient == 0.0) return Lanes{};
    constexpr double least = 1e-300;
    const Lanes raised = exp(hardening_exponent * natural_log(maximum(strain, broadcast(least))));
    return select(strain > least, raised, Lanes{});
  }
  /// (1 + t)^n for 0 <= t <= 0.01: the terms that are left out are below 1e-16.
  struct Binomial {
    std::array<double, 8> coefficient;
    explicit Binomial(double n) {
      coefficient[0] = 1.0;
      for (std::size_t k = 1; k < coefficient.size(); ++k) {
        coefficient[k] = coefficient[k - 1] * (n - static_cast<double>(k - 1)) / static_cast<double>(k);
      }
    }
    [[nodiscard]] Lanes operator()(Lanes t) const {
      const auto& c = coefficient;
      const Lanes t2 = t * t;
      return (c[0] + c[1] * t) + t2 * ((c[2] + c[3] * t) + t2 * ((c[4] + c[5] * t) + t2 * (c[6] + c[7] * t)));
    }
  };
  /// The same of strain = plastic strain + x, by the binomial series where x is small beside the strain.
  [[nodiscard]] Lanes power(const Return& r, Lanes strain, const Binomial& binomial) const {
    if (hardening_coefficient == 0.0) return Lanes{};
    const Lanes x = r.increment;
    const LanesMask small = 100.0 * x < r.plastic_strain;
    const Lanes raised = r.power * binomial(x / maximum(r.plastic_strain, 100.0 * x));
    return bits(small) == all_lanes ? raised : select(small, raised, power(strain));
  }
  /// Bracket, and the root without the rate. With rate it is, for linear hardening, the root of
  /// S x + a ln(x/l) = b, b = q - w Y(ep, 0, T) and a = C w Y: z + ln z = K of z = S x/a.
  void begin(Return& r, double per_least) const {
    const Lanes yield = r.softening * (yield_stress + hardening_coefficient * r.power);
    const Lanes excess = r.trial - yield;
    r.stiffness = 3.0 * r.modulus;
    r.active = excess > 0.0;
    r.lower = Lanes{};
    r.upper = excess / r.stiffness;
    r.slope = r.stiffness + r.softening * (hardening_coefficient * hardening_exponent) * r.power /
                                maximum(r.plastic_strain, r.upper);
    r.increment = select(r.active, excess / r.slope, Lanes{});
    if (!(rate_coefficient > 0.0)) return;
    const Lanes a = maximum(rate_coefficient * yield, 1e-9 * excess);
    r.logarithmic = select(r.active, a / r.slope, broadcast(1.0));
    r.logarithm = rough_log(r.logarithmic * per_least);
    r.argument = select(r.active, excess / a, broadcast(1.0)) - r.logarithm;  // K
  }
  /// z by the asymptotic series of Wright's omega function (R. M. Corless and D. J. Jeffrey, LNCS 2385 (2002)
  /// 76), for K < 1 roughly, and a step of fourth order (F. N. Fritsch, R. E. Shafer and W. P. Crowley,
  /// Commun. ACM 16 (1973) 123); then what the rate adds to the hardening.
  void guess(Return& r, double least) const {
    const Lanes k = maximum(r.argument, broadcast(1.0)), logarithm = rough_log(k), inverse = 1.0 / k;
    Lanes z = k - logarithm + logarithm * inverse * (1.0 + (0.5 * logarithm - 1.0) * inverse);
    if (const LanesMask small = r.argument < 1.0; any(small & r.active)) {
      const Lanes raised = exp(minimum(r.argument, broadcast(1.0)));
      z = select(small, raised / (1.0 + raised), z);
    }
    z = maximum(z, broadcast(std::numeric_limits<double>::min()));
    const Lanes miss = r.argument - z - rough_log(z), after = 1.0 + z,
                q = 2.0 * after * (after + (2.0 / 3.0) * miss);
    z += z * (miss * (q - miss)) / (after * (q - 2.0 * miss));
    const Lanes rate_logarithm = r.argument - z + r.logarithm;
    const Lanes more = (r.slope - r.stiffness) / r.slope * (rate_coefficient * rate_logarithm);
    z -= z * z / (1.0 + z) * more;
    const Lanes root = r.logarithmic * z, without = r.increment;
    r.increment = minimum(without, maximum(root, broadcast(least)));
  }
  void iterate(Return& r, double least, double per_least, const Binomial& binomial) const {
    const Lanes x = r.increment, strain = r.plastic_strain + x, raised = power(r, strain, binomial);
    const LanesMask fast = x > least;
    Lanes rate_factor = broadcast(1.0);
    if (rate_coefficient > 0.0) {
      rate_factor += rate_coefficient * natural_log(maximum(x * per_least, broadcast(1.0)));
    }
    const Lanes hardening = yield_stress + hardening_coefficient * raised;
    const Lanes residual = r.trial - r.stiffness * x - r.softening * hardening * rate_factor;
    r.active &= absolute(residual) > 1e-11 * r.trial;
    const LanesMask left = residual > 0.0;
    r.lower = select(r.active & left, x, r.lower);
    r.upper = select(r.active & ~left, x, r.upper);
    const Lanes inverse = 1.0 / (strain * x), per_strain = inverse * x, per_x = inverse * strain;
    const Lanes work_hardening = (hardening_coefficient * hardening_exponent) * raised * per_strain;
    const Lanes rate_hardening = select(fast, rate_coefficient * per_x, Lanes{});
    const Lanes slope =
        r.stiffness + r.softening * (work_hardening * rate_factor + hardening * rate_hardening);
    const Lanes curvature =
        r.softening * ((hardening_exponent - 1.0) * per_strain * work_hardening * rate_factor +
                       rate_hardening * (2.0 * work_hardening - hardening * per_x));
    Lanes next = x + 2.0 * residual * slope / (2.0 * slope * slope + residual * curvature);
    const LanesMask inside = (next > r.lower) & (next < r.upper);
    // The error of a step of Halley's method goes with the third power of the one before, over three at most.
    const LanesMask near = inside & (absolute(next - x) <= 3e-4 * x);
    if (any(r.active & ~inside)) {
      const Lanes logarithmic = x * exp(residual / (slope * x));
      next = select(inside, next, select(r.lower > 0.0, 0.5 * (r.lower + r.upper), logarithmic));
    }
    r.increment = select(r.active, next, x);
    r.active &= ~near & (r.upper - r.lower > 1e-15 * r.upper);
  }
};

using JohnsonCookModel = FlowLawModel<JohnsonCook>;

}  // namespace whipple::strength
