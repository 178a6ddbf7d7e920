// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "src/material/strength/brittle.hpp"
#include "src/material/strength/dilatant.hpp"

namespace whipple::strength {

/// Mohr-Coulomb, soil: a pyramid around the axis of hydrostatic pressure,
///   f = (s1 - s3) + (s1 + s3) sin(phi) - 2 c cos(phi) <= 0,   s1 >= s2 >= s3, tension positive,
///   p >= p_min = -min(sigma_t, c cot(phi)).
/// Source: C. A. Coulomb, Mem. Acad. R. Sci. 7 (1776) 343; O. Mohr, Z. Ver. Dtsch. Ing. 44 (1900) 1524.
/// docs/theory/soil.md, sections 2 and 3.
struct MohrCoulomb : Dilatant {
  static ParameterTable<MohrCoulomb> parameters() {
    return Dilatant::parameters<MohrCoulomb>({}, "the apex of the pyramid");
  }
  static constexpr const char* name = "mohr_coulomb";
  static constexpr const char* summary = "soil: friction, cohesion and dilation on a pyramid (Mohr-Coulomb)";
  static constexpr const char* theory =
      "(s1 - s3) + (s1 + s3) sin(phi) <= 2 c cos(phi), p >= -min(sigma_t, c cot(phi)): a gap opens. The "
      "return is "
      "exact, on the faces and the edges of the pyramid.\n"
      "Flow changes the plastic volume ratio J_p by d(ln J_p) = 2 sin(psi) (1 - ln J_p/maximum_dilation) dx "
      "for each face, dx half the difference of its plastic strains at psi = 0.\n"
      "Sources: Coulomb (1776); Mohr, Z. Ver. Dtsch. Ing. 44 (1900) 1524.";

  [[nodiscard]] double least_pressure() const {
    return -std::min(tensile_strength, cohesion / std::tan(friction_angle));
  }
};

/// Holds principal stresses in descending order, tension positive, Pa.
using PrincipalStress = std::array<double, 3>;

/// Describes the pyramid and the flow on it.
struct Pyramid {
  double sine;       ///< sin(phi)
  double dilation;   ///< sin(psi) of the flow on each face
  double intercept;  ///< 2 c cos(phi), Pa

