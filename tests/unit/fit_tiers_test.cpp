// SPDX-License-Identifier: BSD-3-Clause
// Tiers of the errors of a fitted material: what its file says of them, and what samples are drawn from.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "md_fitting/fit/fit_report.hpp"
#include "md_fitting/fit/fit_samples.hpp"
#include "md_fitting/fit/gray_fit.hpp"
#include "md_fitting/fit/material_writer.hpp"
#include "src/core/base/error.hpp"
#include "src/material/material_samples.hpp"
#include "tests/unit/fit_support.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace whipple::fit {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using testing::Noise;
using ::testing::Not;
using testing::SyntheticStore;
using testing::true_constants;

/// Two "potentials" of copper without coexistence: T_m0 is the default with its error.
class FitTiers : public ::testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(folder.path() / "template.toml")
        << "name = \"t\"\nsource = \"t\"\n[eos]\nmodel = \"gray\"\n[strength]\nmodel = \"von_mises\"\nsource "
           "= "
           "\"t\"\nshear_modulus = \"48 GPa\"\nyield_stress = \"0.1 GPa\"\n";
    eos::GrayConstants other = true_constants();
    other.hugoniot_intercept = 3700.0;
    other.gruneisen = 2.1;
    first = fitted(true_constants());
    second = fitted(other);
    spread = potential_spread(std::vector<const Fit*>{&first, &second});
  }
  static GrayFit fitted(const eos::GrayConstants& constants) {
    SyntheticStore store(constants, Noise{}, 11);
    std::erase_if(store.points, [](const md::PointRecord& point) { return point.protocol == "coexistence"; });
    return fit_gray(store.points, {}, "store");
  }
  [[nodiscard]] std::string text(bool with_spread) const {
    return material_text(first, StoreOrigin{"store", "0", {}, {}, {}}, folder.path() / "template.toml",
                         with_spread ? spread : std::nullopt);
  }
  [[nodiscard]] std::filesystem::path file(bool with_spread) const {
    const std::filesystem::path path = folder.path() / (with_spread ? "both.toml" : "one.toml");
    write_file(path, text(with_spread), true);
    return path;
  }
  [[nodiscard]] FitSamples samples(ErrorTier tier) const { return sample_fit(first, count, 3, tier, spread); }
  /// Standard deviation of a constant over samples of the fit.
  [[nodiscard]] double scatter(const char* name, const FitSamples& samples) const {
    double mean = 0.0, squares = 0.0;
    for (const Fit& sample : samples.fits) {
      mean += sample.value(name) / count;
      squares += std::pow(sample.value(name) - first.value(name), 2) / count;
    }
    EXPECT_NEAR(mean, first.value(name), 0.25 * std::sqrt(squares) + 1e-12 * std::abs(first.value(name)))
        << name;
    return std::sqrt(squares);
  }

  static constexpr int count = 150;
  TemporaryFolder folder;
  GrayFit first, second;
  std::optional<PotentialSpread> spread;
};

constexpr double tolerance = 4.0 / 17.3;  // of a standard deviation from 150 numbers

TEST_F(FitTiers, SamplesScatterByTheirTier) {
  const Constant& c = first.constant("hugoniot_intercept");
  const double potentials = std::sqrt(spread->covariance(1, 1));
  ASSERT_EQ(spread->names[1], "hugoniot_intercept");
  EXPECT_NEAR(potentials, 170.0 / std::sqrt(2.0), 20.0);
  const FitSamples noise = samples(ErrorTier::noise), fit = samples(ErrorTier::fit);
  const FitSamples scattered = samples(ErrorTier::potentials), all = samples(ErrorTier::all);
  EXPECT_NEAR(scatter("hugoniot_intercept", noise), c.statistical_error, tolerance * c.statistical_error);
  EXPECT_NEAR(scatter("hugoniot_intercept", fit), c.error, tolerance * c.error);
  EXPECT_NEAR(scatter("hugoniot_intercept", scattered), potentials, tolerance * potentials);
  const double both = std::hypot(potentials, c.error);
  EXPECT_NEAR(scatter("hugoniot_intercept", all), both, tolerance * both);
  // The default with a known error belongs to the fit's tier, and to no other.
  EXPECT_EQ(first.constant("melting_temperature").error, 38.0);
  EXPECT_NEAR(scatter("melting_temperature", fit), 38.0, tolerance * 38.0);
  EXPECT_EQ(scatter("melting_temperature", noise), 0.0);
  EXPECT_EQ(scatter("melting_temperature", scattered), 0.0);
  EXPECT_EQ(scatter("melting_entropy", all), 0.0);  // no error known
}

