// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "eos/table/builder.hpp"

/// Reads and writes tables of equations of state (schema: docs/manual/output.md).
namespace whipple::eos {

struct TableFile {
  TableData data;
  std::map<std::string, TableError> verification;  ///< by phase; may be empty
};

/// Writes NAME.eos.h5; the file gets its final name when it is complete.
/// @throws InputError naming the file
void write_table(const std::filesystem::path& path, const TableFile& file);

/// Reads a table. @throws InputError naming the file and the fault: missing, not HDF5, truncated, no table, a
/// different version, damaged (the digest differs)
TableFile read_table(const std::filesystem::path& path);

/// Returns the table of a model from a folder of tables, or builds and adds it; found by a digest of the model, its
/// constants and the request. A folder that cannot be written causes a warning.
/// @param name beginning of the file name, for readability
TableData cached_table(const EquationOfState& eos, const TableRequest& request,
                       const std::filesystem::path& folder, const std::string& name, const ForEach& for_each,
                       const Report& report);

/// Returns $XDG_CACHE_HOME/whipple/tables, or ~/.cache/whipple/tables; empty if neither variable is set.
std::filesystem::path table_cache();

}  // namespace whipple::eos
