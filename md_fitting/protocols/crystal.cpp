// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/protocols/crystal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "md_fitting/lammps/units.hpp"
#include "md_fitting/protocols/point_team.hpp"

namespace whipple::md {

Crystal::Crystal(const Potential& potential, double lattice_constant, std::int64_t nx, std::int64_t ny,
                 std::int64_t nz, std::optional<CrystalStructure> structure)
    : nx_(nx), ny_(ny), nz_(nz), lammps_(point_communicator()) {
  potential.begin(lammps_);
  lammps_.command("boundary p p p");
  lammps_.command("lattice {} {:.17g}", word_of(structure.value_or(potential.structure())), lattice_constant);
  lammps_.command("region box block 0 {} 0 {} 0 {}", nx, ny, nz);
  lammps_.command("create_box 1 box");
  lammps_.command("create_atoms 1 box");
  potential.apply(lammps_);
  // Use a thin skin with a check at every step: atoms in hot, strongly compressed states move fast, and no
  // neighbour may be missed.
  lammps_.command("neighbor 1.0 bin");
  lammps_.command("neigh_modify every 1 delay 0 check yes");
  atoms_ = lammps_.atoms();
  lammps_.command("compute virial all pressure NULL virial");
  lammps_.command("compute displacement all msd com yes");
  // Thermodynamic output keeps the computes current for the variables, including after `run 0`.
  lammps_.command("thermo_style custom step temp pe vol c_virial c_displacement[4]");
  lammps_.command("thermo_modify norm no");
  lammps_.command("variable energy equal pe/{:.17g}", atoms_);
  lammps_.command("variable volume equal vol/{:.17g}", atoms_);
  lammps_.command("variable virial equal c_virial");
  lammps_.command("variable kinetic_temperature equal temp");
  lammps_.command("variable displacement equal c_displacement[4]");
}

void Crystal::rescale(double lattice_constant) {
  lammps_.command("change_box all x final 0 {:.17g} y final 0 {:.17g} z final 0 {:.17g} remap units box",
                  static_cast<double>(nx_) * lattice_constant, static_cast<double>(ny_) * lattice_constant,
                  static_cast<double>(nz_) * lattice_constant);
}

std::vector<std::vector<double>> Crystal::sample(const std::vector<std::string>& variables,
                                                 std::int64_t every, std::int64_t steps) {
  std::string columns;
  for (const std::string& name : variables) columns += " v_" + name;
  lammps_.command("fix series all vector {}{}", every, columns);
  lammps_.command("run {} post no", steps);
  auto series = lammps_.series("series", static_cast<int>(variables.size()));
  lammps_.command("unfix series");
  return series;
}

double time_step(const Potential& potential, double volume_ratio, double temperature, const RunSize& size) {
  if (size.time_step > 0.0) return size.time_step / metal::picosecond;
  constexpr double copper_mass = 63.55;
  const double femtoseconds = temperature > 8000.0 || volume_ratio < 0.6   ? 0.5
                              : temperature < 1500.0 && volume_ratio > 0.8 ? 2.0
                                                                           : 1.0;
  return 1e-3 * femtoseconds * std::sqrt(potential.mass() / copper_mass);
}

std::int64_t sampling_interval(std::int64_t steps) { return std::clamp<std::int64_t>(steps / 64, 1, 10); }

}  // namespace whipple::md
