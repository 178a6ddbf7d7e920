// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/gauges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "src/case/case.hpp"

namespace whipple::cases {

ParameterTable<Gauge> Gauge::parameters() {
  return {text("name", &Gauge::name, "name of its columns in gauges.csv"),
          choice("kind", &Gauge::kind, "fixed in space | moving with the particle that is initially nearest")
              .optional(),
          vector("position", &Gauge::position, "m", range::any(), "initial position")};
}

ParameterTable<Tracers> Tracers::parameters() {
  return {text("name", &Tracers::name, "name of its gauges, numbered NAME_1, NAME_2, ..."),
          vector("from", &Tracers::from, "m", range::any(), "initial position of the first gauge"),
          vector("to", &Tracers::to, "m", range::any(), "initial position of the last gauge"),
          integer("count", &Tracers::count, range::between(2, 10000), "number of moving gauges on the line")};
}

std::vector<Gauge> Tracers::gauges() const {
  std::vector<Gauge> gauges;
  for (std::int64_t i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count - 1);
    gauges.push_back(
        {fmt::format("{}_{}", name, i + 1), GaugeKind::moving, (1.0 - share) * from + share * to});
  }
  return gauges;
}

void check_name_of_gauge(const std::string& name, const Faults& faults) {
  const auto allowed = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; };
  if (name.empty()) faults.add("name", "'name' is empty: it names columns");
  if (!std::ranges::all_of(name, allowed)) {
    faults.add("name",
               fmt::format("'name' is \"{}\": letters, digits, '_' and '-' only, it names columns", name));
  }
}

namespace {

/// Adds a fault if the name is used by one of the preceding gauges.
void check_twice(const std::string& name, std::span<const Gauge> before, const Faults& faults) {
  if (name.empty() || std::ranges::count(before, name, &Gauge::name) == 0) return;
  faults.add("name", fmt::format("two gauges are called \"{}\"", name));
}

}  // namespace

void Gauge::check(const Case& setup, const Faults& faults) const {
  check_name_of_gauge(name, faults);
  check_twice(name, {setup.gauges.data(), this}, faults);
}

void Tracers::check(const Case& setup, const Faults& faults) const {
  check_name_of_gauge(name, faults);
  std::vector<Gauge> before = setup.gauges;
  for (const Tracers* line = setup.tracers.data(); line != this; ++line) {
    for (Gauge& gauge : line->gauges()) before.push_back(std::move(gauge));
  }
  for (const Gauge& gauge : gauges()) check_twice(gauge.name, before, faults);
}

void lay_into_section(std::vector<Gauge>& gauges, std::vector<Tracers>& tracers, grid::Dimension dimension) {
  if (dimension == grid::Dimension::space) return;
  const auto lay = [&](Vector3& x) {
    const double across = dimension == grid::Dimension::axisymmetric ? std::hypot(x[1], x[2]) : x[1];
    x = Vector3(x[0], across, 0.0);
  };
  for (Gauge& gauge : gauges) lay(gauge.position);
  for (Tracers& line : tracers) {
    lay(line.from);
    lay(line.to);
  }
}

void check_places_of_gauges(const Case& setup, const Faults& faults) {
  const auto in_matter = [&](const Vector3& point) {
    return std::ranges::any_of(setup.bodies, [&](const Body& body) {
      return !body.discretization.is_bars() && setup.holds(body, point);
    });
  };
  const auto check = [&](const Gauge& gauge, const Faults& of_section, const char* key) {
    const Vector3& x = gauge.position;
    const auto add = [&](const char* what) {
      of_section.add(key, fmt::format("gauge \"{}\" at ({:.6g}, {:.6g}, {:.6g}) m {}", gauge.name, x[0], x[1],
                                      x[2], what));
    };
    bool inside = true;
    for (int a = 0; a < 3; ++a) inside &= x[a] >= setup.geometry.lower[a] && x[a] <= setup.geometry.upper(a);
    if (!inside) {
      add("is outside of the domain");
    } else if (gauge.moving() && !in_matter(x)) {
      add("moves with material, but no body is there that has some (bars do not count)");
    }
  };
  for (std::size_t i = 0; i < setup.gauges.size(); ++i) {
    check(setup.gauges[i], faults.in("gauge").in(i), "position");
  }
  for (std::size_t i = 0; i < setup.tracers.size(); ++i) {
    for (const Gauge& gauge : setup.tracers[i].gauges()) check(gauge, faults.in("tracers").in(i), "");
  }
}

}  // namespace whipple::cases
