// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "src/case/section.hpp"
#include "src/material/material.hpp"

namespace whipple::cases {

/// `initial` of a body: at most two of pressure, temperature and density; infinite: not given.
struct InitialState {
  double pressure = std::numeric_limits<double>::infinity();     ///< Pa
  double temperature = std::numeric_limits<double>::infinity();  ///< K
  double density = std::numeric_limits<double>::infinity();      ///< kg/m^3
  static ParameterTable<InitialState> parameters();

  [[nodiscard]] bool given() const;
  /// @throws InputError if the material has no such state, or if too much is given
  [[nodiscard]] eos::State of(const Material& material) const;
};

/// How the failed material of a body parts.
enum class CrackMotion : std::uint8_t {
  none,    ///< it stays in the one velocity field of the body
  fields,  ///< with a velocity field on either side of a crack (docs/theory/cracks.md)
};
constexpr std::array<Word<CrackMotion>, 2> words(CrackMotion) {
  return {{{CrackMotion::none, "none"}, {CrackMotion::fields, "fields"}}};
}

/// `failure` of a body.
struct Failure {
  CrackMotion cracks = CrackMotion::none;
  static ParameterTable<Failure> parameters();
  [[nodiscard]] bool given() const { return cracks != CrackMotion::none; }
};

/// `failure_scatter` of a body: Weibull distribution of the failure thresholds of its particles
/// (docs/theory/material.md, eq. 23).
struct FailureScatter {
  double weibull_modulus = std::numeric_limits<double>::infinity();  ///< m; infinite: no scatter
  std::int64_t seed = 0;
  double reference_volume = std::numeric_limits<double>::infinity();  ///< m^3; infinite: no effect of size
  static ParameterTable<FailureScatter> parameters();

  [[nodiscard]] bool given() const;
  /// Factor of the thresholds of a particle; the same for a seed and an id wherever it is computed.
  [[nodiscard]] double factor(std::uint64_t id, double volume) const;
};

}  // namespace whipple::cases
