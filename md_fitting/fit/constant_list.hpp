// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "md_fitting/elements/element_defaults.hpp"
#include "md_fitting/fit/fit_result.hpp"
#include "src/core/base/parameter_table.hpp"

namespace whipple::fit {

using elements::ElementDefaults;
using elements::NamedDefault;

/// Records the origin of each constant that is not fitted, by name.
struct Sources {
  struct Entry {
    Origin origin;
    std::string text;
    Evidence evidence = Evidence::chosen;
    double error = 0.0;
    std::string error_source{};
  };
  std::map<std::string, Entry, std::less<>> entries;

  void given(const std::string& name, const std::string& text) { entries[name] = {Origin::given, text}; }
  void measured(const std::string& name, const std::string& text) {
    entries[name] = {Origin::given, text, Evidence::measured};
  }
  void by_default(const NamedDefault& entry) {
    entries[entry.parameter] = {Origin::by_default, named(entry), entry.evidence, entry.error,
                                entry.error_source};
  }
  static std::string named(const NamedDefault& entry);
};

/// Returns the electronic heat coefficient, given by the name of a choice in the element's table (none: the first)
/// or as a quantity, J/(mol K^2).
/// @throws InputError naming the choices
double electronic_coefficient(const ElementDefaults& table, const std::optional<std::string>& choice,
                              Sources& sources);

/// Lists the constants of a bound parameter table in `fit`, each with its error or its source, and rounds them to
/// the values written to the material file. Covariances and fitted names must have been set.
/// @throws InternalError if a constant has no source
void list_constants(Fit& fit, const std::vector<BoundParameter>& table, const Sources& sources);

/// Returns a value as written in the material file, in the practical unit for its SI unit, e.g. "0.1118 cm^3/g";
/// `as_written` returns the value that it reads back to.
std::string practical_quantity(double value, const std::string& si_unit, int digits = 8);
double as_written(double value, const std::string& si_unit);

}  // namespace whipple::fit
