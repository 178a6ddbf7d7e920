// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "eos/model_equation_of_state.hpp"
#include "eos/models/ideal_gas.hpp"
#include "eos/models/jwl.hpp"
#include "eos/models/jwl_reactant.hpp"
#include "eos/models/murnaghan.hpp"
#include "eos/models/polynomial.hpp"
#include "eos/models/stiffened_gas.hpp"
#include "eos/models/tait.hpp"
#include "eos/models/tillotson.hpp"

/// Published constants of the models of impact codes.
namespace whipple::eos::test {

/// Melosh, Impact Cratering (1989), appendix II.
inline TillotsonConstants aluminium_tillotson() {
  TillotsonConstants c;
  c.reference_density = 2700;
  c.thermal_a = 0.5;
  c.thermal_b = 1.63;
  c.bulk_modulus = 75.2e9;
  c.quadratic_modulus = 65e9;
  c.expansion_alpha = c.expansion_beta = 5;
  c.energy_scale = 5e6;
  c.incipient_vaporisation_energy = 3e6;
  c.complete_vaporisation_energy = 13.9e6;
  c.heat_capacity = 896;
  return c;
}

/// Dobratz and Crawford, UCRL-52997 (1985): A, B (GPa), R1, R2, omega, E0 (GJ/m^3), D (m/s), p_CJ (GPa). The
/// heat capacity is of the order of that of the products.
inline JwlConstants jwl(double density, double A, double B, double R1, double R2, double omega, double E0,
                        double D, double p_CJ) {
  JwlConstants c;
  c.reference_density = density;
  c.pressure_1 = A * 1e9;
  c.pressure_2 = B * 1e9;
  c.exponent_1 = R1;
  c.exponent_2 = R2;
  c.gruneisen = omega;
  c.detonation_energy = E0 * 1e9;
  c.heat_capacity = 1000;
  c.detonation_velocity = D;
  c.chapman_jouguet_pressure = p_CJ * 1e9;
  return c;
}
inline JwlConstants tnt() { return jwl(1630, 371.2, 3.231, 4.15, 0.95, 0.30, 7.0, 6930, 21.0); }
inline JwlConstants comp_b() { return jwl(1717, 524.2, 7.678, 4.2, 1.1, 0.34, 8.5, 7980, 29.5); }
/// Unreacted Composition B of an ignition-and-growth set: 780 Mbar, -0.05031 Mbar, c_v 2.49e-5 Mbar/K per
/// volume.
inline JwlReactantConstants comp_b_reactant() {
  return {.reference_density = 1717,
          .pressure_1 = 78000e9,
          .pressure_2 = -5.031e9,
          .exponent_1 = 11.3,
          .exponent_2 = 1.13,
          .gruneisen = 0.8938,
          .heat_capacity = 2.49e6 / 1717};
}
inline JwlConstants petn() { return jwl(1770, 617.0, 16.926, 4.4, 1.2, 0.25, 10.1, 8300, 33.5); }

/// The series of Mie-Grueneisen on Us = c0 + s up in mu up to the third power (Steinberg's aluminium
/// 2024-T4), with rho Gamma constant.
inline PolynomialConstants aluminium_polynomial() {
  const double K = 2785 * 5328.0 * 5328.0, s = 1.338, G = 2.0;
  // p_H = K [mu + (2 s - 1) mu^2 + (s - 1)(3 s - 1) mu^3], less Gamma0/2 x p_H with x = mu - mu^2.
  PolynomialConstants c;
  c.reference_density = 2785;
  c.C1 = K;
  c.C2 = K * (2 * s - 1 - 0.5 * G);
  c.C3 = K * ((s - 1) * (3 * s - 1) - 0.5 * G * (2 * s - 2));
  c.C4 = G;
  c.heat_capacity = 863;
  return c;
}
/// Air as C4 = C5 = gamma - 1 with E0 = 0.25 MPa: the usual way to put it into a polynomial.
inline PolynomialConstants air_polynomial() {
  PolynomialConstants c;
  c.reference_density = 1.225;
  c.C4 = c.C5 = 0.4;
  c.reference_energy = 0.25e6 / 1.225;
  c.heat_capacity = 718;
  c.reference_temperature = c.reference_energy / c.heat_capacity;
  return c;
}

/// Air of the standard atmosphere (ISO 2533): 1.225 kg/m^3, 288.15 K, 101325 Pa.
inline IdealGasConstants air() {
  IdealGasConstants c;
  c.reference_density = 1.225;
  c.heat_capacity_ratio = 1.4;
  c.heat_capacity = 101325 / (0.4 * 1.225 * 288.15);
  c.reference_temperature = 288.15;
  return c;
}

/// Copper: K0 = 133 GPa, K0' = 5.3 (near the isotherm of Dewaele, Loubeyre and Mezouar, 2004).
inline MurnaghanConstants copper_murnaghan() {
  MurnaghanConstants c;
  c.reference_density = 8935;
  c.bulk_modulus = 137e9;
  c.bulk_modulus_slope = 5.0;
  c.gruneisen = 2.0;
  c.heat_capacity = 385;
  c.reference_temperature = 298;
  return c;
}

/// Water: n of Cole, Underwater Explosions (1948), sound speed at 20 degrees.
inline TaitConstants water_tait() {
  TaitConstants c;
  c.reference_density = 998;
  c.sound_speed = 1483;
  c.exponent = 7.15;
  c.gruneisen = 0.28;
  c.heat_capacity = 4182;
  c.reference_temperature = 293;
  return c;
}

/// Water: gamma = 4.4, p_inf = 600 MPa (Saurel and Abgrall, J. Comput. Phys. 150 (1999) 425).
inline StiffenedGasConstants water_stiffened() {
  StiffenedGasConstants c;
  c.reference_density = 1000;
  c.heat_capacity_ratio = 4.4;
  c.stiffness_pressure = 6e8;
  c.heat_capacity = 4182;
  c.reference_pressure = 1e5;
  c.reference_temperature = 293;
  return c;
}

}  // namespace whipple::eos::test
