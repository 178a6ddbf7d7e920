// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/protocols/cold_curve.hpp"

#include <fmt/format.h>

#include <cmath>

#include "md_fitting/lammps/units.hpp"
#include "md_fitting/protocols/catalogue.hpp"
#include "md_fitting/protocols/crystal.hpp"
#include "src/core/base/error.hpp"

namespace whipple::md {
namespace {

constexpr std::int64_t cells = 3;

/// Returns the axial ratio at which the stress of an hcp crystal of given volume is isotropic, which is that of
/// minimum energy. The sites of hcp are fixed by symmetry for any ratio.
double relax_axial_ratio(Crystal& crystal, double volume_per_cell) {
  Lammps& lammps = crystal.lammps();
  lammps.command("variable anisotropy equal c_virial[3]-0.5*(c_virial[1]+c_virial[2])");
  lammps.command(
      "thermo_style custom step pe vol c_virial c_displacement[4] c_virial[1] c_virial[2] c_virial[3]");
  const auto anisotropy = [&](double ratio) {
    // The orthogonal cell a, sqrt(3) a, c holds four atoms.
    const double a = std::cbrt(volume_per_cell / (std::sqrt(3.0) * ratio));
    const double edge = a * static_cast<double>(cells);
    lammps.command("change_box all x final 0 {:.17g} y final 0 {:.17g} z final 0 {:.17g} remap units box",
                   edge, edge * std::sqrt(3.0), edge * ratio);
    crystal.evaluate();
    return lammps.variable("anisotropy");
  };
  const double ideal = std::sqrt(8.0 / 3.0);
  double former = 1.002 * ideal;
  double former_value = anisotropy(former);
  double ratio = ideal;
  for (int iteration = 0; iteration < 30; ++iteration) {
    const double value = anisotropy(ratio);
    const double step = value == former_value ? 0.0 : -value * (ratio - former) / (value - former_value);
    if (std::abs(step) < 1e-7) return ratio;
    former = ratio;
    former_value = value;
    ratio += step;
    if (!(std::abs(ratio / ideal - 1.0) < 0.2)) break;
  }
  throw StateError(
      fmt::format("hcp has no energy minimum over the axial ratio near {:.3f} at {:.2f} A^3 per atom", ideal,
                  volume_per_cell / 4.0));
}

}  // namespace

ColdState measure_cold(const Potential& potential, CrystalStructure structure, double specific_volume,
                       std::string& transcript) {
  const double mass = potential.mass();
  const double atomic = metal::volume_per_atom(specific_volume, mass);
  const double a = structure == CrystalStructure::hcp ? std::cbrt(std::sqrt(2.0) * atomic)  // ideal
                                                      : std::cbrt(atoms_per_cell(structure) * atomic);
  Crystal crystal(potential, a, cells, cells, cells, structure);
  ColdState state;
  if (structure == CrystalStructure::hcp) {
    state.axial_ratio = relax_axial_ratio(crystal, 4.0 * atomic);
  } else {
    crystal.evaluate();
  }
  state.pressure = crystal.lammps().variable("virial") * metal::bar;
  state.specific_internal_energy = metal::specific_energy(crystal.lammps().variable("energy"), mass);
  transcript += crystal.lammps().transcript();
  return state;
}

void add_cold_curve(const Plan& plan, TaskList& list) {
  if (!plan.cold_curve) return;
  for (const double ratio : plan.cold_curve->volume_ratio) {
    list.require_range(ratio);
    const double volume = ratio * list.potential().static_volume();
    list.add({conditions_of(ColdCurvePoint{.specific_volume = volume}), {}, {}},
             [&potential = list.potential(), volume](std::int64_t, const PointRecord*) {
               TaskResult result;
               ColdCurvePoint point{.specific_volume = volume};
               for (const auto& [structure, pressure, energy] : ColdCurvePoint::others()) {
                 const bool own = structure == potential.structure();
                 ColdState state;
                 try {
                   state = measure_cold(potential, structure, volume, result.transcript);
                 } catch (const StateError& error) {
                   // A structure used for comparison that does not exist at this volume is not an error.
                   if (own) throw;
                   result.message = error.what();
                   continue;
                 }
                 if (own) {
                   point.pressure = state.pressure;
                   point.specific_internal_energy = state.specific_internal_energy;
                 } else {
                   point.*pressure = state.pressure;
                   point.*energy = state.specific_internal_energy;
                 }
                 if (structure == CrystalStructure::hcp) point.hcp_axial_ratio = state.axial_ratio;
               }
               result.results = results_of(point);
               return result;
             });
  }
}

}  // namespace whipple::md
