// SPDX-License-Identifier: BSD-3-Clause
// Measures of tests of fracture, as the laboratory takes them: of a bar that is pulled from its plane of symmetry, x = 0,
// and of a plate that a punch shears between itself and a die, which lies at a plane. The force is that of the plane
// (history.csv); the section has moving tracers from the axis to the surface, in the plane (gauges.csv). The bar is torn
// when the force over the section that is left has fallen to half of its greatest value: in a deep neck the force alone
// falls as far without a crack.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>

#include "src/analysis/requests.hpp"
#include "src/analysis/run_table.hpp"
#include "src/core/base/error.hpp"

namespace whipple::analysis {
namespace {

constexpr double average = 4e-6;  // s: a few passages of sound over a bar of centimetres

/// Force of the plane on the bodies along -x (N), pull of x = 0, push of the upper plane: means over `average`.
struct Forces {
  std::vector<double> time, force;
  [[nodiscard]] double greatest() const { return force.empty() ? nan : *std::ranges::max_element(force); }
};

Forces forces_of(const Request& request) {
  const RunTable history(request.folder / "history.csv");
  const std::vector<double>&time = history["time"], &impulse = history["wall_impulse_x"];
  Forces forces;
  if (time.empty() || impulse.empty()) return forces;
  const auto parts = static_cast<std::size_t>(time.back() / average);
  double before = value_at(0.0, time, impulse);
  for (std::size_t i = 1; i <= parts; ++i) {
    const double from = average * static_cast<double>(i - 1), to = average * static_cast<double>(i);
    const double reached = value_at(to, time, impulse);
    forces.time.push_back(0.5 * (from + to));
    forces.force.push_back(-(reached - before) / average);
    before = reached;
  }
  return forces;
}

/// Returns when values have fallen to half of the greatest; NaN if they never do.
double time_of_half(const std::vector<double>& time, const std::vector<double>& values) {
  if (values.empty()) return nan;
  const auto greatest = std::ranges::max_element(values);
  const auto half =
      std::find_if(greatest, values.end(), [&](double value) { return value < 0.5 * *greatest; });
  return half == values.end() ? nan : time[static_cast<std::size_t>(half - values.begin())];
}

/// Gauges of a section: tracers TRACERS_1, TRACERS_2, ... from the axis outwards.
struct Section {
  RunTable gauges;
  std::vector<std::string> tracers;

