// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/protocols/phase.hpp"

#include "md_fitting/lammps/units.hpp"
#include "md_fitting/protocols/compressed_start.hpp"
#include "md_fitting/protocols/crystal.hpp"
#include "md_fitting/protocols/statistics.hpp"
#include "md_fitting/protocols/structure.hpp"

namespace whipple::md {

void make_melt(Crystal& crystal, double temperature, double dt, std::int64_t seed) {
  Lammps& lammps = crystal.lammps();
  lammps.command("timestep {:.17g}", 0.5 * dt);
  lammps.command("velocity all create {:.17g} {} mom yes rot no dist gaussian", 2 * overheating * temperature,
                 seed);
  lammps.command("fix melt all nvt temp {0:.17g} {0:.17g} {1:.17g}", overheating * temperature, 50 * dt);
  lammps.command("run 5000 post no");
  lammps.command("unfix melt");
  lammps.command("velocity all scale {:.17g}", temperature);
  lammps.command("timestep {:.17g}", dt);
}

Phase measure_phase(const Potential& potential, bool liquid, double pressure, double temperature,
                    const RunSize& size, double dt, std::int64_t seed, std::string& transcript) {
  Crystal crystal(potential, 1.02 * compressed_start(potential, pressure).lattice_constant, size.cells,
                  size.cells, size.cells);
  Lammps& lammps = crystal.lammps();
  if (liquid) {
    make_melt(crystal, temperature, dt, seed);
  } else {
    lammps.command("velocity all create {:.17g} {} mom yes rot no dist gaussian", 2 * temperature, seed);
    lammps.command("timestep {:.17g}", dt);
  }
  lammps.command("fix whole all npt temp {0:.17g} {0:.17g} {1:.17g} iso {2:.17g} {2:.17g} {3:.17g}",
                 temperature, 100 * dt, pressure / metal::bar, 1000 * dt);
  lammps.command("run {} post no", size.equilibration_steps);
  auto series = crystal.sample({"volume", "energy"}, sampling_interval(size.steps), size.steps);
  Phase phase;
  phase.volume = series_mean(series[0]);
  phase.energy = series_mean(series[1]);
  const double work = pressure / metal::bar / metal::pressure_from_energy;  // eV/A^3
  for (std::size_t i = 0; i < series[0].size(); ++i) series[1][i] += work * series[0][i];
  phase.enthalpy = series_mean(series[1]);
  phase.crystal_share = crystal_share(crystal, potential);
  transcript += lammps.transcript();
  return phase;
}

}  // namespace whipple::md
