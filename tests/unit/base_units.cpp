// SPDX-License-Identifier: BSD-3-Clause
// Quantities at the border of the program: every spelling that users write, and refusal of the wrong ones.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/base/units.hpp"

namespace whipple::units {
namespace {

struct Spelling {
  std::string text;
  std::string si_unit;
  double value;
};

void PrintTo(const Spelling& spelling, std::ostream* out) { *out << '"' << spelling.text << '"'; }

class Accepted : public ::testing::TestWithParam<Spelling> {};

// Expected values follow from the definitions of the units (SI brochure, 9th edition), not from this program.
TEST_P(Accepted, HasTheDefinedValue) {
  const Spelling& spelling = GetParam();
  const double value = parse_quantity(spelling.text, spelling.si_unit);
  EXPECT_NEAR(value, spelling.value, 4e-15 * std::abs(spelling.value)) << spelling.text;
}

INSTANTIATE_TEST_SUITE_P(
    Units, Accepted,
    ::testing::Values(
        Spelling{"6.58 km/s", "m/s", 6580.0}, Spelling{"0.394 cm/us", "m/s", 3940.0},
        Spelling{"1 mm/us", "m/s", 1000.0}, Spelling{"8.93 g/cc", "kg/m^3", 8930.0},
        Spelling{"8.93 g/cm^3", "kg/m^3", 8930.0}, Spelling{"8.93 g/cm3", "kg/m^3", 8930.0},
        Spelling{"0.1118 cm^3/g", "m^3/kg", 1.118e-4}, Spelling{"0.1118 cc/g", "m^3/kg", 1.118e-4},
        Spelling{"0.05 Mbar cm3/g", "J/kg", 5e6}, Spelling{"6.9e-7 kJ/(mole K2)", "J/(mol K^2)", 6.9e-4},
        Spelling{"140 GPa", "Pa", 140e9}, Spelling{"2.1 kbar", "Pa", 210e6},
        Spelling{"3.615 angstrom", "m", 3.615e-10}, Spelling{"2.5 ps", "s", 2.5e-12},
        Spelling{"20 us", "s", 20e-6}, Spelling{"10 min", "s", 600.0}, Spelling{"25 degC", "K", 298.15},
        Spelling{"300 K", "K", 300.0}, Spelling{"1 eV", "J", 1.602176634e-19},
        Spelling{"3 meV", "J", 3 * 1.602176634e-22}, Spelling{"2 eV/K", "J/K", 3.204353268e-19},
        Spelling{"63.546 g/mol", "kg/mol", 0.063546}, Spelling{"180 deg", "rad", std::numbers::pi},
        Spelling{"25 %", "", 0.25}, Spelling{"0.25", "", 0.25}, Spelling{"1.2 MJ/kg", "J/kg", 1.2e6},
        Spelling{"383 J/(kg K)", "J/(kg K)", 383.0}, Spelling{"5 m s-1", "m/s", 5.0},
        Spelling{"5 m.s^-1", "m/s", 5.0}, Spelling{"+1.5 m", "m", 1.5}, Spelling{"-1.5 mm", "m", -1.5e-3},
        Spelling{"  1.5 m  ", "m", 1.5}, Spelling{"1.5m", "m", 1.5}, Spelling{"1e3 m", "m", 1e3},
        Spelling{"42", "", 42.0}, Spelling{"0", "m/s", 0.0}));

TEST(Units, ElectronVoltIsTheExactSiValue) {
  EXPECT_DOUBLE_EQ(convert(1.0, "eV", "J"), 1.602176634e-19);
  EXPECT_DOUBLE_EQ(convert(1.0, "eV/angstrom^3", "Pa"), 1.602176634e11);
}

// The number in memory is the one nearest to what was written, as if it had been written in SI.
TEST(Units, DecimalFractionsRoundOnce) {
  EXPECT_EQ(parse_quantity("2.03 g", "kg"), 0.00203);
  EXPECT_EQ(parse_quantity("40 um", "m"), 40e-6);
  EXPECT_EQ(parse_quantity("3.615 angstrom", "m"), 3.615e-10);
  EXPECT_EQ(parse_quantity("0.1118 cm^3/g", "m^3/kg"), 0.1118e-3);
  EXPECT_EQ(parse_quantity("20 us", "s"), 20e-6);
  EXPECT_EQ(parse_quantity("-8.93e0 g/cm^3", "kg/m^3"), -8930.0);
  EXPECT_EQ(parse_quantity("1.4E+2 GPa", "Pa"), 140e9);
}

TEST(Units, CelsiusCarriesItsOffsetAndOtherUnitsCarryNone) {
  const Conversion celsius = conversion("degC", "K");
  EXPECT_DOUBLE_EQ(celsius.factor, 1.0);
  EXPECT_DOUBLE_EQ(celsius.offset, 273.15);
  EXPECT_EQ(conversion("km/s", "m/s").offset, 0.0);
}

std::string message_of(const std::string& text, const std::string& si_unit) {
  try {
    parse_quantity(text, si_unit);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Units, WrongDimensionNamesBothUnits) {
  EXPECT_EQ(message_of("3 GPa", "m/s"),
            "unit 'GPa' has the wrong dimension: expected a unit of the kind 'm/s'");
  EXPECT_EQ(message_of("3 GPa", ""),
            "unit 'GPa' has the wrong dimension: expected a unit of the kind '1 (no unit)'");
}

// UDUNITS2 converts between a unit and its reciprocal.
TEST(Units, ReciprocalsAreNotConverted) {
  EXPECT_EQ(message_of("1 1/s", "s"),
            "unit '1/s' is the reciprocal of what is expected: a unit of the kind 's'");
  EXPECT_NE(message_of("3 GPa-1", "Pa"), "accepted");
}

TEST(Units, ABareNumberIsNoQuantity) {
  EXPECT_EQ(message_of("42", "m/s"), "is 42 without a unit; in SI units that would be \"42 m/s\"");
  EXPECT_EQ(message_of("-0.0", "m/s"), "accepted");
  EXPECT_EQ(message_of("42", ""), "accepted");
}

TEST(Units, UnknownUnitIsNamed) {
  EXPECT_EQ(message_of("3 furlongz", "m"), "unknown unit 'furlongz': expected a unit of the kind 'm'");
  EXPECT_EQ(message_of("6.58 kms", "m/s"), "unknown unit 'kms': expected a unit of the kind 'm/s'");
}

TEST(Units, TextWithoutNumberIsRefusedWithAnExample) {
  EXPECT_EQ(message_of("fast", "m/s"),
            "'fast' is not a number with a unit: expected for example \"1.5 m/s\"");
  EXPECT_EQ(message_of("+-5 m", "m"), "'+-5 m' is not a number with a unit: expected for example \"1.5 m\"");
  EXPECT_EQ(message_of("", "m/s"), "'' is not a number with a unit: expected for example \"1.5 m/s\"");
  EXPECT_EQ(message_of("half", ""), "'half' is not a number: expected for example \"1.5\"");
}

TEST(Units, InfinityAndNanAreRefused) {
  for (const char* text : {"inf m", "-inf m", "nan m", "infinity m", "1e999 m"}) {
    EXPECT_NE(message_of(text, "m"), "accepted") << text;
  }
}

// A unit with a number in front of it ("3 2 m") is a typing error, not three times two metres.
TEST(Units, SecondNumberIsRefused) {
  for (const char* text : {"3 2 m", "1,5 m", "1.5.5 m", "3 * 2", "1e3e3 m", "5 1e3 m", "1 m^1.5", "1 m1.5",
                           "1 -1m", "1 m/-1", "1 m)"}) {
    EXPECT_NE(message_of(text, "m"), "accepted") << text;
  }
  for (const char* text : {"1 m^2", "1 m2", "1 1/m-2", "1 (m)2", "1 m+2", "1 m^4/m^+2", "1 m^10 m^-8"})
    EXPECT_EQ(message_of(text, "m^2"), "accepted") << text;
}

TEST(Units, WrittenQuantityReadsBackToTheSameBits) {
  std::mt19937_64 random(20240501);
  std::uniform_real_distribution<double> exponent(-300.0, 300.0);
  std::uniform_real_distribution<double> mantissa(-10.0, 10.0);
  for (int i = 0; i < 2000; ++i) {
    const double value = mantissa(random) * std::pow(10.0, exponent(random));
    EXPECT_EQ(parse_quantity(format_quantity(value, "J/(kg K)"), "J/(kg K)"), value);
  }
}

TEST(Units, ThereAndBackIsTheIdentity) {
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"Mbar cm3/g", "J/kg"}, {"eV", "J"}, {"degC", "K"}, {"g/cc", "kg/m^3"}, {"cm/us", "m/s"}}) {
    EXPECT_NEAR(convert(convert(0.7, from, to), to, from), 0.7, 1e-13) << from;
  }
}

}  // namespace
}  // namespace whipple::units
