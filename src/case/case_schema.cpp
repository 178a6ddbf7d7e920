// SPDX-License-Identifier: BSD-3-Clause
#include <nlohmann/json.hpp>

#include "src/case/case.hpp"
#include "src/case/shapes/shape.hpp"

namespace whipple::cases {

void Body::add_rest(input::Schema& table) {
  input::Schema shape = input::reference_to("shape");
  shape["description"] = "what the body fills initially; of bodies with a mesh or bars: none";
  input::add_key(table, "shape", shape);
  input::Schema with_shape, with_discretization;
  with_shape["required"].push_back("shape");
  with_discretization["required"].push_back("discretization");
  table["anyOf"].push_back(with_shape);
  table["anyOf"].push_back(with_discretization);
}

void Case::add_rest(input::Schema& table) {
  input::Schema free;
  free["description"] = "where the file comes from: free text";
  input::add_key(table, "provenance", free);
  table["required"].push_back("body");
  table["properties"]["body"]["minItems"] = 1;
  add_shapes(table["$defs"]["shape"]);
}

std::string case_schema() {
  input::Schema table;
  input::add_content<Case>(table);
  return input::schema_text(table, "Case of whipple",
                            "Case file of whipple run. Quantities are texts with a unit, \"6.58 km/s\".");
}

}  // namespace whipple::cases
