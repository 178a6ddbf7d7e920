// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "src/core/base/parameter_table.hpp"
#include "src/core/base/tensor.hpp"
#include "src/material/failure/code.hpp"

namespace whipple::failure {

/// Holds the components xx, yy, zz, xy, yz, zx of a symmetric tensor, one entry per point.
template <class Number>
struct Components {
  std::array<std::span<Number>, 6> lane;

  [[nodiscard]] SymmetricTensor operator[](std::size_t i) const {
    return {lane[0][i], lane[1][i], lane[2][i], lane[3][i], lane[4][i], lane[5][i]};
  }
};

/// Holds the state of a chunk of points after the equation of state (SI units), one entry per point.
struct State {
  double time_step;                           ///< s
  std::span<const double> pressure;           ///< acting pressure, positive in compression, Pa
  std::span<const double> temperature;        ///< K
  std::span<const double> density;            ///< of the material, kg/m^3
  std::span<const double> bulk_modulus;       ///< rho c^2, Pa
  std::span<const double> shear_modulus;      ///< of the solid, Pa
  std::span<const double> volume;             ///< of material and void, m^3
  std::span<const double> band;               ///< width to which strain localises, m: a cell, an element
  std::span<const double> plastic_strain;     ///< equivalent plastic strain
  std::span<const double> plastic_increment;  ///< its increment in this step
  std::span<const double> melted_fraction;    ///< mass fraction of liquid and vapour
  std::span<const double> threshold_factor;   ///< scatter of the failure threshold (1: none)
  Components<const double> deviator;          ///< positive in tension, Pa
  Components<const double> strain;            ///< logarithmic strain; empty unless a criterion needs it
};

/// Holds a chunk of points between the equation of state and the criteria, for models in which voids grow while the
/// material still carries stress (SI units). Volume and stress are those of the material between the voids.
struct PorousState {
  double time_step;                         ///< s
  std::span<const double> bulk_modulus;     ///< rho c^2, Pa
  std::span<const double> shear_modulus;    ///< with melting, Pa
  std::span<const double> melted_fraction;  ///< mass fraction of liquid and vapour
  /// Flow stress of the material between the voids, with melting, Pa; only if needed.
  std::span<const double> flow_stress;
  std::span<const double> trial;             ///< equivalent trial stress of the deviator, Pa
  std::span<const double> threshold_factor;  ///< scatter of the failure threshold (1: none)
  std::span<double> equivalent;              ///< equivalent stress, Pa; in and out
  std::span<double> pressure;                ///< Pa; in and out
  std::span<double> plastic_increment;       ///< in: of material without voids; out: with voids
  std::span<double> plastic_strain;          ///< in: including that increment; out: with voids
  std::span<double> volume;                  ///< of the material, m^3; in and out
  std::span<double> void_volume;             ///< m^3; in and out
};

/// Interface of the failure criteria, with one virtual call per chunk. A failed point remains failed, unless the
/// criterion heals.
class Criterion {
 public:
  virtual ~Criterion() = default;
  [[nodiscard]] virtual std::string_view model() const = 0;
  /// Advances the damage of the points and sets the code of intact points that meet the criterion.
  /// @param damage  history field `damage`; only criteria that accumulate change it
  virtual void mark(const State& state, std::span<double> damage, std::span<std::uint8_t> failed) const = 0;
  /// Grows voids and relaxes the stress of the material between them; sets damage and code.
  virtual void grow_voids(const PorousState& /*state*/, std::span<double> /*damage*/,
                          std::span<std::uint8_t> /*failed*/) const {}
  /// Returns whether `grow_voids` has any effect.
  [[nodiscard]] virtual bool grows_voids() const { return false; }
  /// Returns whether `grow_voids` returns the deviator to the criterion's yield surface, using the flow stress of the
  /// material.
  [[nodiscard]] virtual bool returns_deviator() const { return false; }
  /// Returns the code that is reset once pressure has closed the void of a point; `intact`: points remain failed.
  [[nodiscard]] virtual Code healing_code() const { return intact; }
  /// Returns the initial volume fraction of the voids.
  [[nodiscard]] virtual double initial_porosity() const { return 0.0; }
  /// Returns whether the criterion stores its past in the history field `damage`. At most one criterion of a material
  /// may.
  [[nodiscard]] virtual bool accumulates() const { return false; }
  /// Returns whether the damage reduces the stress before it is complete (docs/theory/material.md, eq. 18, 19).
  [[nodiscard]] virtual bool softens() const { return false; }
  /// Returns whether the criterion needs `State::strain`.
  [[nodiscard]] virtual bool needs_strain() const { return false; }
  /// Returns all constants with units as TOML lines (provenance in output files).
  [[nodiscard]] virtual std::string constants() const = 0;
};

/// Implements the interface of the criteria for a law, a plain struct of constants with
///   name, summary, theory, parameters()                        for the catalogue
///   accumulates, softens, needs_strain                         static constexpr bool, see Criterion
///   mark(state, damage, failed), grow_voids(state, damage, failed), or both: see Criterion
///   require_consistent()                                       throws InputError
/// and, for laws with voids that differ from the defaults of Criterion,
///   grows_voids(), healing_code(), initial_porosity, returns_deviator
template <class Law>
class CriterionModel final : public Criterion {
 public:
  /// @throws InputError if the constants are inconsistent
  explicit CriterionModel(const Law& law) : law_(law) { law_.require_consistent(); }
  [[nodiscard]] const Law& law() const { return law_; }
  [[nodiscard]] std::string_view model() const override { return Law::name; }
  void mark(const State& state, std::span<double> damage, std::span<std::uint8_t> failed) const override {
    if constexpr (requires { law_.mark(state, damage, failed); }) law_.mark(state, damage, failed);
  }
  void grow_voids(const PorousState& state, std::span<double> damage,
                  std::span<std::uint8_t> failed) const override {
    if constexpr (requires { law_.grow_voids(state, damage, failed); }) {
      law_.grow_voids(state, damage, failed);
    }
  }
  [[nodiscard]] bool grows_voids() const override {
    if constexpr (requires { law_.grows_voids(); }) return law_.grows_voids();
    return requires(const PorousState& state, std::span<double> damage, std::span<std::uint8_t> failed) {
      law_.grow_voids(state, damage, failed);
    };
  }
  [[nodiscard]] bool returns_deviator() const override {
    return requires { Law::returns_deviator; };
  }
  [[nodiscard]] Code healing_code() const override {
    if constexpr (requires { law_.healing_code(); }) return law_.healing_code();
    return intact;
  }
  [[nodiscard]] double initial_porosity() const override {
    if constexpr (requires { law_.initial_porosity; }) return law_.initial_porosity;
    return 0.0;
  }
  [[nodiscard]] bool accumulates() const override { return Law::accumulates; }
  [[nodiscard]] bool softens() const override { return Law::softens; }
  [[nodiscard]] bool needs_strain() const override { return Law::needs_strain; }
  [[nodiscard]] std::string constants() const override {
    Law copy = law_;
    return fmt::format("model = \"{}\"\n{}", Law::name, to_toml(whipple::bind(Law::parameters(), copy)));
  }

 private:
  Law law_;
};

/// Provides the defaults of a law that is a threshold of the present state.
struct Threshold {
  static constexpr bool accumulates = false;
  static constexpr bool softens = false;
  static constexpr bool needs_strain = false;
  void require_consistent() const {}  // ensured by the ranges of the constants
};

}  // namespace whipple::failure
