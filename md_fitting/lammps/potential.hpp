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

/// The folder of the potential files that LAMMPS ships; the environment variable LAMMPS_POTENTIALS comes
/// first.
std::filesystem::path potential_folder();

/// The interatomic potential of one element, checked before a simulation uses it: an embedded-atom potential
/// whose tables the program reads itself, a model of OpenKIM, or a pair style of LAMMPS.
class Potential {
 public:
  /// Loads a potential by the name of a known one ("zhou_2004" for each of its elements), by the extended
  /// identifier of a KIM model, or by a file name: a path, a file beside the plan (`folder`), or a file in
  /// LAMMPS' folder.
  /// @param structure fcc or bcc; none: that of least energy
  /// @param pair      with a style: LAMMPS' commands for it, and `name` is free
  /// @throws InputError if there is no such file or model (listing the ones for the element), if the element
  /// is not in it, if the file is damaged, or if hcp has the least energy.
  static Potential load(const std::string& name, const std::string& element,
                        const std::filesystem::path& folder = {},
                        std::optional<CrystalStructure> structure = {}, const PairStyle& pair = {});

  /// Units and atom style of an instance that has no box yet.
  void begin(Lammps& lammps) const;
  /// Gives an instance with a defined box the pair style, the tables and the mass of atom type 1.
  /// @throws InputError if LAMMPS was built without the pair style.
  void apply(Lammps& lammps) const;

  /// Refuses a state whose density leaves the embedding table, where LAMMPS would silently continue it by a
  /// straight line, or the range in which a measured model was found to bear compression.
  /// @param volume_ratio V/V0, V0 that of the static crystal at zero pressure
  /// @throws InputError naming the potential, the end of its range and the state.
  void require_range(double volume_ratio) const;

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  [[nodiscard]] const std::string& source() const { return source_; }
  /// SHA-256 of the tables as LAMMPS reads them.
  [[nodiscard]] const std::string& hash() const { return hash_; }
  /// Returns whether its functions are those of tables that the program read.
  [[nodiscard]] bool has_tables() const { return model_ == nullptr; }
  /// @throws InternalError for a measured model.
  [[nodiscard]] const EamTables& tables() const;
  [[nodiscard]] const std::string& element() const { return element_; }
  [[nodiscard]] double mass() const { return mass_; }                      ///< g/mol
  [[nodiscard]] CrystalStructure structure() const { return structure_; }  ///< fcc or bcc
  /// How the structure differs from what the file says; empty: it does not.
  [[nodiscard]] const std::string& remark() const { return remark_; }
  [[nodiscard]] int atoms_per_cell() const { return md::atoms_per_cell(structure_); }
  [[nodiscard]] double cutoff() const { return cutoff_; }  ///< A
  /// Energy per atom (eV) of the static crystal with lattice constant a (A).
  /// @throws StateError for a measured model beyond the volumes that were scanned.
  [[nodiscard]] double crystal_energy(double a) const;
  /// Least specific volume (m^3/kg) with a known `crystal_energy`; 0: all.
  [[nodiscard]] double least_known_volume() const;
  /// Lattice constant (A) of the static crystal at zero pressure.
  [[nodiscard]] double lattice_constant() const { return lattice_constant_; }
  /// Specific volume (m^3/kg) of the static crystal at zero pressure: the V0 of all volume ratios.
  [[nodiscard]] double static_volume() const;
  /// V/V0 at which the static crystal reaches the end of the density table, or of the range of a measured
  /// model; 0: never.
  [[nodiscard]] double table_end() const { return table_end_; }
  /// Least admissible V/V0: there the static crystal still keeps `density_margin` to the end of the table, or
  /// `volume_margin` to the end of a measured model.
  [[nodiscard]] double least_volume_ratio() const { return least_volume_ratio_; }
  /// Pressure beyond which states are flagged.
  [[nodiscard]] const Validity& validity() const { return validity_; }
  /// Replaces it by what the plan states.
  void state_validity(Validity validity) { validity_ = std::move(validity); }

  /// Thermal motion raises the density of single atoms above that of the static crystal at the same volume.
  static constexpr double density_margin = 0.10;
  /// Leaves this part of the volume for thermal motion in models whose electron density is not known; that of
  /// metals grows about as 1/V^2.
  static constexpr double volume_margin = 0.05;

 private:
  class TemporaryFile;
  void take_model(std::shared_ptr<const MeasuredModel> model);
  void read_file(const std::string& element, const std::filesystem::path& folder,
                 std::optional<CrystalStructure> stated);
  /// Tables that LAMMPS reads from a file made for it.
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
  std::shared_ptr<const TemporaryFile> written_;  // what LAMMPS reads, if it is not `file_` itself
};

}  // namespace whipple::md
