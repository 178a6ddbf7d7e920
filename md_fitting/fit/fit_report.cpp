// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/fit_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "md_fitting/fit/constant_list.hpp"
#include "md_fitting/fit/identifiability.hpp"
#include "md_fitting/fit/joint/joint_report.hpp"
#include "md_fitting/fit/published_rows.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/json.hpp"
#include "src/core/base/text_table.hpp"

namespace whipple::fit {
namespace {

struct Column {
  std::string title, unit;
  std::string name;  ///< name of the constant
  double size;       ///< printed unit in SI
  int decimals;
};

const std::vector<Column>& columns(FitModel model) {
  static const std::vector<Column> gray = {{"V0", "cm3/g", "reference_specific_volume", 1e-3, 5},
                                           {"C", "km/s", "hugoniot_intercept", 1e3, 3},
                                           {"S", "", "hugoniot_slope", 1.0, 3},
                                           {"gamma0", "", "gruneisen", 1.0, 3},
                                           {"a", "", "gruneisen_slope", 1.0, 2},
                                           {"g", "1e-7 kJ/(mol K2)", "anharmonic_heat_coefficient", 1e-4, 2},
                                           {"T_m0", "K", "melting_temperature", 1.0, 0},
                                           {"dS", "J/(mol K)", "melting_entropy", 1.0, 2}};
  static const std::vector<Column> mie_gruneisen = {{"rho0", "g/cm3", "reference_density", 1e3, 4},
                                                    {"c0", "km/s", "hugoniot_intercept", 1e3, 3},
                                                    {"s", "", "hugoniot_slope", 1.0, 3},
                                                    {"Gamma0", "", "gruneisen", 1.0, 3},
                                                    {"b", "", "gruneisen_slope", 1.0, 2},
                                                    {"c_v", "J/(kg K)", "heat_capacity", 1.0, 1}};
  static const std::vector<Column> debye = {
      {"rho0", "g/cm3", "reference_density", 1e3, 4}, {"K0", "GPa", "bulk_modulus", 1e9, 1},
      {"K0'", "", "bulk_modulus_slope", 1.0, 2},      {"gamma0", "", "gruneisen", 1.0, 3},
      {"a", "", "gruneisen_slope", 1.0, 2},           {"theta0", "K", "debye_temperature", 1.0, 0},
      {"T_m0", "K", "melting_temperature", 1.0, 0}};
  switch (model) {
    case FitModel::gray:
      return gray;
    case FitModel::mie_gruneisen:
      return mie_gruneisen;
    case FitModel::debye_gruneisen:
      return debye;
  }
  throw InternalError("unknown model of a fit");
}

using Row = std::vector<std::string>;

/// Returns the word for the origin of a constant.
const char* source_word(const Constant& constant, bool joint) {
  switch (constant.origin) {
    case Origin::fitted:
      return joint ? "MD and measured" : "MD";
    case Origin::given:
      return constant.evidence == Evidence::measured ? "measured" : "given";
    case Origin::by_default:
      return constant.evidence == Evidence::measured ? "measured (default)" : "default";
  }
  throw InternalError("unknown origin of a constant");
}

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
  for (std::size_t i = 0; i < std::size(values); ++i) {
    cells.push_back(fmt::format("{:.{}f}", values[i] / columns(FitModel::gray)[i].size,
                                columns(FitModel::gray)[i].decimals));
  }
  cells.emplace_back();
  return cells;
}

std::string left_out_text(const Fit& fit) {
  std::string text =
      "\neach datum omitted in turn and predicted from the others: data, rms of (datum - prediction)/error, "
      "largest; "
      "the largest shift of a constant in its errors\n";
  for (const LeaveOneOut& part : fit.left_out) {
    if (part.data == 0) {
      text += fmt::format("  {}: the others do not predict it\n", part.quantity);
      continue;
    }
    text += fmt::format("  {}: {}, {:.2f}, {:.2f} ({}); {} by {:.2f} without {}\n", part.quantity, part.data,
                        part.rms, part.largest, part.worst, fit.left_out_names[part.constant], part.shift,
                        part.mover);
  }
  return text;
}

std::string bootstrap_text(const Fit& fit) {
  const BootstrapResult& result = *fit.bootstrap;
  std::string text = fmt::format(
      "\nbootstrap over blocks: {} replicates ({} could not be fitted); {} points drawn from their blocks, "
      "{} from "
      "their stated errors\n  constant: error over replicates, error from the noise, their ratio\n",
      result.replicates, result.failed, result.points_with_blocks, result.points_without);
  for (std::size_t k = 0; k < fit.left_out_names.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    const double scatter = std::sqrt(result.covariance(row, row));
    const auto place = std::find(fit.fitted_names.begin(), fit.fitted_names.end(), fit.left_out_names[k]);
    if (place == fit.fitted_names.end()) continue;
    const Eigen::Index own = place - fit.fitted_names.begin();
    const double noise = std::sqrt(fit.statistical_covariance(own, own));
    text += fmt::format("  {}: {:.3g}, {:.3g}, {:.2f}\n", *place, scatter, noise, scatter / noise);
  }
  return text;
}

std::string unknown_to_classical_nuclei(const Fit& fit) {
  std::string text =
      "\neffects that classical nuclei do not include: electrons (heat, pressure), zero-point motion, and "
      "the fall of "
      "the heat "
      "capacity below the Debye temperature\n";
  const auto find = [&](const char* name) {
    const auto found = std::find_if(fit.constants.begin(), fit.constants.end(),
                                    [&](const Constant& constant) { return constant.name == name; });
    return found == fit.constants.end() ? nullptr : &*found;
  };
  const Constant* const electrons = find("electronic_heat_coefficient");
  const Constant* const nuclei = find("anharmonic_heat_coefficient");
  if (nuclei != nullptr && electrons != nullptr) {
    text += fmt::format(
        "  g_anh = {:.3g} +- {:.2g} mJ/(mol K^2), the anharmonic energy of the nuclei, is all that the "
        "simulations "
        "bear of g_e\n  g_el = {:.3g} mJ/(mol K^2): {}\n  g_e of the material = g_anh + g_el = {:.3g} "
        "mJ/(mol K^2)\n",
        1e3 * nuclei->value, 1e3 * nuclei->error, 1e3 * electrons->value, electrons->source,
        1e3 * (nuclei->value + electrons->value));
  } else if (electrons != nullptr) {
    text += fmt::format("  g_el = {:.3g} mJ/(mol K^2): {}\n", 1e3 * electrons->value, electrons->source);
  }
  return text;
}

/// Formats the isotherms of classical and quantum nuclei, if the database has points of the protocol "quantum".
std::string nuclei_text(const Fit& fit) {
  const NucleiComparison& nuclei = fit.nuclei;
  if (nuclei.isotherm.empty()) return {};
  std::string text = fmt::format(
      "\nisotherm at {} K of classical and of quantum nuclei (points of the protocol \"quantum\"; the fitted "
      "constants {}): V (cm3/g), P classical, P quantum, difference (GPa)\n",
      fit.settings.reference_temperature,
      nuclei.contained ? "contain the difference" : "are those of classical nuclei");
  for (const NucleiPressures& row : nuclei.isotherm) {
    text += fmt::format("  {:.5f}  {:8.3f}  {:8.3f}  {:+.3f}\n", 1e3 * row.volume, 1e-9 * row.classical,
                        1e-9 * (row.classical + row.addition), 1e-9 * row.addition);
  }
  return text + fmt::format("  the volume at zero pressure {} {:.3f} % with quantum nuclei\n",
                            nuclei.expansion < 0.0 ? "shrinks by" : "grows by",
                            100.0 * std::abs(nuclei.expansion));
}

std::string windows_text(const Fit& fit) {
  std::string text =
      "\nwindow of particle velocities (km/s), states, weight in the mean, C (km/s), S: the first is the "
      "fit's own\n";
  for (const WindowResult& window : fit.windows) {
    text +=
        fmt::format("  {:.2f} ... {:.2f}  {:3d}  {:.2f}  {:.3f}  {:.3f}\n", window.least * 1e-3,
                    window.most * 1e-3, window.states, window.weight, window.intercept * 1e-3, window.slope);
  }
  const auto [least_c, most_c] =
      std::minmax_element(fit.windows.begin(), fit.windows.end(),
                          [](const auto& a, const auto& b) { return a.intercept < b.intercept; });
  const auto [least_s, most_s] = std::minmax_element(
      fit.windows.begin(), fit.windows.end(), [](const auto& a, const auto& b) { return a.slope < b.slope; });
  return text + fmt::format("  over the windows: C {:.3f} ... {:.3f} km/s, S {:.3f} ... {:.3f}\n",
                            least_c->intercept * 1e-3, most_c->intercept * 1e-3, least_s->slope,
                            most_s->slope);
}

}  // namespace

