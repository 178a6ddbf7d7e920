// SPDX-License-Identifier: BSD-3-Clause
// Files written by several ranks together (run under mpiexec; every rank runs every test): one of them
// without any particle, and the content that of one rank.
#include <gmock/gmock.h>
#include <mpi.h>

#include <new>
#include <numeric>

#include "src/core/base/error.hpp"
#include "src/core/base/resource_error.hpp"
#include "src/core/hdf5/hdf5.hpp"
#include "src/io/checkpoint.hpp"
#include "src/io/particle_series.hpp"
#include "tests/unit/io_support.hpp"

namespace whipple::io {
namespace {

namespace fs = std::filesystem;

class RanksTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        fs::temp_directory_path() / ("whipple_io_ranks_" + ranks_.broadcast(std::to_string(::getpid())));
    ranks_.on_root([&] { fs::create_directories(folder_); });
  }
  void TearDown() override {
    MPI_Barrier(MPI_COMM_WORLD);
    ranks_.on_root([&] { fs::remove_all(folder_); });
  }
  /// The share of this rank: the second rank has nothing.
  [[nodiscard]] Particles share(const Particles& all) const {
    const std::size_t parts = ranks_.count() > 1 ? static_cast<std::size_t>(ranks_.count()) - 1 : 1;
    const auto rank = static_cast<std::size_t>(ranks_.rank());
    const std::size_t part = rank == 0 ? 0 : rank - 1;
    std::vector<std::uint32_t> order;
    if (rank != 1) {
      const std::size_t begin = all.size() * part / parts;
      const std::size_t end = all.size() * (part + 1) / parts;
      order.resize(end - begin);
      std::iota(order.begin(), order.end(), static_cast<std::uint32_t>(begin));
    }
    Particles mine = all;
    SortBuffers buffers;
    reorder(mine, order, buffers);
    return mine;
  }
  Ranks ranks_{MPI_COMM_WORLD};
  fs::path folder_;
};

TEST_F(RanksTest, a_checkpoint_does_not_depend_on_the_number_of_ranks) {
  const Particles all = random_bits(150'000, 11);  // more than one chunk, borders inside chunks
  CheckpointValues values;
  values.reals = {{"time", 0.5}};
  values.texts = {{"case", "title"}};
  values.arrays = {{"impulse", {1, 2, 3}}};
  const fs::path together = write_checkpoint(folder_, 1, share(all), values);
  const Checkpoint alone = read_checkpoint(together, MPI_COMM_SELF);
  EXPECT_EQ(differing_fields(alone.particles, all), "");
  EXPECT_EQ(alone.values.texts, values.texts);
  EXPECT_EQ(alone.values.arrays, values.arrays);

  // And back: what one rank wrote, all of them read in equal shares.
  fs::path single;
  ranks_.on_root([&] { single = write_checkpoint(folder_ / "single", 1, all, values, MPI_COMM_SELF); });
  const Checkpoint part = read_latest_checkpoint(folder_ / "single");
  const std::vector<std::uint64_t> counts = ranks_.gather(part.particles.size());
  EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}), all.size());
  const auto first = static_cast<std::uint32_t>(
      std::accumulate(counts.begin(), counts.begin() + ranks_.rank(), std::uint64_t{0}));
  std::vector<std::uint32_t> order(part.particles.size());
  std::iota(order.begin(), order.end(), first);
  Particles expected = all;
  SortBuffers buffers;
  reorder(expected, order, buffers);
  EXPECT_EQ(differing_fields(part.particles, expected), "");
}

TEST_F(RanksTest, damage_is_recognised_on_every_rank) {
  write_checkpoint(folder_, 1, share(random_bits(100, 12)), {});
  const fs::path newest = write_checkpoint(folder_, 2, share(random_bits(100, 13)), {});
  MPI_Barrier(MPI_COMM_WORLD);
  ranks_.on_root([&] { fs::resize_file(newest, fs::file_size(newest) / 2); });
  EXPECT_THROW((void)read_checkpoint(newest), InputError);
  EXPECT_EQ(read_latest_checkpoint(folder_).path.filename(), "checkpoint.00000001.h5");
}

