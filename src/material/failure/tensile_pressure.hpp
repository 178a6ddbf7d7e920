// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "src/material/failure/criterion.hpp"
#include "src/material/void_formulas.hpp"

namespace whipple::failure {

/// Selects the response of a point at the spall strength.
enum class SpallResponse : std::uint8_t { failure, opening, cut_off };
constexpr std::array<Word<SpallResponse>, 3> words(SpallResponse) {
  return {{{SpallResponse::failure, "failure"},
           {SpallResponse::opening, "opening"},
           {SpallResponse::cut_off, "cut_off"}}};
}

/// Spall at a constant tensile pressure p_cut (1 - f) k (Pa), with the melted fraction f and the scatter k of the
/// threshold; the tensile strength vanishes with the solid. The `response` is one of:
///   failure  p < -p_cut: the point fails permanently; it keeps its pressure, but neither tension nor deviator.
///            Fully melted material fails as soon as p < 0: it breaks into drops.
///   opening  as failure, but once pressure has closed its void the point is intact again: pressure, tension and,
///            from zero, the deviator.
///   cut_off  the pressure is held at -p_cut, the excess volume is void; the deviator is kept and nothing fails.
///            Compression closes the void first.
/// Source: D. R. Curran, L. Seaman, D. A. Shockey, Dynamic failure of solids, Phys. Rep. 147 (1987) 253-388, of which
/// the constant spall strength is the simplest form; the three responses are those of hydrocodes (J. O. Hallquist,
/// LS-DYNA Theory Manual (2006), spall models of material 10: cut-off, and zero deviator with tension no longer
/// allowed); the linear decrease with melting is this project's choice.
struct TensilePressure : Threshold {
  double spall_strength = 0.0;  ///< p_cut, Pa
  SpallResponse response = SpallResponse::failure;

  static ParameterTable<TensilePressure> parameters() {
    using P = TensilePressure;
    return {
        real("spall_strength", &P::spall_strength, "Pa", range::non_negative(),
             "tensile pressure p_cut at which the solid parts"),
        choice("response", &P::response,
               "what the point loses: tension and deviator permanently, both while it is open, or only the "
               "tension beyond p_cut")
            .optional()};
  }
  static constexpr const char* name = "tensile_pressure";
  static constexpr Code code = tensile;
  static constexpr const char* cause = "tension";
  static constexpr const char* summary = "spall: tensile pressure beyond the spall strength";
  static constexpr const char* theory =
      "At p < -p_cut, p_cut = spall_strength (1 - melted fraction) * scatter factor, the response is\n"
      "failure: fails (code 1) permanently, without tension and deviator;\n"
      "opening: the same, but healed once pressure has closed the void;\n"
      "cut_off: p = -p_cut, the deviator stays, nothing fails (a pressure cut-off that keeps the deviator).\n"
      "Source: Curran, Seaman and Shockey, Phys. Rep. 147 (1987) 253 (constant spall strength; linear loss "
      "with melting: own choice).";

  [[nodiscard]] bool cuts_off() const { return response == SpallResponse::cut_off; }
  [[nodiscard]] bool grows_voids() const { return cuts_off(); }
  [[nodiscard]] Code healing_code() const { return response == SpallResponse::opening ? tensile : intact; }

  void mark(const State& state, std::span<double> /*damage*/, std::span<std::uint8_t> failed) const {
    if (cuts_off()) return;
    for (std::size_t i = 0; i < failed.size(); ++i) {
      const double strength = spall_strength * (1.0 - state.melted_fraction[i]) * state.threshold_factor[i];
      if (failed[i] == intact && state.pressure[i] < -strength) failed[i] = tensile;
    }
  }
  /// Holds the pressure at the cut-off: the volume is divided into material and void so that p = -p_cut next to a void.
  void grow_voids(const PorousState& state, std::span<double> /*damage*/,
                  std::span<std::uint8_t> failed) const {
    for (std::size_t i = 0; i < failed.size(); ++i) {
      const double least = -spall_strength * (1.0 - state.melted_fraction[i]) * state.threshold_factor[i];
      const bool is_open = state.void_volume[i] > 0.0;
      if (failed[i] != intact || (!is_open && state.pressure[i] >= least)) continue;
      const material::formulas::PorousPoint<double> shared =
          material::formulas::share_volume<double>({state.pressure[i], state.volume[i], state.void_volume[i]},
                                                   state.bulk_modulus[i], 1.0, least)
              .point;
      state.pressure[i] = shared.pressure;
      state.volume[i] = shared.volume;
      state.void_volume[i] = shared.void_volume;
    }
  }
};

}  // namespace whipple::failure
