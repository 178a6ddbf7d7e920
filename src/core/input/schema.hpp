// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "src/core/base/parameter_table.hpp"

/// JSON schemas (draft 2020-12) of inputs, with which editors of TOML check and complete. Only keywords that
/// mean the same since draft 6 are used, as editors know different ones.
namespace whipple::input {

using Schema = nlohmann::ordered_json;

/// Adds the keys of a parameter table to the schema of a table; keys that it does not hold are refused from
/// then on.
void add_keys(Schema& table, std::span<const BoundParameter> parameters);

template <class Owner>
void add_keys(Schema& table, const ParameterTable<Owner>& parameters) {
  Owner defaults{};
  add_keys(table, bind(parameters, defaults));
}

/// Adds one key whose value has a schema of its own.
void add_key(Schema& table, const std::string& name, const Schema& value, bool required = false);

/// A section of an input, for its schema.
struct SchemaSection {
  std::string name;
  std::string remark;
  bool is_list = false;
  bool required = false;
};

/// Adds a section: a table, or a list of tables.
/// @param fill  adds the keys of the section
void add_section(Schema& table, const SchemaSection& section, void (*fill)(Schema&));

/// Returns the value of a key that stands for a schema in the definitions: `"$ref": "#/$defs/NAME"`.
Schema reference_to(const std::string& definition);

/// Returns the text of the schema of a file.
/// @param table  of the root of the file, with its definitions
std::string schema_text(const Schema& table, const std::string& title, const std::string& description);

}  // namespace whipple::input
