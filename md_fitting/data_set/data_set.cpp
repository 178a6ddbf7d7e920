// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/data_set/data_set.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <iterator>
#include <optional>
#include <tuple>
#include <vector>

#include "md_fitting/data_set/store_order.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/file_lock.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/units.hpp"
#include "src/core/hdf5/hdf5.hpp"

namespace whipple::md {
namespace {

constexpr const char* format_name = "whipple-md";
constexpr std::int64_t format_version = 1;

// ---- quantities: a data set {value, error} or {value} with its unit

void write_text(const hdf5::Object& object, const std::string& name, const std::string& text) {
  object.set_fixed_attribute(name, text);
}

void write_quantity(const hdf5::Group& group, const std::string& name, std::span<const double> numbers) {
  const hdf5::Dataset set = group.write<double>(name, numbers, hdf5::Slab::whole(numbers.size()));
  write_text(set, "unit", std::string(unit_of(name)));
}

Estimate read_quantity(const hdf5::Group& group, const std::string& name) {
  const hdf5::Dataset set = group.open_dataset(name);
  const std::vector<double> numbers = set.read_all<double>();
  if (numbers.empty() || numbers.size() > 2) {
    throw InputError(
        fmt::format("{}: contains {} numbers, not a value and its error", set.name(), numbers.size()));
  }
  return {numbers[0], numbers.size() > 1 ? numbers[1] : 0.0};
}

// ---- points

PointRecord read_point(const hdf5::Group& points, const std::string& key) {
  const hdf5::Group group = points.open_group(key);
  PointRecord point;
  point.key = key;
  point.protocol = group.text_attribute("protocol");
  const std::string status = group.text_attribute("status");
  if (!value_of<PointStatus>(status)) {
    throw InputError(fmt::format("{}: unknown status '{}' of a point", group.name(), status));
  }
  point.status = *value_of<PointStatus>(status);
  point.message = group.text_attribute("message");
  const hdf5::Group conditions = group.open_group("conditions");
  for (const std::string& name : conditions.names(hdf5::Order::creation))
    point.conditions[name] = read_quantity(conditions, name).value;
  const hdf5::Group results = group.open_group("results");
  for (const std::string& name : results.names(hdf5::Order::creation))
    point.results[name] = read_quantity(results, name);
  if (group.has("blocks")) {
    const hdf5::Group blocks = group.open_group("blocks");
    for (const std::string& name : blocks.names(hdf5::Order::creation)) {
      point.blocks[name] = blocks.open_dataset(name).read_all<double>();
    }
  }
  const hdf5::Group provenance = group.open_group("provenance");
  for (const std::string& name : provenance.attribute_names())
    point.provenance[name] = provenance.text_attribute(name);
  return point;
}

void write_point(const hdf5::Group& points, const PointRecord& point) {
  const hdf5::Group group = points.create_group(point.key, hdf5::Order::creation);
  write_text(group, "protocol", point.protocol);
  write_text(group, "status", std::string(word_of(point.status)));
  write_text(group, "message", point.message);
  const hdf5::Group conditions = group.create_group("conditions", hdf5::Order::creation);
  for (const auto& [name, value] : point.conditions) write_quantity(conditions, name, {&value, 1});
  const hdf5::Group results = group.create_group("results", hdf5::Order::creation);
  for (const auto& [name, estimate] : point.results) {
    const std::array<double, 2> numbers = {estimate.value, estimate.error};
    write_quantity(results, name, numbers);
  }
  if (!point.blocks.empty()) {
    const hdf5::Group blocks = group.create_group("blocks", hdf5::Order::creation);
    for (const auto& [name, means] : point.blocks) {
      if (!means.empty()) write_quantity(blocks, name, means);
    }
  }
  const hdf5::Group provenance = group.create_group("provenance", hdf5::Order::creation);
  for (const auto& [name, text] : point.provenance) write_text(provenance, name, text);
}

/// Checks the format of a database. @throws InputError unless the file is a database in a format known to this program.
void check_format(const hdf5::File& file, const std::filesystem::path& path) {
  if (!file.root.has_attribute("format") || file.root.text_attribute("format") != format_name) {
    throw InputError(
        fmt::format("{} is an HDF5 file, but not a store of molecular-dynamics points", path.string()));
  }
  const double version = file.root.real_attribute("version");
  if (version > static_cast<double>(format_version)) {
    throw InputError(fmt::format("{} has format version {}, this program reads versions up to {}",
                                 path.string(), version, format_version));
  }
}

std::filesystem::path beside(const std::filesystem::path& path, const char* ending) {
  return path.parent_path() / fmt::format(".{}{}", path.filename().string(), ending);
}

/// Creates an empty database in memory.
hdf5::File empty_store(const std::filesystem::path& path) {
  hdf5::File file = hdf5::File::create_in_memory(beside(path, ".part"), hdf5::File::Compatibility::compact);
  write_text(file.root, "format", format_name);
  file.root.set_attribute("version", static_cast<double>(format_version));
  file.root.create_group("points", hdf5::Order::creation);
  return file;
}

// ---- files

/// Locks the database for a single writer.
FileLock lock_store(const std::filesystem::path& path) {
  return {beside(path, ".lock"), fmt::format("the store {}", path.string()), FileLock::IfHeld::wait};
}

/// Replaces the content of a database. @throws InputError, leaving the old content unchanged
void replace_store(const std::filesystem::path& path, const std::string& bytes) {
  try {
    replace_durably(path, beside(path, ".part"), bytes);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}; the points stored so far are safe", error.what()));
  }
}

template <class Map>
auto find_or_throw(const Map& map, std::string_view name, const PointRecord& point, const char* kind) {
  const auto found = map.find(std::string(name));
  if (found == map.end()) {
    throw InputError(fmt::format("the point {} of the store (key {}) has no {} '{}'", point.label(),
                                 point.key.substr(0, 12), kind, name));
  }
  return found->second;
}

}  // namespace

