// SPDX-License-Identifier: BSD-3-Clause
// Files of other programs, damaged and forged ones: they are read or refused with an InputError. Nothing else:
// no crash, no hang, no memory for what a file only declares. WHIPPLE_FUZZ_TRIALS sets the number of each kind
// (default 40), WHIPPLE_FUZZ_FIRST the first one (a trial depends on its number alone); under the preset dev
// the sanitizers watch.
#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>
#include <functional>
#include <random>

#include "eos/experiments/comparison.hpp"
#include "eos/files/sesame.hpp"
#include "eos/files/table_file.hpp"
#include "src/analysis/run.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/log.hpp"
#include "src/core/hdf5/hdf5.hpp"
#include "src/io/checkpoint.hpp"
#include "src/io/particle_series.hpp"
#include "src/io/run_directory.hpp"
#include "src/io/sealed_file.hpp"
#include "src/material/material_file.hpp"
#include "src/case/case.hpp"
#include "src/run/restart.hpp"
#include "tests/unit/eos_support.hpp"
#include "tests/unit/folder_test.hpp"

namespace whipple {
namespace {

namespace fs = std::filesystem;
using Random = std::mt19937_64;

int wanted(const char* variable, int otherwise) {
  const char* value = std::getenv(variable);
  return value != nullptr ? std::atoi(value) : otherwise;
}

std::size_t any(Random& random, std::size_t below) { return random() % below; }

/// Bits flipped, blocks overwritten, the end cut off.
std::string damaged(std::string bytes, Random& random) {
  for (std::size_t n = 1 + any(random, 4); n > 0; --n) {
    const std::size_t at = any(random, bytes.size());
    switch (any(random, 4)) {
      case 0:
        bytes.resize(std::max<std::size_t>(at, 1));
        break;
      case 1:
        bytes.replace(at, 8, std::string("\0\0\0\0\0\0\xf8\x7f", 8));  // NaN
        break;
      case 2:
        bytes.replace(at, 8, bytes.substr(any(random, bytes.size()), 8));
        break;
      default:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << any(random, 8)));
    }
  }
  return bytes;
}

/// Words and lines replaced, doubled, left out.
std::string garbled(std::string text, Random& random) {
  static const std::vector<std::string> words = {"nan",  "-1",     "1e999", "0",    "",   "\n", ",", ";",  "\"",
                                                 "1e30", "\xc3\xa4", "#",     "\t", "-",  "+",  ".", "99999999999"};
  for (std::size_t n = 1 + any(random, 4); n > 0; --n) {
    const std::size_t at = any(random, text.size()), length = any(random, 12);
    switch (any(random, 4)) {
      case 0:
        text.insert(at, text.substr(any(random, text.size()), 80));
        break;
      case 1:
        text.erase(at, length);
        break;
      default:
        text.replace(at, length, words[any(random, words.size())]);
    }
    if (text.empty()) text = "x";
  }
  return text;
}

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
  void try_all(const fs::path& path, const Change& change, const std::function<void()>& read) const {
    const std::string whole = io::read_text(path);
    read();
    int accepted = 0;
    const int first = wanted("WHIPPLE_FUZZ_FIRST", 0), trials = wanted("WHIPPLE_FUZZ_TRIALS", 40);
    for (int trial = first; trial < first + trials; ++trial) {
      Random random(static_cast<std::uint64_t>(trial));
      std::ofstream(path, std::ios::binary) << change(whole, random);
      try {
        read();
        ++accepted;
      } catch (const InputError&) {
      } catch (const StateError&) {  // of a material that was read
      } catch (const std::exception& error) {
        ADD_FAILURE() << "trial " << trial << ": " << error.what();
      }
    }
    std::printf("%d of %d accepted\n", accepted, trials);
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
    return io::read_text(path);
  };
  try_all(path, sealed, [&] {
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
  try_all(path, damaged, sound);

  // Each array shorter than the others.
  for (const std::string name : {"Points", "PointData/velocity", "PointData/mass", "PointData/body",
                                 "PointData/pressure", "PointData/phase"}) {
    const std::string whole = io::read_text(path);
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
    fs::copy_file(fs::path(WHIPPLE_SOURCE_DIR "/eos/data") / name, path);
    try_all(path, garbled, [&] {
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
  std::ofstream(folder_ / "test.toml") << "name = \"t\"\nsource = \"t\"\n[eos]\nmodel = \"sesame\"\nfile = \"test.ses\"\n";
  try_all(path, garbled, [&] {
    static_cast<void>(eos::read_sesame(path));
    static_cast<void>(read_material(folder_ / "test.toml"));
  });
}

TEST_F(ForeignFiles, TablesOfEquationsOfState) {
  const eos::test::GrayEos copper(eos::test::copper());
  const fs::path path = folder_ / "copper.eos.h5";
  eos::write_table(path, {eos::tabulate(copper, {.error = 0.05}), {}});
  try_all(path, damaged, [&] { static_cast<void>(eos::Table(eos::read_table(path).data)); });
}

}  // namespace
}  // namespace whipple
