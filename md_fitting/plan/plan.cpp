// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/plan/plan.hpp"

#include <fmt/format.h>

namespace whipple::md {
namespace {

std::vector<BoundParameter> keys(Plan& plan) {
  static const ParameterTable<Plan> table = {
      text("title", &Plan::title, "shown in messages").optional(),
      text("element", &Plan::element, "chemical symbol, e.g. \"Cu\""),
      text("potential", &Plan::potential,
           "name of a known potential, or a potential file beside the plan or in the folder of LAMMPS"),
      choice("structure", &Plan::structure, {"least_energy", "fcc", "bcc"},
             "crystal that is simulated; what the file of the potential says does not count")
          .optional(),
      integer("seed", &Plan::seed, {.lower = 0}, "changes all initial velocities").optional(),
      integer("ranks_per_point", &Plan::ranks_per_point, {.lower = 1, .upper = 4096},
              "MPI ranks that compute one point together: for points of many thousand atoms; the last digits "
              "depend "
              "on it")
          .optional()};
  return bind(table, plan);
}

template <class Content>
void read_section(Content& section, const Plan& plan, input::Table& table) {
  table.read(keys(section));
  if constexpr (requires { check(section, plan, table); }) check(section, plan, table);
}

template <class Content>
std::vector<Content> as_list(const std::optional<Content>& section) {
  return section ? std::vector<Content>{*section} : std::vector<Content>{};
}
template <class Content>
const std::vector<Content>& as_list(const std::vector<Content>& sections) {
  return sections;
}

/// How one section is read, described and written, whatever its type.
struct Section {
  const char* name;
  const char* meaning;
  void (*read)(Plan& plan, input::Table& root, const char* name);
  std::string (*describe)(const char* name, const char* meaning);
  std::string (*write)(const Plan& plan, const char* name);
};

template <auto Member>
Section section(const char* name, const char* meaning) {
  using Holder = std::remove_reference_t<decltype(Plan{}.*Member)>;
  using Content = typename Holder::value_type;
  constexpr bool single = std::is_same_v<Holder, std::optional<Content>>;
  return {name, meaning,
          [](Plan& plan, input::Table& root, const char* key) {
            Holder& holder = plan.*Member;
            if constexpr (single) {
              if (auto table = root.optional_table(key)) read_section(holder.emplace(), plan, *table);
            } else {
              for (input::Table& table : root.list(key)) read_section(holder.emplace_back(), plan, table);
            }
          },
          [](const char* key, const char* text) {
            Content defaults;
            return fmt::format("{0}{2}{1}: {3}\n{4}", single ? "[" : "[[", single ? "]" : "]]", key, text,
                               describe(keys(defaults)));
          },
          [](const Plan& plan, const char* key) {
            std::string all;
            for (Content content : as_list(plan.*Member)) {
              all += fmt::format("\n{0}{2}{1}\n{3}", single ? "[" : "[[", single ? "]" : "]]", key,
                                 to_toml(keys(content)));
            }
            return all;
          }};
}

/// The sections: one line each. A section may ask in its check for the ones above it.
const std::vector<Section>& sections() {
  static const std::vector<Section> all = {
      section<&Plan::zero_pressure>(
          "zero_pressure_volume", "volume and energy at zero pressure, by constant pressure and temperature"),
      section<&Plan::isotherms>("isotherm",
                                "pressure and energy at one temperature, by constant volume and temperature"),
      section<&Plan::isochores>("isochore", "pressure and energy at one volume"),
      section<&Plan::hugoniot>("hugoniot",
                               "states behind a shock from the first state of [zero_pressure_volume]"),
      section<&Plan::coexistence>("coexistence",
                                  "melting temperatures from a crystal in contact with its melt"),
      section<&Plan::cold_curve>("cold_curve",
                                 "energy and pressure of the static crystal, and of fcc, bcc and hcp at the "
                                 "same volume"),
      section<&Plan::elastic>("elastic", "elastic constants of the static crystal"),
      section<&Plan::hugoniostat>("hugoniostat",
                                  "states behind a shock of given pressure, by the Hugoniostat"),
      section<&Plan::liquid>("liquid", "volume and enthalpy of the melt"),
      section<&Plan::piston>("piston", "shocks that a piston drives through a crystal along [001]"),
      section<&Plan::spall>("spall", "largest tension of a crystal that expands in all directions"),
      section<&Plan::liquid_vapour>("liquid_vapour", "a film of melt and its vapour"),
      section<&Plan::adaptive>(
          "adaptive",
          "of a call with --adaptive: what the points chosen from the ranges of the other "
          "sections shall tell")};
  return all;
}

}  // namespace

Plan read_plan(input::Document& document) {
  Plan plan;
  input::Table root = document.root();
  plan.folder = root.folder();
  root.read(keys(plan));
  for (const Section& section : sections()) section.read(plan, root, section.name);
  document.finish();
  return plan;
}

Plan read_plan(const std::filesystem::path& path) {
  input::Document document = input::Document::from_file(path);
  return read_plan(document);
}

std::string plan_text(const Plan& plan) {
  Plan copy = plan;
  const std::filesystem::path beside = plan.folder / plan.potential;
  if (std::filesystem::is_regular_file(beside)) copy.potential = std::filesystem::absolute(beside).string();
  std::string all = to_toml(keys(copy));
  copy.adaptive.reset();
  for (const Section& section : sections()) all += section.write(copy, section.name);
  return all;
}

std::string describe_plan() {
  Plan plan;
  std::string all =
      fmt::format("Top of the plan. The lattice constant and the cohesive energy are always measured.\n{}",
                  describe(keys(plan)));
  for (const Section& section : sections()) {
    if (!all.ends_with('\n')) all += '\n';
    all += '\n' + section.describe(section.name, section.meaning);
  }
  if (!all.ends_with('\n')) all += '\n';
  return all;
}

}  // namespace whipple::md
