// SPDX-License-Identifier: BSD-3-Clause
#include "src/io/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>
#include <system_error>

#include "src/core/base/error.hpp"
#include "src/core/base/log.hpp"
#include "src/core/hdf5/hdf5.hpp"
#include "src/io/ranks.hpp"
#include "src/io/sealed_file.hpp"
#include "src/material/constitutive_catalogue.hpp"

namespace whipple::io {
namespace {

namespace fs = std::filesystem;

/// Describes the numbers of one value of a field; Eigen and SymmetricTensor contain exactly these, in this order.
template <class Value>
struct Numbers {
  using Type = Value;
  static constexpr std::uint64_t columns = 0;
};
template <>
struct Numbers<Vector3> {
  using Type = double;
  static constexpr std::uint64_t columns = 3;
};
template <>
struct Numbers<SymmetricTensor> {
  using Type = double;
  static constexpr std::uint64_t columns = 6;
};
template <>
struct Numbers<Matrix3> {
  using Type = double;
  static constexpr std::uint64_t columns = 9;
};
template <>
struct Numbers<fem::Corners> {
  using Type = std::uint32_t;
  static constexpr std::uint64_t columns = 8;
};
template <>
struct Numbers<std::array<std::uint32_t, 2>> {
  using Type = std::uint32_t;
  static constexpr std::uint64_t columns = 2;
};
template <class Value>
constexpr std::uint64_t width() {
  constexpr std::uint64_t columns = Numbers<Value>::columns == 0 ? 1 : Numbers<Value>::columns;
  static_assert(sizeof(Value) == columns * sizeof(typename Numbers<Value>::Type));
  return columns;
}

/// Limits the chunks: a chunk of tensors is smaller than a megabyte, because HDF5 keeps two copies to compute the
/// checksum.
const hdf5::Storage checksummed{.fletcher32 = true, .chunk_rows = 16384};

/// Writes all fields of particles, nodes, elements or Gauss points.
template <class Points>
void write_points(const hdf5::Group& group, const Points& points, const Ranks& ranks) {
  const std::uint64_t n = points.size();
  const hdf5::Slab slab = ranks.slab(n);
  group.set_attribute("count", static_cast<std::int64_t>(slab.total));
  for_each_field(points, [&](const auto& field) {
    const auto& values = field.of(points);
    using Value = typename std::decay_t<decltype(values)>::value_type;
    using Number = typename Numbers<Value>::Type;
    if (field.optional) {  // used on some rank: written by all, including ranks without particles
      const std::vector<std::uint64_t> used = ranks.gather(values.size());
      if (std::ranges::all_of(used, [](std::uint64_t size) { return size == 0; })) return;
    }
    if (values.size() != n) throw InternalError(fmt::format("field {} has another length", field.name));
    hdf5::Storage storage = checksummed;
    storage.columns = Numbers<Value>::columns;
    const std::span<const Number> numbers(reinterpret_cast<const Number*>(values.data()), n * width<Value>());
    const hdf5::Dataset array = group.write<Number>(field.name, numbers, slab, storage);
    array.set_fixed_attribute("unit", field.unit);
  });
}

/// Allocates the fields of material models that the file contains. All other fields must match those of the program: a
/// missing field would have no value (missing optional fields were not in use), an unknown one would be lost.
template <class Points>
void require_fields(const hdf5::Group& group, Points& points) {
  const std::vector<std::string> found = group.names();
  std::set<std::string> unknown(found.begin(), found.end());
  std::vector<std::string> missing;
  for_each_field<Points>([&](const auto& field) {
    if (unknown.erase(field.name) == 0 && !field.optional) missing.emplace_back(field.name);
  });
  if constexpr (requires { points.history; }) {
    for (const HistoryField& field : material::history_fields()) {
      if (unknown.erase(field.name) != 0) points.history.add(field);
    }
  }
  if (missing.empty() && unknown.empty()) return;
  std::string message = group.name() + ": was written by another version of the program:";
  if (!missing.empty()) message += fmt::format(" missing fields: {};", fmt::join(missing, ", "));
  if (!unknown.empty()) message += fmt::format(" unknown fields: {};", fmt::join(unknown, ", "));
  message.back() = '.';
  throw InputError(message);
}

template <class Points>
void read_points(const hdf5::Group& group, Points& points, const Ranks& ranks) {
  require_fields(group, points);
  const std::int64_t declared = group.integer_attribute("count");
  if (declared < 0)
    throw InputError(fmt::format("{}: is declared to hold {} points", group.name(), declared));
  const auto total = static_cast<std::uint64_t>(declared);
  const std::vector<std::string> found = group.names();
  // Before memory is allocated: the data sets must have the declared size.
  for_each_field(points, [&](const auto& field) {
    using Value = typename std::decay_t<decltype(field.of(points))>::value_type;
    if (std::ranges::find(found, field.name) == found.end()) return;
    group.open_dataset(field.name).require_shape({total, width<Value>()});
  });
  const auto rank = static_cast<std::uint64_t>(ranks.rank());
  const auto count = static_cast<std::uint64_t>(ranks.count());
  const std::uint64_t first = total * rank / count;
  const hdf5::Slab slab{first, total * (rank + 1) / count - first, total};
  resize(points, slab.count);
  for_each_field(points, [&](const auto& field) {
    auto& values = field.of(points);
    if (field.optional) {
      if (std::ranges::find(found, field.name) == found.end()) return;
      values.resize(slab.count);
    }
    using Value = typename std::decay_t<decltype(values)>::value_type;
    using Number = typename Numbers<Value>::Type;
    const hdf5::Dataset array = group.open_dataset(field.name);
    const std::string unit = array.text_attribute("unit");
    if (unit != field.unit) {
      throw InputError(fmt::format("{}: is in {}, expected {}", array.name(), unit, field.unit));
    }
    array.read_rows<Number>({reinterpret_cast<Number*>(values.data()), slab.count * width<Value>()}, slab,
                            width<Value>());
  });
}

/// Writes groups "0", "1", ..., one per mesh.
void write_meshes(const hdf5::Group& group, std::span<const fem::Mesh> meshes, const Ranks& ranks) {
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const fem::Mesh& mesh = meshes[m];
    const hdf5::Group of_mesh = group.create_group(std::to_string(m));
    of_mesh.set_attribute("body", static_cast<std::int64_t>(mesh.body));
    of_mesh.set_attribute("quadrature", static_cast<std::int64_t>(mesh.quadrature));
    write_points(of_mesh.create_group("nodes"), mesh.nodes, ranks);
    write_points(of_mesh.create_group("elements"), mesh.elements, ranks);
    write_points(of_mesh.create_group("points"), mesh.points, ranks);
  }
}

void write_bars(const hdf5::Group& group, std::span<const fem::Bars> all, const Ranks& ranks) {
  for (std::size_t m = 0; m < all.size(); ++m) {
    const hdf5::Group of_bars = group.create_group(std::to_string(m));
    of_bars.set_attribute("body", static_cast<std::int64_t>(all[m].body));
    write_points(of_bars.create_group("nodes"), all[m].nodes, ranks);
    write_points(of_bars.create_group("bars"), all[m].elements, ranks);
  }
}

std::vector<fem::Bars> read_bars(const hdf5::Group& group, const Ranks& ranks) {
  std::vector<fem::Bars> all(group.names().size());
  for (std::size_t m = 0; m < all.size(); ++m) {
    const hdf5::Group of_bars = group.open_group(std::to_string(m));
    all[m].body = static_cast<std::uint32_t>(of_bars.integer_attribute("body"));
    read_points(of_bars.open_group("nodes"), all[m].nodes, ranks);
    read_points(of_bars.open_group("bars"), all[m].elements, ranks);
  }
  return all;
}

std::vector<fem::Mesh> read_meshes(const hdf5::Group& group, const Ranks& ranks) {
  std::vector<fem::Mesh> meshes(group.names().size());
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    fem::Mesh& mesh = meshes[m];
    const hdf5::Group of_mesh = group.open_group(std::to_string(m));
    mesh.body = static_cast<std::uint32_t>(of_mesh.integer_attribute("body"));
    const std::int64_t quadrature = of_mesh.integer_attribute("quadrature");
    if (quadrature < 0 || quadrature > static_cast<std::int64_t>(fem::Quadrature::ring)) {
      throw InputError(
          fmt::format("{}: is of the quadrature {}, which does not exist", of_mesh.name(), quadrature));
    }
    mesh.quadrature = static_cast<fem::Quadrature>(quadrature);
    read_points(of_mesh.open_group("nodes"), mesh.nodes, ranks);
    read_points(of_mesh.open_group("elements"), mesh.elements, ranks);
    read_points(of_mesh.open_group("points"), mesh.points, ranks);
  }
  return meshes;
}