std::string constants_table(std::span<const NamedFit> fits) {
  const FitModel model = fits.front().fit.model;
  Row titles = {""};
  Row units = {""};
  for (const Column& column : columns(model)) {
    titles.push_back(column.title);
    units.push_back(column.unit);
  }
  std::vector<Row> rows = {titles, units};
  std::set<std::string, std::less<>> elements;
  for (const NamedFit& fit : fits) {
    Row row = {fit.name};
    for (const Column& column : columns(model)) row.push_back(cell(fit.fit.constant(column.name), column));
    rows.push_back(row);
    elements.insert(fit.fit.element);
  }
  std::string sources;
  for (const PublishedRow& row : published_rows()) {
    if (model != FitModel::gray || !elements.contains(row.element)) continue;
    rows.push_back(published_cells(row));
    if (sources.find(row.source) == std::string::npos) {
      sources += fmt::format("{}{}", sources.empty() ? "" : "; ", row.source);
    }
  }
  std::string text = text_table(rows, "lr");
  text +=
      "errors: one standard deviation from noise, model error and windows, in brackets from the noise "
      "alone\n";
  if (model == FitModel::gray) text += "g: fitted rows the anharmonic coefficient of classical nuclei";
  if (!sources.empty()) {
    text += fmt::format("; published rows that of the electrons, or the sum\npublished rows: {}", sources);
  }
  return model == FitModel::gray ? text + "\n" : text;
}

