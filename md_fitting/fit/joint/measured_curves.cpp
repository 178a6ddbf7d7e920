// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/joint/measured_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "eos/experiments/comparison.hpp"
#include "eos/model_equation_of_state.hpp"
#include "eos/models/debye_function.hpp"
#include "eos/models/gray.hpp"
#include "src/core/base/error.hpp"

namespace whipple::fit {
namespace {

using eos::experiments::Experiment;
using eos::experiments::ExperimentKind;

constexpr std::size_t most_points = 1500;  // the cost of the fit grows as their third power
constexpr std::size_t least_points = 4;    // of a scatter
/// Least error of an ordinate without a stated one, relative: tables of a smooth formula have no scatter.
constexpr double least_scatter = 1e-4;

/// Returns the slope d(ordinate)/d(abscissa) of the points by differences between neighbours.
std::vector<double> slopes(const Experiment& experiment) {
  const std::vector<double>& x = experiment.abscissa;
  const std::vector<double>& y = experiment.ordinate;
  std::vector<double> slope(x.size(), 0.0);
  for (std::size_t i = 0; i < x.size() && x.size() > 1; ++i) {
    const std::size_t before = i == 0 ? 0 : i - 1;
    const std::size_t after = std::min(i + 1, x.size() - 1);
    if (x[after] > x[before]) slope[i] = (y[after] - y[before]) / (x[after] - x[before]);
  }
  return slope;
}

/// Returns the errors of points of which a table states none: the scatter along them, and at least that of rounding.
std::vector<double> unstated_errors(const std::vector<double>& x, const std::vector<double>& y,
                                    bool relative) {
  std::vector<double> error = scatter_along(x, y, relative);
  for (std::size_t i = 0; i < x.size(); ++i) error[i] = std::hypot(error[i], least_scatter * y[i]);
  return error;
}

/// Sets the errors of a curve: those that the file states; where it states none, the scatter along these points, or
/// with fewer than four of them the median of the others, relative.
void set_errors(MeasuredCurve& curve) {
  const Experiment& experiment = curve.experiment;
  const std::vector<double>& x = experiment.abscissa;
  const std::vector<double>& y = experiment.ordinate;
  const bool relative = eos::experiments::is_pressure(experiment.kind);
  curve.stated = experiment.states_errors;
  if (!curve.stated) {
    curve.error = unstated_errors(x, y, relative);
    return;
  }
  const std::vector<double> slope = slopes(experiment);
  std::vector<double> shares, other_x, other_y;
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < curve.points(); ++i) {
    const double error = std::hypot(experiment.ordinate_error[i], slope[i] * experiment.abscissa_error[i]);
    curve.error.push_back(error);
    if (std::isfinite(error) && error > 0.0) {
      shares.push_back(error / std::abs(y[i]));
    } else {
      others.push_back(i);
      other_x.push_back(x[i]);
      other_y.push_back(y[i]);
    }
  }
  if (others.size() >= least_points) {
    const std::vector<double> error = unstated_errors(other_x, other_y, relative);
    for (std::size_t k = 0; k < others.size(); ++k) curve.error[others[k]] = error[k];
  } else if (!others.empty()) {
    if (shares.empty()) {
      throw InputError(
          fmt::format("{}: none of the stated errors is a positive number", experiment.file.string()));
    }
    std::ranges::nth_element(shares, shares.begin() + static_cast<std::ptrdiff_t>(shares.size() / 2));
    for (const std::size_t i : others) curve.error[i] = shares[shares.size() / 2] * std::abs(y[i]);
  }
}

/// Converts heat capacities and expansions to those of classical nuclei, which GRAY has: both fall with the heat
/// capacity of the vibrations, c_v/3R of Debye's model. A fifth of the correction counts as its error; points with a
/// correction above 20 % are removed.
void make_classical(MeasuredCurve& curve, double debye_temperature) {
  constexpr double least_share = 0.8, error_of_correction = 0.2;
  Experiment& experiment = curve.experiment;
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < curve.points(); ++i) {
    const double y = debye_temperature / experiment.abscissa[i];
    const double share = 4.0 * eos::debye_function(y) - 3.0 * y / std::expm1(y);
    if (share < least_share) {
      experiment.left_out["far below the Debye temperature"].push_back(experiment.lines[i]);
      continue;
    }
    experiment.ordinate[i] /= share;
    curve.error[i] =
        std::hypot(curve.error[i] / share, error_of_correction * (1.0 - share) * experiment.ordinate[i]);
    kept.push_back(i);
  }
  const auto keep = [&](auto& values) {
    for (std::size_t k = 0; k < kept.size(); ++k) values[k] = values[kept[k]];
    values.resize(kept.size());
  };
  for (std::vector<double>* values :
       {&experiment.abscissa, &experiment.ordinate, &experiment.initial_density, &experiment.porosity,
        &experiment.temperatures, &experiment.ordinate_error, &experiment.abscissa_error, &curve.error})
    keep(*values);
  keep(experiment.lines);
}

}  // namespace

