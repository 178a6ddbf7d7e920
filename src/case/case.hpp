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
#include "src/case/detonation.hpp"
#include "src/case/dissipation.hpp"
#include "src/case/domain.hpp"
#include "src/case/gauges.hpp"
#include "src/case/gravity.hpp"
#include "src/case/heat.hpp"
#include "src/case/output_control.hpp"
#include "src/case/splitting.hpp"
#include "src/case/time_control.hpp"
#include "src/case/transfer_control.hpp"
#include "src/grid/geometry.hpp"
#include "src/material/material.hpp"

namespace whipple::cases {

/// One simulation: everything that stands in a case file, in SI, and what follows from it.
struct Case {
  std::string title;
  Domain domain;
  TimeControl time;
  TransferControl transfer;
  Splitting splitting;
  ArtificialViscosity viscosity;  ///< of bodies that bring none of their own
  Dissipation dissipation;
  HeatControl heat;
  ContactControl contact;
  Gravity gravity;
  BurnControl burn;
  OutputControl output;
  std::vector<Body> bodies;
  std::vector<Detonation> detonations;
  std::vector<Gauge> gauges;
  std::vector<Tracers> tracers;

  std::filesystem::path file;  ///< that it was read from; materials are looked for beside it

  // Found by `complete`; materials that are there stay.
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
  /// Returns whether a body is an explosive that burns.
  [[nodiscard]] bool has_burn() const;
  /// Returns whether a body holds a point; in two dimensions its section, on the side of z = 0 that models with a mirror
  /// plane there hold.
  [[nodiscard]] bool holds(const Body& body, Vector3 point) const;
  /// Returns all gauges, those of the tracers last.
  [[nodiscard]] std::vector<Gauge> all_gauges() const;
};

/// Returns what is wrong with a case, each fault with the key that it belongs to; nothing if it can run.
std::vector<InputFault> check(const Case& setup);

/// Returns a case built in code with all that follows from its keys: materials, grid, contact fields, values
/// that depend on others.
/// @throws InputError with all that `check` finds
Case complete(Case setup);

/// Reads, checks and completes a case: all errors at once, as InputError.
/// @param overrides pairs of key and value as of --set
Case read_case(const std::filesystem::path& path,
               const std::vector<std::pair<std::string, std::string>>& overrides);
Case read_case_text(const std::string& text, const std::string& name);

/// Reads the keys of a case that a run wrote (run.toml), neither checked nor completed: for measures of finished runs.
/// Keys of other versions of the program are ignored. @throws InputError for a file that is no case
Case read_written_case(const std::filesystem::path& path);

/// The complete case as TOML, with every default, readable by `read_case`.
/// @param material_of_body file names to write instead of those of the case (copies in the run directory)
std::string to_toml(const Case& setup, const std::vector<std::string>& material_of_body);

/// All keys of a case file for `whipple describe case`.
std::string describe_case();

/// Returns the JSON schema of case files, for editors (src/core/input/schema.hpp).
std::string case_schema();

}  // namespace whipple::cases
