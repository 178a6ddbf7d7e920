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

/// TOML input with all errors at once, each as "file:line:column: error: what, where, what is accepted".
namespace whipple::input {

class Table;

/// One input file. Errors are collected while its tables are read; `finish` throws them together.
class Document {
 public:
  /// Reads what people wrote: every number of a quantity needs its unit, but for 0.
  /// @throws InputError if the file is missing or is not TOML (with file:line:column).
  static Document from_file(const std::filesystem::path& path);
  /// Reads what a program wrote: a number without a unit is in SI.
  static Document from_text(const std::string& text, const std::string& name);

  Document(Document&&) noexcept;
  Document& operator=(Document&&) noexcept;
  ~Document();

  /// Overrides one key before reading, e.g. ("domain.cell_size", "0.3 mm"); missing tables are made, and
  /// list entries are addressed by number ("body.0.material"). A value that is not TOML is taken as text.
  void set(std::string_view key, std::string_view value);

  /// Takes from another document what this one does not have, key by key; its words stay with their places in that
  /// file. A table whose key `model` differs, and every list, is taken whole or not at all.
  /// @param link  key of the root that names the other document: it is taken away
  /// @param own   keys of the root that are not taken
  /// @param remarks  keys that tell of the values beside them, as their source: a table with values of its own does not
  /// take them
  void inherit(Document base, std::string_view link, std::span<const std::string_view> own,
               std::span<const std::string_view> remarks = {});
  /// Returns the document as TOML, without comments.
  [[nodiscard]] std::string text() const;

  Table root();
  [[nodiscard]] const std::filesystem::path& path() const;
  /// From here on vectors may have two components; the third is then `ParameterInfo::across`. Three components, and
  /// words that name a direction, are those of space, of which the plane is a section.
  /// @param first  direction of space (0, 1, 2) that is the first one of the plane; the next one is its second
  void set_section(int first);

  /// Adds what a check has found wrong with the values, each fault at the place of its key, or of the table
  /// nearest to it. Faults at, above or below a key that already has one are dropped: the value that was
  /// checked is not the one in the file then.
  void add(std::vector<InputFault> found);

  /// Reports every key that no reader asked for, then throws the collected errors, if any, as one InputError.
  void finish();
  /// Throws the collected errors, if any, after a few keys of a larger document were read: other keys are no errors.
  void finish_partly_read();

  struct State;

 private:
  explicit Document(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// One table of a document. Cheap to copy; valid while the document lives.
class Table {
 public:
  /// Reads the keys of a parameter table into the bound object. Missing required keys, wrong types, wrong
  /// units and values out of range become errors of the document; the object then keeps its former value.
  /// Returns whether there was no such error.
  bool read(std::span<const BoundParameter> parameters);

  template <class Owner>
  bool read(const ParameterTable<Owner>& table, Owner& owner) {
    const std::vector<BoundParameter> bound = bind(table, owner);
    return read(bound);
  }

  [[nodiscard]] bool has(std::string_view key) const;
  /// A sub-table that must exist: reports its absence and returns nothing.
  std::optional<Table> required_table(std::string_view key);
  /// A sub-table that may be missing.
  std::optional<Table> optional_table(std::string_view key);
  /// The tables of a list `[[key]]`; none if the key is missing.
  std::vector<Table> list(std::string_view key);
  /// The word under a key that selects a variant ("model", "method"): reports a missing key or a word that is
  /// not among the choices and returns an empty text.
  std::string choice(std::string_view key, std::span<const std::string> choices,
                     std::string_view fallback = {});
  /// The names of all keys that are tables, in the order of the file.
  [[nodiscard]] std::vector<std::string> table_names() const;
  /// Marks a key, with everything below it, as known (free text such as provenance).
  void accept(std::string_view key);

  /// Adds an error at this table, or at one of its keys.
  void error(const std::string& message);
  void error_at(std::string_view key, const std::string& message);
  /// "file:line:column" of a key (or of the table if the key is empty).
  [[nodiscard]] std::string where(std::string_view key = {}) const;
  /// Path of the table in the document, "body[1].shape".
  [[nodiscard]] const std::string& name() const { return name_; }
  /// Returns the path of the table as --set and InputFault::key take it, "body.1.shape".
  [[nodiscard]] std::string key_path() const;
  /// Folder of the file that the table stands in: relative paths in the input are resolved against it.
  [[nodiscard]] std::filesystem::path folder() const;

 private:
  friend class Document;
  Table(Document::State* state, void* node, std::string name)
      : state_(state), node_(node), name_(std::move(name)) {}

  Document::State* state_;
  void* node_;  // toml::table; the library's header stays out of this one
  std::string name_;
};

}  // namespace whipple::input
