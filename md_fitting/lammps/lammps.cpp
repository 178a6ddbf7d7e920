// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/lammps/lammps.hpp"

#define LAMMPS_LIB_MPI  // declares lammps_open with a communicator
#include <lammps/library.h>

#include <array>
#include <cstdlib>

#include "src/core/base/error.hpp"

namespace whipple::md {
namespace {

/// Returns the instances abandoned after an error, kept reachable so that leak checkers do not report them.
std::vector<void*>& abandoned_instances() {
  static std::vector<void*> instances;
  return instances;
}

}  // namespace

template <class Call>
auto Lammps::guarded(const Call& call) -> decltype(call()) {
  if (!sound_) throw InternalError("a LAMMPS instance was used again after an error");
  const ErrorGuard guard(ranks_);
  try {
    return call();
  } catch (const LammpsError&) {
    sound_ = false;
    throw;
  }
}

Lammps::Lammps(MPI_Comm communicator) {
  // One thread per rank: LAMMPS links OpenMP, and idle threads of several ranks would compete for the cores.
  setenv("OMP_NUM_THREADS", "1", 1);
  int initialized = 0;
  MPI_Initialized(&initialized);
  if (initialized == 0) throw InternalError("a LAMMPS instance needs MPI to be initialised");
  MPI_Comm_size(communicator, &ranks_);
  std::array<std::string, 7> words = {"lammps", "-log", "none", "-screen", "none", "-nocite", ""};
  std::array<char*, 6> arguments{};
  for (std::size_t i = 0; i < arguments.size(); ++i) arguments[i] = words[i].data();
  const ErrorGuard guard(ranks_);
  handle_ = lammps_open(static_cast<int>(arguments.size()), arguments.data(), communicator, nullptr);
  if (handle_ == nullptr) throw LammpsError("LAMMPS could not be started");
}

Lammps::Lammps(Lammps&& other) noexcept
    : handle_(std::exchange(other.handle_, nullptr)),
      ranks_(other.ranks_),
      sound_(other.sound_),
      transcript_(std::move(other.transcript_)) {}

Lammps::~Lammps() {
  if (handle_ == nullptr) return;
  if (!sound_) {
    abandoned_instances().push_back(handle_);
    return;
  }
  const ErrorGuard guard(ranks_);
  try {
    lammps_close(handle_);
  } catch (const LammpsError&) {
    // The instance is being discarded; errors during its destruction affect no result.
  }
}

void Lammps::command_shown_as(const std::string& line, const std::string& shown) {
  transcript_ += shown + '\n';
  try {
    guarded([&] { lammps_command(handle_, line.c_str()); });
  } catch (const LammpsError& error) {
    throw LammpsError(fmt::format("{}; command: {}", error.what(), shown));
  }
}

double Lammps::variable(const std::string& name) {
  void* const value = guarded([&] { return lammps_extract_variable(handle_, name.c_str(), nullptr); });
  if (value == nullptr) throw LammpsError(fmt::format("LAMMPS has no variable '{}'", name));
  const double number = *static_cast<double*>(value);
  lammps_free(value);  // LAMMPS allocates every number returned through a pointer
  return number;
}

std::vector<std::vector<double>> Lammps::series(const std::string& fix, int columns) {
  return guarded([&] {
    const auto entry = [&](int type, int row, int column) {
      void* const value = lammps_extract_fix(handle_, fix.c_str(), LMP_STYLE_GLOBAL, type, row, column);
      if (value == nullptr) throw LammpsError(fmt::format("LAMMPS has no data of a fix '{}'", fix));
      return value;
    };
    // The size is a pointer into the fix; the entries are allocated one by one and must be freed by the caller.
    const int count = *static_cast<const int*>(entry(columns == 1 ? LMP_SIZE_VECTOR : LMP_SIZE_ROWS, 0, 0));
    std::vector<std::vector<double>> table(static_cast<std::size_t>(columns));
    for (int column = 0; column < columns; ++column) {
      for (int row = 0; row < count; ++row) {
        double* const value =
            static_cast<double*>(entry(columns == 1 ? LMP_TYPE_VECTOR : LMP_TYPE_ARRAY, row, column));
        table[static_cast<std::size_t>(column)].push_back(*value);
        lammps_free(value);
      }
    }
    return table;
  });
}

std::vector<double> Lammps::gather(const std::string& name) {
  return guarded([&] {
    std::vector<double> values(3 * static_cast<std::size_t>(lammps_get_natoms(handle_)));
    std::string copy = name;  // the interface does not accept constant text
    constexpr int floating_point = 1;
    constexpr int components = 3;
    lammps_gather_atoms(handle_, copy.data(), floating_point, components, values.data());
    return values;
  });
}

bool Lammps::has_style(const std::string& category, const std::string& name) const {
  return lammps_has_style(handle_, category.c_str(), name.c_str()) == 1;
}

std::vector<std::string> Lammps::styles(const std::string& category) const {
  constexpr int longest = 128;
  std::vector<std::string> names;
  for (int i = 0; i < lammps_style_count(handle_, category.c_str()); ++i) {
    std::array<char, longest> name{};
    if (lammps_style_name(handle_, category.c_str(), i, name.data(), longest) == 1)
      names.emplace_back(name.data());
  }
  std::ranges::sort(names);
  return names;
}

double Lammps::atoms() const { return lammps_get_natoms(handle_); }

int Lammps::version() const { return lammps_version(handle_); }

int lammps_release() {
  static const int release = Lammps(MPI_COMM_SELF).version();
  return release;
}

}  // namespace whipple::md
