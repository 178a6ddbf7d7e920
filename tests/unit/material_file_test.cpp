// SPDX-License-Identifier: BSD-3-Clause
// Material files: every library material reads and starts at zero pressure; errors name file, line, key and
// what is accepted, all at once.
#include "src/material/material_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "eos/catalogue.hpp"
#include "src/core/base/error.hpp"
#include "src/material/failure/catalogue.hpp"
#include "src/material/material_samples.hpp"
#include "src/material/strength/catalogue.hpp"
#include "src/material/update.hpp"

namespace whipple {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// A folder of its own for each test.
class MaterialFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        fs::path(::testing::TempDir()) /
        ("material_file_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override {
    unsetenv("WHIPPLE_MATERIALS");
    fs::remove_all(folder_);
  }
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  static std::string message(const fs::path& file, const fs::path& beside = {}) {
    try {
      static_cast<void>(read_material(file, beside));
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
  fs::path folder_;
};

const std::string sound_eos = R"toml(name = "metal"
source = "test"
[eos]
model = "mie_gruneisen"
reference_density = "8.93 g/cm^3"
hugoniot_intercept = "3.94 km/s"
hugoniot_slope = 1.49
gruneisen = 1.96
heat_capacity = "383 J/(kg K)"
)toml";

TEST_F(MaterialFile, ReadsUnitsModelsAndRemarks) {
  const fs::path file = write("metal.toml", sound_eos + R"toml(
[strength]
model = "von_mises"
source = "a report"
note = "free text"
youngs_modulus = "117 GPa"
poisson_ratio = 0.35
yield_stress = "157 MPa"
[[failure]]
model = "tensile_pressure"
spall_strength = "13 kbar"
[[failure]]
model = "plastic_strain"
failure_strain = 3.0
[provenance]
anything = { goes = [1, 2, "three"] }
[defaults]
cell_size = "1 mm"
)toml");
  const Material material = read_material(file);
  EXPECT_EQ(material.name, "metal");
  EXPECT_EQ(material.file, file);
  EXPECT_EQ(material.eos->model(), "mie_gruneisen");
  EXPECT_EQ(material.strength->model(), "von_mises");
  const std::array at_rest = {0.0}, cold = {300.0};
  std::array<double, 1> flow = {};
  material.strength->flow_stress({at_rest, at_rest, cold, at_rest}, at_rest, flow);
  EXPECT_NEAR(flow[0], 157e6, 1e-3);
  ASSERT_EQ(material.failure.size(), 2U);
  EXPECT_EQ(material.failure[0]->model(), "tensile_pressure");
  EXPECT_THAT(material.failure[0]->constants(), HasSubstr("1300000000 Pa"));
  EXPECT_NEAR(material.reference.density, 8930.0, 1e-9);
  EXPECT_NEAR(material.reference.sound_speed, 3940.0, 1e-6);
}

const std::string strong = sound_eos + R"toml(
[strength]
model = "von_mises"
youngs_modulus = "117 GPa"
poisson_ratio = 0.35
yield_stress = "157 MPa"
[[failure]]
model = "tensile_pressure"
spall_strength = "13 kbar"
)toml";

double flow_stress_of(const Material& material) {
  const std::array at_rest = {0.0}, cold = {300.0};
  std::array<double, 1> flow = {};
  material.strength->flow_stress({at_rest, at_rest, cold, at_rest}, at_rest, flow);
  return flow[0];
}

