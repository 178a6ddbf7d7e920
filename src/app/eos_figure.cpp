// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/eos_figure.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "src/app/compare_data.hpp"
#include "src/core/base/error.hpp"
#include "src/core/process/scripts.hpp"

namespace whipple::app {
namespace {

nlohmann::json numbers(const std::vector<double>& values) {
  nlohmann::json list = nlohmann::json::array();
  for (const double value : values) {
    list.push_back(std::isfinite(value) ? nlohmann::json(value) : nlohmann::json());  // JSON has no NaN
  }
  return list;
}

nlohmann::json lines(const std::vector<FigureCurve>& curves) {
  nlohmann::json list = nlohmann::json::array();
  for (const FigureCurve& curve : curves) {
    list.push_back({{"label", curve.label},
                    {"material", curve.material},
                    {"x", numbers(curve.x)},
                    {"y", numbers(curve.y)},
                    {"colour", curve.colour},
                    {"style", curve.style}});
  }
  return list;
}

std::string axis_label(const Column& column) {
  const std::string& name = column.meaning.empty() ? column.name : column.meaning;
  return column.unit.empty() ? name : fmt::format("{} ({})", name, column.unit);
}

}  // namespace

void add_measurements(Figure& figure, const std::vector<std::string>& experiments) {
  for (const std::string& name : experiments) {
    const std::filesystem::path file = find_experiment(name);
    FigureCurve curve;
    curve.label = file.stem().string();
    curve.x = measured_quantity(file, figure.x.name);
    curve.y = measured_quantity(file, figure.y.name);
    for (double& value : curve.x) value /= figure.x.size;
    for (double& value : curve.y) value /= figure.y.size;
    figure.points.push_back(std::move(curve));
  }
}

void draw(const Figure& figure, const std::filesystem::path& path) {
  const nlohmann::json description = {
      {"title", figure.title},
      {"x", {{"label", axis_label(figure.x)}, {"logarithmic", figure.logarithmic_x}}},
      {"y", {{"label", axis_label(figure.y)}, {"logarithmic", figure.logarithmic_y}}},
      {"curves", lines(figure.curves)},
      {"points", lines(figure.points)}};
  process::draw_json("scripts/plot_curves.py", description.dump(1), path);
  fmt::print("written: {}\n", path.string());
}

}  // namespace whipple::app
