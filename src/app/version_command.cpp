// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/version_command.hpp"

#include <H5public.h>
#include <fmt/format.h>
#include <mpi.h>
#include <p4est_base.h>
#include <spdlog/version.h>

#include <Eigen/Core>
#include <array>
#include <nlohmann/json.hpp>

#include "src/app/build_info.hpp"

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

void print_version() {
  const BuildInfo& info = build_info();
  fmt::print("whipple {} (revision {})\n", info.version, info.revision);
  fmt::print("build     {}, {}\n", info.build_type, info.compiler);
  fmt::print("flags     {}\n", info.flags);
  fmt::print("Eigen     {}.{}.{}\n", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION);
  fmt::print("HDF5      {}\n", hdf5_version());
  fmt::print("MPI       {}\n", mpi_version());
  fmt::print("p4est     {}\n", P4EST_VERSION);
  fmt::print("CLI11     {}\n", CLI11_VERSION);
  fmt::print("fmt       {}.{}.{}\n", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100);
  fmt::print("spdlog    {}.{}.{}\n", SPDLOG_VER_MAJOR, SPDLOG_VER_MINOR, SPDLOG_VER_PATCH);
  fmt::print("json      {}.{}.{}\n", NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
             NLOHMANN_JSON_VERSION_PATCH);
}

}  // namespace

void add_version_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("version", "Version, revision, compiler and libraries");
  command->footer("Example:\n  whipple version");
  command->callback(print_version);
}

}  // namespace whipple::app
