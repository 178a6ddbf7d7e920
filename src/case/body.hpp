// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "src/case/artificial_viscosity.hpp"
#include "src/case/body_state.hpp"
#include "src/case/discretization.hpp"
#include "src/case/shapes/shape.hpp"
#include "src/core/base/parameter_table.hpp"
#include "src/core/base/tensor.hpp"
#include "src/core/input/document.hpp"

namespace whipple::cases {

struct Case;

struct Body {
  std::string name;
  std::string material;  ///< file as written in the case
  std::string equation_of_state = "model";
  double table_error = 1e-4;
  Vector3 velocity = Vector3::Zero();
  Vector3 angular_velocity = Vector3::Zero();
  std::string contact_group;
  Discretization discretization;
  Conversion conversion;
  std::vector<NodeCondition> node_conditions;
  std::vector<BarRow> bars;
  InitialState initial;
  FailureScatter failure_scatter;
  std::optional<ArtificialViscosity> viscosity;  ///< instead of that of the case
  std::shared_ptr<const Shape> shape;
  static ParameterTable<Body> parameters();
};

/// Reads the tables [[body]] and their materials into the case; faults are reported at the tables.
void read_bodies(Case& setup, const std::vector<input::Table>& tables);

/// The body as a table [[body]] with every default.
/// @param material file name to write instead of that of the case
std::string body_to_toml(Body body, const std::string& material);

/// All keys of [[body]] for `whipple describe case`.
std::string describe_body();

}  // namespace whipple::cases
