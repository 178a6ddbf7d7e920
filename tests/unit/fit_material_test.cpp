// SPDX-License-Identifier: BSD-3-Clause
// What whipple-fit writes: a material file that the solver reads back with the same constants, that says of
// each where it comes from, and that is the same for the same input; and what it refuses, with which words.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "eos/model_equation_of_state.hpp"
#include "eos/models/gray.hpp"
#include "md_fitting/elements/element_defaults.hpp"
#include "md_fitting/fit/constant_list.hpp"
#include "md_fitting/fit/fit_report.hpp"
#include "md_fitting/fit/fit_samples.hpp"
#include "md_fitting/fit/gray_fit.hpp"
#include "md_fitting/fit/material_writer.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/normal_samples.hpp"
#include "src/core/base/units.hpp"
#include "src/material/material_file.hpp"
#include "src/material/material_samples.hpp"
#include "tests/folders.hpp"
#include "tests/unit/fit_support.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace whipple::fit {
namespace {

using ::testing::HasSubstr;
using testing::Noise;
using ::testing::Not;
using testing::SyntheticStore;
using testing::true_constants;

std::string read_text(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

constexpr const char* template_text = R"(name = "template"
source = "test"
[eos]
model = "gray"
molar_mass = "1 g/mol"  # must not be copied
# About the strength.
[strength]
model = "von_mises"
source = "test"
shear_modulus = "47.7 GPa"  # G
yield_stress = "120 MPa"

# First criterion.
[[failure]]
model = "tensile_pressure"
source = "test"
spall_strength = "1.3 GPa"

# Must not be copied.
[provenance]
what = "nothing"
)";

class FitMaterial : public ::testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(folder.path() / "template.toml") << template_text;
    std::filesystem::copy_file(shared().file, file);
  }

  /// Appending rewrites the whole store: it is done once, and copied for each test.
  struct Shared {
    TemporaryFolder folder;
    std::filesystem::path file = folder.path() / "copper.md.h5";
    Shared() {
      const SyntheticStore points(true_constants(), Noise{}, 11);
      for (const md::PointRecord& point : points.points) md::append_point(file, point);
    }
  };
  static const Shared& shared() {
    static const Shared once;
    return once;
  }

  [[nodiscard]] std::string text(const FitSettings& settings = {}) const {
    const std::vector<md::PointRecord> points = md::read_store(file);
    return material_text(fit_gray(points, settings, file.string()), store_origin(file, points),
                         folder.path() / "template.toml");
  }
  [[nodiscard]] int run(const std::string& arguments) const {
    const std::string program = tests::program("whipple-fit"), out = (folder.path() / "output.txt").string();
    const int status = std::system(fmt::format("'{}' {} > '{}' 2>&1", program, arguments, out).c_str());
    return WEXITSTATUS(status);
  }
  [[nodiscard]] std::string output() const { return read_text(folder.path() / "output.txt"); }

  TemporaryFolder folder;
  std::filesystem::path file = folder.path() / "copper.md.h5";
  SyntheticStore store{true_constants(), Noise{}, 11};
};

TEST_F(FitMaterial, ReadsBackThroughTheSolverWithTheSameConstants) {
  const std::vector<md::PointRecord> points = md::read_store(file);
  const GrayFit fit = fit_gray(points, {}, file.string());
  const std::filesystem::path material_file = folder.path() / "copper_fitted.toml";
  write_file(material_file, text(), false);
  const Material material = read_material(material_file);
  const eos::ModelEquationOfState<eos::Gray> expected(fit.gray);
  // Every constant as text, in SI with all digits.
  EXPECT_EQ(material.eos->constants(), expected.constants());
  EXPECT_NE(material.strength, nullptr);
  ASSERT_EQ(material.failure.size(), 1u);
}

