// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "md_fitting/data_set/crystal_structure.hpp"
#include "md_fitting/lammps/eam_tables.hpp"
#include "md_fitting/lammps/lammps.hpp"
#include "md_fitting/lammps/measured_model.hpp"
#include "md_fitting/lammps/pair_style.hpp"
#include "md_fitting/lammps/validity.hpp"

namespace whipple::md {

/// Returns the folder of the potential files shipped with LAMMPS; the environment variable LAMMPS_POTENTIALS takes
/// precedence.
std::filesystem::path potential_folder();

/// Represents the interatomic potential of one element, checked before a simulation uses it: an embedded-atom
/// potential whose tables the program reads itself, an OpenKIM model, or a LAMMPS pair style.
class Potential {
 public:
  /// Loads a potential by the name of a built-in one ("zhou_2004" for each of its elements), by the extended
  /// identifier of a KIM model, or by a file name: a path, a file in the folder of the plan (`folder`), or a file
  /// in the LAMMPS folder.
  /// @param structure fcc or bcc; none: the one of minimum energy
  /// @param pair      if it has a style: the LAMMPS commands for it; `name` is then arbitrary
  /// @throws InputError if there is no such file or model (listing those available for the element), if it does not
  /// contain the element, if the file is damaged, or if hcp has the minimum energy.
  static Potential load(const std::string& name, const std::string& element,
                        const std::filesystem::path& folder = {},
                        std::optional<CrystalStructure> structure = {}, const PairStyle& pair = {});

  /// Sets units and atom style of an instance that has no box yet.
  void begin(Lammps& lammps) const;
  /// Applies the pair style, the tables and the mass of atom type 1 to an instance with a defined box.
  /// @throws InputError if LAMMPS was built without the pair style.
  void apply(Lammps& lammps) const;

  /// Rejects a state whose density exceeds the embedding table, which LAMMPS would silently extrapolate linearly,
  /// or that is outside the range in which a measured model resists compression.
  /// @param volume_ratio V/V0, V0 that of the static crystal at zero pressure
  /// @throws InputError naming the potential, the end of its range and the state.
  void require_range(double volume_ratio) const;

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  [[nodiscard]] const std::string& source() const { return source_; }
  /// Returns the SHA-256 of the tables as LAMMPS reads them.
  [[nodiscard]] const std::string& hash() const { return hash_; }
  /// Returns whether the potential is defined by tables that the program has read.
  [[nodiscard]] bool has_tables() const { return model_ == nullptr; }
  /// Returns the tables. @throws InternalError for a measured model.
  [[nodiscard]] const EamTables& tables() const;
  [[nodiscard]] const std::string& element() const { return element_; }
  [[nodiscard]] double mass() const { return mass_; }                      ///< g/mol
  [[nodiscard]] CrystalStructure structure() const { return structure_; }  ///< fcc or bcc
  /// Describes how the structure differs from that in the file; empty if it does not.
  [[nodiscard]] const std::string& remark() const { return remark_; }
  [[nodiscard]] int atoms_per_cell() const { return md::atoms_per_cell(structure_); }
  [[nodiscard]] double cutoff() const { return cutoff_; }  ///< A
  /// Returns the energy per atom (eV) of the static crystal with lattice constant a (A).
  /// @throws StateError for a measured model outside the range of the scanned volumes.
  [[nodiscard]] double crystal_energy(double a) const;
  /// Returns the smallest specific volume (m^3/kg) with a known `crystal_energy`; 0: unlimited.
  [[nodiscard]] double least_known_volume() const;
  /// Returns the lattice constant (A) of the static crystal at zero pressure.
  [[nodiscard]] double lattice_constant() const { return lattice_constant_; }
  /// Returns the specific volume (m^3/kg) of the static crystal at zero pressure: V0 of all volume ratios.
  [[nodiscard]] double static_volume() const;
  /// Returns V/V0 at which the static crystal reaches the end of the density table, or of the range of a measured
  /// model; 0: never.
  [[nodiscard]] double table_end() const { return table_end_; }
  /// Returns the smallest admissible V/V0, at which the static crystal still has the margin `density_margin` to the
  /// end of the table, or `volume_margin` to the end of a measured model.
  [[nodiscard]] double least_volume_ratio() const { return least_volume_ratio_; }
  /// Returns the pressure beyond which states are flagged.
  [[nodiscard]] const Validity& validity() const { return validity_; }
  /// Replaces the validity by that stated in the plan.
  void state_validity(Validity validity) { validity_ = std::move(validity); }

  /// Margin for thermal motion, which raises the density at single atoms above that of the static crystal.
  static constexpr double density_margin = 0.10;
  /// Margin in volume for thermal motion in models with unknown electron density; that of metals grows about as 1/V^2.
  static constexpr double volume_margin = 0.05;

 private:
  class TemporaryFile;
  void take_model(std::shared_ptr<const MeasuredModel> model);
  void read_file(const std::string& element, const std::filesystem::path& folder,
                 std::optional<CrystalStructure> stated);
  /// Writes the tables to a temporary file for LAMMPS.
  void write_tables(const std::string& comment);

  std::string name_;
  std::filesystem::path file_;
  std::string source_;
  std::string hash_;
  std::string style_;
  std::string element_;
  CrystalStructure structure_ = CrystalStructure::fcc;
  std::string remark_;
  double mass_ = 0.0;
  double cutoff_ = 0.0;
  EamTables tables_;
  std::shared_ptr<const MeasuredModel> model_;
  double lattice_constant_ = 0.0;
  double table_end_ = 0.0;
  double least_volume_ratio_ = 0.0;
  Validity validity_;
  std::shared_ptr<const TemporaryFile> written_;  // the file that LAMMPS reads, if different from `file_`
};

}  // namespace whipple::md
