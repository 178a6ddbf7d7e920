// SPDX-License-Identifier: BSD-3-Clause
// Files of other programs, damaged and forged ones: they are read or refused with an InputError. Nothing else:
// no crash, no hang, no memory for what a file only declares (tests/fuzz/trials.hpp).
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <zlib.h>

#include <array>
#include <fstream>
#include <functional>

#include "eos/experiments/comparison.hpp"
#include "eos/files/sesame.hpp"
#include "eos/files/table_file.hpp"
#include "src/analysis/run.hpp"
#include "src/case/case.hpp"
#include "src/case/shapes/image.hpp"
#include "src/case/shapes/points.hpp"
#include "src/case/shapes/surface.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/log.hpp"
#include "src/core/hdf5/hdf5.hpp"
#include "src/decks/import.hpp"
#include "src/fem/mesh_file.hpp"
#include "src/io/checkpoint.hpp"
#include "src/io/particle_series.hpp"
#include "src/io/run_directory.hpp"
#include "src/io/sealed_file.hpp"
#include "src/material/material_file.hpp"
#include "src/run/restart.hpp"
#include "tests/folders.hpp"
#include "tests/fuzz/trials.hpp"
#include "tests/unit/eos_support.hpp"
#include "tests/unit/folder_test.hpp"

