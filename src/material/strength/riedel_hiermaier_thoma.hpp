// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "src/material/strength/brittle.hpp"
#include "src/material/strength/radial_return.hpp"

namespace whipple::strength {

/// Riedel-Hiermaier-Thoma (RHT), concrete: an elastic limit that hardens to a failure surface with three meridians,
/// which damage reduces to a residual one. Stresses over the compressive strength f_c. Source: W. Riedel, K. Thoma, S.
/// Hiermaier, E. Schmolinske, 9th Int. Symp. Interaction of the Effects of Munitions with Structures, Berlin-Strausberg
/// (1999) 315-322; T. Borrvall, W. Riedel, 8th European LS-DYNA Users Conf., Strasbourg (2011). Equations and
/// omissions: docs/theory/concrete_and_ceramics.md, section 5. The equation of state (`p_alpha`) describes the pores.
struct RiedelHiermaierThoma : ElasticConstants {
  static constexpr bool needs_lode_angle = true;

  double compressive_strength = 0.0;         ///< f_c, Pa
  double relative_tensile_strength = 0.0;    ///< f_t/f_c
  double relative_shear_strength = 0.0;      ///< f_s/f_c
  double failure_coefficient = 0.0;          ///< A
  double failure_exponent = 0.0;             ///< n
  double lode_ratio = 1.0;                   ///< Q0
  double lode_ratio_slope = 0.0;             ///< B
  double compressive_rate_exponent = 0.0;    ///< beta_c
  double tensile_rate_exponent = 0.0;        ///< beta_t
  double compressive_reference_rate = 3e-5;  ///< 1/s
  double tensile_reference_rate = 3e-6;      ///< 1/s
  double compressive_yield_ratio = 1.0;      ///< g_c
  double tensile_yield_ratio = 1.0;          ///< g_t
  double hardening_modulus_ratio = 1.0;      ///< xi
  double damage_coefficient = 0.0;           ///< D1
  double damage_exponent = 1.0;              ///< D2
  double least_failure_strain = 0.0;         ///< eps_m
  double residual_coefficient = 0.0;         ///< A_f
  double residual_exponent = 1.0;            ///< n_f

  static ParameterTable<RiedelHiermaierThoma> parameters() {
    using P = RiedelHiermaierThoma;
    return ElasticConstants::parameters<P>(
        {real("compressive_strength", &P::compressive_strength, "Pa", range::positive(),
              "f_c, quasi-static, uniaxial"),
         real("relative_tensile_strength", &P::relative_tensile_strength, "", range::positive(), "f_t/f_c"),
         real("relative_shear_strength", &P::relative_shear_strength, "", range::positive(), "f_s/f_c"),
         real("failure_coefficient", &P::failure_coefficient, "", range::positive(),
              "A of the failure surface"),
         real("failure_exponent", &P::failure_exponent, "", range::open_between(0.0, 1.0),
              "n of the failure surface"),
         real("lode_ratio", &P::lode_ratio, "", range::between(0.5, 1.0),
              "Q0: tensile over compressive meridian at zero pressure")
             .optional(),
         real("lode_ratio_slope", &P::lode_ratio_slope, "", range::non_negative(), "B: its slope over p/f_c")
             .optional(),
         real("compressive_rate_exponent", &P::compressive_rate_exponent, "", range::non_negative(),
              "beta_c"),
         real("tensile_rate_exponent", &P::tensile_rate_exponent, "", range::non_negative(), "beta_t"),
         real("compressive_reference_rate", &P::compressive_reference_rate, "1/s", range::positive(),
              "at and below which the rate factor is 1")
             .optional(),
         real("tensile_reference_rate", &P::tensile_reference_rate, "1/s", range::positive(),
              "at and below which the rate factor is 1")
             .optional(),
         real("compressive_yield_ratio", &P::compressive_yield_ratio, "",
              Range{.lower = 0.0, .upper = 1.0, .lower_open = true},
              "g_c: elastic limit over strength, in compression"),
         real("tensile_yield_ratio", &P::tensile_yield_ratio, "",
              Range{.lower = 0.0, .upper = 1.0, .lower_open = true},
              "g_t: elastic limit over strength, in tension"),
         real("hardening_modulus_ratio", &P::hardening_modulus_ratio, "",
              Range{.lower = 0.0, .upper = 1.0, .lower_open = true},
              "xi: fraction of the shear modulus in the hardening"),
         real("damage_coefficient", &P::damage_coefficient, "", range::non_negative(), "D1"),
         real("damage_exponent", &P::damage_exponent, "", range::non_negative(), "D2").optional(),
         real("least_failure_strain", &P::least_failure_strain, "", range::positive(),
              "eps_m: lower bound of the strain to failure"),
         real("residual_coefficient", &P::residual_coefficient, "", range::non_negative(), "A_f"),
         real("residual_exponent", &P::residual_exponent, "", range::positive(), "n_f")});
  }
  static constexpr const char* name = "riedel_hiermaier_thoma";
  static constexpr const char* summary =
      "concrete: three meridians, hardening, damage, residual strength (Riedel-Hiermaier-Thoma)";
  static constexpr const char* theory =
      "Failure surface Y* = R3(theta, p*) F(p*, rate): A (p* - F_r/3 + (A/F_r)^(-1/n))^n above p* = F_r/3, "
      "straight "
      "lines below\n"
      "through shear and tensile strength; elastic limit Y*(p*/g) g, g from g_c, g_t and the cap of the "
      "pores, hardening "
      "to 1;\n"
      "then dD = dep/max(D1 (p* + (1 - D) p_t*)^D2, eps_m), Y* = (1 - D) Y* + D A_f p*^n_f.\n"
      "Source: Riedel et al., 9th Int. Symp. Interaction of the Effects of Munitions with Structures (1999); "
      "Borrvall and "
      "Riedel,\n"
      "8th European LS-DYNA Users Conf. (2011).";