TEST_F(MaterialFile, TakesWhatItDoesNotSayFromItsBase) {
  write("metal.toml", strong);
  write("hard.toml",
        "base = \"metal\"\nname = \"hard\"\nsource = \"test\"\n[strength]\nyield_stress = \"300 MPa\"\n");
  const fs::path file = write("tough.toml",
                              "base = \"hard.toml\"\nname = \"tough\"\nsource = \"test\"\n[[failure]]\n"
                              "model = \"plastic_strain\"\nfailure_strain = 3.0\n");
  const Material material = read_material(file);
  EXPECT_EQ(material.name, "tough");
  EXPECT_EQ(material.eos->model(), "mie_gruneisen");
  EXPECT_NEAR(flow_stress_of(material), 300e6, 1e-3);  // of hard, with the modulus of metal
  ASSERT_EQ(material.failure.size(), 1U);              // a list is one thing
  EXPECT_EQ(material.failure[0]->model(), "plastic_strain");
  // A table of another model takes nothing.
  EXPECT_THAT(
      message(
          write("other.toml",
                "base = \"metal\"\nname = \"other\"\nsource = \"test\"\n[strength]\nmodel = \"elastic\"\n")),
      HasSubstr("needs a positive 'shear_modulus'"));
  EXPECT_EQ(
      read_material(
          write("fluid.toml",
                "base = \"metal\"\nname = \"fluid\"\nsource = \"test\"\n[strength]\nmodel = \"none\"\n"))
          .strength->model(),
      "none");
  // A base is no source of what replaces its own.
  write("warm.toml", strong + "[thermal]\nsource = \"test\"\nconductivity = \"400 W/(m K)\"\n");
  EXPECT_THAT(message(write("hot.toml",
                            "base = \"warm\"\nname = \"hot\"\nsource = \"test\"\n"
                            "[thermal]\ntaylor_quinney = 0.9\n")),
              HasSubstr("missing key 'source' in [thermal]"));
  // Its text needs neither base.
  const fs::path alone = folder_ / "run";
  fs::create_directories(alone);
  std::ofstream(alone / "tough.toml") << material_text(file);
  const Material copy = read_material(alone / "tough.toml");
  const auto without_path = [](const std::string& text) { return text.substr(text.find('\n')); };
  EXPECT_EQ(without_path(copy.constants()), without_path(material.constants()));
  EXPECT_EQ(material_text(folder_ / "metal.toml"), strong);
}

TEST_F(MaterialFile, FaultsOfABaseAreNamedInItsFile) {
  const std::string head = "name = \"m\"\nsource = \"test\"\n";
  write("wrong.toml", sound_eos + "[strength]\nmodel = \"von_mises\"\nyield_stress = \"157 kg\"\n");
  const fs::path file = write("of_wrong.toml", "base = \"wrong\"\n" + head + "[thermal]\nconductivty = 1\n");
  EXPECT_THAT(message(file),
              AllOf(HasSubstr((folder_ / "wrong.toml").string() + ":12:16: error: 'yield_stress'"),
                    HasSubstr(file.string() + ":5:1: error: unknown key 'thermal.conductivty'")));
  const fs::path none = write("of_none.toml", "base = \"metl\"\n" + head);
  EXPECT_THAT(message(none), AllOf(HasSubstr(none.string() + ":1:8: error: 'base'"), HasSubstr("metl")));
  const fs::path own = write("own.toml", "base = \"own\"\n" + head);
  EXPECT_THAT(message(own), HasSubstr("is one of them its own?"));
  EXPECT_THAT(message(write("number.toml", "base = 3\n" + sound_eos)), HasSubstr("'base' is an integer"));
  EXPECT_THAT(message(write("nameless.toml", "base = \"metal\"\n")), HasSubstr("no material file"));
  write("metal.toml", sound_eos);
  EXPECT_THAT(message(write("nameless.toml", "base = \"metal\"\n")),
              AllOf(HasSubstr("missing key 'name'"), HasSubstr("missing key 'source'")));
}

TEST_F(MaterialFile, StrengthAndFailureMayBeMissing) {
  const Material material = read_material(write("metal.toml", sound_eos));
  EXPECT_EQ(material.strength->model(), "none");
  EXPECT_TRUE(material.failure.empty());
}

TEST_F(MaterialFile, ReportsAllErrorsAtOnceWithLineColumnAndSuggestion) {
  const fs::path file = write("bad.toml", R"toml(name = "bad"
source = "test"
[eos]
model = "mie_gruneisen"
reference_density = "8.93 km/s"
hugoniot_intercept = "3.94 km/s"
hugoniot_slpoe = 1.49
gruneisen = 1.96
heat_capacity = "-3 J/(kg K)"
[strength]
model = "jonson_cook"
[[failure]]
model = "tensile_pressure"
spall_strength = "1 furlong"
)toml");
  const std::string text = message(file);
  const std::string at = file.string() + ":";
  EXPECT_THAT(text, HasSubstr(at + "5:21: error: 'reference_density' unit 'km/s' has the wrong dimension"));
  EXPECT_THAT(text, HasSubstr("missing key 'hugoniot_slope' in [eos]"));
  EXPECT_THAT(
      text, HasSubstr(at + "7:1: error: unknown key 'eos.hugoniot_slpoe', did you mean \"hugoniot_slope\"?"));
  EXPECT_THAT(text, HasSubstr(at + "9:17: error: 'heat_capacity' is -3 J/(kg K), but must be > 0 J/(kg K)"));
  EXPECT_THAT(text, AllOf(HasSubstr("'model' is \"jonson_cook\", did you mean \"johnson_cook\"?"),
                          HasSubstr("Accepted: none, viscous_fluid, elastic, von_mises, ")));
  EXPECT_THAT(text, HasSubstr(at + "14:18: error: 'spall_strength' unit"));
  EXPECT_EQ(std::ranges::count(text, '\n'), 5);  // six errors
}

