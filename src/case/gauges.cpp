// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/gauges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

namespace whipple::cases {

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

namespace {

/// The table that each of `Gauges::all` stands in.
std::vector<input::Table> tables_of(const Gauges& gauges, input::Table& root) {
  std::vector<input::Table> tables = root.list("gauge");
  const std::vector<input::Table> lines = root.list("tracers");
  for (std::size_t i = 0; i < lines.size(); ++i)
    tables.insert(tables.end(), static_cast<std::size_t>(gauges.tracers[i].count), lines[i]);
  return tables;
}

}  // namespace

Gauges read_gauges(input::Table& root) {
  Gauges gauges;
  const auto check_name = [](input::Table& table, const std::string& name) {
    const auto allowed = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; };
    if (name.empty() && table.has("name")) table.error_at("name", "'name' is empty: it names columns");
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
  std::vector<input::Table> tables = tables_of(gauges, root);
  const std::vector<Gauge> all = gauges.all();
  for (std::size_t g = 0; g < all.size(); ++g) {
    if (!all[g].name.empty() && !names.insert(all[g].name).second)
      tables[g].error_at("name", fmt::format("two gauges are called \"{}\"", all[g].name));
  }
  return gauges;
}

void check_gauges(const Gauges& gauges, input::Table& root, const grid::Geometry& geometry,
                  const std::function<bool(const Vector3&)>& in_matter) {
  std::vector<input::Table> tables = tables_of(gauges, root);
  const std::vector<Gauge> all = gauges.all();
  for (std::size_t g = 0; g < all.size(); ++g) {
    const Vector3& x = all[g].position;
    const auto fault = [&](const char* what) {
      tables[g].error_at("position", fmt::format("gauge \"{}\" at ({:.6g}, {:.6g}, {:.6g}) m {}", all[g].name,
                                                 x[0], x[1], x[2], what));
    };
    bool inside = true;
    for (int a = 0; a < 3; ++a) inside &= x[a] >= geometry.lower[a] && x[a] <= geometry.upper(a);
    if (!inside) {
      fault("is outside of the domain");
    } else if (all[g].moving() && !in_matter(x)) {
      fault("moves with matter, but no body is there that has some (bars do not count)");
    }
  }
}

}  // namespace whipple::cases