std::string kind_name(ExperimentKind kind) {
  switch (kind) {
    case ExperimentKind::shock_velocity:
      return "shock velocity";
    case ExperimentKind::shock_pressure:
      return "pressure of the Hugoniot";
    case ExperimentKind::isotherm:
      return "isotherm";
    case ExperimentKind::melting:
      return "melting line";
    case ExperimentKind::isentrope:
      return "isentrope";
    case ExperimentKind::sound_speed:
      return "sound speed";
    case ExperimentKind::shock_temperature:
      return "shock temperature";
    case ExperimentKind::heat_capacity:
      return "heat capacity";
    case ExperimentKind::expansion:
      return "thermal expansion";
  }
  throw InternalError("unknown kind of a measured curve");
}

CurveForm form_of(ExperimentKind kind) {
  switch (kind) {
    case ExperimentKind::shock_velocity:
      return {0.003, 0.0, 1000.0, 0.003};
    case ExperimentKind::shock_pressure:
    case ExperimentKind::isotherm:
    case ExperimentKind::isentrope:
      return {0.01, 5e-4, 0.1, 0.01};
    case ExperimentKind::melting:
      return {0.02, 0.0, 0.3, 0.01};
    case ExperimentKind::sound_speed:
      return {0.01, 0.0, 0.5, 0.01};
    case ExperimentKind::shock_temperature:
      return {0.05, 0.0, 0.5, 0.03};
    case ExperimentKind::heat_capacity:
    case ExperimentKind::expansion:
      return {0.02, 0.0, 500.0, 0.01};
  }
  throw InternalError("unknown kind of a measured curve");
}

std::vector<MeasuredCurve> read_curves(std::span<const std::filesystem::path> tables,
                                       const std::string& metal, std::optional<double> debye_temperature) {
  std::vector<MeasuredCurve> curves;
  std::size_t points = 0;
  for (const std::filesystem::path& table : tables) {
    const std::size_t before = curves.size();
    for (Experiment& experiment : eos::experiments::read_experiments(table)) {
      if (!eos::experiments::belongs_to(experiment, metal)) continue;
      MeasuredCurve curve{std::move(experiment), {}, false};
      set_errors(curve);
      const ExperimentKind kind = curve.experiment.kind;
      if (kind == ExperimentKind::heat_capacity || kind == ExperimentKind::expansion) {
        if (!debye_temperature) {
          throw InputError(
              fmt::format("--with {}: without the Debye temperature of {} (--defaults FILE) its values are "
                          "not those of the "
                          "model, whose nuclei are classical",
                          table.string(), metal));
        }
        make_classical(curve, *debye_temperature);
      }
      points += curve.points();
      curves.push_back(std::move(curve));
    }
    if (curves.size() == before) {
      throw InputError(fmt::format("--with {}: measured on another material than {}", table.string(), metal));
    }
  }
  if (points > most_points) {
    throw InputError(
        fmt::format("--with: {} measured points; at most {} take part in one fit", points, most_points));
  }
  return curves;
}

std::vector<double> scatter_along(std::span<const double> x, std::span<const double> y, bool relative) {
  if (x.size() < least_points) {
    throw InputError(fmt::format(
        "{} points are too few to tell their scatter: four, or a column of errors, are needed", x.size()));
  }
  double sum = 0.0;
  for (std::size_t i = 1; i + 1 < x.size(); ++i) {
    const double span = x[i + 1] - x[i - 1];
    const double weight = span > 0.0 ? (x[i + 1] - x[i]) / span : 0.5;
    const double line = weight * y[i - 1] + (1.0 - weight) * y[i + 1];
    const double variance = 1.0 + weight * weight + (1.0 - weight) * (1.0 - weight);
    const double scale = relative ? y[i] : 1.0;
    sum += (y[i] - line) * (y[i] - line) / (variance * scale * scale);
  }
  const double scatter = std::sqrt(sum / static_cast<double>(x.size() - 2));
  std::vector<double> error(x.size(), scatter);
  if (relative) {
    for (std::size_t i = 0; i < x.size(); ++i) error[i] *= std::abs(y[i]);
  }
  return error;
}

std::optional<double> initial_density(std::span<const MeasuredCurve> curves) {
  std::vector<double> densities;
  for (const MeasuredCurve& curve : curves) {
    for (const double density : curve.experiment.initial_density) {
      if (density > 0.0) densities.push_back(density);
    }
  }
  if (densities.empty()) return std::nullopt;
  const double largest = *std::ranges::max_element(densities);
  std::erase_if(densities,
                [&](double density) { return density < (1.0 - eos::experiments::same_density) * largest; });
  std::ranges::nth_element(densities, densities.begin() + static_cast<std::ptrdiff_t>(densities.size() / 2));
  return densities[densities.size() / 2];
}

CurveModel::CurveModel(const eos::GrayConstants& constants)
    : model_(std::make_unique<eos::ModelEquationOfState<eos::Gray>>(constants)),
      initial_(model_->state_at_temperature(model_->reference_density(), model_->reference_temperature())) {}

std::vector<double> CurveModel::values(const Experiment& experiment) const {
  return eos::experiments::curve(
      *model_, initial_, experiment,
      {experiment.abscissa, eos::experiments::initial_densities(initial_.density, experiment),
       experiment.temperatures});
}

}  // namespace whipple::fit
