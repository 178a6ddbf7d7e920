// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/material/strength/elastic_constants.hpp"
#include "src/material/strength/foam_model.hpp"

namespace whipple::strength {

/// Foam that hardens with its compaction, whose yield surface is an ellipse in q and p between the pressures -p_t and p_c:
///   q^2 + a^2 (p - p_c) (p + p_t) <= 0,  a = 3 k/sqrt[(3 k_t + k) (3 - k)],  k = sigma_c/p_0,  k_t = p_t/p_0
///   p_c = p_0 + h z + b ln[1/(1 - z^m)],  z = 1 - ln(alpha)/ln(alpha_0) of the distension alpha
/// with sigma_c in uniaxial compression; flow is associated. Source: J. Zhang, N. Kikuchi, V. Li, A. Yee, G. Nusholtz, Int.
/// J. Impact Engng 21 (1998) 369, whose flow is not associated; see docs/theory/foam.md, section 4.
struct CrushableFoam : ElasticConstants {
  double relative_density = 0.0;        ///< rho_f/rho_s
  double hydrostatic_yield = 0.0;       ///< p_0, Pa
  double uniaxial_yield = 0.0;          ///< sigma_c of the foam as it is made, Pa
  double tensile_yield = 0.0;           ///< p_t, Pa
  double linear_hardening = 0.0;        ///< h, Pa
  double densification_stress = 0.0;    ///< b, Pa
  double densification_exponent = 1.0;  ///< m
  double solid_yield_stress = 0.0;      ///< Pa

  static ParameterTable<CrushableFoam> parameters();
  static constexpr const char* name = "crushable_foam";
  static constexpr const char* summary =
      "foam that hardens with its compaction, with a tensile strength of its own, and is crushed to the "
      "solid";
  static constexpr const char* theory =
      "q^2 + a^2 (p - p_c) (p + p_t) <= 0, a = 3 k/sqrt[(3 k_t + k) (3 - k)], k = sigma_c/p_0, k_t = "
      "p_t/p_0, "
      "associated flow;\n"
      "p_c = p_0 + h z + b ln[1/(1 - z^m)], z = 1 - ln(alpha)/ln(alpha_0) of the distension alpha.\n"
      "The equation of state is that of the solid; where the pores are closed q <= solid_yield_stress.\n"
      "Source: Zhang, Kikuchi, Li, Yee and Nusholtz, Int. J. Impact Engng 21 (1998) 369, with their flow not "
      "associated.";

  /// Returns a^2, the square of the shape of the ellipse.
  [[nodiscard]] double shape() const;
  /// Returns p_c (Pa) at a distension; it does not fall below p_0, nor rise beyond z = 1 - 1e-6.
  [[nodiscard]] double strength_at(double distension) const;
};

class CrushableFoamModel final : public FoamModel<CrushableFoam> {
 public:
  /// @throws InputError if the constants are inconsistent
  explicit CrushableFoamModel(const CrushableFoam& law);

  void crush(const FoamState& state) const override;
  /// Computes the flow stress in uniaxial compression of foam that has not been compacted.
  void flow_stress(const State& state, std::span<const double> rate, std::span<double> stress) const override;

 private:
  void flow(const FoamState& state, std::size_t i) const;

  double shape_;
};

}  // namespace whipple::strength
