// SPDX-License-Identifier: BSD-3-Clause
// What a fit takes from the table of an element, and what it does without where the points tell it; where strength and
// failure of its material come from.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>

#include "md_fitting/elements/needs.hpp"
#include "md_fitting/fit/gray_fit.hpp"
#include "md_fitting/fit/material_writer.hpp"
#include "md_fitting/fit/solid_models.hpp"
#include "md_fitting/fit/vapour_fit.hpp"
#include "src/core/base/error.hpp"
#include "tests/unit/fit_support.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace whipple::fit {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using testing::Noise;
using ::testing::Not;
using testing::SyntheticStore;
using testing::true_constants;

Noise silent() {
  Noise noise;
  noise.silent = true;
  return noise;
}

/// Points of an element that the program does not know, and a file with some of its constants.
class FitNeeds : public ::testing::Test {
 protected:
  void SetUp() override {
    add_row("join_volume_ratio", "1.3");
    add_row("debye_temperature", "\"340 K\"");
    settings.electrons = "0.69 mJ/(mol K^2)";
    settings.defaults = file;
  }
  void add_row(const std::string& parameter, const std::string& value) {
    rows += fmt::format("[[element.constant]]\nparameter = \"{}\"\nvalue = {}\nsource = \"test\"\n",
                        parameter, value);
    std::ofstream(file) << "[[element]]\nsymbol = \"Xx\"\nmetal = \"copper\"\n" + rows;
  }
  [[nodiscard]] std::vector<md::PointRecord> points() const {
    std::vector<md::PointRecord> named = store.points;
    for (md::PointRecord& point : named) point.provenance["element"] = "Xx";
    return named;
  }
  void erase(const char* protocol) {
    std::erase_if(store.points, [&](const md::PointRecord& point) { return point.protocol == protocol; });
  }
  static std::string refusal(const std::function<void()>& fit) {
    try {
      fit();
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }

  TemporaryFolder folder;
  std::filesystem::path file = folder.path() / "xx.toml";
  std::string rows;
  FitSettings settings;
  SyntheticStore store{true_constants(), silent(), 11};
};

TEST_F(FitNeeds, AreWhatPointsAndUserDoNotSay) {
  const ElementDefaults none = elements::element_defaults("Xx");
  using Names = std::vector<std::string>;
  EXPECT_EQ(missing_constants(FitModel::gray, none, {}),
            (Names{"electronic_heat_coefficient", "melting_temperature", "join_volume_ratio",
                   "boiling_temperature"}));
  EXPECT_EQ(missing_constants(FitModel::gray, none, {.melting = true, .vapour = true, .electrons = true}),
            Names{"join_volume_ratio"});
  EXPECT_EQ(missing_constants(FitModel::mie_gruneisen, none, {}), Names{});
  EXPECT_EQ(missing_constants(FitModel::debye_gruneisen, none, {}),
            (Names{"electronic_heat_coefficient", "melting_temperature", "debye_temperature"}));
  EXPECT_EQ(missing_constants(FitModel::debye_gruneisen, none,
                              {.melting = true, .vibrations = true, .electrons = true}),
            Names{});
}

TEST_F(FitNeeds, EachMissingConstantHasItsRemedy) {
  const std::string text = elements::missing_text(
      "Xx", {"electronic_heat_coefficient", "melting_temperature", "join_volume_ratio"});
  EXPECT_THAT(text, AllOf(HasSubstr("electronic_heat_coefficient: --electrons"),
                          HasSubstr("melting_temperature: points of [[coexistence]], or a row in --defaults"),
                          HasSubstr("join_volume_ratio: a row in --defaults FILE"),
                          HasSubstr("--model mie_gruneisen")));
}

TEST_F(FitNeeds, CoexistencePointsStandForTheMeltingTemperature) {
  add_row("boiling_temperature", "\"2835 K\"");
  const GrayFit fit = fit_gray(points(), settings, "s");
  EXPECT_NEAR(fit.value("melting_temperature"), true_constants().melting_temperature, 10.0);
  erase("coexistence");
  EXPECT_THAT(refusal([&] { fit_gray(points(), settings, "s"); }),
              HasSubstr("no default of melting_temperature for the element 'Xx'"));
}

TEST_F(FitNeeds, SaturatedDensitiesStandForTheBoilingTemperature) {
  EXPECT_THAT(refusal([&] { fit_gray(points(), settings, "s"); }),
              HasSubstr("no default of boiling_temperature for the element 'Xx'"));
  const auto add = [&](double temperature, double factor) {
    const auto [liquid, vapour] = saturated_densities(true_constants(), temperature);
    store.add("liquid_vapour", {{"temperature", temperature}},
              {{"liquid_density", {factor * liquid, 0.001 * liquid}},
               {"vapour_density", {vapour, 0.001 * vapour}}});
  };
  for (const double temperature : {4500.0, 5000.0, 5500.0}) add(temperature, 1.0);
  const GrayFit fit = fit_gray(points(), settings, "s");
  EXPECT_NEAR(fit.value("vapour_attraction"), true_constants().vapour_attraction, 6.0);
  EXPECT_EQ(fit.constant("vapour_attraction").origin, Origin::fitted);
}

TEST_F(FitNeeds, OtherModelsTakeTheMeltingCurveOfThePoints) {
  const auto remark = HasSubstr("superheated states count as solid");
  EXPECT_THAT(fit_mie_gruneisen(points(), settings, "s").remarks, Not(Contains(remark)));
  SolidConstants solid{true_constants(), 0.0, 135e9, 5.3};
  erase("isotherm");
  for (const double ratio : {1.02, 0.99, 0.96, 0.93, 0.89, 0.86, 0.82, 0.78}) {
    const double v = ratio * solid.gray.reference_specific_volume;
    store.add("isotherm", {{"specific_volume", v}, {"temperature", 293.0}},
              {{"pressure", {isotherm_pressure(solid, v), 2e7}}, {"specific_internal_energy", {0.0, 400.0}}});
  }
  const Fit fit = fit_debye_gruneisen(points(), settings, "s");
  EXPECT_EQ(fit.constant("melting_temperature").origin, Origin::fitted);
  erase("coexistence");
  EXPECT_THAT(fit_mie_gruneisen(points(), settings, "s").remarks, Contains(remark));
  EXPECT_THAT(refusal([&] { fit_debye_gruneisen(points(), settings, "s"); }),
              HasSubstr("no default of melting_temperature for the element 'Xx'"));
}

// Without a melting curve nothing is superheated; with one, states above it are left out.
TEST_F(FitNeeds, SuperheatedStatesAreThoseAboveAKnownCurve) {
  erase("coexistence");
  EXPECT_EQ(fit_mie_gruneisen(points(), settings, "s").superheated_states, 0);
  add_row("melting_temperature", "\"1200 K\"");
  EXPECT_GT(fit_mie_gruneisen(points(), settings, "s").superheated_states, 0);
}

TEST_F(FitNeeds, TheTemplateIsTheOneThatIsNamed) {
  for (const std::string& element : elements::known_elements()) {
    EXPECT_NO_THROW((void)default_template(elements::element_defaults(element))) << element;
  }
  const auto copper = default_template(elements::element_defaults("Cu"));
  ASSERT_TRUE(copper);
  EXPECT_EQ(copper->filename(), "copper.toml");
  EXPECT_FALSE(default_template(elements::element_defaults("Pd")));
  // The name of a metal is a name for people, whatever the library has under it.
  EXPECT_FALSE(default_template(elements::element_defaults("Xx", file)));
  std::ofstream(file) << "[[element]]\nsymbol = \"Cu\"\nmetal = \"my copper\"\n";
  EXPECT_EQ(default_template(elements::element_defaults("Cu", file)), copper);
  std::ofstream(file) << "[[element]]\nsymbol = \"Cu\"\ntemplate = \"none\"\n";
  EXPECT_FALSE(default_template(elements::element_defaults("Cu", file)));
  std::ofstream(file) << "[[element]]\nsymbol = \"Cu\"\ntemplate = \"\"\n";
  EXPECT_THAT(refusal([&] { (void)elements::element_defaults("Cu", file); }), HasSubstr("names no material"));
  std::ofstream(file) << "[[element]]\nsymbol = \"Cu\"\ntemplate = \"coper\"\n";
  EXPECT_THAT(refusal([&] { (void)default_template(elements::element_defaults("Cu", file)); }),
              HasSubstr("no material 'coper.toml' to take strength and failure from"));
  const auto iron = default_template(elements::element_defaults("Fe"));
  ASSERT_TRUE(iron);
  EXPECT_TRUE(has_strength(*copper));
  EXPECT_FALSE(has_strength(*iron));
}

TEST_F(FitNeeds, ATemplateHasWhatItsBaseHas) {
  std::ofstream(folder.path() / "plain.toml")
      << "name = \"p\"\nsource = \"t\"\n[eos]\nmodel = \"gray\"\n[strength]\nmodel = \"von_mises\"\n"
         "shear_modulus = \"48 GPa\"\nyield_stress = \"0.1 GPa\"\n"
         "[[failure]]\nmodel = \"tensile_pressure\"\nspall_strength = \"1 GPa\"\n";
  const auto derived = folder.path() / "derived.toml";
  std::ofstream(derived) << "base = \"plain.toml\"\nname = \"d\"\nsource = \"t\"\n"
                            "[[failure]]\nmodel = \"plastic_strain\"\nfailure_strain = 3.0\n"
                            "[[failure]]\nmodel = \"tensile_pressure\"\nspall_strength = \"2 GPa\"\n";
  EXPECT_TRUE(has_strength(derived));
  const std::string copied = strength_and_failure(derived);
  EXPECT_THAT(copied, AllOf(HasSubstr("[strength]"), HasSubstr("48 GPa"), HasSubstr("plastic_strain"),
                            HasSubstr("2 GPa"), Not(HasSubstr("1 GPa\"\n[[")), Not(HasSubstr("eos"))));
}

}  // namespace
}  // namespace whipple::fit
