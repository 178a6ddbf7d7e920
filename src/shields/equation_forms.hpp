// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/shields/shield.hpp"

/// The equations in the units in which their constants were published: cm, g/cm^3, km/s, ksi. Each returns the critical
/// diameter in cm.
namespace whipple::shields::forms {

/// Holds an impact in these units.
struct Input {
  double v = 0.0;                   ///< speed, km/s
  double angle = 0.0;               ///< degree
  double rho_p = 0.0;               ///< of the projectile, g/cm^3
  double t_b = 0.0, rho_b = 0.0;    ///< of the first bumper
  double spacing = 0.0;             ///< from the first bumper to the next sheet, cm
  double t_b2 = 0.0, rho_b2 = 0.0;  ///< of the second bumper
  double spacing_2 = 0.0;           ///< from there to the wall, cm
  double t_w = 0.0, rho_w = 0.0;    ///< of the wall
  double sigma = 0.0;               ///< yield stress of the wall, ksi
  double hardness = 0.0;            ///< of the wall, Brinell
  double ad_stuffing = 0.0;         ///< areal density of fabric, g/cm^2
  double rho_foam = 0.0;            ///< g/cm^3

  /// Returns the impact with its speed replaced.
  [[nodiscard]] Input at(double speed) const {
    Input other = *this;
    other.v = speed;
    return other;
  }
};

/// Converts an impact.
Input input_of(const Impact& impact);

/// Computes d = [t HB^(1/4) (rho_t/rho_p)^m / (5.24 k (V_n/C)^(2/3))]^(18/19): the wall is k times as thick as the crater
/// in a half-space is deep. k = 1.8 perforation, 2.2 detached spall, 3.0 incipient spall; m = 1/2 if rho_p/rho_t < 1.5,
/// otherwise 2/3; C = 5.1 km/s of aluminium. Cour-Palais, Int. J. Impact Eng. 5 (1987) 221; NASA/TM-2009-214785.
double single_wall(const Input& in, double k);

/// Computes NNO: Christiansen, Int. J. Impact Eng. 14 (1993) 145. Below V_n = 3 km/s
/// d = [(t_w (sigma/40)^(1/2) + t_b)/(0.6 cos^(5/3) rho_p^(1/2) V^(2/3))]^(18/19), above 7 km/s
/// d = 3.918 t_w^(2/3) rho_p^(-1/3) rho_b^(-1/9) V_n^(-2/3) S^(1/3) (sigma/70)^(1/3), between them linear in V.
double nno_1993(const Input& in);

/// Computes modified NNO: Christiansen and Kerr, Int. J. Impact Eng. 26 (2001) 93. Below V = 3/cos^(3/2) km/s
/// d = 1.9 [t_w (sigma/40)^(1/2) + 0.37 t_b rho_b] cos^(-11/6) rho_p^(-1/2) V^(-2/3), above V = 7/cos km/s
/// d = k rho_p^(-1/3) V_n^(-2/3) rho_b^(-1/9) S^(1/2) (t_w rho_w)^(2/3) (sigma/70)^(1/3), k = 7.451 x + 0.411 for
/// x = t_b t_w^(-2/3) S^(-1/3) >= 0.126, otherwise 1.35; between them linear in V.
double nno_2001(const Input& in);

/// Computes NNO with thin bumpers: Ryan and Christiansen, Acta Astronautica 69 (2011) 245. Above 7 km/s NNO times
/// F^(-2/3), F = r - 2 y (r - 1) + y^2 (r - 1) with y = (t_b/d)/c < 1, otherwise 1; c = 0.20 if S/d >= 30, otherwise
/// 0.25; r is the wall that stops d at 7 km/s without a bumper over that with a proper one. The lower border is
/// V_n = 2.60 km/s if t_b/d >= 0.16, otherwise 1.436 (t_b/d)^(-1/3). The condition S/d belongs to the diameter sought.
double jsc_2011(const Input& in);

/// Computes the limit of three sheets of metal: Schaefer, Ryan, Lambert and Putzar, Int. J. Impact Eng. 35 (2008) 1784.
/// Below V = 3/cos km/s d = [((t_w^(1/2) + t_b2) (sigma/40)^(1/2)/1.4 + t_b)/(0.6 cos^delta rho_p^(1/2) V^(2/3))]^(18/19)
/// (the square root is that of a length in cm, as published), above 7/cos km/s
/// d = 1.155 [S1^(1/3) (t_b2 + 1.5 t_w)^(2/3) + 0.1 S2^(2/3) t_w^(1/3) cos^(-epsilon)] (sigma/70)^(1/3) /
/// (0.4^(2/3) rho_p^(1/3) rho_b2^(1/9) V^(2/3) cos^delta), between them linear in V; delta = 4/3, epsilon = 8/3, between
/// 45 and 65 degrees 5/4 and 5/2.
double srl_2008(const Input& in);

/// Computes stuffed Whipple shields: Christiansen and Kerr, Int. J. Impact Eng. 26 (2001) 93; NASA/TM-2009-214785. Below
/// V = 2.6/cos^(1/2) km/s d = 2.35 [t_w (sigma/40)^(1/2) + 0.37 A] cos^(-4/3) rho_p^(-1/2) V^(-2/3), above 6.5/cos^(3/4)
/// km/s d = K (t_w rho_w)^(1/3) rho_p^(-1/3) V^(-1/3) cos^(-1/2) S^(2/3) (sigma/40)^(1/6), K = 0.45 if the fabric is 10 to
/// 15 % of the shield, otherwise 0.6; A: areal density of bumper and fabric; between them linear in V.
double stuffed_2001(const Input& in);

/// Computes sandwich panels with open-cell foam: Ryan, Ordonez, Christiansen and Lear, 11th Hypervelocity Impact
/// Symposium (2009). Below V = 2.25 cos^(-1/3) km/s d = 1.83 [t_b + t_w (sigma/40)^(1/2) + S^1.1 rho_f/rho_w] /
/// (rho_p^(1/2) V^(2/3) cos^(4/5))^(18/19), above 4.0 cos^(-1/3) km/s d = 1.915 (t_w + S rho_f/(2 rho_w))^(2/3) S^0.45
/// (sigma/70)^(1/3) / (rho_p^(1/3) rho_b^(1/9) V^(2/5) cos^(4/5)), between them linear in V.
double foam_2009(const Input& in);

}  // namespace whipple::shields::forms
