// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/lammps/error_guard.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <cstdio>
#include <filesystem>

#include "src/core/base/error.hpp"

namespace {
/// Number of ranks of the instance for which the calling thread works.
thread_local int ranks_of_instance = 1;

[[noreturn]] void throw_error(const std::string& file, int line, const std::string& text) {
  throw whipple::md::LammpsError(
      fmt::format("LAMMPS: {} ({}:{})", text, std::filesystem::path(file).filename().string(), line));
}

[[noreturn]] void throw_or_abort(const std::string& file, int line, const std::string& text) {
  if (ranks_of_instance == 1) throw_error(file, line, text);
  fmt::print(stderr, "LAMMPS: {} ({}:{}), reported by one of {} ranks: aborting\n", text, file, line,
             ranks_of_instance);
  std::fflush(stderr);
  MPI_Abort(MPI_COMM_WORLD, static_cast<int>(whipple::ExitCode::state));
  throw_error(file, line, text);  // not reached; MPI_Abort is not declared noreturn
}
}  // namespace

// The class is declared here with only the members that are replaced: LAMMPS' error.h needs headers that are not
// installed. No member variable is accessed, so that the layout is irrelevant. The dynamic linker prefers these
// definitions, which are in the executable, over those of liblammps (verified by tests/unit/md_lammps_test.cpp).
namespace LAMMPS_NS {

struct Error {
  [[noreturn]] void all(const std::string& file, int line, const std::string& text);
  [[noreturn]] void one(const std::string& file, int line, const std::string& text);
  [[noreturn]] void universe_all(const std::string& file, int line, const std::string& text);
  [[noreturn]] void universe_one(const std::string& file, int line, const std::string& text);
  [[noreturn]] void done(int status);
};

void Error::all(const std::string& file, int line, const std::string& text) { throw_error(file, line, text); }
void Error::one(const std::string& file, int line, const std::string& text) {
  throw_or_abort(file, line, text);
}
void Error::universe_all(const std::string& file, int line, const std::string& text) {
  throw_error(file, line, text);
}
void Error::universe_one(const std::string& file, int line, const std::string& text) {
  throw_or_abort(file, line, text);
}
void Error::done(int status) {
  throw whipple::md::LammpsError(
      fmt::format("LAMMPS: a command asked to end the program with status {}", status));
}

}  // namespace LAMMPS_NS

namespace whipple::md {

ErrorGuard::ErrorGuard(int ranks) : former_(ranks_of_instance) { ranks_of_instance = ranks; }
ErrorGuard::~ErrorGuard() { ranks_of_instance = former_; }

}  // namespace whipple::md
