// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Exact solutions for an ideal gas, p = (gamma - 1) rho e.
namespace whipple::verification::exact {

/// State of a gas that flows along one axis.
struct GasState {
  double density;   ///< kg/m^3
  double velocity;  ///< m/s
  double pressure;  ///< Pa
  /// J/kg
  [[nodiscard]] double energy(double gamma) const { return pressure / ((gamma - 1) * density); }
};

/// Riemann problem of two ideal gases of equal gamma that meet at x = 0 (Toro, Riemann Solvers and Numerical
/// Methods for Fluid Dynamics, 3rd ed., Springer 2009, chapter 4): shock or rarefaction on either side of the
/// contact, pressure between by Newton's method.
class RiemannProblem {
 public:
  RiemannProblem(const GasState& left, const GasState& right, double gamma);
  /// State on the ray x/t (m/s).
  [[nodiscard]] GasState at(double ray) const;
  [[nodiscard]] double star_pressure() const { return pressure_; }
  [[nodiscard]] double star_velocity() const { return velocity_; }

 private:
  [[nodiscard]] double jump(const GasState& state, double pressure, double& slope) const;
  /// The state on a ray to the right of the contact, of a wave that runs to the right.
  [[nodiscard]] GasState right_of_contact(const GasState& ahead, double velocity, double ray) const;

  GasState left_, right_;
  double gamma_, pressure_ = 0, velocity_ = 0;
};

/// Noh's problem (Noh, J. Comput. Phys. 72 (1987) 78): cold gas of density 1 kg/m^3 that flows with 1 m/s to
/// a wall (d = 1), an axis (2) or a centre (3); the shock goes out with (gamma - 1)/2 m/s.
struct Noh {
  int dimensions;
  double gamma;
  [[nodiscard]] double shock_radius(double time) const { return 0.5 * (gamma - 1) * time; }
  [[nodiscard]] GasState at(double radius, double time) const;
};

/// Blast of a point source of energy in uniform cold gas (Sedov, Similarity and Dimensional Methods in
/// Mechanics, 1959; in the notation of Kamm & Timmes, LA-UR-07-2849 (2007), spherical, uniform density).
class Sedov {
 public:
  /// @param energy  J, of the whole sphere
  Sedov(double energy, double density, double gamma);
  /// The energy integral: E = alpha rho r^5/t^2.
  [[nodiscard]] double alpha() const { return alpha_; }
  [[nodiscard]] double shock_radius(double time) const;
  /// State at a radius; velocity outwards, zero pressure ahead of the shock.
  [[nodiscard]] GasState at(double radius, double time) const;
  /// Share of the energy that is kinetic.
  [[nodiscard]] double kinetic_share() const { return kinetic_share_; }

 private:
  struct Similar {
    double radius, velocity, density, pressure;  ///< over those at the shock
  };
  /// @param x  0 at the centre, 1 at the shock; v - 2/(5 gamma) of the similarity variable v goes with x^10
  [[nodiscard]] Similar similar(double x) const;

  double energy_, density_, gamma_, alpha_ = 0, kinetic_share_ = 0;
};

}  // namespace whipple::verification::exact
