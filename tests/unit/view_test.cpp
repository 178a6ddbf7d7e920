// SPDX-License-Identifier: BSD-3-Clause
// Packed clouds and pages of made-up runs.
#include <gtest/gtest.h>
#include <zlib.h>

#include <cstring>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "src/core/base/error.hpp"
#include "src/core/base/json.hpp"
#include "src/io/output_fields.hpp"
#include "src/view/cloud.hpp"
#include "src/view/page.hpp"
#include "tests/unit/folder_test.hpp"

namespace whipple::view {
namespace {

analysis::Run run_of_two_bodies() {
  analysis::Run run;
  run.title = "Kugel & <Platte>";
  run.mirror_planes[1] = 0.25;
  run.bodies = {{.name = "ball", .spacing = 1e-3}, {.name = "plate", .spacing = 2e-3}};
  return run;
}

analysis::Snapshot cloud_of(std::size_t n) {
  analysis::Snapshot snapshot;
  snapshot.time = 2.5e-6;
  for (std::size_t i = 0; i < n; ++i) {
    const auto x = static_cast<double>(i);
    snapshot.id.push_back(3 * i + (i > n / 2 ? 1'000'000 : 0));
    snapshot.position.push_back({0.001 * x, -0.5 + 0.3 * std::sin(x), 0.02});
    snapshot.velocity.push_back({3.0, 4.0 * x, 0.0});
    snapshot.mass.push_back(1e-6 * (1.0 + x));
    snapshot.body.push_back(i % 2);
    snapshot.scalars["pressure"].push_back(-1e9 + 1e8 * x);
    snapshot.scalars["phase"].push_back(static_cast<double>(i % 4));
  }
  return snapshot;
}

/// Reads a `.wpv` file as its description in docs/manual/output.md says, with a full check of its length.
struct Unpacked {
  nlohmann::json header;
  std::array<std::vector<std::uint16_t>, 3> position;
  std::map<std::string, std::vector<std::uint32_t>> planes;

  explicit Unpacked(const std::string& bytes) {
    EXPECT_EQ(bytes.substr(0, 4), "WPV1");
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 4, 4);
    header = parse_json(bytes.substr(8, length));
    std::size_t at = 8 + length;
    const auto n = header.at("n").get<std::size_t>();
    const auto plane = [&](std::size_t width) {
      EXPECT_EQ(at % 4, 0U);
      std::vector<std::uint32_t> values(n, 0);
      for (std::uint32_t& value : values) {
        std::memcpy(&value, bytes.data() + at, width);
        at += width;
      }
      at = (at + 3) / 4 * 4;
      return values;
    };
    for (auto& of_axis : position) {
      for (const std::uint32_t value : plane(2)) of_axis.push_back(static_cast<std::uint16_t>(value));
    }
    for (const nlohmann::json& field : header.at("fields")) {
      const auto type = field.at("type").get<std::string>();
      planes[field.at("name")] = plane(type == "u8" ? 1 : type == "u16" ? 2 : 4);
    }
    EXPECT_EQ(at, bytes.size());
  }
  [[nodiscard]] const nlohmann::json& field(const std::string& name) const {
    for (const nlohmann::json& entry : header.at("fields")) {
      if (entry.at("name") == name) return entry;
    }
    throw std::out_of_range(name);
  }
  [[nodiscard]] double value(const std::string& name, std::size_t i) const {
    const double lo = field(name).at("lo"), hi = field(name).at("hi");
    return lo + (hi - lo) * planes.at(name)[i] / 65534.0;
  }
};

// Equally fast bodies, two of which move alike, and a body that is slower than those that meet.
TEST(Cloud, FliesAlongTheLargestRelativeVelocity) {
  const auto flight = [](const std::vector<Vector3>& velocities) {
    analysis::Run run;
    for (const Vector3& velocity : velocities) run.bodies.push_back({.name = "body", .velocity = velocity});
    return Unpacked(pack_cloud(run, cloud_of(3), {})).header.value("flight", std::vector<double>());
  };
  const Vector3 x = Vector3::UnitX();
  EXPECT_EQ(flight({5e3 * x, Vector3::Zero()}), (std::vector<double>{1.0, 0.0, 0.0}));
  EXPECT_EQ(flight({Vector3::Zero(), 5e3 * x}), (std::vector<double>{1.0, 0.0, 0.0}));
  EXPECT_EQ(flight({5e3 * x, -5e3 * x, 5e3 * x}), (std::vector<double>{1.0, 0.0, 0.0}));
  EXPECT_EQ(flight({-4e3 * x, 5e3 * x, 1e3 * Vector3::UnitY()}), (std::vector<double>{1.0, 0.0, 0.0}));
  EXPECT_TRUE(flight({x, x, x}).empty());
}

TEST(PackedCloud, PositionsAndFieldsComeBackWithinHalfAStep) {
  const std::size_t n = 101;
  const analysis::Snapshot snapshot = cloud_of(n);
  const Unpacked cloud(pack_cloud(run_of_two_bodies(), snapshot, {}));
  ASSERT_EQ(cloud.header.at("n"), n);
  EXPECT_EQ(cloud.header.at("of"), n);
  EXPECT_EQ(cloud.header.at("time"), 2.5e-6);
  EXPECT_EQ(cloud.header.at("title"), "Kugel & <Platte>");
  EXPECT_EQ(cloud.header.at("dimension"), "3d");
  EXPECT_EQ(cloud.header.at("mirrors"), parse_json("[null, 0.25, null]"));
  EXPECT_EQ(cloud.header.at("bodies")[1], parse_json(R"({"name": "plate", "spacing": 0.002})"));
  std::uint64_t id = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double lower = cloud.header.at("lower")[axis], upper = cloud.header.at("upper")[axis];
      const double step = (upper - lower) / 65535.0;
      EXPECT_NEAR(lower + step * cloud.position[axis][i],
                  snapshot.position[i][static_cast<Eigen::Index>(axis)], 0.5001 * step + 1e-17);
    }
    id += cloud.planes.at("id")[i];
    EXPECT_EQ(id, snapshot.id[i]);
    EXPECT_EQ(cloud.planes.at("body")[i], snapshot.body[i]);
    EXPECT_EQ(cloud.planes.at("phase")[i], i % 4);
    EXPECT_NEAR(cloud.value("pressure", i), snapshot.scalars.at("pressure")[i], 0.5001 * 1e10 / 65534.0);
    EXPECT_NEAR(cloud.value("speed", i), snapshot.velocity[i].norm(), 0.5001 * 400.0 / 65534.0);
    EXPECT_EQ(cloud.value("velocity_x", i), 3.0);
  }
}

