// SPDX-License-Identifier: BSD-3-Clause
#include "src/material/material_schema.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "eos/files/models.hpp"
#include "src/core/input/schema.hpp"
#include "src/material/constitutive_catalogue.hpp"
#include "src/material/failure/catalogue.hpp"
#include "src/material/material_tables.hpp"
#include "src/material/reaction/catalogue.hpp"
#include "src/material/strength/catalogue.hpp"

namespace whipple {
namespace {

using input::Schema;

Schema list_of(Schema items) {
  Schema list;
  list["type"] = "array";
  list["items"] = std::move(items);
  return list;
}

/// Returns the schema of a table whose key `model` selects an entry of a catalogue, with the constants of that entry.
/// @param more  keys in addition to those of the model
template <class Entry>
Schema one_of(const Catalogue<Entry>& catalogue, const Schema& more = {}) {
  Schema holder;
  for (const Entry& entry : catalogue) {
    Schema table;
    table["title"] = entry.name;
    table["description"] = entry.summary;
    Schema model;
    model["const"] = entry.name;
    input::add_key(table, "model", model, true);
    input::add_keys(table, material_tables::Remarks::parameters());
    // The entry only lists its constants; nothing is built.
    static_cast<void>(entry.declare(
        [&](std::span<const BoundParameter> parameters) { input::add_keys(table, parameters); }));
    for (const auto& [key, value] : more.items()) input::add_key(table, key, value);
    holder["oneOf"].push_back(table);
  }
  return holder;
}

template <class Table>
Schema keys_of() {
  Schema table;
  input::add_keys(table, Table::parameters());
  return table;
}

/// Returns a schema without required keys, which a base may provide. Entries of lists are complete.
Schema partial(Schema schema) {
  if (schema.is_object()) {
    if (schema.contains("items")) return schema;
    schema.erase("required");
    if (schema.contains("oneOf")) {  // several variants may fit
      schema["anyOf"] = schema["oneOf"];
      schema.erase("oneOf");
    }
  }
  if (schema.is_structured()) {
    for (Schema& entry : schema) entry = partial(std::move(entry));
  }
  return schema;
}

/// Returns the schema of the root of a material file.
/// @param unreacted  schema of [eos.unreacted]
/// @param modifiers  schema of [[eos.modifier]]
Schema root_of(const Schema& unreacted, const Schema& modifiers) {
  using namespace material_tables;
  Schema more, table, free;
  more["unreacted"] = unreacted;
  more["modifier"] = modifiers;
  input::add_keys(table, Head::parameters());
  input::add_keys(table, Base::parameters());
  input::add_key(table, "eos", one_of(eos::all_models(), more), true);
  input::add_key(table, "reaction", one_of(reaction::catalogue()));
  input::add_key(table, "strength", one_of(strength::catalogue()));
  input::add_key(table, "failure", list_of(one_of(failure::catalogue())));
  input::add_key(table, "constitutive", one_of(material::catalogue()));
  input::add_key(table, "thermal", keys_of<ThermalTable>());
  input::add_key(table, "measured", keys_of<MeasuredTable>());
  free["description"] = "written by programs";
  for (const char* key : free_keys) input::add_key(table, key, free);
  return table;
}

}  // namespace

std::string describe_material() {
  using namespace material_tables;
  return fmt::format(
      "Material file (TOML). Quantities are texts with a unit, \"8.93 g/cm^3\".\n\n{}"
      "\n[eos], with 'model', 'source', 'note' and the constants of the model: whipple describe eos\n"
      "[[eos.modifier]], in order: whipple describe modifier\n"
      "[eos.unreacted], of explosives: equation of state before the reaction\n"
      "[reaction], with [eos.unreacted]: whipple describe reaction\n"
      "[strength]: whipple describe strength\n"
      "[[failure]]: whipple describe failure\n"
      "[constitutive], in place of strength and failure: whipple describe constitutive\n"
      "\n[thermal]\n{}\n[measured], compared with the equation of state\n{}",
      describe_table(Head::parameters()) + describe_table(Base::parameters()),
      describe_table(ThermalTable::parameters()), describe_table(MeasuredTable::parameters()));
}

std::string material_schema() {
  Schema all;
  const Schema unreacted = one_of(eos::all_models());
  all["$defs"]["unreacted"] = unreacted;
  all["$defs"]["part_of_unreacted"] = partial(unreacted);
  all["$defs"]["modifiers"] = list_of(one_of(eos::modifier_catalogue()));
  const Schema modifiers = input::reference_to("modifiers");
  all["if"]["required"] = {"base"};
  all["then"] = partial(root_of(input::reference_to("part_of_unreacted"), modifiers));
  all["then"]["required"] = {"name", "source", "base"};
  for (const char* table : {"thermal", "measured"})  // the source of the base does not apply
    all["then"]["properties"][table]["required"] = {"source"};
  all["else"] = root_of(input::reference_to("unreacted"), modifiers);
  return input::schema_text(all, "Material of whipple",
                            "Material file of whipple. Quantities are texts with a unit, \"8.93 g/cm^3\".");
}

std::vector<std::string> material_keys() {
  std::vector<std::string> keys;
  const Schema root = root_of({}, {});
  for (const auto& [key, value] : root.at("properties").items()) keys.push_back(key);
  return keys;
}

}  // namespace whipple
