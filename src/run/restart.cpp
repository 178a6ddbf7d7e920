// SPDX-License-Identifier: BSD-3-Clause
#include "src/run/restart.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/base/hash.hpp"
#include "src/core/base/log.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/material/failure/catalogue.hpp"
#include "src/material/material_file.hpp"
#include "src/run/checkpointing.hpp"

namespace whipple::run {
namespace {

namespace fs = std::filesystem;

/// Lists the tables whose keys determine the particles and elements.
constexpr std::array<std::string_view, 5> fixed_tables = {"domain", "body", "gauge", "tracers",
                                                          "force_gauge"};

/// Lists those of them that a run which begins with the state of another one must share.
constexpr std::array<std::string_view, 2> tables_of_material = {"domain", "body"};

/// Computes digests of the material and mesh files of every body. The material files of a run are copies that include
/// the values from their base files.
std::map<std::string, std::string> digests(const cases::Case& setup) {
  std::map<std::string, std::string> found;
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    const Material& material = *setup.materials[b];
    std::string all = sha256(material_text(material.file));
    for (const fs::path& companion : material.companions)
      all += sha256_of_file(material.file.parent_path() / companion);
    found[fmt::format("material of body \"{}\"", setup.bodies[b].name)] = sha256(all);
    if (const std::string& mesh = setup.bodies[b].discretization.mesh; !mesh.empty())
      found[fmt::format("mesh of body \"{}\"", setup.bodies[b].name)] = sha256_of_file(mesh);
  }
  return found;
}

std::string text_of(const cases::Case& setup) {
  return cases::to_toml(setup, std::vector<std::string>(setup.bodies.size()));
}

/// Maps "table.key" to the value for every line of `cases::to_toml`, without comments; entries of lists of tables are
/// numbered.
std::map<std::string, std::string> keys_of(std::string_view toml) {
  std::map<std::string, std::string> keys;
  std::map<std::string, int> entries;
  std::string table, list;
  for (std::size_t at = 0; at < toml.size();) {
    const std::size_t end = std::min(toml.find('\n', at), toml.size());
    std::string_view line = toml.substr(at, end - at);
    at = end + 1;
    if (line.starts_with('[')) {
      const bool of_list = line.starts_with("[[");
      std::string name(line.substr(of_list ? 2 : 1, line.find(']') - (of_list ? 2 : 1)));
      const std::string owner = list.substr(0, list.find('['));
      if (!list.empty() && name.starts_with(owner + ".")) name = list + name.substr(owner.size());
      table = of_list ? fmt::format("{}[{}]", name, entries[name]++) : name;
      if (of_list && name.find('.') == std::string::npos) list = table;
    } else if (const std::size_t equals = line.find(" = ");
               equals != std::string_view::npos && line[0] != '#') {
      line = line.substr(0, line.rfind("  # "));
      keys[fmt::format("{}{}{}", table, table.empty() ? "" : ".", line.substr(0, equals))] =
          line.substr(equals + 3);
    }
  }
  return keys;
}

// ---- admissible values

struct Admissible {
  std::string_view field;
  Range range;
};
constexpr double most = 1.0 + 1e-9;  // of fractions, including round-off
const std::array admissible = {
    Admissible{"mass", {.lower = 0.0, .lower_open = true}},
    Admissible{"volume", {.lower = 0.0, .lower_open = true}},
    Admissible{"void_volume", {.lower = 0.0}},
    Admissible{"temperature", {.lower = 0.0}},
    Admissible{"sound_speed", {.lower = 0.0}},
    Admissible{"plastic_strain", {.lower = 0.0}},
    Admissible{"melted_fraction", {.lower = 0.0, .upper = most}},
    Admissible{"vaporised_fraction", {.lower = 0.0, .upper = most}},
    Admissible{"failed", {.lower = 0.0, .upper = static_cast<double>(failure::greatest_code())}},
    Admissible{"melting_time", {.lower = never}},
    Admissible{"failure_threshold_factor", {.lower = 0.0}},
    Admissible{"strength_factor", {.lower = 0.0, .upper = 1.0}},
    Admissible{"length", {.lower = 0.0, .lower_open = true}},
    Admissible{"reference_length", {.lower = 0.0, .lower_open = true}},
    Admissible{"constrained", {.lower = 0.0, .upper = fem::constraint::all}},
    Admissible{"broken", {.lower = 0.0, .upper = 1.0}},
    Admissible{"time", {.lower = 0.0}},
    Admissible{"time_step", {.lower = 0.0}},
    Admissible{"unclipped_step", {.lower = 0.0}},
    Admissible{"initial_mass", {.lower = 0.0}},
    Admissible{"touched", {.lower = 0.0, .upper = 4294967295.0}},  // halves of words
};

/// Returns the admissible range of a field: any finite number unless the table restricts it.
Range range_of(std::string_view name) {
  const auto found = std::ranges::find(admissible, name, &Admissible::field);
  return found == admissible.end() ? Range{} : found->range;
}

class Checker {
 public:
  explicit Checker(const io::Checkpoint& checkpoint) : file_(checkpoint.path.string()) {}

