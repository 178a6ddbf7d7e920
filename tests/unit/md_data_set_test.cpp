// SPDX-License-Identifier: BSD-3-Clause
// The store of molecular-dynamics points: what goes in comes out bitwise, and no crash or second writer harms
// it.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>

#include "md_fitting/data_set/points.hpp"
#include "md_fitting/data_set/store_order.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/hash.hpp"
#include "src/core/hdf5/hdf5.hpp"
#include "tests/folders.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace whipple::md {
namespace {

PointRecord example(const std::string& name) {
  PointRecord point;
  point.key = sha256(name);
  point.protocol = "isotherm";
  point.status = PointStatus::done;
  point.message = "läuft, \"quoted\"\nsecond line";
  point.conditions = {{"specific_volume", 1.0 / 8930.0}, {"temperature", 293.0}};
  point.results = {{"pressure", {1.0 / 3.0 * 1e10, 7.1e6}},
                   {"specific_internal_energy", {-5.3e6, std::sqrt(2.0)}}};
  point.provenance = {{"potential", "Cu_u3.eam"}, {"molar_mass", "0.06355"}, {"empty", ""}};
  point.blocks = {{"pressure", {1.0e9, 1.0 / 3.0}}};
  return point;
}

void expect_equal(const PointRecord& a, const PointRecord& b) {
  EXPECT_EQ(a.key, b.key);
  EXPECT_EQ(a.protocol, b.protocol);
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.message, b.message);
  EXPECT_EQ(a.conditions, b.conditions);
  EXPECT_EQ(a.provenance, b.provenance);
  EXPECT_EQ(a.blocks, b.blocks);
  ASSERT_EQ(a.results.size(), b.results.size());
  for (const auto& [name, estimate] : a.results) {
    EXPECT_EQ(estimate.value, b.result(name).value) << name;
    EXPECT_EQ(estimate.error, b.result(name).error) << name;
  }
}

// A store outlives the revisions of its protocols: what an older one computed at the same conditions is
// superseded, what only it computed is not.
TEST(Select, TakesTheNewestRevisionOfEachPoint) {
  const auto point = [](const std::string& key, double volume, const std::string& revision) {
    PointRecord record;
    record.key = key;
    record.protocol = "isochore";
    record.status = PointStatus::done;
    record.conditions = {{"specific_volume", volume}, {"temperature", 300.0}};
    if (!revision.empty()) record.provenance["revision"] = revision;
    return record;
  };
  std::vector<PointRecord> points = {point("a", 1e-4, "3"), point("b", 1e-4, "10"), point("c", 1e-4, "10"),
                                     point("d", 2e-4, "3"), point("e", 3e-4, ""),   point("f", 1e-4, "11")};
  points.back().status = PointStatus::failed;
  std::string keys;
  for (const PointRecord& chosen : select(points, "isochore")) keys += chosen.key;
  EXPECT_EQ(keys, "bcde");
  EXPECT_TRUE(select(points, "isotherm").empty());
}

// FIPS PUB 180-4 test vectors (NIST "Examples with intermediate values", SHA-256): the key of a point is this
// hash.
TEST(Hash, AgreesWithThePublishedTestVectors) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256(std::string(1000000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Hash, SeedsLieInTheRangeOfTheGenerators) {
  for (int i = 0; i < 1000; ++i) {
    const std::int64_t seed = seed_from(sha256(std::to_string(i)));
    EXPECT_GE(seed, 1);
    EXPECT_LE(seed, 899999999);
  }
  EXPECT_NE(seed_from(sha256("a")), seed_from(sha256("b")));
}

TEST(Store, ReturnsWhatWasAddedInItsOrder) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "deep" / "copper.md.h5";
  const std::vector<std::string> names = {"first", "second", "a third"};
  for (const std::string& name : names) append_point(path, example(name));
  const std::vector<PointRecord> points = read_store(path);
  ASSERT_EQ(points.size(), names.size());
  for (std::size_t i = 0; i < names.size(); ++i) expect_equal(points[i], example(names[i]));
}

TEST(Store, ReplacesFailedPointsAndNeverFinishedOnes) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "copper.md.h5";
  PointRecord failed = example("point");
  failed.status = PointStatus::failed;
  failed.results.clear();
  append_point(path, failed);
  EXPECT_TRUE(select(read_store(path), "isotherm").empty());
  EXPECT_TRUE(append_point(path, example("point")));
  const std::vector<PointRecord> points = read_store(path);
  ASSERT_EQ(points.size(), 1U);
  EXPECT_TRUE(points[0].done());
  PointRecord other = example("point");
  other.results["pressure"].value = 0.0;
  EXPECT_FALSE(append_point(path, other));
  EXPECT_EQ(read_store(path)[0].result("pressure").value, example("point").result("pressure").value);
  EXPECT_EQ(select(points, "isotherm").size(), 1U);
  EXPECT_TRUE(select(points, "hugoniot").empty());
}

