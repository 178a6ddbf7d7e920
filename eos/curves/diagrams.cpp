// SPDX-License-Identifier: BSD-3-Clause
#include "eos/curves/diagrams.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "eos/inversions.hpp"
#include "src/core/base/error.hpp"

namespace whipple::eos::curves {
namespace {

constexpr int curve_points = 160;
/// Lowest pressure (Pa) of the logarithmic diagram.
constexpr double lowest_pressure = 1e5;

/// Collects curves of states into a figure on two quantities of a state.
class Diagram {
 public:
  Diagram(Figure& figure, const Subject& subject, int colour)
      : figure_(&figure), subject_(&subject), colour_(colour) {}

  /// Adds one curve over a parameter; points where the model has no state are omitted.
  void add(const std::string& label, LineStyle style, const std::vector<double>& values,
           const std::function<State(double)>& state) {
    FigureCurve curve{label, subject_->name, {}, {}, colour_, style};
    for (const double value : values) {
      try {
        add_point(curve, state(value));
      } catch (const StateError&) {
        continue;
      }
    }
    if (!curve.x.empty()) figure_->curves.push_back(std::move(curve));
  }

  /// Adds the isentrope from the reference state up to a pressure.
  void add_isentrope(const std::string& label, LineStyle style, const std::vector<double>& pressures) {
    const EquationOfState& eos = *subject_->eos;
    State last = eos.state(eos.reference_density(), eos.reference_energy());
    add(label, style, pressures, [&](double pressure) {
      last = isentrope_at_pressure(eos, last, pressure).state;
      return last;
    });
  }

  /// Adds the release from a shocked state, in equilibrium where liquid and vapour coexist.
  void add_release(LineStyle style, const State& shocked, const std::vector<double>& pressures) {
    add("release", style, pressures, [&](double pressure) {
      return release(*subject_->eos, shocked, std::min(pressure, shocked.pressure)).end.state;
    });
  }

 private:
  void add_point(FigureCurve& curve, const State& state) const {
    curve.x.push_back(value_of(state, figure_->x));
    curve.y.push_back(value_of(state, figure_->y));
  }
  [[nodiscard]] double value_of(const State& state, const Column& column) const {
    const CurveRow cells = state_cells(state, *subject_->eos);
    const auto place =
        std::ranges::find(state_columns(), column.name, &Column::name) - state_columns().begin();
    return std::get<double>(cells[static_cast<std::size_t>(place)]) / column.size;
  }

