// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "eos/table/builder.hpp"

/// Tables of equations of state as files (schema: docs/manual/output.md).
namespace whipple::eos {

struct TableFile {
  TableData data;
  std::map<std::string, TableError> verification;  ///< by phase; may be empty
};

/// Writes NAME.eos.h5; the file appears under its name when it is complete.
/// @throws InputError naming the file
void write_table(const std::filesystem::path& path, const TableFile& file);

/// @throws InputError naming the file and what is wrong: missing, no HDF5, cut short, no table, of another
/// version, damaged (the digest differs)
TableFile read_table(const std::filesystem::path& path);

/// The table of a model from a folder of tables, or built and added to it: found by a digest of the model,
/// its constants and the request. A folder that cannot be written costs a warning.
/// @param name beginning of the file's name, for people
TableData cached_table(const EquationOfState& eos, const TableRequest& request,
                       const std::filesystem::path& folder, const std::string& name, const ForEach& for_each,
                       const Report& report);

/// $XDG_CACHE_HOME/whipple/tables, or ~/.cache/whipple/tables; empty if neither variable is set.
std::filesystem::path table_cache();

}  // namespace whipple::eos
