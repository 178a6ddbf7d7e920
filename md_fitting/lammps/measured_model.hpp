// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "md_fitting/data_set/crystal_structure.hpp"
#include "md_fitting/lammps/lammps.hpp"

namespace whipple::md {

/// Holds the LAMMPS commands that define interactions whose functions the program does not read.
struct Interactions {
  struct Command {
    std::string line;
    std::string shown;  ///< for transcripts, without folders
  };
  std::string name;  ///< for messages: "the KIM model ..."
  std::vector<Command> before_box;
  std::vector<Command> in_box;
};

/// Provides the interactions of one element from an OpenKIM model or a LAMMPS pair style. Their functions are not
/// accessible to the program: quantities otherwise read from tables are measured on the static crystal when the
/// model is loaded (docs/theory/molecular_dynamics.md, "Measured models").
class MeasuredModel {
 public:
  /// Finds the structure of minimum energy (unless one is specified), its lattice constant and cutoff, and the
  /// largest compression.
  /// @throws InputError if the model does not contain the element, or if the static crystal is neither fcc nor bcc.
  MeasuredModel(Interactions interactions, const std::string& element,
                std::optional<CrystalStructure> structure = {});

  /// Sets units and atom style of an instance that has no box yet.
  void begin(Lammps& lammps) const;
  /// Applies the interactions to an instance with a box.
  void apply(Lammps& lammps) const;

  [[nodiscard]] double mass() const { return mass_; }  ///< g/mol
  [[nodiscard]] CrystalStructure structure() const { return structure_; }
  [[nodiscard]] double lattice_constant() const { return lattice_constant_; }  ///< A
  [[nodiscard]] double cutoff() const { return cutoff_; }                      ///< A
  /// Returns V/V0 at which the model fails for the static crystal or the crystal no longer resists compression; 0:
  /// not down to `least_scanned_ratio`.
  [[nodiscard]] double end() const { return end_; }
  [[nodiscard]] const std::string& reason_of_end() const { return reason_; }
  /// Returns the energy per atom (eV) of the static crystal at a volume per atom (A^3), interpolated between the
  /// scanned states.
  /// @throws StateError outside their range.
  [[nodiscard]] double crystal_energy(double volume) const;
  /// Returns the pressure (Pa) of the static crystal at V/V0.
  /// @throws StateError outside the range of the scanned states.
  [[nodiscard]] double pressure(double volume_ratio) const;
  /// Returns the smallest scanned volume per atom, A^3.
  [[nodiscard]] double least_volume() const { return volumes_.front(); }

  static constexpr double least_scanned_ratio = 0.30;
  static constexpr double largest_scanned_ratio = 1.60;

 private:
  void find_crystal(std::optional<CrystalStructure> stated);
  void find_cutoff();
  void scan();

  Interactions interactions_;
  std::string element_;
  double mass_ = 0.0;
  CrystalStructure structure_ = CrystalStructure::fcc;
  double lattice_constant_ = 0.0;
  double cutoff_ = 0.0;
  double end_ = 0.0;
  std::string reason_;
  std::vector<double> volumes_, energies_, slopes_;  // ascending volumes; A^3, eV, dE/dV in eV/A^3
};

}  // namespace whipple::md
