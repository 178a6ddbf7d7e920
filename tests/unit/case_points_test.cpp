// SPDX-License-Identifier: BSD-3-Clause
// Bodies of particles that a file gives: the same from every format, taken as they are, and what is refused.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <numbers>

#include "src/case/build/seeding.hpp"
#include "src/case/shapes/moved.hpp"
#include "src/case/shapes/points.hpp"
#include "src/case/shapes/source_file.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "tests/unit/case_support.hpp"
#include "tests/unit/folder_test.hpp"
#include "tests/unit/shape_support.hpp"

namespace whipple::cases {
namespace points_test {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr double density = 8000.0;  // kg/m^3, of the bodies without a case

struct Row {
  Vector3 place;  // mm
  double mass;    // mg
};

/// Particles of several sizes, off any lattice.
std::vector<Row> some_rows() {
  return {
      {{0.0, 0.0, 0.0}, 8.0}, {{1.25, 0.5, -0.25}, 4.0}, {{-1.5, 0.75, 2.0}, 1.0}, {{0.5, 3.0, 1.0}, 2.5}};
}

std::string csv(const std::vector<Row>& rows) {
  std::string text = "# by hand\nx [mm],y [mm],z [mm],mass [mg]\n";
  for (const auto& [x, m] : rows) text += fmt::format("{},{},{},{}\n", x[0], x[1], x[2], m);
  return text;
}

std::string base64(const std::string& bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      bits = bits << 8U | (k < left ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) text += k <= left ? digits[bits >> (18U - 6U * k) & 63U] : '=';
  }
  return text;
}

template <class Number>
std::string raw(Number value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

enum class Form : std::uint8_t { ascii, binary, appended_base64, appended_raw };

/// The particles as an unstructured grid of vertices, as ParaView writes it without compression.
std::string vtu(const std::vector<Row>& rows, Form form, const std::string& array = "mass") {
  std::string appended;
  const auto data_array = [&](const std::string& name, int parts, const std::vector<double>& values) {
    std::string head =
        fmt::format("<DataArray type=\"Float64\" Name=\"{}\" NumberOfComponents=\"{}\" ", name, parts);
    std::string bytes = raw(static_cast<std::uint32_t>(8 * values.size()));
    for (const double value : values) bytes += raw(value);
    switch (form) {
      case Form::ascii:
        return fmt::format("{}format=\"ascii\">{}</DataArray>\n", head, fmt::join(values, " "));
      case Form::binary:
        return fmt::format("{}format=\"binary\">{}</DataArray>\n", head, base64(bytes));
      default:
        head += fmt::format("format=\"appended\" offset=\"{}\"/>\n", appended.size());
        appended += form == Form::appended_raw ? bytes : base64(bytes);
        return head;
    }
  };
  std::vector<double> places, masses;
  for (const auto& [x, m] : rows) {
    places.insert(places.end(), {x[0], x[1], x[2]});
    masses.push_back(m);
  }
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
      "byte_order=\"LittleEndian\" "
      "header_type=\"UInt32\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"{0}\" NumberOfCells=\"0\">\n",
      rows.size());
  text +=
      "<PointData>\n" + data_array("velocity", 3, places) + data_array(array, 1, masses) + "</PointData>\n";
  text += "<Points>\n" + data_array("Points", 3, places) + "</Points>\n</Piece>\n</UnstructuredGrid>\n";
  if (!appended.empty()) {
    text += fmt::format("<AppendedData encoding=\"{}\">\n_{}\n</AppendedData>\n",
                        form == Form::appended_raw ? "raw" : "base64", appended);
  }
  return text + "</VTKFile>\n";
}

class PointsOfFiles : public FolderTest {
 protected:
  fs::path write(const std::string& bytes, const char* name = "points.csv") const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  /// Reads particles whose columns without unit are in mm and mg.
  std::unique_ptr<Shape> read(const std::string& bytes, bool with_units = false,
                              solids::SizeColumn size = solids::SizeColumn::whichever) const {
    write(bytes);
    PointsKeys keys{.file = "points.csv", .size = size, .digest = {}};
    if (with_units) {
      keys.unit = 1e-3;
      keys.mass_unit = 1e-6;
    }
    return Points(keys, folder_).settled({.density = density});
  }
  std::string refusal(const std::string& bytes, bool with_units = false) const {
    return message_of<InputError>([&] { read(bytes, with_units); });
  }
  /// A case with one body of copper.
  Case read_with(const std::string& shape, const std::string& domain = "",
                 const std::string& rest = "") const {
    const std::string text = fmt::format(
        "[domain]\n{}\ncell_size = \"1 mm\"\n[time]\nend = \"1 us\"\n[[body]]\nname = \"b\"\nmaterial = "
        "\"copper\"\nshape = {}\n{}",
        domain.empty() ? "lower = [\"-8 mm\", \"-8 mm\", \"-8 mm\"]\nupper = [\"8 mm\", \"8 mm\", \"8 mm\"]"
                       : domain,
        shape, rest);
    return read_case(write(text, "case.toml"), {});
  }
  std::string refusal_of(const std::string& shape, const std::string& domain = "") const {
    return message_of<InputError>([&] { read_with(shape, domain); });
  }
  static constexpr const char* file = "{ points = { file = \"points.csv\" } }";
};

TEST_F(PointsOfFiles, AreTheSameFromAllFormats) {
  const std::vector<Row> rows = some_rows();
  std::string other = "id,volume_mm3,z_m,Y [um],x_mm,mass_fraction\n";  // volumes, other units and order
  for (const auto& [x, m] : rows) {
    other += fmt::format("7,{:.17g},{:.17g},{:.17g},{:.17g},none\r\n", m * 1e-6 / density * 1e9, 1e-3 * x[2],
                         1e3 * x[1], x[0]);
  }
  std::vector<std::unique_ptr<Shape>> shapes;
  shapes.push_back(read(csv(rows)));
  shapes.push_back(read(other));
  shapes.push_back(read("\xEF\xBB\xBF" + replaced(csv(rows), "[mg]", ""), true));
  for (const Form form : {Form::ascii, Form::binary, Form::appended_base64, Form::appended_raw}) {
    shapes.push_back(read(vtu(rows, form), true));
    shapes.push_back(read(vtu(rows, form, "mass [mg]"), true));
  }
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    const auto particles = shapes[s]->particles();
    ASSERT_EQ(particles.size(), rows.size()) << "shape " << s;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      EXPECT_NEAR((particles[i].position - 1e-3 * rows[i].place).norm(), 0.0, 1e-17) << "shape " << s;
      EXPECT_NEAR(std::pow(particles[i].edge, 3) * density, 1e-6 * rows[i].mass, 1e-18) << "shape " << s;
    }
  }
}

