// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "eos/equation_of_state.hpp"
#include "eos/identities.hpp"
#include "eos/loci.hpp"

/// Examines whether an equation of state with the given constants describes a material, and over which range
/// (docs/theory/equations_of_state.md, section 5). SI.
namespace whipple::eos {

enum class Verdict { sound, reservations, not_usable };

/// Holds one objection of the audit.
struct Finding {
  Verdict weight = Verdict::reservations;
  std::string text;  ///< with the numbers and the limit
};

/// Holds the range in which the model may be used.
struct ValidRange {
  double least_density = 0;     ///< of cold material in tension, or of the most dilute requested state
  double greatest_density = 0;  ///< compression limit
  double least_temperature = 0;
  double greatest_temperature = 0;  ///< on the isochore of the reference state
  ShockState strongest_shock;       ///< of the principal Hugoniot from the reference state
  std::string end_of_shocks;  ///< reason for the end of the Hugoniot; empty: the search range was exhausted
};

/// Holds the largest defects of the identities in one phase.
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
  bool condensed = false;         ///< the pressure of the reference state is small compared with rho c^2
  std::optional<ColdCurve> cold;  ///< of condensed material
  std::optional<MeltingPoint> melting;  ///< at zero pressure
  std::optional<ShockMelting> shock_melting;
  std::optional<CriticalPoint> critical;  ///< of liquid and vapour
  std::optional<Saturation> boiling;      ///< at one atmosphere
  std::vector<PhaseIdentities> identities;
  std::vector<Finding> findings;

  [[nodiscard]] Verdict verdict() const;
  /// Returns "sound", "sound with reservations: …" or "not usable: …".
  [[nodiscard]] std::string summary() const;
  /// Returns e.g. "density 6300 … 20400 kg/m^3, temperature 1 … 1e+05 K, shocks to 1.2e+03 GPa".
  [[nodiscard]] std::string range_text() const;
};

enum class AuditDepth {
  brief,  ///< reference state, cold curve, Hugoniot, melting and boiling point: a few milliseconds
  full,   ///< in addition stability and identities over density and temperature, melting line
};

/// Audits an equation of state over its range. Never throws: a state rejected by the model is a finding.
Audit audit(const EquationOfState& eos, AuditDepth depth = AuditDepth::full);

}  // namespace whipple::eos
