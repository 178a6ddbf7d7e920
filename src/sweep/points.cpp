// SPDX-License-Identifier: BSD-3-Clause
#include "src/sweep/points.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>

#include "src/case/build/placement.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/hash.hpp"
#include "src/core/base/log.hpp"
#include "src/core/base/temporary_folder.hpp"
#include "src/core/base/text.hpp"
#include "src/core/base/units.hpp"
#include "src/core/input/document.hpp"
#include "src/material/material_file.hpp"
#include "src/material/material_samples.hpp"
#include "src/sweep/quantities.hpp"
#include "src/sweep/sampling.hpp"

namespace whipple::sweep {
namespace {

using Changes = std::vector<std::pair<std::string, std::string>>;

constexpr std::string_view of_material = ".material.";
constexpr std::string_view folder_mark = "MATERIALS/";  // replaced by the folder of the changed materials

/// Returns the body that a key begins with, "body.0.material".
/// @throws InputError if it names none of the case
std::size_t body_of(const cases::Case& setup, const std::string& key) {
  constexpr std::string_view start = "body.";
  std::size_t body = setup.bodies.size();
  if (key.starts_with(start)) {
    const char* const last = key.data() + key.size();
    const auto [end, error] = std::from_chars(key.data() + start.size(), last, body);
    if (error != std::errc{} || end == last || *end != '.') body = setup.bodies.size();
  }
  if (body < setup.bodies.size()) return body;
  throw InputError(fmt::format("'{}': the case has the bodies 0 to {}", key, setup.bodies.size() - 1));
}

/// Changes keys of the materials of a point, in a copy of the material file for each body.
class MaterialChanges {
 public:
  explicit MaterialChanges(const cases::Case& setup) : setup_(setup) {}

  /// @param inside  key within the material file, "eos.gruneisen"
  void set(std::size_t body, const std::string& inside, const std::string& value) {
    of_body_[body].emplace_back(inside, value);
  }

  void add_to(Point& point) const {
    for (const auto& [body, changes] : of_body_) {
      const std::filesystem::path base =
          find_material(setup_.bodies[body].material, setup_.file.parent_path());
      input::Document document = input::Document::from_text(material_text(base), base.string());
      for (const auto& [key, value] : changes) document.set(key, value);
      const std::string text = document.text();
      const std::string name = fmt::format("{}_{}.toml", base.stem().string(), sha256(text).substr(0, 12));
      point.materials[name] = text;
      point.changes.emplace_back(fmt::format("body.{}.material", body), std::string(folder_mark) + name);
    }
  }