TEST_F(MaterialFile, ReportsMissingTableAndUnknownTable) {
  EXPECT_THAT(message(write("a.toml", "name = \"a\"\nsource = \"b\"\n")), HasSubstr("missing table [eos]"));
  EXPECT_THAT(message(write("b.toml", sound_eos + "[strenght]\nmodel = \"none\"\n")),
              HasSubstr("unknown key 'strenght', did you mean \"strength\"?"));
  EXPECT_THAT(
      message(write("c.toml", "[eos]\nmodel = \"none\"\n")),
      AllOf(HasSubstr("missing key 'name'"), HasSubstr("missing key 'source'"), HasSubstr("Accepted: ")));
}

TEST_F(MaterialFile, ReportsConstantsThatContradictOneAnotherWithTheirTable) {
  const fs::path file =
      write("metal.toml", sound_eos + "[strength]\nmodel = \"von_mises\"\nyield_stress = \"1 MPa\"\n");
  EXPECT_THAT(message(file), AllOf(HasSubstr(file.string() + ":10:"), HasSubstr("[strength]"),
                                   HasSubstr("'shear_modulus'")));
}

TEST_F(MaterialFile, BareNamesAreLookedUpBesideTheCaseThenInTheLibrary) {
  EXPECT_EQ(find_material("copper").filename(), "copper.toml");
  EXPECT_EQ(find_material("copper.toml", folder_), find_material("copper"));
  write("copper.toml", sound_eos);
  EXPECT_EQ(find_material("copper", folder_), folder_ / "copper.toml");
  EXPECT_EQ(read_material("copper", folder_).name, "metal");
}

TEST_F(MaterialFile, EnvironmentAddsALibraryThatHidesTheOwnOne) {
  write("copper.toml", sound_eos);
  write("mine.toml", sound_eos);
  setenv("WHIPPLE_MATERIALS", folder_.c_str(), 1);
  EXPECT_EQ(find_material("copper"), folder_ / "copper.toml");
  EXPECT_EQ(read_material("mine").name, "metal");
  EXPECT_TRUE(std::ranges::any_of(library_materials(),
                                  [&](const auto& m) { return m.file == folder_ / "mine.toml"; }));
}

TEST_F(MaterialFile, MissingFilesNameTheFoldersSearchedAndTheNearestMaterial) {
  EXPECT_THAT(
      message("coper.toml", folder_),
      AllOf(HasSubstr("no material file 'coper.toml', did you mean \"copper\"?"), HasSubstr(folder_.string()),
            HasSubstr("eos/materials"), HasSubstr("'whipple materials' lists")));
  EXPECT_THAT(message("no/such.toml", folder_), HasSubstr((folder_ / "no/such.toml").string()));
}

TEST_F(MaterialFile, UnreadableLibraryFileIsListedWithItsReason) {
  write("broken.toml", "name = 3\n");
  setenv("WHIPPLE_MATERIALS", folder_.c_str(), 1);
  const auto all = library_materials();
  const auto found = std::ranges::find(all, std::string("broken"), &LibraryMaterial::name);
  ASSERT_NE(found, all.end());
  EXPECT_THAT(found->note, HasSubstr("cannot be read"));
}

TEST_F(MaterialFile, ConstantsWrittenToOutputReadBackToTheSameMaterial) {
  for (const LibraryMaterial& entry : library_materials()) {
    const Material material = read_material(entry.file);
    const Material again = read_material(write("again.toml", material.constants()));
    const auto without_first_line = [](const std::string& text) { return text.substr(text.find('\n')); };
    EXPECT_EQ(without_first_line(again.constants()), without_first_line(material.constants())) << entry.file;
    EXPECT_EQ(again.reference.density, material.reference.density) << entry.file;
  }
}

