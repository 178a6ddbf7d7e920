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

/// Where the constants that are not fitted come from, by name.
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

/// The electrons of the material by the name of a choice of the element's table (none: the first), or as a
/// quantity, J/(mol K^2).
/// @throws InputError naming the choices
double electronic_coefficient(const ElementDefaults& table, const std::optional<std::string>& choice,
                              Sources& sources);

/// Lists the constants of a bound parameter table in `fit`, each with its error or its source, and rounds
/// them to what the material file will hold. Covariances and fitted names must be there.
/// @throws InternalError if a constant has no source
void list_constants(Fit& fit, const std::vector<BoundParameter>& table, const Sources& sources);

/// A value as it stands in the material file, in the practical unit of its SI unit: "0.1118 cm^3/g", and the
/// value that it reads back to.
std::string practical_quantity(double value, const std::string& si_unit, int digits = 8);
double as_written(double value, const std::string& si_unit);

}  // namespace whipple::fit
