// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "src/core/base/words.hpp"
#include "src/decks/unit_system.hpp"

/// Reads decks of MPM3D-F90 (github.com/xzhang66/MPM3D-F90, DataIn.f90 and FFI.f90 as of November 2025). The grammar
/// was implemented from its description; no file of that project is needed.
namespace whipple::decks::mpm3d {

/// Names the commit whose grammar this reader follows.
inline constexpr const char* grammar = "MPM3D-F90, commit 4a6275f";

/// Lists the top-level keywords.
enum class Keyword {
  end_of_input,
  title,
  particles,
  materials,
  components,
  bodies,
  grid,
  span_x,
  span_y,
  span_z,
  cell,
  fixed,
  end_time,
  output_interval,
  report_interval,
  time_step_factor,
  musl,
  usf,
  usl,
  jaumann,
  gimp,
  bspline,
  staggered_grid,
  total_lagrangian,
  smoothed_stress,
  volume_by_deformation,
  quasi_static,
  damping,
  dynamic_relaxation,
  bulk_viscosity,
  material,
  equation_of_state,
  detonation,
  body,
  velocity,
  load,
  contact,
  output_field,
  particle_curve,
  point_curve,
  tecplot,
  paraview,
  window
};
/// Returns the keywords with their words, of which only the first four characters are significant.
constexpr std::array<Word<Keyword>, 43> words(Keyword /*of*/) {
  using enum Keyword;
  return {{{end_of_input, "endi"},
           {title, "mpm3"},
           {particles, "nbmp"},
           {materials, "nmat"},
           {components, "nbco"},
           {bodies, "nbbo"},
           {grid, "grid"},
           {span_x, "spx"},
           {span_y, "spy"},
           {span_z, "spz"},
           {cell, "dcel"},
           {fixed, "fixe"},
           {end_time, "endt"},
           {output_interval, "outt"},
           {report_interval, "rptt"},
           {time_step_factor, "dtsc"},
           {musl, "musl"},
           {usf, "usf"},
           {usl, "usl"},
           {jaumann, "jaum"},
           {gimp, "gimp"},
           {bspline, "bimp"},
           {staggered_grid, "sgmp"},
           {total_lagrangian, "tlmp"},
           {smoothed_stress, "smoo"},
           {volume_by_deformation, "uvfp"},
           {quasi_static, "qulo"},
           {damping, "damp"},
           {dynamic_relaxation, "drda"},
           {bulk_viscosity, "bulk"},
           {material, "mate"},
           {equation_of_state, "seos"},
           {detonation, "deto"},
           {body, "part"},
           {velocity, "velo"},
           {load, "load"},
           {contact, "cont"},
           {output_field, "outr"},
           {particle_curve, "curv"},
           {point_curve, "curx"},
           {tecplot, "tecp"},
           {paraview, "para"},
           {window, "pt2d"}}};
}

/// Holds one statement: a keyword with its arguments, or one entry of a block (a material, a body, a load, a velocity).
struct Statement {
  Keyword keyword = Keyword::end_of_input;
  unsigned line = 0;
  /// Holds the second word: kind of a material, body, load, velocity or contact; field of an output; the title.
  std::string kind = {};
  std::vector<double> numbers = {};

  /// Returns the name for messages: "mate john".
  [[nodiscard]] std::string name() const;
};

struct Deck {
  std::filesystem::path file;
  std::vector<Statement> statements;
  std::optional<UnitSystem> units;  ///< from its comment "! Unit: mm g N ms MPa"
  unsigned units_line = 0;
  std::vector<std::pair<unsigned, std::string>> notes;  ///< parts that MPM3D-F90 does not read, by line

  /// Returns the last statement with a keyword, which is the effective one; null if there is none.
  [[nodiscard]] const Statement* last(Keyword keyword) const;
  [[nodiscard]] std::vector<const Statement*> all(Keyword keyword) const;
};

/// Converts a number of a deck to an integer as MPM3D-F90 does; values outside its integer range are clamped.
int whole(double value);

/// Returns whether a text begins like a deck of MPM3D-F90: its first word is one of the keywords.
bool recognise(std::string_view text);

/// Reads a deck. A statement that cannot be read is a fault, and reading continues at the next line that begins with a
/// keyword, so that all faults of a deck (at most twenty) are reported together.
/// @throws InputError with all faults, each with line and column
Deck parse(const std::filesystem::path& file, std::string_view text);

}  // namespace whipple::decks::mpm3d
