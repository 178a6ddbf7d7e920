// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "src/core/base/words.hpp"
#include "src/decks/report.hpp"
#include "src/decks/unit_system.hpp"

namespace whipple::decks {

/// Codes whose decks are read.
enum class Format { mpm3d_f90, ls_dyna };
constexpr std::array<Word<Format>, 2> words(Format /*of*/) {
  return {{{Format::mpm3d_f90, "mpm3d_f90"}, {Format::ls_dyna, "ls_dyna"}}};
}

/// What the stress triaxiality of a failure strain counts positive in a deck.
enum class Triaxiality {
  inferred,  ///< what makes tension break earlier
  tension,   ///< as Johnson and Cook: D3 < 0
  pressure,  ///< D3 > 0
};
constexpr std::array<Word<Triaxiality>, 3> words(Triaxiality /*of*/) {
  return {{{Triaxiality::inferred, "inferred"},
           {Triaxiality::tension, "tension"},
           {Triaxiality::pressure, "pressure"}}};
}

struct ImportOptions {
  std::optional<Format> format = {};     ///< not given: by the content of the deck
  std::optional<UnitSystem> units = {};  ///< not given: those that the deck names
  bool same_method = false;              ///< keep scheme, shape functions and time step of the other code
  /// MPM3D-F90 before 2013-12: the mass of a particle stands where now its density does.
  bool old_mass = false;
  double cell_size = 0.0;                           ///< of the grid, m; for decks without one
  Triaxiality triaxiality = Triaxiality::inferred;  ///< of decks of LS-DYNA
};

/// Throws if a file that is to be a case (CASE.toml) is the deck of another code, with the command that imports it.
void require_no_deck(const std::filesystem::path& file);

/// Reads a deck and turns it into a case.
/// @throws InputError with all faults of the deck, each with its line; if the deck is of no known code; if its units are
///         neither in the deck nor given
Import import_deck(const std::filesystem::path& deck, const ImportOptions& options);

/// Writes case.toml, materials/ and import.txt into a new folder, which appears only when it is complete.
/// @throws InputError if the folder exists or can not be written
class CaseFolder {
 public:
  CaseFolder(const Import& import, std::filesystem::path folder);
  CaseFolder(const CaseFolder&) = delete;
  CaseFolder& operator=(const CaseFolder&) = delete;
  ~CaseFolder();

  /// Returns the case file in the folder as long as that has a name of its own.
  [[nodiscard]] std::filesystem::path case_file() const { return partial_ / "case.toml"; }
  /// Gives the folder its name.
  void publish();

 private:
  std::filesystem::path folder_, partial_;
};

/// Writes case.toml alone into a folder with the materials of an earlier import.
/// @throws InputError if the folder has no materials, lacks one that the case names, or has a case.toml
void write_case_only(const Import& import, const std::filesystem::path& folder);

}  // namespace whipple::decks
