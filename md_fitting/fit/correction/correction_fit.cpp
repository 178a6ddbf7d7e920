// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/correction/correction_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "eos/models/three_phase_model.hpp"
#include "md_fitting/data_set/points.hpp"
#include "md_fitting/fit/correction/correction_prior.hpp"
#include "md_fitting/fit/correction/left_out_curves.hpp"
#include "md_fitting/fit/correction/measured_rows.hpp"
#include "md_fitting/fit/correction/potential_rows.hpp"
#include "md_fitting/fit/correction/stability.hpp"
#include "md_fitting/fit/joint/variance_components.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/linear_algebra.hpp"

namespace whipple::fit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Errors of the conditions at the reference state, in units of rho0 C^2 and C^2: they fix it, and the zero of energy.
constexpr double reference_pressure_error = 1e-6, reference_energy_error = 1e-6;

/// Holds rows that are linear in the coefficients and the zero of energy, which comes last.
struct Rows {
  MatrixXd matrix;
  VectorXd values;
  MatrixXd covariance;
};

class Problem {
 public:
  Problem(const CorrectionSource& source, Films films)
      : constants_(source.metal),
        gray_(constants_),
        data_(collect(source, films)),
        grids_(correction_grids(data_, gray_)),
        energy_(constants_.hugoniot_intercept * constants_.hugoniot_intercept),
        parts_(correction_parts(grids_, energy_, constants_.reference_specific_volume)),
        limits_(stability_limits(gray_, grids_)) {
    require_numbers();
    add_reference();
    const auto count = static_cast<Index>(data_.data.size());
    rows_.matrix = MatrixXd::Zero(count, grids_.size() + 1);
    rows_.values.resize(count);
    rows_.covariance = data_.covariance;
    for (Index i = 0; i < count; ++i) {
      const CorrectionDatum& datum = data_.data[static_cast<std::size_t>(i)];
      rows_.matrix.row(i).head(grids_.size()) = coefficient_row(grids_, datum.terms);
      rows_.matrix(i, grids_.size()) = datum.energy_zero;
      rows_.values[i] = datum.residual;
    }
    centre_energies();
    estimate_sizes();
  }

