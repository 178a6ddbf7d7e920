// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/lammps/measured_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "md_fitting/lammps/elements.hpp"
#include "md_fitting/lammps/units.hpp"
#include "src/core/base/error.hpp"

namespace whipple::md {
namespace {

struct StaticState {
  double energy = 0.0;    ///< eV per atom
  double pressure = 0.0;  ///< eV/A^3
};

/// Evaluates static crystals of one structure in one instance; two cells along each axis, since a lattice sum has
/// no size effect.
class StaticCrystal {
 public:
  StaticCrystal(const MeasuredModel& model, CrystalStructure structure, double lattice_constant) {
    model.begin(lammps_);
    lammps_.command("boundary p p p");
    lammps_.command("lattice {} {:.17g}", word_of(structure), lattice_constant);
    lammps_.command("region box block 0 2 0 2 0 2");
    lammps_.command("create_box 1 box");
    lammps_.command("create_atoms 1 box");
    model.apply(lammps_);
    lammps_.command("neighbor 0.3 bin");
    lammps_.command("compute virial all pressure NULL virial");
    lammps_.command("thermo_style custom step pe c_virial");
    lammps_.command("thermo_modify norm no");
    lammps_.command("variable energy equal pe/{:.17g}", lammps_.atoms());
    lammps_.command("variable virial equal c_virial");
  }
  StaticState state(double lattice_constant) {
    const double edge = 2.0 * lattice_constant;
    lammps_.command("change_box all x final 0 {0:.17g} y final 0 {0:.17g} z final 0 {0:.17g} remap units box",
                    edge);
    return present();
  }
  StaticState present() {
    lammps_.command("run 0 post no");
    return {lammps_.variable("energy"), lammps_.variable("virial") / metal::pressure_from_energy};
  }

