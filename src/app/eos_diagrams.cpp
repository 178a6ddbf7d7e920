// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/eos_diagrams.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "eos/inversions.hpp"
#include "src/core/base/error.hpp"

namespace whipple::app {
namespace {

using eos::EquationOfState;
using eos::Hugoniot;
using eos::State;

constexpr int curve_points = 160;
/// Lowest pressure of the logarithmic diagram.
constexpr double lowest_pressure = 1e5;

Column state_column(const std::string& name) {
  for (const Column& column : state_columns()) {
    if (column.name == name) return column;
  }
  throw InternalError(fmt::format("no column {} of a state", name));
}

/// Collects curves of states into a figure on two quantities of a state.
class Diagram {
 public:
  Diagram(Figure& figure, const Material& material, int colour)
      : figure_(&figure), material_(&material), colour_(colour) {}

  /// One curve over a parameter; points where the model has no state are left out.
  void add(const std::string& label, const char* style, const std::vector<double>& values,
           const std::function<State(double)>& state) {
    FigureCurve curve{label, material_->name, {}, {}, colour_, style};
    for (const double value : values) {
      try {
        add_point(curve, state(value));
      } catch (const StateError&) {
        continue;
      }
    }
    if (!curve.x.empty()) figure_->curves.push_back(std::move(curve));
  }

  /// Isentrope from the reference state up to a pressure.
  void add_isentrope(const std::string& label, const char* style, const std::vector<double>& pressures) {
    const EquationOfState& eos = *material_->eos;
    State last = eos.state(eos.reference_density(), eos.reference_energy());
    add(label, style, pressures, [&](double pressure) {
      last = eos::isentrope_at_pressure(eos, last, pressure).state;
      return last;
    });
  }

  /// Release from a shocked state, in equilibrium where liquid and vapour are.
  void add_release(const char* style, const State& shocked, const std::vector<double>& pressures) {
    add("release", style, pressures, [&](double pressure) {
      return eos::release(*material_->eos, shocked, std::min(pressure, shocked.pressure)).end.state;
    });
  }

 private:
  void add_point(FigureCurve& curve, const State& state) const {
    curve.x.push_back(value_of(state, figure_->x));
    curve.y.push_back(value_of(state, figure_->y));
  }
  [[nodiscard]] double value_of(const State& state, const Column& column) const {
    if (column.name == "V_over_V0") return material_->eos->reference_density() / state.density;
    const double si = column.name == "P_GPa" ? state.pressure
                      : column.name == "T_K" ? state.temperature
                                             : state.density;
    return si / column.size;
  }

