// SPDX-License-Identifier: BSD-3-Clause
#include "src/io/particle_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <string_view>
#include <system_error>

#include "src/base/error.hpp"
#include "src/hdf5/hdf5.hpp"
#include "src/io/run_directory.hpp"
#include "src/parallel/threads.hpp"

namespace whipple::io {
namespace {

namespace fs = std::filesystem;

/// How a value of a field stands in the file.
template <class Value>
struct Row;
template <>
struct Row<double> {
  using Number = float;
  static constexpr std::uint64_t columns = 0;
  static void put(double value, float* row) { *row = static_cast<float>(value); }
};
template <>
struct Row<Vector3> {
  using Number = float;
  static constexpr std::uint64_t columns = 3;
  static void put(const Vector3& value, float* row) {
    Eigen::Map<Eigen::Vector3f>{row} = value.cast<float>();
  }
};
template <>
struct Row<SymmetricTensor> {
  using Number = float;
  static constexpr std::uint64_t columns = 6;
  static void put(const SymmetricTensor& value, float* row) {
    const std::array<double, 6> parts = {value.xx, value.yy, value.zz, value.xy, value.yz, value.zx};
    std::transform(parts.begin(), parts.end(), row, [](double part) { return static_cast<float>(part); });
  }
};
template <class Integer>
  requires std::is_unsigned_v<Integer>
struct Row<Integer> {
  using Number = Integer;
  static constexpr std::uint64_t columns = 0;
  static void put(Integer value, Integer* row) { *row = value; }
};

/// Evaluates value(i) for every particle and writes the array.
template <class Value, class Function>
hdf5::Dataset write_array(const hdf5::Group& group, const std::string& name, const hdf5::Slab& slab,
                          int deflate, Function&& value) {
  using R = Row<Value>;
  constexpr std::uint64_t width = R::columns == 0 ? 1 : R::columns;
  std::vector<typename R::Number> numbers(slab.count * width);
  parallel::for_each(slab.count, [&](std::size_t i) { R::put(value(i), numbers.data() + i * width); });
  return group.write<typename R::Number>(name, numbers, slab, {.columns = R::columns, .deflate = deflate});
}

/// NNNNNN of RUN.particles.NNNNNN.hdf, if the file is one of this run's.
std::optional<std::size_t> snapshot_number(std::string_view file, std::string_view run) {
  const std::string prefix = fmt::format("{}.particles.", run);
  constexpr std::string_view suffix = ".hdf";
  if (file.size() < prefix.size() + 6 + suffix.size() || !file.starts_with(prefix) ||
      !file.ends_with(suffix)) {
    return std::nullopt;
  }
  const std::string_view digits = file.substr(prefix.size(), file.size() - prefix.size() - suffix.size());
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  return number;
}

}  // namespace

ParticleSeries::ParticleSeries(ParticleSeriesOptions options, MPI_Comm communicator)
    : options_(std::move(options)), fields_(select_output_fields(options_.fields)), ranks_(communicator) {}

fs::path ParticleSeries::index_path() const {
  return options_.folder / (options_.name + ".particles.hdf.series");
}

std::string ParticleSeries::index_text() const {
  nlohmann::ordered_json index;
  index["file-series-version"] = "1.0";
  index["files"] = nlohmann::ordered_json::array();
  for (const Entry& entry : entries_) index["files"].push_back({{"name", entry.file}, {"time", entry.time}});
  return index.dump(1) + "\n";
}

void ParticleSeries::restart(double time) {
  std::string text;
  ranks_.on_root([&] {
    if (fs::exists(index_path())) text = read_text(index_path());
  });
  text = ranks_.broadcast(text);

  entries_.clear();
  if (!text.empty()) {
    try {
      const nlohmann::json index = nlohmann::json::parse(text);
      for (const nlohmann::json& entry : index.at("files")) {
        entries_.push_back({entry.at("name").get<std::string>(), entry.at("time").get<double>()});
        if (snapshot_number(entries_.back().file, options_.name) != entries_.size() - 1) {
          throw InputError(fmt::format("{}: entry {} is \"{}\", which is not snapshot {} of the run \"{}\"",
                                       index_path().string(), entries_.size() - 1, entries_.back().file,
                                       entries_.size() - 1, options_.name));
        }
      }
    } catch (const nlohmann::json::exception& error) {
      throw InputError(
          fmt::format("{}: is not the index of a series: {}", index_path().string(), error.what()));
    }
  }
  std::erase_if(entries_, [&](const Entry& entry) { return entry.time > time; });

  ranks_.on_root([&] {
    if (!text.empty()) write_text_atomically(index_path(), index_text());
    // Files beyond the index: later than the restart, or written just before the run was killed.
    std::vector<fs::path> beyond;
    for (const fs::directory_entry& file : fs::directory_iterator(options_.folder)) {
      const auto number = snapshot_number(file.path().filename().string(), options_.name);
      if (number && *number >= entries_.size()) beyond.push_back(file.path());
    }
    for (const fs::path& file : beyond) fs::remove(file);
  });
}

fs::path ParticleSeries::write(const Particles& particles, double time) {
  if (!entries_.empty() && time < entries_.back().time) {
    throw InternalError(fmt::format("snapshot at {} s after one at {} s", time, entries_.back().time));
  }
  const bool replaces = !entries_.empty() && time == entries_.back().time;
  const std::size_t number = replaces ? entries_.size() - 1 : entries_.size();
  const std::string file = fmt::format("{}.particles.{:06}.hdf", options_.name, number);
  const fs::path path = options_.folder / file;
  const fs::path partial = path.string() + ".partial";

  write_file(partial, particles, time);
  if (!replaces) entries_.push_back({file, time});
  ranks_.on_root([&] {
    std::error_code error;
    fs::rename(partial, path, error);
    if (error) throw InputError(fmt::format("{}: cannot name the file: {}", path.string(), error.message()));
    write_text_atomically(index_path(), index_text());
  });
  return path;
}

void ParticleSeries::write_file(const fs::path& path, const Particles& particles, double time) const {
  const std::uint64_t n = particles.size();
  const std::vector<std::uint64_t> counts = ranks_.gather(n);
  const auto rank = static_cast<std::uint64_t>(ranks_.rank());
  const auto partitions = static_cast<std::uint64_t>(ranks_.count());
  const std::uint64_t first =
      std::accumulate(counts.begin(), counts.begin() + ranks_.rank(), std::uint64_t{0});
  const std::uint64_t total = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  const hdf5::Slab points{first, n, total};
  const hdf5::Storage compressed{.deflate = options_.deflate};

  hdf5::File file = hdf5::File::create(path, hdf5::File::Compatibility::vtk, 0, ranks_.communicator());
  const hdf5::Group vtk = file.root.create_group("VTKHDF");
  const std::array<std::int64_t, 2> version = {1, 0};
  vtk.set_attribute("Version", version);
  vtk.set_fixed_attribute("Type", "UnstructuredGrid");

  // One partition per rank.
  const std::array<std::int64_t, 1> count = {static_cast<std::int64_t>(n)};
  for (const char* name : {"NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"}) {
    vtk.write<std::int64_t>(name, count, {rank, 1, partitions});
  }

  write_array<Vector3>(vtk, "Points", points, options_.deflate,
                       [&](std::size_t i) -> const Vector3& { return particles.position[i]; });

  // One vertex cell per particle: thresholds and clips of ParaView work on cells. The arrays vanish in
  // compression.
  std::vector<std::int64_t> indices(n + 1);
  std::iota(indices.begin(), indices.end(), std::int64_t{0});
  vtk.write<std::int64_t>("Connectivity", {indices.data(), n}, points, compressed);
  vtk.write<std::int64_t>("Offsets", indices, {first + rank, n + 1, total + partitions}, compressed);
  constexpr std::uint8_t vertex = 1;  // VTK_VERTEX
  vtk.write<std::uint8_t>("Types", std::vector<std::uint8_t>(n, vertex), points, compressed);

  for (const std::uint32_t body : particles.body) {
    if (body >= options_.material_of_body.size()) {
      throw InternalError(fmt::format("a particle of body {}, but the materials of {} bodies were given",
                                      body, options_.material_of_body.size()));
    }
  }
  const FieldSource source{particles, options_.material_of_body};
  const hdf5::Group point_data = vtk.create_group("PointData");
  for (const OutputField& field : fields_) {
    std::visit(
        [&](auto value) {
          using Value = decltype(value(source, std::size_t{0}));
          const hdf5::Dataset array =
              write_array<Value>(point_data, std::string(field.name), points, options_.deflate,
                                 [&](std::size_t i) { return value(source, i); });
          array.set_attribute("unit", field.unit);
          array.set_attribute("meaning", field.meaning);
        },
        field.value);
  }

  const hdf5::Group field_data = vtk.create_group("FieldData");
  const std::array<double, 1> times = {time};
  const std::uint64_t mine = ranks_.is_root() ? 1 : 0;
  field_data.write<double>("TimeValue", {times.data(), mine}, {0, mine, 1});

  const hdf5::Group run = file.root.create_group("run");
  for (const auto& [name, value] : options_.provenance) run.set_attribute(name, std::string_view(value));
  run.set_attribute("ranks", static_cast<std::int64_t>(ranks_.count()));
  run.set_attribute("unit_system", std::string_view("SI"));
  file.close();
}

}  // namespace whipple::io
