// SPDX-License-Identifier: BSD-3-Clause
// Vapour of GRAY, V > V_J: Carnahan-Starling hard spheres with van der Waals attraction (Young and Alder
// 1971), joined to the liquid at V_J. Equation numbers: docs/theory/gray.md.
#include <cmath>

#include "eos/models/gray_free_energy.hpp"

namespace whipple::eos {
namespace {

/// Returns the compressibility of hard spheres, Carnahan and Starling, J. Chem. Phys. 51, 635 (1969).
template <class Number>
Number compressibility(Number z) {
  const Number y = 1 - z;
  return (1 + z * (1 + z * (1 - z))) / (y * y * y);
}
/// Returns dZ/dz.
template <class Number>
Number compressibility_slope(Number z) {
  const Number y = 1 - z;
  return (1 + z * (2 - 3 * z)) / (y * y * y) + 3 * (1 + z * (1 + z * (1 - z))) / (y * y * y * y);
}
/// Returns the integral of (Z - 1)/z from 0 to z: excess free energy of hard spheres over R T.
double excess_free_energy(double z) { return z * (4 - 3 * z) / ((1 - z) * (1 - z)); }

/// Holds the join function F_P (G21), its derivative dF_P/dV and its integral F_E (G23).
template <class Number>
struct Join {
  Number pressure, pressure_by_volume, energy;
};
template <class Number>
Join<Number> join_function(Number V, double covolume, double z_join, double theta) {
  const Number z = covolume / V;
  const Number root = z * (theta - z_join) / (z_join * (theta - z));
  const Number cube = root * root * root;
  // d ln(root)/dz = 1/z + 1/(theta - z) = theta/(z (theta - z)), dz/dV = -z/V
  const Number slope = -3 * cube * theta / ((theta - z) * V);
  const double d = theta - z_join;
  const Number ratio = d / (theta - z);
  const Number energy = covolume / (2 * z_join * z_join * z_join) * d *
                        (ratio * ratio * (2 * z - theta) - (2 * z_join - theta));
  return {cube, slope, energy};
}

}  // namespace

template <class Number>
BasicGrayBranch<Number> gray_vapour_branch(const GrayConstants& c, const GrayBranch& l, Number V) {
  const double gas = GrayConstants::gas_constant / c.molar_mass, a = c.vapour_attraction;
  const double join_volume = c.join_volume_ratio * c.reference_specific_volume;
  const double covolume = c.covolume_ratio * c.reference_specific_volume;
  const double z_join = covolume / join_volume;
  const Number density = 1 / V, z = covolume * density;
  const double d0 = l.p0 + a / (join_volume * join_volume);
  const double d1 = l.p1 - gas * compressibility(z_join) / join_volume;
  const double d2 = l.p2;
  const Join<Number> join = join_function(V, covolume, z_join, c.join_shape);
  const Number Z = compressibility(z);
  BasicGrayBranch<Number> v;
  v.e0 = l.e0 - a * (density - 1 / join_volume) + d0 * join.energy;
  v.e1 = Number{} + l.e1;
  v.e2 = l.e2 - d2 * join.energy;
  v.p0 = -a * density * density + d0 * join.pressure;
  v.p1 = gas * Z * density + d1 * join.pressure;
  v.p2 = d2 * join.pressure;
  v.q0 = 2 * a * density * density * density + d0 * join.pressure_by_volume;
  v.q1 = -gas * (Z + z * compressibility_slope(z)) * density * density + d1 * join.pressure_by_volume;
  v.q2 = d2 * join.pressure_by_volume;
  return v;
}
template GrayBranch gray_vapour_branch(const GrayConstants&, const GrayBranch&, double);
template BasicGrayBranch<Lanes> gray_vapour_branch(const GrayConstants&, const GrayBranch&, Lanes);

void GrayFreeEnergy::prepare_vapour() {
  join_ = isochore(join_volume_);
  join_band_ = band(join_);
  join_hot_temperature_ = constants_.hot_liquid_ratio * join_.melting_temperature;
  join_cool_ = liquid_branch(join_);
  join_hot_ = hot_liquid_branch(join_);
  join_compressibility_ = compressibility(covolume_ / join_volume_);
}

GrayBranch GrayFreeEnergy::fluid_branch(double V, double T) const {
  if (V > join_volume_) return vapour_branch(V, T > join_hot_temperature_);
  const GrayIsochore iso = isochore(V);
  return T > constants_.hot_liquid_ratio * iso.melting_temperature ? hot_liquid_branch(iso)
                                                                   : liquid_branch(iso);
}

double GrayFreeEnergy::join_difference_slope(double T) const {
  const GrayBranch& l = T > join_hot_temperature_ ? join_hot_ : join_cool_;
  return l.pressure_by_temperature(T) - gas_ * join_compressibility_ / join_volume_;
}

double GrayFreeEnergy::vapour_entropy(double V, double T) const {
  // -dF/dT of (G25)
  const double z = covolume_ / V, z_join = covolume_ / join_volume_;
  const Join<double> join = join_function(V, covolume_, z_join, constants_.join_shape);
  return solid_entropy(join_, T) + liquid_entropy_excess(T / join_.melting_temperature) -
         gas_ * (std::log(z / z_join) + excess_free_energy(z) - excess_free_energy(z_join)) -
         join_difference_slope(T) * join.energy;
}

GrayPoint GrayFreeEnergy::vapour(double V, double T) const {
  const GrayBranch b = vapour_branch(V, T > join_hot_temperature_);
  return {b.pressure(T),
          b.energy(T),
          vapour_entropy(V, T),
          b.heat_capacity(T),
          b.pressure_by_temperature(T),
          b.pressure_by_volume(T)};
}

}  // namespace whipple::eos
