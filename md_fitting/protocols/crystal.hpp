// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "md_fitting/data_set/data_set.hpp"
#include "md_fitting/lammps/lammps.hpp"
#include "md_fitting/lammps/potential.hpp"
#include "md_fitting/plan/plan.hpp"

namespace whipple::md {

/// Holds a LAMMPS instance with a perfect crystal and its potential; all sampling uses named variables: energy (eV
/// per atom), virial (bar, without the kinetic part), volume (A^3 per atom), kinetic_temperature (K), displacement
/// (A^2, mean square from the lattice sites). LAMMPS units internally, SI in the interface.
class Crystal {
 public:
  /// @param lattice_constant A
  /// @param nx,ny,nz         unit cells along the axes
  /// @param structure        fcc, bcc or hcp (orthogonal cell of four atoms); none: that of the potential
  Crystal(const Potential& potential, double lattice_constant, std::int64_t nx, std::int64_t ny,
          std::int64_t nz, std::optional<CrystalStructure> structure = {});

  Lammps& lammps() { return lammps_; }
  [[nodiscard]] double atoms() const { return atoms_; }

  /// Computes forces and energies at the current positions.
  void evaluate() { lammps_.command("run 0 post no"); }
  /// Changes the lattice constant (A) of a crystal at rest.
  void rescale(double lattice_constant);

  /// Samples the variables every `every` steps for `steps` steps, column by column.
  std::vector<std::vector<double>> sample(const std::vector<std::string>& variables, std::int64_t every,
                                          std::int64_t steps);

 private:
  std::int64_t nx_, ny_, nz_;
  Lammps lammps_;
  double atoms_ = 0.0;
};

/// Returns the time step (ps): 2 fs for copper below 1500 K and V/V0 > 0.8, 0.5 fs above 8000 K or below V/V0 =
/// 0.6, otherwise 1 fs; scaled by the square root of the mass, like the vibration periods.
double time_step(const Potential& potential, double volume_ratio, double temperature, const RunSize& size);

/// Returns the steps between samples of a series: 10, or fewer if a short run would have too few samples for block
/// averages.
std::int64_t sampling_interval(std::int64_t steps);

}  // namespace whipple::md
