// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/data_set/points.hpp"

#include <fmt/format.h>

#include <map>
#include <set>
#include <type_traits>

namespace whipple::md {
namespace {

/// Calls f(protocol, table of conditions, table of results) for every record.
template <class Function>
void for_each_record(Function&& f) {
  const auto visit = [&]<class... Points>(std::type_identity<Points>...) {
    (f(Points::protocol, Points::conditions(), Points::results()), ...);
  };
  visit(std::type_identity<LatticePoint>{}, std::type_identity<ZeroPressurePoint>{},
        std::type_identity<StatePoint>{}, std::type_identity<HugoniotPoint>{},
        std::type_identity<ColdCurvePoint>{}, std::type_identity<ElasticPoint>{},
        std::type_identity<CoexistencePoint>{}, std::type_identity<HugoniostatPoint>{},
        std::type_identity<PistonPoint>{}, std::type_identity<LiquidPoint>{},
        std::type_identity<LiquidVapourPoint>{}, std::type_identity<FluidPoint>{},
        std::type_identity<QuantumPoint>{}, std::type_identity<SpallPoint>{});
}

template <class Point>
bool holds_flag(const Quantity<Point>& quantity) {
  return std::holds_alternative<bool Point::*>(quantity.member);
}

}  // namespace

std::string_view unit_of(std::string_view quantity) {
  static const std::map<std::string_view, std::string_view> units = [] {
    std::map<std::string_view, std::string_view> all;
    for_each_record([&](std::string_view, const auto& conditions, const auto& results) {
      for (const auto& one : conditions) all[one.name] = one.unit;
      for (const auto& one : results) all[one.name] = one.unit;
    });
    return all;
  }();
  const auto found = units.find(quantity);
  return found == units.end() ? std::string_view{} : found->second;
}

bool is_solid(const PointRecord& point) {
  const auto flag = point.results.find(std::string(name_of(&StatePoint::solid)));
  return flag == point.results.end() || flag->second.value > 0.5;
}

bool is_flag(std::string_view result) {
  static const std::set<std::string_view> flags = [] {
    std::set<std::string_view> names;
    for_each_record([&](std::string_view, const auto&, const auto& results) {
      for (const auto& one : results) {
        if (holds_flag(one)) names.insert(one.name);
      }
    });
    return names;
  }();
  return flags.contains(result);
}

std::string describe_points() {
  std::string text = "| protocol | entry | unit | meaning |\n| --- | --- | --- | --- |\n";
  for_each_record([&](std::string_view protocol, const auto& conditions, const auto& results) {
    std::string_view title = protocol;
    const auto add = [&](const auto& table, std::string_view kind) {
      for (const auto& one : table) {
        text += fmt::format("| {} | {}{} | {} | {} |\n", title, kind, one.name,
                            one.unit.empty() ? "1" : one.unit, one.meaning);
        title = "";
      }
    };
    add(conditions, "at ");
    add(results, "");
  });
  return text;
}

}  // namespace whipple::md
