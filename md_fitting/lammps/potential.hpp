// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "md_fitting/lammps/eam_tables.hpp"
#include "md_fitting/lammps/lammps.hpp"

namespace whipple::md {

/// The folder of the potential files that LAMMPS ships; the environment variable LAMMPS_POTENTIALS comes
/// first.
std::filesystem::path potential_folder();

/// An embedded-atom potential of one element, checked before LAMMPS sees it.
class Potential {
 public:
  /// Loads a potential by the name of a known one ("zhou_2004" for each of its elements), or by a file name:
  /// a path, a file beside the plan (`folder`), or a file in LAMMPS' folder.
  /// @throws InputError if there is no such file (listing the ones for the element), if the element is not in
  /// it, or if the file is damaged.
  static Potential load(const std::string& name, const std::string& element,
                        const std::filesystem::path& folder = {});

  /// Gives an instance with a defined box the pair style, the tables and the mass of atom type 1.
  /// @throws InputError if LAMMPS was built without the pair style.
  void apply(Lammps& lammps) const;

  /// Refuses a state whose density leaves the embedding table, where LAMMPS would silently continue it by a
  /// straight line.
  /// @param volume_ratio V/V0, V0 that of the static crystal at zero pressure
  /// @throws InputError naming the potential, the end of its table and the state.
  void require_range(double volume_ratio) const;

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  [[nodiscard]] const std::string& source() const { return source_; }
  /// SHA-256 of the tables as LAMMPS reads them.
  [[nodiscard]] const std::string& hash() const { return hash_; }
  [[nodiscard]] const EamTables& tables() const { return tables_; }
  [[nodiscard]] const std::string& element() const { return tables_.element; }
  [[nodiscard]] double mass() const { return tables_.mass; }  ///< g/mol
  /// Lattice constant (A) of the static crystal at zero pressure.
  [[nodiscard]] double lattice_constant() const { return lattice_constant_; }
  /// Specific volume (m^3/kg) of the static crystal at zero pressure: the V0 of all volume ratios.
  [[nodiscard]] double static_volume() const;
  /// V/V0 at which the static crystal reaches the end of the density table; 0: never.
  [[nodiscard]] double table_end() const { return table_end_; }
  /// Least admissible V/V0: there the static crystal still keeps `density_margin` to the end of the table.
  [[nodiscard]] double least_volume_ratio() const { return least_volume_ratio_; }

  /// Thermal motion raises the density of single atoms above that of the static crystal at the same volume.
  static constexpr double density_margin = 0.10;

 private:
  class TemporaryFile;
  void read_file(const std::string& element, const std::filesystem::path& folder);
  /// Tables that LAMMPS reads from a file made for it.
  void write_tables(const std::string& comment);

  std::string name_;
  std::filesystem::path file_;
  std::string source_;
  std::string hash_;
  std::string style_;
  EamTables tables_;
  double lattice_constant_ = 0.0;
  double table_end_ = 0.0;
  double least_volume_ratio_ = 0.0;
  std::shared_ptr<const TemporaryFile> written_;  // what LAMMPS reads, if it is not `file_` itself
};

}  // namespace whipple::md