TEST(Store, KnowsTheStateAndTheProtocolOfAPoint) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "copper.md.h5";
  PointRecord untried = example("point");
  untried.status = PointStatus::not_tried;
  EXPECT_THROW(append_point(path, untried), InternalError);
  PointRecord spall = example("spall");
  spall.protocol = "spall";
  append_point(path, spall);
  append_point(path, example("point"));
  const std::vector<PointRecord> points = read_store(path);
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].kind(), std::nullopt);  // no reader tells it apart
  EXPECT_EQ(points[1].kind(), PointKind::isotherm);
  {
    hdf5::File file = hdf5::File::open(path, hdf5::File::Access::modify);
    const hdf5::Group odd = file.root.open_group("points").create_group("odd");
    odd.set_fixed_attribute("protocol", "isotherm");
    odd.set_fixed_attribute("status", "begun");
    file.close();
  }
  try {
    read_store(path);
    ADD_FAILURE() << "the odd point is read";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("unknown status 'begun'"), std::string::npos) << error.what();
  }
}

// Four processes append at once: the lock lets none of the points be lost.
TEST(Store, KeepsThePointsOfAllWriters) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "copper.md.h5";
  std::vector<pid_t> children;
  for (int writer = 0; writer < 4; ++writer) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      for (int i = 0; i < 8; ++i)
        append_point(path, example(std::to_string(writer) + "/" + std::to_string(i)));
      _exit(0);
    }
    children.push_back(child);
  }
  for (const pid_t child : children) {
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
  EXPECT_EQ(read_store(path).size(), 32U);
}

// A writer is killed without warning, many times, while it appends: the store always opens, and holds only
// whole points.
TEST(Store, SurvivesAKilledWriter) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "copper.md.h5";
  append_point(path, example("before"));
  for (int round = 0; round < 10; ++round) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      for (int i = 0;; ++i) append_point(path, example(std::to_string(round) + "/" + std::to_string(i)));
    }
    usleep(4000 + 1700 * static_cast<useconds_t>(round));
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
    const std::vector<PointRecord> points = read_store(path);
    ASSERT_GE(points.size(), 1U);
    for (const PointRecord& point : points) EXPECT_EQ(point.result("pressure").error, 7.1e6);
  }
  append_point(path, example("after"));
  EXPECT_EQ(read_store(path).back().key, example("after").key);
}

TEST(Store, RefusesOtherFilesAndLeavesThemAlone) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "notes.txt";
  std::ofstream(path) << "not HDF5";
  EXPECT_THROW(read_store(path), InputError);
  EXPECT_THROW(append_point(path, example("point")), InputError);
  EXPECT_THROW(require_writable(path), InputError);
  std::ifstream file(path);
  const std::string content(std::istreambuf_iterator<char>(file), {});
  EXPECT_EQ(content, "not HDF5");
  EXPECT_THROW(read_store(folder.path() / "missing.md.h5"), InputError);
  EXPECT_THROW(require_writable("/proc/whipple/store.md.h5"), InputError);
  EXPECT_THROW(require_writable(folder.path()), InputError);
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// The same points give the same bytes, whatever the order in which they came, and how long they took.
TEST(Store, InOrderHasTheSameBytesWhateverItsHistory) {
  const TemporaryFolder folder;
  const auto first = folder.path() / "first.md.h5";
  const auto second = folder.path() / "second.md.h5";
  for (const char* name : {"a", "b", "c"}) append_point(first, example(name));
  PointRecord failed = example("b");
  failed.status = PointStatus::failed;
  failed.results.clear();
  append_point(second, failed);
  for (const char* name : {"c", "a", "b"}) {
    PointRecord point = example(name);
    point.wall_seconds = 7.0;
    append_point(second, point);
  }
  EXPECT_NE(bytes_of(first), bytes_of(second));
  normalise_store(first);
  normalise_store(second);
  EXPECT_EQ(bytes_of(first), bytes_of(second));
  EXPECT_EQ(read_store(first).size(), 3U);
  // One that is in order stays the file that it is.
  const auto link = folder.path() / "link.md.h5";
  std::filesystem::create_hard_link(first, link);
  normalise_store(first);
  EXPECT_TRUE(std::filesystem::equivalent(first, link));
  EXPECT_THROW(normalise_store(folder.path() / "missing.md.h5"), InputError);
}

TEST(Store, RefusesAnotherVersionByName) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "newer.md.h5";
  {
    hdf5::File file = hdf5::File::create(path, hdf5::File::Compatibility::compact);
    file.root.set_fixed_attribute("format", "whipple-md", hdf5::Characters::utf8);
    file.root.set_attribute("version", 99.0);
    file.close();
  }
  const std::string before = bytes_of(path);
  for (const auto& call : {std::function<void()>([&] { read_store(path); }),
                           std::function<void()>([&] { append_point(path, example("other")); }),
                           std::function<void()>([&] { require_writable(path); })}) {
    try {
      call();
      ADD_FAILURE() << "no error";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("has format version 99, this program reads versions up to 1"),
                std::string::npos)
          << error.what();
    }
  }
  EXPECT_EQ(bytes_of(path), before);
}

