// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/joint/joint_problem.hpp"

#include <cmath>
#include <numeric>
#include <optional>
#include <set>

#include "md_fitting/fit/discrepancy.hpp"
#include "md_fitting/fit/joint/potential_errors.hpp"
#include "src/core/base/linear_algebra.hpp"

namespace whipple::fit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using eos::experiments::Experiment;
using eos::experiments::ExperimentKind;

constexpr double quadratic_width = 3.0;  // of S2: 0.3, as wide as the values of metals scatter
constexpr double widest = 10.0;          // standard deviation of a parameter that no datum determines
constexpr double form_spread = 0.7;      // of ln f: a factor of two either way

/// Sets the size and the place of the deviation of the form at the points of a curve.
void set_form(LinearCurve& linear, double bulk_modulus) {
  const Experiment& experiment = linear.curve->experiment;
  const CurveForm form = form_of(experiment.kind);
  linear.size.resize(static_cast<Index>(linear.used.size()));
  for (const std::size_t i : linear.used) {
    linear.size[static_cast<Index>(linear.place.size())] =
        std::hypot(form.relative * experiment.ordinate[i], form.of_bulk_modulus * bulk_modulus);
    double place = experiment.abscissa[i];
    if (experiment.kind == ExperimentKind::melting || experiment.kind == ExperimentKind::sound_speed ||
        experiment.kind == ExperimentKind::shock_temperature) {
      place /= bulk_modulus;
    } else if (experiment.volume == eos::experiments::VolumeScale::density) {
      place = experiment.abscissa.front() / place;  // near V/V0
    }
    linear.place.push_back(place);
  }
}

/// Appends the deviation of the form from all curves of one kind, which is one function.
/// @param begin  first row of each curve; none: it takes no part
void add_form(const std::vector<LinearCurve>& curves, const std::vector<std::optional<Index>>& begin,
              ExperimentKind kind, LinearSystem& system) {
  VarianceComponent form{
      "form, " + kind_name(kind), Deviation::form, static_cast<std::size_t>(kind), {}, {}, form_spread};
  std::vector<double> size, place;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    if (!begin[c] || curves[c].curve->experiment.kind != kind) continue;
    for (Index row = 0; row < curves[c].size.size(); ++row) {
      form.rows.push_back(*begin[c] + row);
      size.push_back(curves[c].size[row]);
      place.push_back(curves[c].place[static_cast<std::size_t>(row)]);
    }
  }
  if (form.rows.empty()) return;
  const auto count = static_cast<Index>(size.size());
  form.covariance = MatrixXd::Zero(count, count);
  add_discrepancy(smooth(size, place, form_of(kind).length), rows_from(0, size.size()), form.covariance);
  system.components.push_back(std::move(form));
}

/// Appends the common error of all points of a table: its scale.
void add_scale(const LinearCurve& curve, std::size_t number, Index begin, LinearSystem& system) {
  VectorXd size(curve.size.size());
  VarianceComponent scale{
      "table, " + curve.curve->experiment.name, Deviation::table, number, {}, {}, form_spread};
  for (Index row = 0; row < size.size(); ++row) {
    scale.rows.push_back(begin + row);
    size[row] = form_of(curve.curve->experiment.kind).of_table * curve.ordinate(row);
  }
  scale.covariance = size * size.transpose();
  system.components.push_back(std::move(scale));
}

