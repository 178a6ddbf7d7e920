// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "md_fitting/plan/adaptive.hpp"
#include "md_fitting/plan/coexistence.hpp"
#include "md_fitting/plan/cold_curve.hpp"
#include "md_fitting/plan/elastic.hpp"
#include "md_fitting/plan/fluid.hpp"
#include "md_fitting/plan/hugoniostat.hpp"
#include "md_fitting/plan/hugoniot.hpp"
#include "md_fitting/plan/isochore.hpp"
#include "md_fitting/plan/isotherm.hpp"
#include "md_fitting/plan/liquid.hpp"
#include "md_fitting/plan/liquid_vapour.hpp"
#include "md_fitting/plan/piston.hpp"
#include "md_fitting/plan/quantum.hpp"
#include "md_fitting/plan/spall.hpp"
#include "md_fitting/plan/zero_pressure.hpp"
#include "src/core/input/section.hpp"

/// Defines the plan of a campaign of molecular-dynamics points, a TOML file that lists the quantities to compute.
/// This library depends neither on LAMMPS nor on potentials; `whipple describe md` prints its tables. The section
/// of each protocol is defined in a separate file (src/core/input/section.hpp).
namespace whipple::md {

struct Plan {
  std::string title;
  std::string element;
  std::string potential;
  std::string structure = "least_energy";  ///< or "fcc", "bcc"
  std::string pair_style;  ///< LAMMPS pair style with its arguments; empty: `potential` names the potential
  std::vector<std::string> pair_coeff;  ///< its coefficients
  double validity_pressure = 0.0;       ///< Pa; 0: that of the potential
  std::int64_t seed = 1;
  std::int64_t ranks_per_point = 1;
  double processor_time = 0.0;   ///< s, of all ranks together; 0: no limit
  std::filesystem::path folder;  ///< of the plan file, which may contain a potential file

  // One member per section: optional for [section], a vector for [[section]].
  std::optional<ZeroPressurePlan> zero_pressure;
  std::vector<IsothermPlan> isotherms;
  std::vector<IsochorePlan> isochores;
  std::optional<HugoniotPlan> hugoniot;
  std::vector<CoexistencePlan> coexistences;
  std::optional<ColdCurvePlan> cold_curve;
  std::optional<ElasticPlan> elastic;
  std::optional<HugoniostatPlan> hugoniostat;
  std::optional<LiquidPlan> liquid;
  std::vector<FluidPlan> fluids;
  std::optional<PistonPlan> piston;
  std::optional<SpallPlan> spall;
  std::optional<QuantumPlan> quantum;
  std::optional<LiquidVapourPlan> liquid_vapour;
  std::optional<AdaptivePlan> adaptive;  ///< adds no points

  static ParameterTable<Plan> parameters();
  void check(const Plan& plan, const input::Faults& faults) const;
  static std::span<const input::Section<Plan, Plan>> sections();
};

/// Reads a plan. @throws InputError with all errors at once, each with file:line:column.
Plan read_plan(const std::filesystem::path& path);
Plan read_plan(input::Document& document);

/// Writes the points of a plan as a file that reads back to the same numbers, without [adaptive]. A potential file
/// in the folder of the plan is written with its full path.
std::string plan_text(const Plan& plan);

/// Describes the sections of a plan with their keys, for `whipple describe md` and the manual.
std::string describe_plan();

/// Returns the JSON schema of plans, for editors (src/core/input/schema.hpp).
std::string plan_schema();

}  // namespace whipple::md