/// Writes a text or array as a data set with its name as an attribute: names may contain any character ("mass.a/b").
template <class Number>
void write_named(const hdf5::Group& group, const std::string& name, std::span<const Number> numbers,
                 const Ranks& ranks) {
  const std::uint64_t mine = ranks.is_root() ? numbers.size() : 0;
  const hdf5::Dataset array =
      group.write<Number>(fmt::format("{:06}", group.names().size()), numbers.first(mine),
                          {0, mine, numbers.size()}, checksummed);
  array.set_fixed_attribute("name", name);
}

void write_values(const hdf5::Group& group, const CheckpointValues& values, const Ranks& ranks) {
  const hdf5::Group reals = group.create_group("reals");
  for (const auto& [name, value] : values.reals) reals.set_attribute(name, value);
  const hdf5::Group integers = group.create_group("integers");
  for (const auto& [name, value] : values.integers) integers.set_attribute(name, value);
  const hdf5::Group texts = group.create_group("texts");
  for (const auto& [name, value] : values.texts) {
    write_named<std::uint8_t>(texts, name,
                              {reinterpret_cast<const std::uint8_t*>(value.data()), value.size()}, ranks);
  }
  const hdf5::Group arrays = group.create_group("arrays");
  for (const auto& [name, value] : values.arrays) write_named<double>(arrays, name, value, ranks);
}

