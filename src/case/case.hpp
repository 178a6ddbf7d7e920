// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "src/case/body.hpp"
#include "src/case/contact.hpp"
#include "src/case/dissipation.hpp"
#include "src/case/gauges.hpp"
#include "src/core/base/parameter_table.hpp"
#include "src/grid/geometry.hpp"
#include "src/material/material.hpp"

namespace whipple::cases {

struct Domain {
  Vector3 lower = Vector3::Zero();
  Vector3 upper = Vector3::Zero();
  double cell_size = 0.0;
  std::string x_lower = "outflow", x_upper = "outflow";
  std::string y_lower = "outflow", y_upper = "outflow";
  std::string z_lower = "outflow", z_upper = "outflow";
  static ParameterTable<Domain> parameters();
  static ParameterTable<Domain> boundary_parameters();
};

struct TimeControl {
  double end = 0.0;
  double courant = 0.5;
  double first_step = 0.05;
  double maximum_growth = 1.05;
  double acceleration_limit = 0.1;
  double compression_limit = 0.04;
  double element_safety = 0.9;
  std::string scheme = "symplectic";
  std::string stress_rotation = "hughes_winget";
  static ParameterTable<TimeControl> parameters();
};

struct TransferControl {
  std::string shape_function = "quadratic_bspline";
  std::string particle_update = "relaxed_affine";
  double kappa = 0.2;
  std::string affine_field = "deformed";
  double flip_fraction = 0.95;
  std::int64_t fmpm_order = 2;
  bool random_shift = false;
  std::int64_t random_seed = 1;
  bool free_flight = false;
  double rest_tolerance = 1e-12;
  static ParameterTable<TransferControl> parameters();
};

/// Division of stretched particles; no division at length 0.
struct Splitting {
  double length = 0.0;  ///< of a particle along its longest direction, in cells
  std::int64_t maximum_generations = 3;
  static ParameterTable<Splitting> parameters();
};

struct Gravity {
  Vector3 acceleration = Vector3::Zero();
  double rise_time = 0.0;  ///< s
  [[nodiscard]] Vector3 at(double time) const {
    return rise_time > time ? Vector3(time / rise_time * acceleration) : acceleration;
  }
  static ParameterTable<Gravity> parameters();
};

struct OutputControl {
  double snapshot_every = 0.0;
  double checkpoint_every = 600.0;
  std::int64_t history_every = 1;
  std::int64_t gauges_every = 1;
  double maximum_energy_error = 0.01;
  std::vector<std::string> fields = default_fields();
  static std::vector<std::string> default_fields();
  static ParameterTable<OutputControl> parameters();
};

struct HeatControl {
  bool conduction = false;
  static ParameterTable<HeatControl> parameters();
};

/// One simulation: everything that stands in a case file, in SI, with its materials.
struct Case {
  std::string title;
  std::filesystem::path file;
  Domain domain;
  TimeControl time;
  TransferControl transfer;
  Splitting splitting;
  ArtificialViscosity viscosity;  ///< of bodies that bring none of their own
  Dissipation dissipation;
  HeatControl heat;
  ContactControl contact;
  Gravity gravity;
  OutputControl output;
  std::vector<Body> bodies;
  ContactFields contact_fields;
  Gauges gauges;
  std::vector<std::shared_ptr<const Material>> materials;  ///< of each body
  grid::Geometry geometry;

  [[nodiscard]] const ArtificialViscosity& viscosity_of(std::size_t body) const {
    return bodies[body].viscosity ? *bodies[body].viscosity : viscosity;
  }
  [[nodiscard]] bool has_elements() const;
  [[nodiscard]] bool has_bars() const;

  static ParameterTable<Case> parameters();
};

/// Reads and checks a case: all errors at once, as InputError.
/// @param overrides pairs of key and value as of --set
Case read_case(const std::filesystem::path& path,
               const std::vector<std::pair<std::string, std::string>>& overrides);
Case read_case_text(const std::string& text, const std::string& name);

/// The complete case as TOML, with every default, readable by `read_case`.
/// @param material_of_body file names to write instead of those of the case (copies in the run directory)
std::string to_toml(const Case& setup, const std::vector<std::string>& material_of_body);

/// All keys of a case file for `whipple describe case`.
std::string describe_case();

}  // namespace whipple::cases
