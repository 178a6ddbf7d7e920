// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/protocols/lattice.hpp"

#include <fmt/format.h>

#include <cmath>

#include "md_fitting/lammps/units.hpp"
#include "md_fitting/protocols/catalogue.hpp"
#include "md_fitting/protocols/crystal.hpp"
#include "src/core/base/error.hpp"

namespace whipple::md {

LatticeResult measure_lattice(const Potential& potential) {
  // Large enough for the cutoff with any EAM potential; a perfect crystal has no size effect.
  Crystal crystal(potential, potential.lattice_constant(), 3, 3, 3);
  const auto pressure = [&](double a) {
    crystal.rescale(a);
    crystal.evaluate();
    return crystal.lammps().variable("virial");  // bar
  };
  // Secant search for zero pressure, starting from the result of the lattice sum.
  double former = 1.001 * potential.lattice_constant();
  double former_pressure = pressure(former);
  double a = potential.lattice_constant();
  double step = former - a;
  for (int iteration = 0; std::abs(step) > 1e-9; ++iteration) {
    const double present = pressure(a);
    if (present == former_pressure) break;
    if (iteration == 20) {
      throw StateError(fmt::format("no lattice constant with zero pressure near {} A: {} bar at {} A",
                                   potential.lattice_constant(), present, a));
    }
    step = -present * (a - former) / (present - former_pressure);
    former = a;
    former_pressure = present;
    a += step;
  }
  pressure(a);
  const double energy = crystal.lammps().variable("energy");
  const double volume = crystal.lammps().variable("volume");
  LatticeResult result;
  result.lattice_constant = {a * metal::angstrom, std::abs(step) * metal::angstrom};
  result.cohesive_energy = {metal::specific_energy(energy, potential.mass()), 0.0};
  result.specific_volume = {metal::specific_volume(volume, potential.mass()),
                            metal::specific_volume(volume, potential.mass()) * 3.0 * std::abs(step) / a};
  result.transcript = crystal.lammps().transcript();
  return result;
}

void add_lattice(const Plan&, TaskList& list) {
  list.add({}, [&potential = list.potential()](std::int64_t, const PointRecord*) {
    const LatticeResult result = measure_lattice(potential);
    return TaskResult{results_of<LatticePoint>(result), "", result.transcript};
  });
}

}  // namespace whipple::md