CheckpointValues read_values(const hdf5::Group& group) {
  CheckpointValues values;
  const hdf5::Group reals = group.open_group("reals");
  for (const std::string& name : reals.attribute_names()) values.reals[name] = reals.real_attribute(name);
  const hdf5::Group integers = group.open_group("integers");
  for (const std::string& name : integers.attribute_names())
    values.integers[name] = integers.integer_attribute(name);
  const hdf5::Group texts = group.open_group("texts");
  for (const std::string& number : texts.names()) {
    const hdf5::Dataset text = texts.open_dataset(number);
    const std::vector<std::uint8_t> bytes = text.read_all<std::uint8_t>();
    values.texts[text.text_attribute("name")] = std::string(bytes.begin(), bytes.end());
  }
  const hdf5::Group arrays = group.open_group("arrays");
  for (const std::string& number : arrays.names()) {
    const hdf5::Dataset array = arrays.open_dataset(number);
    values.arrays[array.text_attribute("name")] = array.read_all<double>();
  }
  return values;
}

/// Returns the step of a checkpoint file, NNNNNNNN of checkpoint.NNNNNNNN.h5.
std::optional<std::int64_t> step_of(const fs::path& path) {
  const std::string file = path.filename().string();
  constexpr std::string_view prefix = "checkpoint.";
  constexpr std::string_view suffix = ".h5";
  if (!file.starts_with(prefix) || !file.ends_with(suffix) ||
      file.size() < prefix.size() + 8 + suffix.size()) {
    return std::nullopt;
  }
  const char* end = file.data() + file.size() - suffix.size();
  std::int64_t step = 0;
  const auto [stop, error] = std::from_chars(file.data() + prefix.size(), end, step);
  return error == std::errc() && stop == end ? std::optional(step) : std::nullopt;
}

/// Keeps the checkpoint just written and the newest earlier one. Checkpoints of later steps were abandoned when the run
/// resumed from an earlier step.
void remove_old_generations(const fs::path& folder, std::int64_t step) {
  int earlier = 0;
  for (const fs::path& path : list_checkpoints(folder)) {
    const std::int64_t other = *step_of(path);
    if (other == step || (other < step && ++earlier == 1)) continue;
    std::error_code ignored;  // a file that cannot be removed is harmless
    fs::remove(path, ignored);
  }
}