  /// Returns the most probable coefficients with the zero of energy.
  /// @param rows  the data, and the limits of stability that decided
  VectorXd most_probable(Rows& rows) const {
    rows = rows_;
    return stable(rows, VectorXd::Zero(prior_.rows()));
  }
  /// Returns coefficients drawn from the posterior distribution: a draw from before the data, moved by what the data
  /// say of it (Matheron's rule), its distance from the most probable ones widened as the predictions of left-out curves:
  /// the part of the fluid as that of its isochores, the common part as those of the crystal.
  VectorXd draw(std::mt19937_64& random, const VectorXd& best,
                std::span<const LeftOutCurves> left_out) const {
    const VectorXd before = prior_root_ * normal(prior_root_.cols(), random);
    const VectorXd noise = noise_.lower() * normal(rows_.values.size(), random);
    Rows rows = rows_;
    rows.values += noise;
    VectorXd c = stable(rows, before);
    const auto common = static_cast<Index>(grids_.common.size());
    c.head(common) = best.head(common) + widened(left_out, CurveGroup::isochore) * (c - best).head(common);
    c.tail(c.size() - common) = best.tail(c.size() - common) +
                                widened(left_out, CurveGroup::fluid) * (c - best).tail(c.size() - common);
    return c;
  }
  [[nodiscard]] eos::CorrectedGrayConstants constants(const VectorXd& c) const {
    return {constants_, part(grids_.common, c.head(static_cast<Index>(grids_.common.size()))),
            part(grids_.fluid, c.segment(static_cast<Index>(grids_.common.size()),
                                         static_cast<Index>(grids_.fluid.size())))};
  }
  [[nodiscard]] CorrectionResult report(const VectorXd& c, const Rows& with_limits) const {
    CorrectionResult result;
    result.limited = static_cast<int>(with_limits.values.size() - rows_.values.size());
    result.left_out = left_out(with_limits);
    const eos::CorrectedGrayConstants all = constants(c);
    result.common = all.common;
    result.fluid = all.fluid;
    result.energy_zero = energy_zero_ + c[grids_.size()];
    for (std::size_t i = 0; i < parts_.size(); ++i)
      result.sizes.push_back({parts_[i].name, std::exp(log_factors_[static_cast<Index>(i)])});
    for (std::size_t i = 0; i < data_.deviations.size(); ++i)
      result.sizes.push_back(
          {data_.deviations[i].name, std::exp(log_factors_[static_cast<Index>(parts_.size() + i)])});
    const VectorXd rest = rows_.values - rows_.matrix * c;
    std::map<std::string, std::size_t> place;
    for (std::size_t i = 0; i + reference_rows < data_.data.size(); ++i) {
      const CorrectionDatum& datum = data_.data[i];
      const auto row = static_cast<Index>(i);
      const auto [at, is_new] = place.emplace(datum.kind, result.residuals.size());
      if (is_new) result.residuals.push_back({datum.kind});
      CorrectionResiduals& kind = result.residuals[at->second];
      ++kind.data;
      const double before = rows_.values[row] - datum.energy_zero * c[grids_.size()];
      const SurfaceTerm& state = datum.terms.front();
      result.rows.push_back({datum.kind, state.volume, state.temperature, before / datum.scale,
                             rest[row] / datum.scale, std::sqrt(rows_.covariance(row, row)) / datum.scale});
      kind.gray += std::pow(before / datum.scale, 2);
      kind.corrected += std::pow(rest[row] / datum.scale, 2);
      kind.of_errors += rest[row] * rest[row] / rows_.covariance(row, row);
    }
    for (CorrectionResiduals& kind : result.residuals) {
      for (double* sum : {&kind.gray, &kind.corrected, &kind.of_errors}) *sum = std::sqrt(*sum / kind.data);
    }
    return result;
  }

 private:
  static constexpr std::size_t reference_rows = 2;

  static eos::GrayConstants without_electrons(eos::GrayConstants constants) {
    constants.electronic_heat_coefficient = 0.0;
    return constants;
  }
  /// Collects simulations and measurements as data of the metal.
  static CorrectionData collect(const CorrectionSource& source, Films films) {
    const eos::GrayFreeEnergy simulated(without_electrons(source.simulated));
    const bool is_measured = !source.measured.empty();
    std::vector<double> melting;
    for (const MeasuredCurve& curve : source.measured) {
      if (curve.experiment.kind == eos::experiments::ExperimentKind::melting)
        melting.insert(melting.end(), curve.experiment.ordinate.begin(), curve.experiment.ordinate.end());
    }
    CorrectionData data = correction_data(source.points, simulated, films,
                                          is_measured ? of_films_for_metal : of_films, melting);
    if (is_measured) add_potential_errors(data, simulated);
    move_to(data, source.metal.reference_specific_volume / source.simulated.reference_specific_volume);
    return is_measured ? joined(std::move(data), measured_rows(source.measured, source.metal)) : data;
  }
  static VectorXd normal(Index size, std::mt19937_64& random) {
    std::normal_distribution<double> distribution;
    VectorXd x(size);
    for (Index i = 0; i < size; ++i) x[i] = distribution(random);
    return x;
  }

