// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "eos/hermite_table.hpp"
#include "eos/models/gray_constants.hpp"
#include "eos/models/shock_curve.hpp"
#include "eos/vapour_dome.hpp"
#include "src/core/base/vector_math.hpp"

/// Provides the Helmholtz free energy of GRAY in closed form, phase by phase (docs/theory/gray.md, sections 2 to 4).
/// All arguments and results are SI; V is the specific volume in m^3/kg, T is in K. Construction is cheap (a quarter of
/// a millisecond with a given attraction), so that a fit may construct one object per trial set of constants.
namespace whipple::eos {

/// Holds one branch of the free energy on the isochore V: in every phase of GRAY energy and pressure are quadratic
/// in T,
///   E = e0 + e1 T + e2 T^2,  P = p0 + p1 T + p2 T^2,  (dP/dV)_T = q0 + q1 T + q2 T^2.
/// @tparam Number  double, or Lanes for four points at once
template <class Number>
struct BasicGrayBranch {
  Number e0{}, e1{}, e2{};
  Number p0{}, p1{}, p2{};
  Number q0{}, q1{}, q2{};

  [[nodiscard]] Number energy(Number T) const { return e0 + T * (e1 + T * e2); }
  [[nodiscard]] Number heat_capacity(Number T) const { return e1 + 2 * e2 * T; }
  [[nodiscard]] Number pressure(Number T) const { return p0 + T * (p1 + T * p2); }
  /// Returns (dP/dT)_V.
  [[nodiscard]] Number pressure_by_temperature(Number T) const { return p1 + 2 * p2 * T; }
  /// Returns (dP/dV)_T.
  [[nodiscard]] Number pressure_by_volume(Number T) const { return q0 + T * (q1 + T * q2); }
  /// Returns (dE/dV)_T = T (dP/dT)_V - P.
  [[nodiscard]] Number energy_by_volume(Number T) const {
    return T * pressure_by_temperature(T) - pressure(T);
  }
  /// Returns the root of energy(T) = E with positive heat capacity, without cancellation for e2 -> 0. NaN if E is
  /// above the energy at which the heat capacity vanishes (possible for negative e2 only).
  [[nodiscard]] Number temperature(Number E) const {
    using std::sqrt;
    using whipple::sqrt;
    return 2 * (E - e0) / (e1 + sqrt(e1 * e1 + 4 * e2 * (E - e0)));
  }
  /// Returns c^2 = V^2 [T (dP/dT)_V^2/C_v - (dP/dV)_T]  (G28).
  [[nodiscard]] Number squared_sound_speed(Number V, Number T) const {
    const Number slope = pressure_by_temperature(T);
    return V * V * (T * slope * slope / heat_capacity(T) - pressure_by_volume(T));
  }
};
using GrayBranch = BasicGrayBranch<double>;

/// Selects lane by lane a where the mask holds, otherwise b.
inline BasicGrayBranch<Lanes> select_branch(LanesMask mask, const BasicGrayBranch<Lanes>& a,
                                            const BasicGrayBranch<Lanes>& b) {
  return {select(mask, a.e0, b.e0), select(mask, a.e1, b.e1), select(mask, a.e2, b.e2),
          select(mask, a.p0, b.p0), select(mask, a.p1, b.p1), select(mask, a.p2, b.p2),
          select(mask, a.q0, b.q0), select(mask, a.q1, b.q1), select(mask, a.q2, b.q2)};
}

/// Returns the vapour at V > V_J, joined to a liquid whose branch at V_J is given (G20 to G25): hard spheres and
/// attraction relative to V_J, and F_E(V) D(T) with D = P_l(V_J, T) - P_HS(V_J, T) + a_y/V_J^2 = d0 + d1 T + d2 T^2.
/// @param constants  with a finite attraction
template <class Number>
BasicGrayBranch<Number> gray_vapour_branch(const GrayConstants& constants, const GrayBranch& liquid_at_join,
                                           Number V);

/// Holds common quantities of the condensed phases on the isochore V <= V_J.
template <class Number>
struct BasicGrayIsochore {
  Number V{};
  Number log_ratio{};            ///< ln(V/V0)
  Number gruneisen{};            ///< gamma(V)  (G2)
  Number heat_coefficient{};     ///< g_e(V), J/(kg K^2)  (G8)
  Number melting_temperature{};  ///< T_m(V)  (G11)
  Number lindemann_exponent{};   ///< lambda = d ln T_m/d ln V  (G12)
  Number cold_curvature{};       ///< d^2 P_c/dV^2
  BasicGrayBranch<Number> solid;
};
using GrayIsochore = BasicGrayIsochore<double>;

/// Holds the edges of the melting band on an isochore (G31), or both at T_m for isochoric melting (G26).
/// Equilibrium melting is not defined on a single isochore: GrayMeltingCurve.
template <class Number>
struct BasicGrayBand {
  Number T1{}, T2{};  ///< solid below T1, liquid above T2, K
  Number E1{}, E2{};  ///< energies of the edges
  Number P1{}, P2{};  ///< pressures of the edges
};
using GrayBand = BasicGrayBand<double>;

/// Holds the derivatives of the edges along V.
template <class Number>
struct BasicGrayBandSlopes {
  Number T1{}, T2{}, E1{}, E2{}, P1{}, P2{};
};
using GrayBandSlopes = BasicGrayBandSlopes<double>;

/// Holds quantities at (V, T) on one branch.
struct GrayPoint {
  double pressure = 0;                 ///< Pa
  double energy = 0;                   ///< J/kg
  double entropy = 0;                  ///< J/(kg K); zero for the solid at (V0, T0)
  double heat_capacity = 0;            ///< J/(kg K), at constant volume
  double pressure_by_temperature = 0;  ///< Pa/K
  double pressure_by_volume = 0;       ///< Pa kg/m^3

