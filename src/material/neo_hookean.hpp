// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/base/parameter_table.hpp"
#include "src/material/common.hpp"
#include "src/material/constitutive.hpp"

namespace whipple::material {

/// Compressible neo-Hookean solid (rubber): free energy of the equation of state plus that of an isochoric deformation,
/// psi = psi_eos(rho, T) + G / (2 rho0) (tr b' - 3), b' = J^(-2/3) F F^T (docs/theory/material.md, section 12). Source:
/// J. Bonet, R. D. Wood, Nonlinear Continuum Mechanics for Finite Element Analysis (Cambridge 2008), sec. 6.5.2.
struct NeoHookean {
  double shear_modulus = 0.0;  ///< G, Pa

  static ParameterTable<NeoHookean> parameters() {
    return {real("shear_modulus", &NeoHookean::shear_modulus, "Pa", range::positive(),
                 "shear modulus G of small strains")};
  }
  static constexpr const char* name = "neo_hookean";
  static constexpr const char* summary = "compressible neo-Hookean solid (rubber), no dissipation";
  static constexpr const char* theory =
      "s = G rho/rho0 dev b', b' = J^(-2/3) F F^T; pressure and thermal energy of the equation of state, "
      "whose energy\n"
      "is that of the point less G/(2 rho0) (tr b' - 3). The bulk modulus is that of the equation of state.\n"
      "Source: Bonet and Wood, Nonlinear Continuum Mechanics for Finite Element Analysis (2008), sec. 6.5.2.";
};

class NeoHookeanModel final : public Constitutive {
 public:
  using Constants = NeoHookean;
  static std::vector<HistoryField> fields() {
    return {{"deformation_gradient", "1", "deformation since the start, xx xy xz yx yy yz zx zy zz",
             Rank::tensor, Convection::deformed, 1.0}};
  }

  explicit NeoHookeanModel(const NeoHookean& constants)
      : constants_(constants), deformation_(declare(fields().front())) {}
  [[nodiscard]] std::string_view model() const override { return NeoHookean::name; }
  [[nodiscard]] std::string constants(const Material&) const override {
    NeoHookean copy = constants_;
    return fmt::format("\n[constitutive]\nmodel = \"{}\"\n{}", NeoHookean::name,
                       to_toml(whipple::bind(NeoHookean::parameters(), copy)));
  }
  [[nodiscard]] std::shared_ptr<const Constitutive> adapted(const Material& material) const override {
    if (material.eos->has_phases() || material.eos->initial_distension() > 1.0) {
      throw InputError(
          "constitutive model \"neo_hookean\" takes an equation of state without phases and pores");
    }
    return std::make_shared<const NeoHookeanModel>(constants_);
  }
  [[nodiscard]] double sound_speed(const Material&, const eos::State& state) const override {
    return std::sqrt(state.sound_speed * state.sound_speed +
                     5.0 / 3.0 * constants_.shear_modulus / state.density);
  }
  void update(const Step& in, Chunk& out) const override {
    const double least = 0.01 * in.material.reference.sound_speed * in.material.reference.sound_speed;
    Lanes stiffness;
    stress(in, out, stiffness);
    solve_energy(in, out);
    for (std::size_t k = 0; k < out.size; ++k) {
      const double bulk = std::max(out.bulk_sound_speed[k] * out.bulk_sound_speed[k], least);
      const double shear = stiffness[k] / out.density[k];  // G rho/rho0 tr b'; bounds of both waves (eq. 29)
      out.sound_speed[k] = std::sqrt(std::max(bulk + 5.0 / 9.0 * shear, shear));
    }
  }

 private:
  /// Computes the deviator, the elastic energy, and G rho/rho0 tr b' (Pa).
  void stress(const Step& in, Chunk& out, Lanes& stiffness) const {
    const std::span<const Lanes, 9> f = out.field<9>(deformation_);
    SymmetricLanes& s = out.motion.deviator;
    const double per_density = constants_.shear_modulus / in.material.reference.density;
    for (std::size_t k = 0; k < out.size; ++k) {
      const auto product = [&](std::size_t i,
                               std::size_t j) {  // of the rows i and j of F: component ij of F F^T
        return f[3 * i][k] * f[3 * j][k] + f[3 * i + 1][k] * f[3 * j + 1][k] +
               f[3 * i + 2][k] * f[3 * j + 2][k];
      };
      const double determinant = f[0][k] * (f[4][k] * f[8][k] - f[5][k] * f[7][k]) -
                                 f[1][k] * (f[3][k] * f[8][k] - f[5][k] * f[6][k]) +
                                 f[2][k] * (f[3][k] * f[7][k] - f[4][k] * f[6][k]);
      const double isochoric = 1.0 / std::cbrt(determinant * determinant);
      const std::array b = {isochoric * product(0, 0), isochoric * product(1, 1), isochoric * product(2, 2),
                            isochoric * product(0, 1), isochoric * product(1, 2), isochoric * product(2, 0)};
      const double trace = b[0] + b[1] + b[2], modulus = per_density * out.density[k];
      for (std::size_t j = 0; j < 6; ++j) s[j][k] = modulus * (b[j] - (j < 3 ? trace / 3.0 : 0.0));
      out.elastic_energy[k] = 0.5 * modulus * (trace - 3.0);
      stiffness[k] = modulus * trace;
    }
  }

  NeoHookean constants_;
  std::size_t deformation_;  ///< first lane of the field
};

}  // namespace whipple::material