TEST(PackedCloud, EveryFieldHasTheUnitAndMeaningOfTheOutputFields) {
  analysis::Snapshot snapshot = cloud_of(5);
  for (const io::OutputField& field : io::output_fields()) {
    if (std::holds_alternative<double (*)(const io::FieldSource&, std::size_t)>(field.value) &&
        field.name != "mass")
      snapshot.scalars[std::string(field.name)].assign(5, 1.0);
  }
  const Unpacked cloud(pack_cloud(run_of_two_bodies(), snapshot, {}));
  for (const io::OutputField& field : io::output_fields()) {
    const std::string name(field.name);
    if (!cloud.planes.contains(name)) continue;
    EXPECT_EQ(cloud.field(name).at("unit"), field.unit) << name;
    EXPECT_EQ(cloud.field(name).at("meaning"), field.meaning) << name;
  }
  EXPECT_EQ(cloud.field("speed").at("unit"), "m/s");
  EXPECT_EQ(cloud.field("velocity_z").at("unit"), "m/s");
  EXPECT_GT(cloud.planes.size(), 20U);
}

TEST(PackedCloud, ACloudOfFourFieldsTakes18BytesAParticle) {
  const std::size_t n = 40'000;
  const std::string bytes =
      pack_cloud(run_of_two_bodies(), cloud_of(n), {{"speed", "pressure", "phase", "mass"}});
  // 3 x 2 position, 4 number, 1 body, 1 phase, 3 x 2 fields; the header beside.
  EXPECT_NEAR(static_cast<double>(bytes.size()), 18.0 * n, 2000.0);
}

TEST(PackedCloud, LevelsOfDetailKeepTheSameParticlesAtAllTimes) {
  const std::size_t n = 20'000;
  analysis::Snapshot early = cloud_of(n), late = early;
  for (Vector3& x : late.position) x *= 2.0;
  const auto numbers = [](const Unpacked& cloud) {
    std::vector<std::uint64_t> ids;
    std::uint64_t id = 0;
    for (const std::uint32_t step : cloud.planes.at("id")) ids.push_back(id += step);
    return ids;
  };
  const CloudOptions options{.fields = {"speed"}, .one_of = 10};
  const Unpacked first(pack_cloud(run_of_two_bodies(), early, options)),
      second(pack_cloud(run_of_two_bodies(), late, options));
  EXPECT_EQ(numbers(first), numbers(second));
  EXPECT_NEAR(first.header.at("n").get<double>(), 0.1 * n, 5.0 * std::sqrt(0.09 * n));
  EXPECT_EQ(first.header.at("of"), n);
  EXPECT_EQ(first.header.at("one_of"), 10);
}

