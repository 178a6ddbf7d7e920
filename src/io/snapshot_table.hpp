// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

/// Snapshots as tables for other programs: files of VTK (VTU, XML) and CSV (docs/manual/output.md).
namespace whipple::io {

/// A snapshot file as it is: its points, its cells, and their fields.
struct SnapshotTable {
  struct Column {
    std::string name, unit;
    std::size_t components = 1;
    std::variant<std::vector<float>, std::vector<std::uint8_t>, std::vector<std::uint16_t>,
                 std::vector<std::uint64_t>>
        values;
  };
  double time = 0.0;                       ///< s
  std::vector<float> points;               ///< x, y, z of each, m
  std::vector<std::int64_t> connectivity;  ///< points of the cells, one after another
  std::vector<std::int64_t> offsets;       ///< end of each cell in `connectivity`
  std::vector<std::uint8_t> types;         ///< of the cells, numbers of VTK
  std::vector<Column> point_data, cell_data;
};

/// Reads a snapshot of particles or of elements; parts of several ranks become one.
/// @param fields  names of those that are kept; empty: all
/// @throws InputError naming the file if it is none, is damaged, or lacks one of the fields
SnapshotTable read_snapshot_table(const std::filesystem::path& file, double time,
                                  const std::vector<std::string>& fields);

/// Returns the table as a file of VTK: an unstructured grid in XML, arrays appended as they are, little endian. Arrays are
/// called "pressure [Pa]", as the columns of a CSV file are.
std::string vtu_text(const SnapshotTable& table);

/// Returns the table as CSV: a row per particle, or per cell with its centre where there are cells of several points.
std::string csv_text(const SnapshotTable& table);

}  // namespace whipple::io
