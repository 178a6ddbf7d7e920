// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "src/base/error.hpp"
#include "src/hdf5/hdf5.hpp"
#include "src/io/output_fields.hpp"
#include "src/io/ranks.hpp"
#include "src/parallel/threads.hpp"

/// What the VTKHDF files of particles and of elements have in common (docs/output.md).
namespace whipple::io {

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

/// Evaluates value(i) for every point and writes the array.
template <class Value, class Function>
hdf5::Dataset write_array(const hdf5::Group& group, const std::string& name, const hdf5::Slab& slab,
                          int deflate, Function&& value) {
  using R = Row<Value>;
  constexpr std::uint64_t width = R::columns == 0 ? 1 : R::columns;
  std::vector<typename R::Number> numbers(slab.count * width);
  parallel::for_each(slab.count, [&](std::size_t i) { R::put(value(i), numbers.data() + i * width); });
  return group.write<typename R::Number>(name, numbers, slab, {.columns = R::columns, .deflate = deflate});
}

/// Group VTKHDF of an unstructured grid, version 1.0.
inline hdf5::Group create_unstructured_grid(const hdf5::File& file) {
  hdf5::Group vtk = file.root.create_group("VTKHDF");
  const std::array<std::int64_t, 2> version = {1, 0};
  vtk.set_attribute("Version", version);
  vtk.set_fixed_attribute("Type", "UnstructuredGrid");
  return vtk;
}

/// The fields of a source, one row per point of the slab.
inline void write_fields(const hdf5::Group& group, std::span<const OutputField> fields,
                         const FieldSource& source, const hdf5::Slab& slab, int deflate) {
  for (const std::uint32_t body : source.particles.body) {
    if (body >= source.material_of_body.size()) {
      throw InternalError("a point of a body whose material was not given: body " + std::to_string(body));
    }
  }
  for (const OutputField& field : fields) {
    std::visit(
        [&](auto value) {
          using Value = decltype(value(source, std::size_t{0}));
          const hdf5::Dataset array = write_array<Value>(group, std::string(field.name), slab, deflate,
                                                         [&](std::size_t i) { return value(source, i); });
          array.set_attribute("unit", field.unit);
          array.set_attribute("meaning", field.meaning);
        },
        field.value);
  }
}

/// Time and provenance.
inline void write_run(const hdf5::File& file, const hdf5::Group& vtk, double time, const Ranks& ranks,
                      const std::map<std::string, std::string>& provenance) {
  const hdf5::Group field_data = vtk.create_group("FieldData");
  const std::array<double, 1> times = {time};
  const std::uint64_t mine = ranks.is_root() ? 1 : 0;
  field_data.write<double>("TimeValue", {times.data(), mine}, {0, mine, 1});
  const hdf5::Group run = file.root.create_group("run");
  for (const auto& [name, value] : provenance) run.set_attribute(name, std::string_view(value));
  run.set_attribute("ranks", static_cast<std::int64_t>(ranks.count()));
  run.set_attribute("unit_system", std::string_view("SI"));
}

}  // namespace whipple::io
