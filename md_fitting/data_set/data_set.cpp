// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/data_set/data_set.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <optional>

#include "md_fitting/data_set/hdf5_handle.hpp"
#include "src/base/error.hpp"
#include "src/base/units.hpp"

namespace whipple::md {
namespace {

constexpr const char* format_name = "whipple-md";
constexpr std::int64_t format_version = 1;

// ---- attributes
// -----------------------------------------------------------------------------------------------

void write_text(hid_t object, const std::string& name, const std::string& text) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "text type");
  H5Tset_size(type, std::max<std::size_t>(text.size(), 1));
  H5Tset_cset(type, H5T_CSET_UTF8);
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, "scalar space");
  const Handle attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                         "cannot write attribute " + name);
  const std::string bytes = text.empty() ? std::string(1, '\0') : text;
  if (H5Awrite(attribute, type, bytes.data()) < 0) throw InputError("HDF5: cannot write attribute " + name);
}

std::string read_text(hid_t object, const std::string& name) {
  const Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose,
                         "attribute " + name + " is missing");
  const Handle type(H5Aget_type(attribute), H5Tclose, "type of " + name);
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0) {
    throw InputError("HDF5: attribute " + name + " is not a text of fixed length");
  }
  std::string text(H5Tget_size(type), '\0');
  if (H5Aread(attribute, type, text.data()) < 0) throw InputError("HDF5: cannot read attribute " + name);
  text.resize(text.find_last_not_of('\0') + 1);
  return text;
}

void write_number(hid_t object, const std::string& name, double value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, "scalar space");
  const Handle attribute(H5Acreate2(object, name.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose, "cannot write attribute " + name);
  if (H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value) < 0)
    throw InputError("HDF5: cannot write attribute " + name);
}

double read_number(hid_t object, const std::string& name) {
  const Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose,
                         "attribute " + name + " is missing");
  double value = 0.0;
  if (H5Aread(attribute, H5T_NATIVE_DOUBLE, &value) < 0)
    throw InputError("HDF5: cannot read attribute " + name);
  return value;
}

// ---- quantities: a data set {value, error} or {value} with its unit
// ---------------------------------------------

void write_quantity(hid_t group, const std::string& name, std::span<const double> numbers) {
  const hsize_t size = numbers.size();
  const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose, "space of " + name);
  const Handle set(
      H5Dcreate2(group, name.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose,
      "cannot write " + name);
  if (H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()) < 0) {
    throw InputError("HDF5: cannot write " + name);
  }
  write_text(set, "unit", std::string(unit_of(name)));
}

Estimate read_quantity(hid_t group, const std::string& name) {
  const Handle set(H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose, "cannot open " + name);
  const Handle space(H5Dget_space(set), H5Sclose, "space of " + name);
  const hssize_t size = H5Sget_simple_extent_npoints(space);
  std::array<double, 2> numbers{};
  if (size < 1 || size > 2 ||
      H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()) < 0) {
    throw InputError("HDF5: cannot read " + name);
  }
  return {numbers[0], numbers[1]};
}

// ---- groups
// -----------------------------------------------------------------------------------------------------

/// A group that keeps the order in which its members were added and many short attributes without an index.
Handle make_group(hid_t parent, const std::string& name) {
  const Handle list(H5Pcreate(H5P_GROUP_CREATE), H5Pclose, "property list");
  H5Pset_link_creation_order(list, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  H5Pset_attr_phase_change(list, 256, 128);
  return {H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, list, H5P_DEFAULT), H5Gclose,
          "cannot make group " + name};
}

Handle open_group(hid_t parent, const std::string& name) {
  return {H5Gopen2(parent, name.c_str(), H5P_DEFAULT), H5Gclose, "group " + name + " is missing"};
}

