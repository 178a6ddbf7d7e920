// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <filesystem>

#include "src/core/base/temporary_folder.hpp"

namespace whipple::md {

/// Makes an empty folder the working directory of the process for the lifetime of the object. LAMMPS and the KIM
/// library search the working directory first for models, scripts and shared objects; a plan from an untrusted
/// source must not cause such files next to it to be executed. Relative paths must be made absolute beforehand.
class EmptyWorkingFolder {
 public:
  EmptyWorkingFolder() : former_(std::filesystem::current_path()) {
    if (const char* potentials = std::getenv("LAMMPS_POTENTIALS");
        potentials != nullptr && *potentials != '\0') {
      setenv("LAMMPS_POTENTIALS", std::filesystem::absolute(potentials).c_str(), 1);
    }
    std::filesystem::current_path(folder_.path());
  }
  EmptyWorkingFolder(const EmptyWorkingFolder&) = delete;
  EmptyWorkingFolder& operator=(const EmptyWorkingFolder&) = delete;
  ~EmptyWorkingFolder() {
    std::error_code fault;  // the former folder may be gone
    std::filesystem::current_path(former_, fault);
    if (fault) std::filesystem::current_path("/", fault);
  }

 private:
  TemporaryFolder folder_;
  std::filesystem::path former_;
};

}  // namespace whipple::md
