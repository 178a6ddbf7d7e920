// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/version_command.hpp"

#include <H5public.h>
#include <fmt/format.h>
#include <gnu/libc-version.h>
#include <mpi.h>
#include <p4est_base.h>
#include <sc.h>
#include <spdlog/version.h>
#include <zlib.h>

#include <Eigen/Core>
#include <array>
#include <boost/version.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "src/app/build_info.hpp"
#include "src/core/base/json.hpp"
#include "src/core/base/simd.hpp"
#include "src/core/input/library_version.hpp"

namespace whipple::app {
namespace {

std::string mpi_version() {
  // The version of Open MPI, not only that of the MPI standard; callable before MPI_Init.
  std::array<char, MPI_MAX_LIBRARY_VERSION_STRING> text{};
  int length = 0;
  MPI_Get_library_version(text.data(), &length);
  const std::string all(text.data());
  return all.substr(0, all.find_first_of(",\n"));
}

std::string hdf5_version() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return fmt::format("{}.{}.{}", major, minor, release);
}

/// Names one library with its version and its licence (SPDX).
struct Library {
  std::string name;
  std::string version;
  std::string licence;
};

/// Lists the libraries that the executable links or includes, in the order in which they are printed.
std::vector<Library> libraries() {
  return {
      {"Eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION),
       "MPL-2.0"},
      {"HDF5", hdf5_version(), "BSD-3-Clause"},
      {"MPI", mpi_version(), "BSD-3-Clause"},
      {"p4est", P4EST_VERSION, "GPL-2.0-or-later"},
      {"libsc", SC_VERSION, "LGPL-2.1-or-later"},
      {"CLI11", CLI11_VERSION, "BSD-3-Clause"},
      {"fmt", fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100),
       "MIT"},
      {"spdlog", fmt::format("{}.{}.{}", SPDLOG_VER_MAJOR, SPDLOG_VER_MINOR, SPDLOG_VER_PATCH), "MIT"},
      {"json",
       fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
                   NLOHMANN_JSON_VERSION_PATCH),
       "MIT"},
      {"toml++", input::toml_library_version(), "MIT"},
      {"Boost",
       fmt::format("{}.{}.{}", BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100),
       "BSL-1.0"},
      {"UDUNITS", "2", "UCAR"},  // its header tells no more than the name udunits2
      {"zlib", zlibVersion(), "Zlib"},
      {"GCC", __VERSION__, "GPL-3.0-or-later WITH GCC-exception-3.1"},  // libstdc++, libgomp, libgcc
      {"glibc", gnu_get_libc_version(), "LGPL-2.1-or-later"},
  };
}

/// Returns the instructions of the kernels that this processor runs.
std::string_view kernels() {
  switch (kernel_set()) {
    case KernelSet::plain:
      return "scalar";
    case KernelSet::narrow:
      return WHIPPLE_AVX2 ? "AVX2" : "portable";
    case KernelSet::wide:
      break;
  }
  return "AVX-512";
}

void print_version() {
  const BuildInfo& info = build_info();
  fmt::print("whipple {} (revision {})\n", info.version, info.revision);
  fmt::print("build     {}, {}\n", info.build_type, info.compiler);
  fmt::print("flags     {}\n", info.flags);
  fmt::print("kernels   {}\n", kernels());
  for (const Library& library : libraries()) fmt::print("{:<9} {}\n", library.name, library.version);
}

void print_json() {
  const BuildInfo& info = build_info();
  nlohmann::json all = {{"version", info.version},
                        {"revision", info.revision},
                        {"build_type", info.build_type},
                        {"compiler", info.compiler},
                        {"flags", info.flags},
                        {"kernels", kernels()},
                        {"licence_of_sources", "BSD-3-Clause"},
                        {"licence_of_executable", "GPL-2.0-or-later"},  // by p4est
                        {"libraries", nlohmann::json::array()}};
  for (const Library& library : libraries()) {
    all["libraries"].push_back(
        {{"name", library.name}, {"version", library.version}, {"licence", library.licence}});
  }
  fmt::print("{}\n", json_text(all, 1));
}

}  // namespace

void add_version_command(CLI::App& app) {
  auto json = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand("version", "Version, revision, compiler and libraries");
  command->add_flag("--json", *json, "The same for programs, with licences");
  command->footer("Example:\n  whipple version");
  command->callback([json] { *json ? print_json() : print_version(); });
}

}  // namespace whipple::app
