// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "src/case/section.hpp"
#include "src/material/material.hpp"

namespace whipple::cases {

/// Describes `initial.lithostatic` of a body: the stress of material that was deposited under its own weight.
struct Lithostatic {
  double surface = 0.0;  ///< height of the free surface against gravity, coordinate along its axis, m
  double k0 = 1.0;       ///< horizontal over vertical stress
  static ParameterTable<Lithostatic> parameters();
};

/// Describes `initial` of a body: at most two of pressure, temperature and density; infinite: not given.
struct InitialState {
  double pressure = std::numeric_limits<double>::infinity();     ///< Pa
  double temperature = std::numeric_limits<double>::infinity();  ///< K
  double density = std::numeric_limits<double>::infinity();      ///< kg/m^3
  std::optional<Lithostatic> lithostatic;
  static ParameterTable<InitialState> parameters();
  static std::span<const Section<InitialState>> sections();

  [[nodiscard]] bool given() const { return gives_state() || lithostatic.has_value(); }
  /// Returns whether pressure, temperature or density are given.
  [[nodiscard]] bool gives_state() const;
  /// Returns the initial state. @throws InputError if the material has no such state, or if too many quantities are
  /// given
  [[nodiscard]] eos::State of(const Material& material) const;
};

/// Selects how failed material of a body separates.
enum class CrackMotion : std::uint8_t {
  none,    ///< it remains in the single velocity field of the body
  fields,  ///< with a separate velocity field on either side of a crack (docs/theory/cracks.md)
};
constexpr std::array<Word<CrackMotion>, 2> words(CrackMotion) {
  return {{{CrackMotion::none, "none"}, {CrackMotion::fields, "fields"}}};
}

/// Describes `failure` of a body.
struct Failure {
  CrackMotion cracks = CrackMotion::none;
  static ParameterTable<Failure> parameters();
  [[nodiscard]] bool given() const { return cracks != CrackMotion::none; }
};

/// Describes `failure_scatter` of a body: Weibull distribution of the failure thresholds of its particles
/// (docs/theory/material.md, eq. 23).
struct FailureScatter {
  double weibull_modulus = std::numeric_limits<double>::infinity();  ///< m; infinite: no scatter
  std::int64_t seed = 0;
  double reference_volume = std::numeric_limits<double>::infinity();  ///< m^3; infinite: no size effect
  static ParameterTable<FailureScatter> parameters();

  [[nodiscard]] bool given() const;
  /// Returns the factor of the thresholds of a particle, which depends only on its arguments and the parameters.
  [[nodiscard]] double factor(std::uint64_t id, double volume) const;
};

/// Describes `strength_scatter` of a body: factors of the flow stress of its particles, uniform between `least` and 1
/// (docs/theory/material.md, eq. 23b).
struct StrengthScatter {
  double least = 1.0;  ///< 1: no scatter
  std::int64_t seed = 0;
  static ParameterTable<StrengthScatter> parameters();

  [[nodiscard]] bool given() const { return least < 1.0; }
  /// Returns the factor of a particle, which depends only on its number and the parameters.
  [[nodiscard]] double factor(std::uint64_t id) const;
};

}  // namespace whipple::cases
