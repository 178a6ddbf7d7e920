// SPDX-License-Identifier: BSD-3-Clause
#include "eos/files/table_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <utility>

#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/hash.hpp"
#include "src/core/base/log.hpp"
#include "src/core/hdf5/hdf5.hpp"

namespace whipple::eos {
namespace {

namespace fs = std::filesystem;

constexpr const char* format_name = "whipple-eos-table";
constexpr std::int64_t format_version = 4;

/// Describes the numbers of a table, one attribute each.
struct Number {
  const char* name;
  double TableData::* member;
};
constexpr Number numbers[] = {
    {"requested_error", &TableData::requested_error},
    {"condensed", &TableData::condensed},
    {"thermal_energy", &TableData::thermal_energy},
    {"least_sound_speed", &TableData::least_sound_speed},
    {"least_temperature", &TableData::least_temperature},
    {"greatest_temperature", &TableData::greatest_temperature},
    {"reference_density", &TableData::reference_density},
    {"reference_temperature", &TableData::reference_temperature},
    {"reference_energy", &TableData::reference_energy},
};

struct ErrorNumber {
  const char* name;
  double TableError::* member;
};
constexpr ErrorNumber error_numbers[] = {
    {"temperature", &TableError::temperature}, {"pressure", &TableError::pressure},
    {"sound_speed", &TableError::sound_speed}, {"mean_sound_speed", &TableError::mean_sound_speed},
    {"fraction", &TableError::fraction},       {"mean_fraction", &TableError::mean_fraction},
};

/// Holds the arrays of the file.
struct Arrays {
  std::vector<double> bounds;         ///< of strips: begin, end, top, slope of the top
  std::vector<std::uint32_t> layout;  ///< of strips: the indices visited by `for_each_index`
  std::vector<double> curves;         ///< of intervals: 6 coefficients of 4 curves
  std::vector<double> cells;
  std::vector<std::uint16_t> fractions;
};
constexpr std::size_t bounds_width = 4, curves_width = 24;
constexpr std::size_t layout_width = 3 + 7 * TableData::greatest_regions;

template <class Strip, class Visitor>
void for_each_index(Strip& strip, Visitor&& visit) {
  visit(strip.first_interval);
  visit(strip.intervals);
  visit(strip.region_count);
  for (auto& r : strip.regions) {
    for (auto* index :
         {&r.first_cell, &r.nx, &r.ny, &r.first_fraction, &r.fraction_nx, &r.fraction_ny, &r.phase})
      visit(*index);
  }
}

Arrays arrays_of(const TableData& data) {
  Arrays a;
  for (const TableData::Strip& s : data.strips) {
    a.bounds.insert(a.bounds.end(), {s.begin, s.end, s.top, s.top_slope});
    for_each_index(s, [&](std::uint32_t index) { a.layout.push_back(index); });
  }
  for (const TableData::Interval& interval : data.intervals) {
    for (const Lanes& lanes : interval) {
      for (std::size_t k = 0; k < 4; ++k) a.curves.push_back(lanes[k]);
    }
  }
  a.cells = data.cells;
  for (const auto& pair : data.fractions) a.fractions.insert(a.fractions.end(), pair.begin(), pair.end());
  return a;
}

/// Returns the SHA-256 of everything on which a result depends.
std::string digest_of(const TableData& data, const Arrays& arrays) {
  std::string bytes = fmt::format("{}\n{}\n{}\n", data.origin, data.constants, fmt::join(data.phases, "\n"));
  const auto add = [&](const auto& values) {
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(values[0]));
  };
  for (const Number& number : numbers) add(std::array<double, 1>{data.*number.member});
  add(arrays.bounds);
  add(arrays.layout);
  add(arrays.curves);
  add(arrays.cells);
  add(arrays.fractions);
  return sha256(bytes);
}

template <class T>
void write_array(const hdf5::Group& group, const char* name, const std::vector<T>& values,
                 std::uint64_t columns, const char* unit) {
  const hdf5::Dataset array = group.write<T>(name, values, hdf5::Slab::whole(values.size() / columns),
                                             {.columns = columns, .deflate = 4});
  array.set_fixed_attribute("unit", unit);
}

template <class T>
std::vector<T> read_array(const hdf5::Group& group, const char* name, std::uint64_t columns) {
  const hdf5::Dataset array = group.open_dataset(name);
  const std::vector<std::uint64_t> shape = array.shape();
  if (shape.size() != 2 || shape[1] != columns) {
    throw InputError(fmt::format("{}: is no array of {} columns", array.name(), columns));
  }
  std::vector<T> values = array.read_all<T>();
  if (!std::ranges::all_of(values, [](T x) { return std::isfinite(static_cast<double>(x)); }))
    throw InputError(fmt::format("{}: holds numbers that are not finite", array.name()));
  return values;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

}  // namespace

void write_table(const fs::path& path, const TableFile& table) {
  const TableData& data = table.data;
  const Arrays arrays = arrays_of(data);
  PartialFile partial(path);
  hdf5::File file = hdf5::File::create(partial.path(), hdf5::File::Compatibility::compact);
  const hdf5::Group& root = file.root;
  root.set_fixed_attribute("format", format_name);
  root.set_attribute("version", format_version);
  root.set_fixed_attribute("unit_system", "SI");
  root.set_fixed_attribute("model", data.origin);
  root.set_fixed_attribute("constants", data.constants);
  root.set_fixed_attribute("phases", fmt::format("{}", fmt::join(data.phases, "\n")));
  for (const Number& number : numbers) root.set_attribute(number.name, data.*number.member);
  root.set_fixed_attribute("digest", digest_of(data, arrays));
  write_array(root, "strip_bounds", arrays.bounds, bounds_width, "ln(kg/m^3), ln(kg/m^3), ln(J/kg), 1");
  write_array(root, "strip_layout", arrays.layout, layout_width, "");
  write_array(root, "curves", arrays.curves, curves_width, "J/kg, ln(J/kg)");
  write_array(root, "cells", arrays.cells, TableData::cell_size, "J/(kg K)");
  write_array(root, "fractions", arrays.fractions, 2, "1/65535");
  const hdf5::Group verification = root.create_group("verification");
  for (const auto& [phase, error] : table.verification) {
    const hdf5::Group group = verification.create_group(phase);
    group.set_attribute("states", static_cast<std::int64_t>(error.states));
    group.set_attribute("beyond", static_cast<std::int64_t>(error.beyond));
    for (const ErrorNumber& number : error_numbers) group.set_attribute(number.name, error.*number.member);
  }
  file.close();
  partial.publish();
}

TableFile read_table(const fs::path& path) {
  if (!fs::is_regular_file(path)) throw InputError(fmt::format("{}: does not exist", path.string()));
  const hdf5::File file = hdf5::File::open(path);
  const hdf5::Group& root = file.root;
  if (!root.has_attribute("format") || root.text_attribute("format") != format_name) {
    throw InputError(fmt::format("{}: is an HDF5 file, but no table of an equation of state", path.string()));
  }
  if (const std::int64_t version = root.integer_attribute("version"); version != format_version) {
    throw InputError(
        fmt::format("{}: is a table of version {}, this program reads version {}; 'whipple eos "
                    "table' writes it again",
                    path.string(), version, format_version));
  }
  TableFile result;
  TableData& data = result.data;
  data.origin = root.text_attribute("model");
  data.constants = root.text_attribute("constants");
  data.phases = lines_of(root.text_attribute("phases"));
  for (const Number& number : numbers) data.*number.member = root.real_attribute(number.name);
  Arrays arrays;
  arrays.bounds = read_array<double>(root, "strip_bounds", bounds_width);
  arrays.layout = read_array<std::uint32_t>(root, "strip_layout", layout_width);
  arrays.curves = read_array<double>(root, "curves", curves_width);
  arrays.cells = read_array<double>(root, "cells", TableData::cell_size);
  arrays.fractions = read_array<std::uint16_t>(root, "fractions", 2);
  if (root.text_attribute("digest") != digest_of(data, arrays)) {
    throw InputError(fmt::format("{}: is damaged: its content does not match its digest", path.string()));
  }
  if (arrays.bounds.size() / bounds_width != arrays.layout.size() / layout_width) {
    throw InputError(fmt::format("{}: strip_bounds and strip_layout differ in length", path.string()));
  }
  for (std::size_t i = 0; i < arrays.bounds.size() / bounds_width; ++i) {
    const double* b = arrays.bounds.data() + bounds_width * i;
    const std::uint32_t* next = arrays.layout.data() + layout_width * i;
    TableData::Strip strip;
    strip.begin = b[0];
    strip.end = b[1];
    strip.top = b[2];
    strip.top_slope = b[3];
    for_each_index(strip, [&](std::uint32_t& index) { index = *next++; });
    data.strips.push_back(strip);
  }
  for (std::size_t i = 0; i < arrays.curves.size() / curves_width; ++i) {
    TableData::Interval interval;
    for (std::size_t j = 0; j < 6; ++j) {
      for (std::size_t k = 0; k < 4; ++k) interval[j][k] = arrays.curves[curves_width * i + 4 * j + k];
    }
    data.intervals.push_back(interval);
  }
  data.cells = std::move(arrays.cells);
  for (std::size_t i = 0; i + 1 < arrays.fractions.size(); i += 2)
    data.fractions.push_back({arrays.fractions[i], arrays.fractions[i + 1]});
  const hdf5::Group verification = root.open_group("verification");
  for (const std::string& phase : verification.names()) {
    const hdf5::Group group = verification.open_group(phase);
    TableError& error = result.verification[phase];
    error.states = static_cast<std::size_t>(group.integer_attribute("states"));
    error.beyond = static_cast<std::size_t>(group.integer_attribute("beyond"));
    for (const ErrorNumber& number : error_numbers) error.*number.member = group.real_attribute(number.name);
  }
  return result;
}

fs::path table_cache() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache != '\0')
    return fs::path(cache) / "whipple" / "tables";
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
    return fs::path(home) / ".cache" / "whipple" / "tables";
  return {};
}

