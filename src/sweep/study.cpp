// SPDX-License-Identifier: BSD-3-Clause
#include "src/sweep/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "src/core/base/error.hpp"
#include "src/core/base/units.hpp"

namespace whipple::sweep {
namespace {

/// Adds a fault unless a list holds two numbers of one kind of unit, the first below the second.
void check_range(const std::vector<std::string>& range, const char* key, const Faults& faults) {
  const std::optional<Number> first = range.size() == 2 ? Number::of(range[0]) : std::nullopt;
  const std::optional<Number> last = range.size() == 2 ? Number::of(range[1]) : std::nullopt;
  if (!first || !last) {
    faults.add(key,
               fmt::format("'{}' is no pair of numbers: expected for example [\"1 km/s\", \"2 km/s\"]", key));
    return;
  }
  try {
    if (units::convert(last->value, last->unit, first->unit) > first->value) return;
    faults.add(key, fmt::format("'{}' must increase: {} is not below {}", key, range[0], range[1]));
  } catch (const InputError& error) {
    faults.add(key, fmt::format("'{}': {}", key, error.what()));
  }
}

/// Adds faults for keys that are set twice: the same key, or one of a table that varies as a whole. A material drawn from
/// its covariance may have further keys.
void check_keys(const Study& study, const Faults& faults) {
  struct Key {
    std::string name, place;  // place in the study
    bool is_whole;
  };
  std::vector<Key> all;
  for (std::size_t v = 0; v < study.varied.size(); ++v) {
    for (const std::string& key : study.varied[v].keys())
      all.push_back({key, fmt::format("vary.{}.key", v), !study.varied[v].covariance});
  }
  if (study.find)
    for (const std::string& key : study.find->keys()) all.push_back({key, "find.key", true});
  for (auto one = all.begin(); one != all.end(); ++one) {
    for (auto other = all.begin(); other != all.end(); ++other) {
      if (other < one && other->name == one->name)
        faults.add(one->place, fmt::format("'{}' varies twice", one->name));
      if (other->is_whole && one->name.starts_with(other->name + "."))
        faults.add(one->place,
                   fmt::format("'{}' lies in '{}', which varies as a whole", one->name, other->name));
    }
  }
}

}  // namespace

std::optional<Number> Number::of(const std::string& text) {
  Number number;
  const char* const end = text.data() + text.size();
  const auto [rest, fault] = std::from_chars(text.data(), end, number.value);
  if (fault != std::errc() || !std::isfinite(number.value)) return std::nullopt;
  const std::size_t unit = text.find_first_not_of(' ', static_cast<std::size_t>(rest - text.data()));
  if (unit != std::string::npos) number.unit = text.substr(unit);
  return number;
}

std::string Number::text() const {
  return unit.empty() ? fmt::format("{}", value) : fmt::format("{} {}", value, unit);
}

ParameterTable<Vary> Vary::parameters() {
  return {
      text("key", &Vary::key,
           "key of the case as of `whipple run --set`; body.0.material.eos.gruneisen: of its material"),
      text_list("also", &Vary::also, {}, "further keys that get the same value").optional(),
      text_list("values", &Vary::values, {}, "a list of values").optional(),
      text_list("range", &Vary::range, {},
                "or first and last value, with `count` in equal steps, else sampled")
          .optional(),
      integer("count", &Vary::count, range::between(0, 100000), "number of values over the range; 0: sampled")
          .optional(),
      boolean("covariance", &Vary::covariance,
              "or samples of the fitted material of the body, from its covariance: key = \"body.0.material\"")
          .optional()};
}

Vary::Kind Vary::kind() const {
  if (covariance) return Kind::covariance;
  if (!values.empty()) return Kind::list;
  return count > 0 ? Kind::steps : Kind::sampled;
}

std::vector<std::string> Vary::keys() const {
  std::vector<std::string> all = {key};
  all.insert(all.end(), also.begin(), also.end());
  return all;
}

void Vary::check(const Study& study, const Faults& faults) const {
  if (key.empty()) faults.add("key", "'key' is empty: expected a key of the case, \"body.0.velocity.2\"");
  const int given = (values.empty() ? 0 : 1) + (range.empty() ? 0 : 1) + (covariance ? 1 : 0);
  if (given != 1) {
    faults.add("", "expected one of 'values', 'range' and 'covariance'");
    return;
  }
  if (!range.empty()) check_range(range, "range", faults);
  if (count == 1) faults.add("count", "'count' is 1: expected at least 2 values over the range");
  if (range.empty() && count != 0) faults.add("count", "'count' belongs to 'range'");
  const bool draws = kind() == Kind::sampled || kind() == Kind::covariance;
  if (draws && study.sample.count == 0)
    faults.add("", fmt::format("'{}' is sampled: set [sample] count", key));
  if (covariance && !key.ends_with(".material"))
    faults.add("key", "'covariance' draws materials: expected the key of one, \"body.0.material\"");
}

ParameterTable<Sample> Sample::parameters() {
  return {
      integer("count", &Sample::count, range::between(0, 1000000), "number of samples").optional(),
      choice("method", &Sample::method,
             "each range in as many strata as samples, one sample in each | independent samples")
          .optional(),
      integer("seed", &Sample::seed, range::between(0, 1e15), "of the samples; equal seeds, equal samples")
          .optional()};
}

ParameterTable<Wanted> Wanted::parameters() {
  return {
      text("name", &Wanted::name,
           "measure of whipple analyse (\"perforated.wall\"), or a column in time: \"history.momentum_z\", "
           "\"gauge.rear.velocity_z\""),
      choice("take", &Wanted::take, "of a column: its last value | largest | smallest | mean of its rows")
          .optional()};
}

bool Wanted::is_column() const { return name.starts_with("history.") || name.starts_with("gauge."); }

std::string Wanted::title() const {
  return take == Take::last ? name : fmt::format("{} {}", word_of(take), name);
}

void Wanted::check(const Study& /*study*/, const Faults& faults) const {
  if (name.empty()) faults.add("name", "'name' is empty");
  if (!is_column() && take != Take::last)
    faults.add("take", "'take' is of columns in time (history., gauge.): a measure has one value");
}

ParameterTable<Find> Find::parameters() {
  return {
      text("key", &Find::key, "key of the case that is sought"),
      text_list("also", &Find::also, {}, "further keys that get the same value").optional(),
      text_list("between", &Find::between, {}, "first and last value: the limit lies between them"),
      text("quantity", &Find::quantity, "as `name` of [[quantity]]"),
      choice("take", &Find::take, "as of [[quantity]]").optional(),
      text("crosses", &Find::crosses, "threshold of the quantity, with its unit; 0.5 for verdicts of 0 and 1")
          .optional(),
      text("tolerance", &Find::tolerance,
           "width of the interval at which the search ends, in a unit of the key"),
      integer("scan", &Find::scan, range::between(2, 10000),
              "points over the range first: more of them see verdicts that change several times")
          .optional()};
}

std::vector<std::string> Find::keys() const {
  std::vector<std::string> all = {key};
  all.insert(all.end(), also.begin(), also.end());
  return all;
}

void Find::check(const Study& study, const Faults& faults) const {
  check_range(between, "between", faults);
  wanted().check(study, faults);
  if (!Number::of(crosses))
    faults.add("crosses", fmt::format("'crosses' is \"{}\": expected a number", crosses));
  const std::optional<Number> width = Number::of(tolerance);
  if (!width || !(width->value > 0.0)) {
    faults.add("tolerance",
               fmt::format("'tolerance' is \"{}\": expected a number > 0 with its unit", tolerance));
  } else if (const auto first = between.empty() ? std::nullopt : Number::of(between[0])) {
    try {
      static_cast<void>(units::convert(width->value, width->unit, first->unit));
    } catch (const InputError& error) {
      faults.add("tolerance", fmt::format("'tolerance': {}", error.what()));
    }
  }
}

ParameterTable<Bands> Bands::parameters() {
  return {
      text_list("cell_sizes", &Bands::cell_sizes, {}, "each point with each of them").optional(),
      real_list("offsets", &Bands::offsets, "", range::between(0.0, 0.999),
                "each point with the grid moved by so many cells, along axes without walls and mirror planes")
          .optional()};
}

void Bands::check(const Study& study, const Faults& faults) const {
  for (const std::string& size : cell_sizes) {
    const std::optional<Number> number = Number::of(size);
    try {
      if (number) static_cast<void>(units::convert(number->value, number->unit, "m"));
    } catch (const InputError& error) {
      faults.add("cell_sizes", fmt::format("\"{}\": {}", size, error.what()));
    }
    if (!number) faults.add("cell_sizes", fmt::format("\"{}\" is no length", size));
  }
  const std::vector<std::string> keys = study.keys();
  for (const std::string& key : keys) {
    if (!offsets.empty() && (key + ".").starts_with("domain."))
      faults.add("offsets", fmt::format("'offsets' move the domain, which '{}' changes", key));
  }
  if (!cell_sizes.empty() && std::ranges::count(keys, "domain.cell_size") > 0)
    faults.add("cell_sizes", "'domain.cell_size' varies as well");
}

ParameterTable<Computing> Computing::parameters() {
  return {
      integer("jobs", &Computing::jobs, range::between(0, 4096),
              "points computed side by side; bounded by cores and memory")
          .optional("cores / threads"),
      integer("threads", &Computing::threads, range::between(1, 4096), "of each point").optional(),
      choice("keep", &Computing::keep,
             "whole run folders | without snapshots and checkpoints, once a point is measured")
          .optional(),
      text_list("analyse", &Computing::analyse, {}, "options of whipple analyse: [\"--witness\", \"200 mm\"]")
          .optional()};
}

ParameterTable<Study> Study::parameters() {
  return {text("title", &Study::title, "one line: what is studied").optional(),
          text("case", &Study::case_file, "the case, in the folder of the study or with a path")};
}

void Computing::check(const Study& /*study*/, const Faults& faults) const {
  constexpr std::array<std::string_view, 3> others = {"--output", "--json", "--help"};
  for (const std::string& option : analyse) {
    const std::string name = option.substr(0, option.find('='));
    const bool is_short = name.starts_with('-') && !name.starts_with("--");
    if (is_short || std::ranges::count(others, name) > 0)
      faults.add("analyse", fmt::format("'{}' is no option that measures", option));
  }
}

std::span<const Section> Study::sections() {
  static const std::vector<Section> all = {
      input::section<&Study::varied, Study>("vary"),
      input::section<&Study::sample, Study>("sample", ", of ranges without `count`, and of covariances"),
      input::section<&Study::quantities, Study>("quantity",
                                                ", columns of the table; without any: all measures"),
      input::section<&Study::find, Study>("find", ", a limit"),
      input::section<&Study::bands, Study>("bands", ", numerical variants of every point"),
      input::section<&Study::computing, Study>("run")};
  return all;
}

std::vector<std::string> Study::keys() const {
  std::vector<std::string> all = find ? find->keys() : std::vector<std::string>();
  for (const Vary& vary : varied) {
    const std::vector<std::string> own = vary.keys();
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

void Study::check(const Study& /*study*/, const Faults& faults) const {
  if (varied.empty() && !find) faults.add("", "nothing varies: expected [[vary]] or [find]");
  for (auto one = quantities.begin(); one != quantities.end(); ++one) {
    if (std::ranges::count(quantities.begin(), one, one->title(), &Wanted::title) > 0)
      faults.add("quantity", fmt::format("the quantity '{}' is wanted twice", one->title()));
  }
  check_keys(*this, faults);
}

std::filesystem::path Study::case_path() const { return file.parent_path() / case_file; }

std::vector<Wanted> Study::wanted() const {
  std::vector<Wanted> all = quantities;
  if (find && std::ranges::count(all, find->wanted().title(), &Wanted::title) == 0)
    all.push_back(find->wanted());
  return all;
}

Study read_study(const std::filesystem::path& path) {
  input::Document document = input::Document::from_file(path);
  Study study;
  study.file = path;
  input::Table root = document.root();
  input::read_content(study, study, root);
  std::vector<InputFault> faults;
  input::check_content(study, study, Faults(faults));
  document.add(std::move(faults));
  document.finish();
  return study;
}

std::string describe_study() {
  return "Study file (TOML): many runs of a case (docs/manual/sweep.md). Values are texts, with their unit: "
         "\"4 km/s\", \"0.3\".\n\n" +
         input::describe_content<Study>("");
}

std::string study_schema() {
  input::Schema table;
  input::add_content<Study>(table);
  return input::schema_text(table, "Study of whipple", "Study file of whipple sweep: many runs of one case.");
}

}  // namespace whipple::sweep
