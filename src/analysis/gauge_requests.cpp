// SPDX-License-Identifier: BSD-3-Clause
// Measures of gauges and moving tracers: fronts that pass them, walls that carry them, records that they are compared
// with.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "src/analysis/requests.hpp"
#include "src/analysis/run_table.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/units.hpp"

namespace whipple::analysis {
namespace {

RunTable gauges_of(const Request& request) { return RunTable(request.folder / "gauges.csv"); }

/// Returns the names TRACERS_... of the tracers of a group, ascending.
std::set<std::string> tracers_of(const RunTable& gauges, const std::string& group) {
  std::set<std::string> names;
  for (const Column& column : gauges.columns()) {
    if (column.name.starts_with(group + "_")) names.insert(column.name.substr(0, column.name.find('.')));
  }
  return names;
}

double greatest_of(const std::vector<double>& values) {
  double greatest = nan;
  for (const double value : values) greatest = std::fmax(greatest, value);
  return greatest;
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2.0;
}

/// When a front passes a tracer, and where the tracer began.
struct Passage {
  double time, place;
};

/// Finds when the pressure of each tracer first exceeds a fraction of the median of what they reach, in the order of
/// their initial places x.
std::vector<Passage> passages(const RunTable& gauges, const std::string& group, double fraction) {
  const std::set<std::string> names = tracers_of(gauges, group);
  const std::vector<double>& time = gauges["time"];
  if (names.empty() || time.empty()) return {};
  std::vector<double> peaks;
  for (const std::string& name : names) peaks.push_back(greatest_of(gauges[name + ".pressure"]));
  const double level = fraction * median(peaks);
  std::vector<Passage> found;
  for (const std::string& name : names) {
    const std::vector<double>& pressure = gauges[name + ".pressure"];
    const auto first = static_cast<std::size_t>(
        std::ranges::find_if(pressure, [level](double p) { return p > level; }) - pressure.begin());
    if (!(level > 0.0) || first == 0 || first == pressure.size()) continue;
    found.push_back(
        {on_polygon(level, {pressure[first - 1], pressure[first]}, {time[first - 1], time[first]}),
         gauges[name + ".x"].front()});
  }
  std::ranges::stable_sort(found, [](const Passage& a, const Passage& b) {
    return std::pair(a.place, a.time) < std::pair(b.place, b.time);
  });
  return found;
}

/// Times and radii of a wall at a place of the x axis.
std::pair<std::vector<double>, std::vector<double>> path_of_wall(const RunTable& gauges,
                                                                 const std::string& group, double place) {
  const std::set<std::string> names = tracers_of(gauges, group);
  const std::vector<double>& time = gauges["time"];
  std::pair<std::vector<double>, std::vector<double>> path;
  for (std::size_t row = 0; row < time.size(); ++row) {
    std::vector<std::pair<double, double>> points;
    for (const std::string& name : names) {
      const std::vector<double>&x = gauges[name + ".x"], &y = gauges[name + ".y"];
      if (x.empty() || y.empty()) continue;
      // Tracers that have left the domain have no place.
      if (std::isfinite(x[row]) && std::isfinite(y[row])) points.emplace_back(x[row], y[row]);
    }
    std::ranges::sort(points);
    std::vector<double> xs, ys;
    for (const auto& [x, y] : points) xs.push_back(x), ys.push_back(y);
    const double radius = on_polygon(place, xs, ys);
    if (!std::isfinite(radius)) continue;
    path.first.push_back(time[row]);
    path.second.push_back(radius);
  }
  return path;
}

/// A history with finite values.
struct History {
  std::vector<double> time, value;
};

History of_gauge(const Request& request) {
  const RunTable gauges = gauges_of(request);
  const std::vector<double>&time = gauges["time"],
        &value = gauges[fmt::format("{}", fmt::join(request.names, "."))];
  History history;
  for (std::size_t i = 0; i < value.size(); ++i) {
    if (!std::isfinite(value[i])) continue;
    history.time.push_back(time[i]);
    history.value.push_back(value[i]);
  }
  return history;
}

/// Reads a measured history: two columns, "time [UNIT]" and "NAME [UNIT]".
/// @throws InputError naming the file
History measured_history(const Request& request) {
  const RunTable table(request.table, RunTable::Row::complete);
  const std::string file = request.table.string();
  const std::vector<Column>& columns = table.columns();
  if (columns.empty()) throw InputError(fmt::format("{} is missing or empty", file));
  const bool is_history =
      columns.size() == 2 && table.find("time") == &columns[0] && !columns[0].unit.empty() &&
      !columns[1].unit.empty() && table.columns()[0].values.size() >= 3 &&
      std::ranges::is_sorted(columns[0].values) && std::ranges::all_of(columns, [](const Column& column) {
        return std::ranges::all_of(column.values, [](double v) { return std::isfinite(v); });
      });
  if (!is_history) {
    throw InputError(fmt::format(
        "{}: expected the columns \"time [UNIT]\" and \"NAME [UNIT]\" with three or more complete "
        "rows in the order of time",
        file));
  }
  const RunTable gauges = gauges_of(request);
  const Column* const own = gauges.find(fmt::format("{}", fmt::join(request.names, ".")));
  History history{columns[0].values, columns[1].values};
  const double second = units::conversion(columns[0].unit, "s").factor;
  const double unit = own == nullptr ? 1.0 : units::conversion(columns[1].unit, own->unit).factor;
  for (double& time : history.time) time *= second;
  for (double& value : history.value) value *= unit;
  return history;
}

/// Returns when a history first reaches a level of its sign, linear in between; NaN if it never does.
double crossing(const History& history, double level) {
  const auto reaches = [level](double value) { return level > 0.0 ? value >= level : value <= level; };
  const auto found = std::ranges::find_if(history.value, reaches);
  const auto i = static_cast<std::size_t>(found - history.value.begin());
  if (found == history.value.end() || i == 0) return nan;
  const double t0 = history.time[i - 1], v0 = history.value[i - 1];
  return t0 + (history.time[i] - t0) * (level - v0) / (history.value[i] - v0);
}

/// Returns the time by which a simulated history is moved to reach half the greatest measured value when the
/// measurement does: the moment of impact is in few records; shape and size are compared, not the arrival.
double shift(const History& history, const History& measured) {
  const double greatest =
      *std::ranges::max_element(measured.value, {}, [](double value) { return std::abs(value); });
  return crossing(measured, 0.5 * greatest) - crossing(history, 0.5 * greatest);
}

/// Integrates over time by the trapezoidal rule.
template <class Value>
double integral(const std::vector<double>& time, const Value& value) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < time.size(); ++i) {
    sum += 0.5 * (value(i + 1) + value(i)) * (time[i + 1] - time[i]);
  }
  return sum;
}