/// Makes the deviations of the forms orthogonal to the constants: those of the metal are by definition the ones that
/// follow its measured curves best, each kind with the same weight in units of its stated size. Otherwise a deviation
/// could take up what constants can, and simulations of another material would pull them (Plumlee, J. Am. Stat. Assoc.
/// 112 (2017) 1274). Constants that the curves do not determine within `known` are left free.
/// @param first  first row of the curves; `size` the stated size of the deviation of each row, `points` of its kind
void make_orthogonal(Index first, const VectorXd& size, const VectorXd& points, Index constants,
                     LinearSystem& system) {
  constexpr double known = 0.2;  // of the logarithm of a constant
  const Index count = size.size();
  const MatrixXd jacobian = system.jacobian.block(first, 0, count, constants);
  const VectorXd weight = (points.array() * size.array().square()).inverse();
  const MatrixXd normal = jacobian.transpose() * weight.asDiagonal() * jacobian +
                          MatrixXd::Identity(constants, constants) / (known * known);
  const MatrixXd rest =
      MatrixXd::Identity(count, count) -
      jacobian * solve_symmetric(normal, MatrixXd(jacobian.transpose() * weight.asDiagonal()));
  std::vector<Index> rows(static_cast<std::size_t>(count));
  std::iota(rows.begin(), rows.end(), first);
  for (VarianceComponent& component : system.components) {
    if (component.deviation != Deviation::form) continue;
    MatrixXd columns(count, static_cast<Index>(component.rows.size()));
    for (std::size_t k = 0; k < component.rows.size(); ++k)
      columns.col(static_cast<Index>(k)) = rest.col(component.rows[k] - first);
    component.covariance = MatrixXd(columns * component.covariance * columns.transpose());
    component.rows = rows;
  }
}

/// Returns the central differences of the simulated rows.
MatrixXd simulated_jacobian(const SolidProblem& problem, Index parameters) {
  constexpr double step = 1e-4;
  MatrixXd jacobian(problem.size(), parameters);
  VectorXd p = VectorXd::Zero(parameters);
  for (Index k = 0; k < parameters; ++k) {
    p[k] = step;
    const VectorXd above = problem.residuals(p);
    p[k] = -step;
    jacobian.col(k) = (above - problem.residuals(p)) / (2.0 * step);
    p[k] = 0.0;
  }
  return jacobian;
}

}  // namespace

double LinearCurve::deviation_variance(Index row, double form, double table) const {
  const double scale = table * form_of(curve->experiment.kind).of_table * ordinate(row);
  return form * form * size[row] * size[row] + scale * scale;
}

eos::GrayConstants material_constants(const SolidConstants& constants, double density) {
  eos::GrayConstants gray = constants.gray;
  gray.reference_specific_volume = 1.0 / density;
  return gray;
}

JointProblem::JointProblem(const SolidFit& fit, const SolidConstants& constants,
                           const std::vector<MeasuredCurve>& curves, double density)
    : free_(fit.model.free),
      simulated_(fit.data, fit.report.settings, fit.model, constants, fit.scale),
      weights_(simulated_.least_squares()),
      residuals_(simulated_.residuals(weights_.start)),
      jacobian_(simulated_jacobian(simulated_, weights_.start.size())),
      potential_(potential_deviations(simulated_, fit.data, constants)) {
  for (const Place place : free_) {
    before_.push_back(place == Place::quadratic ? at(constants, place) / scale_of(place) : 0.0);
  }
  constexpr double step = 1e-3;
  const auto values = [&](const SolidConstants& at_constants) {
    const CurveModel model(material_constants(at_constants, density));
    std::vector<std::vector<double>> all;
    for (const MeasuredCurve& curve : curves) all.push_back(model.values(curve.experiment));
    return all;
  };
  std::vector<std::vector<std::vector<double>>> above, below;
  const std::vector<std::vector<double>> here = values(constants);
  VectorXd p = VectorXd::Zero(simulated_.constants());
  for (Index k = 0; k < simulated_.constants(); ++k) {
    if (fit.model.free[static_cast<std::size_t>(k)] == Place::volume) {  // that of the metal is measured
      above.push_back(here);
      below.push_back(here);
      continue;
    }
    p[k] = step;
    above.push_back(values(simulated_.constants_at(p)));
    p[k] = -step;
    below.push_back(values(simulated_.constants_at(p)));
    p[k] = 0.0;
  }
  const double bulk_modulus = density * std::pow(constants.gray.hugoniot_intercept, 2);
  for (std::size_t c = 0; c < curves.size(); ++c) {
    LinearCurve linear;
    linear.curve = &curves[c];
    for (std::size_t i = 0; i < curves[c].points(); ++i) {
      bool finite = std::isfinite(here[c][i]);
      for (std::size_t k = 0; k < above.size(); ++k)
        finite = finite && std::isfinite(above[k][c][i]) && std::isfinite(below[k][c][i]);
      if (finite) linear.used.push_back(i);
    }
    const auto count = static_cast<Index>(linear.used.size());
    linear.residuals.resize(count);
    linear.jacobian.resize(count, simulated_.constants());
    for (Index row = 0; row < count; ++row) {
      const std::size_t i = linear.used[static_cast<std::size_t>(row)];
      linear.residuals[row] = curves[c].experiment.ordinate[i] - here[c][i];
      for (std::size_t k = 0; k < above.size(); ++k)
        linear.jacobian(row, static_cast<Index>(k)) = -(above[k][c][i] - below[k][c][i]) / (2.0 * step);
    }
    set_form(linear, bulk_modulus);
    curves_.push_back(std::move(linear));
  }
}

