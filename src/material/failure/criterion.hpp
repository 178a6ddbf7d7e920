// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace whipple::failure {

/// Values of `MaterialPoints::failed`.
enum Code : std::uint8_t { intact = 0, tensile = 1, plastic = 2 };

/// State of a chunk of points after the equation of state (SI), one entry per point.
struct State {
  std::span<const double> pressure;          ///< Pa, positive in compression, of the equation of state
  std::span<const double> plastic_strain;    ///< equivalent plastic strain
  std::span<const double> melted_fraction;   ///< mass fraction of liquid and vapour
  std::span<const double> threshold_factor;  ///< scatter of the failure threshold (1: none)
};

/// A failure criterion; one virtual call per chunk. A failed point stays failed.
class Criterion {
 public:
  virtual ~Criterion() = default;
  [[nodiscard]] virtual std::string_view model() const = 0;
  /// Sets the code of the points that are intact and break the criterion.
  virtual void mark(const State& state, std::span<std::uint8_t> failed) const = 0;
  /// All constants with units as TOML lines (provenance in output files).
  [[nodiscard]] virtual std::string constants() const = 0;
};

}  // namespace whipple::failure