  /// @throws StateError with the state if GRAY or the store gives a datum or an error that is no number
  void require_numbers() const {
    for (std::size_t i = 0; i < data_.data.size(); ++i) {
      const CorrectionDatum& datum = data_.data[i];
      const double variance = data_.covariance(static_cast<Index>(i), static_cast<Index>(i));
      if (std::isfinite(datum.residual) && std::isfinite(variance)) continue;
      const SurfaceTerm& state = datum.terms.front();
      throw StateError(fmt::format(
          "correction: {} at V/V0 = {:.4g}, {:.4g} K has no value ({:.4g}, variance {:.4g})", datum.kind,
          state.volume / constants_.reference_specific_volume, state.temperature, datum.residual, variance));
    }
  }
  /// The correction leaves pressure and energy of the reference state as they are.
  void add_reference() {
    const eos::GrayConstants& c = constants_;
    const double V = c.reference_specific_volume, T = c.reference_temperature;
    data_.data.push_back({"reference state, pressure",
                          CorrectionRowKind::kept,
                          0.0,
                          1.0,
                          0.0,
                          {{PhaseSurface::solid, V, T, {.F_V = -1.0}}}});
    data_.data.push_back({"reference state, energy",
                          CorrectionRowKind::kept,
                          0.0,
                          1.0,
                          0.0,
                          {{PhaseSurface::solid, V, T, {.F = 1.0, .F_T = -T}}}});
    const Index count = data_.covariance.rows();
    MatrixXd all = MatrixXd::Zero(count + 2, count + 2);
    all.topLeftCorner(count, count) = data_.covariance;
    all(count, count) = std::pow(reference_pressure_error * energy_ / V, 2);
    all(count + 1, count + 1) = std::pow(reference_energy_error * energy_, 2);
    data_.covariance = std::move(all);
  }
  /// Takes the mean zero of energy out, so that what remains has the size of the corrections.
  void centre_energies() {
    double sum = 0.0, count = 0.0;
    for (Index i = 0; i < rows_.values.size(); ++i) {
      sum += rows_.matrix(i, grids_.size()) * rows_.values[i];
      count += rows_.matrix(i, grids_.size());
    }
    if (count == 0.0) return;
    energy_zero_ = sum / count;
    for (Index i = 0; i < rows_.values.size(); ++i)
      rows_.values[i] -= rows_.matrix(i, grids_.size()) * energy_zero_;
  }
  void estimate_sizes() {
    const double zero_width = energy_;  // of the zero of energy: far wider than the data leave it
    LinearSystem system;
    system.residuals = rows_.values;
    system.jacobian = -rows_.matrix.rightCols(1);
    system.noise = system.fixed = rows_.covariance;
    std::vector<Index> every(static_cast<std::size_t>(rows_.values.size()));
    for (std::size_t i = 0; i < every.size(); ++i) every[i] = static_cast<Index>(i);
    for (const CorrectionPart& part : parts_) {
      const MatrixXd columns = rows_.matrix.middleCols(part.first, part.covariance.rows());
      system.components.push_back({.name = part.name,
                                   .rows = every,
                                   .covariance = columns * part.covariance * columns.transpose(),
                                   .spread = part.spread});
    }
    for (const VarianceComponent& deviation : data_.deviations) system.components.push_back(deviation);
    log_factors_ =
        most_probable_factors(system, VectorXd::Zero(static_cast<Index>(system.components.size())));
    prior_ = MatrixXd::Zero(grids_.size() + 1, grids_.size() + 1);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const Index size = parts_[i].covariance.rows(), first = parts_[i].first;
      prior_.block(first, first, size, size) +=
          std::exp(2.0 * log_factors_[static_cast<Index>(i)]) * parts_[i].covariance;
    }
    for (std::size_t i = 0; i < data_.deviations.size(); ++i) {
      const VarianceComponent& deviation = data_.deviations[i];
      rows_.covariance(deviation.rows, deviation.rows) +=
          std::exp(2.0 * log_factors_[static_cast<Index>(parts_.size() + i)]) * deviation.covariance;
    }
    prior_(grids_.size(), grids_.size()) = zero_width * zero_width;
    const SymmetricEigen eigen = symmetric_eigen(prior_);
    prior_root_ = eigen.vectors * eigen.values.cwiseMax(0.0).cwiseSqrt().asDiagonal();
    noise_ = Cholesky(rows_.covariance);
  }
  [[nodiscard]] eos::CorrectionConstants part(const eos::FreeEnergyGrid& grid, const VectorXd& c) const {
    const double V0 = constants_.reference_specific_volume;
    eos::CorrectionConstants result{grid.least_volume / V0,
                                    grid.greatest_volume / V0,
                                    grid.temperature,
                                    static_cast<std::int64_t>(grid.temperatures),
                                    {}};
    for (const double value : c) result.coefficients.push_back(value / energy_);
    return result;
  }

  /// Returns the coefficients that the rows make most probable.
  /// @throws StateError if their covariance is singular to rounding: the estimated sizes have no bound
  [[nodiscard]] VectorXd solve(const Rows& rows, const VectorXd& before) const {
    const MatrixXd gain = prior_ * rows.matrix.transpose();
    const Cholesky sigma(rows.matrix * gain + rows.covariance);
    if (!sigma.is_positive()) {
      Index largest = 0;
      const double log_factor = log_factors_.head(static_cast<Index>(parts_.size())).maxCoeff(&largest);
      throw StateError(
          fmt::format("correction: the data ask for a part \"{}\" {:.1e} times as large as expected, and "
                      "their covariance is "
                      "singular: states without data decide; add some (expanded crystal, isochores)",
                      parts_[static_cast<std::size_t>(largest)].name, std::exp(log_factor)));
    }
    return before + gain * VectorXd(sigma.solve(rows.values - rows.matrix * before));
  }

  static double widened(std::span<const LeftOutCurves> left_out, CurveGroup group) {
    for (const LeftOutCurves& kind : left_out) {
      if (kind.group == group) return kind.widened;
    }
    return 1.0;
  }

  /// Returns how the data of each curve are predicted by all others: states of one isotherm, isochore, Hugoniot, film or
  /// table, pressures and energies together.
  [[nodiscard]] std::vector<LeftOutCurves> left_out(const Rows& rows) const {
    std::vector<LeftOutDatum> data;
    for (std::size_t i = 0; i + reference_rows < data_.data.size(); ++i) {
      const CorrectionDatum& datum = data_.data[i];
      // The line of GRAY is kept, not known.
      const bool is_known = datum.row != CorrectionRowKind::kept;
      data.push_back({.kind = datum.kind,
                      .curve = datum.curve,
                      .group = datum.group,
                      .scale = datum.scale,
                      .is_known = is_known});
    }
    return left_out_curves(data, rows.values,
                           rows.matrix * prior_ * rows.matrix.transpose() + rows.covariance, rows.covariance);
  }

  /// Solves, adds the most violated limits of stability as data, and repeats until all hold.
  /// @param rows  the data; then also these limits
  [[nodiscard]] VectorXd stable(Rows& rows, const VectorXd& before) const {
    constexpr int most_rounds = 40;
    constexpr std::size_t at_once = 6;
    // Aimed at beyond the limit, so that rows with an error end on the right side of it.
    constexpr double margin = 0.03, error = 0.01;
    std::size_t last_violation = 0;
    for (int round = 0; round < most_rounds; ++round) {
      const VectorXd c = solve(rows, before);
      const std::vector<std::size_t> violated = worst_violations(limits_, c.head(grids_.size()), at_once);
      if (violated.empty()) return c;
      last_violation = violated.front();
      const Index old = rows.values.size(), added = static_cast<Index>(violated.size());
      rows.matrix.conservativeResize(old + added, Eigen::NoChange);
      rows.values.conservativeResize(old + added);
      const MatrixXd covariance = rows.covariance;
      rows.covariance = MatrixXd::Zero(old + added, old + added);
      rows.covariance.topLeftCorner(old, old) = covariance;
      for (Index i = 0; i < added; ++i) {
        const StabilityLimit& limit = limits_[violated[static_cast<std::size_t>(i)]];
        rows.matrix.row(old + i).setZero();
        rows.matrix.row(old + i).head(grids_.size()) = limit.row;
        rows.values[old + i] = limit.least + margin;
        rows.covariance(old + i, old + i) = error * error;
      }
    }
    const StabilityLimit& worst = limits_[last_violation];
    throw StateError(
        fmt::format("correction: the data leave heat capacity or bulk modulus below half of those of GRAY at "
                    "V/V0 = {:.3g}, "
                    "{:.4g} K",
                    worst.volume / constants_.reference_specific_volume, worst.temperature));
  }

  eos::GrayConstants constants_;
  eos::GrayFreeEnergy gray_;
  CorrectionData data_;
  CorrectionGrids grids_;
  double energy_;
  std::vector<CorrectionPart> parts_;
  std::vector<StabilityLimit> limits_;
  Rows rows_;
  double energy_zero_ = 0.0;
  VectorXd log_factors_;
  MatrixXd prior_, prior_root_;
  Cholesky noise_;
};

