// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/joint/joint_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "src/core/base/text.hpp"
#include "src/core/base/text_table.hpp"

namespace whipple::fit {
namespace {

using Row = std::vector<std::string>;

std::string percent(double fraction, int digits = 2) {
  return fmt::format("{:.{}f} %", 100 * fraction, digits);
}

}  // namespace

std::string joint_text(const JointResult& joint) {
  std::string text = fmt::format(
      "\nfit to simulations and measurements together: chi^2 = {:.1f} for {} degrees of freedom\n"
      "measured curves: material less measurement; the last column is the residual over the errors of "
      "measurement and form\n",
      joint.chi_squared, joint.degrees_of_freedom);
  std::vector<Row> rows = {{"  curve", "kind", "points", "rms", "mean", "rms/error"}};
  for (const CurveResult& curve : joint.curves) {
    rows.push_back({"  " + curve.name, curve.kind, fmt::format("{}", curve.points), percent(curve.rms),
                    fmt::format("{:+.2f} %", 100 * curve.mean), fmt::format("{:.2f}", curve.rms_of_errors)});
  }
  text += text_table(rows, "llr");
  for (const CurveResult& curve : joint.curves) {
    if (curve.out_of_range > 0)
      text += fmt::format("  {}: {} points outside the range of the model left out\n", curve.name,
                          curve.out_of_range);
  }
  if (joint.coverage.empty()) {
    text += "one curve alone is not predicted by others: name two or more to have the coverage\n";
  } else {
    text +=
        "each curve left out and predicted from the rest, and curves that took no part: fraction of its "
        "points within 68 and 95 % "
        "(constants, "
        "form and measurement), half-width of the 95 % band of the constants, the same with the form's "
        "error\n";
    rows = {{"  curve", "points", "68 %", "95 %", "half-width", "with form", "rms"}};
    for (const CurveCoverage& curve : joint.coverage) {
      if (!curve.determined()) {
        rows.push_back(
            {"  " + curve.name, fmt::format("{}", curve.points), "not", "determined", "by the rest"});
        continue;
      }
      rows.push_back({"  " + curve.name + (curve.left_out ? "" : " (check)"), fmt::format("{}", curve.points),
                      percent(curve.inside_68, 0), percent(curve.inside_95, 0), percent(curve.half_width),
                      percent(curve.form_width), percent(curve.rms)});
    }
    text += text_table(rows, "lr");
  }
  text += "sizes of the deviations found, in units of the stated ones\n";
  for (const DeviationSize& size : joint.sizes) text += fmt::format("  {}: {:.2f}\n", size.name, size.factor);
  text += "constants without one kind of data: value +- error (- where nothing else determines it)\n";
  rows = {{"  without"}};
  for (const std::string& name : joint.names) rows.front().push_back(name);
  const auto add = [&](const std::string& name, const Eigen::VectorXd& values,
                       const Eigen::VectorXd& errors) {
    Row row = {"  " + name};
    for (Eigen::Index k = 0; k < values.size(); ++k) {
      const bool determined = errors[k] < 3.0 * std::abs(values[k]);
      row.push_back(determined ? fmt::format("{:.4g} +- {:.2g}", values[k], errors[k]) : "-");
    }
    rows.push_back(row);
  };
  add("nothing", joint.values, joint.errors);
  for (const WithoutKind& without : joint.without) add(without.kind, without.values, without.errors);
  return text + text_table(rows, "lr");
}

std::string coverage_tables(const JointResult& joint) {
  std::string text;
  for (const CurveCoverage& curve : joint.coverage) {
    if (!curve.determined()) continue;
    text += fmt::format(
        "\n[[coverage]]  # predicted by a fit without this curve (docs/theory/fit.md, section 9)\n"
        "curve = {}\nkind = {}\npoints = {}\ninside_68 = {:.3f}\ninside_95 = {:.3f}\nhalf_width = {:.5f}  # "
        "of "
        "the 95 % band of the constants, relative\nhalf_width_with_form = {:.5f}\nrms = {:.5f}\n",
        toml_string(curve.name), toml_string(curve.kind), curve.points, curve.inside_68, curve.inside_95,
        curve.half_width, curve.form_width, curve.rms);
  }
  return text;
}

}  // namespace whipple::fit