std::string sources_table(const Fit& fit) {
  std::vector<Row> rows = {{"constant", "value", "error", "source"}};
  for (const Constant& constant : fit.constants) {
    std::string error = "no error known";
    if (constant.error > 0.0) {
      error = practical_quantity(constant.error, constant.unit, 2);
    } else if (constant.origin == Origin::given) {
      error = "-";
    }
    rows.push_back({constant.name, practical_quantity(constant.value, constant.unit, 6), error,
                    source_word(constant, fit.joint.has_value())});
  }
  return text_table(rows, "lrrl");
}

std::string fit_details(const Fit& fit) {
  std::string text;
  text += fmt::format("model {}; potential {}; chi^2 = {:.1f} for {} degrees of freedom: {:.2f}\n",
                      name_of(fit.model), fit.potential, fit.chi_squared, fit.degrees_of_freedom,
                      fit.chi_squared / fit.degrees_of_freedom);
  for (const ChiSquaredPart& part : fit.chi_squared_parts) {
    text += fmt::format("  {}: {:.1f} from {} data, model error times {:.2f}\n", part.quantity,
                        part.chi_squared, part.data, part.inflation);
  }
  if (fit.superheated_states > 0) {
    text += fmt::format("  {} isochore states above T_m(V) left out (superheated solid)\n",
                        fit.superheated_states);
  }
  for (const std::string& remark : fit.remarks) text += fmt::format("  {}\n", remark);

  text += "\ncorrelations\n";
  const Eigen::MatrixXd correlation = fit.correlation();
  std::vector<Row> rows;
  for (Eigen::Index i = 0; i < correlation.rows(); ++i) {
    Row row = {"  " + fit.fitted_names[static_cast<std::size_t>(i)]};
    for (Eigen::Index k = 0; k <= i; ++k) row.push_back(fmt::format("{:.2f}", correlation(i, k)));
    rows.push_back(row);
  }
  text += text_table(rows, "lr");
  text += identifiability_text(fit);

  text += left_out_text(fit);
  if (fit.bootstrap) text += bootstrap_text(fit);
  if (!fit.windows.empty()) text += windows_text(fit);

  text += "\ngamma of each isochore (slope of P against E; noise only), compared with the fitted line\n";
  for (const IsochoreGruneisen& isochore : fit.isochores) {
    const double ratio = isochore.volume / fit.fitted_reference_volume;
    text +=
        fmt::format("  V/V0 = {:.4f}  {:.3f} +- {:.3f}  line {:.3f}  {} states\n", ratio, isochore.gruneisen,
                    isochore.error, fit.gruneisen - fit.gruneisen_slope * (1.0 - ratio), isochore.states);
  }
  if (fit.isochoric_melting_temperature && fit.model == FitModel::gray) {
    text += fmt::format(
        "\nmelting: the solid of volume V0 coexists with liquid at {:.0f} K; T_m0 of melting = \"{}\" is "
        "{:.0f} K\n",
        *fit.isochoric_melting_temperature, word_of(fit.settings.melting), fit.value("melting_temperature"));
  }

  if (fit.joint) text += joint_text(*fit.joint);
  if (fit.correction) text += "\n" + correction_text(*fit.correction);
  text += unknown_to_classical_nuclei(fit);
  text += nuclei_text(fit);
  text += "\nnot from the simulations\n";
  for (const Constant& constant : fit.constants) {
    if (constant.origin == Origin::fitted) continue;
    text +=
        fmt::format("  {} = {}  {} {}\n", constant.name, practical_quantity(constant.value, constant.unit),
                    constant.origin == Origin::given ? "given:" : "default", constant.source);
    if (constant.error > 0.0) {
      text += fmt::format("    +- {}: {}\n", practical_quantity(constant.error, constant.unit, 2),
                          constant.error_source);
    }
  }
  text += "\ncomplete model of the material less simulations: points, rms, mean, largest\n";
  for (const ModelCheck& check : fit.checks) {
    text += fmt::format("  {}: {}, {:.3g}, {:+.3g}, {:+.3g} {}\n", check.quantity, check.points, check.rms,
                        check.mean, check.maximum, check.unit);
  }
  return text;
}