herr_t collect_link(hid_t, const char* name, const H5L_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}
herr_t collect_attribute(hid_t, const char* name, const H5A_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

std::vector<std::string> members(hid_t group) {
  std::vector<std::string> names;
  if (H5Literate(group, H5_INDEX_CRT_ORDER, H5_ITER_INC, nullptr, collect_link, &names) < 0) {
    throw InputError("HDF5: cannot list a group");
  }
  return names;
}

PointRecord read_point(hid_t points, const std::string& key) {
  const Handle group = open_group(points, key);
  PointRecord point;
  point.key = key;
  point.protocol = read_text(group, "protocol");
  point.status = read_text(group, "status");
  point.message = read_text(group, "message");
  point.wall_seconds = read_number(group, "wall_seconds");
  const Handle conditions = open_group(group, "conditions");
  for (const std::string& name : members(conditions))
    point.conditions[name] = read_quantity(conditions, name).value;
  const Handle results = open_group(group, "results");
  for (const std::string& name : members(results)) point.results[name] = read_quantity(results, name);
  const Handle provenance = open_group(group, "provenance");
  std::vector<std::string> names;
  H5Aiterate2(provenance, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_attribute, &names);
  for (const std::string& name : names) point.provenance[name] = read_text(provenance, name);
  return point;
}

void write_point(hid_t points, const PointRecord& point) {
  const Handle group = make_group(points, point.key);
  write_text(group, "protocol", point.protocol);
  write_text(group, "status", point.status);
  write_text(group, "message", point.message);
  write_number(group, "wall_seconds", point.wall_seconds);
  const Handle conditions = make_group(group, "conditions");
  for (const auto& [name, value] : point.conditions) write_quantity(conditions, name, {&value, 1});
  const Handle results = make_group(group, "results");
  for (const auto& [name, estimate] : point.results) {
    const std::array<double, 2> numbers = {estimate.value, estimate.error};
    write_quantity(results, name, numbers);
  }
  const Handle provenance = make_group(group, "provenance");
  for (const auto& [name, text] : point.provenance) write_text(provenance, name, text);
}

Handle open_file(const std::filesystem::path& path, unsigned flags) {
  return {H5Fopen(path.c_str(), flags, H5P_DEFAULT), H5Fclose,
          fmt::format("{} is not an HDF5 file, or is damaged", path.string())};
}

/// @throws InputError unless the file is a store of a format that this program knows.
void check_format(hid_t file, const std::filesystem::path& path) {
  if (H5Aexists(file, "format") <= 0 || read_text(file, "format") != format_name) {
    throw InputError(
        fmt::format("{} is an HDF5 file, but not a store of molecular-dynamics points", path.string()));
  }
  const double version = read_number(file, "version");
  if (version > static_cast<double>(format_version)) {
    throw InputError(fmt::format("{} has format version {}, this program reads versions up to {}",
                                 path.string(), version, format_version));
  }
}

Handle create_file(const std::filesystem::path& path) {
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "property list");
  // The version-1.8 layout stores small groups and attributes compactly and is read by every HDF5 in use.
  H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V110);
  Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose,
              fmt::format("cannot create {}", path.string()));
  write_text(file, "format", format_name);
  write_number(file, "version", static_cast<double>(format_version));
  make_group(file, "points");
  return file;
}

// ---- files
// ------------------------------------------------------------------------------------------------------

std::filesystem::path beside(const std::filesystem::path& path, const char* ending) {
  return path.parent_path() / fmt::format(".{}{}", path.filename().string(), ending);
}

/// Exclusive lock for the writers of one store, held while the object lives.
class WriterLock {
 public:
  explicit WriterLock(const std::filesystem::path& store) {
    const std::filesystem::path path = beside(store, ".lock");
    descriptor_ = ::open(path.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0644);
    if (descriptor_ < 0 || ::flock(descriptor_, LOCK_EX) != 0) {
      const std::string reason = std::strerror(errno);
      if (descriptor_ >= 0) ::close(descriptor_);
      throw InputError(
          fmt::format("cannot write {}: lock file {}: {}", store.string(), path.string(), reason));
    }
  }
  WriterLock(const WriterLock&) = delete;
  WriterLock& operator=(const WriterLock&) = delete;
  ~WriterLock() { ::close(descriptor_); }