/// Returns whether a point of a store is what its record makes of it.
template <class Point>
void expect_same_entries(const PointRecord& stored) {
  const auto point = read_as<Point>(stored);
  EXPECT_EQ(conditions_of(point), stored.conditions) << stored.label();
  const std::map<std::string, Estimate> results = results_of(point);
  ASSERT_EQ(results.size(), stored.results.size()) << stored.label();
  for (const auto& [name, estimate] : stored.results) {
    ASSERT_TRUE(results.contains(name)) << name;
    EXPECT_EQ(results.at(name).value, estimate.value) << name;
    EXPECT_EQ(results.at(name).error, estimate.error) << name;
  }
}

// The store was written before there were records (tests/data/md/copper_records.toml).
TEST(Records, ReadStoresThatExist) {
  const std::filesystem::path path(whipple::tests::source_folder() + "/tests/data/md/copper_records.md.h5");
  const std::vector<PointRecord> points = read_store(path);
  std::map<std::string, std::function<void(const PointRecord&)>> check = {
      {"lattice", expect_same_entries<LatticePoint>},
      {"zero_pressure_volume", expect_same_entries<ZeroPressurePoint>},
      {"isochore", expect_same_entries<StatePoint>},
      {"hugoniot", expect_same_entries<HugoniotPoint>},
      {"cold_curve", expect_same_entries<ColdCurvePoint>},
      {"elastic", expect_same_entries<ElasticPoint>},
      {"quantum", expect_same_entries<QuantumPoint>}};
  EXPECT_EQ(points.size(), check.size());
  for (const PointRecord& point : points) {
    ASSERT_TRUE(check.contains(point.protocol)) << point.protocol;
    check.at(point.protocol)(point);
  }
  EXPECT_NEAR(select_as<LatticePoint>(points).at(0).lattice_constant.value, 3.615e-10, 1e-14);
  const auto state = select_as<StatePoint>(points, "isochore").at(0);
  EXPECT_NEAR(state.pressure.value, 11.6377e9, 1e5);
  EXPECT_TRUE(state.solid);
  EXPECT_EQ(state.temperature, 600.0);
  const auto cold = select_as<ColdCurvePoint>(points).at(0);
  EXPECT_FALSE(cold.fcc_pressure);
  EXPECT_NEAR(*cold.hcp_axial_ratio, 1.631769, 1e-6);
}

TEST(Records, HaveTheUnitsOfTheStore) {
  EXPECT_EQ(unit_of("shock_velocity"), "m/s");
  EXPECT_EQ(unit_of("strain_rate"), "1/s");
  EXPECT_EQ(unit_of("hcp_axial_ratio"), "");
  EXPECT_EQ(unit_of("colour"), "");
  EXPECT_TRUE(is_flag("liquid") && is_flag("solid") && is_flag("converged") && is_flag("elastic"));
  EXPECT_FALSE(is_flag("pressure") || is_flag("colour"));
  EXPECT_EQ(name_of(&HugoniotPoint::shock_velocity), "shock_velocity");
  EXPECT_EQ(name_of(&HugoniostatPoint::imposed_pressure), "pressure");
}

TEST(Records, NameWhatAStoreLacks) {
  PointRecord point = example("point");
  const auto state = read_as<StatePoint>(point);
  EXPECT_EQ(state.error_correlation, 0.0);  // as in stores of older versions
  EXPECT_TRUE(state.solid);
  EXPECT_TRUE(is_solid(point));
  point.results["solid"] = {0.0, 0.0};
  EXPECT_FALSE(read_as<StatePoint>(point).solid);
  EXPECT_FALSE(is_solid(point));
  for (const auto& call : {std::function<void()>([&] { read_as<HugoniotPoint>(point); }),
                           std::function<void()>([&] { required(point, &StatePoint::error_correlation); }),
                           std::function<void()>([&] { condition(point, &SpallPoint::strain_rate); })}) {
    EXPECT_THROW(call(), InputError);
  }
}

TEST(Records, TheListOfTheTheoryIsThatOfTheProgram) {
  std::ifstream file(whipple::tests::source_folder() + "/docs/theory/molecular_dynamics.md");
  const std::string page((std::istreambuf_iterator<char>(file)), {});
  EXPECT_NE(page.find(describe_points()), std::string::npos) << describe_points();
}

TEST(PointRecord, NamesWhatIsMissing) {
  const PointRecord point = example("point");
  EXPECT_EQ(point.origin_number("molar_mass"), 0.06355);
  EXPECT_THROW((void)point.origin_number("potential"), InputError);
  try {
    (void)point.result("shock_velocity");
    FAIL() << "no exception";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("no result 'shock_velocity'"), std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find("temperature = 293 K"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace whipple::md