/// The region is that of cubes of the volumes.
TEST_F(PointsOfFiles, EncloseCubesOfTheirVolumes) {
  const auto shape = read(csv(some_rows()));
  double volume = 0.0;
  for (const Row& row : some_rows()) volume += 1e-6 * row.mass / density;
  EXPECT_NEAR(shape->volume(), volume, 1e-12 * volume);
  EXPECT_NEAR(shape_test::counted(*shape, shape_test::widened(shape->bounds())), volume, 0.02 * volume);
  const double half = 0.5e-3;  // of 8 mg
  EXPECT_TRUE(shape->contains(Vector3::Constant(0.99 * half)));
  EXPECT_FALSE(shape->contains(Vector3(0, 0, 1.01 * half)));
}

TEST_F(PointsOfFiles, BecomeParticlesAsTheyAre) {
  write(csv(some_rows()));
  const Case setup = read_with(file);
  const Seeding seeding = seed(setup);
  const Particles& p = seeding.particles;
  ASSERT_EQ(p.size(), some_rows().size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Row row = some_rows()[i];
    EXPECT_NEAR((p.position[i] - 1e-3 * row.place).norm(), 0.0, 1e-17);
    EXPECT_NEAR(p.mass[i], 1e-6 * row.mass, 1e-14 * p.mass[i]);
    EXPECT_NEAR(p.volume[i], p.mass[i] / setup.materials[0]->reference.density, 1e-3 * p.volume[i]);
    EXPECT_NEAR(std::pow(4.0 * p.extent[i].xx, 1.5), p.volume[i], 1e-9 * p.volume[i]);
  }
  EXPECT_NEAR(seeding.bodies[0].mass, 15.5e-6, 1e-18);
  EXPECT_NEAR(seeding.bodies[0].shape_mass, 15.5e-6, 1e-18);
  // Two ranks have the same particles as one.
  std::size_t count = 0;
  for (const int rank : {0, 1}) {
    const Particles part = seed(setup, rank, 2).particles;
    for (std::size_t i = 0; i < part.size(); ++i, ++count)
      EXPECT_EQ(part.position[i], p.position[part.id[i]]);
  }
  EXPECT_EQ(count, p.size());
}

