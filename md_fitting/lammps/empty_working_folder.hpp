// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <filesystem>

#include "src/core/base/temporary_folder.hpp"

namespace whipple::md {

/// Makes an empty folder the working folder of the process as long as it lives. LAMMPS and the KIM library look for models,
/// scripts and shared objects in the working folder first: a plan that lies beside such files, received from somebody
/// else, must not run them. Relative paths are to be made absolute before.
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
