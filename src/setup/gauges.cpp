// SPDX-License-Identifier: BSD-3-Clause
#include "src/setup/gauges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

namespace whipple::setup {

ParameterTable<Gauge> Gauge::parameters() {
  return {text("name", &Gauge::name, "name of its columns in gauges.csv"),
          choice("kind", &Gauge::kind, {"fixed", "moving"},
                 "fixed in space | moving with the particle nearest to its position at the start")
              .optional(),
          vector("position", &Gauge::position, "m", range::any(), "position, at the start")};
}

ParameterTable<Tracers> Tracers::parameters() {
  return {text("name", &Tracers::name, "name of its gauges, numbered NAME_1, NAME_2, ..."),
          vector("from", &Tracers::from, "m", range::any(), "first position at the start"),
          vector("to", &Tracers::to, "m", range::any(), "last position at the start"),
          integer("count", &Tracers::count, range::between(2, 10000), "number of moving gauges on the line")};
}

std::vector<Gauge> Gauges::all() const {
  std::vector<Gauge> gauges = points;
  for (const Tracers& line : tracers) {
    for (std::int64_t i = 0; i < line.count; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(line.count - 1);
      gauges.push_back(
          {fmt::format("{}_{}", line.name, i + 1), "moving", (1.0 - share) * line.from + share * line.to});
    }
  }
  return gauges;
}

std::string Gauges::toml() const {
  std::string text;
  for (Gauge gauge : points) {
    text += "\n[[gauge]]\n" + whipple::to_toml(whipple::bind(Gauge::parameters(), gauge));
  }
  for (Tracers line : tracers) {
    text += "\n[[tracers]]\n" + whipple::to_toml(whipple::bind(Tracers::parameters(), line));
  }
  return text;
}

Gauges read_gauges(input::Table& root) {
  Gauges gauges;
  const auto check_name = [](input::Table& table, const std::string& name) {
    const auto allowed = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; };
    if (!std::ranges::all_of(name, allowed)) {
      table.error_at(
          "name", fmt::format("'name' is \"{}\": letters, digits, '_' and '-' only, it names columns", name));
    }
  };
  for (input::Table& table : root.list("gauge")) {
    Gauge& gauge = gauges.points.emplace_back();
    table.read(Gauge::parameters(), gauge);
    check_name(table, gauge.name);
  }
  for (input::Table& table : root.list("tracers")) {
    Tracers& line = gauges.tracers.emplace_back();
    table.read(Tracers::parameters(), line);
    check_name(table, line.name);
  }
  std::set<std::string> names;
  for (const Gauge& gauge : gauges.all()) {
    if (!gauge.name.empty() && !names.insert(gauge.name).second) {
      root.error(fmt::format("two gauges are called \"{}\"", gauge.name));
    }
  }
  return gauges;
}

std::vector<std::string> gauge_faults(const Gauges& gauges, const grid::Geometry& geometry,
                                      const std::function<bool(const Vector3&)>& in_matter) {
  std::vector<std::string> faults;
  for (const Gauge& gauge : gauges.all()) {
    const Vector3& x = gauge.position;
    bool inside = true;
    for (int a = 0; a < 3; ++a) inside &= x[a] >= geometry.lower[a] && x[a] <= geometry.upper(a);
    if (!inside) {
      faults.push_back(fmt::format("gauge \"{}\" at ({:.6g}, {:.6g}, {:.6g}) m is outside of the domain",
                                   gauge.name, x[0], x[1], x[2]));
    } else if (gauge.moving() && !in_matter(x)) {
      faults.push_back(
          fmt::format("gauge \"{}\" at ({:.6g}, {:.6g}, {:.6g}) m moves with matter, but no body is "
                      "there that has some (bars do not count)",
                      gauge.name, x[0], x[1], x[2]));
    }
  }
  return faults;
}

}  // namespace whipple::setup