// Every rank opens the file for itself: what one of them cannot read, none does, and all take the older one.
TEST_F(RanksTest, an_error_of_reading_on_one_rank_is_an_error_of_all) {
  write_checkpoint(folder_, 1, share(random_bits(100, 12)), {});
  const fs::path newest = write_checkpoint(folder_, 2, share(random_bits(100, 13)), {});
  const fs::path other = folder_ / "other";
  ranks_.on_root([&] {
    fs::create_directory(other);
    for (const char* name : {"checkpoint.00000001.h5", "checkpoint.00000002.h5"})
      fs::copy_file(folder_ / name, other / name);
    fs::resize_file(other / newest.filename(), fs::file_size(newest) / 2);
  });
  const bool is_last = ranks_.rank() + 1 == ranks_.count();
  const fs::path folder = is_last ? other : folder_;
  EXPECT_THAT(message_of<InputError>([&] { (void)read_checkpoint(folder / newest.filename()); }),
              ::testing::HasSubstr((other / newest.filename()).string()));
  EXPECT_EQ(read_latest_checkpoint(folder).path.filename(), "checkpoint.00000001.h5");
}

TEST_F(RanksTest, a_snapshot_has_one_partition_per_rank) {
  const Particles all = random_bits(100'000, 14);
  SeriesOptions options{.folder = folder_,
                        .name = "ranks",
                        .fields = output_field_names(),
                        .material_of_body = {0, 0, 0},
                        .provenance = {{"input", std::string(100'000, 'i')}}};
  ParticleSeries series(options);
  const Particles mine = share(all);
  const fs::path path = series.write(mine, 0.0);
  series.write({}, 1.0);  // nothing on any rank
  const std::vector<std::uint64_t> counts = ranks_.gather(mine.size());

  const hdf5::File file = hdf5::File::open(path);
  const hdf5::Group vtk = file.root.open_group("VTKHDF");
  const std::vector<std::int64_t> points = vtk.open_dataset("NumberOfPoints").read_all<std::int64_t>();
  EXPECT_EQ(std::vector<std::uint64_t>(points.begin(), points.end()), counts);
  std::vector<std::int64_t> offsets;
  std::vector<std::int64_t> connectivity;
  for (const std::uint64_t count : counts) {
    for (std::uint64_t i = 0; i <= count; ++i) offsets.push_back(static_cast<std::int64_t>(i));
    for (std::uint64_t i = 0; i < count; ++i) connectivity.push_back(static_cast<std::int64_t>(i));
  }
  EXPECT_EQ(vtk.open_dataset("Offsets").read_all<std::int64_t>(), offsets);
  EXPECT_EQ(vtk.open_dataset("Connectivity").read_all<std::int64_t>(), connectivity);
  EXPECT_EQ(vtk.open_group("PointData").open_dataset("id").read_all<std::uint64_t>(), all.id);
  EXPECT_EQ(file.root.open_group("run").integer_attribute("ranks"), ranks_.count());
  EXPECT_TRUE(file.root.open_group("run").has_attribute("input"));

  series.restart(0.5);
  EXPECT_EQ(series.size(), 1U);
}

TEST_F(RanksTest, an_error_of_the_root_is_an_error_of_all) {
  EXPECT_THAT(message_of<InputError>([&] { ranks_.on_root([] { throw InputError("disk full"); }); }),
              "disk full");
  EXPECT_THAT(message_of<InternalError>([&] { ranks_.on_root([] { throw std::runtime_error("odd"); }); }),
              "odd");
  EXPECT_THAT(message_of<StateError>([&] { ranks_.on_root([] { throw StateError("hot"); }); }), "hot");
  EXPECT_THAT(message_of<ResourceError>([&] { ranks_.on_root([] { throw ResourceError("full"); }); }),
              "full");
  EXPECT_THROW(ranks_.on_root([] { throw std::bad_alloc(); }), std::bad_alloc);
}

TEST_F(RanksTest, of_errors_of_several_ranks_all_throw_the_first) {
  const int own = ranks_.rank(), last = ranks_.count() - 1;
  EXPECT_NO_THROW(ranks_.on_all([] {}));
  EXPECT_THAT(
      message_of<InputError>([&] { ranks_.on_all([&] { throw InputError("of " + std::to_string(own)); }); }),
      "of 0");
  EXPECT_THAT(message_of<ResourceError>([&] {
                ranks_.on_all([&] {
                  if (own == last) throw ResourceError("of the last");
                });
              }),
              "of the last");
}

}  // namespace
}  // namespace whipple::io

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  ::testing::InitGoogleTest(&argc, argv);
  int failed = RUN_ALL_TESTS();
  MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  MPI_Finalize();
  return failed;
}