  template <class Numbers>
  void require(const std::string& name, const Numbers& numbers, const Range& range) const {
    for (std::size_t i = 0; i < std::size(numbers); ++i) {
      const auto value = static_cast<double>(numbers[i]);
      if (std::isfinite(value) && range.contains(value)) continue;
      constexpr double infinity = std::numeric_limits<double>::infinity();
      const bool any = range.contains(-infinity) && range.contains(infinity);
      throw InputError(fmt::format("{}: {}: number {} is {}, but must be {}; is the file another program's?",
                                   file_, name, i, value, any ? "finite" : range.text()));
    }
  }

  /// Checks every field of a set of points.
  /// @param indices  ranges of the fields that are indices
  template <class Points>
  void require_points(const std::string& group, const Points& points,
                      const std::map<std::string, Range>& indices = {}) const {
    for_each_field(points, [&](const auto& field) {
      const auto& values = field.of(points);
      using Value = typename std::decay_t<decltype(values)>::value_type;
      const auto index = indices.find(field.name);
      Range range = index == indices.end() ? range_of(field.name) : index->second;
      if constexpr (requires { field.declared; }) range = field.declared.range;
      const std::string name = group + "/" + field.name;
      if constexpr (std::is_arithmetic_v<Value>) {
        require(name, values, range);
      } else {  // vectors and tensors consist of plain numbers
        using Number = std::conditional_t<std::is_same_v<Value, fem::Corners> ||
                                              std::is_same_v<Value, std::array<std::uint32_t, 2>>,
                                          std::uint32_t, double>;
        require(name,
                std::span(reinterpret_cast<const Number*>(values.data()),
                          values.size() * sizeof(Value) / sizeof(Number)),
                range);
      }
    });
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}: {}", file_, what));
  }

 private:
  std::string file_;
};

/// Returns the range of indices below `count`.
Range below(double count) { return {.lower = 0.0, .upper = count, .upper_open = true}; }

}  // namespace

bool is_fixed(std::string_view key) {
  const std::string_view table = key.substr(0, key.find_first_of(".["));
  return std::ranges::find(fixed_tables, table) != fixed_tables.end();
}

void remember_input(const cases::Case& setup, io::CheckpointValues& values) {
  values.texts["input"] = text_of(setup);
  for (const auto& [name, digest] : digests(setup)) values.texts[name] = digest;
}

void require_same_bodies(const cases::Case& setup, const io::CheckpointValues& values) {
  const auto of_material = [](const std::string& key) {
    const std::string_view table = std::string_view(key).substr(0, key.find_first_of(".["));
    const bool may_differ =
        key.ends_with("velocity") || key.ends_with(".driven") || key.find(".path.") != std::string::npos;
    return std::ranges::find(tables_of_material, table) != tables_of_material.end() && !may_differ;
  };
  const std::map<std::string, std::string> now = keys_of(text_of(setup)),
                                           then = keys_of(values.text("input"));
  std::vector<std::string> differences;
  const auto compare = [&](const auto& one, const auto& other, bool of_case) {
    for (const auto& [key, value] : one) {
      if (!of_material(key)) continue;
      const auto found = other.find(key);
      if (found == other.end()) {
        differences.push_back(fmt::format("{} = {} {}", key, value, of_case ? "here only" : "there only"));
      } else if (of_case && found->second != value) {
        differences.push_back(fmt::format("{} = {}, there {}", key, value, found->second));
      }
    }
  };
  compare(now, then, true);
  compare(then, now, false);
  for (const auto& [name, digest] : digests(setup)) {
    const auto former = values.texts.find(name);
    if (former == values.texts.end() || former->second != digest)
      differences.push_back(fmt::format("the {} is another", name));
  }
  if (differences.empty()) return;
  throw InputError(fmt::format("{}: --start-from: its grid and bodies are not those of the case:\n  {}",
                               values.source, fmt::join(differences, "\n  ")));
}

std::string require_same_input(const cases::Case& setup, const io::CheckpointValues& values) {
  const std::map<std::string, std::string> now = keys_of(text_of(setup)),
                                           then = keys_of(values.text("input"));
  std::set<std::string> keys;
  for (const auto& list : {now, then})
    for (const auto& [key, value] : list) keys.insert(key);
  keys.erase("title");
  const auto shown = [](const auto& list, const std::string& key) {
    const auto found = list.find(key);
    return found == list.end() ? std::string("absent") : found->second;
  };
  std::vector<std::string> fixed, free;
  for (const std::string& key : keys) {
    const std::string present = shown(now, key), former = shown(then, key);
    if (present == former) continue;
    (is_fixed(key) ? fixed : free).push_back(fmt::format("{} = {}, was {}", key, present, former));
  }
  for (const auto& [name, digest] : digests(setup)) {
    const auto former = values.texts.find(name);
    if (former == values.texts.end() || former->second != digest)
      fixed.push_back(fmt::format("the {} is another", name));
  }
  if (!fixed.empty()) {
    throw InputError(fmt::format(
        "{}: is a checkpoint of another input than run.toml and its files:\n  {}\n  Grid, bodies, materials "
        "and "
        "gauges are those of the checkpoint: put them back, or start over with whipple run CASE.toml -o DIR",
        values.source, fmt::join(fixed, "\n  ")));
  }
  return fmt::format("{}", fmt::join(free, "; "));
}