TEST(Library, EveryMaterialStartsInItsReferenceStateAndStaysThereAtRest) {
  const std::vector<LibraryMaterial> all = library_materials();
  ASSERT_GE(all.size(), 7U);
  for (const LibraryMaterial& entry : all) {
    SCOPED_TRACE(entry.file.string());
    EXPECT_FALSE(entry.note.empty());
    const Material material = read_material(entry.file);
    const double modulus =
        material.reference.density * material.reference.sound_speed * material.reference.sound_speed;
    // Gases and detonation products, which have no state of zero pressure, start in their reference state.
    const double rest_pressure = material.eos->condensed() ? 0.0 : material.reference.pressure;
    EXPECT_NEAR(material.reference.pressure, rest_pressure, 1e-10 * modulus);
    EXPECT_NEAR(material.reference.density, material.eos->reference_density(),
                1e-6 * material.reference.density);
    const double room = material.eos->reference_temperature();
    if (material.eos->condensed()) {
      EXPECT_NEAR(room, 299.0, 1.0);  // 298 K or 300 K, as measured
    }
    EXPECT_NEAR(material.reference.temperature, room, 1e-9);
    MaterialPoints points;
    resize(points, 3);
    for (double& mass : points.mass) mass = 1e-6;
    initialise(material, points, 0, 3);
    const MaterialPoints before = points;
    const std::vector<Matrix3> rest(3, Matrix3::Zero());
    const MaterialReport report =
        update_material(material, points, 0, 3, rest, {.time_step = 1e-9, .cell_size = 1e-3});
    EXPECT_TRUE(report.valid());
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(points.volume[i], before.volume[i]);
      EXPECT_NEAR(points.pressure[i], rest_pressure, 1e-10 * modulus);
      EXPECT_NEAR(points.sound_speed[i], before.sound_speed[i], 1e-9 * before.sound_speed[i]);
      EXPECT_NEAR(points.temperature[i], room, 1e-7 * room);
      EXPECT_EQ(points.failed[i], 0);
    }
  }
}

TEST(Library, EveryTableOfConstantsNamesItsSource) {
  for (const LibraryMaterial& entry : library_materials()) {
    std::ifstream file(entry.file);
    std::string line, table = "file";
    std::map<std::string, bool> sourced;
    int number = 0;
    while (std::getline(file, line)) {
      if (line.starts_with("[")) table = line + std::to_string(++number);
      if (line.starts_with("source = ") || line == "model = \"none\"") sourced[table] = true;
      sourced.try_emplace(table, false);
    }
    for (const auto& [name, has_source] : sourced) EXPECT_TRUE(has_source) << entry.file << " " << name;
  }
}

TEST(Library, CopperMeltsAndLosesItsStrengthByTheEquationOfState) {
  // Heated at its reference volume, copper melts between the isochoric melting points of its equation of
  // state; the deviator is gone when the melted fraction is 1, and the sound speed is then the bulk one.
  const Material copper = read_material("copper");
  MaterialPoints points;
  resize(points, 1);
  points.mass[0] = 1e-6;
  initialise(copper, points, 0, 1);
  const UpdateSettings settings{.time_step = 1e-9, .cell_size = 1e-3};
  Matrix3 shear = Matrix3::Zero();
  shear(0, 1) = 2e5;
  for (int n = 0; n < 20; ++n) update_material(copper, points, 0, 1, std::span(&shear, 1), settings);
  ASSERT_GT(points.deviatoric_stress[0].xy, 40e6);
  double melting_begins = 0.0, melting_ends = 0.0;
  const Matrix3 rest = Matrix3::Zero();
  for (double energy = 0.0; energy < 1.5e6; energy += 5e3) {
    points.specific_internal_energy[0] = energy;
    ASSERT_TRUE(update_material(copper, points, 0, 1, std::span(&rest, 1), settings).valid());
    if (melting_begins == 0.0 && points.melted_fraction[0] > 0.0) melting_begins = points.temperature[0];
    if (melting_ends == 0.0 && points.melted_fraction[0] >= 1.0) melting_ends = points.temperature[0];
  }
  // The melting band lies symmetrically about the melting temperature of the isochore V0, here 1790 K; the
  // energy step of the loop is 13 K.
  EXPECT_NEAR(0.5 * (melting_begins + melting_ends), 1790.0, 40.0);
  EXPECT_GE(melting_ends, melting_begins);
  EXPECT_EQ(points.deviatoric_stress[0].squared_norm(), 0.0);
  EXPECT_NEAR(
      points.sound_speed[0],
      copper.eos->state(points.mass[0] / points.volume[0], points.specific_internal_energy[0]).sound_speed,
      1e-9 * points.sound_speed[0]);
}

