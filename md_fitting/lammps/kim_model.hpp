// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "md_fitting/data_set/crystal_structure.hpp"
#include "md_fitting/lammps/lammps.hpp"

namespace whipple::md {

/// A model of the OpenKIM repository (Tadmor et al., JOM 63 (2011) 17) for one element, run by LAMMPS'
/// command `kim`. Its functions are not open to the program: what a file's tables would tell is measured on
/// the static crystal when the model is loaded (docs/theory/molecular_dynamics.md, "Models of OpenKIM").
class KimModel {
 public:
  /// Returns whether a name is an extended KIM identifier: NAME__MO_123456789012_000, or SM for simulator models. The
  /// last number is the version; the identifier stands for one content for ever.
  static bool is_identifier(const std::string& name);

  /// Finds the structure of least energy (unless one is stated), its lattice constant and cutoff, and how far
  /// it can be compressed.
  /// @throws InputError if LAMMPS has no KIM package, if the model is not installed (naming those for the
  /// element), if the element is not in it, or if the static crystal is neither fcc nor bcc.
  KimModel(const std::string& identifier, const std::string& element,
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
  /// Least scanned volume per atom, A^3.
  [[nodiscard]] double least_volume() const { return volumes_.front(); }

  static constexpr double least_scanned_ratio = 0.30;
  static constexpr double largest_scanned_ratio = 1.60;

 private:
  void find_crystal(std::optional<CrystalStructure> stated);
  void find_cutoff();
  void scan();

  std::string identifier_;
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
