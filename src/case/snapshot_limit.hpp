// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <string>

namespace whipple::cases {

/// Says that snapshots are too many for files of six digits; empty if they are not. A step ends at each of them, so that
/// an interval in a wrong unit fills the disk and never comes to an end.
/// @param every  interval, s; 0: none
/// @param until  how long the run goes on, s
inline std::string too_many_snapshots(double every, double until) {
  constexpr double most = 1e6;
  if (!(every > 0.0) || !(until > most * every)) return "";
  return fmt::format(
      "'snapshot_every' makes {:.2g} snapshots, but a run has at most {:.0e}: is its unit right?",
      until / every, most);
}

}  // namespace whipple::cases