/// Reads the part of this rank, without communication.
Checkpoint read_share(const fs::path& path, const Ranks& ranks) {
  const hdf5::File file = hdf5::File::open(path);
  Checkpoint checkpoint;
  checkpoint.path = path;
  read_points(file.root.open_group("particles"), checkpoint.particles, ranks);
  const std::vector<std::string> groups = file.root.names();
  if (std::ranges::find(groups, "meshes") != groups.end()) {
    checkpoint.meshes = read_meshes(file.root.open_group("meshes"), ranks);
  }
  if (std::ranges::find(groups, "bars") != groups.end()) {
    checkpoint.bars = read_bars(file.root.open_group("bars"), ranks);
  }
  checkpoint.values = read_values(file.root.open_group("values"));
  checkpoint.values.source = path.string();
  return checkpoint;
}

/// Lists the checkpoints found by the root, so that all ranks try the same ones. Collective.
std::vector<fs::path> list_together(const fs::path& folder, const Ranks& ranks) {
  std::string names;
  ranks.on_root([&] {
    for (const fs::path& path : list_checkpoints(folder)) names += path.filename().string() + '\n';
  });
  std::istringstream lines(ranks.broadcast(names));
  std::vector<fs::path> paths;
  for (std::string name; std::getline(lines, name);) paths.push_back(folder / name);
  return paths;
}

template <class Map>
const typename Map::mapped_type& find(const Map& map, const std::string& name, const std::string& source) {
  const auto entry = map.find(name);
  if (entry == map.end()) throw InputError(fmt::format("{}: the value \"{}\" is missing", source, name));
  return entry->second;
}

}  // namespace

double CheckpointValues::real(const std::string& name) const { return find(reals, name, source); }
std::int64_t CheckpointValues::integer(const std::string& name) const { return find(integers, name, source); }
const std::string& CheckpointValues::text(const std::string& name) const { return find(texts, name, source); }
const std::vector<double>& CheckpointValues::array(const std::string& name) const {
  return find(arrays, name, source);
}

std::vector<fs::path> list_checkpoints(const fs::path& folder) {
  std::vector<fs::path> paths;
  if (!fs::is_directory(folder)) return paths;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && step_of(entry.path())) paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end(),
            [](const fs::path& a, const fs::path& b) { return *step_of(a) > *step_of(b); });
  return paths;
}

fs::path write_checkpoint(const fs::path& folder, std::int64_t step, const Particles& particles,
                          const CheckpointValues& values, MPI_Comm communicator,
                          std::span<const fem::Mesh> meshes, std::span<const fem::Bars> bars) {
  const Ranks ranks(communicator);
  ranks.on_root([&] {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
      throw InputError(fmt::format("{}: cannot make the folder: {}", folder.string(), error.message()));
  });
  const fs::path path = folder / fmt::format("checkpoint.{:08}.h5", step);
  SharedPartialFile partial(path, ranks);

  hdf5::File file = hdf5::File::create(partial.path(), hdf5::File::Compatibility::checksummed, seal_size,
                                       ranks.communicator());
  write_points(file.root.create_group("particles"), particles, ranks);
  if (!meshes.empty()) write_meshes(file.root.create_group("meshes"), meshes, ranks);
  if (!bars.empty()) write_bars(file.root.create_group("bars"), bars, ranks);
  write_values(file.root.create_group("values"), values, ranks);
  file.close();

  ranks.on_root([&] {
    seal(partial.path());
    partial.publish(true);
    remove_old_generations(folder, step);
  });
  return path;
}

Checkpoint read_checkpoint(const fs::path& path, MPI_Comm communicator) {
  const Ranks ranks(communicator);
  ranks.on_root([&] { require_seal(path); });
  Checkpoint checkpoint;
  ranks.on_all([&] { checkpoint = read_share(path, ranks); });
  return checkpoint;
}

Checkpoint read_latest_checkpoint(const fs::path& folder, MPI_Comm communicator) {
  const Ranks ranks(communicator);
  std::string reasons;
  for (const fs::path& path : list_together(folder, ranks)) {
    try {
      Checkpoint checkpoint = read_checkpoint(path, communicator);
      if (!reasons.empty() && ranks.is_root()) {
        log::warning("the newest checkpoint is not usable; going on from {}:{}", path.string(), reasons);
      }
      return checkpoint;
    } catch (const InputError& error) {
      reasons += std::string("\n  ") + error.what();
    }
  }
  if (reasons.empty()) throw InputError(fmt::format("{}: contains no checkpoint", folder.string()));
  throw InputError(fmt::format("{}: no checkpoint is usable:{}", folder.string(), reasons));
}

}  // namespace whipple::io
