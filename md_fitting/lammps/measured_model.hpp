// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "md_fitting/data_set/crystal_structure.hpp"
#include "md_fitting/lammps/lammps.hpp"

namespace whipple::md {

/// Commands that give a LAMMPS instance interactions whose functions the program does not read.
struct Interactions {
  struct Command {
    std::string line;
    std::string shown;  ///< in transcripts, without folders
  };
  std::string name;  ///< for messages: "the KIM model ..."
  std::vector<Command> before_box;
  std::vector<Command> in_box;
};

/// Interactions of one element, a model of OpenKIM or a pair style of LAMMPS. Their functions are not open to
/// the program: what a file's tables would tell is measured on the static crystal when the model is loaded
/// (docs/theory/molecular_dynamics.md, "Measured models").
class MeasuredModel {
 public:
  /// Finds the structure of least energy (unless one is stated), its lattice constant and cutoff, and how far
  /// it can be compressed.
  /// @throws InputError if the element is not in it, or if the static crystal is neither fcc nor bcc.
  MeasuredModel(Interactions interactions, const std::string& element,
                std::optional<CrystalStructure> structure = {});

  /// Units and atom style of an instance that has no box yet.
  void begin(Lammps& lammps) const;
  /// The interactions of an instance with a box.
  void apply(Lammps& lammps) const;

  [[nodiscard]] double mass() const { return mass_; }  ///< g/mol
  [[nodiscard]] CrystalStructure structure() const { return structure_; }
  [[nodiscard]] double lattice_constant() const { return lattice_constant_; }  ///< A
  [[nodiscard]] double cutoff() const { return cutoff_; }                      ///< A
  /// V/V0 at which the model refuses the static crystal or the crystal ceases to resist compression; 0: not
  /// down to `least_scanned_ratio`.
  [[nodiscard]] double end() const { return end_; }
  [[nodiscard]] const std::string& reason_of_end() const { return reason_; }
  /// Energy per atom (eV) of the static crystal at a volume per atom (A^3), between the scanned states.
  /// @throws StateError outside of them.
  [[nodiscard]] double crystal_energy(double volume) const;
  /// Pressure (Pa) of the static crystal at V/V0.
  /// @throws StateError outside of the scanned states.
  [[nodiscard]] double pressure(double volume_ratio) const;
  /// Least scanned volume per atom, A^3.
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