  Figure* figure_;
  const Subject* subject_;
  int colour_;
};

std::vector<double> geometric(double from, double to, int points) {
  std::vector<double> values;
  for (const double x : spaced(std::log(from), std::log(to), points)) values.push_back(std::exp(x));
  values.front() = from;
  values.back() = to;
  return values;
}

/// Returns the isotherm as a function of pressure; each point starts from the previous one.
std::function<State(double)> isotherm(const EquationOfState& eos, double T) {
  return [&eos, T, density = std::optional<double>()](double pressure) mutable {
    const State s = state_at_pressure_and_temperature(eos, pressure, T, density);
    density = s.density;
    return s;
  };
}

void shock_velocities(Figure& figure, const Subject& subject, int colour, double greatest) {
  const EquationOfState& eos = *subject.eos;
  const Hugoniot hugoniot(eos);
  FigureCurve curve{"Hugoniot", subject.name, {}, {}, colour, LineStyle::solid};
  const auto add = [&figure](FigureCurve& to, const ShockState& s) {
    to.x.push_back(s.particle_velocity / figure.x.size);
    to.y.push_back(s.shock_velocity / figure.y.size);
  };
  for (const double p : spaced(std::max(hugoniot.initial().pressure, 0.0), greatest, curve_points)) {
    try {
      add(curve, hugoniot.at_pressure(p));
    } catch (const StateError&) {
      break;  // the range of the model ends
    }
  }
  figure.curves.push_back(curve);
  const auto melting = shock_melting(eos, greatest);
  if (!melting) return;
  FigureCurve marks{"melting begins, ends", subject.name, {}, {}, colour, LineStyle::marks};
  add(marks, melting->onset);
  add(marks, melting->completion);
  figure.curves.push_back(marks);
}

void volumes(Diagram& diagram, const EquationOfState& eos, double greatest) {
  const Hugoniot hugoniot(eos);
  diagram.add("Hugoniot", LineStyle::solid,
              spaced(std::max(0.0, hugoniot.initial().pressure), greatest, curve_points),
              [&](double p) { return hugoniot.at_pressure(p).state; });
  if (!std::isfinite(eos.reference_temperature())) return;
  diagram.add("reference isotherm", LineStyle::dashed, spaced(0, greatest, curve_points),
              isotherm(eos, eos.reference_temperature()));
  diagram.add("cold curve", LineStyle::dotted,
              spaced(0.97 * eos.reference_density(),
                     std::min(3 * eos.reference_density(), eos.maximum_density()), 3 * curve_points),
              [&](double density) {
                const State s = cold_state(eos, density);
                if (s.pressure < 0 || s.pressure > greatest) throw StateError("outside of the diagram");
                return s;
              });
}

void melting_lines(Diagram& diagram, const EquationOfState& eos, double greatest) {
  const auto point = [&](double p) {
    const auto melting = melting_point(eos, p);
    if (!melting) throw StateError("does not melt");
    return *melting;
  };
  constexpr int points = 60;
  bool melts = false, band = false;
  try {
    const MeltingPoint at_rest = point(0.0);
    melts = true;
    band = at_rest.liquidus.temperature > 1.002 * at_rest.solidus.temperature;
  } catch (const StateError&) {
    return;
  }
  if (!melts) return;
  diagram.add(band ? "solidus" : "melting line", LineStyle::dashed, spaced(0, greatest, points),
              [&](double p) { return point(p).solidus; });
  if (band) {
    diagram.add("liquidus", LineStyle::dotted, spaced(0, greatest, points),
                [&](double p) { return point(p).liquidus; });
  }
}

void temperatures(Diagram& diagram, const EquationOfState& eos, double greatest,
                  const std::vector<double>& releases) {
  melting_lines(diagram, eos, greatest);
  const Hugoniot hugoniot(eos);
  diagram.add("Hugoniot", LineStyle::solid,
              spaced(std::max(0.0, hugoniot.initial().pressure), greatest, curve_points),
              [&](double p) { return hugoniot.at_pressure(p).state; });
  diagram.add_isentrope("isentrope", LineStyle::dashdot,
                        spaced(std::max(0.0, hugoniot.initial().pressure), greatest, curve_points));
  for (const double p : releases) {
    // Use closer points at low pressures, where the vapour forms.
    std::vector<double> pressures;
    for (const double x : spaced(1, 0, curve_points)) pressures.push_back(p * x * x * x + lowest_pressure);
    diagram.add_release(LineStyle::thin, hugoniot.at_pressure(p).state, pressures);
  }
}

void densities(Diagram& diagram, const EquationOfState& eos, double greatest,
               const std::vector<double>& releases) {
  const Hugoniot hugoniot(eos);
  diagram.add("Hugoniot", LineStyle::solid,
              geometric(std::max(lowest_pressure, hugoniot.initial().pressure), greatest, 2 * curve_points),
              [&](double p) { return hugoniot.at_pressure(p).state; });
  for (const double p : releases) {
    diagram.add_release(LineStyle::thin, hugoniot.at_pressure(p).state,
                        geometric(p, lowest_pressure, curve_points));
  }
  const VapourDome* dome = eos.vapour_dome();
  if (dome == nullptr) return;
  const CriticalPoint& critical = dome->critical_point();
  std::vector<double> branch;  // up the liquid, down the vapour: negative pressures
  // The densities merge at the critical point like square roots: use closer points towards it.
  std::vector<double> pressures;
  for (const double x : spaced(1, 0, curve_points))
    pressures.push_back(critical.pressure * std::pow(lowest_pressure / critical.pressure, x * x));
  for (const double p : pressures) branch.push_back(p);
  for (auto p = pressures.rbegin(); p != pressures.rend(); ++p) branch.push_back(-*p);
  diagram.add("liquid and vapour", LineStyle::dashed, branch, [&](double p) {
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

Figure axes(DiagramKind kind) {
  Figure figure;
  switch (kind) {
    case DiagramKind::shock_velocity:
      figure.x = quantity_column("up_km_s", "km/s", "m/s", "particle velocity");
      figure.y = quantity_column("us_km_s", "km/s", "m/s", "shock velocity");
      break;
    case DiagramKind::pressure_volume:
      figure.x = state_column("V_over_V0");
      figure.y = state_column("P_GPa");
      break;
    case DiagramKind::pressure_temperature:
      figure.x = state_column("P_GPa");
      figure.y = state_column("T_K");
      break;
    case DiagramKind::pressure_density:
      figure.x = state_column("rho_kg_m3");
      figure.y = state_column("P_GPa");
      figure.logarithmic_x = figure.logarithmic_y = true;
      break;
  }
  return figure;
}

}  // namespace

Figure diagram(DiagramKind kind, const Subjects& subjects, double greatest, std::vector<double> releases) {
  if (!(greatest > 0)) throw InputError("the maximum pressure of a diagram must be positive");
  if (releases.empty()) releases = {0.25 * greatest, 0.5 * greatest, greatest};
  Figure figure = axes(kind);
  if (subjects.size() == 1) figure.title = fmt::format("{} ({})", subjects[0].name, subjects[0].eos->model());
  int colour = 0;
  for (const Subject& subject : subjects) {
    Diagram curves(figure, subject, colour);
    switch (kind) {
      case DiagramKind::shock_velocity:
        shock_velocities(figure, subject, colour, greatest);
        break;
      case DiagramKind::pressure_volume:
        volumes(curves, *subject.eos, greatest);
        break;
      case DiagramKind::pressure_temperature:
        temperatures(curves, *subject.eos, greatest, releases);
        break;
      case DiagramKind::pressure_density:
        densities(curves, *subject.eos, greatest, releases);
        break;
    }
    ++colour;
  }
  return figure;
}

}  // namespace whipple::eos::curves
