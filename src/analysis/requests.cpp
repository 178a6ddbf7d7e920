// SPDX-License-Identifier: BSD-3-Clause
#include "src/analysis/requests.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "src/analysis/run_table.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/units.hpp"

namespace whipple::analysis {
namespace {

constexpr std::string_view not_torn = "the bar does not tear, or the run has no gauges of these names";
constexpr std::string_view not_failed = "no tracer of the section fails";
constexpr std::string_view no_force = "the run has no history of the force";
constexpr std::string_view no_jet = "no snapshot has particles of the body";

// clang-format off
constexpr auto on_request = std::to_array<RequestedMeasure>({
    {"wall_speed", "TRACERS", "place travel", "m/s", "radial speed of a wall at a place of the x axis, where it has moved outwards by a travel: slope of its radius there over time, from tracers along it, over 0.6 mm on either side", "the wall does not move so far there", wall_speed},
    {"arrival_speed", "TRACERS", "", "m/s", "speed along x of a front: slope by least squares of the places where tracers began over the times at which their pressure first exceeds half of the median of what they reach", "the front passes fewer than three tracers", arrival_speed},
    {"run_distance", "TRACERS", "place", "m", "distance from a place, where a shock enters an explosive, to where it has become a detonation: there the front passes from tracer to tracer faster than the mean of its least speed and of that over the last quarter of the tracers", "the front passes fewer than eight tracers, or its last speed is not a quarter above the least", run_distance},
    {"peak", "GAUGE.QUANTITY", "", "", "greatest value of a column of gauges.csv", "the run has no such column", peak},
    {"change", "GAUGE.QUANTITY", "", "", "last less first value of a column of gauges.csv: of a coordinate of a moving gauge its displacement", "the run has no such column", change},
    {"change_error", "GAUGE.QUANTITY", "table", "1", "integral of the absolute difference of the change of a column of gauges.csv since the start from a given curve over that of the absolute value of the curve, at its times: of a coordinate of a moving gauge the error of its displacement", "the run ends before the curve, or has no such column", change_error},
    {"peak_change", "GAUGE.QUANTITY", "", "", "greatest magnitude of the change of a column of gauges.csv since the start: of a coordinate of a moving gauge its greatest displacement", "the run has no such column", peak_change},
    {"arrival", "GAUGE.QUANTITY", "", "s", "when a column of gauges.csv first comes half way from where it began to its greatest value", "the run has no such column", arrival},
    {"history_error", "GAUGE.QUANTITY", "table", "1", "integral of the absolute difference from a measured history over that of the absolute measured value, after a shift in time that makes both reach half of the greatest measured value together", "the run does not reach half of the greatest measured value, or ends before the record", history_error},
    {"history_shift", "GAUGE.QUANTITY", "table", "s", "time by which the run is moved for this comparison", "the run does not reach half of the greatest measured value", history_shift},
    {"peak_stress", "TRACERS", "place", "Pa", "greatest pull of the plane x = 0 over the area of a section of that initial radius; forces are means over 4 us", no_force, peak_stress},
    {"neck_strain", "TRACERS", "", "1", "ln(A0/A) of the section of the tracers when the bar is torn: when the pull over the section that is left has fallen to half of its greatest value", not_torn, neck_strain},
    {"elongation", "TRACERS.GAUGE", "", "1", "relative elongation between the plane x = 0 and a moving gauge when the bar is torn", not_torn, elongation},
    {"failure_strain", "TRACERS", "", "1", "equivalent plastic strain of the tracer of the section that fails first, at its failure", not_failed, failure_strain},
    {"failure_triaxiality", "TRACERS", "", "1", "mean over equivalent stress of that tracer, averaged over its plastic strain", not_failed, failure_triaxiality},
    {"shear_strength", "GAUGE", "place travel", "Pa", "greatest force on the die at the upper plane x over the area of the cut through a plate, 2 pi R t, R the place and t the travel", no_force, shear_strength},
    {"shear_stroke", "GAUGE", "travel", "1", "path of the punch, which the gauge moves with, over a travel, when the force has fallen to half of its greatest value", "the plate is not cut, or the run has no such gauge", shear_stroke},
    {"mean_force", "IMPULSE", "time", "N", "mean force by a column of impulses of history.csv (wall_impulse_x, ...) from a time to the end: of the planes on the bodies; in plane strain for 1 m of depth", no_force, mean_force},
    {"profile_error", "BODY.QUANTITY", "table", "1", "absolute difference from an exact solution, summed with the masses of the particles of a body at the last snapshot within the places x of its table, over the sum of the absolute exact value; of a velocity its component along x", no_jet, profile_error},
    {"reach", "BODY.AXIS", "fraction", "m", "coordinate along x, y or z that a fraction of the mass of a body exceeds at the last snapshot; in two dimensions x is along the axis and y across it", no_jet, reach},
    {"height", "BODY.AXIS.AXIS", "place", "m", "greatest coordinate along the first axis of the particles of a body within half a cell of a place of the second, at the last snapshot: the surface lies half a spacing of the particles above it", "no particle of the body is there", height},
    {"jet_speed", "BODY", "fraction", "m/s", "velocity along x that a fraction of the mass of a body exceeds at the last snapshot, of what is left of it", no_jet, jet_speed},
    {"jet_gap", "BODY", "fraction", "1", "fraction of the cells along x that hold none of a body, over the length of its jet at the last snapshot: what is faster than a quarter of the speed that a fraction of its mass exceeds, less this fraction, which is ahead of the rest", no_jet, jet_gap},
    {"jet_fraction", "BODY", "time speed", "1", "fraction of the jet in the mass of a body that turns into jet and slug between a time and the last snapshot: of what loses half of its initial velocity along y, what moves along x faster than a speed", "no snapshot is so early, or nothing turns", jet_fraction},
});
// clang-format on

std::vector<std::string> divided(std::string_view text, char by) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(by, begin), text.size());
    parts.emplace_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

/// Divides "NAME KEY=VALUE WITH UNIT KEY=VALUE" into the name and the values by their keys.
std::pair<std::string, std::map<std::string, std::string>> parts_of(const std::string& text) {
  std::string name, key;
  std::map<std::string, std::string> values;
  for (const std::string& word : divided(text, ' ')) {
    const std::size_t equal = word.find('=');
    if (equal != std::string::npos && !name.empty()) {
      key = word.substr(0, equal);
      if (!values.emplace(key, word.substr(equal + 1)).second) {
        throw InputError(fmt::format("measure \"{}\": {} is given twice", text, key));
      }
    } else if (!key.empty()) {
      values[key] += " " + word;
    } else if (name.empty()) {
      name = word;
    } else if (!word.empty()) {
      throw InputError(fmt::format("measure \"{}\": expected KEY=VALUE, not \"{}\"", text, word));
    }
  }
  return {name, values};
}

/// Parameters that are numbers; the other one is the file of a table.
struct Parameter {
  std::string_view key, unit;
  double Request::* member;
};
constexpr std::array<Parameter, 5> parameters = {{{"place", "m", &Request::place},
                                                  {"travel", "m", &Request::travel},
                                                  {"speed", "m/s", &Request::speed},
                                                  {"fraction", "", &Request::fraction},
                                                  {"time", "s", &Request::time}}};

void set(Request& request, const std::string& key, const std::string& value) {
  const auto parameter = std::ranges::find(parameters, key, &Parameter::key);
  if (parameter == parameters.end()) {
    request.table = value;
  } else {
    const double number = units::parse_quantity(value, parameter->unit);
    if (parameter->member == &Request::fraction && !(number > 0.0 && number < 1.0))
      throw InputError(fmt::format("is {}, but must be > 0 and < 1", value));
    request.*parameter->member = number;
  }
}

}  // namespace

