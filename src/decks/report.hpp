// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <string_view>
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

struct Remark {
  Outcome outcome = Outcome::exact;
  unsigned line = 0;  ///< of the deck; 0: of no line
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

  void remark(Outcome outcome, unsigned line, std::string keyword, std::string text) {
    remarks.push_back({outcome, line, std::move(keyword), std::move(text)});
  }
  /// Adds a remark on something that was converted by a choice which the deck does not settle.
  void doubt(unsigned line, std::string keyword, std::string text) {
    remarks.push_back({Outcome::converted, line, std::move(keyword), std::move(text), true});
  }
  [[nodiscard]] std::size_t count(Outcome outcome) const;
  /// Returns the bodies and the four lists of remarks, as `whipple import` prints them and as import.txt holds them.
  [[nodiscard]] std::string report() const;
};

}  // namespace whipple::decks
