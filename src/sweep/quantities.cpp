// SPDX-License-Identifier: BSD-3-Clause
#include "src/sweep/quantities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "src/analysis/measures.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/text.hpp"
#include "src/core/base/units.hpp"
#include "src/run/gauges.hpp"
#include "src/run/observers/history_columns.hpp"

namespace whipple::sweep {
namespace {

/// Lists the columns of gauges.csv of the case.
std::vector<run::GaugeColumn> columns_of_gauges(const Plan& plan) {
  std::vector<run::GaugeColumn> columns;
  for (const cases::Gauge& gauge : plan.base.all_gauges()) {
    const std::vector<run::GaugeColumn> own = run::gauge_columns(gauge);
    columns.insert(columns.end(), own.begin(), own.end());
  }
  for (const cases::ForceGauge& gauge : plan.base.force_gauges) {
    const std::vector<run::GaugeColumn> own = run::gauge_columns(gauge);
    columns.insert(columns.end(), own.begin(), own.end());
  }
  return columns;
}

/// Checks the names of the wanted results.
void check_names(const Plan& plan) {
  std::vector<std::string> history, bodies, gauges;
  for (const run::HistoryColumn& column : run::history_columns(plan.base))
    history.push_back("history." + column.name);
  for (const cases::Body& body : plan.base.bodies) bodies.push_back(body.name);
  for (const run::GaugeColumn& column : columns_of_gauges(plan)) gauges.push_back("gauge." + column.name);
  for (const Wanted& wanted : plan.study.wanted()) {
    const auto refuse = [&](const std::vector<std::string>& accepted, const char* what) {
      throw InputError(fmt::format("{}: error: '{}' is no {}{}", plan.study.file.string(), wanted.name, what,
                                   did_you_mean(wanted.name, accepted)));
    };
    if (wanted.name.starts_with("history.")) {
      if (std::ranges::count(history, wanted.name) == 0) refuse(history, "column of history.csv");
    } else if (wanted.is_column()) {
      if (std::ranges::count(gauges, wanted.name) == 0)
        refuse(gauges, "column of a gauge of the case, gauge.NAME.COLUMN");
    } else {
      std::vector<std::string> names;
      for (const analysis::Measure& measure : analysis::measures()) {
        const std::string name(measure.name);
        if (!name.ends_with(".BODY")) names.push_back(name);
        for (const std::string& body : bodies)
          if (name.ends_with(".BODY")) names.push_back(name.substr(0, name.size() - 4) + body);
      }
      if (std::ranges::count(names, wanted.name) == 0) refuse(names, "measure of whipple analyse");
    }
  }
}

/// Checks the unit of the threshold of a limit, where the unit of the quantity is known before a run.
void check_threshold(const Plan& plan) {
  if (!plan.study.find) return;
  const std::string& name = plan.study.find->quantity;
  std::optional<std::string> unit;
  for (const run::HistoryColumn& column : run::history_columns(plan.base))
    if ("history." + column.name == name) unit = column.unit;
  for (const run::GaugeColumn& column : columns_of_gauges(plan))
    if ("gauge." + column.name == name) unit = column.unit;
  for (const analysis::Measure& measure : analysis::measures()) {
    const std::string known(measure.name);
    const bool of_body = known.ends_with(".BODY") && name.starts_with(known.substr(0, known.size() - 4));
    if (known == name || of_body) unit = measure.unit;
  }
  if (!unit) return;
  try {
    static_cast<void>(units::parse_quantity(plan.study.find->crosses, *unit == "1" ? "" : *unit));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: error: 'find.crosses': {}", plan.study.file.string(), error.what()));
  }
}

}  // namespace

void check_quantities(const Plan& plan) {
  check_names(plan);
  check_threshold(plan);
}

}  // namespace whipple::sweep