 private:
  int descriptor_ = -1;
};

void sync_to_disk(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
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

std::string PointRecord::label() const {
  std::string text = protocol;
  const char* joint = " at ";
  for (const auto& [name, value] : conditions) {
    text += fmt::format("{}{} = {}", joint, name, units::format_quantity(value, unit_of(name)));
    joint = ", ";
  }
  return text;
}

std::string_view unit_of(std::string_view quantity) {
  static const std::map<std::string_view, std::string_view> units = {
      {"temperature", "K"},
      {"pressure", "Pa"},
      {"specific_volume", "m^3/kg"},
      {"specific_internal_energy", "J/kg"},
      {"lattice_constant", "m"},
      {"cohesive_energy", "J/kg"},
      {"mean_square_displacement", "m^2"},
      {"shock_velocity", "m/s"},
      {"particle_velocity", "m/s"},
      {"melting_temperature", "K"},
      {"solid_specific_volume", "m^3/kg"},
      {"liquid_specific_volume", "m^3/kg"},
      {"latent_heat", "J/kg"},
  };
  const auto found = units.find(quantity);
  return found == units.end() ? std::string_view{} : found->second;
}

std::vector<PointRecord> read_store(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) {
    throw InputError(
        fmt::format("the store {} does not exist; 'whipple md PLAN.toml' makes one", path.string()));
  }
  const QuietHdf5 quiet;
  const Handle file = open_file(path, H5F_ACC_RDONLY);
  check_format(file, path);
  const Handle points = open_group(file, "points");
  std::vector<PointRecord> records;
  for (const std::string& key : members(points)) records.push_back(read_point(points, key));
  return records;
}

std::vector<PointRecord> select(std::span<const PointRecord> points, std::string_view protocol) {
  std::vector<PointRecord> chosen;
  std::copy_if(points.begin(), points.end(), std::back_inserter(chosen),
               [&](const PointRecord& point) { return point.done() && point.protocol == protocol; });
  return chosen;
}

bool append_point(const std::filesystem::path& path, const PointRecord& point) {
  if (point.key.empty() || point.protocol.empty() || (point.status != "done" && point.status != "failed")) {
    throw InternalError("a point needs a key, a protocol and a status 'done' or 'failed' to be stored");
  }
  std::filesystem::create_directories(std::filesystem::absolute(path).parent_path());
  const WriterLock lock(path);
  const QuietHdf5 quiet;
  const std::filesystem::path copy = beside(path, ".part");
  const bool exists = std::filesystem::exists(path);
  if (exists) std::filesystem::copy_file(path, copy, std::filesystem::copy_options::overwrite_existing);
  {
    Handle file = exists ? open_file(copy, H5F_ACC_RDWR) : create_file(copy);
    check_format(file, path);
    {
      const Handle points = open_group(file, "points");
      if (H5Lexists(points, point.key.c_str(), H5P_DEFAULT) > 0) {
        if (read_point(points, point.key).done()) return false;  // the copy is dropped by the next writer
        H5Ldelete(points, point.key.c_str(), H5P_DEFAULT);
      }
      write_point(points, point);
    }
    file.close_now(fmt::format("cannot write {}", copy.string()));
  }
  sync_to_disk(copy);
  std::filesystem::rename(copy, path);
  return true;
}

void require_writable(const std::filesystem::path& path) {
  const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
  std::error_code fault;
  std::filesystem::create_directories(folder, fault);
  if (fault) throw InputError(fmt::format("cannot make the folder {}: {}", folder.string(), fault.message()));
  if (std::filesystem::is_directory(path)) throw InputError(fmt::format("{} is a folder", path.string()));
  if (std::filesystem::exists(path)) {
    read_store(path);  // reports a file that is something else, before any work
    if (::access(path.c_str(), W_OK) != 0)
      throw InputError(fmt::format("{} is write-protected", path.string()));
  }
  const WriterLock lock(path);
}

}  // namespace whipple::md
