// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "src/core/base/words.hpp"

namespace whipple::decks {

/// Describes the result of importing a statement.
enum class Outcome {
  exact,      ///< the case contains the same
  converted,  ///< the case contains an equivalent or nearly the same; the remark describes how
  dropped,    ///< without influence on the physics: output or methods of the other code
  missing,    ///< physics that the case does not have
};
constexpr std::array<Word<Outcome>, 4> words(Outcome /*of*/) {
  return {{{Outcome::exact, "exact"},
           {Outcome::converted, "converted"},
           {Outcome::dropped, "dropped"},
           {Outcome::missing, "missing"}}};
}

/// Holds the location of a statement.
struct Place {
  unsigned line = 0;  ///< 0: none
  std::string file;   ///< included file; empty: the deck

  Place(unsigned line, std::string file = {}) : line(line), file(std::move(file)) {}
};

struct Remark {
  Outcome outcome = Outcome::exact;
  Place place;
  std::string keyword;
  std::string text;
  bool doubtful = false;  ///< a choice to be checked by the user: also a warning
};

/// Describes a body of the case as defined in the deck.
struct BodyRow {
  std::string name, shape;
  double particles = 0;
  double mass = 0;  ///< kg
};

/// Holds a file written with the case: a material.
struct CaseFile {
  std::string path;  ///< in the folder of the case, "materials/material_1.toml"
  std::string text;
};

/// Holds a deck converted to a case: the files to write, and the remarks.
struct Import {
  std::string deck;     ///< file name of the deck
  std::string grammar;  ///< program and version whose grammar was followed
  std::string units;    ///< "mm g ms"
  std::string case_text;
  std::vector<CaseFile> files;
  std::vector<BodyRow> bodies;
  std::vector<Remark> remarks;

  void remark(Outcome outcome, Place place, std::string keyword, std::string text) {
    remarks.push_back({outcome, std::move(place), std::move(keyword), std::move(text)});
  }
  /// Adds a remark on a choice made in the conversion that the deck does not determine.
  void doubt(Place place, std::string keyword, std::string text) {
    remarks.push_back({Outcome::converted, std::move(place), std::move(keyword), std::move(text), true});
  }
  [[nodiscard]] std::size_t count(Outcome outcome) const;
  /// Sorts the remarks by the lines of the deck, then by those of the included files.
  void sort_remarks();
  /// Returns the bodies and the four lists of remarks, as printed by `whipple import` and written to import.txt.
  [[nodiscard]] std::string report() const;
};

}  // namespace whipple::decks
