// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>
#include <mpi.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "md_fitting/lammps/error_guard.hpp"

namespace whipple::md {

/// One LAMMPS instance through the C library interface; quiet, without files of its own. Every error arrives
/// as LammpsError with the command that caused it; after an error inside a run the instance can only be
/// destroyed. Numbers are in LAMMPS' units (here always "metal": A, ps, eV, bar, g/mol).
class Lammps {
 public:
  /// Opens an instance on the ranks of a communicator. Collective over it.
  explicit Lammps(MPI_Comm communicator = MPI_COMM_SELF);
  Lammps(Lammps&& other) noexcept;
  Lammps& operator=(Lammps&&) = delete;
  ~Lammps();

  /// Runs one input line. Collective.
  void command(const std::string& line) { command_shown_as(line, line); }
  /// Runs a command, and records another text in the transcript, which must not show a path that lives as
  /// long as this process only. Collective.
  void command_shown_as(const std::string& line, const std::string& shown);
  template <class... Args>
  void command(fmt::format_string<Args...> format, Args&&... args) {
    command(std::string(fmt::format(format, std::forward<Args>(args)...)));
  }

  /// The present value of an equal-style variable. Collective.
  double variable(const std::string& name);
  /// The columns collected by a `fix vector`, column by column.
  /// @throws LammpsError if there is no such fix.
  std::vector<std::vector<double>> series(const std::string& fix, int columns);

  /// A per-atom array of three components ("x", "v", "f"), atom by atom in the order of their numbers:
  /// x1 y1 z1 x2 ... Collective.
  std::vector<double> gather(const std::string& name);

  /// Returns whether LAMMPS was built with a style, e.g. has_style("pair", "eam/alloy").
  [[nodiscard]] bool has_style(const std::string& category, const std::string& name) const;
  /// Names of all styles of a category, sorted.
  [[nodiscard]] std::vector<std::string> styles(const std::string& category) const;
  [[nodiscard]] double atoms() const;
  /// Release as a date, e.g. 20210929.
  [[nodiscard]] int version() const;
  /// Every command so far, one per line: an input file for LAMMPS itself that repeats the work.
  [[nodiscard]] const std::string& transcript() const { return transcript_; }

 private:
  void* handle_ = nullptr;
  int ranks_ = 1;
  bool sound_ = true;  // no error so far
  std::string transcript_;

  /// Runs a call for this instance; an error marks the instance.
  template <class Call>
  auto guarded(const Call& call) -> decltype(call());
};

/// LAMMPS' release as a date, without an instance at hand.
int lammps_release();

}  // namespace whipple::md
