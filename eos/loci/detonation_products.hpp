// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "eos/detonation.hpp"
#include "eos/loci/impedance.hpp"
#include "eos/loci/isentrope.hpp"

namespace whipple::eos {

/// Describes the detonation products of one explosive behind a plane wave: their isentrope from the Chapman-Jouguet
/// state (CJ), the energy released along it, and the metal that they drive. SI; volumes v are relative to that of
/// the explosive, v = rho0/rho.
class DetonationProducts {
 public:
  /// Computes the Chapman-Jouguet state.
  /// @param eos  of the products; its reference state is the unreacted explosive. Kept by reference.
  /// @throws InputError if the model does not describe an explosive: condensed material, or a gas of finite
  /// reference pressure without energy to release
  explicit DetonationProducts(const EquationOfState& eos);

  [[nodiscard]] const EquationOfState& equation_of_state() const { return *eos_; }
  [[nodiscard]] const ChapmanJouguet& chapman_jouguet() const { return cj_; }
  /// Returns v of the Chapman-Jouguet state.
  [[nodiscard]] double chapman_jouguet_volume() const {
    return eos_->reference_density() / cj_.state.density;
  }
  /// Returns the adiabatic exponent rho c^2/p of the Chapman-Jouguet state, which is rho0 D^2/p - 1.
  [[nodiscard]] double adiabatic_exponent() const;
  /// Returns the detonation wave as a shock that moves with D into the explosive at rest.
  [[nodiscard]] ShockState wave() const {
    return {cj_.state, cj_.detonation_velocity, cj_.particle_velocity};
  }

  /// Returns states on the isentrope through CJ at relative volumes, which must increase and exceed that of CJ.
  [[nodiscard]] std::vector<IsentropeState> expansion(const std::vector<double>& volumes) const;

  /// Returns the energy per unit mass of the explosive released by the products as work or kinetic energy after
  /// expansion on the isentrope to a state of specific energy e: E0/rho0 - e (J/kg). At CJ it is negative, -
  /// u_CJ^2/2, since the wave has compressed the explosive.
  [[nodiscard]] double energy_given_off(const State& state) const {
    return eos_->reference_energy() - state.specific_internal_energy;
  }
  /// Returns the Gurney velocity sqrt(2 E) with the energy E released at a relative volume. Metal has most of its
  /// final velocity at v = 7, where the wall of the cylinder test has moved by 19 mm (tested).
  [[nodiscard]] double gurney_velocity(double volume = 7.0) const;

  /// Returns pressure and velocity where the wave meets inert material at normal incidence: the products are
  /// reshocked by stiffer material, and expand on their isentrope against softer material.
  /// @throws StateError if the range of a model ends before the pressures are equal
  [[nodiscard]] ImpedanceMatch contact(const Hugoniot& inert) const;

 private:
  const EquationOfState* eos_;
  ChapmanJouguet cj_;
};

/// Lists the arrangements of metal and explosive for which Gurney gave the velocity of the metal.
enum class GurneyShape {
  cylinder,            ///< metal around a cylinder of explosive
  sphere,              ///< metal around a sphere
  symmetric_sandwich,  ///< explosive between two equal plates
  open_face,           ///< one plate; the opposite face of the explosive is free
};
inline constexpr std::array<std::pair<const char*, GurneyShape>, 4> gurney_shapes = {
    {{"cylinder", GurneyShape::cylinder},
     {"sphere", GurneyShape::sphere},
     {"symmetric_sandwich", GurneyShape::symmetric_sandwich},
     {"open_face", GurneyShape::open_face}}};

/// Returns the velocity of driven metal (Gurney, BRL report 405, 1943), m/s, from the ratio m = M/C of the mass M
/// of metal (of both plates of a sandwich) to that of the explosive C:
///   cylinder G (m + 1/2)^-1/2, sphere G (m + 3/5)^-1/2, symmetric sandwich G (m + 1/3)^-1/2,
///   open face G [((1 + 2 m)^3 + 1)/(6 (1 + m)) + m]^-1/2.
/// @throws InputError if a number is not positive
double gurney_speed(GurneyShape shape, double gurney_velocity, double mass_ratio);

/// Describes the geometry of a cylinder test: a tube filled with explosive and initiated at one end.
struct CylinderTest {
  double inner_radius = 12.7e-3;  ///< m
  double wall = 2.6e-3;           ///< thickness, m
  double wall_density = 8930.0;   ///< kg/m^3; copper
};

/// Holds the state of the wall of a cylinder test at one time.
struct CylinderWall {
  double displacement = 0;    ///< of the outer surface, m
  double radial_speed = 0;    ///< of the outer surface in the plane of the streak camera, m/s
  double material_speed = 0;  ///< of the wall, 2 D sin(theta/2), m/s
  double angle = 0;           ///< theta between wall and axis
  double volume = 0;          ///< v of the products
  double pressure = 0;        ///< of the products, Pa
};

/// Computes the wall motion of a cylinder test at displacements of its outer surface, assuming steady flow in the
/// frame of the wave: products uniform over each section on the isentrope through CJ, U^2/2 + e + p/rho constant,
/// section A = A0 rho0 D/(rho U); wall incompressible and without strength, its mass and half of that of the
/// explosive (Gurney's profile) deflected by the pressure,
///   1 - cos(theta) = integral of p dA/[D^2 (M + C/2)],  dR/dt = D tan(theta) r/R.
/// @param displacements  m, increasing
/// @throws StateError if the products do not expand so far within v = 100
std::vector<CylinderWall> cylinder_test(const DetonationProducts& products, const CylinderTest& test,
                                        const std::vector<double>& displacements);

}  // namespace whipple::eos