TEST_F(FitMaterial, SaysOfEveryConstantWhereItComesFrom) {
  const std::string material = text();
  std::istringstream lines(
      material.substr(material.find("[eos]"), material.find("[strength]") - material.find("[eos]")));
  int fitted = 0;
  int defaults = 0;
  int given = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.find(" = ") == std::string::npos || line.starts_with("model") || line.starts_with("source") ||
        line.starts_with("melting =") || line.starts_with("vapour =")) {
      continue;
    }
    if (line.starts_with("# ")) continue;
    const bool is_fitted = line.find("# fitted: +- ") != std::string::npos;
    const bool is_default = line.find("# default, ") != std::string::npos;
    const bool is_given = line.find("# given: ") != std::string::npos;
    EXPECT_EQ(is_fitted + is_default + is_given, 1) << line;
    fitted += is_fitted;
    defaults += is_default;
    given += is_given;
  }
  EXPECT_EQ(fitted, 8);
  EXPECT_EQ(given, 2);      // molar mass, reference temperature
  EXPECT_EQ(defaults, 11);  // S2 and S3 of the shock curve among them
  EXPECT_THAT(material, HasSubstr("electronic_heat_coefficient = \"\\\"measured\\\": calorimetry"));
  EXPECT_THAT(material, HasSubstr("vapour_attraction = \"\\\"critical\\\""));
  EXPECT_THAT(material, HasSubstr("[covariance]"));
  EXPECT_THAT(material, HasSubstr("[covariance.correlation]\nreference_specific_volume = [1.000, "));
  EXPECT_THAT(material, HasSubstr("store = \"copper.md.h5\""));
  EXPECT_THAT(material, HasSubstr(whipple::sha256_of_file(file)));
  EXPECT_THAT(material, HasSubstr("lammps_version = \"none\""));
  EXPECT_THAT(material, HasSubstr("[provenance.finished_points]\ncoexistence = 4\nhugoniot = 9"));
}

TEST_F(FitMaterial, CopiesStrengthAndFailureVerbatim) {
  EXPECT_EQ(strength_and_failure(folder.path() / "template.toml"), R"(# About the strength.
[strength]
model = "von_mises"
source = "test"
shear_modulus = "47.7 GPa"  # G
yield_stress = "120 MPa"

# First criterion.
[[failure]]
model = "tensile_pressure"
source = "test"
spall_strength = "1.3 GPa"
)");
  EXPECT_THAT(text(), HasSubstr(strength_and_failure(folder.path() / "template.toml")));
}

TEST_F(FitMaterial, SameInputGivesTheSameBytes) { EXPECT_EQ(text(), text()); }

// Nickel's default V_J/V0 = 1.15 ends the liquid before zero pressure at the melting point of a potential
// that melts at a larger volume: the fit takes one near it, and says so.
TEST_F(FitMaterial, TheJoinOfTheVapourGivesWayToTheMelt) {
  eos::GrayConstants nickel = testing::true_constants();
  nickel.molar_mass = 0.05869;
  nickel.reference_specific_volume = 0.11332e-3;
  nickel.hugoniot_intercept = 4444.0;
  nickel.hugoniot_slope = 1.32;
  nickel.gruneisen = 2.03;
  nickel.gruneisen_slope = 2.06;
  nickel.melting_temperature = 2800.0;
  nickel.join_volume_ratio = 1.3;
  testing::SyntheticStore store(nickel, {.silent = true}, 1);
  std::erase_if(store.points, [](const md::PointRecord& point) { return point.protocol == "coexistence"; });
  store.add("coexistence", {{"pressure", 0.0}},
            {{"melting_temperature", {1808.0, 10.0}},
             {"solid_specific_volume", {1.08 * nickel.reference_specific_volume, 0.0}},
             {"latent_heat", {2.7e5, 5e3}}});
  std::vector<md::PointRecord>& points = store.points;
  for (md::PointRecord& point : points) point.provenance["element"] = "Ni";
  FitSettings settings;
  settings.melting = eos::MeltingTransition::band;  // phases in equilibrium end at V_J instead
  const GrayFit fit = fit_gray(points, settings, "store");
  EXPECT_DOUBLE_EQ(fit.value("join_volume_ratio"), 1.2);
  EXPECT_THAT(fit.remarks, Contains(HasSubstr("V_J/V0 raised by 0.05 from the element's default, with which: "
                                              "the model has no liquid at")));
  EXPECT_NEAR(fit.value("melting_temperature"), 2800.0, 0.1 * 2800.0);
}

