// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/material/strength/elastic_constants.hpp"
#include "src/material/strength/foam_model.hpp"

namespace whipple::strength {

/// Metal foam whose yield surface is an ellipse in q and p, with associated flow:
///   sqrt[(q^2 + a^2 p^2)/A] <= Y(e),  A = 1 + a^2/9,  a^2 = 9 (1/2 - nu_p)/(1 + nu_p)
///   Y = sigma_p + gamma z + alpha_2 ln[1/(1 - z^beta)],  z = e/e_D,  e_D = (9 + a^2)/(3 a^2) ln(rho_s/rho_f)
/// Source: V. S. Deshpande, N. A. Fleck, J. Mech. Phys. Solids 48 (2000) 1253; A. G. Hanssen, O. S. Hopperstad, M.
/// Langseth, H. Ilstad, Int. J. Mech. Sci. 44 (2002) 359. docs/theory/foam.md, section 1.
struct DeshpandeFleck : ElasticConstants {
  double relative_density = 0.0;        ///< rho_f/rho_s
  double plateau_stress = 0.0;          ///< sigma_p, Pa
  double linear_hardening = 0.0;        ///< gamma, Pa
  double densification_stress = 0.0;    ///< alpha_2, Pa
  double densification_exponent = 1.0;  ///< beta
  double plastic_poisson_ratio = 0.0;   ///< nu_p
  double solid_yield_stress = 0.0;      ///< Pa

  static ParameterTable<DeshpandeFleck> parameters();
  static constexpr const char* name = "deshpande_fleck";
  static constexpr const char* summary = "metal foam that is crushed to the solid (Deshpande and Fleck)";
  static constexpr const char* theory =
      "sqrt[(q^2 + a^2 p^2)/(1 + a^2/9)] <= Y(e), a^2 = 9 (1/2 - nu_p)/(1 + nu_p), associated flow;\n"
      "Y = sigma_p + gamma z + alpha_2 ln[1/(1 - z^beta)], z = e/e_D, e_D = (9 + a^2)/(3 a^2) "
      "ln(rho_s/rho_f).\n"
      "The equation of state is that of the solid; where the pores are closed q <= solid_yield_stress.\n"
      "Sources: Deshpande and Fleck, J. Mech. Phys. Solids 48 (2000) 1253; Hanssen et al., Int. J. Mech. "
      "Sci. 44 "
      "(2002) 359.";

  /// Returns a^2, the square of the shape of the ellipse.
  [[nodiscard]] double shape() const {
    return 9.0 * (0.5 - plastic_poisson_ratio) / (1.0 + plastic_poisson_ratio);
  }
  /// Returns e_D.
  [[nodiscard]] double densification_strain() const;
  /// Returns Y (Pa) at an equivalent plastic strain; beyond z = 1 - 1e-6 it stays, as the pores are closed by then.
  [[nodiscard]] double strength_at(double strain) const;
};

class DeshpandeFleckModel final : public FoamModel<DeshpandeFleck> {
 public:
  explicit DeshpandeFleckModel(const DeshpandeFleck& law);

  void crush(const FoamState& state) const override;
  /// Computes the flow stress in uniaxial compression without lateral stress.
  void flow_stress(const State& state, std::span<const double> rate, std::span<double> stress) const override;

 private:
  void flow(const FoamState& state, std::size_t i) const;
};

}  // namespace whipple::strength
