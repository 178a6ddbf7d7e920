// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

/// Converts snapshots to tables for other programs: VTK files (VTU, XML) and CSV (docs/manual/output.md).
namespace whipple::io {

/// Holds the contents of a snapshot file: its points, its cells, and their fields.
struct SnapshotTable {
  struct Column {
    std::string name, unit;
    std::size_t components = 1;
    std::variant<std::vector<float>, std::vector<std::uint8_t>, std::vector<std::uint16_t>,
                 std::vector<std::uint64_t>>
        values;
  };
  double time = 0.0;                       ///< s
  std::vector<float> points;               ///< x, y, z of each point, m
  std::vector<std::int64_t> connectivity;  ///< points of the cells, one after another
  std::vector<std::int64_t> offsets;       ///< end of each cell in `connectivity`
  std::vector<std::uint8_t> types;         ///< cell types, numbers of VTK
  std::vector<Column> point_data, cell_data;
};

/// Reads a snapshot of particles or of elements; the parts of several ranks are merged.
/// @param fields  names of the fields to keep; empty: all
/// @throws InputError naming the file if it is not a snapshot, is damaged, or lacks one of the fields
SnapshotTable read_snapshot_table(const std::filesystem::path& file, double time,
                                  const std::vector<std::string>& fields);

/// Returns the table as a VTK file: an unstructured grid in XML with appended raw arrays, little endian. Arrays are
/// named "pressure [Pa]", like the columns of a CSV file.
std::string vtu_text(const SnapshotTable& table);

/// Returns the table as CSV: one row per particle, or per cell with its centre if there are cells of several points.
std::string csv_text(const SnapshotTable& table);

}  // namespace whipple::io
