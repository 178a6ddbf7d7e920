// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <filesystem>
#include <functional>
#include <string>

#include "src/case/case.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/io/run_directory.hpp"
#include "src/solver/simulation.hpp"
#include "tests/unit/temporary_folder.hpp"

/// Tools of the verification problems.
namespace whipple::verification {

/// Selects the method under test; the default is that of the solver.
struct Method {
  std::string scheme = "symplectic";
  std::string shape_function = "quadratic_bspline";
  std::string particle_update = "relaxed_affine";
  double courant = 0.5;
  double linear_viscosity = 0.25;
  double quadratic_viscosity = 1.0;
  double first_step = 0.05;
  int fmpm_order = 2;
  std::string options = {};  ///< further lines of the table `transfer`

  /// Returns linear FLIP-MUSL with the usual viscosity of hydrocodes, the method of most other codes.
  static Method musl() { return {"musl", "linear", "flip", 0.3, 0.06, 1.5}; }
  [[nodiscard]] std::string toml() const {
    return "[transfer]\nshape_function = \"" + shape_function + "\"\nparticle_update = \"" + particle_update +
           "\"\nfmpm_order = " + std::to_string(fmpm_order) + "\n" + options +
           "[artificial_viscosity]\nlinear = " + std::to_string(linear_viscosity) +
           "\nquadratic = " + std::to_string(quadratic_viscosity) + "\n";
  }
  [[nodiscard]] std::string time_toml(double end) const {
    return "[time]\nend = " + std::to_string(end * 1e9) + "e-9\ncourant = " + std::to_string(courant) +
           "\nfirst_step = " + std::to_string(first_step) + "\nscheme = \"" + scheme + "\"\n";
  }
};

/// Writes a material file in a temporary folder of the process; returns its path.
inline std::string write_material(const std::string& name, const std::string& text) {
  static const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / (name + ".toml");
  io::write_text_atomically(path, text);
  return path.string();
}

/// Returns aluminium, the Grueneisen material of the shock problems, with von Mises' yield stress; `more` is appended
/// (failure).
inline std::string aluminium(const std::string& name, const std::string& yield_stress,
                             const std::string& more = {}) {
  return write_material(name, R"toml(
name = "aluminium"
source = "constants of the verification problems"
[eos]
model = "mie_gruneisen"
source = "Steinberg (1996), Al 2024-T4"
reference_density = "2.785 g/cm^3"
hugoniot_intercept = "5.328 km/s"
hugoniot_slope = 1.338
gruneisen = 2.0
heat_capacity = "863 J/(kg K)"
reference_temperature = "300 K"
[strength]
model = "von_mises"
source = "test"
shear_modulus = "27.6 GPa"
yield_stress = ")toml" + yield_stress +
                                  "\"\n" + more);
}

/// Returns a linear elastic material: its yield stress is far above every stress.
inline std::string elastic_aluminium() { return aluminium("elastic_aluminium", "1e6 GPa"); }

/// Runs a simulation to a time; `each_step` is called after every step.
inline void run_to(solver::Simulation& simulation, double end,
                   const std::function<void(const solver::Simulation&)>& each_step = {}) {
  while (simulation.state().time < end) {
    simulation.advance(end);
    if (each_step) each_step(simulation);
  }
}

/// Records the largest absolute error of the total energy over the run, relative to the initial energy.
struct EnergyWatch {
  double worst = 0.0;
  void operator()(const solver::Simulation& simulation) {
    worst = std::max(worst, std::abs(simulation.state().ledger.energy_error(simulation.totals())));
  }
};

}  // namespace whipple::verification
