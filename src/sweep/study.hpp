// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "src/core/base/words.hpp"
#include "src/core/input/section.hpp"

/// Studies: many runs of one case with changed keys, and one table of their results (docs/manual/sweep.md).
namespace whipple::sweep {

struct Study;
using Section = input::Section<Study, Study>;
using input::Faults;

/// Holds a number of an input and its unit as written, "4 km/s"; the unit is empty for plain numbers.
struct Number {
  double value = 0.0;
  std::string unit;

  /// Reads a number with or without a unit. @returns nothing for other texts
  static std::optional<Number> of(const std::string& text);
  /// Returns the text that an input accepts, with the shortest digits that restore the value.
  [[nodiscard]] std::string text() const;
};

/// Describes a key of the case that changes from point to point.
struct Vary {
  enum class Kind : std::uint8_t { list, steps, sampled, covariance };
  std::string key;
  std::vector<std::string> also;    ///< keys that get the same value
  std::vector<std::string> values;  ///< of a list
  std::vector<std::string> range;   ///< first and last value
  std::int64_t count = 0;           ///< of equal steps over the range; 0: sampled
  bool covariance = false;          ///< materials drawn from the covariance of the one that `key` names
  std::string where;                ///< of the key in the study, "study.toml:3:7"

  void read_rest(input::Table& table) { where = table.where("key"); }
  static ParameterTable<Vary> parameters();
  void check(const Study& study, const Faults& faults) const;
  [[nodiscard]] Kind kind() const;
  /// Returns all keys that get the value.
  [[nodiscard]] std::vector<std::string> keys() const;
};

enum class Sampling : std::uint8_t { latin_hypercube, random };
constexpr std::array<Word<Sampling>, 2> words(Sampling) {
  return {{{Sampling::latin_hypercube, "latin_hypercube"}, {Sampling::random, "random"}}};
}

/// Describes how ranges without steps and covariances are sampled, all together.
struct Sample {
  std::int64_t count = 0;
  Sampling method = Sampling::latin_hypercube;
  std::int64_t seed = 1;
  static ParameterTable<Sample> parameters();
};

enum class Take : std::uint8_t { last, largest, smallest, mean };
constexpr std::array<Word<Take>, 4> words(Take) {
  return {
      {{Take::last, "last"}, {Take::largest, "largest"}, {Take::smallest, "smallest"}, {Take::mean, "mean"}}};
}

/// Describes a result of every point.
struct Wanted {
  std::string name;        ///< measure of `whipple analyse`, history.COLUMN, gauge.COLUMN
  Take take = Take::last;  ///< of a column

  static ParameterTable<Wanted> parameters();
  void check(const Study& study, const Faults& faults) const;
  /// Returns whether it is a column of a table in time, not a measure.
  [[nodiscard]] bool is_column() const;
  /// Returns the name of its column in the table.
  [[nodiscard]] std::string title() const;
};

/// Describes a limit: the value of a key at which a quantity crosses a threshold.
struct Find {
  std::string key;
  std::vector<std::string> also, between;
  std::string quantity;
  Take take = Take::last;
  std::string crosses = "0.5";
  std::string tolerance;
  std::int64_t scan = 2;  ///< points over the range before the first halving
  std::string where;      ///< of the key in the study

  void read_rest(input::Table& table) { where = table.where("key"); }
  static ParameterTable<Find> parameters();
  void check(const Study& study, const Faults& faults) const;
  [[nodiscard]] Wanted wanted() const { return {quantity, take}; }
  [[nodiscard]] std::vector<std::string> keys() const;
};

/// Describes the numerical variants of each point.
struct Bands {
  std::vector<std::string> cell_sizes;  ///< empty: that of the case
  std::vector<double> offsets;          ///< of the grid, in cells; empty: none
  static ParameterTable<Bands> parameters();
  void check(const Study& study, const Faults& faults) const;
};

enum class Keep : std::uint8_t { all, tables };
constexpr std::array<Word<Keep>, 2> words(Keep) { return {{{Keep::all, "all"}, {Keep::tables, "tables"}}}; }

/// Describes how the points are computed.
struct Computing {
  std::int64_t jobs = 0;  ///< 0: as many as the cores allow
  std::int64_t threads = 1;
  Keep keep = Keep::all;
  std::vector<std::string> analyse;  ///< options of `whipple analyse`
  static ParameterTable<Computing> parameters();
  void check(const Study& study, const Faults& faults) const;
};

/// Holds the contents of a study file.
struct Study {
  std::string title;
  std::string case_file;  ///< as written; `case_path` resolves it
  std::vector<Vary> varied;
  Sample sample;
  std::vector<Wanted> quantities;  ///< empty: all measures
  std::optional<Find> find;
  Bands bands;
  Computing computing;

  std::filesystem::path file;  ///< of the study

  static ParameterTable<Study> parameters();
  static std::span<const Section> sections();
  void check(const Study& study, const Faults& faults) const;

  [[nodiscard]] std::filesystem::path case_path() const;
  /// Returns all keys of the case that change from point to point.
  [[nodiscard]] std::vector<std::string> keys() const;
  /// Returns all wanted results, that of the limit included.
  [[nodiscard]] std::vector<Wanted> wanted() const;
};

/// Reads a study. @throws InputError with all errors at once, each with file:line:column
Study read_study(const std::filesystem::path& path);

/// Describes all keys of a study for `whipple describe study`.
std::string describe_study();

/// Returns the JSON schema of studies, for editors.
std::string study_schema();

}  // namespace whipple::sweep
