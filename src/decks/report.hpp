// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "src/core/base/words.hpp"

namespace whipple::decks {

/// What became of a statement of a deck.
enum class Outcome {
  exact,      ///< the case says the same
  converted,  ///< the case says the same in another way, or nearly the same; the remark tells how
  dropped,    ///< without influence on the physics: output of the other code, its methods
  missing,    ///< physics that the case does not have
};
constexpr std::array<Word<Outcome>, 4> words(Outcome /*of*/) {
  return {{{Outcome::exact, "exact"},
           {Outcome::converted, "converted"},
           {Outcome::dropped, "dropped"},
           {Outcome::missing, "missing"}}};
}

/// Where a statement stands.
struct Place {
  unsigned line = 0;  ///< 0: nowhere
  std::string file;   ///< that the deck includes; empty: the deck

  Place(unsigned line, std::string file = {}) : line(line), file(std::move(file)) {}
};

struct Remark {
  Outcome outcome = Outcome::exact;
  Place place;
  std::string keyword;
  std::string text;
  bool doubtful = false;  ///< a choice that the user should know of: also a warning
};

/// A body of the case as the deck describes it.
struct BodyRow {
  std::string name, shape;
  double particles = 0;
  double mass = 0;  ///< kg
};

/// A file beside the case: a material.
struct CaseFile {
  std::string path;  ///< in the folder of the case, "materials/material_1.toml"
  std::string text;
};

/// A deck as a case: what is to be written, and what is to be said about it.
struct Import {
  std::string deck;     ///< file name of the deck
  std::string grammar;  ///< whose grammar was followed
  std::string units;    ///< "mm g ms"
  std::string case_text;
  std::vector<CaseFile> files;
  std::vector<BodyRow> bodies;
  std::vector<Remark> remarks;

  void remark(Outcome outcome, Place place, std::string keyword, std::string text) {
    remarks.push_back({outcome, std::move(place), std::move(keyword), std::move(text)});
  }
  /// Adds a remark on something that was converted by a choice which the deck does not settle.
  void doubt(Place place, std::string keyword, std::string text) {
    remarks.push_back({Outcome::converted, std::move(place), std::move(keyword), std::move(text), true});
  }
  [[nodiscard]] std::size_t count(Outcome outcome) const;
  /// Sorts the remarks by the lines of the deck, then by those of the files that it includes.
  void sort_remarks();
  /// Returns the bodies and the four lists of remarks, as `whipple import` prints them and as import.txt holds them.
  [[nodiscard]] std::string report() const;
};

}  // namespace whipple::decks