/// A body that a lattice fills, written to a file and read again: nothing but the last digits changes.
TEST_F(PointsOfFiles, RepeatALattice) {
  const std::string solid = "{ sphere = { center = [\"1 mm\", \"2 mm\", \"0 mm\"], radius = \"2.3 mm\" } }";
  const Particles made = seed(read_with(solid)).particles;
  std::string text = "x [m],y [m],z [m],mass [kg]\n";
  for (std::size_t i = 0; i < made.size(); ++i) {
    const Vector3& x = made.position[i];
    text += fmt::format("{},{},{},{}\n", x[0], x[1], x[2], made.mass[i]);
  }
  write(text);
  const Particles read = seed(read_with(file)).particles;
  ASSERT_EQ(read.size(), made.size());
  for (std::size_t i = 0; i < made.size(); ++i) {
    ASSERT_EQ(read.position[i], made.position[i]);
    ASSERT_NEAR(read.mass[i], made.mass[i], 1e-14 * made.mass[i]);
    ASSERT_NEAR(read.volume[i], made.volume[i], 1e-14 * made.volume[i]);
  }
}

/// In two dimensions a mass is that of 1 m of depth, or of a ring.
TEST_F(PointsOfFiles, FillSquaresInTheSection) {
  for (const bool ring : {false, true}) {
    write(fmt::format("x [mm],y [mm],mass [{}]\n1,2,4\n3,2,6\n", ring ? "cg" : "g"));
    const double unit = ring ? 1e-5 : 1e-3;  // kg
    const Case setup = read_with(
        file, fmt::format("dimension = \"{}\"\nlower = [\"-8 mm\", \"0 mm\"]\nupper = [\"8 mm\", \"8 mm\"]",
                          ring ? "axisymmetric" : "plane_strain"));
    const Particles p = seed(setup).particles;
    ASSERT_EQ(p.size(), 2U);
    EXPECT_EQ(p.position[0], Vector3(1e-3, 2e-3, p.position[0][2]));
    EXPECT_NEAR(p.mass[0], 4.0 * unit, 1e-13 * unit);
    EXPECT_NEAR(p.mass[1], 6.0 * unit, 1e-13 * unit);
    const double depth = ring ? 2.0 * std::numbers::pi * 2e-3 : 1.0;
    EXPECT_NEAR(4.0 * p.extent[0].xx * depth, p.volume[0], 1e-9 * p.volume[0]);
    EXPECT_TRUE(setup.holds(setup.bodies[0], p.position[1]));
  }
  write("x [mm],y [mm],z [mm],mass [g]\n1,2,0,4\n3,2,1,6\n");
  const std::string plane =
      "dimension = \"plane_strain\"\nlower = [\"-8 mm\", \"0 mm\"]\nupper = [\"8 mm\", \"8 mm\"]";
  EXPECT_THAT(refusal_of(file, plane), HasSubstr("points.csv:3: z = 0.001 m, where others have 0 m"));
  write("x [mm],y [mm],mass [g]\n1,0,4\n");
  EXPECT_THAT(refusal_of(file, replaced(plane, "plane_strain", "axisymmetric")),
              HasSubstr("points.csv:2: lies on or below the axis"));
}

