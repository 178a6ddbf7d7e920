// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "src/analysis/run.hpp"

namespace whipple::view {

struct PageOptions {
  std::size_t times = 12;           ///< snapshots in the page, evenly spaced, first and last included
  std::vector<std::string> fields;  ///< names from `cloud_fields`; empty: all
  int bits = 16;                    ///< as in `CloudOptions`
  double most_bytes = 20e6;         ///< of the page; particles are omitted to meet this limit
};

struct Page {
  std::string html;
  std::size_t times = 0;
  std::uint64_t one_of = 1;  ///< level of detail
};

/// Makes one self-contained page that shows a run in three dimensions, without other files and without a network.
/// @param viewer  the folder of the viewer's modules, with page.html, style.css and main.js
/// @throws InputError if the run has no snapshots, a field is unknown, or not even one of 4096 particles fits
Page make_page(const analysis::Run& run, const PageOptions& options, const std::filesystem::path& viewer);

/// Writes every snapshot in full detail as NAME.wpv.gz into a folder, which is created. Returns their number.
/// @throws InputError as `pack_cloud`, or if a file cannot be written
std::size_t write_clouds(const analysis::Run& run, const std::vector<std::string>& fields,
                         const std::filesystem::path& folder);

/// Returns the bytes as a gzip file without name and time: equal bytes give equal files.
std::string gzipped(std::string_view bytes);

/// Returns the bytes as text in base 64 (RFC 4648).
std::string base64(std::string_view bytes);

/// Joins a JavaScript module and the modules that it imports into one script, each once and after its dependencies. An
/// import is one line, `import { names } from './file.js';`, and names are unique among all modules.
/// @throws InputError if a file is missing or an import has another form
std::string joined_modules(const std::filesystem::path& main);

}  // namespace whipple::view