/// Checks that the corrected phases make a material. @throws InputError if they do not
void require_material(const eos::CorrectedGrayConstants& constants) { eos::CorrectedGray model(constants); }

CorrectionResult fit_with(const CorrectionSource& source, int samples, std::uint64_t seed, Films films) {
  const Problem problem(source, films);
  Rows rows;
  const VectorXd best = problem.most_probable(rows);
  CorrectionResult result = problem.report(best, rows);
  require_material(problem.constants(best));
  std::mt19937_64 random(seed);
  int refused = 0;
  while (static_cast<int>(result.samples.size()) < samples) {
    try {
      eos::CorrectedGrayConstants sample = problem.constants(problem.draw(random, best, result.left_out));
      require_material(sample);
      result.samples.push_back(std::move(sample));
    } catch (const std::runtime_error& error) {  // InputError or StateError
      if (++refused > 4 * static_cast<int>(result.samples.size()) + 20)
        throw DrawsRefused(
            fmt::format("{} draws of the correction make no material; the last: {}", refused, error.what()));
    }
  }
  return result;
}

}  // namespace

CorrectionResult fit_correction(const CorrectionSource& source, int samples, std::uint64_t seed) {
  std::string reason;
  try {
    return fit_with(source, samples, seed, Films::used);
  } catch (const std::runtime_error& error) {  // InputError or StateError
    if (md::select_as<md::LiquidVapourPoint>(source.points).empty()) throw;
    reason = error.what();
  }
  CorrectionResult result = fit_with(source, samples, seed, Films::left_out);
  result.remark =
      fmt::format("films of melt and vapour left out, the expanded fluid stays that of GRAY: {}", reason);
  return result;
}

