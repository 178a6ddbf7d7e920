// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/protocols/structure.hpp"

#include <fmt/format.h>

#include <cmath>

#include "md_fitting/lammps/units.hpp"
#include "src/core/base/error.hpp"

namespace whipple::md {

void define_crystal_order(Lammps& lammps, const Potential& potential) {
  const double a = std::cbrt(lammps.variable("volume") * potential.atoms_per_cell());
  // Between the first and second shell of fcc (0.71 and 1 a), the second and third of bcc (1 and 1.41 a).
  const bool fcc = potential.structure() == CrystalStructure::fcc;
  lammps.command("compute order all orientorder/atom degrees 1 6 nnn {} cutoff {:.17g}", fcc ? 12 : 14,
                 (fcc ? 0.85 : 1.2) * a);
  lammps.command("variable is_crystal atom c_order[1]>{}", crystal_order);
}

double crystal_share(Crystal& crystal, const Potential& potential) {
  Lammps& lammps = crystal.lammps();
  define_crystal_order(lammps, potential);
  lammps.command("compute share all reduce ave v_is_crystal");
  lammps.command("variable share equal c_share");
  lammps.command("thermo_style custom step pe vol c_virial c_displacement[4] c_share");
  crystal.evaluate();
  const double share = lammps.variable("share");
  lammps.command("thermo_style custom step temp pe vol c_virial c_displacement[4]");
  lammps.command("thermo_modify norm no");
  lammps.command("variable share delete");
  lammps.command("uncompute share");
  lammps.command("variable is_crystal delete");
  lammps.command("uncompute order");
  return share;
}

double inherent_crystal_share(Crystal& crystal, const Potential& potential) {
  crystal.lammps().command("min_style cg");
  crystal.lammps().command("minimize 1e-7 0.0 200 1000");
  return crystal_share(crystal, potential);
}

double neighbour_distance(const Potential& potential, double specific_volume) {
  const double a =
      std::cbrt(metal::volume_per_atom(specific_volume, potential.mass()) * potential.atoms_per_cell());
  return nearest_neighbour(potential.structure(), metal::angstrom * a);
}

void require_stable(bool solid, const Estimate& energy, double cold_energy, double temperature,
                    const Potential& potential) {
  const double potential_energy = energy.value - 1.5 * metal::boltzmann * temperature;
  if (!solid || potential_energy > cold_energy - 3.0 * energy.error) return;
  throw StateError(
      fmt::format("the {} crystal of {} ({}) is unstable: its potential energy of {:.4f} eV per atom at {} K "
                  "lies below that of the "
                  "static crystal, {:.4f} eV",
                  word_of(potential.structure()), potential.element(), potential.name(), potential_energy,
                  temperature, cold_energy));
}

}  // namespace whipple::md
