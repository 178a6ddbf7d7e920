// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "eos/modifiers/modified.hpp"

namespace whipple::eos {

/// Specifies the crush curve alpha(p) above p_e.
enum class CompactionCurve : std::uint8_t { quadratic, power, exponential };
constexpr std::array<Word<CompactionCurve>, 3> words(CompactionCurve) {
  return {{{CompactionCurve::quadratic, "quadratic"},
           {CompactionCurve::power, "power"},
           {CompactionCurve::exponential, "exponential"}}};
}

struct PAlphaConstants {
  double distension = 0;        ///< alpha0 = rho_s/rho of the material at rest, > 1
  double elastic_pressure = 0;  ///< p_e, Pa
  CompactionCurve compaction = CompactionCurve::quadratic;
  double solid_pressure = 0;       ///< p_s, Pa (quadratic, power)
  double compaction_exponent = 0;  ///< n (power)
  double compaction_rate = 0;      ///< 1/Pa (exponential)
};

/// Models porous material after Herrmann, J. Appl. Phys. 40, 2490 (1969), with the pressure of the matrix divided
/// by the distension (Carroll and Holt, J. Appl. Phys. 43, 759, 1972): alpha = V/V_s,
///   p(rho, e, alpha) = p_s(alpha rho, e)/alpha.
/// The distension is constant while p is below the crush curve and follows it in further loading, permanently:
///   quadratic:    alpha = 1 + (alpha0 - 1) [(p_s - p)/(p_s - p_e)]^2,  p_e < p < p_s;
///   power:        the same with an exponent n for 2 (Borrvall and Riedel, 8th European LS-DYNA Conf., 2011);
///   exponential:  alpha = 1 + (alpha0 - 1) exp[-rate (p - p_e)] (Boade, J. Appl. Phys. 39, 5693, 1968), ended
///                 at 1e-6 (alpha0 - 1).
/// The energy is that of the matrix (pores have none). States without history are on the virgin path: loaded once,
/// from alpha0. Sound speed, Gamma, K_T and heat capacities are those of unloading (constant alpha); loading with
/// crushing is slower. There is no vapour dome, which would be that of the matrix.
class PAlpha final : public Modified {
 public:
  using Constants = PAlphaConstants;
  static constexpr std::string_view name = "p_alpha";
  static constexpr std::string_view summary =
      "porous material that is crushed permanently (Herrmann's P-alpha model)";
  static ParameterTable<Constants> parameters();

  /// @throws InputError for constants that contradict each other, or a base that already has pores
  PAlpha(std::shared_ptr<const EquationOfState> base, const Constants& constants);

  [[nodiscard]] double reference_density() const override {
    return base().reference_density() / constants_.distension;
  }
  [[nodiscard]] double minimum_energy(double density) const override {
    return state_at_temperature(density, least_temperature()).specific_internal_energy;
  }
  /// Adds the cost of finding the root on the crush curve.
  [[nodiscard]] double relative_cost() const override { return base().relative_cost() + 11.0; }
  [[nodiscard]] double initial_distension() const override { return constants_.distension; }
  [[nodiscard]] const VapourDome* vapour_dome() const override { return nullptr; }
  RangeReport evaluate(const Batch& batch) const override;
  [[nodiscard]] State state(double density, double specific_internal_energy) const override;
  [[nodiscard]] State state_at_temperature(double density, double temperature) const override;
  [[nodiscard]] std::unique_ptr<EquationOfState> unloading(const State& from) const override;
  [[nodiscard]] std::string constants() const override { return constants_with_table<PAlpha>(constants_); }

  void crush_pressure(std::span<const double> distension, std::span<double> pressure) const override {
    for (std::size_t i = 0; i < distension.size(); ++i) {
      pressure[i] =
          distension[i] > 1 ? crush_pressure(distension[i]) : std::numeric_limits<double>::infinity();
    }
  }

  /// Evaluates the crush curve; the next function is its inverse (Pa).
  [[nodiscard]] double distension_at(double pressure) const;
  [[nodiscard]] double crush_pressure(double distension) const;
  /// Returns the pressure at which the pores are closed (Pa).
  [[nodiscard]] double closing_pressure() const { return closing_pressure_; }

 private:
  template <class MatrixPressure>
  [[nodiscard]] double crushed(double density, double distension,
                               const MatrixPressure& matrix_pressure) const;
  template <class MatrixState>
  [[nodiscard]] State virgin(double density, const MatrixState& matrix_state) const;

  Constants constants_;
  double exponent_ = 0;  ///< of the power-law curves; 0: exponential
  double closing_pressure_ = 0;
};

}  // namespace whipple::eos
