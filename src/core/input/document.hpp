// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/base/parameter_table.hpp"

/// TOML input that reports all errors at once, each as "file:line:column: error: item, location, accepted values".
namespace whipple::input {

class Table;

/// Represents one input file. Errors are collected while its tables are read; `finish` throws them together.
class Document {
 public:
  /// Reads a user-written file: every number of a dimensional quantity except 0 requires a unit.
  /// @throws InputError if the file is missing or is not TOML (with file:line:column).
  static Document from_file(const std::filesystem::path& path);
  /// Reads a text written by a program: a number without a unit is in SI.
  static Document from_text(const std::string& text, const std::string& name);

  Document(Document&&) noexcept;
  Document& operator=(Document&&) noexcept;
  ~Document();

  /// Overrides one key before reading, e.g. ("domain.cell_size", "0.3 mm"); missing tables are created, and list
  /// entries are addressed by index ("body.0.material"). A value that is not TOML is read as text.
  void set(std::string_view key, std::string_view value);

  /// Inherits missing entries from another document, key by key; messages about them refer to their location in that
  /// file. A table whose key `model` differs, and every list, is either inherited completely or not at all.
  /// @param link  key of the root that refers to the other document; it is removed
  /// @param own   keys of the root that are not inherited
  /// @param remarks  keys that describe the values next to them, such as their source; a table with values of its own
  /// does not inherit them
  void inherit(Document base, std::string_view link, std::span<const std::string_view> own,
               std::span<const std::string_view> remarks = {});
  /// Returns the document as TOML, without comments.
  [[nodiscard]] std::string text() const;

  Table root();
  [[nodiscard]] const std::filesystem::path& path() const;
  /// Accepts vectors with two components from now on; the third is then `ParameterInfo::across`. Three components, and
  /// words that select a direction, refer to space, of which the plane is a section.
  /// @param first  spatial direction (0, 1, 2) that becomes the first one of the plane; the next one becomes the second
  void set_section(int first);
  /// Sets what `Table::resolution` returns.
  void set_resolution(double length);

  /// Adds faults found by a check of the values, each at the location of its key, or of the nearest existing table.
  /// Faults at, above or below a key that already has a fault are dropped, as the checked value is then not the one in
  /// the file.
  void add(std::vector<InputFault> found);

  /// Reports every key not requested by any reader, then throws the collected errors, if any, as one InputError.
  void finish();
  /// Throws the collected errors, if any, after only some keys of a larger document were read; other keys are not
  /// errors.
  void finish_partly_read();

  struct State;

 private:
  explicit Document(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// Represents one table of a document. Cheap to copy; valid while the document exists.
class Table {
 public:
  /// Reads the keys of a parameter table into the bound object. Missing required keys, wrong types, wrong units and
  /// values out of range become errors of the document, and the object keeps its previous value. Returns whether there
  /// was no such error.
  bool read(std::span<const BoundParameter> parameters);

  template <class Owner>
  bool read(const ParameterTable<Owner>& table, Owner& owner) {
    const std::vector<BoundParameter> bound = bind(table, owner);
    return read(bound);
  }

  [[nodiscard]] bool has(std::string_view key) const;
  /// Returns a required sub-table: reports its absence and then returns nothing.
  std::optional<Table> required_table(std::string_view key);
  /// Returns an optional sub-table.
  std::optional<Table> optional_table(std::string_view key);
  /// Returns the tables of a list `[[key]]`; empty if the key is missing.
  std::vector<Table> list(std::string_view key);
  /// Returns the word of a key that selects a variant ("model", "method"): reports a missing key or a word that is not
  /// among the choices and then returns an empty text.
  std::string choice(std::string_view key, std::span<const std::string> choices,
                     std::string_view fallback = {});
  /// Returns the names of all keys that are tables, in the order of the file.
  [[nodiscard]] std::vector<std::string> table_names() const;
  /// Marks a key and everything below it as known (free text such as provenance).
  void accept(std::string_view key);

  /// Adds an error at this table, or at one of its keys.
  void error(const std::string& message);
  void error_at(std::string_view key, const std::string& message);
  /// Returns "file:line:column" of a key (or of the table if the key is empty).
  [[nodiscard]] std::string where(std::string_view key = {}) const;
  /// Returns the path of the table in the document, "body[1].shape".
  [[nodiscard]] const std::string& name() const { return name_; }
  /// Returns the path of the table as used by --set and InputFault::key, "body.1.shape".
  [[nodiscard]] std::string key_path() const;
  /// Returns the folder of the file that contains the table: relative paths in the input are resolved against it.
  [[nodiscard]] std::filesystem::path folder() const;
  /// Returns the length (m) that what is read is resolved to, as the size of the cells; infinite: not known.
  [[nodiscard]] double resolution() const;

 private:
  friend class Document;
  Table(Document::State* state, void* node, std::string name)
      : state_(state), node_(node), name_(std::move(name)) {}

  Document::State* state_;
  void* node_;  // toml::table; avoids including the header of the library here
  std::string name_;
};

}  // namespace whipple::input
