// SPDX-License-Identifier: BSD-3-Clause
// Header of NRRD: lines "key: value" up to an empty one (teem.sourceforge.net/nrrd/format.html).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "src/solids/fields.hpp"
#include "src/solids/image.hpp"

namespace whipple::solids {
namespace {

struct TypeName {
  std::string_view name;
  VoxelType type;
};
constexpr std::array<TypeName, 34> type_names = {{
    {"signed char", VoxelType::int8},
    {"int8", VoxelType::int8},
    {"int8_t", VoxelType::int8},
    {"uchar", VoxelType::uint8},
    {"unsigned char", VoxelType::uint8},
    {"uint8", VoxelType::uint8},
    {"uint8_t", VoxelType::uint8},
    {"short", VoxelType::int16},
    {"short int", VoxelType::int16},
    {"signed short", VoxelType::int16},
    {"signed short int", VoxelType::int16},
    {"int16", VoxelType::int16},
    {"int16_t", VoxelType::int16},
    {"ushort", VoxelType::uint16},
    {"unsigned short", VoxelType::uint16},
    {"unsigned short int", VoxelType::uint16},
    {"uint16", VoxelType::uint16},
    {"uint16_t", VoxelType::uint16},
    {"int", VoxelType::int32},
    {"signed int", VoxelType::int32},
    {"int32", VoxelType::int32},
    {"int32_t", VoxelType::int32},
    {"uint", VoxelType::uint32},
    {"unsigned int", VoxelType::uint32},
    {"uint32", VoxelType::uint32},
    {"uint32_t", VoxelType::uint32},
    {"float", VoxelType::float32},
    {"double", VoxelType::float64},
    {"float32", VoxelType::float32},
    {"float64", VoxelType::float64},
    {"char", VoxelType::int8},
    {"single", VoxelType::float32},
    {"signed int8", VoxelType::int8},
    {"unsigned int8", VoxelType::uint8},
}};

struct LengthName {
  std::string_view name;
  double unit;  // m
};
constexpr std::array<LengthName, 13> length_names = {{{"m", 1.0},
                                                      {"meter", 1.0},
                                                      {"cm", 1e-2},
                                                      {"centimeter", 1e-2},
                                                      {"mm", 1e-3},
                                                      {"millimeter", 1e-3},
                                                      {"millimeters", 1e-3},
                                                      {"um", 1e-6},
                                                      {"micron", 1e-6},
                                                      {"microns", 1e-6},
                                                      {"micrometer", 1e-6},
                                                      {"nm", 1e-9},
                                                      {"nanometer", 1e-9}}};

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  return text.substr(0, text.find_last_not_of(blanks) + 1);
}

/// Reads "(x,y,z)"; nothing for "none".
std::optional<Vector3> vector_of(std::string_view text) {
  if (text.size() < 2 || text.front() != '(' || text.back() != ')') return std::nullopt;
  std::string spaced(text.substr(1, text.size() - 2));
  std::ranges::replace(spaced, ',', ' ');
  Fields fields(spaced, "");
  Vector3 result;
  fields.next_line();
  for (double& x : result) {
    const auto value = Fields::parsed<double>(fields.word());
    if (!value) return std::nullopt;
    x = *value;
  }
  return result;
}

/// Reads the unit of the three axes: "mm" "mm" "mm"; empty texts state none.
void take_units(ImageHeader& header, std::string_view value, const Fields& lines) {
  std::string words(value);
  std::ranges::replace(words, '"', ' ');
  Fields fields(words, "");
  fields.next_line();
  for (std::string_view word = fields.word(); !word.empty(); word = fields.word()) {
    const auto* found = std::ranges::find(length_names, lower_case(word), &LengthName::name);
    if (found == length_names.end())
      lines.fail(fmt::format("unit \"{}\" is not known; known: m, cm, mm, um, nm", shown(word)));
    if (header.unit && *header.unit != found->unit) lines.fail("the axes have different units");
    header.unit = found->unit;
  }
}

}  // namespace