TEST(PlasticWork, ShareThatIsHeatStandsInTheMaterialFile) {
  const auto changed = [](const char* material, const char* share) {
    const std::pair<std::string, std::string> change = {"thermal.taylor_quinney", share};
    return read_changed_material(find_material(material, {}), std::span(&change, 1));
  };
  EXPECT_FALSE(read_material("copper_ofhc").stores_cold_work());
  const Material copper = changed("copper_ofhc", "0.9");
  EXPECT_EQ(copper.taylor_quinney, 0.9);
  EXPECT_THAT(copper.constants(), HasSubstr("taylor_quinney = 0.9"));
  for (const char* wrong : {"0", "1.01", "-1", "nan"})
    EXPECT_THROW(changed("copper_ofhc", wrong), InputError) << wrong;
  // No plastic work of (7) to count.
  Material concrete = read_material("concrete_48mpa_hjc");
  EXPECT_THROW(set_taylor_quinney(concrete, 0.9), InputError);
}

// Nothing of a material is lost when a table takes the place of its equation of state.
TEST(Material, WithAnotherEquationOfStateIsTheSameInAllElse) {
  for (const char* name : {"copper", "concrete_35mpa_rht", "tungsten_nickel_iron", "lead_mie_gruneisen"}) {
    Material material = read_material(std::string(name));
    material.conductivity = 123.0;
    if (material.strength->brittle() == nullptr && material.void_growth == nullptr)
      set_taylor_quinney(material, 0.9);
    const Material other = with_eos(material, read_material("aluminium_mie_gruneisen").eos);
    EXPECT_EQ(other.eos->model(), "mie_gruneisen") << name;
    EXPECT_NE(other.reference.density, material.reference.density) << name;
    const Material back = with_eos(other, material.eos);
    EXPECT_EQ(back.constants(), material.constants()) << name;
    EXPECT_EQ(back.reference.density, material.reference.density) << name;
    EXPECT_EQ(back.reference_bulk_modulus, material.reference_bulk_modulus) << name;
    const auto rest = [](const Material& m) {
      return std::tuple(m.name, m.file, m.companions, m.source, m.note, m.group, m.conductivity,
                        m.taylor_quinney, m.strength, m.failure, m.void_growth);
    };
    EXPECT_TRUE(rest(other) == rest(material)) << name;
  }
}

TEST(InitialState, GivenTemperatureOrDensityGivesTheirState) {
  const Material copper = read_material("copper");
  const eos::State hot = initial_state(copper, {}, 800.0);
  EXPECT_LT(hot.density, copper.reference.density);  // thermal expansion at zero pressure
  EXPECT_NEAR(hot.pressure, 0.0, 10.0);
  // Touloukian's recommended linear expansion of copper at 800 K is 0.92 % (volume 2.8 %)
  EXPECT_NEAR(copper.reference.density / hot.density, 1.028, 0.006);
  const eos::State dense = initial_state(copper, 9500.0);
  EXPECT_GT(dense.pressure, 5e9);
  EXPECT_EQ(dense.temperature, 300.0);
  EXPECT_THROW(static_cast<void>(initial_state(copper, {}, 50000.0)), InputError);
  EXPECT_THROW(static_cast<void>(initial_state(copper, 1e6)), InputError);
}

