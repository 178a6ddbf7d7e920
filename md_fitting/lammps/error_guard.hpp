// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

namespace whipple::md {

/// LAMMPS reported an error. The text is LAMMPS' own, with its source file and line.
class LammpsError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// LAMMPS is usually built without exceptions: an error then ends the process that hosts it. Linking this
/// file replaces the five members of LAMMPS' class Error through which every error passes by members that
/// throw LammpsError. Errors reported by all ranks of an instance throw on all; an error that one rank alone
/// reports throws if the instance has one rank, and aborts the job with its message otherwise, because the
/// other ranks would wait for the throwing one for ever.
///
/// While an object of this class lives, the calling thread works for an instance on `ranks` ranks.
class ErrorGuard {
 public:
  explicit ErrorGuard(int ranks);
  ErrorGuard(const ErrorGuard&) = delete;
  ErrorGuard& operator=(const ErrorGuard&) = delete;
  ~ErrorGuard();

 private:
  int former_;
};

}  // namespace whipple::md