TEST_F(FitMaterial, DensityReplacesTheFittedVolumeOnly) {
  FitSettings settings;
  const std::vector<md::PointRecord> points = md::read_store(file);
  const GrayFit free = fit_gray(points, settings, "store");
  settings.density = 8944.5;
  const GrayFit fixed = fit_gray(points, settings, "store");
  EXPECT_NEAR(fixed.value("reference_specific_volume") * 8944.5, 1.0, 1e-7);
  EXPECT_EQ(fixed.constant("reference_specific_volume").origin, Origin::given);
  EXPECT_THAT(fixed.constant("reference_specific_volume").source,
              HasSubstr("measured density 8944.5 kg/m^3"));
  EXPECT_DOUBLE_EQ(fixed.fitted_reference_volume, free.fitted_reference_volume);
  for (const char* name : {"hugoniot_intercept", "hugoniot_slope", "gruneisen", "gruneisen_slope",
                           "anharmonic_heat_coefficient", "melting_temperature"}) {
    EXPECT_DOUBLE_EQ(fixed.value(name), free.value(name)) << name;
    EXPECT_DOUBLE_EQ(fixed.constant(name).error, free.constant(name).error) << name;
  }
  EXPECT_EQ(fixed.covariance.rows(), free.covariance.rows() - 1);
}

TEST_F(FitMaterial, ElectronsAreANamedChoice) {
  const std::vector<md::PointRecord> points = md::read_store(file);
  FitSettings settings;
  EXPECT_DOUBLE_EQ(fit_gray(points, settings, "s").value("electronic_heat_coefficient"), 6.9e-4);
  settings.electrons = "liu2013";
  EXPECT_DOUBLE_EQ(fit_gray(points, settings, "s").value("electronic_heat_coefficient"), 4.9e-4);
  settings.electrons = "0.5 mJ/(mol K^2)";
  const GrayFit given = fit_gray(points, settings, "s");
  EXPECT_DOUBLE_EQ(given.value("electronic_heat_coefficient"), 5e-4);
  EXPECT_EQ(given.constant("electronic_heat_coefficient").origin, Origin::given);
  for (const char* wrong : {"mesured", "-1e-4", "3 km", ""}) {
    settings.electrons = wrong;
    EXPECT_THROW(fit_gray(points, settings, "s"), InputError) << wrong;
  }
}

TEST_F(FitMaterial, WithoutCoexistenceTheMeltingTemperatureIsTheNamedDefault) {
  std::erase_if(store.points, [](const md::PointRecord& point) { return point.protocol == "coexistence"; });
  const GrayFit fit = fit_gray(store.points, {}, "store");
  const Constant& melting = fit.constant("melting_temperature");
  EXPECT_EQ(melting.origin, Origin::by_default);
  EXPECT_DOUBLE_EQ(melting.value, 1790.0);
  EXPECT_THAT(melting.source, HasSubstr("Steinberg 1996"));
  EXPECT_EQ(fit.fitted_names.size(), 6u);
  EXPECT_FALSE(fit.isochoric_melting_temperature.has_value());
}

