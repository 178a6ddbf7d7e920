// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "src/core/hdf5/hdf5.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/io/output_fields.hpp"
#include "src/io/ranks.hpp"

/// Writes the common parts of the VTKHDF files of particles and of elements (docs/manual/output.md).
namespace whipple::io {

/// Describes the representation of a field value in the file.
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
template <>
struct Row<Matrix3> {
  using Number = float;
  static constexpr std::uint64_t columns = 9;  ///< xx xy xz yx yy yz zx zy zz
  static void put(const Matrix3& value, float* row) {
    Eigen::Map<Eigen::Matrix<float, 3, 3, Eigen::RowMajor>>{row} = value.cast<float>();
  }
};
template <class Integer>
  requires std::is_integral_v<Integer>
struct Row<Integer> {
  using Number = Integer;
  static constexpr std::uint64_t columns = 0;
  static void put(Integer value, Integer* row) { *row = value; }
};

/// Describes an array of a snapshot. Its numbers are computed by a function of the row when the array is written, or
/// earlier if the points will have moved by then.
class Array {
 public:
  enum class From { points, row_number };
  /// @param value  value(i) for the rows of this process
  /// @param from   data that the function needs: the current points, or only the row number
  template <class Function>
  Array(std::string name, const hdf5::Slab& slab, Function value, From from = From::points)
      : name_(std::move(name)), slab_(slab), from_(from) {
    using R = Row<std::decay_t<decltype(value(std::size_t{0}))>>;
    columns_ = R::columns;
    evaluate_ = [value = std::move(value), count = slab.count]() -> Numbers {
      constexpr std::uint64_t width = R::columns == 0 ? 1 : R::columns;
      std::vector<typename R::Number> numbers(count * width);
      parallel::for_each(count, [&](std::size_t i) { R::put(value(i), numbers.data() + i * width); });
      return numbers;
    };
  }

  void set_attribute(std::string_view name, std::string_view text) { attributes_.emplace_back(name, text); }
  /// Evaluates the current values, if they depend on the points.
  void evaluate() {
    if (from_ == From::row_number) return;
    numbers_ = evaluate_();
    evaluate_ = nullptr;  // together with its captured data
  }
  /// Writes the array and frees the memory of its numbers.
  void write(const hdf5::Group& group, int deflate);

 private:
  using Numbers =
      std::variant<std::monostate, std::vector<float>, std::vector<std::uint8_t>, std::vector<std::uint16_t>,
                   std::vector<std::uint64_t>, std::vector<std::int64_t>>;
  std::string name_;
  hdf5::Slab slab_;
  From from_;
  std::uint64_t columns_ = 0;
  std::function<Numbers()> evaluate_;
  Numbers numbers_;
  std::vector<std::pair<std::string, std::string>> attributes_;
};

/// Defines cell types of VTK.
constexpr std::uint8_t vtk_vertex = 1, vtk_line = 3, vtk_quad = 9, vtk_hexahedron = 12;

/// Holds an unstructured grid of VTKHDF 1.0, one partition per rank.
struct UnstructuredGrid {
  double time = 0.0;                                          ///< s
  std::uint64_t points = 0, cells = 0, connectivity_ids = 0;  ///< of this process
  std::vector<Array> geometry = {};                           ///< points, then the cells
  std::vector<Array> cell_data = {}, point_data = {};

  /// Evaluates the current values: afterwards `write` does not need the points.
  void evaluate();
  /// Writes the grid to a file. Collective.
  void write(const std::filesystem::path& path, const Ranks& ranks,
             const std::map<std::string, std::string>& provenance, int deflate);
};

/// Returns the fields of a source, one row per point of the slab.
/// @throws InternalError if a point belongs to a body whose material is not in the source
std::vector<Array> arrays_of(std::span<const OutputField> fields, const FieldSource& source,
                             const hdf5::Slab& slab);

}  // namespace whipple::io