 private:
  Lammps lammps_;
};

double lattice_constant_of(CrystalStructure structure, double volume_per_atom) {
  return std::cbrt(volume_per_atom * atoms_per_cell(structure));
}

}  // namespace

MeasuredModel::MeasuredModel(Interactions interactions, const std::string& element,
                             std::optional<CrystalStructure> structure)
    : interactions_(std::move(interactions)), element_(element) {
  const std::optional<double> weight = standard_atomic_weight(element);
  if (!weight) throw InputError(fmt::format("{} is no element with a standard atomic weight", element));
  mass_ = *weight;
  try {
    find_crystal(structure);
    find_cutoff();
    scan();
  } catch (const LammpsError& error) {
    throw InputError(fmt::format("{} has no crystal of {}: {}", interactions_.name, element, error.what()));
  }
}

void MeasuredModel::begin(Lammps& lammps) const {
  for (const Interactions::Command& command : interactions_.before_box) {
    lammps.command_shown_as(command.line, command.shown);
  }
  lammps.command("atom_style atomic");
}

void MeasuredModel::apply(Lammps& lammps) const {
  for (const Interactions::Command& command : interactions_.in_box) {
    lammps.command_shown_as(command.line, command.shown);
  }
  lammps.command("mass * {:.17g}", mass_);
}

/// Finds the crystal: the stated structure, or that of minimum energy at zero pressure among fcc and bcc. Scans
/// neighbour distances from 5.5 A, longer than in any metal, inwards to 1.9 A, or until the model fails.
void MeasuredModel::find_crystal(std::optional<CrystalStructure> stated) {
  bool found = false;
  double least = 0.0;
  double volume_at_rest = 0.0;
  for (const CrystalStructure structure : {CrystalStructure::fcc, CrystalStructure::bcc}) {
    if (stated && structure != *stated) continue;
    const double per_distance = structure == CrystalStructure::fcc ? std::sqrt(2.0) : std::sqrt(4.0 / 3.0);
    constexpr double longest = 5.5;
    constexpr double shortest = 1.9;
    constexpr double step = 0.985;
    StaticCrystal crystal(*this, structure, longest * per_distance);
    double best = 0.0;
    double best_energy = 0.0;
    try {
      for (double distance = longest; distance > shortest; distance *= step) {
        const double energy = crystal.state(distance * per_distance).energy;
        if (energy < best_energy) best_energy = energy, best = distance * per_distance;
      }
    } catch (const LammpsError& error) {
      // The model does not cover this density: earlier results remain valid, unless there are none.
      if (best == 0.0) throw;
    }
    if (best == 0.0) continue;
    // Find zero pressure between the neighbours of the best step.
    StaticCrystal fine(*this, structure, best);
    double smaller = best * step;
    double larger = best / step;
    while (larger - smaller > 1e-9 * best) {
      const double middle = 0.5 * (smaller + larger);
      (fine.state(middle).pressure > 0.0 ? smaller : larger) = middle;
    }
    const double energy = fine.state(smaller).energy;
    if (energy < least) {
      found = true;
      least = energy;
      structure_ = structure;
      lattice_constant_ = smaller;
      volume_at_rest = std::pow(smaller, 3) / atoms_per_cell(structure);
    }
  }
  if (!found) {
    throw InputError(fmt::format("{} binds no crystal of {}", interactions_.name, element_));
  }
  if (stated) return;
  // Lattice constant of hcp with the ideal axial ratio and the same volume per atom.
  StaticCrystal hexagonal(*this, CrystalStructure::hcp, std::cbrt(volume_at_rest * std::sqrt(2.0)));
  constexpr double clearly = 1e-3;  // eV per atom: a relaxed axial ratio and stacking faults stay below it
  if (hexagonal.present().energy < least - clearly) {
    throw InputError(fmt::format("with {} the crystal of {} is hcp; fcc and bcc are supported",
                                 interactions_.name, element_));
  }
}

/// Finds the distance beyond which two atoms do not interact.
void MeasuredModel::find_cutoff() {
  Lammps lammps;
  begin(lammps);
  lammps.command("boundary p p p");
  lammps.command("region box block 0 60 0 60 0 60 units box");
  lammps.command("create_box 1 box");
  lammps.command("create_atoms 1 single 10 30 30 units box");
  lammps.command("create_atoms 1 single 30 30 30 units box");
  apply(lammps);
  lammps.command("thermo_style custom step pe fmax");
  lammps.command("variable force equal fmax");
  constexpr double longest = 15.0;
  constexpr double step = 0.1;
  for (double distance = longest; distance > 2.0; distance -= step) {
    lammps.command("set atom 2 x {:.17g}", 10.0 + distance);
    lammps.command("run 0 post no");
    if (std::abs(lammps.variable("force")) > 1e-12) {
      cutoff_ = std::min(longest, distance + step);
      return;
    }
  }
  throw InputError(fmt::format("two atoms of {} do not interact in {}", element_, interactions_.name));
}

void MeasuredModel::scan() {
  const double v0 = std::pow(lattice_constant_, 3) / atoms_per_cell(structure_);
  const auto evaluate = [&](StaticCrystal& crystal, double ratio) {
    return crystal.state(lattice_constant_of(structure_, ratio * v0));
  };
  std::optional<StaticCrystal> crystal;
  crystal.emplace(*this, structure_, lattice_constant_);
  constexpr double step = 0.01;
  const auto steps = static_cast<int>(std::lround((largest_scanned_ratio - least_scanned_ratio) / step));
  double good = largest_scanned_ratio + step;
  double former_pressure = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const double ratio = largest_scanned_ratio - i * step;
    try {
      const StaticState state = evaluate(*crystal, ratio);
      const bool sound = std::isfinite(state.energy) && std::isfinite(state.pressure);
      if (!sound || (ratio < 0.995 && state.pressure <= former_pressure)) {
        end_ = good;
        reason_ = "the static crystal ceases to resist compression";
        break;
      }
      former_pressure = state.pressure;
      good = ratio;
      volumes_.push_back(ratio * v0);
      energies_.push_back(state.energy);
      slopes_.push_back(-state.pressure);
    } catch (const LammpsError&) {
      reason_ = "the model refuses the static crystal";
      double bad = ratio;
      while (good - bad > 1e-4) {
        const double middle = 0.5 * (good + bad);
        try {
          crystal.emplace(*this, structure_, lattice_constant_);
          evaluate(*crystal, middle);
          good = middle;
        } catch (const LammpsError&) {
          bad = middle;
        }
      }
      end_ = good;
      break;
    }
  }
  if (volumes_.empty() || volumes_.back() > 0.97 * v0) {
    throw InputError(fmt::format("with {} the crystal of {} carries no compression: {}", interactions_.name,
                                 element_, reason_));
  }
  for (auto* list : {&volumes_, &energies_, &slopes_}) std::reverse(list->begin(), list->end());
}

double MeasuredModel::pressure(double volume_ratio) const {
  constexpr double small = 1e-3;
  const double volume = volume_ratio * std::pow(lattice_constant_, 3) / atoms_per_cell(structure_);
  return -(crystal_energy(volume * (1.0 + small)) - crystal_energy(volume * (1.0 - small))) /
         (2.0 * small * volume) * metal::pressure_from_energy * metal::bar;
}

double MeasuredModel::crystal_energy(double volume) const {
  if (!(volume >= volumes_.front() && volume <= volumes_.back())) {
    throw StateError(
        fmt::format("the static crystal of {} is known from {:.3f} to {:.3f} A^3 per "
                    "atom, not at {:.3f}",
                    interactions_.name, volumes_.front(), volumes_.back(), volume));
  }
  const auto upper = std::upper_bound(volumes_.begin() + 1, volumes_.end() - 1, volume);
  const auto i = static_cast<std::size_t>(upper - volumes_.begin()) - 1;
  // Cubic interpolation of values and slopes at both ends.
  const double h = volumes_[i + 1] - volumes_[i];
  const double t = (volume - volumes_[i]) / h;
  const double s = 1.0 - t;
  return s * s * (1.0 + 2.0 * t) * energies_[i] + t * t * (1.0 + 2.0 * s) * energies_[i + 1] +
         h * t * s * (s * slopes_[i] - t * slopes_[i + 1]);
}

}  // namespace whipple::md