std::string plot_data(const NamedFit& named) {
  const Fit& fit = named.fit;
  nlohmann::json data;
  data["title"] = named.name;
  data["model"] = name_of(fit.model);
  data["reference_volume"] = fit.fitted_reference_volume;
  data["molar_mass"] = fit.molar_mass;
  data["gruneisen"] = {fit.gruneisen, fit.gruneisen_slope};
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
  if (fit.correction) {
    for (const CorrectionRow& row : fit.correction->rows) {
      data["correction"].push_back({{"kind", row.kind},
                                    {"volume", row.volume},
                                    {"temperature", row.temperature},
                                    {"gray", row.gray},
                                    {"corrected", row.corrected},
                                    {"error", row.error}});
    }
    for (const LeftOutCurves& kind : fit.correction->left_out) {
      data["correction_left_out"].push_back({{"kind", kind.kind},
                                             {"data", kind.data},
                                             {"curves", kind.curves},
                                             {"inside_68", kind.inside_68},
                                             {"inside_95", kind.inside_95},
                                             {"half_width", kind.half_width},
                                             {"rms", kind.rms}});
    }
  }
  for (const IsochoreGruneisen& isochore : fit.isochores) {
    data["isochores"].push_back(
        {{"volume", isochore.volume}, {"gruneisen", isochore.gruneisen}, {"error", isochore.error}});
  }
  return json_text(data, 1);
}

}  // namespace whipple::fit
