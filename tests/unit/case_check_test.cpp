// SPDX-License-Identifier: BSD-3-Clause
// A case built in code is checked as one from a file is: the same faults under the same keys, as data.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "src/case/shapes/box.hpp"
#include "src/case/shapes/sphere.hpp"
#include "tests/folders.hpp"
#include "tests/unit/case_support.hpp"

namespace whipple::cases {
namespace {

Case ball_in_box() {
  Case setup;
  setup.domain.upper = Vector3(0.012, 0.012, 0.012);
  setup.domain.cell_size = 1e-3;
  setup.time.end = 4e-6;
  Body& body = setup.bodies.emplace_back();
  body.name = "ball";
  body.material = "copper.toml";
  body.shape = std::make_shared<Sphere>(Vector3(0.006, 0.006, 0.006), 0.003);
  return setup;
}

std::vector<std::string> keys_of(const std::vector<InputFault>& faults) {
  std::vector<std::string> keys;
  for (const InputFault& fault : faults) keys.push_back(fault.key);
  std::ranges::sort(keys);
  return keys;
}

using Keys = std::vector<std::string>;

TEST(CaseInCode, IsCompletedWithWhatFollowsFromItsKeys) {
  EXPECT_EQ(keys_of(check(ball_in_box())), Keys{});
  const Case setup = complete(ball_in_box());
  EXPECT_EQ(setup.geometry.cells, (std::array<std::int32_t, 3>{12, 12, 12}));
  EXPECT_EQ(setup.transfer.particle_update, ParticleUpdate::relaxed_affine);
  EXPECT_EQ(setup.dissipation.losses, Losses::unresolved);
  EXPECT_TRUE(setup.bodies[0].discretization.partial_volumes);
  EXPECT_EQ(setup.contact_fields.of_body, std::vector<std::uint8_t>{0});
  ASSERT_NE(setup.materials.at(0), nullptr);
  Case other = ball_in_box();
  other.time.scheme = Scheme::usl;
  other = complete(other);
  EXPECT_EQ(other.transfer.particle_update, ParticleUpdate::flip);
  EXPECT_EQ(other.dissipation.losses, Losses::heat);
  // What is written is the same as what a file with these keys gives.
  EXPECT_EQ(to_toml(read_case_text(to_toml(setup, {"copper.toml"}), "run.toml"), {"copper.toml"}),
            to_toml(setup, {"copper.toml"}));
}

TEST(CaseInCode, BodiesThatTouchMayHaveUnknownMaterials) {
  Case setup = ball_in_box();
  setup.bodies.push_back(setup.bodies[0]);
  setup.bodies[1].name = "other";
  setup.bodies[1].shape = std::make_shared<Box>(Vector3(0.004, 0.004, 0.0), Vector3(0.008, 0.008, 0.003));
  for (Body& body : setup.bodies) body.material = "coper";
  EXPECT_EQ(keys_of(check(setup)), (Keys{"body.0.material", "body.1.material"}));
}

TEST(CaseInCode, AMeshThatRunTomlCannotNameIsRefused) {
  Case setup = ball_in_box();
  setup.bodies[0].shape = nullptr;
  setup.bodies[0].discretization.mesh = "/folder \xff/ball.msh";
  const std::vector<InputFault> faults = check(setup);
  const auto found = std::ranges::find(faults, "body.0.discretization.mesh", &InputFault::key);
  ASSERT_NE(found, faults.end());
  EXPECT_NE(found->text.find("rename what is not UTF-8"), std::string::npos) << found->text;
}

TEST(CaseInCode, FaultsAreListedWithTheirKeys) {
  Case setup = ball_in_box();
  setup.domain.cell_size = 0.0;
  setup.time.courant = 2.0;
  setup.transfer.particle_update = ParticleUpdate::fmpm;
  setup.bodies[0].material = "coper";
  setup.bodies[0].discretization.per_cell = 5;
  setup.gauges = {{"a,b", GaugeKind::fixed, Vector3::Zero()}};
  setup.bodies.push_back(setup.bodies[0]);
  setup.bodies[1].shape = nullptr;
  const std::vector<InputFault> faults = check(setup);
  EXPECT_EQ(keys_of(faults),
            (Keys{"body.0.discretization.per_cell", "body.0.material", "body.1.discretization.per_cell",
                  "body.1.material", "body.1.name", "body.1.shape", "domain.cell_size", "gauge.0.name",
                  "time.courant", "transfer.particle_update"}));
  for (const InputFault& fault : faults) {
    EXPECT_EQ(fault.file, "");
    EXPECT_EQ(fault.line, 0U);
    EXPECT_NE(fault.text, "");
  }
  EXPECT_EQ(keys_of(check(Case{})), (Keys{"body", "domain.cell_size", "time.end"}));
  try {
    static_cast<void>(complete(setup));
    ADD_FAILURE() << "a bad case was completed";
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().size(), faults.size());
    EXPECT_NE(std::string(error.what()).find("time.courant: error: 'courant' is 2"), std::string::npos)
        << error.what();
  }
}

TEST(CaseInCode, BodiesThatCannotBePlacedAreFaults) {
  Case setup = ball_in_box();
  setup.bodies.push_back(setup.bodies[0]);
  setup.bodies[1].name = "other";
  setup.gauges = {{"far", GaugeKind::moving, Vector3(0.001, 0.001, 0.001)}};
  EXPECT_EQ(keys_of(check(setup)), (Keys{"body.1.shape", "gauge.0.position"}));
  setup = ball_in_box();
  setup.bodies[0].shape = std::make_shared<Box>(Vector3(0.005, 0.005, 0.005), Vector3(0.005, 0.008, 0.008));
  EXPECT_EQ(keys_of(check(setup)), Keys{"body.0.shape"});
}

/// The faults of a text.
std::vector<InputFault> faults_of(const std::string& text) {
  try {
    read_case_text(text, "case.toml");
  } catch (const InputError& error) {
    return error.faults();
  }
  return {};
}

TEST(CaseFile, FaultsHaveThePlaceAndTheKey) {
  std::string text = domain + sphere;
  text = replaced(text, "end = \"4 us\"", "end = \"4 us\"\ncourant = 2");
  text = replaced(text, "copper.toml", "coper.toml");
  text = replaced(text, "5.55 km/s", "5.55 K");
  text = replaced(text, "name = \"sphere\"", "name = \"a b\"\nshpe = 1");
  const std::vector<InputFault> faults = faults_of(text);
  EXPECT_EQ(keys_of(faults),
            (Keys{"body.0.material", "body.0.name", "body.0.shpe", "body.0.velocity", "time.courant"}));
  ASSERT_EQ(faults.size(), 5U);
  EXPECT_EQ(faults[0].key, "time.courant");  // by their places
  EXPECT_EQ(faults[0].file, "case.toml");
  EXPECT_EQ(faults[0].line, 9U);
  EXPECT_EQ(faults[0].column, 11U);
  EXPECT_EQ(faults[0].message(), "case.toml:9:11: error: " + faults[0].text);
}

// A key that cannot be read has one fault: what a check says of the default in its place is no help.
TEST(CaseFile, AKeyThatCannotBeReadIsReportedOnce) {
  EXPECT_EQ(keys_of(faults_of(replaced(domain, "\"4 us\"", "\"4 kg\"") + sphere)), Keys{"time.end"});
  EXPECT_EQ(keys_of(faults_of(replaced(domain, "cell_size = \"1 mm\"", "") + sphere)),
            Keys{"domain.cell_size"});
  EXPECT_EQ(keys_of(faults_of(domain + replaced(sphere, "radius = \"3 mm\"", "radius = \"-3 mm\""))),
            Keys{"body.0.shape.sphere.radius"});
  EXPECT_EQ(keys_of(faults_of(domain + replaced(sphere, "name = \"sphere\"\n", ""))), Keys{"body.0.name"});
}

// Whatever the repository holds is read: no key of a case file has been lost.
TEST(CaseFile, AllOfTheRepositoryAreAccepted) {
  int count = 0;
  for (const char* folder : {"cases", "tests/data"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(
             std::filesystem::path(whipple::tests::source_folder()) / folder)) {
      if (entry.path().extension() != ".toml") continue;
      std::ifstream file(entry.path());
      const std::string text{std::istreambuf_iterator<char>(file), {}};
      if (text.find("\n[domain]") == std::string::npos) continue;
      SCOPED_TRACE(entry.path().string());
      // The material of this case would start molecular dynamics.
      const bool simulates = entry.path().parent_path().filename() == "inline";
      using Overrides = std::vector<std::pair<std::string, std::string>>;
      EXPECT_NO_THROW(read_case(entry.path(), simulates ? Overrides{{"body.0.material", "copper.toml"},
                                                                    {"body.1.material", "copper.toml"}}
                                                        : Overrides{}));
      ++count;
    }
  }
  EXPECT_GT(count, 25);
}

}  // namespace
}  // namespace whipple::cases