 private:
  const cases::Case& setup_;
  std::map<std::size_t, Changes> of_body_;
};

/// Holds the values of the variables of one [[vary]] at each of its points.
struct Values {
  std::vector<Variable> variables;
  std::vector<std::vector<std::string>> texts;  ///< of each point, for each variable
};

Number in_range(const Vary& vary, double share) {
  const Number first = *Number::of(vary.range[0]), last = *Number::of(vary.range[1]);
  const double end = units::convert(last.value, last.unit, first.unit);
  return {share >= 1.0 ? end : first.value + share * (end - first.value), first.unit};
}

Values listed(const Vary& vary) {
  Values all{.variables = {{.name = vary.key}}, .texts = {}};
  if (vary.kind() == Vary::Kind::steps) {
    for (std::int64_t i = 0; i < vary.count; ++i)
      all.texts.push_back(
          {in_range(vary, static_cast<double>(i) / static_cast<double>(vary.count - 1)).text()});
  } else {
    for (const std::string& value : vary.values) all.texts.push_back({value});
  }
  Variable& variable = all.variables.front();
  const std::optional<Number> first = Number::of(all.texts.front().front());
  if (first) variable.unit = first->unit;
  for (const auto& text : all.texts) {
    const std::optional<Number> number = Number::of(text.front());
    variable.is_number = variable.is_number && number && number->unit == variable.unit;
  }
  if (!variable.is_number) variable.unit.clear();
  return all;
}

/// Draws the constants of a fitted material.
Values drawn(const Vary& vary, const Study& study, const cases::Case& base,
             const std::function<bool()>& is_asked_to_end) {
  const std::size_t body = body_of(base, vary.key);
  const MaterialSamples samples =
      sample_material(base.bodies[body].material, static_cast<int>(study.sample.count),
                      static_cast<std::uint64_t>(study.sample.seed), ErrorTier::fit, base.file.parent_path(),
                      is_asked_to_end);
  if (is_asked_to_end()) return {};
  Values all;
  for (const auto& [key, value] : samples.changes.front()) {
    const std::optional<Number> number = Number::of(value);
    all.variables.push_back({.name = vary.key + "." + key,
                             .unit = number ? number->unit : "",
                             .is_number = number.has_value(),
                             .is_sampled = true});
  }
  for (const auto& changes : samples.changes) {
    std::vector<std::string>& texts = all.texts.emplace_back();
    for (const auto& [key, value] : changes) texts.push_back(value);
  }
  return all;
}

/// Combines the lists of values: every one with every one, the last fastest.
std::vector<std::vector<std::string>> product(
    const std::vector<std::vector<std::vector<std::string>>>& lists) {
  std::vector<std::vector<std::string>> all = {{}};
  for (const auto& list : lists) {
    std::vector<std::vector<std::string>> longer;
    for (const auto& begin : all) {
      for (const auto& values : list) {
        longer.push_back(begin);
        longer.back().insert(longer.back().end(), values.begin(), values.end());
      }
    }
    all = std::move(longer);
  }
  return all;
}

/// Returns the values of all sampled ranges and covariances, sample by sample.
std::vector<Values> sampled(const Study& study, const cases::Case& base,
                            const std::function<bool()>& is_asked_to_end) {
  std::vector<const Vary*> ranges;
  for (const Vary& vary : study.varied)
    if (vary.kind() == Vary::Kind::sampled) ranges.push_back(&vary);
  const auto count = static_cast<std::size_t>(study.sample.count);
  const auto seed = static_cast<std::uint64_t>(study.sample.seed);
  const auto shares = study.sample.method == Sampling::random ? random_samples(count, ranges.size(), seed)
                                                              : latin_hypercube(count, ranges.size(), seed);
  std::vector<Values> all;
  for (std::size_t r = 0; r < ranges.size(); ++r) {
    Values& values = all.emplace_back();
    values.variables = {{.name = ranges[r]->key,
                         .unit = Number::of(ranges[r]->range[0])->unit,
                         .is_number = true,
                         .is_sampled = true}};
    for (std::size_t i = 0; i < count; ++i)
      values.texts.push_back({in_range(*ranges[r], shares[i][r]).text()});
  }
  for (const Vary& vary : study.varied)
    if (vary.kind() == Vary::Kind::covariance) all.push_back(drawn(vary, study, base, is_asked_to_end));
  return all;
}

/// Returns all keys that a variable sets, those of `also` included.
std::vector<std::string> keys_of(const Study& study, const std::string& variable) {
  const auto added = [&](const std::string& key, const std::vector<std::string>& also) {
    std::vector<std::string> keys = {variable};
    for (const std::string& other : also) keys.push_back(other + variable.substr(key.size()));
    return keys;
  };
  for (const Vary& vary : study.varied) {
    const bool of_samples = vary.covariance && variable.starts_with(vary.key + ".");
    if (variable == vary.key || of_samples) return added(vary.key, vary.also);
  }
  return study.find && study.find->key == variable ? study.find->keys() : std::vector{variable};
}

/// Returns the keys that move the grid by a part of a cell. Corners are given whole: those of a section have two
/// components then, along its own directions, however many the case has.
Changes moved_grid(const cases::Case& base, double cells, double cell_size) {
  const std::array<grid::Boundary, 6> faces = base.domain.boundary.in_order();
  const std::size_t dimensions = base.domain.is_planar() ? 2 : 3;
  std::vector<std::string> lower, upper;
  bool moves = false;
  for (std::size_t a = 0; a < dimensions; ++a) {
    const bool is_radius = base.domain.dimension == grid::Dimension::axisymmetric && a == 1;
    const bool is_free =
        !is_radius && faces[2 * a] == grid::Boundary::outflow && faces[2 * a + 1] == grid::Boundary::outflow;
    const double by = is_free ? cells * cell_size : 0.0;
    const auto axis = static_cast<Eigen::Index>(a);
    lower.push_back(fmt::format("\"{} m\"", base.domain.lower[axis] + by));
    upper.push_back(fmt::format("\"{} m\"", base.domain.upper[axis] + by));
    moves = moves || is_free;
  }
  if (!moves) return {};
  return {{"domain.lower", fmt::format("[{}]", fmt::join(lower, ", "))},
          {"domain.upper", fmt::format("[{}]", fmt::join(upper, ", "))}};
}

/// Fills in changes and materials from the values of a point and its variant.
void set_changes(const Plan& plan, Point& point) {
  point.changes.clear();
  point.materials.clear();
  MaterialChanges materials(plan.base);
  for (std::size_t v = 0; v < plan.variables.size(); ++v) {
    for (const std::string& key : keys_of(plan.study, plan.variables[v].name)) {
      const std::size_t inside = key.find(of_material);
      if (inside == std::string::npos) {
        point.changes.emplace_back(key, point.texts[v]);
      } else {
        materials.set(body_of(plan.base, key), key.substr(inside + of_material.size()), point.texts[v]);
      }
    }
  }
  materials.add_to(point);
  double cell_size = plan.base.domain.cell_size;
  if (!point.cell_size.empty()) {
    cell_size = units::parse_quantity(point.cell_size, "m");
    point.changes.emplace_back("domain.cell_size", point.cell_size);
  }
  if (point.offset == 0.0) return;
  const Changes moves = moved_grid(plan.base, point.offset, cell_size);
  point.changes.insert(point.changes.end(), moves.begin(), moves.end());
}

/// Returns the digest of the complete input of a case: all keys, and the contents of its materials.
std::string digest_of(const cases::Case& setup) {
  std::vector<std::string> of_body;
  std::map<const Material*, std::string> known;
  for (const auto& material : setup.materials) {
    std::string& digest = known[material.get()];
    if (digest.empty()) {
      std::string text = material_text(material->file);
      for (const std::filesystem::path& companion : material->companions)
        text += sha256_of_file(material->file.parent_path() / companion);
      digest = sha256(text);
    }
    of_body.push_back(digest);
  }
  return sha256(cases::to_toml(setup, of_body));
}

/// Returns where the study names the key of a variable.
std::string where_of(const Study& study, const std::string& variable) {
  for (const Vary& vary : study.varied) {
    if (vary.key == variable || (vary.covariance && variable.starts_with(vary.key + "."))) return vary.where;
  }
  return study.find ? study.find->where : study.file.string();
}

/// Returns whether one key is the other or contains it.
bool are_related(std::string_view one, std::string_view other) {
  const std::string_view shorter = one.size() < other.size() ? one : other;
  const std::string_view longer = one.size() < other.size() ? other : one;
  return longer.starts_with(shorter) &&
         (shorter.empty() || shorter.size() == longer.size() || longer[shorter.size()] == '.');
}

/// Returns a line per variable that sets a key at, above or below the one at fault.
/// @param file  to which the key belongs, for the message
std::string lines_of(const Plan& plan, const Point& point, const std::string& key, const std::string& file,
                     const std::string& text) {
  std::string lines;
  for (std::size_t v = 0; v < plan.variables.size(); ++v) {
    const std::string& variable = plan.variables[v].name;
    const std::vector<std::string> keys = keys_of(plan.study, variable);
    if (std::ranges::none_of(keys, [&](const std::string& own) { return are_related(own, key); })) continue;
    lines += fmt::format("{}: error: '{}' = {}, in {}: {}\n", where_of(plan.study, variable), variable,
                         toml_string(point.texts[v]), file, text);
  }
  return lines;
}

/// Returns the faults of a point: file, line and key of the study that set what is wrong, and the file that it changes.
/// @param error    of its case
/// @param scratch  folder of its materials, which the reader knows nothing of
std::string faults_of(const Plan& plan, const Point& point, const InputError& error,
                      const std::filesystem::path& scratch) {
  std::string lines;
  std::set<std::string> told;
  for (const auto& [key, value] : point.changes) {
    if (!value.starts_with(folder_mark)) continue;
    const std::filesystem::path copy = scratch / value.substr(folder_mark.size());
    if (!std::filesystem::exists(copy) || !told.insert(copy.string()).second) continue;
    const std::filesystem::path base =
        find_material(plan.base.bodies[body_of(plan.base, key)].material, plan.base.file.parent_path());
    try {
      require_usable(read_material(copy));
    } catch (const InputError& of_material) {
      for (const InputFault& fault : of_material.faults()) {
        const std::string below = fault.key.empty() ? key : key + "." + fault.key;
        const std::string copied = copy.string() + ": error: ";
        const std::string text =
            fault.text.starts_with(copied) ? fault.text.substr(copied.size()) : fault.text;
        lines += lines_of(plan, point, below, base.string(), text);
      }
    }
  }
  if (lines.empty()) {
    for (const InputFault& fault : error.faults())
      if (!fault.key.empty()) lines += lines_of(plan, point, fault.key, plan.base.file.string(), fault.text);
  }
  if (!lines.empty()) return lines.substr(0, lines.size() - 1);
  std::string values;
  for (std::size_t v = 0; v < plan.variables.size(); ++v)
    values += fmt::format("{}{} = {}", v == 0 ? "" : ", ", plan.variables[v].name, point.texts[v]);
  return fmt::format("{}: error: at {}:\n{}", plan.study.file.string(), values, error.what());
}

/// Reads the case of a point: sets its digest. @returns the memory that it is expected to take, bytes
double settle(const Plan& plan, Point& point, const std::filesystem::path& scratch) {
  try {
    set_changes(plan, point);
    const log::WarningsAside aside;  // each point's own run repeats them
    const cases::Case setup = cases::read_case(plan.base.file, changes_in(point, scratch));
    point.digest = digest_of(setup);
    return cases::expected_memory(setup);
  } catch (const InputError& error) {
    throw InputError(faults_of(plan, point, error, scratch));
  }
}

/// Checks that no key is set by two variables: constants drawn from a covariance may be varied as well.
void check_single(const Plan& plan) {
  std::map<std::string, std::string> known;
  for (const Variable& variable : plan.variables) {
    for (const std::string& key : keys_of(plan.study, variable.name)) {
      const auto [first, is_new] = known.emplace(key, variable.name);
      if (!is_new)
        throw InputError(fmt::format("{}: error: '{}' varies twice, as '{}' and as '{}'",
                                     plan.study.file.string(), key, first->second, variable.name));
    }
  }
}

/// Returns the values of the sought key before the first halving; one empty text without a limit.
std::vector<std::string> scan_of(const Study& study) {
  if (!study.find) return {""};
  Vary range;
  range.range = study.find->between;
  std::vector<std::string> texts;
  for (std::int64_t i = 0; i < study.find->scan; ++i)
    texts.push_back(
        in_range(range, static_cast<double>(i) / static_cast<double>(study.find->scan - 1)).text());
  return texts;
}

double number_of(const Variable& variable, const std::string& text) {
  return variable.is_number ? Number::of(text)->value : std::numeric_limits<double>::quiet_NaN();
}

/// Lists the values of all variables but the sought one, in the order of the groups; none if it is asked to end.
std::vector<std::vector<std::string>> groups_of(Plan& plan, const std::function<bool()>& is_asked_to_end) {
  std::vector<std::vector<std::vector<std::string>>> lists;
  for (const Vary& vary : plan.study.varied) {
    if (vary.kind() != Vary::Kind::list && vary.kind() != Vary::Kind::steps) continue;
    const Values values = listed(vary);
    plan.variables.insert(plan.variables.end(), values.variables.begin(), values.variables.end());
    lists.push_back(values.texts);
  }
  const std::vector<Values> samples = sampled(plan.study, plan.base, is_asked_to_end);
  if (is_asked_to_end()) return {};
  if (!samples.empty()) {
    std::vector<std::vector<std::string>> together(static_cast<std::size_t>(plan.study.sample.count));
    for (const Values& values : samples) {
      plan.variables.insert(plan.variables.end(), values.variables.begin(), values.variables.end());
      for (std::size_t i = 0; i < together.size(); ++i)
        together[i].insert(together[i].end(), values.texts[i].begin(), values.texts[i].end());
    }
    lists.push_back(std::move(together));
  }
  return product(lists);
}

}  // namespace

std::vector<std::pair<std::string, std::string>> changes_in(const Point& point,
                                                            const std::filesystem::path& folder) {
  for (const auto& [name, text] : point.materials) write_text_atomically(folder / name, text);
  Changes changes = point.changes;
  for (auto& [key, value] : changes) {
    if (value.starts_with(folder_mark))
      value = (std::filesystem::absolute(folder) / value.substr(folder_mark.size())).string();
  }
  return changes;
}

std::optional<Plan> make_plan(const std::filesystem::path& file,
                              const std::function<bool()>& is_asked_to_end) {
  Plan plan{.study = read_study(file), .base = {}, .variables = {}, .points = {}};
  const Study& study = plan.study;
  plan.base = cases::read_case(study.case_path(), {});
  check_quantities(plan);
  const std::vector<std::vector<std::string>> groups = groups_of(plan, is_asked_to_end);
  if (is_asked_to_end()) return std::nullopt;
  if (study.find)
    plan.variables.push_back({.name = study.find->key, .unit = Number::of(study.find->between[0])->unit});
  check_single(plan);
  const std::vector<std::string> cells =
      study.bands.cell_sizes.empty() ? std::vector<std::string>{""} : study.bands.cell_sizes;
  const std::vector<double> offsets = study.bands.offsets.empty() ? std::vector{0.0} : study.bands.offsets;
  const TemporaryFolder scratch;
  std::set<std::string> known;
  for (std::size_t group = 0; group < groups.size(); ++group) {
    for (const std::string& cell : cells) {
      for (const double offset : offsets) {
        for (const std::string& sought : scan_of(study)) {
          if (is_asked_to_end()) return std::nullopt;
          Point point;
          point.group = group;
          point.cell_size = cell;
          point.offset = offset;
          point.texts = groups[group];
          if (study.find) point.texts.push_back(sought);
          for (std::size_t v = 0; v < point.texts.size(); ++v)
            point.numbers.push_back(number_of(plan.variables[v], point.texts[v]));
          plan.most_memory = std::max(plan.most_memory, settle(plan, point, scratch.path()));
          if (!known.insert(point.digest).second)
            log::warning("two points of the study are the same computation: {}",
                         fmt::join(point.texts, ", "));
          plan.points.push_back(std::move(point));
        }
      }
    }
  }
  return plan;
}

Point with_sought(const Plan& plan, const Point& point, double value) {
  Point next = point;
  next.texts.back() = Number{value, plan.variables.back().unit}.text();
  next.numbers.back() = value;
  const TemporaryFolder scratch;
  static_cast<void>(settle(plan, next, scratch.path()));
  return next;
}

}  // namespace whipple::sweep
