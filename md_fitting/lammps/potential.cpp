// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/lammps/potential.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <vector>

#include "md_fitting/lammps/eam_files.hpp"
#include "md_fitting/lammps/kim_model.hpp"
#include "md_fitting/lammps/units.hpp"
#include "md_fitting/lammps/zhou_2004.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/hash.hpp"
#include "src/core/base/temporary_folder.hpp"
#include "src/core/base/text.hpp"

namespace whipple::md {
namespace {

/// Describes a built-in potential.
struct KnownPotential {
  const char* name;
  const char* element;
  const char* file;    ///< in the LAMMPS potentials folder
  double cutoff;       ///< A, overrides that of the file; 0: that of the file
  const char* source;  ///< publication
};

// Cu_mishin1.eam.alloy, the file that LAMMPS ships for Mishin's copper, ends at 1.64 times the equilibrium density,
// which the static crystal reaches at V/V0 = 0.72 (102 GPa). The copper block of the angular-dependent Al-Cu
// potential is the same function with a table that extends to 22 times that density; its angular part is zero for
// copper. Beyond 5.5076 A, the cutoff of the publication, its functions are below 1e-12: the larger cutoff of the
// file only increases the cost.
constexpr std::array known = {
    KnownPotential{
        "copper_mishin_2001", "Cu", "AlCu.adp", 5.5076,
        "Mishin, Mehl, Papaconstantopoulos, Voter, Kress, Phys. Rev. B 63 (2001) 224106; tables from the "
        "Cu block of Apostol, Mishin, Phys. Rev. B 83 (2011) 054116"},
    KnownPotential{"copper_universal_3", "Cu", "Cu_u3.eam", 0.0,
                   "Foiles, Baskes, Daw, Phys. Rev. B 33 (1986) 7983"},
    KnownPotential{"copper_universal_6", "Cu", "Cu_u6.eam", 0.0,
                   "Adams, Foiles, Wolfer, J. Mater. Res. 4 (1989) 102"},
    KnownPotential{"aluminium_mendelev_2008", "Al", "Al_mm.eam.fs", 0.0,
                   "Mendelev, Kramer, Becker, Asta, Philos. Mag. 88 (2008) 1723"},
    KnownPotential{
        "aluminium_voter_chen_1987", "Al", "CoAl.eam.alloy", 0.0,
        "Voter, Chen, Mater. Res. Soc. Symp. Proc. 82 (1987) 175; tables from the Al block of Vailhe, "
        "Farkas, J. Mater. Res. 12 (1997) 2559"},
    KnownPotential{"nickel_universal_3", "Ni", "Ni_u3.eam", 0.0,
                   "Foiles, Baskes, Daw, Phys. Rev. B 33 (1986) 7983"},
};

/// Returns the files of a folder that contain the element, for error messages.
std::vector<std::string> files_for(const std::string& element, const std::filesystem::path& folder) {
  std::vector<std::string> names;
  std::error_code fault;
  for (const auto& entry : std::filesystem::directory_iterator(folder, fault)) {
    try {
      const std::vector<std::string> elements = elements_in(entry.path());
      if (std::find(elements.begin(), elements.end(), element) != elements.end()) {
        names.push_back(entry.path().filename().string());
      }
    } catch (const InputError&) {
      // Not a potential file of a known format.
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::filesystem::path find_file(const std::string& name, const std::string& element,
                                const std::filesystem::path& folder) {
  const std::filesystem::path path(name);
  std::vector<std::filesystem::path> places;
  if (path.is_absolute()) {
    places = {path};
  } else {
    places = {folder / path, potential_folder() / path};
  }
  for (const std::filesystem::path& place : places) {
    if (std::filesystem::is_regular_file(place)) return place;
  }
  std::vector<std::string> choices;
  for (const KnownPotential& potential : known) {
    if (element == potential.element) choices.emplace_back(potential.name);
  }
  const std::vector<std::string> formulas = zhou_2004_elements();
  if (std::find(formulas.begin(), formulas.end(), element) != formulas.end()) {
    choices.emplace_back(zhou_2004_name);
  }
  for (std::string& file : files_for(element, potential_folder())) choices.push_back(std::move(file));
  throw InputError(fmt::format("there is no potential '{}'{}; for {} there are: {} (files in {})", name,
                               did_you_mean(name, choices), element, fmt::join(choices, ", "),
                               potential_folder().string()));
}

/// Truncates all functions at the cutoff; the truncated part must be zero.
void shorten(EamTables& tables, double cutoff, const std::string& name) {
  for (std::size_t i = 0; i < tables.density.size(); ++i) {
    const double r = tables.radius_step * static_cast<double>(i);
    if (r >= cutoff && (std::abs(tables.density[i]) > 1e-9 || std::abs(tables.radius_times_pair[i]) > 1e-9)) {
      throw InputError(
          fmt::format("potential {}: its functions do not vanish beyond {} A (at {} A: density {}, "
                      "r phi {} eV A)",
                      name, cutoff, r, tables.density[i], tables.radius_times_pair[i]));
    }
  }
  tables.cutoff = cutoff;
}

/// Returns whether a text is ASCII; LAMMPS replaces other characters in its commands.
bool is_ascii(const std::string& text) {
  return std::ranges::all_of(text, [](unsigned char c) { return c < 0x80; });
}

/// Chooses the cubic structure of minimum energy, unless the plan states one: headers of potential files are
/// written by hand, and some programs that fit alloys support fcc only.
/// @return the difference from the header; empty if none
std::string choose_structure(EamTables& tables, std::optional<CrystalStructure> stated,
                             const std::string& name) {
  constexpr double clearly = 5e-3;  // eV per atom: typical difference of fcc and hcp in fcc metals
  const std::optional<CrystalStructure> header = value_of<CrystalStructure>(tables.header_structure);
  const bool cubic = header == CrystalStructure::fcc || header == CrystalStructure::bcc;
  const double header_volume = std::pow(tables.header_lattice_constant, 3) / tables.atoms_per_cell();
  struct Candidate {
    EamTables tables;
    double volume, energy;
  };
  std::vector<Candidate> candidates;
  for (const CrystalStructure structure : {CrystalStructure::fcc, CrystalStructure::bcc}) {
    if (stated && structure != *stated) continue;
    EamTables own = tables;
    own.structure = structure;
    // The search is bracketed by the header, at its volume per atom.
    if (structure != header) {
      own.header_lattice_constant = cubic ? std::cbrt(header_volume * own.atoms_per_cell()) : 0.0;
    }
    try {
      const double a = own.static_lattice_constant();
      candidates.push_back({own, a * a * a / own.atoms_per_cell(), own.crystal_energy(a)});
    } catch (const InputError& fault) {
      // A structure used for comparison need not exist.
      if (structure == (stated ? stated : header))
        throw InputError(fmt::format("potential {}: {}", name, fault.what()));
    }
  }
  if (candidates.empty()) {
    throw InputError(
        fmt::format("potential {}: neither fcc nor bcc {} has an energy minimum", name, tables.element));
  }
  const auto rank = [&](const Candidate& c) {
    return c.energy - (c.tables.structure == header ? clearly : 0.0);
  };
  const Candidate& best = *std::ranges::min_element(candidates, {}, rank);
  tables.structure = best.tables.structure;
  tables.header_lattice_constant = best.tables.header_lattice_constant;
  if (stated) return "";
  const double hexagonal = tables.hexagonal_energy(best.volume);
  if (hexagonal < best.energy - clearly) {
    throw InputError(fmt::format(
        "with the potential {} hcp {} has {:.4f} eV per atom, {} {:.4f}: the crystal is hcp; fcc and bcc are "
        "supported (structure = \"{}\" in the plan overrides this)",
        name, tables.element, hexagonal, word_of(tables.structure), best.energy, word_of(tables.structure)));
  }
  if (tables.structure == header) return "";
  std::string energies;
  for (const Candidate& c : candidates) {
    energies +=
        fmt::format("{}{} {:.4f}", energies.empty() ? "" : ", ", word_of(c.tables.structure), c.energy);
  }
  return fmt::format(
      "potential {}: the header gives {} the structure '{}', but {} has the lowest energy ({} eV "
      "per atom) and is taken; `structure` in the plan states another",
      name, tables.element, tables.header_structure, word_of(tables.structure), energies);
}

}  // namespace

/// Holds a file in a new folder below the system's temporary folder, removed with its last user.
class Potential::TemporaryFile {
 public:
  TemporaryFile(const std::string& name, const std::string& content)
      : folder_(place()), path_(folder_.path() / name) {
    write_text_atomically(path_, content);
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  /// Returns the parent folder, since LAMMPS reads ASCII paths only.
  static std::filesystem::path place() {
    const std::filesystem::path usual = std::filesystem::temp_directory_path();
    return is_ascii(usual.string()) ? usual : "/tmp";
  }

  TemporaryFolder folder_;
  std::filesystem::path path_;
};

std::filesystem::path potential_folder() {
  const char* chosen = std::getenv("LAMMPS_POTENTIALS");
  return chosen != nullptr && *chosen != '\0' ? chosen : WHIPPLE_LAMMPS_POTENTIALS;
}

Potential Potential::load(const std::string& name, const std::string& element,
                          const std::filesystem::path& folder, std::optional<CrystalStructure> structure,
                          const PairStyle& pair) {
  Potential potential;
  potential.name_ = name;
  potential.element_ = element;
  if (!pair.style.empty()) {
    PairInteractions own = pair_interactions(pair, name, folder);
    potential.style_ = pair.style;
    potential.source_ = own.interactions.name;
    potential.hash_ = own.hash;
    potential.take_model(
        std::make_shared<const MeasuredModel>(std::move(own.interactions), element, structure));
    return potential;
  }
  if (is_kim_identifier(name)) {
    potential.style_ = "kim";
    potential.source_ = "OpenKIM, https://openkim.org/id/" + name;
    // The identifier with its version identifies the content of the model: KIM never changes one without the other.
    potential.hash_ = sha256("KIM model " + name);
    potential.take_model(
        std::make_shared<const MeasuredModel>(kim_interactions(name, element), element, structure));
    return potential;
  }
  if (name == zhou_2004_name) {
    potential.tables_ = zhou_2004(element);
    potential.remark_ = choose_structure(potential.tables_, structure, name);
    potential.file_ = name;
    potential.source_ = "Zhou, Johnson, Wadley, Phys. Rev. B 69 (2004) 144113";
    potential.write_tables(fmt::format("{} by the formulas of {}", element, potential.source_));
  } else {
    potential.read_file(element, folder, structure);
  }
  potential.structure_ = potential.tables_.structure;
  potential.mass_ = potential.tables_.mass;
  potential.cutoff_ = potential.tables_.cutoff;
  potential.lattice_constant_ = potential.tables_.static_lattice_constant();
  const double end = potential.tables_.density_end();
  potential.table_end_ = potential.tables_.volume_ratio_at(end);
  potential.least_volume_ratio_ = potential.tables_.volume_ratio_at(end / (1.0 + density_margin));
  potential.validity_ = validity_of(potential.tables_, potential.least_volume_ratio_);
  return potential;
}

void Potential::take_model(std::shared_ptr<const MeasuredModel> model) {
  model_ = std::move(model);
  file_ = name_;
  structure_ = model_->structure();
  mass_ = model_->mass();
  cutoff_ = model_->cutoff();
  lattice_constant_ = model_->lattice_constant();
  table_end_ = model_->end();
  least_volume_ratio_ =
      table_end_ > 0.0 ? (1.0 + volume_margin) * table_end_ : MeasuredModel::least_scanned_ratio + 0.01;
  if (table_end_ > 0.0) validity_ = {model_->pressure(least_volume_ratio_), model_->reason_of_end()};
}

void Potential::read_file(const std::string& element, const std::filesystem::path& folder,
                          std::optional<CrystalStructure> stated) {
  const auto entry =
      std::find_if(known.begin(), known.end(), [&](const auto& one) { return name_ == one.name; });
  const bool by_name = entry != known.end();
  if (by_name && element != entry->element) {
    throw InputError(fmt::format("potential {} is for {}, not for {}", name_, entry->element, element));
  }
  file_ = find_file(by_name ? entry->file : name_, element, folder);
  tables_ = read_eam(file_, element);
  remark_ = choose_structure(tables_, stated, name_);
  source_ = by_name ? entry->source : "the file " + file_.filename().string();
  const EamFormat format = eam_format(file_);
  if (format == EamFormat::angular_dependent) {
    if (by_name && entry->cutoff > 0.0) shorten(tables_, entry->cutoff, name_);
    write_tables(fmt::format("{} out of {}", element, file_.string()));
  } else {
    style_ = format == EamFormat::funcfl ? "eam" : format == EamFormat::setfl ? "eam/alloy" : "eam/fs";
    const std::string content = read_text(file_);
    hash_ = sha256(content);
    if (!is_ascii(file_.string())) {
      written_ = std::make_shared<TemporaryFile>(
          "potential" + file_.filename().string().substr(file_.filename().string().find(".eam")), content);
    }
  }
}

void Potential::write_tables(const std::string& comment) {
  style_ = "eam/alloy";
  // The hash covers the tables only: the comment does not affect the physics.
  hash_ = sha256(to_setfl(tables_, ""));
  written_ = std::make_shared<TemporaryFile>(element() + ".eam.alloy", to_setfl(tables_, comment));
}

void Potential::begin(Lammps& lammps) const {
  if (model_) {
    model_->begin(lammps);
    return;
  }
  lammps.command("units metal");
  lammps.command("atom_style atomic");
}

void Potential::apply(Lammps& lammps) const {
  if (model_) {
    model_->apply(lammps);
    return;
  }
  if (!lammps.has_style("pair", style_)) {
    throw InputError(
        fmt::format("LAMMPS was built without the pair style {}, which {} needs", style_, name_));
  }
  const std::filesystem::path& path = written_ ? written_->path() : file_;
  const std::string elements = style_ == "eam" ? "" : " " + element();
  lammps.command("pair_style {}", style_);
  lammps.command_shown_as(fmt::format("pair_coeff * * \"{}\"{}", path.string(), elements),
                          fmt::format("pair_coeff * * \"{}\"{}", path.filename().string(), elements));
  // pair_coeff sets the mass in the file; reset it to the value used in all conversions.
  lammps.command("mass 1 {:.17g}", mass());
}

void Potential::require_range(double volume_ratio) const {
  if (volume_ratio >= least_volume_ratio_) return;
  if (model_ && table_end_ > 0.0) {
    throw InputError(fmt::format(
        "potential {}: at V/V0 = {:.3f} {} ({}); V/V0 = {:.3f} is refused, the least that leaves {:.0f} % of "
        "volume for thermal motion is {:.3f}",
        name_, table_end_, model_->reason_of_end(), word_of(structure_), volume_ratio, 100 * volume_margin,
        least_volume_ratio_));
  }
  if (model_) {
    throw InputError(
        fmt::format("potential {}: the static crystal was tried down to V/V0 = {:.2f}; {:.3f} is "
                    "refused",
                    name_, least_volume_ratio_, volume_ratio));
  }
  throw InputError(
      fmt::format("potential {}: density table ends at V/V0 = {:.3f} (static {} crystal of {}); V/V0 = "
                  "{:.3f} is refused, the least "
                  "that leaves {:.0f} % of density for thermal motion is {:.3f}",
                  name_, table_end_, word_of(tables_.structure), file_.filename().string(), volume_ratio,
                  100 * density_margin, least_volume_ratio_));
}

double Potential::static_volume() const {
  const double a = lattice_constant_;
  return metal::specific_volume(a * a * a / atoms_per_cell(), mass());
}

const EamTables& Potential::tables() const {
  if (model_) throw InternalError("a measured model has no tables");
  return tables_;
}

double Potential::crystal_energy(double a) const {
  return model_ ? model_->crystal_energy(a * a * a / atoms_per_cell()) : tables_.crystal_energy(a);
}

double Potential::least_known_volume() const {
  return model_ ? metal::specific_volume(model_->least_volume(), mass()) : 0.0;
}

}  // namespace whipple::md
