// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/protocols/hugoniot_guess.hpp"

#include <fmt/format.h>

#include <cmath>

#include "md_fitting/lammps/units.hpp"
#include "src/core/base/error.hpp"

namespace whipple::md {

ReferenceState static_reference(const Potential& potential) {
  const double energy = potential.crystal_energy(potential.lattice_constant());
  return {{potential.static_volume(), 0.0}, {metal::specific_energy(energy, potential.mass()), 0.0}};
}

HugoniotGuess guess_hugoniot(const Potential& potential, const ReferenceState& reference, double volume) {
  const double mass = potential.mass();
  const int atoms = potential.atoms_per_cell();
  const auto cold_energy = [&](double v) {
    return metal::specific_energy(
        potential.crystal_energy(std::cbrt(metal::volume_per_atom(v, mass) * atoms)), mass);
  };
  const double dv = 1e-3 * volume;
  const double cold_pressure = -(cold_energy(volume + dv) - cold_energy(volume - dv)) / (2 * dv);
  const double heat = 3.0 * metal::specific_energy(metal::boltzmann, mass);
  const double half = 0.5 * (reference.specific_volume.value - volume);
  const double gruneisen = 2.0 * volume / reference.specific_volume.value;
  const double t = (half * cold_pressure - cold_energy(volume) + reference.specific_internal_energy.value) /
                   (heat * (1.0 - gruneisen * half / volume));
  const double temperature = std::fmax(t, 100.0);
  return {volume, temperature, cold_pressure + gruneisen * heat * temperature / volume};
}

double least_guess_volume(const Potential& potential, const ReferenceState& reference) {
  // The cold curve of a KIM model has a finite range, and (10) differentiates it.
  return std::fmax(0.3 * reference.specific_volume.value, 1.005 * potential.least_known_volume());
}

HugoniotGuess guess_hugoniot_at_pressure(const Potential& potential, const ReferenceState& reference,
                                         double pressure) {
  double larger = reference.specific_volume.value;
  double smaller = least_guess_volume(potential, reference);
  if (guess_hugoniot(potential, reference, smaller).pressure < pressure) {
    throw StateError(
        fmt::format("no shock of {:.4g} GPa found down to V/V0 = {:.2f}", 1e-9 * pressure, smaller / larger));
  }
  while (larger - smaller > 1e-5 * larger) {
    const double middle = 0.5 * (larger + smaller);
    (guess_hugoniot(potential, reference, middle).pressure < pressure ? larger : smaller) = middle;
  }
  return guess_hugoniot(potential, reference, smaller);
}

}  // namespace whipple::md
