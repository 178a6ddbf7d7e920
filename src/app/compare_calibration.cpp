// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/compare_calibration.hpp"

#include <fmt/format.h>

#include <map>
#include <utility>

#include "eos/experiments/calibration.hpp"
#include "src/app/eos_remarks.hpp"
#include "src/app/eos_table.hpp"
#include "src/core/base/csv.hpp"
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

std::string calibration_report(const std::vector<CalibratedPair>& pairs, const CalibrationOptions& options) {
  const ErrorTier tier = value_of<ErrorTier>(options.tier).value();
  std::map<const Material*, MaterialSamples> drawn;
  std::vector<std::vector<std::string>> rows = {
      {"experiment", "material", "points", "half-width", "measurement", "in band"}};
  for (const double level : eos::experiments::coverage_levels)
    rows.front().push_back(fmt::format("{:g} %", 100 * level));
  std::string csv =
      "# whipple compare --samples: SI; model_error, measurement_error: one standard deviation; pull: (model "
      "- "
      "measured)/both\n"
      "experiment,material,abscissa,measured,model,model_error,measurement_error,pull\n";
  for (const CalibratedPair& pair : pairs) {
    auto found = drawn.find(pair.material);
    if (found == drawn.end()) {
      found = drawn
                  .emplace(pair.material,
                           sample_material(pair.material->file, options.samples, options.seed, tier))
                  .first;
    }
    std::vector<std::pair<const eos::EquationOfState*, eos::State>> samples;
    for (const Material& sample : found->second.materials)
      samples.emplace_back(sample.eos.get(), sample.reference);
    const Calibration calibration =
        eos::experiments::calibrate(*pair.material->eos, pair.material->reference, samples, *pair.experiment);
    csv += csv_rows(pair, calibration);
    std::vector<std::string> row = {pair.experiment->name,
                                    pair.label,
                                    fmt::format("{}", calibration.points),
                                    fmt::format("{:.2f} %", 100 * calibration.median_half_width),
                                    fmt::format("{:.2f} %", 100 * calibration.median_error),
                                    fmt::format("{:.1f} %", 100 * calibration.coverage_of_band)};
    for (const double fraction : calibration.coverage) row.push_back(fmt::format("{:.1f}", 100 * fraction));
    rows.push_back(std::move(row));
  }
  if (!options.csv.empty()) write_output(options.csv, csv);
  std::string text = fmt::format(
      "\ncalibration with {} samples, errors of tier \"{}\": median half-width of the 95 % band and median "
      "error of the "
      "measurement (one standard deviation), both relative; points within that band alone; percent of the "
      "points within "
      "the nominal levels of both errors together\n{}",
      options.samples, options.tier, text_table(rows, "llr"));
  for (const auto& [material, samples] : drawn) {
    for (const std::string& remark : drawn_remarks(samples)) {
      text += fmt::format("{}: {}\n", material->file.stem().string(), remark);
    }
  }
  return text;
}

}  // namespace whipple::app