namespace whipple {
namespace {

namespace fs = std::filesystem;
using fuzz::damaged;
using fuzz::garbled;
using fuzz::Random;

class ForeignFiles : public FolderTest {
 protected:
  using Change = std::function<std::string(const std::string&, Random&)>;
  void SetUp() override {
    FolderTest::SetUp();
    log::set_level(log::Level::quiet);
  }
  void TearDown() override {
    log::set_level(log::Level::normal);
    FolderTest::TearDown();
  }
  /// Reads changed copies of a sound file. It must be right often enough to reach what lies behind its first line.
  static void try_all(const char* kind, const fs::path& path, const Change& change,
                      const std::function<void()>& read) {
    const std::string whole = read_text(path);
    read();
    fuzz::try_inputs(kind, 40, [&](Random& random) {
      std::ofstream(path, std::ios::binary) << change(whole, random);
      read();
    });
    std::ofstream(path, std::ios::binary) << whole;
  }
};

Particles matter() {
  Particles p;
  resize(p, 300);
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.id[i] = i;
    p.mass[i] = p.volume[i] = 1.0;
    p.position[i] = p.velocity[i] = Vector3::Constant(1e-3 * static_cast<double>(i));
  }
  return p;
}

/// A case of one body, without its files.
cases::Case one_body() {
  cases::Case setup;
  setup.bodies.emplace_back().name = "body";
  return setup;
}

TEST_F(ForeignFiles, CheckpointsThatWereSealedAgain) {
  io::CheckpointValues values;
  values.reals["time"] = 0.5;
  const fs::path path = io::write_checkpoint(folder_, 1, matter(), values, MPI_COMM_SELF);
  const auto sealed = [&](const std::string& whole, Random& random) {
    const std::string bytes = whole.substr(0, io::seal_size) + damaged(whole.substr(io::seal_size), random);
    std::ofstream(path, std::ios::binary) << bytes;
    io::seal(path);
    return read_text(path);
  };
  try_all("checkpoint", path, sealed, [&] {
    const io::Checkpoint checkpoint = io::read_checkpoint(path, MPI_COMM_SELF);
    run::require_admissible(one_body(), checkpoint, MPI_COMM_SELF);
    for (const std::uint32_t body : checkpoint.particles.body) ASSERT_EQ(body, 0U);
    for (const double mass : checkpoint.particles.mass) ASSERT_GT(mass, 0.0);
  });
}

TEST_F(ForeignFiles, Snapshots) {
  const io::SeriesOptions options{.folder = folder_,
                                  .name = "r",
                                  .fields = {"pressure", "phase", "failed"},
                                  .material_of_body = {0},
                                  .provenance = {}};
  const fs::path path = io::ParticleSeries(options, MPI_COMM_SELF).write(matter(), 0.0);
  const analysis::SnapshotEntry entry{path, 0.0, 1};
  const auto sound = [&] {
    const analysis::Snapshot snapshot = analysis::read_snapshot(entry);
    ASSERT_EQ(snapshot.position.size(), snapshot.size());
    for (const Vector3& x : snapshot.position) ASSERT_TRUE(x.allFinite());
  };
  try_all("snapshot", path, damaged, sound);

  // Each array shorter than the others.
  for (const std::string name : {"Points", "PointData/velocity", "PointData/mass", "PointData/body",
                                 "PointData/pressure", "PointData/phase"}) {
    const std::string whole = read_text(path);
    hdf5::File file = hdf5::File::open(path, hdf5::File::Access::modify);
    {
      const hdf5::Group vtk = file.root.open_group("VTKHDF");
      H5Ldelete(vtk.id(), name.c_str(), H5P_DEFAULT);
      const std::uint64_t columns = name == "Points" || name == "PointData/velocity" ? 3 : 0;
      const std::vector<float> values(2 * std::max<std::uint64_t>(columns, 1));
      vtk.write<float>(name, values, hdf5::Slab::whole(2), {.columns = columns});
    }
    file.close();
    EXPECT_THAT(message_of<InputError>(sound), testing::HasSubstr(name + ": has 2 rows"));
    std::ofstream(path, std::ios::binary) << whole;
  }
}

TEST_F(ForeignFiles, TablesOfMeasurements) {
  const Material copper = read_material("copper");
  for (const char* name : {"cu_hugoniot_marsh1980.csv", "cu_melting.csv"}) {
    const fs::path path = folder_ / name;
    fs::copy_file(fs::path(whipple::tests::source_folder() + "/eos/data") / name, path);
    try_all("measurements (CSV)", path, garbled, [&] {
      for (const auto& experiment : eos::experiments::read_experiments(path))
        static_cast<void>(eos::experiments::compare(*copper.eos, copper.reference, experiment));
    });
  }
}

TEST_F(ForeignFiles, SesameTables) {
  eos::SesameMaterial table;
  table.number = 77;
  table.comment = "material. test";
  table.reference_density = 1000;
  table.total.density = {0, 500, 1000, 2000};
  table.total.temperature = {0, 300, 1e4};
  for (const double T : table.total.temperature) {
    for (const double rho : table.total.density) {
      table.total.pressure.push_back(400 * rho * T + 2e6 * (rho - 1000) * rho / 1000);
      table.total.energy.push_back(1000 * T);
    }
  }
  const fs::path path = folder_ / "test.ses";
  eos::write_sesame(path, {&table, 1});
  std::ofstream(folder_ / "test.toml")
      << "name = \"t\"\nsource = \"t\"\n[eos]\nmodel = \"sesame\"\nfile = \"test.ses\"\n";
  try_all("SESAME", path, garbled, [&] {
    static_cast<void>(eos::read_sesame(path));
    static_cast<void>(read_material(folder_ / "test.toml"));
  });
}

TEST_F(ForeignFiles, TablesOfEquationsOfState) {
  const eos::test::GrayEos copper(eos::test::copper());
  const fs::path path = folder_ / "copper.eos.h5";
  eos::write_table(path, {eos::tabulate(copper, {.error = 0.05}), {}});
  try_all("table of an equation of state", path, damaged,
          [&] { static_cast<void>(eos::Table(eos::read_table(path).data)); });
}

TEST_F(ForeignFiles, Meshes) {
  for (const char* name : {"two_boxes_22.msh", "two_boxes_41.msh"}) {
    const fs::path path = folder_ / name;
    fs::copy_file(fs::path(whipple::tests::source_folder() + "/tests/data/fem") / name, path);
    const auto numbers_nodes = [](const auto& elements, std::size_t nodes) {
      for (const auto& element : elements) {
        for (const std::size_t node : element) ASSERT_LT(node, nodes);
      }
    };
    try_all("mesh (Gmsh)", path, garbled, [&] {
      const fem::MeshFile file = fem::MeshFile::read(path, 1e-3);
      for (const std::string& group : file.group_names(3)) {
        const fem::Hexahedra part = file.hexahedra(group);
        numbers_nodes(part.elements, part.nodes.size());
        for (const Vector3& x : part.nodes) ASSERT_TRUE(x.allFinite());
      }
      for (const std::string& group : file.group_names(1)) {
        const fem::Lines part = file.lines(group);
        numbers_nodes(part.elements, part.nodes.size());
      }
    });
  }
}

/// A tetrahedron in every format of surfaces.
TEST_F(ForeignFiles, Surfaces) {
  std::string binary(80, ' ');
  const auto append = [&](auto value) { binary.append(reinterpret_cast<const char*>(&value), sizeof value); };
  std::string text = "solid t\n", obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
      "z\nelement face "
      "4\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  append(std::uint32_t{4});
  const std::array<Vector3, 4> corners = {Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0),
                                          Vector3(0, 0, 1)};
  constexpr std::array<std::array<std::size_t, 3>, 4> faces = {{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  for (const auto& face : faces) {
    binary += std::string(12, '\0');
    text += "facet normal 0 0 0\nouter loop\n";
    for (const std::size_t corner : face) {
      for (const double x : corners[corner]) append(static_cast<float>(x));
      text += fmt::format("vertex {} {} {}\n", corners[corner][0], corners[corner][1], corners[corner][2]);
    }
    binary += std::string(2, '\0');
    text += "endloop\nendfacet\n";
    obj += fmt::format("f {} {} {}\n", face[0] + 1, face[1] + 1, face[2] + 1);
    ply += fmt::format("3 {} {} {}\n", face[0], face[1], face[2]);
  }
  text += "endsolid t\n";
  std::string binary_ply =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty "
      "float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n";
  const auto append_ply = [&](auto value) {
    binary_ply.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (const Vector3& corner : corners) {
    for (const double x : corner) append_ply(static_cast<float>(x));
  }
  for (const auto& face : faces) {
    append_ply(std::uint8_t{3});
    for (const std::size_t corner : face) append_ply(static_cast<std::int32_t>(corner));
  }
  for (const auto& [bytes, change] : {std::pair<std::string, Change>{binary, damaged},
                                      {text, garbled},
                                      {obj, garbled},
                                      {ply, garbled},
                                      {binary_ply, damaged}}) {
    const fs::path path = folder_ / "surface";
    std::ofstream(path, std::ios::binary) << bytes;
    try_all("surface", path, change, [&] {
      const cases::Surface body({.file = "surface", .unit = 1.0, .digest = {}}, folder_);
      ASSERT_GT(body.volume(), 0.0);
      static_cast<void>(body.contains(Vector3(0.1, 0.1, 0.1)));
    });
  }
}

/// Eight particles as CSV and as VTU, written and packed.
TEST_F(ForeignFiles, Points) {
  std::string csv = "# eight\nx [mm],y [mm],z [mm],mass [g]\n", places, masses;
  std::string bytes(4, '\0');
  const auto append = [&](auto value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  bytes[0] = static_cast<char>(8 * 8);
  for (int i = 0; i < 8; ++i) append(0.1 + 0.01 * i);
  const std::size_t offset = bytes.size();
  append(std::uint32_t{8 * 24});
  for (int i = 0; i < 8; ++i) {
    csv += fmt::format("{},{},{},{}\n", 5 * (i % 2), 5 * (i / 2 % 2), 5 * (i / 4), 1.0 + 0.1 * i);
    places += fmt::format("{} {} {} ", 5 * (i % 2), 5 * (i / 2 % 2), 5 * (i / 4));
    masses += fmt::format("{} ", 1.0 + 0.1 * i);
    for (const int x : {i % 2, i / 2 % 2, i / 4}) append(5.0 * x);
  }
  const auto vtu = [](const std::string& of_masses, const std::string& of_places, const std::string& end) {
    const std::string array =
        "<DataArray type=\"Float64\" Name=\"{}\" NumberOfComponents=\"{}\" {}/DataArray>\n";
    return fmt::format(
        "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\" header_type=\"UInt32\">\n"
        "<UnstructuredGrid>\n<Piece NumberOfPoints=\"8\" NumberOfCells=\"0\">\n<PointData>{}</PointData>\n"
        "<Points>{}</Points>\n</Piece>\n</UnstructuredGrid>\n{}</VTKFile>\n",
        fmt::format(fmt::runtime(array), "mass", 1, of_masses),
        fmt::format(fmt::runtime(array), "Points", 3, of_places), end);
  };
  const std::string written = vtu("format=\"ascii\">" + masses + "<", "format=\"ascii\">" + places + "<", "");
  const std::string packed_raw =
      vtu("format=\"appended\" offset=\"0\"><", fmt::format("format=\"appended\" offset=\"{}\"><", offset),
          "<AppendedData encoding=\"raw\">\n_" + bytes + "\n</AppendedData>\n");
  for (const auto& [text, change] :
       {std::pair<std::string, Change>{csv, garbled}, {written, garbled}, {packed_raw, damaged}}) {
    const fs::path path = folder_ / "points";
    std::ofstream(path, std::ios::binary) << text;
    try_all("points", path, change, [&] {
      cases::PointsKeys keys;
      keys.file = "points";
      if (text != csv) keys.unit = keys.mass_unit = 1e-3;
      const cases::Points read(keys, folder_);
      ASSERT_GT(read.volume(), 0.0);
      const auto body = read.settled({.density = 8000.0});
      ASSERT_GT(body->volume(), 0.0);
      static_cast<void>(body->contains(Vector3(1e-4, 1e-4, 1e-4)));
      for (const cases::GivenParticle& each : body->particles()) ASSERT_TRUE(each.position.allFinite());
    });
  }
}

/// Packs a text as gzip does.
std::string packed(const std::string& bytes) {
  z_stream stream{};
  constexpr int as_gzip = 16 + MAX_WBITS;
  deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, as_gzip, 8, Z_DEFAULT_STRATEGY);
  std::string result(deflateBound(&stream, bytes.size()) + 64, '\0');
  // zlib does not write to its input, but its interface is not const.
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));  // NOLINT
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.data());  // NOLINT
  stream.avail_out = static_cast<uInt>(result.size());
  deflate(&stream, Z_FINISH);
  result.resize(stream.total_out);
  deflateEnd(&stream);
  return result;
}

