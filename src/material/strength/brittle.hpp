// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/core/base/parameter_table.hpp"
#include "src/core/base/tensor.hpp"
#include "src/material/strength/brittle_surface.hpp"
#include "src/material/strength/dilation.hpp"
#include "src/material/strength/elastic_constants.hpp"
#include "src/material/strength/strength.hpp"

/// Brittle material: the strength follows the pressure and decreases with damage
/// (docs/theory/concrete_and_ceramics.md).
namespace whipple::strength {

/// Holds a chunk of points after the equation of state (SI units), one entry per point.
struct BrittleState {
  double bulk_modulus;               ///< rho c^2 of the reference state, Pa
  std::span<const double> pressure;  ///< of the equation of state, as if the material filled its voids, Pa
  std::span<const double> modulus;   ///< shear modulus with melting, Pa
  std::span<const double> solid_fraction;    ///< solid fraction; 0 where the point has failed
  std::span<const double> trial;             ///< equivalent trial stress of the deviator, Pa
  std::span<const double> rate;              ///< equivalent strain rate, 1/s
  std::span<const double> lode_cosine;       ///< cos 3 theta of the trial deviator; empty unless needed
  std::span<const double> compaction;        ///< increase of the compression at rest by crushed pores
  std::span<const double> crush_pressure;    ///< at which the pores collapse, Pa; infinite: no pores
  std::span<const double> threshold_factor;  ///< scatter of the failure strain (1: none)
  std::span<double> equivalent;              ///< equivalent stress, Pa; out
  std::span<double> plastic_increment;       ///< out
  std::span<double> plastic_strain;          ///< in and out
  std::span<double> damage;                  ///< in and out
  std::span<double> least_pressure;          ///< pressure at which voids open, Pa; out
  std::span<double> bulking_pressure;        ///< pressure gained by bulking, Pa; out
  std::span<SymmetricTensor> deviator;  ///< trial deviator, Pa; in and out; empty unless the law turns it
  std::span<double> work;               ///< plastic work, J/m^3; out; with the deviator
  std::span<const double> dilation;  ///< fraction of the dilation angle that `dilate` took; with the deviator
  std::span<const double> distension;  ///< after `dilate`; empty unless the law changes the volume
};

/// Interface of the part of a strength model that acts once the pressure of the step is known, with one virtual call
/// per chunk.
class Brittle {
 public:
  virtual ~Brittle() = default;
  /// Returns the deviator to the strength, advances the damage, and computes the pressure at which voids open.
  virtual void relax(const BrittleState& state) const = 0;
  /// Returns whether its flow changes the volume: `dilate` is then called before `relax`, and the equation of state is
  /// evaluated between them with the new distension.
  [[nodiscard]] virtual bool dilates() const { return false; }
  /// Returns the greatest distension that `dilate` leads to.
  [[nodiscard]] virtual double greatest_distension() const { return 1.0; }
  /// Computes by how much the flow of the step changes the distension.
  virtual void dilate(const DilationState& /*state*/) const {}
  /// Returns whether lost shear energy is converted to pressure (bulking).
  [[nodiscard]] virtual bool bulks() const { return false; }
  /// Returns whether the law returns the deviator itself, in another direction than to zero.
  [[nodiscard]] virtual bool turns_deviator() const { return false; }
  /// Returns whether the strength depends on the Lode angle.
  [[nodiscard]] virtual bool needs_lode_angle() const { return false; }
};

/// Describes the state of a point in a step.
struct BrittlePoint {
  double pressure;  ///< not below the pressure at which voids open, Pa
  double rate;      ///< 1/s
  double lode_cosine = 1.0;
  double plastic_strain = 0.0;
  double damage = 0.0;
  double compaction = 0.0;
  double crush_pressure = std::numeric_limits<double>::infinity();
  double distension = 1.0;  ///< of laws that change the volume
};

/// Implements the interfaces for a brittle law. A law is a plain struct of constants that derives from
/// ElasticConstants, with name, summary, theory, parameters(), require_consistent() and
///   surface(point) -> BrittleSurface              strength and failure strain at point.pressure, point.rate
///   least_pressure(point) -> double               Pa, <= 0, at point.damage
///   crushed_strain(point) -> double               strain that crushed pores add to the damage
/// and optionally prepare() (computes once what its functions need), keeps_strength (soils: no strain damages them),
/// growth(point) (of ln J_p by flow, where changes_volume(); not beyond maximum_dilation), bulking (fraction of the lost
/// shear energy that becomes pressure) or hardening(trial, stiffness, surface, point) -> BrittleReturn (strain hardening
/// before any damage).
template <class Law>
class BrittleModel final : public Strength, public Brittle {
 public:
  /// @throws InputError if the constants are inconsistent
  explicit BrittleModel(const Law& law) : law_(law), modulus_(law.stiffness()) {
    law.require_consistent();
    if constexpr (requires { law_.prepare(); }) law_.prepare();
  }