std::string correction_text(const CorrectionResult& result) {
  std::string text = fmt::format("{:<38} {:>5} {:>12} {:>12} {:>10}\n", "correction of the free energy: data",
                                 "", "GRAY %", "corrected %", "of errors");
  for (const CorrectionResiduals& kind : result.residuals) {
    text += fmt::format("{:<38} {:>5} {:>12.3f} {:>12.3f} {:>10.2f}\n", kind.kind, kind.data,
                        100.0 * kind.gray, 100.0 * kind.corrected, kind.of_errors);
  }
  text +=
      "in percent of rho0 C^2 (pressures of condensed states), 3RT (energies), RT/V and RT (films), of the "
      "heat "
      "of fusion, and of the melting temperature\n";
  text += fmt::format("\n{:<38} {:>5} {:>7} {:>9} {:>9} {:>12} {:>8} {:>8}\n",
                      "each curve predicted without itself", "", "curves", "in 68 %", "in 95 %",
                      "half-width %", "rms %", "widened");
  for (const LeftOutCurves& kind : result.left_out) {
    text += fmt::format("{:<38} {:>5} {:>7} {:>9.2f} {:>9.2f} {:>12.3f} {:>8.3f} {:>8.2f}\n", kind.kind,
                        kind.data, kind.curves, kind.inside_68, kind.inside_95, 100.0 * kind.half_width,
                        100.0 * kind.rms, kind.widened);
  }
  text += "sizes in units of those expected:";
  for (const CorrectionSize& size : result.sizes) text += fmt::format(" {} {:.2f};", size.name, size.factor);
  text += fmt::format(" {} limits of stability\n", result.limited);
  if (!result.remark.empty()) text += result.remark + "\n";
  return text;
}

}  // namespace whipple::fit