TableData cached_table(const EquationOfState& eos, const TableRequest& request, const fs::path& folder,
                       const std::string& name, const ForEach& for_each, const Report& report) {
  const std::string key =
      sha256(fmt::format("{} {}\n{}\n{}\n{} {} {} {} {}", format_name, format_version, eos.model(),
                         eos.constants(), request.error, request.minimum_density, request.maximum_density,
                         request.least_temperature, request.greatest_temperature));
  const fs::path path = folder / fmt::format("{}-{}.eos.h5", name, key.substr(0, 16));
  if (!folder.empty() && fs::exists(path)) {
    try {
      TableData data = read_table(path).data;
      if (data.origin == eos.model() && data.constants == eos.constants() &&
          data.requested_error == request.error) {
        return data;
      }
      log::warning("{}: is the table of another model, constants or error; it is built again", path.string());
    } catch (const InputError& error) {
      log::warning("{}; it is built again", error.what());
    }
  }
  TableFile table{tabulate(eos, request, for_each, report), {}};
  if (folder.empty()) return std::move(table.data);
  try {
    std::error_code fault;
    fs::create_directories(folder, fault);
    write_table(path, table);
  } catch (const InputError& error) {
    log::warning("the table is not kept for the next run: {}", error.what());
  }
  return std::move(table.data);
}

}  // namespace whipple::eos
