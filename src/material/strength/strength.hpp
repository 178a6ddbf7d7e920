// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace whipple::strength {

/// Holds the variables of strength models at the beginning of the step (SI units), one entry per point of a chunk.
struct State {
  std::span<const double> density;         ///< kg/m^3
  std::span<const double> pressure;        ///< positive in compression, Pa
  std::span<const double> temperature;     ///< K
  std::span<const double> plastic_strain;  ///< equivalent plastic strain
  std::span<const double> threshold = {};  ///< Pa, of models with an `initial_threshold`; not read by others

  [[nodiscard]] std::size_t size() const { return density.size(); }
};

class Brittle;

/// Interface of the strength models, with one virtual call per chunk of points, never per point. Every model is
/// isotropic with a von Mises surface, so that a step is a radial return (docs/theory/material.md, eq. 7): the
/// equivalent trial stress q and the flow stress Y determine the increment of the equivalent plastic strain.
class Strength {
 public:
  virtual ~Strength() = default;

  [[nodiscard]] virtual std::string_view model() const = 0;

  /// Returns false for material without deviatoric stress: the update skips strain and return.
  [[nodiscard]] virtual bool carries_deviator() const { return true; }

  /// Returns the slope H of the back stress over the plastic strain in uniaxial tension (Pa), for linear kinematic
  /// hardening; 0: none (docs/theory/material.md, eq. 16).
  [[nodiscard]] virtual double kinematic_modulus() const { return 0.0; }

  /// Returns the threshold stress (Pa) of an undisturbed point, for a model whose hardening is a separate state that
  /// depends on the history of rate and temperature (docs/theory/material.md, eq. 31); none: hardening depends on the
  /// plastic strain alone.
  [[nodiscard]] virtual std::optional<double> initial_threshold() const { return std::nullopt; }
  /// Advances the threshold stress over the increments that `plastic_increment` computed from the same state.
  virtual void advance_threshold(const State& /*state*/, std::span<const double> /*increment*/, double /*dt*/,
                                 std::span<double> /*threshold*/) const {}

  /// Returns the viscosity of a fluid without deviatoric strength (Pa s): s = 2 eta dev D; 0: none.
  [[nodiscard]] virtual double viscosity() const { return 0.0; }

  /// Returns the part of a brittle model that acts after the pressure of the step is known
  /// (strength/brittle.hpp); null if there is none.
  [[nodiscard]] virtual const Brittle* brittle() const { return nullptr; }

  /// Computes the shear modulus of the solid (Pa); the caller applies the loss by melting.
  virtual void shear_modulus(const State& state, std::span<double> modulus) const = 0;

  /// Solves q - 3 G x - w Y(ep + x, x / dt, T) = 0 for the increment x >= 0 of the equivalent plastic strain (0 where q
  /// <= w Y at x = 0). Bounded work, no allocation, no exceptions.
  /// @param trial           q, equivalent trial stress, Pa
  /// @param modulus         G, shear modulus with melting, Pa, > 0 where the point carries a deviator
  /// @param solid_fraction  w, fraction of the strength that the point retains after melting, damage and failure
  /// @param dt              time step, s
  virtual void plastic_increment(const State& state, std::span<const double> trial,
                                 std::span<const double> modulus, std::span<const double> solid_fraction,
                                 double dt, std::span<double> increment) const = 0;

  /// Computes the flow stress of the solid (Pa) at rates of the equivalent plastic strain (1/s).
  virtual void flow_stress(const State& state, std::span<const double> rate,
                           std::span<double> stress) const = 0;

  /// Returns all constants with units as TOML lines (provenance in output files).
  [[nodiscard]] virtual std::string constants() const = 0;
};

}  // namespace whipple::strength
