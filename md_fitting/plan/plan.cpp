// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/plan/plan.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

namespace whipple::md {
namespace {

template <auto Member>
input::Section<Plan, Plan> section_of(const char* name, const char* meaning) {
  return input::section<Member, Plan>(name, meaning);
}

}  // namespace

ParameterTable<Plan> Plan::parameters() {
  return {
      text("title", &Plan::title, "shown in messages").optional(),
      text("element", &Plan::element, "chemical symbol, e.g. \"Cu\""),
      text("potential", &Plan::potential,
           "name of a known potential, or a potential file in the folder of the plan or of LAMMPS; with "
           "pair_style: any "
           "name for it"),
      text("pair_style", &Plan::pair_style,
           "pair style of LAMMPS with its arguments, for potentials that are no tables "
           "of the embedded-atom kind")
          .optional(),
      text_list("pair_coeff", &Plan::pair_coeff, {},
                "what follows `pair_coeff`, one entry for each command; files lie in the "
                "folder of the plan or of LAMMPS")
          .optional(),
      real("validity_pressure", &Plan::validity_pressure, "Pa", range::non_negative(),
           "beyond it points are flagged; 0: where the potential's crystal, fit or table ends")
          .optional(),
      choice("structure", &Plan::structure, {"least_energy", "fcc", "bcc"},
             "crystal that is simulated; overrides the header of the potential file")
          .optional(),
      integer("seed", &Plan::seed, {.lower = 0}, "changes all initial velocities").optional(),
      integer("ranks_per_point", &Plan::ranks_per_point, {.lower = 1, .upper = 4096},
              "MPI ranks that compute one point together: for points of many thousand atoms; the last digits "
              "depend on it")
          .optional(),
      real("processor_time", &Plan::processor_time, "s", range::non_negative(),
           "budget of the plan, all ranks together: compared with the estimate at the start and the time at "
           "the end; "
           "0: none")
          .optional()};
}

void Plan::check(const Plan&, const input::Faults& faults) const {
  if (pair_style.empty() && !pair_coeff.empty()) {
    faults.add("pair_coeff", "'pair_coeff' belongs to a pair_style, which the plan does not give");
  }
  if (!pair_style.empty() && pair_coeff.empty()) {
    faults.add("pair_style", "'pair_style' needs its coefficients: pair_coeff = [\"* * FILE ELEMENT\"]");
  }
}

/// Lists the sections, one per line.
std::span<const input::Section<Plan, Plan>> Plan::sections() {
  static const std::vector<input::Section<Plan, Plan>> all = {
      section_of<&Plan::zero_pressure>(
          "zero_pressure_volume",
          ": volume and energy at zero pressure, by constant pressure and temperature"),
      section_of<&Plan::isotherms>(
          "isotherm", ": pressure and energy at one temperature, by constant volume and temperature"),
      section_of<&Plan::isochores>("isochore", ": pressure and energy at one volume"),
      section_of<&Plan::hugoniot>("hugoniot",
                                  ": states behind a shock from the first state of [zero_pressure_volume]"),
      section_of<&Plan::coexistences>("coexistence",
                                      ": melting temperatures from a crystal in contact with its melt"),
      section_of<&Plan::cold_curve>(
          "cold_curve",
          ": energy and pressure of the static crystal, and of fcc, bcc and hcp at the "
          "same volume"),
      section_of<&Plan::elastic>("elastic", ": elastic constants of the static crystal"),
      section_of<&Plan::hugoniostat>("hugoniostat",
                                     ": states behind a shock of given pressure, by the Hugoniostat"),
      section_of<&Plan::liquid>("liquid", ": volume and enthalpy of the melt"),
      section_of<&Plan::fluids>("fluid",
                                ": pressure and energy of liquid, hot and expanded fluid at one volume"),
      section_of<&Plan::piston>("piston", ": shocks that a piston drives through a crystal along [001]"),
      section_of<&Plan::spall>("spall", ": largest tension of a crystal that expands in all directions"),
      section_of<&Plan::liquid_vapour>("liquid_vapour", ": a film of melt and its vapour"),
      section_of<&Plan::quantum>("quantum",
                                 ": what quantum nuclei add to energy and pressure of the classical crystal"),
      section_of<&Plan::adaptive>(
          "adaptive",
          ": of a call with --adaptive: which result the points chosen from the ranges of the other "
          "sections improve")};
  return all;
}

Plan read_plan(input::Document& document) {
  Plan plan;
  input::Table root = document.root();
  plan.folder = root.folder();
  input::read_content(plan, plan, root);
  std::vector<InputFault> faults;
  input::check_content(plan, plan, input::Faults(faults));
  document.add(std::move(faults));
  document.finish();
  return plan;
}

Plan read_plan(const std::filesystem::path& path) {
  input::Document document = input::Document::from_file(path);
  return read_plan(document);
}

std::string plan_text(const Plan& plan) {
  Plan copy = plan;
  const auto placed = [&](const std::string& name) {
    const std::filesystem::path beside = plan.folder / name;
    return std::filesystem::is_regular_file(beside) ? std::filesystem::absolute(beside).string() : name;
  };
  copy.potential = placed(plan.potential);
  for (std::string& line : copy.pair_coeff) {
    std::istringstream words(line);
    std::string found;
    for (std::string word; words >> word;) found += (found.empty() ? "" : " ") + placed(word);
    line = found;
  }
  copy.adaptive.reset();
  return input::write_content(copy, "");
}

std::string describe_plan() {
  return "Top of the plan. The lattice constant and the cohesive energy are always measured.\n" +
         input::describe_content<Plan>("");
}

std::string plan_schema() {
  input::Schema table;
  input::add_content<Plan>(table);
  return input::schema_text(table, "Plan of whipple md", "Plan of molecular dynamics for whipple md.");
}

}  // namespace whipple::md
