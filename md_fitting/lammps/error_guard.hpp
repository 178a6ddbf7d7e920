// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

namespace whipple::md {

/// Reports an error raised by LAMMPS, with LAMMPS' text, source file and line.
class LammpsError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Converts LAMMPS errors to exceptions. LAMMPS is usually built without exceptions, so that an error terminates
/// the host process. Linking this file replaces the five members of LAMMPS' class Error through which every error
/// passes by members that throw LammpsError. Errors reported by all ranks of an instance throw on all of them; an
/// error reported by one rank only throws if the instance has one rank, and otherwise aborts the job with its
/// message, because the other ranks would wait for it indefinitely.
///
/// While an object of this class exists, the calling thread works for an instance on `ranks` ranks.
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