  explicit Section(const Request& request) : gauges(request.folder / "gauges.csv") {
    const std::string& group = request.names[0];
    std::vector<std::pair<int, std::string>> found;
    for (const Column& column : gauges.columns()) {
      if (!column.name.starts_with(group + "_") || !column.name.ends_with(".y")) continue;
      const char* const begin = column.name.data() + group.size() + 1;
      const char* const end = column.name.data() + column.name.size() - 2;
      int number = 0;
      const auto [read_to, fault] = std::from_chars(begin, end, number);
      if (fault == std::errc() && read_to == end)
        found.emplace_back(number, column.name.substr(0, column.name.size() - 2));
    }
    std::ranges::sort(found);
    for (const auto& [number, name] : found) tracers.push_back(name);
    if (tracers.empty() && !gauges.columns().empty()) {
      throw InputError(fmt::format("{} has no {}_1, {}_2, ...", gauges.file().string(), group, group));
    }
  }
  [[nodiscard]] const std::vector<double>& of(std::size_t tracer, std::string_view quantity) const {
    return gauges[fmt::format("{}.{}", tracers[tracer], quantity)];
  }
  [[nodiscard]] const std::vector<double>& radius() const { return of(tracers.size() - 1, "y"); }
};

/// Returns the column x of a gauge; empty without gauges.csv. @throws InputError if that has no such gauge
const std::vector<double>& path_of(const RunTable& gauges, const std::string& gauge) {
  const std::vector<double>& x = gauges[gauge + ".x"];
  if (x.empty() && !gauges.columns().empty()) {
    throw InputError(fmt::format("{} has no {}", gauges.file().string(), gauge));
  }
  return x;
}

double time_of_rupture(const Request& request, const Section& section) {
  Forces pull = forces_of(request);
  if (section.tracers.empty()) return nan;
  for (std::size_t i = 0; i < pull.time.size(); ++i) {
    const double radius = value_at(pull.time[i], section.gauges["time"], section.radius());
    pull.force[i] /= radius * radius;
  }
  return time_of_half(pull.time, pull.force);
}

/// The tracer of a section that fails first, and the row of gauges.csv in which it has failed.
struct Failure {
  std::size_t row, tracer;
};
std::optional<Failure> first_failure(const Section& section) {
  std::optional<Failure> first;
  for (std::size_t k = 0; k < section.tracers.size(); ++k) {
    const std::vector<double>& failed = section.of(k, "failed_fraction");
    const auto found = std::ranges::find_if(failed, [](double fraction) { return fraction > 0.5; });
    if (found == failed.end()) continue;
    const Failure here{static_cast<std::size_t>(found - failed.begin()), k};
    // Of those that fail in one row the first by name counts.
    const bool sooner = !first || here.row < first->row ||
                        (here.row == first->row && section.tracers[k] < section.tracers[first->tracer]);
    if (sooner) first = here;
  }
  return first;
}

}  // namespace

double mean_force(const Request& request) {
  const RunTable history(request.folder / "history.csv");
  const std::vector<double>&time = history["time"], &impulse = history[request.names[0]];
  if (time.empty() || impulse.size() != time.size() || !(request.time < time.back())) return nan;
  return (impulse.back() - value_at(request.time, time, impulse)) / (time.back() - request.time);
}

double peak_stress(const Request& request) {
  return forces_of(request).greatest() / (std::numbers::pi * request.place * request.place);
}

double neck_strain(const Request& request) {
  const Section section(request);
  const double torn = time_of_rupture(request, section);
  if (!std::isfinite(torn)) return nan;
  const std::vector<double>& radius = section.radius();
  return 2.0 * std::log(radius.front() / value_at(torn, section.gauges["time"], radius));
}

double elongation(const Request& request) {
  const Section section(request);
  const std::vector<double>& mark = path_of(section.gauges, request.names[1]);
  const double torn = time_of_rupture(request, section);
  if (mark.empty() || !std::isfinite(torn)) return nan;
  return value_at(torn, section.gauges["time"], mark) / mark.front() - 1.0;
}

double failure_strain(const Request& request) {
  const Section section(request);
  const std::optional<Failure> failure = first_failure(section);
  return failure ? section.of(failure->tracer, "plastic_strain")[failure->row] : nan;
}

double failure_triaxiality(const Request& request) {
  const Section section(request);
  const std::optional<Failure> failure = first_failure(section);
  if (!failure) return nan;
  const auto of = [&](const char* quantity) -> const std::vector<double>& {
    return section.of(failure->tracer, quantity);
  };
  const std::vector<double>&xx = of("stress_xx"), &yy = of("stress_yy"), &zz = of("stress_zz"),
        &xy = of("stress_xy"), &yz = of("stress_yz"), &zx = of("stress_zx"), &strain = of("plastic_strain");
  const auto square = [](double x) { return x * x; };
  double total = 0.0;
  for (std::size_t i = 1; i < failure->row; ++i) {
    const double mean = (xx[i] + yy[i] + zz[i]) / 3.0;
    const double shear = square(xy[i]) + square(yz[i]) + square(zx[i]);
    const double equivalent =
        std::sqrt(1.5 * (square(xx[i] - mean) + square(yy[i] - mean) + square(zz[i] - mean) + 2.0 * shear));
    total += (strain[i] - strain[i - 1]) * (equivalent > 0.0 ? mean / equivalent : 0.0);
  }
  const double reached = strain[failure->row > 0 ? failure->row - 1 : 0];
  return reached > 0.0 ? total / reached : nan;
}

double shear_strength(const Request& request) {
  const RunTable gauges(request.folder / "gauges.csv");
  path_of(gauges, request.names[0]);
  return forces_of(request).greatest() / (2.0 * std::numbers::pi * request.place * request.travel);
}

double shear_stroke(const Request& request) {
  const RunTable gauges(request.folder / "gauges.csv");
  const std::vector<double>& punch = path_of(gauges, request.names[0]);
  const Forces push = forces_of(request);
  const double cut = time_of_half(push.time, push.force);
  if (punch.empty() || !std::isfinite(cut)) return nan;
  return (value_at(cut, gauges["time"], punch) - punch.front()) / request.travel;
}

}  // namespace whipple::analysis
