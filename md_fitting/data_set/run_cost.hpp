// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>

#include "md_fitting/data_set/data_set.hpp"

/// Estimates the cost of the runs of a point before they are made (docs/theory/fit.md, section 8).
namespace whipple::md {

/// Describes the size and number of the runs of a point.
struct RunShape {
  double cells = 0.0;   ///< unit cells along an edge; 0: a static crystal, which costs nothing
  double length = 0.0;  ///< unit cells along the third edge
  double equilibration_steps = 0.0;
  double steps = 0.0;  ///< steps that are averaged
  double replicas = 1.0;
};

/// Reads the shape from the provenance of a point or of a task.
RunShape run_shape(const std::map<std::string, std::string>& provenance);

/// Returns atoms times steps of all runs of a point, including those that prepare it or search for it.
/// @param protocol  of the point; none: a protocol without a search
double atom_steps(std::optional<PointKind> protocol, double atoms_per_cell, const RunShape& shape);

/// Returns unit cells times averaged steps of all runs of a point; the variance is inversely proportional to it.
double sampling(const RunShape& shape);

}  // namespace whipple::md
