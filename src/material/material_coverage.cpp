// SPDX-License-Identifier: BSD-3-Clause
#include "src/material/material_coverage.hpp"

#include "src/core/base/parameter_table.hpp"
#include "src/core/input/document.hpp"
#include "src/material/material_schema.hpp"

namespace whipple {
namespace {

ParameterTable<Coverage> coverage_keys() {
  return {text("curve", &Coverage::curve, "measured curve"),
          text("kind", &Coverage::kind, "its kind"),
          integer("points", &Coverage::points, range::positive(), "points with a prediction"),
          real("inside_68", &Coverage::inside_68, "", range::between(0.0, 1.0), "fraction within 68 %"),
          real("inside_95", &Coverage::inside_95, "", range::between(0.0, 1.0), "fraction within 95 %"),
          real("half_width", &Coverage::half_width, "", range::non_negative(), "of the constants' 95 % band"),
          real("half_width_with_form", &Coverage::half_width_with_form, "", range::non_negative(),
               "with the error of the form"),
          real("rms", &Coverage::rms, "", range::non_negative(), "of the relative deviation")};
}

}  // namespace

std::vector<Coverage> coverage_of(const Material& material) {
  std::vector<Coverage> found;
  if (material.file.empty()) return found;
  input::Document document = input::Document::from_file(material.file);
  input::Table root = document.root();
  for (input::Table& table : root.list("coverage")) {
    Coverage coverage;
    if (table.read(coverage_keys(), coverage)) found.push_back(std::move(coverage));
  }
  for (const std::string& other : material_keys()) root.accept(other);  // those of the material reader
  document.finish();
  return found;
}

}  // namespace whipple
