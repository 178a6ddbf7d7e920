// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "eos/loci.hpp"
#include "md_fitting/fit/outcomes.hpp"
#include "md_fitting/fit/proposal.hpp"
#include "tests/property/fit_recovery.hpp"

/// Molecular dynamics played by formulas with known constants, and with deviations of the sizes that the
/// fit's model errors state.
namespace whipple::fit::testing {

using md::PointRecord;
using Points = std::vector<PointRecord>;

inline md::Plan plan_from(const std::string& text) {
  auto document = input::Document::from_text(text, "plan.toml");
  return md::read_plan(document);
}

/// Copper-like ranges and sizes; as they stand an even plan: five shocks, three isochores of four
/// temperatures, melting at both ends of the pressures.
inline std::string plan_text(const std::string& adaptive) {
  return R"(
element = "Cu"
potential = "synthetic"
[zero_pressure_volume]
temperature = ["293 K"]
cells = 4
[hugoniot]
volume_ratio = [0.95, 0.89, 0.83, 0.77, 0.71]
cells = 4
equilibration_steps = 1000
steps = 4000
[[isochore]]
volume_ratio = 1.0
temperature = ["150 K", "500 K", "850 K", "1200 K"]
cells = 4
[[isochore]]
volume_ratio = 0.9
temperature = ["150 K", "750 K", "1350 K", "1950 K"]
cells = 4
[[isochore]]
volume_ratio = 0.8
temperature = ["150 K", "1150 K", "2200 K", "3200 K"]
cells = 4
[[coexistence]]
pressure = ["0 GPa", "20 GPa"]
first_guess = ["1320 K", "1900 K"]
[adaptive]
)" + adaptive;
}

/// Answers plans by the laws of the fit and the melting of GRAY.
class SyntheticDynamics {
 public:
  /// @param misfit  share of the fit's model errors that the answers deviate by; 0: none, and no noise
  SyntheticDynamics(const eos::GrayConstants& truth, double misfit, unsigned seed)
      : truth_(truth), misfit_(misfit), seed_(seed), solid_{truth} {
    solid_.heat_capacity = 3.0 * eos::GrayConstants::gas_constant / truth.molar_mass;
  }

  /// Adds what is missing of a plan.
  void answer(const md::Plan& plan, Points& points) const {
    const double v0 = truth_.reference_specific_volume;
    for (const double t : plan.zero_pressure->temperature) {
      add(points, "zero_pressure_volume", {{"temperature", t}, {"pressure", 0.0}}, plan.zero_pressure->size,
          [&](auto& deviate) {
            const double error = 2e-5 * v0;
            const double v = v0 * (1.0 + misfit_ * 1e-4 * deviate()) + noise() * error * deviate();
            return Results{{"specific_volume", {v, error}}};
          });
    }
    if (plan.hugoniot) {
      for (const double ratio : plan.hugoniot->volume_ratio) add_hugoniot(points, ratio, plan.hugoniot->size);
    }
    for (const md::IsochorePlan& isochore : plan.isochores) {
      for (const double t : isochore.temperature) add_state(points, isochore.volume_ratio, t, isochore.size);
    }
    for (const md::CoexistencePlan& section : plan.coexistences) {
      for (const double p : section.pressure) add_melting(points, p, section);
    }
  }

 private:
  using Results = std::map<std::string, md::Estimate>;
  [[nodiscard]] double static_volume() const { return truth_.reference_specific_volume / 1.014; }
  [[nodiscard]] double noise() const { return misfit_ > 0.0 ? 1.0 : 0.0; }

  /// Deviates that depend on what is measured, not on the order.
  [[nodiscard]] auto deviates(const std::string& label) const {
    return
        [generator = std::mt19937_64(whipple::seed_from(whipple::sha256(fmt::format("{} {}", seed_, label)))),
         normal = std::normal_distribution<double>()]() mutable { return normal(generator); };
  }

  template <class Measure>
  void add(Points& points, const std::string& protocol, const std::map<std::string, double>& conditions,
           const md::RunSize& size, Measure measure) const {
    PointRecord point;
    point.protocol = protocol;
    point.status = md::PointStatus::done;
    point.conditions = conditions;
    for (const PointRecord& other : points) {
      if (other.label() == point.label()) return;
    }
    auto deviate = deviates(point.label());
    point.results = measure(deviate);
    point.provenance = {{"element", "Cu"},
                        {"potential", "synthetic"},
                        {"molar_mass", fmt::format("{}", truth_.molar_mass)},
                        {"static_specific_volume", fmt::format("{}", static_volume())},
                        {"structure", "fcc"},
                        {"cells", std::to_string(size.cells)},
                        {"equilibration_steps", std::to_string(size.equilibration_steps)},
                        {"steps", std::to_string(size.steps)}};
    points.push_back(point);
  }

  void add_hugoniot(Points& points, double ratio, const md::RunSize& size) const {
    const double v0 = truth_.reference_specific_volume;
    const double v = ratio * static_volume();
    add(points, "hugoniot", {{"specific_volume", v}}, size, [&](auto& deviate) {
      const double x = 1.0 - v / v0;
      // At a volume us and up deviate together, Us - S up by C/Us of what Us does; the fit states that of Us
      // at an up.
      const auto deviation = [&](double compression) {
        return ModelErrors{}.shock_velocity / (1.0 - truth_.hugoniot_slope * compression);
      };
      const double us = truth_.hugoniot_intercept / (1.0 - truth_.hugoniot_slope * x) *
                        (1.0 + misfit_ * deviation(x) * deviate());
      double p = us * us * x / v0;
      const double error = 1e-3 * p;
      p += noise() * error * deviate();
      return Results{{"pressure", {p, error}},
                     {"shock_velocity", {std::sqrt(p * v0 / x), 0.0}},
                     {"particle_velocity", {std::sqrt(p * v0 * x), 0.0}}};
    });
  }