  /// @throws InputError if the constants are inconsistent
  void require_consistent() const {
    if (!(relative_tensile_strength * shear_meridian() < relative_shear_strength * lode_ratio)) {
      throw InputError(
          "'relative_shear_strength' is too small compared with 'relative_tensile_strength': the failure "
          "surface "
          "would not "
          "close in tension");
    }
  }

  /// Returns R3, the equivalent stress over that of the compressive meridian (Willam and Warnke 1975): 1 in uniaxial
  /// compression, the tensile ratio in uniaxial tension.
  [[nodiscard]] double meridian(double lode_cosine, double pressure_ratio) const {
    const double q = std::clamp(lode_ratio + lode_ratio_slope * pressure_ratio, 0.5, 1.0);
    const double c = std::cos(std::acos(lode_cosine) / 3.0), u = 1.0 - q * q, w = 2.0 * q - 1.0;
    const double square = 4.0 * u * c * c + 5.0 * q * q - 4.0 * q;
    return (2.0 * u * c + w * std::sqrt(std::max(square, 0.0))) / (4.0 * u * c * c + w * w);
  }
  [[nodiscard]] double least_pressure(const BrittlePoint& point) const {
    return -compressive_strength * tensile_limit(point) * (1.0 - point.damage);
  }
  static double crushed_strain(const BrittlePoint&) { return 0.0; }
  [[nodiscard]] BrittleSurface surface(const BrittlePoint& point) const {
    const double p = point.pressure / compressive_strength;
    const double scale = compressive_strength * meridian(point.lode_cosine, p);
    const double whole = scale * failure(p, point);
    const double residual =
        p > 0.0 ? compressive_strength * residual_coefficient * std::pow(p, residual_exponent) : 0.0;
    const double strain =
        std::max(damage_coefficient * std::pow(std::max(0.0, p + (1.0 - point.damage) * tensile_limit(point)),
                                               damage_exponent),
                 least_failure_strain);
    // In tension (1 - D) times the surface at p/(1 - D), which is also linear in D.
    const double fall = p > 0.0
                            ? std::max(0.0, whole - residual)
                            : scale * rate_factor(p, point.rate) * relative_shear_strength / shear_meridian();
    return {whole, fall, std::numeric_limits<double>::infinity(), strain};
  }
  /// Returns the elastic limit over the failure surface at a hardening h in [0, 1] (eq. 16).
  [[nodiscard]] double hardened_share(double h, const BrittlePoint& point) const {
    const double p = point.pressure / compressive_strength, limit = elastic_share(point);
    const double g = h + (1.0 - h) * limit, whole = failure(p, point);
    return g > 0.0 && whole > 0.0 ? g * failure(p / g, point) / whole : 0.0;
  }
  /// Returns the plastic strain between elastic limit and failure surface (eq. 16).
  [[nodiscard]] double hardening_strain(double whole, const BrittlePoint& point) const {
    return whole * (1.0 - elastic_share(point)) / (3.0 * hardening_modulus_ratio * stiffness());
  }
  /// Returns to the hardening surface, and beyond it to the failure surface.
  /// @param y  surface at this pressure, with melting
  [[nodiscard]] BrittleReturn hardening(double trial, double stiffness, const BrittleSurface& y,
                                        const BrittlePoint& point) const {
    const double span = hardening_strain(y.whole, point), left = span - point.plastic_strain;
    if (point.damage > 0.0 || !(left > 0.0)) return brittle_return(trial, stiffness, y, point.damage);
    const double slope = 3.0 * hardening_modulus_ratio * this->stiffness();  // slope of the linear hardening
    const auto strength = [&](double x) {
      return y.whole * hardened_share(std::min(1.0, (point.plastic_strain + x) / span), point);
    };
    const double x = radial_return(trial, stiffness / 3.0, 1.0, strength(0.0),
                                   [&](double dep) { return FlowStress{strength(dep), slope}; });
    if (x < left) return {x, 0.0};
    const BrittleReturn beyond = brittle_return(trial - stiffness * left, stiffness, y, 0.0);
    return {left + beyond.increment, beyond.damage};
  }