/// Integrates the absolute difference of a history from a given one over that of its absolute value, at its times.
/// Before it begins nothing has happened yet: it is 0.
double relative_difference(const History& given, const History& history) {
  const auto difference = [&](std::size_t i) {
    const double t = given.time[i];
    const double found = t < history.time.front() ? 0.0 : value_at(t, history.time, history.value);
    return std::abs(found - given.value[i]);
  };
  return integral(given.time, difference) /
         integral(given.time, [&](std::size_t i) { return std::abs(given.value[i]); });
}

}  // namespace

double wall_speed(const Request& request) {
  constexpr double window = 0.6e-3;  // m on either side: a polygon through particles is rough
  const auto [times, radii] = path_of_wall(gauges_of(request), request.names[0], request.place);
  if (radii.empty()) return nan;
  const double wanted = radii.front() + request.travel;
  return 2.0 * window /
         (on_polygon(wanted + window, radii, times) - on_polygon(wanted - window, radii, times));
}

double arrival_speed(const Request& request) {
  const std::vector<Passage> passed = passages(gauges_of(request), request.names[0], 0.5);
  if (passed.size() < 3) return nan;
  double middle = 0.0, centre = 0.0, moment = 0.0, square = 0.0;
  const auto n = static_cast<double>(passed.size());
  for (const Passage& p : passed) middle += p.time, centre += p.place;
  middle /= n, centre /= n;
  for (const Passage& p : passed) {
    moment += (p.time - middle) * (p.place - centre);
    square += (p.time - middle) * (p.time - middle);
  }
  return moment / square;
}

double run_distance(const Request& request) {
  const std::vector<Passage> passed = passages(gauges_of(request), request.names[0], 0.05);
  if (passed.size() < 8) return nan;
  std::vector<double> speeds, places;  // between neighbours but one
  for (std::size_t i = 1; i + 1 < passed.size(); ++i) {
    const Passage &a = passed[i - 1], &b = passed[i + 1];
    const double way = b.place - a.place, time = b.time - a.time;
    speeds.push_back(time > 0.0 ? way / time : std::numeric_limits<double>::infinity());
    places.push_back(passed[i].place);
  }
  const Passage &first = passed[passed.size() - passed.size() / 4 - 1], &end = passed.back();
  const double last = (end.place - first.place) / (end.time - first.time);
  const auto least = std::ranges::min_element(speeds);
  if (!(last > 1.25 * *least)) return nan;
  const double middle = 0.5 * (last + *least);
  const auto found = std::find_if(least, speeds.end(), [middle](double speed) { return speed >= middle; });
  if (found == speeds.end()) return nan;
  const auto i = static_cast<std::size_t>(found - speeds.begin());
  if (found == least) return places[i] - request.place;
  return on_polygon(middle, {speeds[i - 1], speeds[i]}, {places[i - 1], places[i]}) - request.place;
}

double peak(const Request& request) { return greatest_of(of_gauge(request).value); }

double change(const Request& request) {
  const History history = of_gauge(request);
  return history.value.empty() ? nan : history.value.back() - history.value.front();
}

double arrival(const Request& request) {
  const History history = of_gauge(request);
  if (history.value.empty()) return nan;
  const double half = 0.5 * (history.value.front() + greatest_of(history.value));
  const auto reached = std::ranges::find_if(history.value, [half](double value) { return value >= half; });
  return history.time[static_cast<std::size_t>(reached - history.value.begin())];
}

double history_shift(const Request& request) {
  const History history = of_gauge(request);
  return history.value.size() > 1 ? shift(history, measured_history(request)) : nan;
}

double history_error(const Request& request) {
  History history = of_gauge(request);
  if (history.value.size() < 2) return nan;
  const History measured = measured_history(request);
  const double moved = shift(history, measured);
  for (double& time : history.time) time += moved;
  if (!std::isfinite(moved) || history.time.back() < measured.time.back()) return nan;
  return relative_difference(measured, history);
}

double peak_change(const Request& request) {
  const History history = of_gauge(request);
  double greatest = history.value.empty() ? nan : 0.0;
  for (const double value : history.value)
    greatest = std::max(greatest, std::abs(value - history.value.front()));
  return greatest;
}

double change_error(const Request& request) {
  History history = of_gauge(request);
  if (history.value.size() < 2) return nan;
  const History given = measured_history(request);
  if (history.time.back() < given.time.back()) return nan;
  const double start = history.value.front();
  for (double& value : history.value) value -= start;
  return relative_difference(given, history);
}

}  // namespace whipple::analysis
