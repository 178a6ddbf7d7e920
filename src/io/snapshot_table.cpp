// SPDX-License-Identifier: BSD-3-Clause
#include "src/io/snapshot_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <span>

#include "src/core/base/error.hpp"
#include "src/core/base/text.hpp"
#include "src/core/hdf5/hdf5.hpp"
#include "src/io/output_fields.hpp"
#include "src/io/vtkhdf.hpp"

namespace whipple::io {
namespace {

static_assert(std::endian::native == std::endian::little, "appended arrays are little endian");

std::string unit_of(const std::string& name) {
  for (const OutputField& field : output_fields()) {
    if (field.name == name) return std::string(field.unit);
  }
  return "";
}

template <class Number>
bool read_as(const hdf5::Dataset& set, const hdf5::Dataset::Shape& shape, SnapshotTable::Column& column) {
  if (!set.stores<Number>()) return false;
  column.values = set.read_all<Number>(shape);
  return true;
}

std::vector<SnapshotTable::Column> read_columns(const hdf5::Group& group, std::uint64_t rows) {
  std::vector<SnapshotTable::Column> columns;
  for (const std::string& name : group.names()) {
    const hdf5::Dataset set = group.open_dataset(name);
    const std::vector<std::uint64_t> shape = set.shape();
    SnapshotTable::Column column{name, unit_of(name), shape.size() == 2 ? shape[1] : 1, {}};
    const hdf5::Dataset::Shape expected{rows, column.components};
    if (!read_as<float>(set, expected, column) && !read_as<std::uint8_t>(set, expected, column) &&
        !read_as<std::uint16_t>(set, expected, column) && !read_as<std::uint64_t>(set, expected, column)) {
      throw InputError(fmt::format("{}: error: is of a type that snapshots do not have", set.name()));
    }
    columns.push_back(std::move(column));
  }
  return columns;
}

/// Reads the cells; the point numbers and list ends of each rank are relative to the part of that rank.
void read_cells(const hdf5::Group& vtk, const std::string& file, SnapshotTable& table) {
  const auto fail = [&](const char* why) { throw InputError(fmt::format("{}: error: {}", file, why)); };
  const auto points_of = vtk.open_dataset("NumberOfPoints").read_all<std::int64_t>();
  const auto cells_of = vtk.open_dataset("NumberOfCells").read_all<std::int64_t>();
  const auto ids_of = vtk.open_dataset("NumberOfConnectivityIds").read_all<std::int64_t>();
  table.types = vtk.open_dataset("Types").read_all<std::uint8_t>();
  table.connectivity = vtk.open_dataset("Connectivity").read_all<std::int64_t>();
  const auto offsets = vtk.open_dataset("Offsets").read_all<std::int64_t>();
  const std::size_t ranks = points_of.size();
  if (cells_of.size() != ranks || ids_of.size() != ranks)
    fail("its numbers of points and cells differ in length");
  std::int64_t point = 0, cell = 0, id = 0, offset = 0;
  const std::int64_t points = std::ssize(table.points) / 3, cells = std::ssize(table.types),
                     ids = std::ssize(table.connectivity);
  for (std::size_t rank = 0; rank < ranks; ++rank) {
    if (points_of[rank] < 0 || cells_of[rank] < 0 || ids_of[rank] < 0 || points_of[rank] > points - point ||
        cells_of[rank] > cells - cell || ids_of[rank] > ids - id ||
        cells_of[rank] >= std::ssize(offsets) - offset) {
      fail("its parts do not add up to its points and cells");
    }
    for (std::int64_t i = id; i < id + ids_of[rank]; ++i) {
      std::int64_t& corner = table.connectivity[static_cast<std::size_t>(i)];
      if (corner < 0 || corner >= points_of[rank]) fail("a cell names a point that is not there");
      corner += point;
    }
    std::int64_t last = 0;
    for (std::int64_t i = 1; i <= cells_of[rank]; ++i) {
      const std::int64_t end = offsets[static_cast<std::size_t>(offset + i)];
      if (end < last || end > ids_of[rank]) fail("the lists of its cells are not in order");
      last = end;
      table.offsets.push_back(id + end);
    }
    point += points_of[rank];
    cell += cells_of[rank];
    id += ids_of[rank];
    offset += cells_of[rank] + 1;
  }
  if (point != points || cell != cells || id != ids) fail("its parts do not add up to its points and cells");
}

void keep(std::vector<SnapshotTable::Column>& columns, const std::vector<std::string>& fields) {
  std::erase_if(columns,
                [&](const auto& column) { return std::ranges::find(fields, column.name) == fields.end(); });
}

std::string title_of(const std::string& name, const std::string& unit) {
  return unit.empty() || unit == "1" ? name : fmt::format("{} [{}]", name, unit);
}

/// Appends arrays one after another, each preceded by its size in bytes.
class Appended {
 public:
  /// Appends an array and returns its XML element.
  template <class Number>
  std::string array(const std::string& name, std::size_t components, std::span<const Number> values) {
    static_assert(std::is_arithmetic_v<Number>);
    const char* const type = std::is_same_v<Number, float>           ? "Float32"
                             : std::is_same_v<Number, double>        ? "Float64"
                             : std::is_same_v<Number, std::int64_t>  ? "Int64"
                             : std::is_same_v<Number, std::uint8_t>  ? "UInt8"
                             : std::is_same_v<Number, std::uint16_t> ? "UInt16"
                                                                     : "UInt64";
    const std::string element = fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n",
        type, name, components, bytes_.size());
    append(std::uint64_t{values.size_bytes()});
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());  // NOLINT
    return element;
  }
  std::string columns(const std::vector<SnapshotTable::Column>& columns) {
    std::string elements;
    for (const auto& column : columns) {
      std::visit(
          [&](const auto& values) {
            elements += array(title_of(column.name, column.unit), column.components, std::span(values));
          },
          column.values);
    }
    return elements;
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  void append(std::uint64_t number) {
    const auto raw = std::bit_cast<std::array<char, sizeof number>>(number);
    bytes_.append(raw.data(), raw.size());
  }
  std::string bytes_;
};

std::string component_name(const SnapshotTable::Column& column, std::size_t k) {
  constexpr std::array<const char*, 3> of_vector = {"x", "y", "z"};
  constexpr std::array<const char*, 6> of_tensor = {"xx", "yy", "zz", "xy", "yz", "zx"};
  const std::string part = column.components == 1   ? column.name
                           : column.components == 3 ? fmt::format("{}_{}", column.name, of_vector[k])
                           : column.components == 6 ? fmt::format("{}_{}", column.name, of_tensor[k])
                                                    : fmt::format("{}_{}", column.name, k);
  return title_of(part, column.unit);
}

}  // namespace