std::span<const RequestedMeasure> requested_measures() { return on_request; }

Quantity take_on_request(const std::filesystem::path& folder, const std::string& text) {
  const auto [name, values] = parts_of(text);
  const std::size_t dot = std::min(name.find('.'), name.size());
  const auto measure =
      std::ranges::find(on_request, std::string_view(name).substr(0, dot), &RequestedMeasure::kind);
  if (measure == on_request.end()) {
    std::vector<std::string_view> kinds;
    for (const RequestedMeasure& one : on_request) kinds.push_back(one.kind);
    throw InputError(fmt::format("measure \"{}\": unknown kind; there are {}", text, fmt::join(kinds, ", ")));
  }
  Request request{.folder = folder};
  if (dot < name.size()) request.names = divided(std::string_view(name).substr(dot + 1), '.');
  const bool named = request.names.size() == divided(measure->names, '.').size() &&
                     std::ranges::none_of(request.names, &std::string::empty);
  if (!named) {
    throw InputError(fmt::format("measure \"{}\": expected {}.{}", text, measure->kind, measure->names));
  }
  std::vector<std::string> wanted;
  if (!measure->parameters.empty()) wanted = divided(measure->parameters, ' ');
  const bool complete =
      values.size() == wanted.size() &&
      std::ranges::all_of(wanted, [&](const std::string& key) { return values.contains(key); });
  if (!complete) {
    throw InputError(
        fmt::format("measure \"{}\": {} takes {}", text, measure->kind,
                    wanted.empty() ? "no parameters" : fmt::format("{}", fmt::join(wanted, ", "))));
  }
  for (const auto& [key, value] : values) {
    try {
      set(request, key, value);
    } catch (const InputError& error) {
      throw InputError(fmt::format("measure \"{}\": {}: {}", text, key, error.what()));
    }
  }
  std::string unit(measure->unit);
  if (unit.empty()) {
    const RunTable gauges(folder / "gauges.csv");
    const Column* const column = gauges.find(fmt::format("{}", fmt::join(request.names, ".")));
    unit = column == nullptr ? "1" : column->unit;
  }
  Quantity quantity{text, unit, std::string(measure->meaning), nan};
  try {
    quantity.value = measure->value(request);
  } catch (const InputError& error) {
    throw InputError(fmt::format("measure \"{}\": {}", text, error.what()));
  }
  if (!std::isfinite(quantity.value)) {
    quantity.value = nan;
    quantity.reason = measure->missing;
  }
  return quantity;
}

std::string requested_measures_as_markdown() {
  std::string text = "| measure | parameters | unit | meaning |\n| --- | --- | --- | --- |\n";
  for (const RequestedMeasure& one : on_request) {
    text += fmt::format("| `{}.{}` | {} | {} | {} |\n", one.kind, one.names, one.parameters,
                        one.unit.empty() ? "of the column" : one.unit, one.meaning);
  }
  return text;
}

}  // namespace whipple::analysis