/// The message of the error that a fit of some points must raise.
std::string refusal(const std::vector<md::PointRecord>& points) {
  try {
    fit_gray(points, {}, "cu.md.h5");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST_F(FitMaterial, NamesAllMissingProtocolsAtOnce) {
  EXPECT_THAT(refusal({}), HasSubstr("cu.md.h5: no finished points"));
  std::vector<md::PointRecord> points = store.points;
  std::erase_if(points, [](const md::PointRecord& point) {
    return point.protocol == "hugoniot" || point.protocol == "zero_pressure_volume";
  });
  md::PointRecord failed = store.points.back();
  failed.protocol = "hugoniot";
  failed.status = md::PointStatus::failed;
  points.push_back(failed);
  const std::string message = refusal(points);
  EXPECT_THAT(message, HasSubstr("protocol \"zero_pressure_volume\": 0 finished"));
  EXPECT_THAT(message, HasSubstr("the fit needs one at 293 K"));
  EXPECT_THAT(
      message,
      HasSubstr("protocol \"hugoniot\": 0 finished, 0 of them with a particle velocity of 0.3 ... 2.5 "
                "km/s, the fit needs 3 there (1 failed)"));
  EXPECT_THAT(message, Not(HasSubstr("isochore")));
}

TEST_F(FitMaterial, RefusesPointsOfTwoPotentials) {
  store.points.back().provenance["potential"] = "another";
  EXPECT_THAT(refusal(store.points), HasSubstr("different values of 'potential' (another, synthetic)"));
}

TEST_F(FitMaterial, UnknownElementNamesTheKnownOnes) {
  for (md::PointRecord& point : store.points) point.provenance["element"] = "Xx";
  EXPECT_THAT(refusal(store.points), HasSubstr("for the element 'Xx': electronic_heat_coefficient: --"));
}

TEST_F(FitMaterial, TableHoldsThePublishedRows) {
  const std::vector<NamedFit> fits = {{"mine", fit_gray(store.points, {}, "s")}};
  const std::string table = constants_table(fits);
  EXPECT_THAT(table, HasSubstr("mine"));
  EXPECT_THAT(table, HasSubstr("Liu, Wang & Zhang, Int. J. Mech. Mater. Des. 9 (2013) 127"));
  for (const char* figure :
       {"0.11180", "3.940", "1.489", "1790", "0.11190", "3.980", "1.301", "8.30", "2006"}) {
    EXPECT_THAT(table, HasSubstr(figure));
  }
}

TEST_F(FitMaterial, ElementsStandSideBySideEachWithItsPublishedRows) {
  const Fit copper = fit_gray(store.points, {}, "s");
  for (md::PointRecord& point : store.points) point.provenance["element"] = "Ta";
  const std::string table =
      constants_table(std::vector<NamedFit>{{"one", copper}, {"two", fit_gray(store.points, {}, "s")}});
  EXPECT_THAT(table, HasSubstr("Liu, Wang & Zhang, Int. J. Mech. Mater. Des. 9 (2013) 127"));
  EXPECT_THAT(table, HasSubstr("Steinberg, UCRL-MA-106439 (1996)"));
  for (const char* figure : {"one", "two", "0.11180", "0.05992"}) EXPECT_THAT(table, HasSubstr(figure));
}

// The defaults' table says what the documents say: units and values of the public constants.
TEST(ElementDefaults, CopperHoldsThePublishedConstants) {
  const ElementDefaults copper = elements::element_defaults("Cu");
  for (const NamedDefault& entry : copper.constants) {
    EXPECT_FALSE(entry.source.empty()) << entry.parameter;
    if (entry.parameter == "vapour_attraction") {
      EXPECT_NEAR(entry.value, units::convert(0.62, "kJ cm^3/g^2", "J m^3/kg^2"), 1e-9);
    }
  }
  EXPECT_EQ(copper.at("electronic_heat_coefficient").name, "measured");
}

// Every metal of the program has what GRAY needs, each number with its source; another one has it from a file.
TEST_F(FitMaterial, MetalsHaveTheirConstantsFromTheProgramOrAFile) {
  for (const char* metal :
       {"Ag", "Al", "Au", "Cr", "Cu", "Fe", "Ir", "Mo", "Nb", "Ni", "Pb", "Pd", "Pt", "Rh", "Ta", "V", "W"}) {
    const ElementDefaults table = elements::element_defaults(metal);
    EXPECT_TRUE(missing_constants(FitModel::gray, table, {}).empty()) << metal;
    for (const NamedDefault& entry : table.constants)
      EXPECT_GT(entry.source.size(), 10U) << metal << entry.parameter;
    const double melting = table.at("melting_point").value;
    EXPECT_GT(table.at("melting_temperature").value, melting) << metal;
    if (const NamedDefault* boiling = table.find("boiling_temperature")) {
      EXPECT_GT(boiling->value, melting) << metal;
    }
  }
  const auto strontium = folder.path() / "sr.toml";
  std::ofstream(strontium)
      << "[[source]]\nname = \"crc\"\ntext = \"CRC Handbook\"\n"
         "[[element]]\nsymbol = \"Sr\"\nmetal = \"strontium\"\n"
         "[[element.constant]]\nparameter = \"melting_temperature\"\nvalue = \"1365 K\"\n"
         "source = \"1.3 times the melting point\"\n"
         "[[element.constant]]\nparameter = \"electronic_heat_coefficient\"\n"
         "value = \"3.6 mJ/(mol K^2)\"\nclass = \"measured\"\nsource = \"crc\"\n";
  EXPECT_EQ(missing_constants(FitModel::gray, elements::element_defaults("Sr"), {}).size(), 4U);
  const ElementDefaults given = elements::element_defaults("Sr", strontium);
  EXPECT_EQ(missing_constants(FitModel::gray, given, {}),
            (std::vector<std::string>{"join_volume_ratio", "boiling_temperature"}));
  EXPECT_EQ(given.metal, "strontium");
  EXPECT_NEAR(given.at("electronic_heat_coefficient").value, 3.6e-3, 1e-12);
  EXPECT_EQ(given.at("electronic_heat_coefficient").source, "CRC Handbook");
  EXPECT_EQ(given.at("electronic_heat_coefficient").evidence, Evidence::measured);
  EXPECT_THROW((void)given.at("boiling_temperature"), InputError);
  std::ofstream(strontium, std::ios::app) << "colour = \"grey\"\n";
  EXPECT_THROW(elements::element_defaults("Sr", strontium), InputError);
}

TEST_F(FitMaterial, ExecutableWritesRefusesAndOverwrites) {
  const std::filesystem::path target = folder.path() / "new" / "copper.toml";
  const std::string basic =
      fmt::format("'{}' --template '{}'", file.string(), (folder.path() / "template.toml").string());
  EXPECT_EQ(run(fmt::format("{} -o '{}'", basic, target.string())), 0) << output();
  EXPECT_THAT(output(), HasSubstr("written: " + target.string()));
  EXPECT_EQ(read_text(target), text());
  EXPECT_EQ(run(fmt::format("{} -o '{}'", basic, target.string())), 2);
  EXPECT_THAT(output(), HasSubstr("exists; --force overwrites it"));
  EXPECT_EQ(run(fmt::format("{} -o '{}' --force", basic, target.string())), 0) << output();
  EXPECT_EQ(run(basic), 0);
  EXPECT_THAT(output(), HasSubstr("no material written"));
}

TEST_F(FitMaterial, ExecutableDrawsTheFigure) {
  const std::filesystem::path figure = folder.path() / "fit.png";
  ASSERT_EQ(run(fmt::format("'{}' -q --plot '{}'", file.string(), figure.string())), 0) << output();
  EXPECT_EQ(read_text(figure).substr(1, 3), "PNG");
  for (const auto& file : std::filesystem::directory_iterator(figure.parent_path())) {
    EXPECT_NE(file.path().extension(), ".partial") << file.path();
  }
  EXPECT_EQ(run(fmt::format("'{}' -q --plot '{}'", file.string(), figure.string())), 2);
  EXPECT_THAT(output(), HasSubstr("--force overwrites it"));
}

TEST_F(FitMaterial, ExecutableReportsWrongInput) {
  EXPECT_EQ(run("missing.md.h5"), 2);
  EXPECT_THAT(output(), HasSubstr("missing.md.h5"));
  EXPECT_EQ(run(fmt::format("'{}' --density '3 m/s'", file.string())), 2);
  EXPECT_THAT(output(), HasSubstr("--density: unit 'm/s' has the wrong dimension"));
  EXPECT_EQ(run(fmt::format("'{}' --up-range '2 km/s' '1 km/s'", file.string())), 2);
  EXPECT_THAT(output(), HasSubstr("expected two rising velocities"));
  EXPECT_EQ(run(fmt::format("'{}' --model jwl", file.string())), 2);
  EXPECT_EQ(run(fmt::format("'{0}' '{0}' -o one.toml", file.string())), 2);
  EXPECT_THAT(output(), HasSubstr("2 stores and 1 outputs"));
}

// Draws have the mean and the covariance that they were asked for, also where variables differ by powers of
// ten.
TEST(NormalSamples, HaveTheirCovariance) {
  const Eigen::Vector3d mean(1e-4, 4000.0, 1.5);
  const Eigen::Vector3d sigma(2e-8, 15.0, 0.0);  // the last one is known exactly
  Eigen::Matrix3d correlation = Eigen::Matrix3d::Identity();
  correlation(0, 1) = correlation(1, 0) = -0.8;
  const Eigen::Matrix3d covariance = sigma.asDiagonal() * correlation * sigma.asDiagonal();
  NormalSamples samples(mean, covariance, 5);
  constexpr int draws = 4000;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (int i = 0; i < draws; ++i) {
    const Eigen::Vector3d x = samples.draw();
    EXPECT_EQ(x[2], 1.5);
    const Eigen::Vector3d pull((x[0] - mean[0]) / sigma[0], (x[1] - mean[1]) / sigma[1], 0.0);
    sum += pull / draws;
    squares += pull * pull.transpose() / draws;
  }
  EXPECT_LT(sum.norm(), 4.0 * std::sqrt(2.0 / draws));
  EXPECT_NEAR(squares(0, 0), 1.0, 4.0 * std::sqrt(2.0 / draws));
  EXPECT_NEAR(squares(1, 1), 1.0, 4.0 * std::sqrt(2.0 / draws));
  EXPECT_NEAR(squares(0, 1), -0.8, 4.0 * std::sqrt(1.64 / draws));
  EXPECT_EQ(NormalSamples(mean, covariance, 5).draw(), NormalSamples(mean, covariance, 5).draw());
  Eigen::Matrix3d wrong = Eigen::Matrix3d::Identity();
  wrong(0, 1) = wrong(1, 0) = 2.0;  // a correlation of 2
  EXPECT_THROW(NormalSamples(mean, wrong, 1), InputError);
  wrong(0, 1) = 0.0;
  EXPECT_THROW(NormalSamples(mean, wrong, 1), InputError);  // not symmetric
  EXPECT_THROW(NormalSamples(mean, Eigen::Matrix2d::Identity(), 1), InputError);
}

// The ensemble of the fit and that of its material file have the stated errors, and their files read back.
TEST_F(FitMaterial, SamplesScatterByTheStatedErrors) {
  const std::vector<md::PointRecord> points = md::read_store(file);
  const GrayFit fit = fit_gray(points, {}, file.string());
  const FitSamples samples = sample_fit(fit, 200, 1);
  ASSERT_EQ(samples.fits.size(), 200u);
  for (const std::string& name : fit.fitted_names) {
    double mean = 0.0, squares = 0.0;
    for (const Fit& sample : samples.fits) {
      const double pull = (sample.value(name) - fit.value(name)) / fit.constant(name).error;
      mean += pull / 200.0;
      squares += pull * pull / 200.0;
    }
    EXPECT_NEAR(mean, 0.0, 4.0 / std::sqrt(200.0)) << name;
    EXPECT_NEAR(squares, 1.0, 4.0 * std::sqrt(2.0 / 200.0)) << name;
  }
  EXPECT_EQ(samples.fits[0].constant("gruneisen").source.substr(0, 15), "sample 1 of 200");
  const std::filesystem::path material_file = folder.path() / "fitted.toml";
  write_file(material_file, text(), false);
  const MaterialSamples materials = sample_material(material_file, 20, 1);
  ASSERT_EQ(materials.materials.size(), 20u);
  EXPECT_EQ(materials.names, fit.fitted_names);
  // The same distribution and the same seed: the first materials are the same but for the digits of a file.
  const double rho0 = materials.materials[0].eos->reference_density();
  EXPECT_NEAR(rho0 * samples.fits[0].value("reference_specific_volume"), 1.0, 1e-6);
  EXPECT_NE(materials.materials[1].eos->reference_density(), rho0);
  EXPECT_THROW(sample_material(folder.path() / "template.toml", 2, 1), InputError);  // no covariance
}

TEST_F(FitMaterial, ExecutableWritesAnEnsemble) {
  const std::filesystem::path target = folder.path() / "cu.toml";
  ASSERT_EQ(run(fmt::format("'{}' -q --template '{}' -o '{}' --samples 12 --bootstrap 5", file.string(),
                            (folder.path() / "template.toml").string(), target.string())),
            0)
      << output();
  EXPECT_THAT(output(), HasSubstr("written: 12 samples in " + (folder.path() / "cu_samples").string()));
  EXPECT_THAT(read_text(target), HasSubstr("bootstrap_replicates = 5"));
  const std::string sample = read_text(folder.path() / "cu_samples" / "cu_07.toml");
  EXPECT_THAT(sample, HasSubstr("# given: sample 7 of 12 from the covariance of the fit, seed 1"));
  EXPECT_THAT(sample, Not(HasSubstr("[covariance]")));
  EXPECT_NO_THROW(read_material(folder.path() / "cu_samples" / "cu_12.toml"));
  EXPECT_EQ(run(fmt::format("'{}' --samples 3", file.string())), 2);
  EXPECT_THAT(output(), HasSubstr("--samples: name the material with -o"));
}

TEST_F(FitMaterial, ExecutableFitsOtherModels) {
  const std::filesystem::path target = folder.path() / "mg.toml";
  ASSERT_EQ(run(fmt::format("'{}' --model mie_gruneisen --template '{}' -o '{}'", file.string(),
                            (folder.path() / "template.toml").string(), target.string())),
            0)
      << output();
  const Material material = read_material(target);
  EXPECT_EQ(material.eos->model(), "mie_gruneisen");
  EXPECT_THAT(read_text(target), HasSubstr("gruneisen_law = \"linear\""));
  EXPECT_EQ(run(fmt::format("'{}' --model debye_gruneisen", file.string())), 2);
  EXPECT_THAT(output(), HasSubstr("protocol \"isotherm\""));  // three states are too few
}

TEST_F(FitMaterial, SeveralStoresAreWrittenIntoAFolder) {
  const std::filesystem::path second = folder.path() / "second.md.h5";
  std::filesystem::copy_file(file, second);
  const std::string materials = (folder.path() / "materials").string() + "/";
  EXPECT_EQ(run(fmt::format("'{}' '{}' -q --template '{}' -o '{}'", file.string(), second.string(),
                            (folder.path() / "template.toml").string(), materials)),
            0)
      << output();
  EXPECT_TRUE(std::filesystem::exists(materials + "copper.toml"));
  EXPECT_TRUE(std::filesystem::exists(materials + "second.toml"));
  EXPECT_THAT(output(), HasSubstr("\ncopper  "));
  EXPECT_THAT(output(), HasSubstr("\nsecond  "));
  // Two stores of one potential say nothing of a scatter over potentials.
  EXPECT_THAT(output(), Not(HasSubstr("second tier")));
  EXPECT_THAT(read_text(materials + "copper.toml"), Not(HasSubstr("[potential_spread]")));
}

}  // namespace
}  // namespace whipple::fit