  /// Returns f of the face between the stresses i and j.
  [[nodiscard]] double excess(double greater, double less) const {
    return greater - less + (greater + less) * sine - intercept;
  }
};

/// Returns principal stresses to the pyramid along the elastic response to its flow: on a face, on one of the two edges
/// of it, or at the apex (docs/theory/soil.md, equations 4 to 6). With psi = phi this is the closest point in the energy
/// norm; with psi = 0 the mean stress does not change, and must not be beyond the apex.
inline PrincipalStress return_to(const Pyramid& pyramid, double bulk, double shear,
                                 const PrincipalStress& trial) {
  const double sine = pyramid.sine, psi = pyramid.dilation;
  const double excess = pyramid.excess(trial[0], trial[2]);
  if (!(excess > 0.0)) return trial;
  const double greatest =
      2.0 * shear * (1.0 + psi / 3.0) + 2.0 * bulk * psi;  // falls, of the greater stress of a face
  const double least = 2.0 * shear * (1.0 - psi / 3.0) - 2.0 * bulk * psi;  // rises, of the lesser
  const double middle = (4.0 / 3.0 * shear - 2.0 * bulk) * psi;             // rises, of the third
  const double own = 4.0 * shear * (1.0 + sine * psi / 3.0) + 4.0 * bulk * sine * psi;
  double x = excess / own;
  PrincipalStress s = {trial[0] - greatest * x, trial[1] + middle * x, trial[2] + least * x};
  if (s[0] >= s[1] && s[1] >= s[2]) return s;
  const bool at_greater = s[1] > s[0];  // the edge of two equal greater stresses, or of two equal lesser ones
  const double other = at_greater
                           ? 2.0 * shear * (1.0 - sine - psi - sine * psi / 3.0) + 4.0 * bulk * sine * psi
                           : 2.0 * shear * (1.0 + sine + psi - sine * psi / 3.0) + 4.0 * bulk * sine * psi;
  const double beside = at_greater ? pyramid.excess(trial[1], trial[2]) : pyramid.excess(trial[0], trial[1]);
  const double determinant = own * own - other * other;
  x = (own * excess - other * beside) / determinant;
  const double y = (own * beside - other * excess) / determinant;
  s = at_greater ? PrincipalStress{trial[0] - greatest * x + middle * y, trial[1] + middle * x - greatest * y,
                                   trial[2] + least * (x + y)}
                 : PrincipalStress{trial[0] - greatest * (x + y), trial[1] + middle * x + least * y,
                                   trial[2] + least * x + middle * y};
  const double apex = pyramid.intercept / (2.0 * sine);
  const double mean = (s[0] + s[1] + s[2]) / 3.0;
  // Without dilation the mean is that of the trial and decides alone. With it x or y is clearly negative beyond the apex;
  // at the border of an edge they are so by round-off.
  constexpr double round_off = 1e-12;
  const bool leaves_edge = psi > 0.0 && std::min(x, y) < -round_off * std::max(x, y);
  if (leaves_edge || mean > apex) return {apex, apex, apex};
  return s;
}

/// Implements the interfaces for the pyramid.
class MohrCoulombModel final : public Strength, public Brittle {
 public:
  /// @throws InputError if the constants are inconsistent
  explicit MohrCoulombModel(const MohrCoulomb& law)
      : law_(law),
        modulus_(law.stiffness()),
        pyramid_{std::sin(law.friction_angle), std::sin(law.dilation_angle),
                 2.0 * law.cohesion * std::cos(law.friction_angle)} {
    law.require_consistent();
  }

  [[nodiscard]] const MohrCoulomb& law() const { return law_; }
  [[nodiscard]] std::string_view model() const override { return MohrCoulomb::name; }
  [[nodiscard]] const Brittle* brittle() const override { return this; }
  void shear_modulus(const State&, std::span<double> modulus) const override {
    std::ranges::fill(modulus, modulus_);
  }
  /// Returns no increment: the pressure is not yet known, and the trial deviator is passed to `relax`.
  void plastic_increment(const State&, std::span<const double>, std::span<const double>,
                         std::span<const double>, double, std::span<double> increment) const override {
    std::ranges::fill(increment, 0.0);
  }
  /// Computes the equivalent stress at failure in triaxial compression.
  void flow_stress(const State& state, std::span<const double>, std::span<double> stress) const override {
    const double slope = 6.0 * pyramid_.sine / (3.0 - pyramid_.sine);
    const double at_rest = 3.0 * pyramid_.intercept / (3.0 - pyramid_.sine);
    for (std::size_t i = 0; i < stress.size(); ++i) {
      stress[i] = std::max(at_rest + slope * state.pressure[i], 0.0);
    }
  }
  [[nodiscard]] bool turns_deviator() const override { return true; }
  void relax(const BrittleState& state) const override;
  [[nodiscard]] bool dilates() const override { return law_.changes_volume(); }
  [[nodiscard]] double greatest_distension() const override {
    return dilates() ? std::exp(law_.maximum_dilation) : 1.0;
  }
  void dilate(const DilationState& state) const override;
  [[nodiscard]] std::string constants() const override {
    MohrCoulomb copy = law_;
    return fmt::format("model = \"{}\"\n{}", MohrCoulomb::name,
                       to_toml(whipple::bind(MohrCoulomb::parameters(), copy)));
  }

 private:
  /// Returns the pyramid with a fraction of its dilation.
  [[nodiscard]] Pyramid with_dilation(double fraction) const {
    return {pyramid_.sine, pyramid_.dilation * fraction, pyramid_.intercept};
  }

  MohrCoulomb law_;
  double modulus_;
  Pyramid pyramid_;
};

}  // namespace whipple::strength