// The file holds the same distributions, and names what is drawn and what is not.
TEST_F(FitTiers, MaterialFilesHoldTheTiers) {
  const MaterialSamples fit = sample_material(file(true), 3, 1);
  EXPECT_THAT(fit.names, Contains("melting_temperature"));
  EXPECT_EQ(fit.defaults, std::vector<std::string>{"melting_temperature"});
  EXPECT_THAT(fit.unknown, Contains("melting_entropy"));
  EXPECT_THAT(fit.unknown, Not(Contains("melting_temperature")));
  const MaterialSamples potentials = sample_material(file(true), 3, 1, ErrorTier::potentials);
  EXPECT_EQ(potentials.names, spread->names);
  const MaterialSamples noise = sample_material(file(true), 3, 1, ErrorTier::noise);
  EXPECT_EQ(noise.names, first.fitted_names);
  // A file may take its other tables from a base.
  const std::filesystem::path child = folder.path() / "child.toml";
  write_file(child, "base = \"template\"\n" + text(false), true);
  EXPECT_EQ(sample_material(child, 3, 1, ErrorTier::noise).changes, noise.changes);
  // The same draw as that of the fit itself, from the digits of the file.
  const FitSamples own = sample_fit(first, 3, 1, ErrorTier::noise);
  EXPECT_NEAR(noise.materials[1].eos->reference_density() * own.fits[1].value("reference_specific_volume"),
              1.0, 1e-7);
  EXPECT_THROW(sample_material(file(false), 3, 1, ErrorTier::all), InputError);
  EXPECT_THROW(sample_fit(first, 3, 1, ErrorTier::potentials), InputError);
  try {
    sample_material(file(false), 3, 1, ErrorTier::potentials);
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no table [potential_spread]: fit the stores of several potentials"));
  }
}

// What belongs to the material and not to its errors stays in the file: whoever adds a conductivity draws as before.
TEST_F(FitTiers, OtherTablesOfTheMaterialAreLeftAlone) {
  const std::filesystem::path path = folder.path() / "thermal.toml";
  write_file(path, text(true) + "\n[thermal]\nsource = \"t\"\nconductivity = \"401 W/(m K)\"\n", true);
  const MaterialSamples samples = sample_material(path, 2, 1);
  EXPECT_EQ(samples.materials[1].conductivity, 401.0);
  EXPECT_EQ(samples.materials[1].eos->reference_density(),
            sample_material(file(true), 2, 1).materials[1].eos->reference_density());
}

TEST_F(FitTiers, BrokenTablesAreRefused) {
  const auto refused = [&](const std::string& from, const std::string& to) {
    std::string broken = text(true);
    const std::size_t place = broken.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    broken.replace(place, from.size(), to);
    const std::filesystem::path path = folder.path() / "broken.toml";
    write_file(path, broken, true);
    EXPECT_THROW(sample_material(path, 2, 1), InputError) << to;
  };
  refused("errors = [3.8000e+01]", "errors = []");
  refused("errors = [3.8000e+01]", "errors = [1.0, 2.0]");
  refused("[covariance.matrix]", "[covariance.other]");
}

// Value, error and source of every constant, before all else.
TEST_F(FitTiers, FirstTableNamesTheSources) {
  const std::string table = sources_table(first);
  EXPECT_THAT(table, ::testing::ContainsRegex("constant +value +error +source\n"));
  EXPECT_THAT(table, ::testing::ContainsRegex("hugoniot_intercept +3\\.[0-9]+ km/s +[0-9.]+ km/s +MD\n"));
  EXPECT_THAT(table, ::testing::ContainsRegex("melting_temperature +1790 K +38 K +default\n"));
  EXPECT_THAT(table,
              ::testing::ContainsRegex("melting_entropy +9\\.637 J/\\(mol K\\) +no error known +default\n"));
  EXPECT_THAT(table,
              ::testing::ContainsRegex("electronic_heat_coefficient +0\\.69 mJ.* measured \\(default\\)\n"));
  EXPECT_THAT(table, ::testing::ContainsRegex("molar_mass +[0-9.]+ g/mol +- +given\n"));
  EXPECT_TRUE(text(false).starts_with("# constant"));
  SyntheticStore store(true_constants(), Noise{}, 11);
  FitSettings settings;
  settings.density = 8944.5;
  EXPECT_THAT(sources_table(fit_gray(store.points, settings, "s")),
              ::testing::ContainsRegex("reference_specific_volume .* - +measured\n"));
}

}  // namespace
}  // namespace whipple::fit