void require_admissible(const cases::Case& setup, const io::Checkpoint& checkpoint, MPI_Comm communicator) {
  const Checker checker(checkpoint);
  const Range bodies = below(static_cast<double>(setup.bodies.size()));
  for (const auto& [name, value] : checkpoint.values.reals)
    checker.require("values/" + name, std::span(&value, 1), range_of(name));
  for (const auto& [name, value] : checkpoint.values.integers)
    checker.require("values/" + name, std::span(&value, 1), range::non_negative());
  for (const auto& [name, array] : checkpoint.values.arrays)
    checker.require("values/" + name, array, range_of(name));
  checker.require_points("particles", checkpoint.particles, {{"body", bodies}});
  const auto of_all_ranks = [&](std::size_t count) {
    std::array<double, 1> sum = {static_cast<double>(count)};
    parallel::sum(communicator, sum);
    return sum[0];
  };
  for (const fem::Mesh& mesh : checkpoint.meshes) {
    checker.require("meshes/body", std::span(&mesh.body, 1), bodies);
    checker.require_points("nodes", mesh.nodes);
    checker.require_points("elements", mesh.elements, {{"corners", below(of_all_ranks(mesh.nodes.size()))}});
    checker.require_points("points", mesh.points);
    const std::size_t expected = mesh.elements.size() * fem::points_per_element(mesh.quadrature);
    if (of_all_ranks(mesh.points.size()) != of_all_ranks(expected))
      checker.fail("meshes: elements and Gauss points differ in number");
  }
  for (const fem::Bars& bars : checkpoint.bars) {
    checker.require("bars/body", std::span(&bars.body, 1), bodies);
    checker.require_points("nodes", bars.nodes);
    checker.require_points("bars", bars.elements, {{"ends", below(of_all_ranks(bars.nodes.size()))}});
  }
}

solver::Simulation resume(const cases::Case& setup, io::Checkpoint& checkpoint, MPI_Comm communicator) {
  const std::string changed = require_same_input(setup, checkpoint.values);
  require_admissible(setup, checkpoint, communicator);
  if (!changed.empty()) log::info("changed since the checkpoint: {}", changed);
  const solver::RunState state = from_checkpoint(checkpoint.values);
  if (state.driven.size() != setup.bodies.size() || state.outflow_of_body.size() != setup.bodies.size()) {
    throw InputError(fmt::format(
        "{}: holds \"driven_bodies\" of {} and \"outflow_of_body\" of {} bodies: expected "
        "those of the {} of the case",
        checkpoint.path.string(), state.driven.size(), state.outflow_of_body.size(), setup.bodies.size()));
  }
  if (state.loaded_mass.size() != setup.loads.size()) {
    throw InputError(
        fmt::format("{}: holds \"loaded_mass\" of {} loads: expected those of the {} of the case",
                    checkpoint.path.string(), state.loaded_mass.size(), setup.loads.size()));
  }
  if (state.gauged.size() != setup.force_gauges.size()) {
    throw InputError(
        fmt::format("{}: holds \"gauged_impulses\" of {} force gauges: expected those of the {} of the case",
                    checkpoint.path.string(), state.gauged.size(), setup.force_gauges.size()));
  }
  if (setup.time.end < state.time) {
    throw InputError(
        fmt::format("'time.end' is {} s, and the run is at t = {} s already: expected at least that",
                    setup.time.end, state.time));
  }
  try {
    return {setup,        std::move(checkpoint.particles), state,
            communicator, std::move(checkpoint.meshes),    std::move(checkpoint.bars)};
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}; changed since then: {}", checkpoint.path.string(), error.what(),
                                 changed.empty() ? "nothing" : changed));
  }
}

solver::Simulation start_from(const cases::Case& setup, io::Checkpoint& checkpoint, MPI_Comm communicator) {
  require_same_bodies(setup, checkpoint.values);
  require_admissible(setup, checkpoint, communicator);
  Particles& particles = checkpoint.particles;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const cases::Body& body = setup.bodies[particles.body[p]];
    const cases::Shape::Bounds bounds = body.shape->bounds();
    particles.velocity[p] += body.velocity_at(particles.position[p], 0.5 * (bounds.lower + bounds.upper));
  }
  return {setup,        std::move(particles),         solver::RunState{},
          communicator, std::move(checkpoint.meshes), std::move(checkpoint.bars)};
}

}  // namespace whipple::run