  [[nodiscard]] double gibbs(double V, double T) const { return energy - T * entropy + pressure * V; }
};

class GrayFreeEnergy {
 public:
  /// @throws InputError if the constants contradict each other, the heat capacity would not remain positive, or no
  /// attraction gives the requested critical or boiling temperature
  explicit GrayFreeEnergy(const GrayConstants& constants);

  /// Returns the constants with the defaults resolved and the attraction of the vapour solved.
  [[nodiscard]] const GrayConstants& constants() const { return constants_; }
  /// Returns the smallest specific volume, where the cold pressure turns over or the shock curve nears its pole (G29).
  [[nodiscard]] double least_volume() const { return least_volume_; }
  /// Returns V_J: condensed phases at and below, vapour above.
  [[nodiscard]] double join_volume() const { return join_volume_; }
  [[nodiscard]] double covolume() const { return covolume_; }
  /// Returns R/M, J/(kg K).
  [[nodiscard]] double specific_gas_constant() const { return gas_; }

  // Functions of V, for least_volume() <= V <= join_volume().
  [[nodiscard]] double cold_pressure(double V) const;        ///< P_c = -dE_c/dV
  [[nodiscard]] double gamma(double V) const;                ///< (G2)
  [[nodiscard]] double melting_temperature(double V) const;  ///< (G11)

  // Full states on the surface of one phase, stable or not.
  [[nodiscard]] GrayPoint solid(double V, double T) const;   ///< V <= V_J
  [[nodiscard]] GrayPoint liquid(double V, double T) const;  ///< V <= V_J; Grover's and the hot liquid
  [[nodiscard]] GrayPoint vapour(double V, double T) const;  ///< V >= V_J
  [[nodiscard]] GrayPoint solid(const GrayIsochore& isochore, double T) const;
  [[nodiscard]] GrayPoint liquid(const GrayIsochore& isochore, double T) const;
  /// Returns liquid() or vapour(), depending on V: the surface whose loop contains the liquid-vapour dome.
  [[nodiscard]] GrayPoint fluid(double V, double T) const {
    return V > join_volume_ ? vapour(V, T) : liquid(V, T);
  }

  /// Returns the fluid surface for the search of its dome. The result refers to this object.
  [[nodiscard]] VapourDome::Search dome_search() const;

