// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "eos/equation_of_state.hpp"
#include "eos/identities.hpp"
#include "eos/loci.hpp"

/// Examines whether an equation of state, with the constants that it was given, describes a material, and where
/// (docs/theory/equations_of_state.md, section 5). SI.
namespace whipple::eos {

enum class Verdict { sound, reservations, not_usable };

/// One thing that the audit objects to.
struct Finding {
  Verdict weight = Verdict::reservations;
  std::string text;  ///< with the numbers and the limit
};

/// Where the model may be used.
struct ValidRange {
  double least_density = 0;     ///< of cold material in tension, or of the thinnest state asked
  double greatest_density = 0;  ///< compression limit
  double least_temperature = 0;
  double greatest_temperature = 0;  ///< on the isochore of the reference state
  ShockState strongest_shock;       ///< of the principal Hugoniot from the reference state
  std::string end_of_shocks;        ///< why it ends there; empty: the search ended
};

/// Largest defects of the identities in one phase.
struct PhaseIdentities {
  std::string phase;
  int states = 0;
  IdentityDefects largest;
  Verdict verdict = Verdict::sound;
};

struct Audit {
  std::string model;
  State reference;
  ValidRange range;
  bool condensed = false;               ///< the pressure of the reference state is small beside rho c^2
  std::optional<ColdCurve> cold;        ///< of condensed material
  std::optional<MeltingPoint> melting;  ///< at zero pressure
  std::optional<ShockMelting> shock_melting;
  std::optional<CriticalPoint> critical;  ///< of liquid and vapour
  std::optional<Saturation> boiling;      ///< at one atmosphere
  std::vector<PhaseIdentities> identities;
  std::vector<Finding> findings;

  [[nodiscard]] Verdict verdict() const;
  /// "sound", "sound with reservations: …", "not usable: …"
  [[nodiscard]] std::string summary() const;
  /// "density 6300 … 20400 kg/m^3, temperature 1 … 1e+05 K, shocks to 1.2e+03 GPa"
  [[nodiscard]] std::string range_text() const;
};

enum class AuditDepth {
  brief,  ///< reference state, cold curve, Hugoniot, melting and boiling point: some milliseconds
  full,   ///< and stability and identities over density and temperature, melting line
};

/// Audits an equation of state over its range. Throws nothing: a state that the model refuses is a finding.
Audit audit(const EquationOfState& eos, AuditDepth depth = AuditDepth::full);

}  // namespace whipple::eos
