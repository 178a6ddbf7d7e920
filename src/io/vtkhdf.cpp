// SPDX-License-Identifier: BSD-3-Clause
#include "src/io/vtkhdf.hpp"

#include <fmt/format.h>

#include "src/core/base/error.hpp"

namespace whipple::io {

void Array::write(const hdf5::Group& group, int deflate) {
  if (std::holds_alternative<std::monostate>(numbers_)) numbers_ = evaluate_();
  std::visit(
      [&]<class Stored>(const Stored& numbers) {
        if constexpr (!std::is_same_v<Stored, std::monostate>) {
          using Number = typename Stored::value_type;
          const hdf5::Dataset array =
              group.write<Number>(name_, numbers, slab_, {.columns = columns_, .deflate = deflate});
          for (const auto& [name, text] : attributes_) array.set_attribute(name, std::string_view(text));
        }
      },
      numbers_);
  numbers_ = {};
}

void UnstructuredGrid::evaluate() {
  for (auto* arrays : {&geometry, &cell_data, &point_data}) {
    for (Array& array : *arrays) array.evaluate();
  }
}

void UnstructuredGrid::write(const std::filesystem::path& path, const Ranks& ranks,
                             const std::map<std::string, std::string>& provenance, int deflate) {
  hdf5::File file = hdf5::File::create(path, hdf5::File::Compatibility::vtk, 0, ranks.communicator());
  const hdf5::Group vtk = file.root.create_group("VTKHDF");
  const std::array<std::int64_t, 2> version = {1, 0};
  vtk.set_attribute("Version", version);
  vtk.set_fixed_attribute("Type", "UnstructuredGrid", hdf5::Characters::ascii);
  const auto rank = static_cast<std::uint64_t>(ranks.rank()),
             partitions = static_cast<std::uint64_t>(ranks.count());
  const auto write_count = [&](const char* name, std::uint64_t count) {
    const std::array<std::int64_t, 1> value = {static_cast<std::int64_t>(count)};
    vtk.write<std::int64_t>(name, value, {rank, 1, partitions});
  };
  write_count("NumberOfPoints", points);
  write_count("NumberOfCells", cells);
  write_count("NumberOfConnectivityIds", connectivity_ids);
  for (Array& array : geometry) array.write(vtk, deflate);
  const auto write_group = [&](const char* name, std::vector<Array>& arrays) {
    if (arrays.empty()) return;
    const hdf5::Group group = vtk.create_group(name);
    for (Array& array : arrays) array.write(group, deflate);
  };
  write_group("CellData", cell_data);
  write_group("PointData", point_data);

  const hdf5::Group field_data = vtk.create_group("FieldData");
  const std::array<double, 1> times = {time};
  const std::uint64_t mine = ranks.is_root() ? 1 : 0;
  field_data.write<double>("TimeValue", {times.data(), mine}, {0, mine, 1});
  const hdf5::Group run = file.root.create_group("run");
  for (const auto& [name, value] : provenance) run.set_attribute(name, std::string_view(value));
  run.set_attribute("ranks", static_cast<std::int64_t>(ranks.count()));
  run.set_attribute("unit_system", std::string_view("SI"));
  file.close();
}

namespace {

/// Returns the array of a field declared by a material model, with neutral values if no material of the particles has
/// it.
Array history_array(const HistoryField& field, const Particles& particles, const hdf5::Slab& slab) {
  const History* found = particles.history.find(field.name);
  return std::visit(
      [&]<class Value>(const std::vector<Value>&) {
        const auto* values = found == nullptr ? nullptr : &std::get<std::vector<Value>>(found->values);
        return Array(field.name, slab,
                     [values, neutral = neutral_value<Value>(field.neutral)](std::size_t i) {
                       return values == nullptr || values->empty() ? neutral : (*values)[i];
                     });
      },
      History(field).values);
}

}  // namespace

std::vector<Array> arrays_of(std::span<const OutputField> fields, const FieldSource& source,
                             const hdf5::Slab& slab) {
  for (const std::uint32_t body : source.particles.body) {
    if (body >= source.material_of_body.size()) {
      throw InternalError(fmt::format("a point of a body whose material was not given: body {}", body));
    }
  }
  std::vector<Array> arrays;
  for (const OutputField& field : fields) {
    std::visit(
        [&](auto value) {
          if constexpr (std::is_same_v<decltype(value), const HistoryField*>) {
            arrays.push_back(history_array(*value, source.particles, slab));
          } else {
            arrays.emplace_back(std::string(field.name), slab,
                                [value, source](std::size_t i) { return value(source, i); });
          }
        },
        field.value);
    arrays.back().set_attribute("unit", field.unit);
    arrays.back().set_attribute("meaning", field.meaning);
  }
  return arrays;
}

}  // namespace whipple::io
