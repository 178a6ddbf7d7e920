// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/plan/plan.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "src/base/error.hpp"

namespace whipple::md {
namespace {

using Bound = std::vector<BoundParameter>;

void append(Bound& all, const Bound& more) { all.insert(all.end(), more.begin(), more.end()); }

Bound size_keys(RunSize& size) {
  static const ParameterTable<RunSize> table = {
      integer("cells", &RunSize::cells, {.lower = 2, .upper = 100}, "unit cells along each edge of the cube")
          .optional(),
      integer("equilibration_steps", &RunSize::equilibration_steps, {.lower = 100, .upper = 1e9},
              "time steps before averaging")
          .optional(),
      integer("steps", &RunSize::steps, {.lower = 200, .upper = 1e9}, "time steps that are averaged")
          .optional(),
      real("time_step", &RunSize::time_step, "s", range::between(0.0, 1e-13),
           "0: 2 fs for the mass of copper, less when hot or compressed")
          .optional()};
  return bind(table, size);
}

Bound head_keys(Plan& plan) {
  static const ParameterTable<Plan> table = {
      text("title", &Plan::title, "shown in messages").optional(),
      text("element", &Plan::element, "chemical symbol, e.g. \"Cu\""),
      text("potential", &Plan::potential,
           "name of a known potential, or a potential file beside the plan or in the folder of LAMMPS"),
      integer("seed", &Plan::seed, {.lower = 0}, "changes all initial velocities").optional()};
  return bind(table, plan);
}

Bound keys(ZeroPressurePlan& plan) {
  static const ParameterTable<ZeroPressurePlan> table = {
      real_list("temperature", &ZeroPressurePlan::temperature, "K", range::positive(),
                "temperatures at zero pressure; the first is the state before the shock")
          .optional()};
  Bound all = bind(table, plan);
  append(all, size_keys(plan.size));
  return all;
}

Bound keys(IsothermPlan& plan) {
  static const ParameterTable<IsothermPlan> table = {
      real("temperature", &IsothermPlan::temperature, "K", range::positive(), "temperature of the isotherm")
          .optional(),
      real_list("volume_ratio", &IsothermPlan::volume_ratio, "", range::open_between(0.1, 3.0),
                "V over the volume of the static crystal at zero pressure")};
  Bound all = bind(table, plan);
  append(all, size_keys(plan.size));
  return all;
}

Bound keys(IsochorePlan& plan) {
  static const ParameterTable<IsochorePlan> table = {
      real("volume_ratio", &IsochorePlan::volume_ratio, "", range::open_between(0.1, 3.0),
           "V over the volume of the static crystal at zero pressure"),
      real_list("temperature", &IsochorePlan::temperature, "K", range::positive(),
                "temperatures along the isochore")};
  Bound all = bind(table, plan);
  append(all, size_keys(plan.size));
  return all;
}

Bound keys(HugoniotPlan& plan) {
  static const ParameterTable<HugoniotPlan> table = {
      real_list("volume_ratio", &HugoniotPlan::volume_ratio, "", range::open_between(0.1, 1.0),
                "V behind the shock over the volume of the static crystal at zero pressure")};
  Bound all = bind(table, plan);
  append(all, size_keys(plan.size));
  return all;
}

Bound keys(CoexistencePlan& plan) {
  static const ParameterTable<CoexistencePlan> table = {
      real_list("pressure", &CoexistencePlan::pressure, "Pa", range::non_negative(),
                "pressures of melting points"),
      real_list("first_guess", &CoexistencePlan::first_guess, "K", range::positive(),
                "where the search begins, one per pressure"),
      integer("attempts", &CoexistencePlan::attempts, {.lower = 1, .upper = 20},
              "restarts from the last temperature when crystal or melt has vanished")
          .optional()};
  Bound all = bind(table, plan);
  append(all, size_keys(plan.size));
  return all;
}

}  // namespace

Plan read_plan(input::Document& document) {
  Plan plan;
  input::Table root = document.root();
  plan.folder = root.folder();
  root.read(head_keys(plan));
  if (auto table = root.optional_table("zero_pressure_volume")) {
    plan.zero_pressure.emplace();
    table->read(keys(*plan.zero_pressure));
    if (plan.zero_pressure->temperature.empty())
      table->error_at("temperature", "needs at least one temperature");
  }
  for (input::Table& table : root.list("isotherm")) table.read(keys(plan.isotherms.emplace_back()));
  for (input::Table& table : root.list("isochore")) table.read(keys(plan.isochores.emplace_back()));
  if (auto table = root.optional_table("hugoniot")) {
    plan.hugoniot.emplace();
    table->read(keys(*plan.hugoniot));
    if (!plan.zero_pressure) {
      table->error("[hugoniot] needs the section [zero_pressure_volume]: it is the state before the shock");
    }
  }
  if (auto table = root.optional_table("coexistence")) {
    CoexistencePlan& melting = plan.coexistence.emplace();
    table->read(keys(melting));
    if (melting.pressure.size() != melting.first_guess.size()) {
      table->error_at("first_guess", fmt::format("has {} temperatures for {} pressures",
                                                 melting.first_guess.size(), melting.pressure.size()));
    }
  }
  document.finish();
  return plan;
}

Plan read_plan(const std::filesystem::path& path) {
  input::Document document = input::Document::from_file(path);
  return read_plan(document);
}

std::string describe_plan() {
  Plan plan;
  ZeroPressurePlan zero_pressure;
  IsothermPlan isotherm;
  IsochorePlan isochore;
  HugoniotPlan hugoniot;
  CoexistencePlan coexistence;
  std::string all;
  const auto section = [&](const char* title, const Bound& bound) {
    all += fmt::format("{}{}\n{}", all.empty() ? "" : "\n", title, describe(bound));
    if (!all.ends_with('\n')) all += '\n';
  };
  section("Top of the plan. The lattice constant and the cohesive energy are always measured.",
          head_keys(plan));
  section("[zero_pressure_volume]: volume and energy at zero pressure, by constant pressure and temperature",
          keys(zero_pressure));
  section("[[isotherm]]: pressure and energy at one temperature, by constant volume and temperature",
          keys(isotherm));
  section("[[isochore]]: pressure and energy at one volume", keys(isochore));
  section("[hugoniot]: states behind a shock from the first state of [zero_pressure_volume]", keys(hugoniot));
  section("[coexistence]: melting temperatures from a crystal in contact with its melt", keys(coexistence));
  return all;
}

}  // namespace whipple::md