TEST_F(PointsOfFiles, MoveAsWhole) {
  write(csv(some_rows()));
  const Case setup = read_with(
      "{ moved = { translation = [\"1 mm\", \"0 mm\", \"0 mm\"], axis = [0, 0, 1], angle = \"90 degree\", "
      "shape = "
      "{ points = { file = \"points.csv\" } } } }");
  const Particles p = seed(setup).particles;
  ASSERT_EQ(p.size(), 4U);
  EXPECT_NEAR((p.position[1] - Vector3(0.5e-3, 1.25e-3, -0.25e-3)).norm(), 0.0, 1e-15);
  EXPECT_NEAR(p.mass[1], 4e-6, 1e-18);
  for (const char* combination :
       {"{ union = [{ points = { file = \"points.csv\" } }] }",
        "{ scaled = { factors = [2, 2, 2], shape = { points = { file = \"points.csv\" } } } }"}) {
    EXPECT_THAT(refusal_of(combination), HasSubstr("particles and no solid"));
  }
}

TEST_F(PointsOfFiles, RunsKeepTheFile) {
  write(csv(some_rows()));
  const Case setup = read_with(file);
  const fs::path run = folder_ / "run";
  fs::create_directories(run);
  keep_sources(*setup.bodies[0].shape, run);
  std::ofstream(run / "run.toml") << to_toml(setup, {"copper"});
  fs::remove(folder_ / "points.csv");
  const Case again = read_case(run / "run.toml", {});
  EXPECT_EQ(seed(again).particles.mass, seed(setup).particles.mass);
  const Case written = read_written_case(run / "run.toml");
  EXPECT_DOUBLE_EQ(written.bodies[0].shape->volume(), setup.bodies[0].shape->volume());
  const std::string text =
      replaced(read_text(run / "run.toml"), "name = \"b\"", "name = \"b\"\ninitial.temperature = \"900 K\"");
  std::ofstream(run / "hot.toml") << text;
  EXPECT_THAT(message_of<InputError>([&] { read_case(run / "hot.toml", {}); }),
              HasSubstr("'density' of the points is"));
}