TEST_F(ForeignFiles, Images) {
  const std::string values = std::string(13, '\0') + std::string(14, '\1');
  const std::string nrrd =
      "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 3 3 3\nencoding: raw\nspace origin: (0,0,0)\n"
      "space directions: (1,0,0) (0,1,0) (0,0,1)\n\n";
  const std::string meta =
      "ObjectType = Image\nNDims = 3\nDimSize = 3 3 3\nElementType = MET_UCHAR\nElementSpacing = "
      "1 1 1\nOffset = 0 0 0\nElementDataFile = LOCAL\n";
  std::string nifti(352, '\0');
  const auto put = [&](std::size_t at, auto value) {
    nifti.replace(at, sizeof value, reinterpret_cast<const char*>(&value), sizeof value);
  };
  put(0, std::int32_t{348});
  for (std::size_t d = 0; d < 4; ++d) put(40 + 2 * d, std::int16_t{3});
  put(70, std::int16_t{2});
  for (std::size_t d = 0; d < 4; ++d) put(76 + 4 * d, 1.0F);
  put(108, 352.0F);
  nifti.replace(344, 3, "n+1");
  const fs::path path = folder_ / "image";
  cases::ImageKeys keys;
  keys.file = "image";
  keys.unit = 1.0;
  keys.values = {1};
  const auto try_image = [&](const std::string& bytes, const Change& change) {
    std::ofstream(path, std::ios::binary) << bytes;
    try_all("image", path, change, [&] { ASSERT_GT(cases::VoxelBody(keys, folder_).volume(), 0.0); });
  };
  try_image(nrrd + values, garbled);
  try_image(meta + values, garbled);
  try_image(nifti + values, damaged);
  std::string packed_nrrd = nrrd;
  packed_nrrd.replace(nrrd.find("raw"), 3, "gzip");
  try_image(packed_nrrd + packed(values), damaged);
  try_image(packed(nifti + values), damaged);
  std::ofstream(folder_ / "values", std::ios::binary) << values;
  std::string detached = meta;
  detached.replace(meta.find("LOCAL"), 5, "values");
  try_image(detached, garbled);
  keys.size = {3, 3, 3};
  keys.described_by = cases::ImageDescription::keys;
  try_image(values, damaged);
}

TEST_F(ForeignFiles, DecksOfOtherCodes) {
  using Units = std::optional<decks::UnitSystem>;
  for (const auto& [name, units] : {std::pair{"sphere_on_plate.mpm", Units{}},
                                    std::pair{"columns_of_water.mpm", Units{{"m", "kg", "s"}}}}) {
    const fs::path path = folder_ / name, target = folder_ / "imported";
    fs::copy_file(fs::path(whipple::tests::source_folder() + "/tests/data/decks") / name, path);
    try_all("deck (MPM3D-F90)", path, garbled, [&] {
      const decks::Import import = decks::import_deck(path, {.units = units});
      const decks::CaseFolder folder(import, target);
      static_cast<void>(cases::read_case(folder.case_file(), {}));
    });
  }
}

}  // namespace
}  // namespace whipple
