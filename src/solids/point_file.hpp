// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "src/core/base/tensor.hpp"
#include "src/core/base/words.hpp"

namespace whipple::solids {

/// Holds columns of numbers of a file: positions and sizes of particles.
struct PointTable {
  struct Column {
    std::string heading;  ///< "x [mm]", "x_mm", or "x"
    std::vector<double> values;
  };
  std::string file;  ///< for messages
  std::vector<Column> columns;
  std::vector<std::string> unread;  ///< headings of the other columns of a CSV file
  std::vector<std::size_t> lines;   ///< of the file, of each row; empty: rows are numbered from 0, as in VTK
};

/// Holds the particles of a body.
struct PointList {
  std::vector<Vector3> places;  ///< m
  std::vector<double> amounts;  ///< kg, or m^3
  bool are_masses = true;
  std::string file;
  std::vector<std::size_t> lines;

  /// Returns where the file has a particle: "points.csv:7", or "points.vtu: point 5".
  [[nodiscard]] std::string where(std::size_t i) const;
};

/// Holds the units of columns without one in their heading; infinite: not given.
struct PointUnits {
  double length = std::numeric_limits<double>::infinity();  ///< m
  double mass = std::numeric_limits<double>::infinity();    ///< kg
};

/// Selects the column that gives the size of the particles.
enum class SizeColumn : std::uint8_t { whichever, mass, volume };
constexpr std::array<Word<SizeColumn>, 2> words(SizeColumn) {
  return {{{SizeColumn::mass, "mass"}, {SizeColumn::volume, "volume"}}};
}

/// Returns whether a heading names the size of particles: "mass [g]", "volume".
bool is_size_column(std::string_view heading);

/// Reads a CSV file: lines that begin with # are remarks, the first other line is the heading, `x [mm],y [mm],z [mm],
/// mass [g]` in any order, also `x_mm`. Other columns are not read.
/// @throws InputError naming file and line: no heading, no rows, another number of cells, a cell that is no finite
/// number
PointTable read_point_csv(std::string_view bytes, const std::string& file);

/// Returns the particles of a table. A volume without unit is in cubes of the unit of length; without a column z, all
/// are at z = 0.
/// @throws InputError naming file and line: a column that is missing or there twice, a unit that is missing, of another
/// kind, or not the one given; a size that is not above 0; a number that is not finite; two particles at one place
PointList points_of(const PointTable& table, const PointUnits& units, SizeColumn size);

}  // namespace whipple::solids
