// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

/// Text of JSON documents and back, compiled once: the library is a template, and its parser and writer are large.
namespace whipple {

/// Parses a document; keys are sorted.
/// @throws nlohmann::json::parse_error with the place of the fault
nlohmann::json parse_json(std::string_view text);
/// Parses a document; keys keep their order.
/// @throws nlohmann::ordered_json::parse_error with the place of the fault
nlohmann::ordered_json parse_ordered_json(std::string_view text);

/// Writes a document. Bytes that are not UTF-8, as in names of files, are replaced by U+FFFD.
/// @param indent  spaces per level; negative: on one line
std::string json_text(const nlohmann::json& document, int indent);
std::string json_text(const nlohmann::ordered_json& document, int indent);

}  // namespace whipple