  Figure* figure_;
  const Material* material_;
  int colour_;
};

std::vector<double> geometric(double from, double to, int points) {
  std::vector<double> values;
  for (const double x : spaced(std::log(from), std::log(to), points)) values.push_back(std::exp(x));
  values.front() = from;
  values.back() = to;
  return values;
}

/// Isotherm over pressures, each point from the one before.
std::function<State(double)> isotherm(const EquationOfState& eos, double T) {
  return [&eos, T, density = std::optional<double>()](double pressure) mutable {
    const State s = eos::state_at_pressure_and_temperature(eos, pressure, T, density);
    density = s.density;
    return s;
  };
}

void shock_velocities(Figure& figure, const Material& material, int colour, double greatest) {
  const EquationOfState& eos = *material.eos;
  const Hugoniot hugoniot(eos);
  FigureCurve curve{"Hugoniot", material.name, {}, {}, colour, "solid"};
  const auto add = [](FigureCurve& to, const eos::ShockState& s) {
    to.x.push_back(s.particle_velocity * 1e-3);
    to.y.push_back(s.shock_velocity * 1e-3);
  };
  for (const double p : spaced(std::max(hugoniot.initial().pressure, 0.0), greatest, curve_points)) {
    try {
      add(curve, hugoniot.at_pressure(p));
    } catch (const StateError&) {
      break;  // the model ends
    }
  }
  figure.curves.push_back(curve);
  const auto melting = eos::shock_melting(eos, greatest);
  if (!melting) return;
  FigureCurve marks{"melting begins, ends", material.name, {}, {}, colour, "marks"};
  add(marks, melting->onset);
  add(marks, melting->completion);
  figure.curves.push_back(marks);
}

void volumes(Diagram& diagram, const EquationOfState& eos, double greatest) {
  const Hugoniot hugoniot(eos);
  diagram.add("Hugoniot", "solid", spaced(std::max(0.0, hugoniot.initial().pressure), greatest, curve_points),
              [&](double p) { return hugoniot.at_pressure(p).state; });
  if (!std::isfinite(eos.reference_temperature())) return;
  diagram.add("reference isotherm", "dashed", spaced(0, greatest, curve_points),
              isotherm(eos, eos.reference_temperature()));
  diagram.add("cold curve", "dotted",
              spaced(0.97 * eos.reference_density(),
                     std::min(3 * eos.reference_density(), eos.maximum_density()), 3 * curve_points),
              [&](double density) {
                const State s = eos::cold_state(eos, density);
                if (s.pressure < 0 || s.pressure > greatest) throw StateError("outside of the diagram");
                return s;
              });
}

void melting_lines(Diagram& diagram, const EquationOfState& eos, double greatest) {
  const auto point = [&](double p) {
    const auto melting = eos::melting_point(eos, p);
    if (!melting) throw StateError("does not melt");
    return *melting;
  };
  constexpr int points = 60;
  bool melts = false, band = false;
  try {
    const eos::MeltingPoint at_rest = point(0.0);
    melts = true;
    band = at_rest.liquidus.temperature > 1.002 * at_rest.solidus.temperature;
  } catch (const StateError&) {
    return;
  }
  if (!melts) return;
  diagram.add(band ? "solidus" : "melting line", "dashed", spaced(0, greatest, points),
              [&](double p) { return point(p).solidus; });
  if (band) {
    diagram.add("liquidus", "dotted", spaced(0, greatest, points),
                [&](double p) { return point(p).liquidus; });
  }
}

void temperatures(Diagram& diagram, const EquationOfState& eos, double greatest,
                  const std::vector<double>& releases) {
  melting_lines(diagram, eos, greatest);
  const Hugoniot hugoniot(eos);
  diagram.add("Hugoniot", "solid", spaced(std::max(0.0, hugoniot.initial().pressure), greatest, curve_points),
              [&](double p) { return hugoniot.at_pressure(p).state; });
  diagram.add_isentrope("isentrope", "dashdot",
                        spaced(std::max(0.0, hugoniot.initial().pressure), greatest, curve_points));
  for (const double p : releases) {
    // Denser towards low pressures, where the vapour forms.
    std::vector<double> pressures;
    for (const double x : spaced(1, 0, curve_points)) pressures.push_back(p * x * x * x + lowest_pressure);
    diagram.add_release("thin", hugoniot.at_pressure(p).state, pressures);
  }
}

void densities(Diagram& diagram, const EquationOfState& eos, double greatest,
               const std::vector<double>& releases) {
  const Hugoniot hugoniot(eos);
  diagram.add("Hugoniot", "solid",
              geometric(std::max(lowest_pressure, hugoniot.initial().pressure), greatest, 2 * curve_points),
              [&](double p) { return hugoniot.at_pressure(p).state; });
  for (const double p : releases) {
    diagram.add_release("thin", hugoniot.at_pressure(p).state, geometric(p, lowest_pressure, curve_points));
  }
  const eos::VapourDome* dome = eos.vapour_dome();
  if (dome == nullptr) return;
  const eos::CriticalPoint& critical = dome->critical_point();
  std::vector<double> branch;  // up the liquid, down the vapour: negative pressures
  // The densities meet at the critical point like square roots: points closer to each other towards it.
  std::vector<double> pressures;
  for (const double x : spaced(1, 0, curve_points))
    pressures.push_back(critical.pressure * std::pow(lowest_pressure / critical.pressure, x * x));
  for (const double p : pressures) branch.push_back(p);
  for (auto p = pressures.rbegin(); p != pressures.rend(); ++p) branch.push_back(-*p);
  diagram.add("liquid and vapour", "dashed", branch, [&](double p) {
    State s;
    if (std::abs(p) == critical.pressure) {
      s.pressure = critical.pressure;
      s.temperature = critical.temperature;
      s.density = 1 / critical.specific_volume;
      return s;
    }
    const auto saturation = dome->at_pressure(std::abs(p));
    if (!saturation) throw StateError("outside of the dome");
    s.pressure = saturation->pressure;
    s.temperature = saturation->temperature;
    s.density = 1 / (p > 0 ? saturation->liquid_volume : saturation->vapour_volume);
    return s;
  });
}

}  // namespace

const std::vector<std::string>& diagram_kinds() {
  static const std::vector<std::string> kinds = {"us-up", "p-v", "p-t", "p-rho"};
  return kinds;
}

Figure diagram(const std::string& kind, const EosOptions& options, const std::vector<std::string>& releases,
               const Materials& materials) {
  const double greatest = quantity("--to", options.to, "Pa").value_or(200 * GPa);
  if (!(greatest > 0)) throw InputError("--to: the greatest pressure must be positive");
  std::vector<double> shocks;
  for (const std::string& text : releases) shocks.push_back(*quantity("--release", text, "Pa"));
  if (shocks.empty()) shocks = {0.25 * greatest, 0.5 * greatest, greatest};
  const bool several = materials.size() > 1;
  Figure figure;
  figure.title = several ? "" : fmt::format("{} ({})", materials[0].name, materials[0].eos->model());
  if (kind == "us-up") {
    figure.x = {"up_km_s", "km/s", 1e3, "particle velocity"};
    figure.y = {"us_km_s", "km/s", 1e3, "shock velocity"};
  } else {
    figure.x = state_column(kind == "p-v" ? "V_over_V0" : kind == "p-t" ? "P_GPa" : "rho_kg_m3");
    figure.y = state_column(kind == "p-t" ? "T_K" : "P_GPa");
    figure.logarithmic_x = figure.logarithmic_y = kind == "p-rho";
  }
  int colour = 0;
  for (const Material& material : materials) {
    Diagram curves(figure, material, colour);
    if (kind == "us-up") shock_velocities(figure, material, colour, greatest);
    if (kind == "p-v") volumes(curves, *material.eos, greatest);
    if (kind == "p-t") temperatures(curves, *material.eos, greatest, shocks);
    if (kind == "p-rho") densities(curves, *material.eos, greatest, shocks);
    ++colour;
  }
  return figure;
}

}  // namespace whipple::app
