// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/fit_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "md_fitting/fit/element_defaults.hpp"
#include "src/base/text_table.hpp"

namespace whipple::fit {
namespace {

struct Column {
  std::string title, unit;
  std::string name;  ///< of the constant
  double size;       ///< of the printed unit in SI
  int decimals;
};

const std::vector<Column>& columns() {
  static const std::vector<Column> list = {{"V0", "cm3/g", "reference_specific_volume", 1e-3, 5},
                                           {"C", "km/s", "hugoniot_intercept", 1e3, 3},
                                           {"S", "", "hugoniot_slope", 1.0, 3},
                                           {"gamma0", "", "gruneisen", 1.0, 3},
                                           {"a", "", "gruneisen_slope", 1.0, 2},
                                           {"g", "1e-7 kJ/(mol K2)", "anharmonic_heat_coefficient", 1e-4, 2},
                                           {"T_m0", "K", "melting_temperature", 1.0, 0}};
  return list;
}

using Row = std::vector<std::string>;

std::string cell(const Constant& constant, const Column& column) {
  const double value = constant.value / column.size;
  switch (constant.origin) {
    case Origin::fitted:
      return fmt::format("{:.{}f} +- {:.{}f} ({:.{}f})", value, column.decimals, constant.error / column.size,
                         column.decimals, constant.statistical_error / column.size, column.decimals);
    case Origin::given:
      return fmt::format("{:.{}f} (given)", value, column.decimals);
    case Origin::by_default:
      return fmt::format("{:.{}f} (default)", value, column.decimals);
  }
  return {};
}

Row published_cells(const PublishedRow& row) {
  const double values[] = {row.specific_volume, row.hugoniot_intercept, row.hugoniot_slope,     row.gruneisen,
                           row.gruneisen_slope, row.heat_coefficient,   row.melting_temperature};
  Row cells = {std::string(row.name)};
  for (std::size_t i = 0; i < columns().size(); ++i) {
    cells.push_back(fmt::format("{:.{}f}", values[i] / columns()[i].size, columns()[i].decimals));
  }
  return cells;
}

}  // namespace

std::string constants_table(std::span<const NamedFit> fits) {
  Row titles = {""};
  Row units = {""};
  for (const Column& column : columns()) {
    titles.push_back(column.title);
    units.push_back(column.unit);
  }
  std::vector<Row> rows = {titles, units};
  std::set<std::string, std::less<>> elements;
  for (const NamedFit& fit : fits) {
    Row row = {fit.name};
    for (const Column& column : columns()) row.push_back(cell(fit.fit.constant(column.name), column));
    rows.push_back(row);
    elements.insert(fit.fit.element);
  }
  bool published = false;
  for (const PublishedRow& row : published_rows()) {
    if (!elements.contains(row.element)) continue;
    rows.push_back(published_cells(row));
    published = true;
  }
  std::string text = text_table(rows, "lr");
  text += "errors: one standard deviation from noise and model error, in brackets from the noise alone\n";
  text += "g: fitted rows the anharmonic coefficient of classical nuclei";
  if (published) {
    text +=
        fmt::format("; published rows the sum with the electrons\npublished rows: {}", published_rows_source);
  }
  return text + "\n";
}

std::string fit_details(const GrayFit& fit) {
  std::string text;
  text += fmt::format("potential {}; chi^2 = {:.1f} for {} degrees of freedom: {:.2f}\n", fit.potential,
                      fit.chi_squared, fit.degrees_of_freedom, fit.chi_squared / fit.degrees_of_freedom);
  for (const ChiSquaredPart& part : fit.chi_squared_parts) {
    text += fmt::format("  {}: {:.1f} from {} data\n", part.quantity, part.chi_squared, part.data);
  }
  if (fit.superheated_states > 0) {
    text += fmt::format("  {} isochore states above T_m(V) left out (superheated solid)\n",
                        fit.superheated_states);
  }

  text += "\ncorrelations\n";
  const Eigen::MatrixXd correlation = fit.correlation();
  std::vector<Row> rows;
  for (Eigen::Index i = 0; i < correlation.rows(); ++i) {
    Row row = {"  " + fit.fitted_names[static_cast<std::size_t>(i)]};
    for (Eigen::Index k = 0; k <= i; ++k) row.push_back(fmt::format("{:.2f}", correlation(i, k)));
    rows.push_back(row);
  }
  text += text_table(rows, "lr");

  text += "\nwindow of particle velocities (km/s), states, C (km/s), S: the first is the fit's own\n";
  for (const WindowResult& window : fit.windows) {
    text += fmt::format("  {:.2f} ... {:.2f}  {:3d}  {:.3f}  {:.3f}\n", window.least * 1e-3,
                        window.most * 1e-3, window.states, window.intercept * 1e-3, window.slope);
  }
  const auto [least_c, most_c] =
      std::minmax_element(fit.windows.begin(), fit.windows.end(),
                          [](const auto& a, const auto& b) { return a.intercept < b.intercept; });
  const auto [least_s, most_s] = std::minmax_element(
      fit.windows.begin(), fit.windows.end(), [](const auto& a, const auto& b) { return a.slope < b.slope; });
  text += fmt::format("  over the windows: C {:.3f} ... {:.3f} km/s, S {:.3f} ... {:.3f}\n",
                      least_c->intercept * 1e-3, most_c->intercept * 1e-3, least_s->slope, most_s->slope);

  text += "\ngamma of each isochore (slope of P against E; noise only) beside the fitted line\n";
  for (const IsochoreGruneisen& isochore : fit.isochores) {
    const double ratio = isochore.volume / fit.fitted_reference_volume;
    text +=
        fmt::format("  V/V0 = {:.4f}  {:.3f} +- {:.3f}  line {:.3f}  {} states\n", ratio, isochore.gruneisen,
                    isochore.error, fit.value("gruneisen") - fit.value("gruneisen_slope") * (1.0 - ratio),
                    isochore.states);
  }
  if (fit.isochoric_melting_temperature) {
    text += fmt::format(
        "\nmelting: the solid of volume V0 coexists with liquid at {:.0f} K; T_m0 of melting = \"{}\" is "
        "{:.0f} K\n",
        *fit.isochoric_melting_temperature, fit.settings.melting, fit.value("melting_temperature"));
  }

  text += "\nnot from the simulations\n";
  for (const Constant& constant : fit.constants) {
    if (constant.origin == Origin::fitted) continue;
    text +=
        fmt::format("  {} = {}  {} {}\n", constant.name, practical_quantity(constant.value, constant.unit),
                    constant.origin == Origin::given ? "given:" : "default", constant.source);
  }
  text += "\ncomplete model of the material less simulations: points, rms, mean, largest\n";
  for (const ModelCheck& check : fit.checks) {
    text += fmt::format("  {}: {}, {:.3g}, {:+.3g}, {:+.3g} {}\n", check.quantity, check.points, check.rms,
                        check.mean, check.maximum, check.unit);
  }
  return text;
}

std::string plot_data(const NamedFit& named) {
  const GrayFit& fit = named.fit;
  nlohmann::json data;
  data["title"] = named.name;
  data["reference_volume"] = fit.fitted_reference_volume;
  for (const Constant& constant : fit.constants) {
    data["constants"][constant.name] = {{"value", constant.value}, {"error", constant.error}};
  }
  for (const Residual& row : fit.residuals) {
    data["residuals"].push_back({{"quantity", row.quantity},
                                 {"volume", row.volume},
                                 {"temperature", row.temperature},
                                 {"abscissa", row.abscissa},
                                 {"datum", row.datum},
                                 {"fitted", row.fitted},
                                 {"sigma", row.sigma}});
  }
  for (const IsochoreGruneisen& isochore : fit.isochores) {
    data["isochores"].push_back(
        {{"volume", isochore.volume}, {"gruneisen", isochore.gruneisen}, {"error", isochore.error}});
  }
  return data.dump(1);
}

}  // namespace whipple::fit