LinearSystem JointProblem::system(const std::vector<bool>& takes_part) const {
  const Index simulated = simulated_.size();
  Index rows = simulated + constants();
  for (std::size_t c = 0; c < curves_.size(); ++c)
    rows += takes_part[c] ? static_cast<Index>(curves_[c].used.size()) : 0;
  LinearSystem system;
  system.residuals = VectorXd::Zero(rows);
  system.jacobian = MatrixXd::Zero(rows, weights_.start.size());
  system.noise = MatrixXd::Zero(rows, rows);
  system.fixed = MatrixXd::Zero(rows, rows);
  system.residuals.head(simulated) = residuals_;
  system.jacobian.topRows(simulated) = jacobian_;
  system.noise.topLeftCorner(simulated, simulated) = weights_.statistical;
  system.fixed.topLeftCorner(simulated, simulated) = weights_.statistical + weights_.model;
  system.components = potential_;
  Index row = simulated;
  std::vector<std::optional<Index>> begin(curves_.size());
  std::set<ExperimentKind> kinds;
  for (std::size_t c = 0; c < curves_.size(); ++c) {
    if (!takes_part[c] || curves_[c].used.empty()) continue;
    const LinearCurve& curve = curves_[c];
    const auto count = static_cast<Index>(curve.used.size());
    system.residuals.segment(row, count) = curve.residuals;
    system.jacobian.block(row, 0, count, constants()) = curve.jacobian;
    for (Index i = 0; i < count; ++i) {
      const double error = curve.curve->error[curve.used[static_cast<std::size_t>(i)]];
      system.noise(row + i, row + i) = system.fixed(row + i, row + i) = error * error;
    }
    begin[c] = row;
    kinds.insert(curve.curve->experiment.kind);
    row += count;
  }
  for (const ExperimentKind kind : kinds) add_form(curves_, begin, kind, system);
  for (std::size_t c = 0; c < curves_.size(); ++c) {
    if (begin[c]) add_scale(curves_[c], c, *begin[c], system);
  }
  VectorXd size(row - simulated), points(row - simulated);
  for (std::size_t c = 0; c < curves_.size(); ++c) {
    if (!begin[c]) continue;
    const ExperimentKind kind = curves_[c].curve->experiment.kind;
    double of_kind = 0.0;
    for (std::size_t other = 0; other < curves_.size(); ++other) {
      if (begin[other] && curves_[other].curve->experiment.kind == kind)
        of_kind += static_cast<double>(curves_[other].used.size());
    }
    size.segment(*begin[c] - simulated, curves_[c].size.size()) = curves_[c].size;
    points.segment(*begin[c] - simulated, curves_[c].size.size()).setConstant(of_kind);
  }
  if (size.size() > 0) make_orthogonal(simulated, size, points, constants(), system);
  for (Index k = 0; k < constants(); ++k) {
    system.jacobian(row + k, k) = 1.0;
    system.residuals[row + k] = before_[static_cast<std::size_t>(k)];
    const double width = free_[static_cast<std::size_t>(k)] == Place::quadratic ? quadratic_width : widest;
    system.fixed(row + k, row + k) = width * width;
  }
  return system;
}

}  // namespace whipple::fit