TEST(InitialState, PressureWithTemperatureOrDensityGivesTheirState) {
  const Material copper = read_material("copper");
  const eos::State hot = initial_state(copper, {}, 600.0, 1e5);
  EXPECT_NEAR(hot.pressure, 1e5, 1.0);
  EXPECT_NEAR(hot.temperature, 600.0, 1e-6);
  EXPECT_NEAR(hot.density, initial_state(copper, {}, 600.0).density, 1e-5 * hot.density);
  const eos::State squeezed = initial_state(copper, {}, {}, 10e9);
  EXPECT_EQ(squeezed.temperature, copper.reference.temperature);
  EXPECT_NEAR(squeezed.density / copper.reference.density, 1.065,
              0.005);  // 8.93 to 9.52: isotherm of Dewaele
  const eos::State dense = initial_state(copper, 9500.0, {}, 20e9);
  EXPECT_EQ(dense.density, 9500.0);
  EXPECT_NEAR(dense.pressure, 20e9, 1e3);
  EXPECT_GT(dense.temperature, 1000.0);
  const eos::State vapour = initial_state(copper, {}, 12000.0, 1e5);  // above the critical temperature
  EXPECT_NEAR(vapour.density, 1e5 * 0.063546 / (8.314 * 12000.0), 0.01);
  EXPECT_NEAR(vapour.pressure, 1e5, 1.0);
  const eos::State air = initial_state(read_material("air"), {}, 300.0, 101325.0);
  EXPECT_NEAR(air.density, 101325.0 / (287.0 * 300.0), 0.01);
  for (const auto& [density, temperature, pressure] :
       {std::tuple<double, double, double>{9000, 300, 1e5}, {0, 300, -50e9}, {8930, 0, -50e9}}) {
    const auto given = [](double x) { return x == 0.0 ? std::nullopt : std::optional(x); };
    EXPECT_THROW(static_cast<void>(initial_state(copper, given(density), given(temperature), pressure)),
                 InputError);
  }
}

TEST(PeakFields, KeepWhatWasReachedAndWhenHalfOfTheMassMelted) {
  const Material copper = read_material("copper");
  MaterialPoints points;
  resize(points, 1);
  points.mass[0] = copper.reference.density * 1e-9;
  initialise(copper, points, 0, 1);
  EXPECT_EQ(points.melting_time[0], never);
  EXPECT_EQ(points.maximum_temperature[0], points.temperature[0]);
  double pressure = 0.0, temperature = 0.0, melted_at = never;
  for (int n = 1; n <= 400; ++n) {
    const double rate = n <= 200 ? -1e-4 : 1.2e-4;
    points.specific_internal_energy[0] += n <= 200 ? 6e3 : -4e3;
    const Matrix3 gradient = rate / 1e-8 * Matrix3::Identity();
    update_material(copper, points, 0, 1, std::span(&gradient, 1),
                    {.time_step = 1e-8, .cell_size = 1e-3, .time = n * 1e-8});
    pressure = std::max(pressure, points.pressure[0]);
    temperature = std::max(temperature, points.temperature[0]);
    if (melted_at == never && points.melted_fraction[0] >= 0.5) melted_at = n * 1e-8;
  }
  EXPECT_GT(melted_at, 0.0);
  EXPECT_EQ(points.melting_time[0], melted_at);
  EXPECT_EQ(points.maximum_pressure[0], pressure);
  EXPECT_EQ(points.maximum_temperature[0], temperature);
  EXPECT_LT(points.pressure[0], pressure);
  EXPECT_LT(points.temperature[0], temperature);
}

TEST(Describe, NamesEveryModelAndRefusesUnknownOnes) {
  const auto& strength = strength::catalogue();
  const auto& failure = failure::catalogue();
  for (const auto& entry : strength) EXPECT_THAT(strength.describe(), HasSubstr(entry.name));
  for (const auto& entry : failure) {
    EXPECT_THAT(failure.describe(), HasSubstr(entry.summary));
    EXPECT_THAT(failure.describe(entry.name), AllOf(HasSubstr("required"), HasSubstr("meaning")));
  }
  EXPECT_THAT(strength.describe("johnson_cook"), HasSubstr("Johnson and Cook"));
  EXPECT_THROW(static_cast<void>(strength.describe("johnson")), InputError);
}

// Every code that a point can fail with has its words in the output.
TEST(Describe, NamesEveryCauseOfFailure) {
  EXPECT_EQ(failure::code_meanings(),
            "0 intact; failed by 1 tension, 2 plastic strain, 3 principal stress, 4 principal strain, "
            "5 ductile damage, 6 fragmentation, 7 growth of voids, 8 accumulated tension");
  std::set<int> codes = {failure::intact};
  for (const auto& entry : failure::catalogue()) codes.insert(entry.code);
  EXPECT_EQ(codes.size(), failure::greatest_code() + 1U) << "a code without a criterion";
  EXPECT_LT(failure::greatest_code(), failure::code_count);
}

}  // namespace
}  // namespace whipple