SnapshotTable read_snapshot_table(const std::filesystem::path& path, double time,
                                  const std::vector<std::string>& fields) {
  const hdf5::File file = hdf5::File::open(path);
  const hdf5::Group vtk = file.root.open_group("VTKHDF");
  SnapshotTable table;
  table.time = time;
  const hdf5::Dataset points = vtk.open_dataset("Points");
  table.points = points.read_all<float>({points.stored_shape().rows, 3});
  read_cells(vtk, path.string(), table);
  table.point_data = read_columns(vtk.open_group("PointData"), table.points.size() / 3);
  if (vtk.has("CellData")) table.cell_data = read_columns(vtk.open_group("CellData"), table.types.size());
  if (fields.empty()) return table;
  std::vector<std::string> known;
  for (const auto* columns : {&table.point_data, &table.cell_data}) {
    for (const auto& column : *columns) known.push_back(column.name);
  }
  for (const std::string& name : fields) {
    if (std::ranges::find(known, name) != known.end()) continue;
    throw InputError(fmt::format("{}: error: has no field \"{}\"{}; known: {}", path.string(), name,
                                 did_you_mean(name, known), fmt::join(known, ", ")));
  }
  keep(table.point_data, fields);
  keep(table.cell_data, fields);
  return table;
}

std::string vtu_text(const SnapshotTable& table) {
  Appended data;
  const std::array time = {table.time};
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n"
      "<UnstructuredGrid>\n<FieldData>\n";
  std::string time_element = data.array<double>("TimeValue", 1, time);
  time_element.insert(time_element.find(" format"), " NumberOfTuples=\"1\"");
  text += time_element + "</FieldData>\n";
  text += fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", table.points.size() / 3,
                      table.types.size());
  text += "<PointData>\n" + data.columns(table.point_data) + "</PointData>\n";
  text += "<CellData>\n" + data.columns(table.cell_data) + "</CellData>\n";
  text += "<Points>\n" + data.array<float>("Points", 3, table.points) + "</Points>\n<Cells>\n";
  text += data.array<std::int64_t>("connectivity", 1, table.connectivity);
  text += data.array<std::int64_t>("offsets", 1, table.offsets);
  text += data.array<std::uint8_t>("types", 1, table.types);
  text += "</Cells>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
  return text + data.bytes() + "\n</AppendedData>\n</VTKFile>\n";
}

std::string csv_text(const SnapshotTable& table) {
  const bool of_points =
      std::ranges::all_of(table.types, [](std::uint8_t type) { return type == vtk_vertex; });
  const std::vector<SnapshotTable::Column>& columns = of_points ? table.point_data : table.cell_data;
  std::vector<std::string> heads = {"x [m]", "y [m]", "z [m]"};
  for (const auto& column : columns) {
    for (std::size_t k = 0; k < column.components; ++k) heads.push_back(component_name(column, k));
  }
  std::string text = fmt::format("{}\n", fmt::join(heads, ","));
  const std::size_t rows = of_points ? table.points.size() / 3 : table.types.size();
  for (std::size_t row = 0; row < rows; ++row) {
    const std::size_t first = of_points || row == 0 ? 0 : static_cast<std::size_t>(table.offsets[row - 1]);
    const std::size_t last = of_points ? 0 : static_cast<std::size_t>(table.offsets[row]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double sum = of_points ? double{table.points[3 * row + axis]} : 0.0;
      for (std::size_t i = first; i < last; ++i) {
        sum += table.points[3 * static_cast<std::size_t>(table.connectivity[i]) + axis];
      }
      if (axis > 0) text += ',';
      fmt::format_to(std::back_inserter(text), "{}",
                     static_cast<float>(sum / std::max<double>(double(last - first), 1.0)));
    }
    for (const auto& column : columns) {
      std::visit(
          [&](const auto& values) {
            for (std::size_t k = 0; k < column.components; ++k) {
              fmt::format_to(std::back_inserter(text), ",{}", +values[row * column.components + k]);
            }
          },
          column.values);
    }
    text += '\n';
  }
  return text;
}

}  // namespace whipple::io
