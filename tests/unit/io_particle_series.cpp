// SPDX-License-Identifier: BSD-3-Clause
// Snapshots: every rule of the VTKHDF layout (docs/manual/output.md), and a series that opens whenever the run was
// killed.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <numeric>

#include "src/core/base/error.hpp"
#include "src/core/base/json.hpp"
#include "src/core/hdf5/hdf5.hpp"
#include "src/io/background_writer.hpp"
#include "src/io/particle_series.hpp"
#include "src/io/run_directory.hpp"
#include "tests/unit/io_support.hpp"

namespace whipple::io {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class Series : public FolderTest {
 protected:
  SeriesOptions options(std::vector<std::string> fields = {"pressure", "phase"}) const {
    return {.folder = folder_,
            .name = "disk",
            .fields = std::move(fields),
            .material_of_body = {5, 6, 7},
            .provenance = {{"version", "0.1"}, {"input", std::string(100'000, 'i')}}};
  }
  std::vector<double> index_times() const {
    std::vector<double> times;
    const auto index = parse_json(read_text(folder_ / "disk.particles.hdf.series"));
    for (const auto& entry : index.at("files")) {
      EXPECT_TRUE(fs::exists(folder_ / entry.at("name").get<std::string>()));
      times.push_back(entry.at("time").get<double>());
    }
    return times;
  }
};

/// Finite, distinct values everywhere.
Particles ramp(std::size_t n) {
  Particles p = random_bits(n, 1);
  for (std::size_t i = 0; i < n; ++i) {
    const auto x = static_cast<double>(i);
    p.id[i] = (std::uint64_t{1} << 60) + i;
    p.body[i] = static_cast<std::uint32_t>(i % 3);
    p.position[i] = {x, 2 * x, 3 * x};
    p.velocity[i] = {-x, 0.5 * x, 1.0};
    p.mass[i] = 1.0 + x;
    p.volume[i] = 0.25;
    p.void_volume[i] = 0.75;
    p.pressure[i] = 1e9 + x;
    p.deviatoric_stress[i] = {1, 2, -3, 4, 5, 6};
    p.melted_fraction[i] = i % 4 == 0 ? 0.0 : i % 4 == 1 ? 0.5 : 1.0;
    p.vaporised_fraction[i] = i % 4 == 3 ? 0.75 : 0.0;
    p.failed[i] = static_cast<std::uint8_t>(i % 3);
  }
  return p;
}

TEST_F(Series, follows_the_layout) {
  const std::size_t n = 1000;
  const Particles particles = ramp(n);
  ParticleSeries series(options(output_field_names()), MPI_COMM_SELF);
  const fs::path path = series.write(particles, 2.5e-6);
  EXPECT_EQ(path, folder_ / "disk.particles.000000.hdf");

  const hdf5::File file = hdf5::File::open(path);
  const hdf5::Group vtk = file.root.open_group("VTKHDF");
  const hdf5::Handle version(H5Aopen(vtk.id(), "Version", H5P_DEFAULT), H5Aclose);
  std::int64_t numbers[2] = {};
  ASSERT_GE(H5Aread(version.get(), H5T_NATIVE_INT64, numbers), 0);
  EXPECT_THAT(numbers, ElementsAre(1, 0));
  const hdf5::Handle type(H5Aopen(vtk.id(), "Type", H5P_DEFAULT), H5Aclose);
  const hdf5::Handle type_type(H5Aget_type(type.get()), H5Tclose);
  EXPECT_EQ(H5Tis_variable_str(type_type.get()), 0);
  EXPECT_EQ(H5Tget_size(type_type.get()), 16U);
  EXPECT_EQ(H5Tget_cset(type_type.get()), H5T_CSET_ASCII);
  EXPECT_EQ(vtk.text_attribute("Type"), "UnstructuredGrid");

  for (const char* name : {"NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"}) {
    EXPECT_THAT(vtk.open_dataset(name).read_all<std::int64_t>(), ElementsAre(1000)) << name;
  }
  const std::vector<std::int64_t> connectivity = vtk.open_dataset("Connectivity").read_all<std::int64_t>();
  const std::vector<std::int64_t> offsets = vtk.open_dataset("Offsets").read_all<std::int64_t>();
  const std::vector<std::uint8_t> types = vtk.open_dataset("Types").read_all<std::uint8_t>();
  ASSERT_EQ(connectivity.size(), n);
  ASSERT_EQ(offsets.size(), n + 1);
  ASSERT_EQ(types.size(), n);
  for (std::size_t i = 0; i < n; ++i) {
    ASSERT_EQ(connectivity[i], static_cast<std::int64_t>(i));
    ASSERT_EQ(offsets[i + 1], static_cast<std::int64_t>(i) + 1);
    ASSERT_EQ(types[i], 1);
  }
  const std::vector<float> points = vtk.open_dataset("Points").read_all<float>();
  ASSERT_EQ(points.size(), 3 * n);
  EXPECT_EQ(points[3 * 7 + 2], 21.0F);

  const hdf5::Group data = vtk.open_group("PointData");
  EXPECT_EQ(data.names().size(), output_fields().size());
  EXPECT_EQ(data.open_dataset("id").read_all<std::uint64_t>()[7], (std::uint64_t{1} << 60) + 7);
  EXPECT_EQ(data.open_dataset("body").read_all<std::uint16_t>()[7], 1);
  EXPECT_EQ(data.open_dataset("material").read_all<std::uint16_t>()[7], 6);
  EXPECT_EQ(data.open_dataset("failed").read_all<std::uint8_t>()[7], 1);
  EXPECT_THAT(std::vector<int>({data.open_dataset("phase").read_all<std::uint8_t>()[0],
                                data.open_dataset("phase").read_all<std::uint8_t>()[1],
                                data.open_dataset("phase").read_all<std::uint8_t>()[2],
                                data.open_dataset("phase").read_all<std::uint8_t>()[3]}),
              ElementsAre(0, 1, 2, 3));
  EXPECT_EQ(data.open_dataset("density").read_all<float>()[7], 32.0F);
  EXPECT_EQ(data.open_dataset("void_fraction").read_all<float>()[7], 0.75F);
  EXPECT_EQ(data.open_dataset("velocity").shape(), (std::vector<std::uint64_t>{n, 3}));
  EXPECT_EQ(data.open_dataset("stress").shape(), (std::vector<std::uint64_t>{n, 6}));
  const std::vector<float> stress = data.open_dataset("stress").read_all<float>();
  const float p = static_cast<float>(1e9);
  EXPECT_EQ(std::vector<float>(stress.begin(), stress.begin() + 6),
            (std::vector<float>{1 - p, 2 - p, -3 - p, 4, 5, 6}));
  // s:s = 1 + 4 + 9 + 2 (16 + 25 + 36) = 168
  EXPECT_FLOAT_EQ(data.open_dataset("von_mises_stress").read_all<float>()[0], std::sqrt(1.5F * 168.0F));
  EXPECT_TRUE(data.open_dataset("pressure").has_attribute("unit"));

  EXPECT_THAT(vtk.open_group("FieldData").names(), ElementsAre("TimeValue"));
  EXPECT_THAT(vtk.open_group("FieldData").open_dataset("TimeValue").read_all<double>(), ElementsAre(2.5e-6));
  EXPECT_TRUE(file.root.open_group("run").has_attribute("version"));
  EXPECT_TRUE(file.root.open_group("run").has_attribute("input"));
  EXPECT_EQ(file.root.open_group("run").integer_attribute("ranks"), 1);
}

TEST_F(Series, uses_only_built_in_filters_and_an_old_file_format) {
  ParticleSeries series(options(), MPI_COMM_SELF);
  const fs::path path = series.write(ramp(70'000), 0.0);
  const std::string bytes = read_text(path);
  EXPECT_EQ(bytes.substr(1, 3), "HDF");
  EXPECT_EQ(static_cast<int>(bytes[8]), 0);  // version 0 of the superblock: H5F_LIBVER_EARLIEST
  const hdf5::File file = hdf5::File::open(path);
  const hdf5::Dataset points = file.root.open_group("VTKHDF").open_dataset("Points");
  const hdf5::Handle creation(H5Dget_create_plist(points.id()), H5Pclose);
  ASSERT_EQ(H5Pget_nfilters(creation.get()), 2);
  std::vector<H5Z_filter_t> filters;
  for (unsigned i = 0; i < 2; ++i) {
    std::size_t values = 0;
    filters.push_back(H5Pget_filter2(creation.get(), i, nullptr, &values, nullptr, 0, nullptr, nullptr));
  }
  EXPECT_THAT(filters, ElementsAre(H5Z_FILTER_SHUFFLE, H5Z_FILTER_DEFLATE));
  hsize_t chunk[2] = {};
  ASSERT_EQ(H5Pget_chunk(creation.get(), 2, chunk), 2);
  EXPECT_THAT(chunk, ElementsAre(65536, 3));
}

TEST_F(Series, writes_what_was_asked_for_and_what_reports_need) {
  ParticleSeries series(options({"pressure"}), MPI_COMM_SELF);
  const hdf5::File file = hdf5::File::open(series.write(ramp(3), 0.0));
  EXPECT_THAT(file.root.open_group("VTKHDF").open_group("PointData").names(),
              ElementsAre("body", "density", "failed", "id", "mass", "pressure", "velocity"));
}

TEST_F(Series, no_particles_make_a_valid_file) {
  ParticleSeries series(options(), MPI_COMM_SELF);
  const hdf5::File file = hdf5::File::open(series.write({}, 0.0));
  const hdf5::Group vtk = file.root.open_group("VTKHDF");
  EXPECT_THAT(vtk.open_dataset("NumberOfPoints").read_all<std::int64_t>(), ElementsAre(0));
  EXPECT_THAT(vtk.open_dataset("Offsets").read_all<std::int64_t>(), ElementsAre(0));
  EXPECT_EQ(vtk.open_dataset("Points").shape(), (std::vector<std::uint64_t>{0, 3}));
  EXPECT_EQ(vtk.open_group("PointData").open_dataset("pressure").shape(), (std::vector<std::uint64_t>{0}));
}

TEST_F(Series, what_is_prepared_is_the_state_of_its_time_however_late_it_is_written) {
  Particles particles = ramp(1000);
  ParticleSeries series(options(output_field_names()), MPI_COMM_SELF);
  const fs::path at_once = series.write(particles, 0.0);
  BackgroundWriter writer;
  std::function<void()> write = series.prepare(particles, 1e-6);
  particles = ramp(10);
  writer.start(std::move(write));
  writer.wait();
  EXPECT_EQ(series.size(), 2);
  const hdf5::File first = hdf5::File::open(at_once);
  const hdf5::File second = hdf5::File::open(folder_ / "disk.particles.000001.hdf");
  const auto bytes = [](const hdf5::Group& group, const std::string& name) {
    const hdf5::Dataset array = group.open_dataset(name);
    const std::vector<std::uint64_t> shape = array.shape();
    const hdf5::Handle type(H5Dget_type(array.id()), H5Tclose);
    std::vector<char> all(
        std::accumulate(shape.begin(), shape.end(), H5Tget_size(type.get()), std::multiplies<>()));
    EXPECT_GE(H5Dread(array.id(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data()), 0);
    return all;
  };
  const hdf5::Group a = first.root.open_group("VTKHDF"), b = second.root.open_group("VTKHDF");
  for (const char* name : {"Points", "Connectivity", "Offsets", "Types"}) {
    EXPECT_EQ(bytes(a, name), bytes(b, name)) << name;
  }
  const hdf5::Group of_a = a.open_group("PointData"), of_b = b.open_group("PointData");
  EXPECT_EQ(of_a.names(), of_b.names());
  for (const std::string& name : of_a.names()) EXPECT_EQ(bytes(of_a, name), bytes(of_b, name)) << name;
}

TEST(Background, the_next_call_says_what_went_wrong) {
  BackgroundWriter writer;
  writer.start([] { throw InputError("the disk is full"); });
  bool written = false;
  EXPECT_THAT(message_of<InputError>([&] { writer.start([&] { written = true; }); }),
              HasSubstr("the disk is full"));
  EXPECT_FALSE(written);
  writer.start([&] { written = true; });
  writer.wait();
  EXPECT_TRUE(written);
}

TEST_F(Series, the_index_holds_exact_times) {
  ParticleSeries series(options(), MPI_COMM_SELF);
  const double third = 1e-6 / 3;
  series.write(ramp(2), 0.0);
  series.write(ramp(2), third);
  EXPECT_THAT(index_times(), ElementsAre(0.0, third));
  EXPECT_TRUE(std::ranges::none_of(fs::directory_iterator(folder_), [](const fs::directory_entry& file) {
    return file.path().extension() == ".partial";
  }));
  const auto index = parse_json(read_text(series.index_path()));
  EXPECT_EQ(index.at("file-series-version"), "1.0");
  EXPECT_EQ(index.at("files")[1].at("name"), "disk.particles.000001.hdf");
}

TEST_F(Series, a_second_snapshot_at_one_time_replaces_the_first) {
  ParticleSeries series(options(), MPI_COMM_SELF);
  series.write(ramp(2), 0.0);
  series.write(ramp(5), 0.0);
  EXPECT_THAT(index_times(), ElementsAre(0.0));
  EXPECT_THROW(series.write(ramp(2), -1.0), InternalError);
}

/// Killed between the data file and the index: the old index is whole, the new file is not in it, and the
/// restarted run writes that file again.
TEST_F(Series, survives_a_kill_between_data_file_and_index) {
  ParticleSeries series(options(), MPI_COMM_SELF);
  series.write(ramp(2), 0.0);
  series.write(ramp(2), 1.0);
  const std::string index = read_text(series.index_path());
  series.write(ramp(2), 2.0);
  write_text_atomically(series.index_path(), index);  // as if killed before the index
  EXPECT_THAT(index_times(), ElementsAre(0.0, 1.0));

  ParticleSeries again(options(), MPI_COMM_SELF);
  again.restart(1.5);
  EXPECT_EQ(again.size(), 2U);
  EXPECT_FALSE(fs::exists(folder_ / "disk.particles.000002.hdf"));
  EXPECT_EQ(again.write(ramp(2), 2.0).filename(), "disk.particles.000002.hdf");
  again.write(ramp(2), 3.0);
  EXPECT_THAT(index_times(), ElementsAre(0.0, 1.0, 2.0, 3.0));
}

TEST_F(Series, a_restart_cuts_the_index_and_leaves_other_files_alone) {
  ParticleSeries series(options(), MPI_COMM_SELF);
  for (const double time : {0.0, 1.0, 2.0, 3.0}) series.write(ramp(2), time);
  std::ofstream(folder_ / "other.particles.000003.hdf") << "x";
  ParticleSeries again(options(), MPI_COMM_SELF);
  again.restart(1.0);
  EXPECT_THAT(index_times(), ElementsAre(0.0, 1.0));
  EXPECT_FALSE(fs::exists(folder_ / "disk.particles.000003.hdf"));
  EXPECT_TRUE(fs::exists(folder_ / "other.particles.000003.hdf"));
  again.restart(-1.0);
  EXPECT_EQ(again.size(), 0U);
}

TEST_F(Series, refuses_a_foreign_index) {
  ParticleSeries series(options(), MPI_COMM_SELF);
  EXPECT_NO_THROW(series.restart(0.0));
  std::ofstream(series.index_path()) << "{\"files\": 3";
  EXPECT_THAT(message_of<InputError>([&] { series.restart(0.0); }),
              AllOf(HasSubstr(series.index_path().string()), HasSubstr("is not the index of a series")));
  std::ofstream(series.index_path()) << R"({"files": [{"name": "../precious.hdf", "time": 1}]})";
  EXPECT_THAT(message_of<InputError>([&] { series.restart(0.0); }), HasSubstr("../precious.hdf"));
}

TEST_F(Series, unknown_fields_are_answered_with_the_nearest_name) {
  EXPECT_THAT(
      message_of<InputError>([&] { ParticleSeries(options({"temprature", "pressure"}), MPI_COMM_SELF); }),
      AllOf(HasSubstr("unknown output field \"temprature\", did you mean \"temperature\"?"),
            HasSubstr("known: velocity, mass")));
}

TEST_F(Series, an_unwritable_folder_is_the_users_matter) {
  SeriesOptions elsewhere = options();
  elsewhere.folder = folder_ / "none";
  ParticleSeries series(elsewhere, MPI_COMM_SELF);
  EXPECT_THAT(message_of<InputError>([&] { series.write(ramp(2), 0.0); }),
              HasSubstr((folder_ / "none" / "disk.particles.000000.hdf").string()));
}

/// The margins of the phases: what round-off may leave at the ends of the melting band is not melting.
TEST(PhaseOfFractions, has_margins) {
  static_assert(phase(0.0, 0.0) == Phase::solid);
  static_assert(phase(1e-9, 0.0) == Phase::solid);
  static_assert(phase(0.5, 0.0) == Phase::melting);
  static_assert(phase(1.0 - 1e-9, 0.0) == Phase::liquid);
  static_assert(phase(1.0, 0.49) == Phase::liquid);
  static_assert(phase(1.0, 0.5) == Phase::vapour);
  for (const double vaporised : {0.0, 0.49, 0.5, 1.0}) {
    constexpr Lanes melted = {1e-9, 0.5, 1.0 - 1e-9, 1.0};
    const std::array<LanesMask, 4> in = phases(melted, broadcast(vaporised));
    for (std::size_t k = 0; k < 4; ++k) {
      for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(in[i][k] != 0, static_cast<std::size_t>(phase(melted[k], vaporised)) == i);
      }
    }
  }
  EXPECT_EQ(select_output_fields(default_output_fields()).size(), default_output_fields().size() + 4);
  EXPECT_THAT(describe_output_fields(), HasSubstr("temperature               K         temperature\n"));
}

}  // namespace
}  // namespace whipple::io
