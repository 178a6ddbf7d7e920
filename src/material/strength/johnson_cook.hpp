// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

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
  [[nodiscard]] bool may_yield(double trial, double temperature, double solid) const {
    const double homologous =
        (temperature - reference_temperature) / (melting_temperature - reference_temperature);
    double least_factor = 1.0;
    // T*^m <= T* for m >= 1
    if (homologous > 0.0) least_factor = thermal_exponent >= 1.0 ? 1.0 - std::min(homologous, 1.0) : 0.0;
    return trial > solid * least_factor * yield_stress;
  }

  /// Root of f(x) = q - 3 G x - w Y(ep + x, x/dt, T) for four points. f falls monotonically from f(0) > 0 to
  /// f((q - w Y(ep, 0, T)) / 3G) <= 0, which brackets it. Y is concave in x, so a Newton step from the right
  /// of the root ends left of it and from there converges monotonically; where the first step leaves the
  /// bracket (the logarithm is steep for small increments), Newton in ln x, which approaches from the right,
  /// replaces it, and bisection at the kink of the reference rate. Two to six evaluations in practice.
  /// Every point takes the steps that it would take alone.
  [[nodiscard]] Lanes increment(Lanes trial, Lanes plastic_strain, Lanes temperature, Lanes modulus,
                                Lanes solid, double dt) const {
    const Lanes softening = solid * thermal_factor(temperature);
    const Lanes strain_0 = maximum(plastic_strain, Lanes{});
    const Lanes yield = softening * (yield_stress + hardening_coefficient * power(strain_0));
    const Lanes stiffness = 3.0 * modulus;
    const double least_rate_strain = reference_rate * dt;
    LanesMask active = trial > yield;
    const LanesMask yields = active;
    Lanes lower{}, upper = (trial - yield) / stiffness;
    Lanes x = upper;
    for (int iteration = 0; iteration < 30 && any(active); ++iteration) {
      const Lanes strain = strain_0 + x, raised = power(strain);
      const LanesMask fast = x > least_rate_strain;
      Lanes rate_factor = broadcast(1.0);
      if (rate_coefficient > 0.0 && any(fast)) {
        rate_factor += rate_coefficient * natural_log(maximum(x / least_rate_strain, broadcast(1.0)));
      }
      const Lanes hardening = yield_stress + hardening_coefficient * raised;
      const Lanes residual = trial - stiffness * x - softening * hardening * rate_factor;
      active &= absolute(residual) > 1e-11 * trial;
      if (!any(active)) break;
      const LanesMask right = residual > 0.0;
      lower = select(active & right, x, lower);
      upper = select(active & ~right, x, upper);
      const Lanes slope = stiffness + softening * (hardening_coefficient * hardening_exponent * raised /
                                                       strain * rate_factor +
                                                   select(fast, hardening * rate_coefficient / x, Lanes{}));
      const Lanes newton = x + residual / slope;
      const LanesMask inside = (newton > lower) & (newton < upper);
      Lanes next = newton;
      if (any(active & ~inside)) {
        const Lanes logarithmic = x * exp(residual / (slope * x));
        next = select(inside, newton, select(lower > 0.0, 0.5 * (lower + upper), logarithmic));
      }
      x = select(active, next, x);
      active &= upper - lower > 1e-15 * upper;
    }
    return select(yields, x, Lanes{});
  }
  [[nodiscard]] double increment(double trial, double plastic_strain, double temperature, double modulus,
                                 double solid, double dt) const {
    return increment(broadcast(trial), broadcast(plastic_strain), broadcast(temperature), broadcast(modulus),
                     broadcast(solid), dt)[0];
  }

 private:
  /// strain^n for strain >= 0
  [[nodiscard]] Lanes power(Lanes strain) const {
    if (hardening_coefficient == 0.0) return Lanes{};
    constexpr double least = 1e-300;
    const Lanes raised = exp(hardening_exponent * natural_log(maximum(strain, broadcast(least))));
    return select(strain > least, raised, Lanes{});
  }
  [[nodiscard]] Lanes thermal_factor(Lanes temperature) const {
    const Lanes homologous =
        (temperature - reference_temperature) / (melting_temperature - reference_temperature);
    const LanesMask warm = homologous > 0.0;
    if (!any(warm)) return broadcast(1.0);
    const Lanes base = minimum(select(warm, homologous, broadcast(1.0)), broadcast(1.0));
    return select(warm, 1.0 - pow(base, broadcast(thermal_exponent)), broadcast(1.0));
  }
};

using JohnsonCookModel = FlowLawModel<JohnsonCook>;

}  // namespace whipple::strength
