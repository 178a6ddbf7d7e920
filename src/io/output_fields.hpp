// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "src/core/base/vector_math.hpp"
#include "src/particles/particles.hpp"

namespace whipple::io {

/// Lists the phases as numbered in the output files and the phase masses of history.csv.
enum class Phase : std::uint8_t { solid = 0, melting = 1, liquid = 2, vapour = 3 };

/// Returns the phase of a point from its mass fractions: vapour if at least half of the mass is vapour; otherwise solid
/// below 1 % of melt, liquid above 99 %, melting between. The margins prevent points at the edge of the melting range
/// (where round-off causes a fraction of 1e-12) from being counted as melting.
constexpr double least_vapour = 0.5, least_melting = 0.01, greatest_melting = 0.99;
constexpr Phase phase(double melted_fraction, double vaporised_fraction) {
  if (vaporised_fraction >= least_vapour) return Phase::vapour;
  if (melted_fraction < least_melting) return Phase::solid;
  return melted_fraction <= greatest_melting ? Phase::melting : Phase::liquid;
}

/// Returns which of four points are solid, melting, liquid, vapour.
inline std::array<LanesMask, 4> phases(Lanes melted_fraction, Lanes vaporised_fraction) {
  const LanesMask vapour = vaporised_fraction >= least_vapour,
                  solid = ~vapour & (melted_fraction < least_melting),
                  liquid = ~vapour & (melted_fraction > greatest_melting);
  return {solid, ~(vapour | solid | liquid), liquid, vapour};
}

/// Holds the data from which a field is computed.
struct FieldSource {
  const Particles& particles;
  std::span<const std::uint16_t> material_of_body;  ///< index of the material of every body of the case
};

/// Defines the value of a field, with one alternative per component type and width in the file: reals are written as
/// float32.
using FieldFunction = std::variant<double (*)(const FieldSource&, std::size_t),           //
                                   Vector3 (*)(const FieldSource&, std::size_t),          //
                                   SymmetricTensor (*)(const FieldSource&, std::size_t),  //
                                   std::uint8_t (*)(const FieldSource&, std::size_t),
                                   std::uint16_t (*)(const FieldSource&, std::size_t),
                                   std::uint64_t (*)(const FieldSource&, std::size_t),
                                   const HistoryField*>;  ///< a field that a material model declares

/// Describes a quantity that snapshots may contain.
struct OutputField {
  std::string_view name;
  std::string_view unit;
  std::string_view meaning;
  bool always = false;  ///< written even if not requested, for the report
  FieldFunction value;
};

/// Returns all quantities: the table of output_fields.cpp, one line each, then the fields that material models declare.
std::span<const OutputField> output_fields();

/// Returns the names in the table, in its order: the accepted words of `output.fields` in a case file.
std::vector<std::string> output_field_names();

/// Returns the fields that are written if the case has no `output.fields`.
std::vector<std::string> default_output_fields();

/// Returns the selected fields plus those always written, each once, in the order of the table.
/// @throws InputError naming an unknown field, with the nearest known name.
std::vector<OutputField> select_output_fields(std::span<const std::string> names);

/// Returns rows "name  unit  meaning" for `whipple describe`.
std::string describe_output_fields();

}  // namespace whipple::io
