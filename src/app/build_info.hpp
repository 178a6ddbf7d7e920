// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace whipple::app {

/// Describes the sources and the compiler of this executable.
struct BuildInfo {
  std::string version;
  std::string revision;  ///< git commit, "+changes" if files differed from it, "unknown" outside git
  std::string source_folder;
  std::string build_type;
  std::string compiler;
  std::string flags;
};

const BuildInfo& build_info();

}  // namespace whipple::app
