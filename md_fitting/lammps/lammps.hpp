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

/// Wraps one LAMMPS instance through the C library interface, without screen output or log files. Every error is
/// thrown as LammpsError with the command that caused it; after an error inside a run the instance can only be
/// destroyed. Numbers are in LAMMPS units (here always "metal": A, ps, eV, bar, g/mol).
class Lammps {
 public:
  /// Opens an instance on the ranks of a communicator. Collective over it.
  explicit Lammps(MPI_Comm communicator = MPI_COMM_SELF);
  Lammps(Lammps&& other) noexcept;
  Lammps& operator=(Lammps&&) = delete;
  ~Lammps();

  /// Runs one input line. Collective.
  void command(const std::string& line) { command_shown_as(line, line); }
  /// Runs a command and records different text in the transcript, which must not contain paths that exist only
  /// during this process. Collective.
  void command_shown_as(const std::string& line, const std::string& shown);
  template <class... Args>
  void command(fmt::format_string<Args...> format, Args&&... args) {
    command(std::string(fmt::format(format, std::forward<Args>(args)...)));
  }

  /// Returns the current value of an equal-style variable. Collective.
  double variable(const std::string& name);
  /// Returns the data collected by a `fix vector`, column by column.
  /// @throws LammpsError if there is no such fix.
  std::vector<std::vector<double>> series(const std::string& fix, int columns);

  /// Returns a per-atom array of three components ("x", "v", "f"), ordered by atom number: x1 y1 z1 x2 ... Collective.
  std::vector<double> gather(const std::string& name);

  /// Returns whether LAMMPS was built with a style, e.g. has_style("pair", "eam/alloy").
  [[nodiscard]] bool has_style(const std::string& category, const std::string& name) const;
  /// Returns the names of all styles of a category, sorted.
  [[nodiscard]] std::vector<std::string> styles(const std::string& category) const;
  [[nodiscard]] double atoms() const;
  /// Returns the release as a date, e.g. 20210929.
  [[nodiscard]] int version() const;
  /// Returns every command so far, one per line: a LAMMPS input file that reproduces the calculation.
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

/// Returns the LAMMPS release as a date, without requiring an instance.
int lammps_release();

}  // namespace whipple::md
