// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/step_mesher.hpp"

#include <fmt/format.h>

#include <string>
#include <system_error>

#include "src/core/base/error.hpp"
#include "src/core/base/temporary_folder.hpp"
#include "src/core/base/text.hpp"
#include "src/core/process/process.hpp"

namespace whipple::app {

namespace fs = std::filesystem;

void triangulate_by_gmsh(const fs::path& step, double edge, const fs::path& stl) {
  const std::string file = utf8(step.string());
  const TemporaryFolder folder;
  const fs::path part = folder.path() / "part.step";  // gmsh decides by the ending of the name
  std::error_code fault;
  fs::create_symlink(fs::absolute(step), part, fault);
  if (fault) throw InputError(fmt::format("{}: {}", part.string(), fault.message()));
  const std::string longest = fmt::format("{}", edge), shortest = fmt::format("{}", edge / 8.0);
  int code = 0;
  try {
    code = process::run_process({"gmsh",   part.string(), "-2",
                                 "-v",     "1",           "-nt",
                                 "1",      "-setstring",  "Geometry.OCCTargetUnit",
                                 "M",      "-clmax",      longest,
                                 "-clmin", shortest,      "-clcurv",
                                 "36",     "-format",     "stl",
                                 "-o",     stl.string()},
                                {{"GMSH_HOME", folder.path().string()}});  // not the settings of the user
  } catch (const InputError&) {
    throw InputError(
        fmt::format("{}: a STEP file is triangulated by the program gmsh, which cannot be started: "
                    "'scripts/install_deps.sh "
                    "--step' installs it; or save the part as STL",
                    file));
  }
  if (code != 0 || !fs::is_regular_file(stl, fault) || fs::file_size(stl, fault) == 0) {
    throw InputError(fmt::format("{}: gmsh does not triangulate it (exit code {})", file, code));
  }
}

}  // namespace whipple::app
