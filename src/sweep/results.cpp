// SPDX-License-Identifier: BSD-3-Clause
#include "src/sweep/results.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <tuple>

#include "src/analysis/measures.hpp"
#include "src/analysis/table.hpp"
#include "src/core/base/csv.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/units.hpp"
#include "src/sweep/sampling.hpp"

namespace whipple::sweep {
namespace {

namespace fs = std::filesystem;

double number(const std::string& cell, const fs::path& file) {
  double value = 0.0;
  const auto [end, fault] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (fault != std::errc() || end != cell.data() + cell.size())
    throw InputError(fmt::format("{}: error: \"{}\" is no number", file.string(), cell));
  return value;
}

/// Holds a table in time: history.csv or gauges.csv.
struct TimeTable {
  std::vector<std::string> names, units;
  std::vector<std::vector<double>> columns;
};

TimeTable read_time_table(const fs::path& file) {
  std::istringstream lines(read_text(file));
  TimeTable table;
  std::string line;
  std::getline(lines, line);
  for (const std::string& head : csv_cells(line)) {
    const std::size_t unit = head.find(" [");
    table.names.push_back(head.substr(0, unit));
    table.units.push_back(unit == std::string::npos ? "" : head.substr(unit + 2, head.size() - unit - 3));
  }
  table.columns.resize(table.names.size());
  while (std::getline(lines, line)) {
    const std::vector<std::string> cells = csv_cells(line);
    if (cells.size() != table.names.size())
      throw InputError(fmt::format("{}: error: a row of {} cells for {} columns", file.string(), cells.size(),
                                   table.names.size()));
    for (std::size_t c = 0; c < cells.size(); ++c) table.columns[c].push_back(number(cells[c], file));
  }
  return table;
}

double taken(Take take, const std::vector<double>& values) {
  if (values.empty()) return analysis::nan;
  switch (take) {
    case Take::last:
      return values.back();
    case Take::largest:
      return *std::ranges::max_element(values);
    case Take::smallest:
      return *std::ranges::min_element(values);
    case Take::mean:
      break;
  }
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

const Result* find(const std::vector<Result>& results, const std::string& name) {
  const auto found = std::ranges::find(results, name, &Result::name);
  return found == results.end() ? nullptr : &*found;
}

Column words(std::string name, std::string meaning) {
  return {.name = std::move(name), .unit = "", .meaning = std::move(meaning), .numbers = {}, .words = {}};
}

bool has_variants(const Study& study) {
  return study.bands.cell_sizes.size() > 1 || study.bands.offsets.size() > 1;
}

/// Adds columns with the values of a point.
std::vector<Column> variable_columns(const Plan& plan) {
  std::vector<Column> columns;
  for (const Variable& variable : plan.variables)
    columns.push_back({variable.name, variable.unit, "varied", {}, {}});
  return columns;
}

void add_values(std::vector<Column>& columns, std::size_t first, const Plan& plan, const Point& point,
                std::size_t count) {
  for (std::size_t v = 0; v < count; ++v) {
    if (plan.variables[v].is_number) {
      columns[first + v].numbers.push_back(point.numbers[v]);
    } else {
      columns[first + v].words.push_back(point.texts[v]);
    }
  }
}

/// Makes the table of all points.
void make_points(const Plan& plan, const Computer& computer, std::span<const Point> points,
                 Results& results) {
  Table& table = results.points;
  table = {"points", "one row per point", {}};
  table.columns.push_back(words("point", "name of its run in the folder points"));
  const std::vector<Column> variables = variable_columns(plan);
  table.columns.insert(table.columns.end(), variables.begin(), variables.end());
  const std::size_t own = table.columns.size();
  table.columns.push_back({"group", "", "points of equal values but for their numerical variant", {}, {}});
  table.columns.push_back(words("cell_size", "of the variant; empty: that of the case"));
  table.columns.push_back({"offset", "", "of the grid of the variant, in cells", {}, {}});
  table.columns.push_back(words("state", "done, failed, or missing"));
  table.columns.push_back({"exit_code", "", "of the program that ended the point", {}, {}});
  table.columns.push_back({"wall_time", "s", "of the run", {}, {}});
  table.columns.push_back(
      words("message", "why it failed or was not measured, or what ended it before its end time"));
  const std::size_t first = table.columns.size();
  for (const Wanted& wanted : plan.study.wanted())
    table.columns.push_back({wanted.title(), "", "result", {}, {}});
  const std::vector<Wanted> wanted = plan.study.wanted();
  for (std::size_t row = 0; row < points.size(); ++row) {
    const Point& point = points[row];
    const Record record = computer.record(point);
    table.columns[0].words.push_back(point.name());
    add_values(table.columns, 1, plan, point, plan.variables.size());
    table.columns[own].numbers.push_back(static_cast<double>(point.group));
    table.columns[own + 1].words.push_back(point.cell_size);
    table.columns[own + 2].numbers.push_back(point.offset);
    table.columns[own + 3].words.emplace_back(word_of(record.state));
    table.columns[own + 4].numbers.push_back(record.exit_code);
    table.columns[own + 5].numbers.push_back(record.wall_time);
    const std::string unmeasured = computer.unmeasured(point);
    const std::string message = unmeasured.empty() ? record.message : "not measured: " + unmeasured;
    table.columns[own + 6].words.push_back(message.substr(0, message.find('\n')));
    if (record.state == State::done) {
      for (const Result& result : read_results(computer, point, record, wanted)) {
        auto column = std::ranges::find(table.columns.begin() + static_cast<std::ptrdiff_t>(first),
                                        table.columns.end(), result.name, &Column::name);
        if (column == table.columns.end()) {
          table.columns.push_back({result.name, result.unit, "result", {}, {}});
          column = table.columns.end() - 1;
        }
        column->unit = result.unit;
        column->numbers.resize(row, analysis::nan);
        column->numbers.push_back(result.value);
      }
    }
    for (std::size_t c = first; c < table.columns.size(); ++c)
      table.columns[c].numbers.resize(row + 1, analysis::nan);
  }
  for (std::size_t c = first; c < table.columns.size(); ++c)
    results.quantities.push_back(table.columns[c].name);
}

const Column& column(const Table& table, const std::string& name) {
  const auto found = std::ranges::find(table.columns, name, &Column::name);
  if (found == table.columns.end())
    throw InternalError(fmt::format("table {} has no column {}", table.name, name));
  return *found;
}

/// Combines the variants of each point: least and largest value, and verdicts of 0 and 1.
void make_bands(const Plan& plan, std::span<const Point> points, Results& results) {
  if (!has_variants(plan.study)) return;
  Table& table = results.bands;
  table = {"bands", "one row per point, over its cell sizes and offsets", variable_columns(plan)};
  std::map<std::vector<std::string>, std::vector<std::size_t>> of_values;
  std::vector<std::vector<std::string>> order;
  for (std::size_t row = 0; row < points.size(); ++row) {
    std::vector<std::size_t>& rows = of_values[points[row].texts];
    if (rows.empty()) order.push_back(points[row].texts);
    rows.push_back(row);
  }
  for (const auto& texts : order)
    add_values(table.columns, 0, plan, points[of_values[texts].front()], plan.variables.size());
  for (const std::string& name : results.quantities) {
    const Column& values = column(results.points, name);
    Column least{name + " least", values.unit, "least value of the variants", {}, {}};
    Column largest{name + " largest", values.unit, "largest value of the variants", {}, {}};
    Column verdict = words(name + " verdict", "of values 0 and 1: that of all variants, else undecided");
    bool is_verdict = true;
    for (const auto& texts : order) {
      std::set<double> seen;
      bool complete = true;
      for (const std::size_t row : of_values[texts]) {
        complete = complete && !std::isnan(values.numbers[row]);
        if (!std::isnan(values.numbers[row])) seen.insert(values.numbers[row]);
      }
      least.numbers.push_back(seen.empty() ? analysis::nan : *seen.begin());
      largest.numbers.push_back(seen.empty() ? analysis::nan : *seen.rbegin());
      is_verdict = is_verdict && std::ranges::all_of(seen, [](double v) { return v == 0.0 || v == 1.0; });
      verdict.words.push_back(complete && seen.size() == 1 ? fmt::format("{}", *seen.begin()) : "undecided");
    }
    table.columns.push_back(std::move(least));
    table.columns.push_back(std::move(largest));
    if (is_verdict) table.columns.push_back(std::move(verdict));
  }
}

/// Estimates first-order indices of all numeric variables from the points that have a result.
void make_sensitivities(const Plan& plan, Results& results) {
  if (plan.study.find || has_variants(plan.study) || results.points.rows() < 3) return;
  Table& table = results.sensitivities;
  table = {"sensitivities",
           "first-order indices of Sobol: part of the variance of a result that a variable explains",
           {}};
  table.columns.push_back(words("variable", ""));
  for (const Variable& variable : plan.variables) {
    if (variable.is_number) table.columns.front().words.push_back(variable.name);
  }
  for (const std::string& name : results.quantities) {
    const Column& y = column(results.points, name);
    Column index{name, "1", "first-order index", {}, {}};
    for (const Variable& variable : plan.variables) {
      if (!variable.is_number) continue;
      const Column& x = column(results.points, variable.name);
      std::vector<double> inputs, outputs;
      for (std::size_t row = 0; row < y.numbers.size(); ++row) {
        if (!std::isfinite(y.numbers[row])) continue;
        inputs.push_back(x.numbers[row]);
        outputs.push_back(y.numbers[row]);
      }
      index.numbers.push_back(
          first_order_index(inputs, outputs, variable.is_sampled ? Design::sampled : Design::listed));
    }
    table.columns.push_back(std::move(index));
  }
}

/// Describes the verdicts of one group in words.
std::string verdict_words(const std::vector<Limit>& of_variants, bool found) {
  if (found) return "found";
  if (std::ranges::count(of_variants, Limit::Kind::not_monotone, &Limit::kind) > 0) {
    std::vector<std::string> changes;
    for (const Limit& limit : of_variants) {
      for (const auto& [from, to] : limit.changes)
        if (limit.kind == Limit::Kind::not_monotone) changes.push_back(fmt::format("{} to {}", from, to));
    }
    return fmt::format("not monotone: the verdict changes at {}", fmt::join(changes, ", "));
  }
  return "undecided: the verdict does not change, or an end of the range has none";
}

/// Makes the table of limits.
void make_limits(const Plan& plan, const Computer& computer, std::span<const Point> points,
                 Results& results) {
  if (!plan.study.find) return;
  std::map<std::size_t, std::map<std::pair<std::string, double>, std::vector<Judged>>> judged;
  std::map<std::size_t, const Point*> of_group;
  for (const Point& point : points) {
    judged[point.group][{point.cell_size, point.offset}].push_back(
        {point.numbers.back(), verdict_of(plan, computer, point)});
    of_group[point.group] = &point;
  }
  Table& table = results.limits;
  table = {"limits", fmt::format("interval of {} that holds the limit", plan.study.find->key),
           variable_columns(plan)};
  table.columns.pop_back();  // the sought key
  const std::string& unit = plan.variables.back().unit;
  const std::size_t others = table.columns.size();
  table.columns.push_back({"lower", unit, "the limit is above", {}, {}});
  table.columns.push_back({"upper", unit, "and below", {}, {}});
  table.columns.push_back(words("verdict", "found, not monotone, or undecided"));
  for (auto& [group, variants] : judged) {
    std::vector<Limit> limits;
    for (auto& [variant, values] : variants) {
      std::ranges::sort(values, {}, &Judged::at);
      limits.push_back(limit_of(values));
    }
    const std::optional<std::pair<double, double>> interval = hull(limits);
    add_values(table.columns, 0, plan, *of_group[group], others);
    table.columns[others].numbers.push_back(interval ? interval->first : analysis::nan);
    table.columns[others + 1].numbers.push_back(interval ? interval->second : analysis::nan);
    table.columns[others + 2].words.push_back(verdict_words(limits, interval.has_value()));
  }
}

}  // namespace

std::vector<Result> read_results(const Computer& computer, const Point& point, const Record& record,
                                 std::span<const Wanted> wanted) {
  const fs::path run = computer.run_folder(point);
  const fs::path measures = run / "report" / "quantities.csv";
  std::vector<Result> all;
  if (computer.is_measured(record) && fs::exists(measures)) {
    for (const analysis::Quantity& q : analysis::read_quantities(measures.parent_path()))
      all.push_back({q.name, q.unit, q.value});
  }
  if (wanted.empty()) return all;
  std::map<std::string, TimeTable> tables;
  std::vector<Result> results;
  for (const Wanted& one : wanted) {
    if (!one.is_column()) {
      if (const Result* found = find(all, one.name)) results.push_back(*found);
      continue;
    }
    const std::size_t dot = one.name.find('.');
    const bool of_history = one.name.starts_with("history.");
    const fs::path file = run / (of_history ? "history.csv" : "gauges.csv");
    if (!fs::exists(file)) continue;
    if (!tables.contains(file)) tables[file] = read_time_table(file);
    const TimeTable& table = tables[file];
    const auto found = std::ranges::find(table.names, one.name.substr(dot + 1));
    if (found == table.names.end()) continue;
    const auto at = static_cast<std::size_t>(found - table.names.begin());
    results.push_back({one.title(), table.units[at], taken(one.take, table.columns[at])});
  }
  return results;
}

Verdict verdict_of(const Plan& plan, const Computer& computer, const Point& point) {
  const Record record = computer.record(point);
  if (record.state != State::done) return Verdict::undecided;
  const Find& find = *plan.study.find;
  const std::vector<Wanted> wanted = {find.wanted()};
  const std::vector<Result> results = read_results(computer, point, record, wanted);
  if (results.empty() || std::isnan(results.front().value)) return Verdict::undecided;
  const std::string& unit = results.front().unit;
  const double threshold = units::parse_quantity(find.crosses, unit == "1" ? "" : unit);
  return results.front().value < threshold ? Verdict::below : Verdict::above;
}

bool search(const Plan& plan, Computer& computer, std::vector<Point>& points) {
  const Number width = *Number::of(plan.study.find->tolerance);
  const double tolerance = units::convert(width.value, width.unit, plan.variables.back().unit);
  const auto is_missing = [&](const Point& point) { return computer.record(point).state == State::missing; };
  while (std::ranges::none_of(points, is_missing)) {
    std::map<std::tuple<std::size_t, std::string, double>, std::vector<std::size_t>> searches;
    for (std::size_t i = 0; i < points.size(); ++i)
      searches[{points[i].group, points[i].cell_size, points[i].offset}].push_back(i);
    std::vector<Point> next;
    for (auto& [search, members] : searches) {
      std::ranges::sort(members, {}, [&](std::size_t i) { return points[i].numbers.back(); });
      std::vector<Judged> judged;
      for (const std::size_t i : members)
        judged.push_back({points[i].numbers.back(), verdict_of(plan, computer, points[i])});
      for (const double value : next_values(judged, tolerance))
        next.push_back(with_sought(plan, points[members.front()], value));
    }
    if (next.empty()) return true;
    const bool complete = computer.compute(next);
    points.insert(points.end(), next.begin(), next.end());
    if (!complete) return false;
  }
  return true;
}

Results collect(const Plan& plan, const Computer& computer, std::span<const Point> points) {
  Results results;
  results.variables = plan.variables;
  make_points(plan, computer, points, results);
  make_bands(plan, points, results);
  make_sensitivities(plan, results);
  make_limits(plan, computer, points, results);
  return results;
}

}  // namespace whipple::sweep
