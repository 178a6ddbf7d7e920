// SPDX-License-Identifier: BSD-3-Clause
// Cards of other programs, read back from their text: the pressures of the laws of these programs are the material's.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/decks/dyna_deck.hpp"
#include "src/decks/eos_card.hpp"
#include "src/material/material_file.hpp"
#include "tests/folders.hpp"

namespace whipple::decks {
namespace {

using ::testing::HasSubstr;

Material library(const std::string& name) {
  return read_material(whipple::tests::source_folder() + "/eos/materials/" + name + ".toml");
}

std::string card_of(const Material& material, CardFormat format, const std::string& units) {
  return eos_card(material.name, *material.eos, format, parse_unit_system(units).value(), 7);
}

/// The numbers of a card of LS-DYNA, by the reader of its decks.
std::vector<double> dyna_numbers(const std::string& card, const std::string& keyword) {
  const dyna::Deck deck = dyna::parse("card.k", "*KEYWORD\n" + card + "*END\n");
  std::vector<double> numbers;
  for (const dyna::Block& block : deck.blocks) {
    if (block.keyword != keyword) continue;
    for (const dyna::Card& line : block.cards) {
      const dyna::Fields fields(deck, block, line);
      for (std::size_t i = 0; i < fields.size(); ++i) numbers.push_back(fields.real(i));
    }
  }
  return numbers;
}

/// The numbers of the lines below /EOS/GRUNEISEN and its title, in fields of twenty columns.
std::vector<double> radioss_numbers(const std::string& card) {
  std::istringstream lines(card.substr(card.find("/EOS/GRUNEISEN/7\n")));
  std::string line;
  std::getline(lines, line);
  std::getline(lines, line);
  std::vector<double> numbers;
  while (std::getline(lines, line)) {
    if (line.front() == '#') continue;
    for (std::size_t at = 0; at < line.size(); at += 20) numbers.push_back(std::stod(line.substr(at, 20)));
  }
  return numbers;
}

/// Pressure of *EOS_GRUNEISEN and of /EOS/GRUNEISEN, E per initial volume.
double gruneisen(double c, double s1, double s2, double s3, double gamma0, double a, double rho0, double mu,
                 double energy) {
  const double thermal = (gamma0 + a * mu) * energy;
  if (mu < 0) return rho0 * c * c * mu + thermal;
  const double below =
      1 - (s1 - 1) * mu - s2 * mu * mu / (mu + 1) - s3 * mu * mu * mu / ((mu + 1) * (mu + 1));
  return rho0 * c * c * mu * (1 + (1 - 0.5 * gamma0) * mu - 0.5 * a * mu * mu) / (below * below) + thermal;
}

TEST(EosCard, GruneisenHasThePressuresOfTheMaterial) {
  for (const char* name : {"copper_ofhc_mie_gruneisen", "lead_steinberg_mie_gruneisen", "lead_mie_gruneisen",
                           "steel_304_mie_gruneisen"}) {
    SCOPED_TRACE(name);
    const Material material = library(name);
    const double rho0 = material.eos->reference_density(), gpa = 1e9;
    // GPa, mm/ms = m/s and kg/mm^3; cm, g and us: Mbar, cm/us and g/cm^3.
    const std::vector<double> k =
        dyna_numbers(card_of(material, CardFormat::ls_dyna, "mm ms kg"), "EOS_GRUNEISEN");
    ASSERT_GE(k.size(), 9u);
    EXPECT_EQ(k[0], 7);
    EXPECT_EQ(k[7], 0);
    EXPECT_EQ(k[8], 1);
    const std::vector<double> r = radioss_numbers(card_of(material, CardFormat::openradioss, "cm us g"));
    ASSERT_EQ(r.size(), 8u);
    EXPECT_NEAR(r[7], 1e-3 * rho0, 1e-9 * rho0);
    for (const double mu : {-0.02, 0.01, 0.1, 0.3, 0.5}) {
      for (const double heat :
           {0.0, 2e5, 2e6}) {  // J/kg above the cold curve; expanded: the remark of the card
        const double energy = mu < 0 ? 0.0 : material.eos->minimum_energy(rho0 * (1 + mu)) + heat;
        const double p = material.eos->state(rho0 * (1 + mu), energy).pressure;
        const double dyna =
            gruneisen(k[1], k[2], k[3], k[4], k[5], k[6], 1e-9 * rho0, mu, rho0 * energy / gpa);
        EXPECT_NEAR(dyna, p / gpa, 1e-6 * std::abs(p) / gpa) << mu << " " << energy;
        const double radioss =
            gruneisen(r[0], r[1], r[2], r[3], r[4], r[5], r[7], mu, rho0 * energy / (100 * gpa));
        EXPECT_NEAR(radioss, p / (100 * gpa), 1e-6 * std::abs(p) / (100 * gpa)) << mu << " " << energy;
      }
    }
  }
}

TEST(EosCard, JwlHasThePressuresOfTheProducts) {
  const Material tnt = library("tnt");
  const std::vector<double> k = dyna_numbers(card_of(tnt, CardFormat::ls_dyna, "cm us g"), "EOS_JWL");
  ASSERT_EQ(k.size(), 8u);
  const double rho0 = tnt.eos->reference_density(), mbar = 1e11;
  for (const double v : {0.7, 1.0, 2.0, 8.0}) {
    const double energy = k[6];  // per initial volume
    const double p = k[1] * (1 - k[5] / (k[3] * v)) * std::exp(-k[3] * v) +
                     k[2] * (1 - k[5] / (k[4] * v)) * std::exp(-k[4] * v) + k[5] * energy / v;
    const double own = tnt.eos->state(rho0 / v, energy * mbar / rho0).pressure / mbar;
    EXPECT_NEAR(p, own, 1e-6 * own) << v;
  }
}

TEST(EosCard, NamesUnitsDensityAndWhatDiffers) {
  const Material copper = library("copper_ofhc_mie_gruneisen");
  const std::string card = card_of(copper, CardFormat::ls_dyna, "mm ms kg");
  EXPECT_THAT(card, HasSubstr("$ units: mm, kg, ms; pressure and energy per initial volume GPa"));
  EXPECT_THAT(card, HasSubstr("$ reference density 8.93e-06 kg/mm^3"));
  EXPECT_THAT(card, HasSubstr("expanded ones have"));
  EXPECT_THROW(card_of(library("copper"), CardFormat::ls_dyna, "mm ms kg"), InputError);
  EXPECT_THROW(card_of(library("tnt"), CardFormat::openradioss, "mm ms kg"), InputError);
}

}  // namespace
}  // namespace whipple::decks
