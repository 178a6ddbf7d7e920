// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/compare_calibration.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>
#include <utility>

#include "eos/experiments/calibration.hpp"
#include "src/app/eos_remarks.hpp"
#include "src/app/eos_table.hpp"
#include "src/core/base/csv.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/text_table.hpp"
#include "src/material/material_samples.hpp"

namespace whipple::app {
namespace {

using eos::experiments::Calibration;

std::string csv_rows(const CalibratedPair& pair, const Calibration& calibration) {
  const eos::experiments::Experiment& experiment = *pair.experiment;
  std::string text;
  for (std::size_t i = 0; i < experiment.abscissa.size(); ++i) {
    text += fmt::format("{},\"{}\",{:.8g},{:.8g},{:.8g},{:.6g},{:.6g},{:.6g}\n", csv_cell(experiment.name),
                        pair.label, experiment.abscissa[i], experiment.ordinate[i], calibration.model[i],
                        calibration.deviation[i], calibration.measurement_error[i], calibration.pull[i]);
  }
  return text;
}

}  // namespace

DrawnMaterials draw_fitted(const std::vector<CalibratedPair>& pairs, const CalibrationOptions& options) {
  const ErrorTier tier = value_of<ErrorTier>(options.tier).value();
  DrawnMaterials drawn;
  for (const CalibratedPair& pair : pairs) {
    if (drawn.contains(pair.material) || !has_covariance(*pair.material)) continue;
    drawn.emplace(pair.material, sample_material(pair.material->file, options.samples, options.seed, tier));
  }
  if (drawn.empty()) {
    throw InputError(
        fmt::format("--samples: {} has no table [covariance]: only fitted materials have bands (whipple fit)",
                    pairs.size() == 1 ? pairs.front().label : "none of the materials"));
  }
  return drawn;
}

std::vector<std::pair<const eos::EquationOfState*, eos::State>> states_at_rest(
    const MaterialSamples& samples) {
  std::vector<std::pair<const eos::EquationOfState*, eos::State>> states;
  for (const Material& sample : samples.materials) states.emplace_back(sample.eos.get(), sample.reference);
  return states;
}

std::string calibration_report(const std::vector<CalibratedPair>& pairs, const DrawnMaterials& drawn,
                               const CalibrationOptions& options) {
  std::vector<std::vector<std::string>> rows = {
      {"experiment", "material", "points", "half-width", "measurement", "in band"}};
  std::string remarks;
  std::set<std::string> unfitted;
  for (const double level : eos::experiments::coverage_levels)
    rows.front().push_back(fmt::format("{:g} %", 100 * level));
  std::string csv =
      "# whipple compare --samples: SI; model_error, measurement_error: one standard deviation; pull: (model "
      "- "
      "measured)/both\n"
      "experiment,material,abscissa,measured,model,model_error,measurement_error,pull\n";
  for (const CalibratedPair& pair : pairs) {
    const auto found = drawn.find(pair.material);
    std::vector<std::string> row = {pair.experiment->name, pair.label};
    if (found == drawn.end()) {
      row.resize(rows.front().size(), "-");
      rows.push_back(std::move(row));
      unfitted.insert(pair.label);
      continue;
    }
    const Calibration calibration = eos::experiments::calibrate(
        *pair.material->eos, pair.material->reference, states_at_rest(found->second), *pair.experiment);
    csv += csv_rows(pair, calibration);
    const auto percent = [](double fraction, int digits, const char* sign = " %") {
      return std::isfinite(fraction) ? fmt::format("{:.{}f}{}", 100 * fraction, digits, sign)
                                     : std::string("-");
    };
    row.push_back(fmt::format("{}", calibration.band_points));
    row.push_back(percent(calibration.median_half_width, 2));
    row.push_back(percent(calibration.median_error, 2));
    row.push_back(percent(calibration.coverage_of_band, 1));
    for (const double fraction : calibration.coverage) row.push_back(percent(fraction, 1, ""));
    rows.push_back(std::move(row));
    if (calibration.points == 0 && calibration.band_points > 0) {
      remarks += fmt::format(
          "{}: no column of errors of P or V/V0 (docs/manual/equations_of_state.md): the errors of the "
          "measurement "
          "are not known, nor whether both together hold the points\n",
          pair.experiment->name);
    } else if (calibration.points < calibration.band_points) {
      remarks += fmt::format("{}: {} points state no error and do not count for the coverage\n",
                             pair.experiment->name, calibration.band_points - calibration.points);
    }
  }
  for (const std::string& label : unfitted)
    remarks += fmt::format("{}: not a fitted material, without errors and band\n", label);
  if (!options.csv.empty()) write_output(options.csv, csv);
  std::string text = fmt::format(
      "\ncalibration with {} samples, errors of tier \"{}\": median half-width of the 95 % band and median "
      "error of the "
      "measurement (one standard deviation), both relative; points within that band alone; percent of the "
      "points within "
      "the nominal levels of both errors together\n{}{}",
      options.samples, options.tier, text_table(rows, "llr"), remarks);
  for (const auto& [material, samples] : drawn) {
    for (const std::string& remark : drawn_remarks(samples)) {
      text += fmt::format("{}: {}\n", material->file.stem().string(), remark);
    }
  }
  return text;
}

}  // namespace whipple::app
