// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>

#include "src/core/base/parameter_table.hpp"
#include "src/material/material.hpp"
#include "src/material/material_file.hpp"

/// Keys of a material file that are not constants of a model, for its reader and its schema.
namespace whipple::material_tables {

/// Tables and keys of a file that programs write and the material reader ignores.
inline constexpr std::array<const char*, 6> free_keys = {"provenance",     "covariance",       "defaults",
                                                         "default_errors", "potential_spread", "coverage"};

/// Holds the free texts that every table with a model may contain.
struct Remarks {
  std::string source;
  std::string note;
  static ParameterTable<Remarks> parameters() {
    return {text("source", &Remarks::source, "where the constants come from").optional(),
            text("note", &Remarks::note, "remark").optional()};
  }
};

/// Holds the name of the material on which a file is based.
struct Base {
  std::string base;
  static ParameterTable<Base> parameters() {
    return {text("base", &Base::base,
                 "material beside this file, or of the library, that holds where this file does not say "
                 "otherwise: "
                 "its tables, key by key where their model is the same, without 'source' and 'note' beside "
                 "values of this file; lists as a whole")
                .optional()};
  }
};

struct Head : Remarks {
  std::string name;
  std::string group;
  static ParameterTable<Head> parameters() {
    return {text("name", &Head::name, "name of the material"),
            text<Head>("source", &Head::source, "where the constants come from"),
            text<Head>("note", &Head::note, "one line about the purpose or the limits").optional(),
            choice("group", &Head::group, {material_groups.begin(), material_groups.end()},
                   "where the library lists the material")
                .optional()};
  }
};

struct MeasuredTable : Measured {
  std::string source;
  static ParameterTable<MeasuredTable> parameters() {
    using M = MeasuredTable;
    return {
        text("source", &M::source, "where the values come from"),
        real<M>("melting_point", &M::melting_point, "K", range::positive(), "at 1 atm; of an alloy: solidus")
            .optional(),
        real<M>("liquidus", &M::liquidus, "K", range::positive(), "of an alloy, at 1 atm").optional(),
        real<M>("boiling_point", &M::boiling_point, "K", range::positive(), "at 1 atm").optional()};
  }
};

struct ThermalTable {
  double conductivity = 0.0;
  double taylor_quinney = 1.0;
  std::string source;
  static ParameterTable<ThermalTable> parameters() {
    using T = ThermalTable;
    return {
        text("source", &T::source, "where the values come from"),
        real("conductivity", &T::conductivity, "W/(m K)", range::non_negative(),
             "heat conductivity, for runs with heat conduction")
            .optional(),
        real("taylor_quinney", &T::taylor_quinney, "", Range{.lower = 0.0, .upper = 1.0, .lower_open = true},
             "fraction of the plastic work that becomes heat; the rest is stored as cold work until the "
             "material melts")
            .optional()};
  }
};

}  // namespace whipple::material_tables
