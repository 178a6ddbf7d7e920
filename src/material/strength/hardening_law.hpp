// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/material/strength/elastic_constants.hpp"
#include "src/material/strength/flow_law_model.hpp"
#include "src/material/strength/radial_return.hpp"

namespace whipple::strength {

/// Common part of the von Mises models whose isotropic hardening depends on the plastic strain alone: elastic
/// constants, initial yield stress and linear kinematic hardening. The yield surface moves with the back stress,
///   sqrt(3/2 (s - a):(s - a)) = Y(ep),  da = 2/3 H d(plastic strain),
/// W. Prager, Proc. Inst. Mech. Eng. 169 (1955) 41; for this surface H. Ziegler's rule, Quart. Appl. Math. 17 (1959)
/// 55, is equivalent. A law derives from HardeningLaw<Law> and has flow(plastic_strain) -> FlowStress.
template <class Law>                      // an aggregate, as its laws are
struct HardeningLaw : ElasticConstants {  // NOLINT(bugprone-crtp-constructor-accessibility)
  double yield_stress = 0.0;              ///< A, Pa
  double kinematic_modulus = 0.0;         ///< H, Pa

  static ParameterTable<Law> parameters(const ParameterTable<Law>& own) {
    ParameterTable<Law> table = {
        real<Law>("yield_stress", &Law::yield_stress, "Pa", range::positive(), "initial yield stress A")};
    table.append(own);
    table.push_back(real<Law>("kinematic_modulus", &Law::kinematic_modulus, "Pa", range::non_negative(),
                              "H: slope of the back stress over plastic strain in uniaxial tension")
                        .optional());
    return ElasticConstants::parameters<Law>(table);
  }
  void require_consistent() const {}  // ensured by the ranges of the constants

  [[nodiscard]] double flow_stress(double strain, double /*rate*/ = 0.0, double /*temperature*/ = 0.0) const {
    return law().flow(strain).value;
  }
  [[nodiscard]] double increment(double trial, double strain, double /*temperature*/, double modulus,
                                 double solid, double /*dt*/) const {
    return radial_return(trial, modulus, solid, law().flow(strain).value,
                         [&](double x) { return law().flow(strain + x); });
  }

 private:
  [[nodiscard]] const Law& law() const { return static_cast<const Law&>(*this); }
};

}  // namespace whipple::strength