double PointRecord::condition(std::string_view name) const {
  return find_or_throw(conditions, name, *this, "condition");
}
Estimate PointRecord::result(std::string_view name) const {
  return find_or_throw(results, name, *this, "result");
}
std::string PointRecord::origin(std::string_view name) const {
  return find_or_throw(provenance, name, *this, "provenance entry");
}

double PointRecord::origin_number(std::string_view name) const {
  const std::string text = origin(name);
  double value = 0.0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc{} || end != text.data() + text.size()) {
    throw InputError(
        fmt::format("the provenance entry '{}' of {} is \"{}\", not a number", name, label(), text));
  }
  return value;
}

int PointRecord::segments() const {
  return provenance.contains("segments") ? static_cast<int>(origin_number("segments")) : 1;
}

std::string PointRecord::label() const {
  std::string text = protocol;
  const char* joint = " at ";
  for (const auto& [name, value] : conditions) {
    text += fmt::format("{}{} = {}", joint, name, units::format_quantity(value, unit_of(name)));
    joint = ", ";
  }
  return text;
}

std::vector<PointRecord> read_store(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) {
    throw InputError(
        fmt::format("the store {} does not exist; 'whipple md PLAN.toml' makes one", path.string()));
  }
  const hdf5::File file = hdf5::File::open_bytes(path, read_text(path));
  check_format(file, path);
  const hdf5::Group points = file.root.open_group("points");
  std::vector<PointRecord> records;
  for (const std::string& key : points.names(hdf5::Order::creation))
    records.push_back(read_point(points, key));
  return records;
}

std::vector<PointRecord> select(std::span<const PointRecord> points, std::string_view protocol) {
  const auto revision = [](const PointRecord& point) {
    return point.provenance.contains("revision") ? static_cast<int>(point.origin_number("revision")) : 0;
  };
  const auto wanted = [&](const PointRecord& point) { return point.done() && point.protocol == protocol; };
  std::map<std::map<std::string, double>, int> newest;  // by conditions
  for (const PointRecord& point : points) {
    if (wanted(point)) newest[point.conditions] = std::max(newest[point.conditions], revision(point));
  }
  std::vector<PointRecord> chosen;
  std::copy_if(points.begin(), points.end(), std::back_inserter(chosen), [&](const PointRecord& point) {
    return wanted(point) && revision(point) == newest[point.conditions];
  });
  return chosen;
}

namespace {

bool in_order(const PointRecord& a, const PointRecord& b) {
  return std::tie(a.protocol, a.conditions, a.key) < std::tie(b.protocol, b.conditions, b.key);
}

}  // namespace

void normalise_store(const std::filesystem::path& path) {
  const FileLock lock = lock_store(path);
  std::vector<PointRecord> records = read_store(path);
  std::sort(records.begin(), records.end(), in_order);
  hdf5::File file = empty_store(path);
  {
    const hdf5::Group points = file.root.open_group("points");
    for (const PointRecord& point : records) write_point(points, point);
  }
  const std::string bytes = file.close_as_bytes();
  if (bytes != read_text(path)) replace_store(path, bytes);  // a call that computed nothing writes nothing
}

bool append_point(const std::filesystem::path& path, const PointRecord& point) {
  if (point.key.empty() || point.protocol.empty() || word_of(point.status).empty()) {
    throw InternalError("a point needs a key, a protocol and a status 'done' or 'failed' to be stored");
  }
  make_folder(std::filesystem::absolute(path).parent_path());
  const FileLock lock = lock_store(path);
  hdf5::File file = std::filesystem::exists(path)
                        ? hdf5::File::open_bytes(path, read_text(path), hdf5::File::Access::modify)
                        : empty_store(path);
  check_format(file, path);
  {
    const hdf5::Group points = file.root.open_group("points");
    if (points.has(point.key)) {
      const PointRecord present = read_point(points, point.key);
      const bool better = !present.done() || (point.done() && point.segments() > present.segments());
      if (!better) return false;
      points.remove(point.key);
    }
    write_point(points, point);
  }
  replace_store(path, file.close_as_bytes());
  return true;
}

void require_writable(const std::filesystem::path& path) {
  const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
  std::error_code fault;
  std::filesystem::create_directories(folder, fault);
  if (fault) throw InputError(fmt::format("cannot make the folder {}: {}", folder.string(), fault.message()));
  if (std::filesystem::is_directory(path)) throw InputError(fmt::format("{} is a folder", path.string()));
  if (std::filesystem::exists(path)) {
    read_store(path);  // reports a file that is not a database, before any work
    if (::access(path.c_str(), W_OK) != 0)
      throw InputError(fmt::format("{} is write-protected", path.string()));
  }
  const FileLock lock = lock_store(path);
}

}  // namespace whipple::md