TEST(PackedCloud, WhatIsNoNumberIsMarkedAndDoesNotSpoilTheRange) {
  analysis::Snapshot snapshot = cloud_of(4);
  snapshot.scalars["pressure"] = {1.0, std::numeric_limits<double>::quiet_NaN(), 3.0,
                                  std::numeric_limits<double>::infinity()};
  const Unpacked cloud(pack_cloud(run_of_two_bodies(), snapshot, {}));
  EXPECT_EQ(cloud.field("pressure").at("lo"), 1.0);
  EXPECT_EQ(cloud.field("pressure").at("hi"), 3.0);
  EXPECT_EQ(cloud.planes.at("pressure"), (std::vector<std::uint32_t>{0, 65535, 65534, 65535}));
}

TEST(PackedCloud, FieldsOfEightBitsHaveTheirOwnSteps) {
  analysis::Snapshot snapshot = cloud_of(4);
  snapshot.scalars["pressure"] = {1.0, std::numeric_limits<double>::quiet_NaN(), 3.0, 2.0};
  const std::string wide = pack_cloud(run_of_two_bodies(), snapshot, {}),
                    narrow = pack_cloud(run_of_two_bodies(), snapshot, {.fields = {}, .bits = 8});
  const Unpacked cloud(narrow);
  EXPECT_EQ(cloud.field("pressure").at("type"), "u8");
  EXPECT_EQ(cloud.planes.at("pressure"), (std::vector<std::uint32_t>{0, 255, 254, 127}));
  const Unpacked full(wide);
  EXPECT_EQ(cloud.position, full.position);
  for (const char* exact : {"id", "phase", "body"}) EXPECT_EQ(cloud.planes.at(exact), full.planes.at(exact));
  EXPECT_LT(narrow.size(), wide.size());
}

TEST(PackedCloud, UnknownFieldsAndEmptySnapshotsAreRefused) {
  EXPECT_EQ(message_of<InputError>([] { pack_cloud(run_of_two_bodies(), cloud_of(3), {{"presure"}}); }),
            "the snapshots have no field \"presure\", did you mean \"pressure\"?\n"
            "known: speed, velocity_x, velocity_y, velocity_z, mass, pressure, phase");
  EXPECT_NE(message_of<InputError>([] { pack_cloud(run_of_two_bodies(), {}, {}); }).find("no particles"),
            std::string::npos);
}

TEST(PackedCloud, GzipAndBase64AreThoseOfTheirStandards) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");  // RFC 4648, section 10
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
  const std::string text(100'000, 'x'), packed = gzipped(text);
  EXPECT_LT(packed.size(), 300U);
  EXPECT_EQ(packed, gzipped(text));
  std::string back(text.size(), '\0');
  z_stream stream = {};
  ASSERT_EQ(inflateInit2(&stream, 15 + 16), Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(back.data());
  stream.avail_out = static_cast<uInt>(back.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  inflateEnd(&stream);
  EXPECT_EQ(back, text);
}

class ViewerModules : public FolderTest {
 protected:
  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }
};

TEST_F(ViewerModules, AreJoinedEachOnceAfterWhatTheyNeed) {
  write("main.js", "import { b } from './b.js';\nimport { c } from './c.js';\nb(c);\n");
  write("b.js", "import { c } from './c.js';\nexport function b() { return c; }\n");
  write("c.js", "export const c = 1;\n");
  EXPECT_EQ(joined_modules(folder_ / "main.js"), "const c = 1;\nfunction b() { return c; }\nb(c);\n");
}

TEST_F(ViewerModules, OtherImportsAndMissingFilesAreNamed) {
  write("main.js", "import three from 'three';\n");
  EXPECT_NE(
      message_of<InputError>([&] { joined_modules(folder_ / "main.js"); }).find("main.js: error: imports"),
      std::string::npos);
  write("main.js", "import { b } from './b.js';\n");
  EXPECT_NE(message_of<InputError>([&] { joined_modules(folder_ / "main.js"); }).find("b.js"),
            std::string::npos);
}

TEST(ViewerPage, OfARunWithoutSnapshotsIsRefused) {
  EXPECT_NE(
      message_of<InputError>([] { make_page(run_of_two_bodies(), {}, "nowhere"); }).find("has no snapshots"),
      std::string::npos);
}

}  // namespace
}  // namespace whipple::view
