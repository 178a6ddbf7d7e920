// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "src/case/artificial_viscosity.hpp"
#include "src/case/body.hpp"
#include "src/case/build/contact_fields.hpp"
#include "src/case/contact.hpp"
#include "src/case/damping.hpp"
#include "src/case/detonation.hpp"
#include "src/case/dissipation.hpp"
#include "src/case/domain.hpp"
#include "src/case/force_gauge.hpp"
#include "src/case/gauges.hpp"
#include "src/case/gravity.hpp"
#include "src/case/heat.hpp"
#include "src/case/load.hpp"
#include "src/case/output_control.hpp"
#include "src/case/quasi_static.hpp"
#include "src/case/splitting.hpp"
#include "src/case/stop.hpp"
#include "src/case/time_control.hpp"
#include "src/case/transfer_control.hpp"
#include "src/grid/geometry.hpp"
#include "src/material/material.hpp"

namespace whipple::cases {

/// Describes one simulation: the contents of a case file in SI units, and the quantities derived from it.
struct Case {
  std::string title;
  Domain domain;
  TimeControl time;
  QuasiStatic quasi_static;
  TransferControl transfer;
  Splitting splitting;
  ArtificialViscosity viscosity;  ///< default for the bodies
  Dissipation dissipation;
  HeatControl heat;
  ContactControl contact;
  Gravity gravity;
  Damping damping;
  BurnControl burn;
  OutputControl output;
  std::vector<Body> bodies;
  std::vector<AppliedLoad> loads;
  std::vector<Detonation> detonations;
  std::vector<Gauge> gauges;
  std::vector<Tracers> tracers;
  std::vector<ForceGauge> force_gauges;
  std::vector<Stop> stops;

  std::filesystem::path file;  ///< the case file; materials are searched for in its folder

  // Set by `complete`, which keeps materials that are already set.
  grid::Geometry geometry;
  std::vector<std::shared_ptr<const Material>> materials;  ///< of each body
  ContactFields contact_fields;

  static ParameterTable<Case> parameters();
  static std::span<const Section<Case>> sections();
  static void add_rest(input::Schema& table);

  [[nodiscard]] const ArtificialViscosity& viscosity_of(std::size_t body) const {
    return bodies[body].viscosity ? *bodies[body].viscosity : viscosity;
  }
  [[nodiscard]] bool has_elements() const;
  [[nodiscard]] bool has_bars() const;
  /// Returns whether any body is a burning explosive.
  [[nodiscard]] bool has_burn() const;
  /// Returns whether a body contains a point; in two dimensions whether its section does, evaluated just above z = 0,
  /// the side that models with a mirror plane there include.
  [[nodiscard]] bool holds(const Body& body, Vector3 point) const;
  /// Returns whether a point within `radius` (m) of this one may be in a body; false only where none is.
  [[nodiscard]] bool may_hold(const Body& body, Vector3 point, double radius) const;
  /// Returns all gauges, with those of the tracers last.
  [[nodiscard]] std::vector<Gauge> all_gauges() const;
};

/// Returns the faults of a case, each with its key; empty if the case can run.
std::vector<InputFault> check(const Case& setup);

/// Completes a case built in code with everything derived from its keys: materials, grid, contact fields, dependent
/// defaults.
/// @throws InputError with all faults that `check` finds
Case complete(Case setup);

/// Reads, checks and completes a case. Throws all errors together as one InputError.
/// @param overrides pairs of key and value as given by --set
Case read_case(const std::filesystem::path& path,
               const std::vector<std::pair<std::string, std::string>>& overrides);
Case read_case_text(const std::string& text, const std::string& name);

/// Reads the keys of a case written by a run (run.toml), without checks and completion, for measures of finished runs.
/// Ignores keys of other versions of the program. @throws InputError if the file is not a case
Case read_written_case(const std::filesystem::path& path);

/// Writes the complete case as TOML, including all defaults, readable by `read_case`.
/// @param material_of_body file names to write instead of those of the case (copies in the run directory)
std::string to_toml(const Case& setup, const std::vector<std::string>& material_of_body);

/// Describes all keys of a case file for `whipple describe case`.
std::string describe_case();

/// Returns the JSON schema of case files, for editors (src/core/input/schema.hpp).
std::string case_schema();

}  // namespace whipple::cases
