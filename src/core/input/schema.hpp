// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "src/core/base/parameter_table.hpp"

/// JSON schemas (draft 2020-12) of inputs, used by TOML editors for checks and completion. Only keywords with the same
/// meaning since draft 6 are used, as editors support different drafts.
namespace whipple::input {

using Schema = nlohmann::ordered_json;

/// Adds the keys of a parameter table to the schema of a table; other keys are rejected from then on.
void add_keys(Schema& table, std::span<const BoundParameter> parameters);

template <class Owner>
void add_keys(Schema& table, const ParameterTable<Owner>& parameters) {
  Owner defaults{};
  add_keys(table, bind(parameters, defaults));
}

/// Adds one key whose value is described by a schema.
void add_key(Schema& table, const std::string& name, const Schema& value, bool required = false);

/// Describes a section of an input for its schema.
struct SchemaSection {
  std::string name;
  std::string remark;
  bool is_list = false;
  bool required = false;
};

/// Adds a section: a table, or a list of tables.
/// @param fill  adds the keys of the section
void add_section(Schema& table, const SchemaSection& section, void (*fill)(Schema&));

/// Returns the schema that refers to one of the definitions: `"$ref": "#/$defs/NAME"`.
Schema reference_to(const std::string& definition);

/// Returns the text of the schema of a file.
/// @param table  root of the file, with its definitions
std::string schema_text(const Schema& table, const std::string& title, const std::string& description);

}  // namespace whipple::input