  // Building blocks of the evaluation.
  template <class Number>
  [[nodiscard]] BasicGrayIsochore<Number> isochore(Number V) const;
  /// Returns the isochore with the given energy, pressure and its slope dP/dV at T = 0, for the continuation of the
  /// cold curve beyond least_volume(). The curvature of the cold pressure is not set.
  [[nodiscard]] GrayIsochore isochore_of_cold_curve(double V, double energy, double pressure,
                                                    double pressure_by_volume) const;
  /// Returns the branch for T_m <= T <= T_G  (G16, G18).
  template <class Number>
  [[nodiscard]] BasicGrayBranch<Number> liquid_branch(const BasicGrayIsochore<Number>& isochore) const;
  /// Returns the branch for T > T_G  (G17, G18).
  template <class Number>
  [[nodiscard]] BasicGrayBranch<Number> hot_liquid_branch(const BasicGrayIsochore<Number>& isochore) const;
  template <class Number>
  [[nodiscard]] BasicGrayBand<Number> band(const BasicGrayIsochore<Number>& isochore) const;
  template <class Number>
  [[nodiscard]] BasicGrayBandSlopes<Number> band_slopes(const BasicGrayIsochore<Number>& isochore,
                                                        const BasicGrayBand<Number>& band) const;
  /// Returns the branch of the vapour at V >= V_J: below (hot = false) or above T_G(V_J)  (G25).
  template <class Number>
  [[nodiscard]] BasicGrayBranch<Number> vapour_branch(Number V, bool hot) const {
    return gray_vapour_branch(constants_, hot ? join_hot_ : join_cool_, V);
  }
  /// Returns the branch of fluid() at (V, T).
  [[nodiscard]] GrayBranch fluid_branch(double V, double T) const;
  /// Returns T_G(V_J), at which the vapour changes branch at every volume.
  [[nodiscard]] double vapour_branch_temperature() const { return join_hot_temperature_; }
  /// Returns the melting band at V_J.
  [[nodiscard]] const GrayBand& join_band() const { return join_band_; }

  [[nodiscard]] double solid_entropy(const GrayIsochore& isochore, double T) const;
  /// Returns the entropy of the liquid minus that of the solid at equal V and T.
  [[nodiscard]] double liquid_entropy_excess(double reduced_temperature) const;
  [[nodiscard]] double vapour_entropy(double V, double T) const;

 private:
  /// Holds the cold curve and its derivatives along x = 1 - V/V0.
  template <class Number>
  struct Cold {
    Number e, p, p1, p2;  ///< E_c - E_0H, P_c, dP_c/dx, d^2P_c/dx^2
  };
  template <class Number>
  [[nodiscard]] BasicGrayIsochore<Number> with_cold_curve(Number V, const Cold<Number>& cold) const;
  template <class Number>
  [[nodiscard]] Cold<Number> cold_from_energy(Number x, Number energy) const;
  [[nodiscard]] double lattice_factor(double x) const;  ///< h(x)  (G10)
  void tabulate_cold_curve();
  void prepare_vapour();
  void solve_vapour_attraction();
  void check_heat_capacity() const;
  template <class Number>
  [[nodiscard]] Number band_width(const BasicGrayIsochore<Number>& isochore) const;
  template <class Number>
  [[nodiscard]] Number band_width_slope(const BasicGrayIsochore<Number>& isochore) const;
  [[nodiscard]] double join_difference_slope(double T) const;  ///< dD/dT of (G25)

  GrayConstants constants_;
  // Per unit mass.
  double gas_ = 0, lattice_ = 0, heat_coefficient_ = 0, melting_entropy_ = 0, liquid_slope_ = 0;
  ShockCurve shock_curve_;
  double cold_offset_ = 0, cold_energy_at_reference_ = 0;  ///< P_CC (G6), E_00 (G4)
  double entropy_offset_ = 0;
  double least_volume_ = 0, join_volume_ = 0, covolume_ = 0;
  HermiteTable table_;  ///< E_c - E_0H over x
  bool isochoric_ = false;
  // Vapour.
  GrayIsochore join_;
  GrayBand join_band_;
  double join_hot_temperature_ = 0;
  GrayBranch join_cool_, join_hot_;  ///< liquid branches at V_J
  double join_compressibility_ = 0;  ///< Z(z_J) of the hard spheres
};

}  // namespace whipple::eos
