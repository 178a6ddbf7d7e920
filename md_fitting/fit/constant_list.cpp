// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/constant_list.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "md_fitting/fit/table_access.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/units.hpp"

namespace whipple::fit {
namespace {

std::string practical_unit(const std::string& si_unit) {
  static const std::map<std::string, std::string, std::less<>> units = {
      {"kg/mol", "g/mol"},        {"m^3/kg", "cm^3/g"},          {"m/s", "km/s"},
      {"J/kg", "kJ/g"},           {"J m^3/kg^2", "kJ cm^3/g^2"}, {"J/(mol K^2)", "mJ/(mol K^2)"},
      {"J/(mol K)", "J/(mol K)"}, {"kg/m^3", "g/cm^3"},          {"Pa", "GPa"}};
  const auto found = units.find(si_unit);
  return found == units.end() ? si_unit : found->second;
}

}  // namespace

std::string Sources::named(const NamedDefault& entry) {
  return fmt::format("\"{}\": {}", entry.name, entry.source);
}

std::string practical_quantity(double value, const std::string& si_unit, int digits) {
  const std::string unit = practical_unit(si_unit);
  const std::string number = fmt::format("{:.{}g}", units::convert(value, si_unit, unit), digits);
  return unit.empty() || unit == "1" ? number : fmt::format("{} {}", number, unit);
}

double as_written(double value, const std::string& si_unit) {
  return units::parse_quantity(practical_quantity(value, si_unit), si_unit);
}

double electronic_coefficient(const ElementDefaults& table, const std::optional<std::string>& choice,
                              Sources& sources) {
  std::vector<std::string> names;
  if (!choice) {
    const NamedDefault& entry = table.at("electronic_heat_coefficient");
    sources.by_default(entry);
    return entry.value;
  }
  for (const NamedDefault* entry : table.choices("electronic_heat_coefficient")) {
    if (entry->name == *choice) {
      sources.by_default(*entry);
      return entry->value;
    }
    names.push_back(entry->name);
  }
  try {
    const double value = units::parse_quantity(*choice, "J/(mol K^2)");
    sources.given("electronic_heat_coefficient", "command line");
    if (value >= 0.0) return value;
  } catch (const InputError&) {
    // Reported below, with the names.
  }
  throw InputError(
      fmt::format("electronic heat coefficient '{}': expected {}a quantity >= 0 such as "
                  "\"0.69 mJ/(mol K^2)\"",
                  *choice, names.empty() ? "" : fmt::format("{} or ", fmt::join(names, ", "))));
}

void list_constants(Fit& fit, const std::vector<BoundParameter>& table, const Sources& sources) {
  for (const BoundParameter& parameter : table) {
    if (const ChoiceTarget* choice = std::get_if<ChoiceTarget>(&parameter.target)) {
      fit.words.emplace_back(parameter.info.name, choice->word(choice->value));
      continue;
    }
    double* value = number_behind(parameter);
    if (value == nullptr || !std::isfinite(*value)) continue;  // "same as the solid", not given
    *value = as_written(*value, parameter.info.unit);
    Constant constant;
    constant.name = parameter.info.name;
    constant.unit = parameter.info.unit;
    constant.meaning = parameter.info.meaning;
    constant.value = *value;
    const auto place = std::find(fit.fitted_names.begin(), fit.fitted_names.end(), constant.name);
    if (place != fit.fitted_names.end()) {
      const Eigen::Index row = place - fit.fitted_names.begin();
      constant.origin = Origin::fitted;
      constant.error = std::sqrt(fit.covariance(row, row));
      constant.statistical_error = std::sqrt(fit.statistical_covariance(row, row));
    } else {
      const auto source = sources.entries.find(constant.name);
      if (source == sources.entries.end()) {
        throw InternalError(fmt::format("the fit has no source for the constant '{}'", constant.name));
      }
      constant.origin = source->second.origin;
      constant.source = source->second.text;
      constant.evidence = source->second.evidence;
      constant.error = source->second.error;
      constant.error_source = source->second.error_source;
    }
    fit.constants.push_back(constant);
  }
}

const Constant& Fit::constant(std::string_view name) const {
  const auto found = std::find_if(constants.begin(), constants.end(),
                                  [&](const Constant& entry) { return entry.name == name; });
  if (found == constants.end()) throw InternalError(fmt::format("the fit has no constant '{}'", name));
  return *found;
}

Eigen::MatrixXd Fit::correlation() const {
  const Eigen::VectorXd inverse = covariance.diagonal().cwiseSqrt().cwiseInverse();
  return inverse.asDiagonal() * covariance * inverse.asDiagonal();
}

}  // namespace whipple::fit