TEST_F(PointsOfFiles, AreRefusedWithFileAndLine) {
  const std::string head = "x [mm],y [mm],z [mm],mass [mg]\n";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "points.csv: the file is empty"},
      {"# remark\n\n", "points.csv: has no heading, only remarks"},
      {head, "points.csv: has a heading, but no particles"},
      {"1,2,3,4\n1,2,3,5\n", "points.csv:1: \"1,2,3,4\" is no heading"},
      {"x [mm],y [mm],z [mm],weight\n1,2,3,4\n",
       "points.csv: has no column 'mass' or 'volume', only: x [mm], y [mm], z"},
      {"x [mm],z [mm],mass [g]\n1,2,3\n", "points.csv: has no column 'y', only: x [mm], z [mm], mass [g]"},
      {"x [mm],x [m],y [mm],mass [g]\n1,2,3,4\n", "points.csv: has two columns 'x'"},
      {"x,y [mm],mass [g]\n1,2,3\n",
       "points.csv: the column 'x' has no unit: write it as 'x [mm]', or give 'unit'"},
      {"x [mm],y [mm],mass\n1,2,3\n",
       "points.csv: the column 'mass' has no unit: write it as 'mass [g]', or give 'mass_unit'"},
      {"x [kg],y [mm],mass [g]\n1,2,3\n", "points.csv: the column 'x [kg]': "},
      {"x [mm],y [mm],mass [g],volume [mm^3]\n1,2,3,4\n",
       "points.csv: has both 'mass' and 'volume': 'size' says"},
      {head + "1,2,3,4\n1,2,3\n", "points.csv:3: 3 cells, the heading has 4"},
      {head + "1,2,3,4\n\n1,2,three,4\n", "points.csv:4: column 'z': expected a number instead of \"three\""},
      {head + "1,2,3,4\n1,nan,3,4\n", "points.csv:3: column 'y': expected a number instead of \"nan\""},
      {head + "1,2,3,0\n", "points.csv:2: a mass of 0: expected > 0"},
      {head + "1,2,3,-4\n", "points.csv:2: a mass of -4"},
      {head + "1,2,3,4\n5,6,7,8\n# remark\n1,2,3,5\n",
       "points.csv:5: a second particle at the place of that of line 2"},
      {head + "1,2,3,4e9\n2,3,4,4e9\n2,2,3,4e9\n", "points.csv: the 3 particles fill the box around them"},
      {"# vtk DataFile Version 3.0\n", "points.csv: a legacy VTK file: save it as .vtu (XML), or as CSV"},
      {"\x89HDF\r\n", "points.csv: an HDF5 file: 'whipple export' makes VTU or CSV files"},
      {vtu(some_rows(), Form::ascii), "points.csv: the column 'mass' has no unit"},
      {vtu(some_rows(), Form::ascii, "mass [g]"), "points.csv: the column 'x' has no unit"},
      {vtu(some_rows(), Form::ascii, "weight"),
       "points.csv: has no column 'mass' or 'volume', only: x, y, z"},
      {replaced(vtu(some_rows(), Form::ascii), "\"UnstructuredGrid\"", "\"PolyData\""),
       "holds \"PolyData\", expected an"},
      {replaced(vtu(some_rows(), Form::ascii), "LittleEndian", "BigEndian"), "is big endian"},
      {replaced(vtu(some_rows(), Form::ascii), "header_type",
                "compressor=\"vtkLZ4DataCompressor\" header_type"),
       "is packed by vtkLZ4DataCompressor"},
      {replaced(vtu(some_rows(), Form::ascii), "NumberOfPoints=\"4\"", "NumberOfPoints=\"5\""),
       "announces 5 points and has 12 coordinates"}};
  for (const auto& [bytes, message] : cases) EXPECT_THAT(refusal(bytes), HasSubstr(message)) << bytes;
  std::vector<Row> rows = some_rows();
  rows[2].place[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal(vtu(rows, Form::binary), true),
              HasSubstr("points.csv: point 2: a coordinate that is not finite"));
  rows[2] = rows[0];
  EXPECT_THAT(refusal(vtu(rows, Form::binary), true),
              HasSubstr("points.csv: point 2: a second particle at the place of that of point 0"));
  EXPECT_THAT(refusal(replaced(csv(some_rows()), "x [mm]", "x [m]"), true),
              HasSubstr("the column 'x' is in m, and 'unit' says otherwise"));
}

TEST_F(PointsOfFiles, OutsideTheDomainAreNamed) {
  write("x [mm],y [mm],z [mm],mass [mg]\n1,2,3,1\n9,2,3,1\n-9,2,3,1\n");
  EXPECT_THAT(refusal_of(file), testing::AllOf(HasSubstr("points.csv:3: at x = 0.009 m"),
                                               HasSubstr("beyond the end of the domain at 0.008 m"),
                                               HasSubstr("(2 such particles)")));
  const std::string quarter =
      "lower = [\"0 mm\", \"-8 mm\", \"-8 mm\"]\nupper = [\"10 mm\", \"8 mm\", \"8 mm\"]\nboundary = { "
      "x_lower = "
      "\"symmetry\" }";
  EXPECT_THAT(refusal_of(file, quarter),
              HasSubstr("points.csv:4: lies at x = -0.009 m, beyond the mirror plane or wall at 0 m"));
}

TEST_F(PointsOfFiles, AreCounted) {
  const auto shape = read(csv(some_rows()));
  const std::vector<std::string> account = shape->account();
  ASSERT_EQ(account.size(), 2U);
  EXPECT_THAT(account[0], HasSubstr("points points.csv: 4 particles, 0.0155 g, "));
  EXPECT_THAT(account[1], HasSubstr("cubes of 0.5 to 1 mm, which fill"));
}

}  // namespace points_test
}  // namespace whipple::cases