ImageHeader read_nrrd_header(std::string_view bytes, const std::string& file) {
  Fields lines(bytes, file);
  ImageHeader header;
  bool has_type = false, has_size = false, has_dimension = false, is_stated = false;
  lines.next_line();  // NRRD000N
  while (lines.next_line()) {
    const std::string_view line = trimmed(lines.rest());
    if (line.empty()) break;
    if (line.starts_with('#') || line.find(":=") != std::string_view::npos) continue;
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos) lines.fail(fmt::format("\"{}\" is no \"key: value\"", shown(line)));
    // Identifiers and names of values are known in either case.
    const std::string key = lower_case(trimmed(line.substr(0, colon)));
    const std::string_view value = trimmed(line.substr(colon + 1));
    const std::string name = lower_case(value);
    Fields fields(value, file);
    fields.next_line();
    const auto number = [&](auto kind) {
      const auto read = Fields::parsed<decltype(kind)>(fields.word());
      if (!read) lines.fail(fmt::format("'{}' is \"{}\": expected numbers", key, shown(value)));
      return *read;
    };
    const auto finish = [&] {
      if (!fields.is_blank()) lines.fail(fmt::format("'{}' has more than three values", key));
    };
    if (key == "dimension") {
      if (number(0) != 3 || !fields.is_blank())
        lines.fail(fmt::format("dimension {}, expected 3", shown(value)));
      has_dimension = true;
    } else if (key == "sizes") {
      for (auto& n : header.size) n = number(std::uint64_t{});
      finish();
      has_size = true;
    } else if (key == "type") {
      const auto* found = std::ranges::find(type_names, name, &TypeName::name);
      if (found == type_names.end()) lines.fail(fmt::format("type \"{}\" is not known", shown(value)));
      header.type = found->type;
      has_type = true;
    } else if (key == "endian") {
      if (name != "big" && name != "little")
        lines.fail(fmt::format("endian \"{}\", expected big or little", shown(value)));
      header.order = name == "big" ? std::endian::big : std::endian::little;
      is_stated = true;
    } else if (key == "encoding") {
      if (name == "raw") {
        header.packing = Packing::raw;
      } else if (name == "gzip" || name == "gz") {
        header.packing = Packing::gzip;
      } else if (name == "ascii" || name == "text" || name == "txt") {
        header.packing = Packing::text;
      } else {
        lines.fail(fmt::format("encoding \"{}\"; known: raw, gzip, ascii", shown(value)));
      }
    } else if (key == "spacings") {
      for (Eigen::Index a = 0; a < 3; ++a) header.steps(a, a) = number(double{});
      finish();
    } else if (key == "space directions") {
      for (Eigen::Index a = 0; a < 3; ++a) {
        const auto step = vector_of(fields.word());
        if (!step) lines.fail("'space directions' are not three vectors (x,y,z)");
        header.steps.col(a) = *step;
      }
      finish();
    } else if (key == "axis mins" || key == "axismins" || key == "axis maxs" || key == "axismaxs") {
      for (std::string_view word = fields.word(); !word.empty(); word = fields.word()) {
        if (lower_case(word) != "nan") {
          lines.fail(fmt::format("'{}' is not read: state 'space directions' and 'space origin'", key));
        }
      }
    } else if (key == "space units" || key == "units") {
      take_units(header, value, lines);
    } else if (key == "space origin") {
      const auto origin = vector_of(value);
      if (!origin) lines.fail("'space origin' is no vector (x,y,z)");
      header.origin = *origin;
    } else if (key == "data file" || key == "datafile") {
      header.data = beside(value, file);
    } else if (key == "byte skip" || key == "line skip" || key == "byteskip" || key == "lineskip") {
      if (number(0) != 0) lines.fail(fmt::format("'{}' is not known", key));
    }
  }
  if (!has_dimension || !has_type || !has_size)
    lines.fail("the header states no dimension, no type or no sizes");
  if (!is_stated && bytes_of(header.type) > 1 && header.packing != Packing::text)
    lines.fail("the header states no endian");
  if (header.data.empty()) header.begin = lines.bytes_read();
  return header;
}

}  // namespace whipple::solids
