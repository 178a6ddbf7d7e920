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
#include "src/grid/geometry.hpp"
#include "src/particles/particles.hpp"
#include "src/particles/phases.hpp"

namespace whipple::io {

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
  const grid::Geometry* geometry = nullptr;         ///< of the finest cells; null: not known
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
