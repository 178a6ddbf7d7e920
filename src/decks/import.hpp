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

/// Lists the codes whose decks are read.
enum class Format { mpm3d_f90, ls_dyna };
constexpr std::array<Word<Format>, 2> words(Format /*of*/) {
  return {{{Format::mpm3d_f90, "mpm3d_f90"}, {Format::ls_dyna, "ls_dyna"}}};
}

/// Defines the sign convention of the stress triaxiality of a failure strain in a deck.
enum class Triaxiality {
  inferred,  ///< the sign for which tension fails earlier
  tension,   ///< positive in tension, as in Johnson and Cook: D3 < 0
  pressure,  ///< positive in compression: D3 > 0
};
constexpr std::array<Word<Triaxiality>, 3> words(Triaxiality /*of*/) {
  return {{{Triaxiality::inferred, "inferred"},
           {Triaxiality::tension, "tension"},
           {Triaxiality::pressure, "pressure"}}};
}

struct ImportOptions {
  std::optional<Format> format = {};     ///< not given: by the contents of the deck
  std::optional<UnitSystem> units = {};  ///< not given: the units stated in the deck
  bool same_method = false;              ///< keep scheme, shape functions and time step of the other code
  /// Reads decks for MPM3D-F90 before 2013-12, which give the mass of a particle instead of its density.
  bool old_mass = false;
  double cell_size = 0.0;                           ///< of the grid, m; for decks without one
  Triaxiality triaxiality = Triaxiality::inferred;  ///< of decks of LS-DYNA
};

/// Checks that a case file (CASE.toml) is not the deck of another code.
/// @throws InputError with the command that imports the deck
void require_no_deck(const std::filesystem::path& file);

/// Reads a deck and converts it to a case.
/// @throws InputError with all faults of the deck, each with its line; if the code of the deck is unknown; or if its
/// units are neither in the deck nor given
Import import_deck(const std::filesystem::path& deck, const ImportOptions& options);

/// Writes case.toml, materials/ and import.txt into a new folder, which gets its name only when it is complete.
/// @throws InputError if the folder exists or cannot be written
class CaseFolder {
 public:
  CaseFolder(const Import& import, std::filesystem::path folder);
  CaseFolder(const CaseFolder&) = delete;
  CaseFolder& operator=(const CaseFolder&) = delete;
  ~CaseFolder();

  /// Returns the case file in the folder under its temporary name.
  [[nodiscard]] std::filesystem::path case_file() const { return partial_ / "case.toml"; }
  /// Renames the folder to its final name.
  void publish();

 private:
  std::filesystem::path folder_, partial_;
};

/// Writes only case.toml into a folder with the materials of an earlier import.
/// @throws InputError if the folder has no materials, lacks one that the case names, or has a case.toml
void write_case_only(const Import& import, const std::filesystem::path& folder);

}  // namespace whipple::decks
