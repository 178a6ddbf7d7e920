// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "src/core/base/error.hpp"
#include "src/core/base/parameter_table.hpp"
#include "src/core/base/vector_math.hpp"
#include "src/material/strength/law_formulas.hpp"
#include "src/material/strength/radial_return.hpp"
#include "src/material/strength/return_in_batch.hpp"
#include "src/material/strength/strength.hpp"

namespace whipple::strength {

/// Steinberg-Cochran-Guinan: shear modulus and flow stress of metals at high rates (above 1e5 1/s, where the
/// rate has no further effect), rising with pressure and falling with temperature,
///   G = G0 [1 + A p/eta^(1/3) - B (T - 300 K)],  eta = rho/rho0,
///   Y = min(Y0 [1 + beta (ep + ep_i)]^n, Y_max) G/G0.
/// Melting is that of the equation of state (its Lindemann law is the same as that of GRAY). Source: D. J.
/// Steinberg, S. G. Cochran, M. W. Guinan, J. Appl. Phys. 51 (1980) 1498; constants: UCRL-MA-106439 (1996).
struct SteinbergGuinan {
  double reference_density = 0.0;        ///< rho0, kg/m^3
  double shear_modulus = 0.0;            ///< G0, Pa
  double pressure_coefficient = 0.0;     ///< A, 1/Pa
  double temperature_coefficient = 0.0;  ///< B, 1/K
  double yield_stress = 0.0;             ///< Y0, Pa
  double maximum_flow_stress = 0.0;      ///< Y_max, Pa
  double hardening_coefficient = 0.0;    ///< beta
  double hardening_exponent = 1.0;       ///< n
  double initial_plastic_strain = 0.0;   ///< ep_i

  static ParameterTable<SteinbergGuinan> parameters() {
    using P = SteinbergGuinan;
    return {
        real("reference_density", &P::reference_density, "kg/m^3", range::positive(), "rho0"),
        real("shear_modulus", &P::shear_modulus, "Pa", range::positive(), "G0 at 300 K and no pressure"),
        real("pressure_coefficient", &P::pressure_coefficient, "1/Pa", range::non_negative(),
             "A: relative rise of G with p/eta^(1/3)"),
        real("temperature_coefficient", &P::temperature_coefficient, "1/K", range::non_negative(),
             "B: relative fall of G with temperature"),
        real("yield_stress", &P::yield_stress, "Pa", range::positive(), "Y0"),
        real("maximum_flow_stress", &P::maximum_flow_stress, "Pa", range::positive(),
             "Y_max, bound of the work hardening at 300 K and no pressure"),
        real("hardening_coefficient", &P::hardening_coefficient, "", range::non_negative(), "beta"),
        real("hardening_exponent", &P::hardening_exponent, "", range::non_negative(), "n"),
        real("initial_plastic_strain", &P::initial_plastic_strain, "", range::non_negative(), "ep_i")
            .optional(),
    };
  }
  static constexpr const char* name = "steinberg_guinan";
  static constexpr const char* summary =
      "Steinberg-Cochran-Guinan: strength and shear modulus with pressure and temperature, high rates";
  static constexpr const char* theory =
      "G = G0 [1 + A p/eta^(1/3) - B (T - 300 K)], Y = min(Y0 [1 + beta (ep + ep_i)]^n, Y_max) G/G0,\n"
      "both times the solid fraction; eta = rho/rho0.\n"
      "Source: Steinberg, Cochran and Guinan, J. Appl. Phys. 51 (1980) 1498.";

  /// Returns G/G0, at least 1e-3: so soft a solid has almost no stress, and melting removes the rest. Without a
  /// temperature (NaN) of the equation of state there is no softening.
  template <class Number>
  [[nodiscard]] Number stiffness_ratio(Number density, Number pressure, Number temperature) const {
    return formulas::stiffness_ratio(*this, density, pressure, temperature);
  }
  /// Returns the flow stress at 300 K and zero pressure, with its slope.
  [[nodiscard]] FlowStress hardening(double plastic_strain) const {
    return formulas::power_hardening(*this, plastic_strain);
  }

  /// Returns false if a point remains elastic: Y >= Y_0 G/G_0 avoids the powers for most elastic points.
  [[nodiscard]] bool may_yield(double trial, double /*temperature*/, double modulus, double /*solid*/) const {
    return trial > modulus * (yield_stress / shear_modulus);
  }
  /// Solves for the increments (BatchLaw).
  void solve(YieldingPoints& points, double dt) const;
  [[nodiscard]] double increment(double trial, double plastic_strain, double modulus, double solid) const {
    return increment_of_one(*this, trial, plastic_strain, 0.0, modulus, solid, 0.0);
  }
};

class SteinbergGuinanModel final : public Strength {
 public:
  /// @throws InputError if the constants are inconsistent
  explicit SteinbergGuinanModel(const SteinbergGuinan& constants) : constants_(constants) {
    if (constants.maximum_flow_stress < constants.yield_stress) {
      throw InputError("'maximum_flow_stress' is less than 'yield_stress'");
    }
  }

  [[nodiscard]] const SteinbergGuinan& law() const { return constants_; }
  [[nodiscard]] std::string_view model() const override { return SteinbergGuinan::name; }
  void shear_modulus(const State& state, std::span<double> modulus) const override {
    for (std::size_t i = 0; i < modulus.size(); i += 4) {
      const std::size_t count = std::min<std::size_t>(4, modulus.size() - i);
      const Lanes ratio = constants_.stiffness_ratio(load(&state.density[i], count, 1.0),
                                                     load(&state.pressure[i], count, 0.0),
                                                     load(&state.temperature[i], count, 0.0));
      store(&modulus[i], constants_.shear_modulus * ratio, count);
    }
  }
  /// Solves for the increments of the plastic strain.
  /// @param modulus  result of `shear_modulus`, times the solid fraction
  void plastic_increment(const State& state, std::span<const double> trial, std::span<const double> modulus,
                         std::span<const double> solid_fraction, double dt,
                         std::span<double> increment) const override {
    return_in_batch(constants_, state, trial, modulus, solid_fraction, dt, increment);
  }
  void flow_stress(const State& state, std::span<const double>, std::span<double> stress) const override {
    for (std::size_t i = 0; i < stress.size(); ++i) {
      stress[i] = constants_.hardening(state.plastic_strain[i]).value * ratio(state, i);
    }
  }
  [[nodiscard]] std::string constants() const override {
    SteinbergGuinan copy = constants_;
    const auto bound = whipple::bind(SteinbergGuinan::parameters(), copy);
    return "model = \"steinberg_guinan\"\n" + to_toml(bound);
  }

 private:
  [[nodiscard]] double ratio(const State& state, std::size_t i) const {
    return constants_.stiffness_ratio(state.density[i], state.pressure[i], state.temperature[i]);
  }
  SteinbergGuinan constants_;
};

}  // namespace whipple::strength
