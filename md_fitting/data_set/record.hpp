// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "md_fitting/data_set/data_set.hpp"

/// Typed records of points: a struct with a table of its conditions and one of its results, from which the entries of
/// the database, their units, and the list in docs/theory/molecular_dynamics.md come.
namespace whipple::md {

/// Treatment of a quantity that a database does not contain, since it was written by an older version.
enum class IfMissing : std::uint8_t { error, keep_default };

/// One quantity of a point: an entry of the database, and the member of the record that holds it. Numbers without error
/// are stored with the error 0, flags as 0 or 1; an optional that is empty is not stored.
template <class Point>
struct Quantity {
  std::string_view name;
  std::string_view unit;  ///< SI; empty: dimensionless
  std::string_view meaning;
  std::variant<double Point::*, bool Point::*, Estimate Point::*, std::optional<double> Point::*,
               std::optional<Estimate> Point::*>
      member;
  IfMissing if_missing = IfMissing::error;
};

/// Returns the name of a quantity of a record.
/// @param member  of the tables, e.g. &HugoniotPoint::pressure
template <class Point, class Value>
constexpr std::string_view name_of(Value Point::* member) {
  const auto in = [member](const auto& table) -> std::string_view {
    for (const Quantity<Point>& quantity : table) {
      if (const auto* const own = std::get_if<Value Point::*>(&quantity.member)) {
        if (*own == member) return quantity.name;
      }
    }
    return {};
  };
  const std::string_view name = in(Point::results());
  return name.empty() ? in(Point::conditions()) : name;
}

/// Returns the conditions of a point as entries of the database.
template <class Point>
std::map<std::string, double> conditions_of(const Point& point) {
  std::map<std::string, double> entries;
  for (const Quantity<Point>& quantity : Point::conditions()) {
    entries[std::string(quantity.name)] = point.*std::get<double Point::*>(quantity.member);
  }
  return entries;
}

/// Returns the results of a point as entries of the database.
template <class Point>
std::map<std::string, Estimate> results_of(const Point& point) {
  std::map<std::string, Estimate> entries;
  for (const Quantity<Point>& quantity : Point::results()) {
    const auto set = [&](const Estimate& value) { entries[std::string(quantity.name)] = value; };
    std::visit(
        [&](auto member) {
          const auto& value = point.*member;
          using Value = std::remove_cvref_t<decltype(value)>;
          if constexpr (std::is_same_v<Value, Estimate>) {
            set(value);
          } else if constexpr (std::is_same_v<Value, std::optional<Estimate>>) {
            if (value) set(*value);
          } else if constexpr (std::is_same_v<Value, std::optional<double>>) {
            if (value) set({*value, 0.0});
          } else if constexpr (std::is_same_v<Value, bool>) {
            set({value ? 1.0 : 0.0, 0.0});
          } else {
            set({value, 0.0});
          }
        },
        quantity.member);
  }
  return entries;
}

/// Reads a point of the database as the record of its protocol.
/// @throws InputError naming the point and the quantity that it lacks
template <class Point>
Point read_as(const PointRecord& record) {
  Point point;
  for (const Quantity<Point>& quantity : Point::conditions()) {
    point.*std::get<double Point::*>(quantity.member) = record.condition(quantity.name);
  }
  for (const Quantity<Point>& quantity : Point::results()) {
    const bool present = record.results.contains(std::string(quantity.name));
    std::visit(
        [&](auto member) {
          auto& value = point.*member;
          using Value = std::remove_cvref_t<decltype(value)>;
          constexpr bool may_lack =
              std::is_same_v<Value, std::optional<Estimate>> || std::is_same_v<Value, std::optional<double>>;
          if (!present && (may_lack || quantity.if_missing == IfMissing::keep_default)) return;
          const Estimate estimate = record.result(quantity.name);
          if constexpr (std::is_same_v<Value, Estimate> || std::is_same_v<Value, std::optional<Estimate>>) {
            value = estimate;
          } else if constexpr (std::is_same_v<Value, bool>) {
            value = estimate.value > 0.5;
          } else {
            value = estimate.value;
          }
        },
        quantity.member);
  }
  return point;
}

/// Returns the finished points of a protocol, as `select` does, as records.
template <class Point>
std::vector<Point> select_as(std::span<const PointRecord> points,
                             std::string_view protocol = Point::protocol) {
  std::vector<Point> found;
  for (const PointRecord& record : select(points, protocol)) found.push_back(read_as<Point>(record));
  return found;
}

/// Returns a result that the computation at hand requires, whatever the record does without it.
/// @throws InputError naming the point and the result
template <class Point, class Value>
Value required(const PointRecord& record, Value Point::* member) {
  const Estimate result = record.result(name_of(member));
  if constexpr (std::is_same_v<Value, double>)
    return result.value;
  else
    return result;
}

/// Returns a condition, also of a point that failed and has no results.
template <class Point>
double condition(const PointRecord& record, double Point::* member) {
  return record.condition(name_of(member));
}

}  // namespace whipple::md
