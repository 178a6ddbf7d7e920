// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/lammps/kim_model.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <regex>
#include <sstream>

#include "md_fitting/lammps/elements.hpp"
#include "md_fitting/lammps/units.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/text.hpp"

namespace whipple::md {
namespace {

/// Keeps the KIM library, which is part of liblammps' dependencies, from writing kim.log into the present
/// folder. It is reached by name, because its headers are no requirement of the build.
void silence_kim() {
  struct Verbosity {
    int id;
  };
  using Push = void (*)(Verbosity);
  static const bool done = [] {
    void* const push = dlsym(RTLD_DEFAULT, "KIM_Log_PushDefaultVerbosity");
    void* const silent = dlsym(RTLD_DEFAULT, "KIM_LOG_VERBOSITY_silent");
    if (push != nullptr && silent != nullptr) {
      reinterpret_cast<Push>(push)(*static_cast<const Verbosity*>(silent));
    }
    return true;
  }();
  static_cast<void>(done);
}

/// The folders in which the KIM library looks for models, by the environment variables of its manual and the
/// places of packages.
std::vector<std::filesystem::path> model_folders() {
  std::vector<std::filesystem::path> folders;
  for (const char* variable : {"KIM_API_PORTABLE_MODELS_DIR", "KIM_API_SIMULATOR_MODELS_DIR"}) {
    const char* const value = std::getenv(variable);
    std::istringstream parts(value == nullptr ? "" : value);
    for (std::string part; std::getline(parts, part, ':');) folders.emplace_back(part);
  }
  for (const char* kind : {"portable-models", "simulator-models"}) {
    folders.push_back(std::filesystem::path(WHIPPLE_KIM_MODELS) / kind);
    folders.push_back(std::filesystem::path("/usr/local/lib/kim-api") / kind);
  }
  return folders;
}

/// The species in an identifier, "..._2001_Cu__MO_..." or "..._AlCu__MO_...", hold the element.
bool names_element(const std::string& identifier, const std::string& element) {
  const std::string name = identifier.substr(0, identifier.find("__"));
  const std::string species = name.substr(name.rfind('_') + 1);
  for (std::size_t at = species.find(element); at != std::string::npos; at = species.find(element, at + 1)) {
    const std::size_t next = at + element.size();
    if (next == species.size() || std::islower(static_cast<unsigned char>(species[next])) == 0) return true;
  }
  return false;
}

std::vector<std::string> installed_models(const std::string& element) {
  std::vector<std::string> names;
  for (const std::filesystem::path& folder : model_folders()) {
    std::error_code fault;
    for (const auto& entry : std::filesystem::directory_iterator(folder, fault)) {
      const std::string name = entry.path().filename().string();
      if (KimModel::is_identifier(name) && names_element(name, element)) names.push_back(name);
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// Tells which models to name instead: the installed ones nearest in name, or where to get some.
std::string advice(const std::string& identifier, const std::string& element) {
  std::vector<std::string> models = installed_models(element);
  if (models.empty())
    return fmt::format("no model for {} is installed (scripts/install_deps.sh --kim)", element);
  constexpr std::size_t most = 12;
  const std::size_t more = models.size() > most ? models.size() - most : 0;
  const std::string nearest = did_you_mean(identifier, models);
  models.resize(models.size() - more);
  return fmt::format("for {} there are{}: {}{}", element, nearest, fmt::join(models, ", "),
                     more > 0 ? fmt::format(" and {} more in {}", more, WHIPPLE_KIM_MODELS) : "");
}

struct StaticState {
  double energy = 0.0;    ///< eV per atom
  double pressure = 0.0;  ///< eV/A^3
};

/// Static crystals of one structure, all in one instance; two cells along each axis, as a lattice sum has no
/// size effect.
class StaticCrystal {
 public:
  StaticCrystal(const KimModel& model, CrystalStructure structure, double lattice_constant) {
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

bool KimModel::is_identifier(const std::string& name) {
  static const std::regex pattern("[A-Za-z_][A-Za-z0-9_]*__(MO|SM)_[0-9]{12}_[0-9]{3}");
  return std::regex_match(name, pattern);
}

KimModel::KimModel(const std::string& identifier, const std::string& element,
                   std::optional<CrystalStructure> structure)
    : identifier_(identifier), element_(element) {
  silence_kim();
  const std::optional<double> weight = standard_atomic_weight(element);
  if (!weight) throw InputError(fmt::format("{} is no element with a standard atomic weight", element));
  mass_ = *weight;
  try {
    Lammps probe;
    if (!probe.has_style("pair", "kim")) {
      throw InputError(fmt::format("LAMMPS was built without its package KIM, which {} needs", identifier));
    }
    begin(probe);
  } catch (const LammpsError& error) {
    throw InputError(fmt::format("the KIM model {} cannot be used: {}; {}", identifier, error.what(),
                                 advice(identifier, element)));
  }
  try {
    find_crystal(structure);
    find_cutoff();
    scan();
  } catch (const LammpsError& error) {
    throw InputError(
        fmt::format("the KIM model {} has no crystal of {}: {}", identifier, element, error.what()));
  }
}

void KimModel::begin(Lammps& lammps) const {
  lammps.command("kim init {} metal", identifier_);
  lammps.command("atom_style atomic");
}

void KimModel::apply(Lammps& lammps) const {
  lammps.command("kim interactions {}", element_);
  lammps.command("mass * {:.17g}", mass_);
}

/// The structure stated, or that of least energy at rest among fcc and bcc. Distances of neighbours from 5.5
/// A, longer than those of any metal, inwards to 1.9 A, or to where the model refuses.
void KimModel::find_crystal(std::optional<CrystalStructure> stated) {
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
      // The model knows no such density: what was found before stands, unless it knows none at all.
      if (best == 0.0) throw;
    }
    if (best == 0.0) continue;
    // Zero pressure between the neighbours of the best step.
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
    throw InputError(fmt::format("the KIM model {} binds no crystal of {}", identifier_, element_));
  }
  if (stated) return;
  // Lattice constant of hcp with the ideal axial ratio and the same volume per atom.
  StaticCrystal hexagonal(*this, CrystalStructure::hcp, std::cbrt(volume_at_rest * std::sqrt(2.0)));
  constexpr double clearly = 1e-3;  // eV per atom: a relaxed axial ratio and stacking faults stay below it
  if (hexagonal.present().energy < least - clearly) {
    throw InputError(fmt::format("with the KIM model {} the crystal of {} is hcp; fcc and bcc are supported",
                                 identifier_, element_));
  }
}

/// The distance beyond which two atoms do not feel each other.
void KimModel::find_cutoff() {
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
  throw InputError(fmt::format("two atoms of {} do not interact in the KIM model {}", element_, identifier_));
}

void KimModel::scan() {
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
    throw InputError(fmt::format("with the KIM model {} the crystal of {} carries no compression: {}",
                                 identifier_, element_, reason_));
  }
  for (auto* list : {&volumes_, &energies_, &slopes_}) std::reverse(list->begin(), list->end());
}

double KimModel::crystal_energy(double volume) const {
  if (!(volume >= volumes_.front() && volume <= volumes_.back())) {
    throw StateError(
        fmt::format("the static crystal of the KIM model {} is known from {:.3f} to {:.3f} A^3 per "
                    "atom, not at {:.3f}",
                    identifier_, volumes_.front(), volumes_.back(), volume));
  }
  const auto upper = std::upper_bound(volumes_.begin() + 1, volumes_.end() - 1, volume);
  const auto i = static_cast<std::size_t>(upper - volumes_.begin()) - 1;
  // Cubic through both values and slopes.
  const double h = volumes_[i + 1] - volumes_[i];
  const double t = (volume - volumes_[i]) / h;
  const double s = 1.0 - t;
  return s * s * (1.0 + 2.0 * t) * energies_[i] + t * t * (1.0 + 2.0 * s) * energies_[i + 1] +
         h * t * s * (s * slopes_[i] - t * slopes_[i + 1]);
}

}  // namespace whipple::md