  [[nodiscard]] const Law& law() const { return law_; }
  [[nodiscard]] std::string_view model() const override { return Law::name; }
  [[nodiscard]] const Brittle* brittle() const override { return this; }
  void shear_modulus(const State&, std::span<double> modulus) const override {
    std::ranges::fill(modulus, modulus_);
  }
  /// Returns no increment: the pressure is not yet known, and the trial deviator is passed to `relax`.
  void plastic_increment(const State&, std::span<const double>, std::span<const double>,
                         std::span<const double>, double, std::span<double> increment) const override {
    std::ranges::fill(increment, 0.0);
  }
  /// Computes the flow stress of undamaged material.
  void flow_stress(const State& state, std::span<const double> rate,
                   std::span<double> stress) const override {
    for (std::size_t i = 0; i < stress.size(); ++i) {
      stress[i] = law_.surface({.pressure = state.pressure[i], .rate = rate[i]}).strength(0.0);
    }
  }
  [[nodiscard]] bool bulks() const override {
    if constexpr (requires { law_.bulking; }) return law_.bulking > 0.0;
    return false;
  }
  [[nodiscard]] bool needs_lode_angle() const override {
    return requires { Law::needs_lode_angle; };
  }
  void relax(const BrittleState& state) const override {
    for (std::size_t i = 0; i < state.trial.size(); ++i) relax_point(state, i);
  }
  [[nodiscard]] bool dilates() const override {
    if constexpr (grows()) return law_.changes_volume();
    return false;
  }
  [[nodiscard]] double greatest_distension() const override {
    if constexpr (grows()) return dilates() ? std::exp(law_.maximum_dilation) : 1.0;
    return 1.0;
  }
  void dilate(const DilationState& state) const override {
    if constexpr (grows()) {
      for (std::size_t i = 0; i < state.trial.size(); ++i) {
        const bool flows =
            may_dilate(state, i, law_.least_pressure(BrittlePoint{.pressure = 0.0, .rate = 0.0}));
        state.growth[i] = flows ? law_.growth({.pressure = state.pressure[i],
                                               .trial = state.trial[i],
                                               .stiffness = state.stiffness[i],
                                               .modulus = state.modulus[i],
                                               .distension = state.distension[i]})
                                : 0.0;
      }
    }
  }
  [[nodiscard]] std::string constants() const override {
    Law copy = law_;
    return fmt::format("model = \"{}\"\n{}", Law::name, to_toml(whipple::bind(Law::parameters(), copy)));
  }

 private:
  void relax_point(const BrittleState& state, std::size_t i) const {
    BrittlePoint point{.pressure = state.pressure[i],
                       .rate = state.rate[i],
                       .plastic_strain = state.plastic_strain[i],
                       .damage = state.damage[i],
                       .compaction = state.compaction[i],
                       .crush_pressure = state.crush_pressure[i]};
    if (!state.lode_cosine.empty()) point.lode_cosine = state.lode_cosine[i];
    if (!state.distension.empty()) point.distension = state.distension[i];
    point.pressure = std::max(point.pressure, law_.least_pressure(point));
    BrittleSurface y = law_.surface(point);
    const double solid = state.solid_fraction[i], stiffness = 3.0 * state.modulus[i];
    y.whole *= solid;
    y.fall *= solid;
    y.greatest *= solid;
    y.failure_strain *= state.threshold_factor[i];
    const double crushed = law_.crushed_strain(point);
    if (crushed > 0.0) {
      point.damage = y.failure_strain > 0.0 ? std::min(1.0, point.damage + crushed / y.failure_strain) : 1.0;
    }
    double increment = 0.0;
    if (stiffness > 0.0) {
      const double before = y.strength(point.damage);
      const BrittleReturn r = step(state.trial[i], stiffness, y, point);
      increment = r.increment;
      point.damage = r.damage;
      // The stress of broken material and of soil is exactly that of its surface: without strength it has none at all.
      const bool on_surface = increment > 0.0 && (r.damage == 1.0 || keeps_strength());
      state.equivalent[i] = on_surface ? std::min(state.trial[i], y.strength(r.damage))
                                       : state.trial[i] - stiffness * increment;
      if (increment > 0.0) state.bulking_pressure[i] = bulking_pressure(state, i, point, before, y);
    }
    state.plastic_increment[i] = increment;
    state.plastic_strain[i] += increment;
    state.damage[i] = point.damage;
    state.least_pressure[i] = law_.least_pressure(point);
  }
  static constexpr bool grows() {
    return requires(const Law& law) { law.growth(DilatingPoint{}); };
  }
  static constexpr bool keeps_strength() {
    return requires { Law::keeps_strength; };
  }
  BrittleReturn step(double trial, double stiffness, const BrittleSurface& y,
                     const BrittlePoint& point) const {
    if constexpr (requires { law_.hardening(trial, stiffness, y, point); }) {
      return law_.hardening(trial, stiffness, y, point);
    } else if constexpr (keeps_strength()) {
      return {std::max(0.0, trial - y.strength(point.damage)) / stiffness, point.damage};
    } else {
      return brittle_return(trial, stiffness, y, point.damage);
    }
  }
  /// Returns the pressure increment from the fraction `bulking` of the shear energy that is lost with the strength
  /// (docs/theory/concrete_and_ceramics.md, eq. 12).
  double bulking_pressure(const BrittleState& state, std::size_t i, const BrittlePoint& point, double before,
                          const BrittleSurface& y) const {
    if constexpr (requires { law_.bulking; }) {
      if (!(point.pressure > 0.0)) return 0.0;
      const double after = y.strength(point.damage), p = point.pressure;
      const double lost = (before * before - after * after) / (6.0 * state.modulus[i]);
      return lost > 0.0 ? std::sqrt(p * p + 2.0 * law_.bulking * state.bulk_modulus * lost) - p : 0.0;
    }
    return 0.0;
  }

  Law law_;
  double modulus_;
};

/// Returns 1 + C ln max(1, rate/rate_0), the rate factor of Johnson and co-authors; 1 below the reference rate.
inline double logarithmic_rate_factor(double coefficient, double rate, double reference_rate) {
  if (coefficient == 0.0 || !(rate > reference_rate)) return 1.0;
  return 1.0 + coefficient * std::log(rate / reference_rate);
}

}  // namespace whipple::strength