 private:
  /// Returns Q1 = R3 in pure shear at zero pressure.
  [[nodiscard]] double shear_meridian() const { return meridian(0.0, 0.0); }
  [[nodiscard]] double compressive_factor(double rate) const {
    return std::pow(std::max(1.0, rate / compressive_reference_rate), compressive_rate_exponent);
  }
  [[nodiscard]] double tensile_factor(double rate) const {
    return std::pow(std::max(1.0, rate / tensile_reference_rate), tensile_rate_exponent);
  }
  /// Returns F_r, linear between that of compression and that of tension.
  [[nodiscard]] double rate_factor(double p, double rate) const {
    const double c = compressive_factor(rate), t = tensile_factor(rate);
    const double s = std::clamp((c - 3.0 * p) / (c + t * relative_tensile_strength), 0.0, 1.0);
    return c + s * (t - c);
  }
  /// Returns p_t*, the tensile pressure at the tip of the failure surface over f_c.
  [[nodiscard]] double tensile_limit(const BrittlePoint& point) const {
    const double shear = lode_ratio * relative_shear_strength;
    return tensile_factor(point.rate) * shear * relative_tensile_strength /
           (3.0 * (shear - shear_meridian() * relative_tensile_strength));
  }
  /// Returns the failure surface on the compressive meridian over f_c (eq. 15).
  [[nodiscard]] double failure(double p, const BrittlePoint& point) const {
    const double f = rate_factor(p, point.rate), shear = relative_shear_strength / shear_meridian();
    if (3.0 * p >= f) {
      const double start = std::pow(failure_coefficient / f, -1.0 / failure_exponent);
      return failure_coefficient * std::pow(p - f / 3.0 + start, failure_exponent);
    }
    if (p >= 0.0) return f * shear + 3.0 * p * (1.0 - shear);
    return std::max(0.0, f * shear - 3.0 * p * (1.0 / lode_ratio - shear / relative_tensile_strength));
  }
  /// Returns F_e F_c: elastic limit over failure surface, with the cap at which the pores collapse (eq. 17).
  [[nodiscard]] double elastic_share(const BrittlePoint& point) const {
    const double p = point.pressure / compressive_strength,
                 crush = point.crush_pressure / compressive_strength;
    const double c = compressive_factor(point.rate) * compressive_yield_ratio;
    const double t = tensile_factor(point.rate) * tensile_yield_ratio * relative_tensile_strength;
    const double s = std::clamp((c - 3.0 * p) / (c + t), 0.0, 1.0);
    const double elastic = compressive_yield_ratio + s * (tensile_yield_ratio - compressive_yield_ratio);
    if (p >= crush) return 0.0;
    const double begin =
        c / 3.0 + hardening_modulus_ratio * stiffness() * point.plastic_strain / compressive_strength;
    if (p <= begin || !std::isfinite(crush)) return elastic;
    const double x = (p - begin) / (crush - begin);
    return elastic * std::sqrt(std::max(0.0, 1.0 - x * x));
  }
};

using RiedelHiermaierThomaModel = BrittleModel<RiedelHiermaierThoma>;

}  // namespace whipple::strength
