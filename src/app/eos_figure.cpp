// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/eos_figure.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "eos/experiments/experiment.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/json.hpp"
#include "src/core/base/log.hpp"
#include "src/core/process/paths.hpp"
#include "src/core/process/scripts.hpp"

namespace whipple::app {
namespace {

using eos::curves::Column;
using eos::curves::Figure;
using eos::curves::FigureCurve;
using eos::curves::LineStyle;

nlohmann::json numbers(const std::vector<double>& values) {
  nlohmann::json list = nlohmann::json::array();
  for (const double value : values) {
    list.push_back(std::isfinite(value) ? nlohmann::json(value) : nlohmann::json());  // JSON has no NaN
  }
  return list;
}

/// Returns the name of a line style in scripts/plot_curves.py.
const char* word_of(LineStyle style) {
  switch (style) {
    case LineStyle::solid:
      return "solid";
    case LineStyle::dashed:
      return "dashed";
    case LineStyle::dotted:
      return "dotted";
    case LineStyle::dashdot:
      return "dashdot";
    case LineStyle::thin:
      return "thin";
    case LineStyle::marks:
      return "marks";
  }
  throw InternalError("unknown style of a line");
}

nlohmann::json lines(const std::vector<FigureCurve>& curves) {
  nlohmann::json list = nlohmann::json::array();
  for (const FigureCurve& curve : curves) {
    list.push_back({{"label", curve.label},
                    {"material", curve.material},
                    {"x", numbers(curve.x)},
                    {"y", numbers(curve.y)},
                    {"colour", curve.colour},
                    {"style", word_of(curve.style)}});
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
    const std::filesystem::path file = process::find_experiment(name);
    FigureCurve curve;
    curve.label = file.stem().string();
    curve.x = eos::experiments::measured_quantity(file, figure.x.name);
    curve.y = eos::experiments::measured_quantity(file, figure.y.name);
    for (double& value : curve.x) value /= figure.x.size;
    for (double& value : curve.y) value /= figure.y.size;
    figure.points.push_back(std::move(curve));
  }
}

void draw(const Figure& figure, const std::filesystem::path& path) {
  nlohmann::json bands = nlohmann::json::array();
  for (const eos::curves::FigureBand& band : figure.bands) {
    bands.push_back({{"label", band.label},
                     {"x", numbers(band.x)},
                     {"lower", numbers(band.lower)},
                     {"upper", numbers(band.upper)},
                     {"colour", band.colour}});
  }
  const nlohmann::json description = {
      {"title", figure.title},
      {"x", {{"label", axis_label(figure.x)}, {"logarithmic", figure.logarithmic_x}}},
      {"y", {{"label", axis_label(figure.y)}, {"logarithmic", figure.logarithmic_y}}},
      {"curves", lines(figure.curves)},
      {"points", lines(figure.points)},
      {"bands", bands}};
  // File names need not be UTF-8.
  process::draw_json("scripts/plot_curves.py", json_text(description, 1), path);
  log::info("written: {}", path.string());
}

}  // namespace whipple::app