  void add_state(Points& points, double ratio, double t, const md::RunSize& size) const {
    const double v = ratio * static_volume();
    const double cold = thermal_energy(solid_, v, 150.0);
    auto common = deviates(fmt::format("isochore {}", v));
    const double gruneisen = gamma(truth_, v) * (1.0 + misfit_ * ModelErrors{}.gruneisen * common());
    const double anharmonic = misfit_ * ModelErrors{}.anharmonic * common();
    add(points, "isochore", {{"specific_volume", v}, {"temperature", t}}, size, [&](auto& deviate) {
      const ModelErrors errors;
      const double heat = thermal_energy(solid_, v, t) - cold;
      const double energy_error = 10.0 * std::sqrt(t);
      const double pressure_error = 1e6 * std::sqrt(t);
      const double energy = cold + heat * (1.0 + misfit_ * errors.energy * deviate()) +
                            anharmonic * (t * t - 150.0 * 150.0) / (2.0 * truth_.molar_mass) +
                            noise() * energy_error * deviate();
      const double pressure =
          (gruneisen * energy + gamma(truth_, v) * misfit_ * errors.thermal_pressure * deviate() * heat) / v +
          anharmonic_pressure(truth_, v, t) + noise() * pressure_error * deviate();
      return Results{{"pressure", {pressure, pressure_error}},
                     {"specific_internal_energy", {energy, energy_error}},
                     {"solid", {1.0, 0.0}}};
    });
  }

  void add_melting(Points& points, double pressure, const md::CoexistencePlan& section) const {
    const std::size_t before = points.size();
    add(points, "coexistence", {{"pressure", pressure}}, section.size, [&](auto& deviate) {
      const eos::ModelEquationOfState<eos::Gray> model(truth_);
      const eos::State solid = eos::melting_point(model, pressure).value().solidus;
      const double heat = Melting(truth_).latent_heat(pressure, solid.temperature);
      const ModelErrors errors;
      const double t = solid.temperature * (1.0 + misfit_ * errors.melting_temperature * deviate());
      return Results{{"melting_temperature", {t + noise() * 2.0 * deviate(), 2.0}},
                     {"solid_specific_volume", {1.0 / solid.density, 0.0}},
                     {"latent_heat",
                      {heat * (1.0 + misfit_ * errors.latent_heat * deviate() + noise() * 5e-3 * deviate()),
                       5e-3 * heat}}};
    });
    if (points.size() == before) return;
    points.back().provenance["length"] = std::to_string(section.length);
    points.back().provenance["replicas"] = std::to_string(section.replicas);
  }

  eos::GrayConstants truth_;
  double misfit_;
  unsigned seed_;
  SolidConstants solid_;
};

/// A complete set of constants that a fit can find: those of a fit of exact answers.
inline const eos::GrayConstants& truth() {
  static const eos::GrayConstants constants = [] {
    eos::GrayConstants start = true_constants();
    start.electronic_heat_coefficient = 0.69e-3;
    const md::Plan plan = plan_from(plan_text("outcome = \"shock_melting_pressure\"\nbudget = 1e9"));
    Points points;
    SyntheticDynamics(start, 0.0, 0).answer(plan, points);
    return fit_gray(points, {}, "synthetic").gray;
  }();
  return constants;
}

/// Rounds until the proposer is content.
inline Proposal work_off(const md::Plan& plan, const SyntheticDynamics& dynamics, int at_once,
                         Points& points) {
  for (;;) {
    Proposal proposal = propose(plan, points, at_once, "synthetic");
    if (!proposal.next) return proposal;
    dynamics.answer(*proposal.next, points);
  }
}

inline std::string outcome_keys(const std::string& name) {
  return fmt::format("outcome = \"{}\"\n{}", name,
                     name.starts_with("hugoniot_") ? "volume_ratio = 0.75\n" : "");
}

/// The fit of all points of the plan, and that of points chosen at the same cost.
inline std::pair<Proposal, Proposal> even_and_chosen(const std::string& outcome, double misfit,
                                                     unsigned seed) {
  const md::Plan even = plan_from(plan_text(outcome_keys(outcome) + "target_error = 1"));
  const SyntheticDynamics dynamics(truth(), misfit, seed);
  Points all;
  dynamics.answer(even, all);
  const Proposal standing = propose(even, all, 1, "synthetic");  // the target is met: nothing more
  EXPECT_FALSE(standing.next);
  const md::Plan adaptive =
      plan_from(plan_text(outcome_keys(outcome) + fmt::format("budget = {}", standing.spent)));
  Points chosen;
  const Proposal last = work_off(adaptive, dynamics, 40, chosen);
  EXPECT_LE(last.spent, standing.spent);
  return {standing, last};
}

inline void expect_less_error_than_even_plan(const std::string& outcome) {
  const auto [even, chosen] = even_and_chosen(outcome, 0.0, 1);
  std::printf("%s: even plan %.2f %%, chosen points %.2f %%\n", outcome.c_str(),
              100 * even.standing->error / even.standing->value,
              100 * chosen.standing->error / chosen.standing->value);
  EXPECT_LT(chosen.standing->error, 0.85 * even.standing->error) << outcome;
}

}  // namespace whipple::fit::testing
