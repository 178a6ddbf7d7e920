// SPDX-License-Identifier: BSD-3-Clause
// SESAME files: what is written is read back to the printed digits, the layout is that of the library, bad
// files of each kind are refused with file and line; a table of copper as a model against copper itself.
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <fstream>
#include <sstream>

#include "eos/files/sesame.hpp"
#include "eos/identities.hpp"
#include "eos/loci.hpp"
#include "eos/table/sesame.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/log.hpp"
#include "src/material/material_file.hpp"
#include "tests/unit/eos_support.hpp"
#include "tests/unit/folder_test.hpp"

namespace whipple::eos {
namespace sesame_test {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const test::GrayEos& copper() {
  static const test::GrayEos eos(test::copper());
  return eos;
}

const SesameMaterial& copper_table() {
  static const SesameMaterial table = [] {
    SesameMaterial result = sesame_of(copper(), {});
    result.number = 90029;
    result.created = 112126;
    result.atomic_number = 29;
    result.atomic_mass = 63.546e-3;
    result.comment = "material. copper /source. whipple, model gray /";
    return result;
  }();
  return table;
}

/// Two densities, three temperatures, numbers of every sign and size.
SesameMaterial small() {
  SesameMaterial m;
  m.number = 77;
  m.comment = std::string(85, 'x');
  m.reference_density = 1000;
  m.total.density = {0, 2000};
  m.total.temperature = {0, 300, 1e6};
  m.total.pressure = {0, -1e9, 1e-100, 2e9, 3, 1.23456789e15};
  m.total.energy = {-5e6, -6e6, -4e6, 1, 3e120, 4e6};
  m.vaporisation = {{1e5, 2e5}, {300, 400}, {1, 2}, {900, 800}, {2e6, 2.1e6}, {1e6, 1.1e6}, {}, {}};
  return m;
}

class SesameFiles : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    path_ = folder_ / "table.ses";
  }
  [[nodiscard]] std::vector<std::string> lines() const {
    std::ifstream file(path_);
    std::vector<std::string> result;
    for (std::string line; std::getline(file, line);) result.push_back(line);
    return result;
  }
  void put(const std::vector<std::string>& lines) const {
    std::ofstream file(path_);
    for (const std::string& line : lines) file << line << '\n';
  }
  [[nodiscard]] std::string refusal(std::optional<int> number = {}) const {
    return message_of<InputError>([&] { (void)read_sesame(path_, number); });
  }
  void write(const SesameMaterial& m) const { write_sesame(path_, {&m, 1}); }
  fs::path path_;
};

void expect_digits(const std::vector<double>& a, const std::vector<double>& b, const char* what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], 5.1e-9 * std::abs(b[i])) << what << i;
}

TEST_F(SesameFiles, are_read_back_to_the_printed_digits) {
  for (const SesameMaterial& m : {copper_table(), small()}) {
    write(m);
    const std::vector<std::string> first = lines();
    const SesameMaterial read = read_sesame(path_);
    EXPECT_EQ(read.number, m.number);
    EXPECT_EQ(read.created, m.created);
    EXPECT_EQ(read.comment, m.comment);
    EXPECT_NEAR(read.atomic_mass, m.atomic_mass, 1e-12);
    EXPECT_NEAR(read.bulk_modulus, m.bulk_modulus, 1e-8 * m.bulk_modulus);
    EXPECT_NEAR(read.reference_density, m.reference_density, 1e-8 * m.reference_density);
    expect_digits(read.total.density, m.total.density, "density");
    expect_digits(read.total.temperature, m.total.temperature, "temperature");
    expect_digits(read.total.pressure, m.total.pressure, "pressure");
    expect_digits(read.total.energy, m.total.energy, "energy");
    expect_digits(read.total.helmholtz, m.total.helmholtz, "helmholtz");
    expect_digits(read.vaporisation.pressure, m.vaporisation.pressure, "saturation pressure");
    expect_digits(read.vaporisation.vapour_density, m.vaporisation.vapour_density, "vapour density");
    expect_digits(read.vaporisation.liquid_energy, m.vaporisation.liquid_energy, "liquid energy");
    expect_digits(read.vaporisation.liquid_helmholtz, m.vaporisation.liquid_helmholtz, "liquid helmholtz");
    write(read);
    EXPECT_EQ(lines(), first) << "the second round changes no digit";
  }
}

TEST_F(SesameFiles, have_the_layout_of_the_library) {
  write(small());
  EXPECT_THAT(
      lines(),
      ElementsAre(" 0    77   101   160   r        0        0   1                                 1",
                  std::string(80, 'x'), "xxxxx" + std::string(75, ' '),
                  " 1    77   201     5   r        0        0   1                                 1",
                  " 0.00000000E+00 0.00000000E+00 1.00000000E+00 0.00000000E+00 0.00000000E+0011111",
                  " 1    77   301    19   r        0        0   1                                 1",
                  " 2.00000000E+00 3.00000000E+00 0.00000000E+00 2.00000000E+00 0.00000000E+0011111",
                  " 3.00000000E+02 1.00000000E+06 0.00000000E+00-1.00000000E+00 1.00000000-10911111",
                  " 2.00000000E+00 3.00000000E-09 1.23456789E+06-5.00000000E+00-6.00000000E+0011111",
                  "-4.00000000E+00 1.00000000E-06 3.00000000+114 4.00000000E+00               11110",
                  " 1    77   401    13   r        0        0   1                                 1",
                  " 2.00000000E+00 1.00000000E-04 2.00000000E-04 3.00000000E+02 4.00000000E+0211111",
                  " 1.00000000E-03 2.00000000E-03 9.00000000E-01 8.00000000E-01 2.00000000E+0011111",
                  " 2.10000000E+00 1.00000000E+00 1.10000000E+00                              11100",
                  " 2                                                                             2"));
}

TEST_F(SesameFiles, of_double_precision_and_with_other_tables_are_read) {
  write(small());
  std::vector<std::string> text = lines();
  const std::vector<std::string> others = {
      " 1    77   102     5   r        0        0   1", "words",
      " 1    77   306     6   r        0        0   1",
      " 0.00000000E+00 0.00000000E+00 1.00000000E+00 0.00000000E+00 0.00000000E+0011111", " 1.00000000E+00"};
  text.insert(text.begin() + 3, others.begin(), others.end());
  text[9] =
      " 4.000000000000000D+01 9.122400000000000E+01 6.506123456789012E+00 0.000000000000000E+00"
      " 0.000000000000000E+0011111";
  put(text);
  const SesameMaterial read = read_sesame(path_);
  EXPECT_EQ(read.atomic_number, 40);
  EXPECT_DOUBLE_EQ(read.reference_density, 6506.123456789012);
  EXPECT_EQ(read.total.density.back(), 2000);
}

/// The numbers of a written file in other columns.
std::vector<std::string> in_columns(const std::vector<std::string>& lines, std::size_t width,
                                    std::size_t per_line) {
  std::vector<std::string> result;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    result.push_back(lines[i]);
    if (lines[i].substr(20, 4) != "   r" || lines[i].substr(8, 6) < "   201") continue;
    std::vector<std::string> words;
    std::size_t left = std::stoul(lines[i].substr(14, 6));
    while (left > 0) {
      ++i;
      for (std::size_t j = 0; j < 5 && left > 0; ++j, --left)
        words.push_back(std::string(width - 15, ' ') + lines[i].substr(15 * j, 15));
    }
    for (std::size_t j = 0; j < words.size(); ++j) {
      if (j % per_line == 0) result.emplace_back();
      result.back() += words[j];
    }
  }
  return result;
}

TEST_F(SesameFiles, with_other_columns_and_without_a_last_record_are_read) {
  write(small());
  const std::vector<std::string> text = lines();
  const SesameMaterial expected = read_sesame(path_);
  struct Columns {
    std::size_t width, per_line;
  };
  for (const auto [width, per_line] : {Columns{16, 5}, {22, 3}, {22, 5}, {24, 4}, {15, 5}}) {
    SCOPED_TRACE(std::to_string(per_line) + " words of " + std::to_string(width));
    std::vector<std::string> changed = in_columns(text, width, per_line);
    changed.pop_back();
    put(changed);
    const SesameMaterial read = read_sesame(path_);
    EXPECT_EQ(read.total.density, expected.total.density);
    EXPECT_EQ(read.total.pressure, expected.total.pressure);
    EXPECT_EQ(read.total.energy, expected.total.energy);
    EXPECT_EQ(read.vaporisation.liquid_energy, expected.vaporisation.liquid_energy);
  }
}

// The layout of the tables that come with ANEOS: an index of the material, a label before each table, words
// of 16 columns, no comment and no last record.
TEST_F(SesameFiles, with_labelled_headers_are_read) {
  write(small());
  const SesameMaterial expected = read_sesame(path_);
  std::vector<std::string> text = {
      " INDEX      MATID =     77    NWDS =        9",
      "  7.70000000e+01  2.30216000e+05  2.30216000e+05  1.00000000e+00  3.00000000e+00",
      "  2.01000000e+02  3.01000000e+02  4.01000000e+02  5.00000000e+00"};
  const std::vector<std::string> wide = in_columns(lines(), 16, 5);
  for (std::size_t i = 3; i + 1 < wide.size(); ++i) {
    const bool header = wide[i].substr(20, 4) == "   r";
    text.push_back(header ? " RECORD     TYPE =  " + wide[i].substr(11, 3) +
                                "     NWDS =   " + wide[i].substr(14, 6)
                          : wide[i]);
  }
  put(text);
  const SesameMaterial read = read_sesame(path_);
  EXPECT_EQ(read.number, 77);
  EXPECT_EQ(read.reference_density, expected.reference_density);
  EXPECT_EQ(read.total.density, expected.total.density);
  EXPECT_EQ(read.total.temperature, expected.total.temperature);
  EXPECT_EQ(read.total.energy, expected.total.energy);
  EXPECT_EQ(read.vaporisation.liquid_energy, expected.vaporisation.liquid_energy);
  // Cut behind the constants, and with an unknown label.
  put({text.begin(), text.begin() + 5});
  EXPECT_THAT(refusal(), HasSubstr("material 77 has no table 301"));
  text[5] = " RECORD     KIND =  301";
  put(text);
  EXPECT_THAT(refusal(), AllOf(HasSubstr(path_.string() + ":6: expected the header"),
                               HasSubstr("RECORD TYPE ="), HasSubstr("FLASH (.301)")));
}

TEST_F(SesameFiles, that_are_bad_are_refused_with_file_and_line) {
  write(small());
  const std::vector<std::string> good = lines();
  const auto changed = [&](std::size_t line, const std::string& text) {
    std::vector<std::string> bad = good;
    bad[line - 1] = text;
    put(bad);
    return refusal();
  };
  const std::string file = path_.string();
  put({good.begin(), good.begin() + 8});
  EXPECT_THAT(refusal(), AllOf(HasSubstr(file + ":8: the file ends in table 301 of material 77"),
                               HasSubstr("expected 9 more of 19 words")));
  put({});
  EXPECT_THAT(refusal(), HasSubstr(file + ":1: the file is empty"));
  EXPECT_THAT(changed(6, " 1    77   301    18   r        0        0   1"),
              AllOf(HasSubstr(file + ":7: table 301"), HasSubstr("expected 19 words (p, e), or 25")));
  EXPECT_THAT(changed(11, " 1    77   401    12   r        0        0   1"),
              AllOf(HasSubstr(file + ":12: table 401"), HasSubstr("expected 13 words, or 17")));
  EXPECT_THAT(changed(4, " 1    77   201     4   r        0        0   1"),
              AllOf(HasSubstr(file + ":5: table 201"), HasSubstr("expected 5 words or more")));
  EXPECT_THAT(changed(6, "no header"),
              AllOf(HasSubstr(file + ":6: expected the header"), HasSubstr("no header")));
  EXPECT_THAT(
      changed(8, " 3.00000000E+02 2.99000000E+02 0.00000000E+00-1.00000000E+00 1.00000000-10911111"),
      AllOf(HasSubstr(file + ":8: table 301"), HasSubstr("temperature 3 is 299, expected more than 300")));
  EXPECT_THAT(changed(7, " 2.00000000E+00 3.00000000E+00-1.00000000E+00 2.00000000E+00 0.00000000E+0011111"),
              AllOf(HasSubstr(file + ":7: table 301"), HasSubstr("density 1 is -1, expected at least 0")));
  EXPECT_THAT(changed(7, " 2.50000000E+00 3.00000000E+00 0.00000000E+00 2.00000000E+00 0.00000000E+0011111"),
              AllOf(HasSubstr(file + ":7: table 301"), HasSubstr("number of densities, an integer"),
                    HasSubstr("2.5")));
  EXPECT_THAT(changed(9, " 2.00000000E+00 3.00000000E-09 1.2345x789E+06-5.00000000E+00-6.00000000E+0011111"),
              AllOf(HasSubstr(file + ":9: table 301"), HasSubstr("expected a number in columns 31-45")));
  EXPECT_THAT(changed(5, " 0.00000000E+00 0.00000000E+00 0.00000000E+00 0.00000000E+00 0.00000000E+0011111"),
              AllOf(HasSubstr(file + ":5: table 201"), HasSubstr("positive reference density")));
  put({good.begin(), good.begin() + 5});
  std::ofstream(path_, std::ios::app) << " 2\n";
  EXPECT_THAT(refusal(), HasSubstr("material 77 has no table 301"));
  put(good);
  EXPECT_THAT(refusal(78), AllOf(HasSubstr(file), HasSubstr("holds no material 78; it holds 77")));
  fs::remove(path_);
  EXPECT_THAT(refusal(), HasSubstr("there is no such file"));
}

TEST_F(SesameFiles, of_several_materials_need_a_number) {
  std::array<SesameMaterial, 2> two = {small(), small()};
  two[1].number = 78;
  two[1].reference_density = 1500;
  write_sesame(path_, two);
  EXPECT_THAT(refusal(),
              AllOf(HasSubstr("holds the materials 77, 78"), HasSubstr("expected the number of one")));
  EXPECT_NEAR(read_sesame(path_, 78).reference_density, 1500, 1e-9);
  EXPECT_NEAR(read_sesame(path_, 77).reference_density, 1000, 1e-9);
}

TEST_F(SesameFiles, hold_finite_numbers_and_a_material_number_only) {
  SesameMaterial m = small();
  m.total.pressure[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(message_of<InputError>([&] { write(m); }), HasSubstr("not finite"));
  m = small();
  m.number = 1000000;
  EXPECT_THAT(message_of<InputError>([&] { write(m); }), HasSubstr("expected 1 to 999999"));
  EXPECT_FALSE(fs::exists(path_));
}

/// Copper through a file.
class SesameModel : public SesameFiles {
 protected:
  void SetUp() override {
    SesameFiles::SetUp();
    write(copper_table());
    table_.emplace(read_sesame(path_), copper().reference_temperature(), path_.string());
  }
  std::optional<Sesame> table_;
};

TEST_F(SesameModel, has_the_hugoniot_of_its_model_to_200_GPa) {
  const Hugoniot exact(copper()), tabulated(*table_);
  for (double up = 100; up <= 2770; up += 89) {
    const ShockState a = exact.at_particle_velocity(up), b = tabulated.at_particle_velocity(up);
    EXPECT_NEAR(b.state.pressure / a.state.pressure, 1, 1e-5) << up;
    EXPECT_NEAR(b.state.density / a.state.density, 1, 5e-6) << up;
    EXPECT_NEAR(b.state.temperature / a.state.temperature, 1, 1e-4) << up;
    EXPECT_NEAR(b.state.sound_speed / a.state.sound_speed, 1, 2e-4) << up;
    EXPECT_NEAR(b.state.specific_entropy, a.state.specific_entropy, 0.05) << up;
  }
}

TEST_F(SesameModel, has_the_isotherm_of_its_model) {
  const double rho0 = copper().reference_density();
  for (double x = 0.95; x < 1.6; x += 0.00313) {
    const State a = copper().state_at_temperature(x * rho0, 300),
                b = table_->state_at_temperature(x * rho0, 300);
    EXPECT_NEAR(b.pressure, a.pressure, 1e-5 * std::abs(a.pressure) + 1e5) << x;
    EXPECT_NEAR(b.specific_internal_energy, a.specific_internal_energy,
                1e-5 * std::abs(a.specific_internal_energy) + 10)
        << x;
  }
}

/// p, e and F are interpolated apart; in compressed solid and liquid they fit together all the same.
TEST_F(SesameModel, keeps_the_identities_in_compression) {
  for (const double rho : {10000.0, 12000.0, 15000.0}) {
    for (const double T : {150.0, 310.0, 1000.0, 2000.0, 5000.0, 9000.0, 12000.0}) {
      const State s = table_->state_at_temperature(rho, T);
      const IdentityDefects defects = check_identities(*table_, rho, s.specific_internal_energy);
      EXPECT_LT(std::abs(defects.pressure), 2e-3) << rho << ' ' << T;
      EXPECT_LT(std::abs(defects.sound_speed), 2e-3) << rho << ' ' << T;
      EXPECT_LT(std::abs(defects.entropy_energy), 1e-4) << rho << ' ' << T;
      EXPECT_LT(std::abs(defects.entropy_volume), 1e-4) << rho << ' ' << T;
    }
  }
}

TEST_F(SesameModel, inverts_energy_to_temperature_everywhere) {
  for (double rho = 1.01 * table_->minimum_density(); rho < table_->maximum_density(); rho *= 1.37) {
    double before = -std::numeric_limits<double>::infinity();
    for (double T = 50; T < 5e4; T *= 1.031) {
      const State a = table_->state_at_temperature(rho, T);
      EXPECT_GT(a.specific_internal_energy, before) << rho << ' ' << T;
      before = a.specific_internal_energy;
      const State b = table_->state(rho, a.specific_internal_energy);
      EXPECT_NEAR(b.temperature, T, 1e-9 * T) << rho;
      EXPECT_NEAR(b.pressure, a.pressure, 1e-9 * std::abs(a.pressure) + 1) << rho << ' ' << T;
    }
  }
}

TEST_F(SesameModel, evaluates_batches_like_points_and_reports_the_bounds) {
  const double rho0 = copper().reference_density(), e0 = table_->reference_energy();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::array<double, 6> rho = {1.2 * rho0, rho0, 20 * rho0, rho0, nan, 1e-6};
  const std::array<double, 6> e = {e0 + 1e6, -1e9, e0, 1e12, e0, e0};
  std::array<double, 6> p{}, T{}, c{}, melted{};
  const RangeReport report = table_->evaluate({rho, e, p, T, c, melted, {}});
  const State point = table_->state(rho[0], e[0]);
  EXPECT_EQ(p[0], point.pressure);
  EXPECT_EQ(T[0], point.temperature);
  EXPECT_EQ(c[0], point.sound_speed);
  EXPECT_EQ(report.below_cold_curve, 1U);
  EXPECT_EQ(T[1], 50);
  EXPECT_EQ(report.out_of_range, 4U);
  EXPECT_EQ(report.first, 2U);
  EXPECT_EQ(report.bound, "density outside the table");
  for (const std::size_t i : {2U, 3U, 4U, 5U})
    EXPECT_TRUE(std::isnan(p[i]) && std::isnan(T[i]) && std::isnan(c[i]));
  EXPECT_THAT(message_of<StateError>([&] { (void)table_->state(20 * rho0, e0); }),
              HasSubstr("density outside"));
  EXPECT_THAT(message_of<StateError>([&] { (void)table_->state(rho0, 1e12); }), HasSubstr("above the table"));
  EXPECT_THAT(message_of<StateError>([&] { (void)table_->state_at_temperature(rho0, 49); }),
              HasSubstr("50 to 50000 K"));
}

TEST_F(SesameModel, needs_an_energy_that_rises_and_a_reference_state_inside) {
  SesameMaterial m = read_sesame(path_);
  EXPECT_THAT(message_of<InputError>([&] { Sesame(m, 10, "origin"); }), HasSubstr("lies outside the table"));
  const std::size_t nr = m.total.density.size();
  // A fall of more than the heat of 2 % of the temperature is no round-off.
  const auto energy = [&](std::size_t i, std::size_t j) -> double& { return m.total.energy[j * nr + i]; };
  const double before = energy(3, 40);
  energy(3, 40) = energy(3, 30);
  EXPECT_THAT(
      message_of<InputError>([&] { Sesame(m, 300, "origin"); }),
      AllOf(HasSubstr("origin: material 90029"),
            HasSubstr("the energy does not rise with the temperature in"), HasSubstr("are not cured")));
  energy(3, 40) = before;
  for (std::size_t i = 0; i < nr; ++i) energy(i, 7) = energy(i, 6);
  for (std::size_t i = 0; i < nr; ++i) energy(i, 9) = energy(i, 8);
  EXPECT_THAT(message_of<InputError>([&] { Sesame(m, 300, "origin"); }),
              HasSubstr("more than 1 % of the steps"));
}

// Flat steps of other people's tables are cured and counted; away from them the table is the same.
TEST_F(SesameModel, cures_a_few_energies_that_do_not_rise) {
  SesameMaterial m = read_sesame(path_);
  const std::size_t nr = m.total.density.size();
  for (const std::size_t i : {std::size_t{3}, nr / 2, nr - 1})
    m.total.energy[7 * nr + i] = m.total.energy[6 * nr + i];
  SesameGrid grid = m.total;
  const EnergyRepair repair = raise_energies(grid);
  EXPECT_EQ(repair.raised, 3U);
  EXPECT_EQ(repair.steps, nr * (m.total.temperature.size() - 1));
  EXPECT_GT(repair.largest, 0.0);
  EXPECT_LT(repair.fraction, 1e-3);
  log::WarningsAside warnings;
  const Sesame table(m, copper().reference_temperature(), "origin");
  ASSERT_EQ(warnings.messages().size(), 1U);
  EXPECT_THAT(warnings.messages()[0], HasSubstr("in 3 of"));
  const double rho0 = copper().reference_density();
  EXPECT_EQ(table.state_at_temperature(1.2 * rho0, 2000).specific_internal_energy,
            table_->state_at_temperature(1.2 * rho0, 2000).specific_internal_energy);
}

// The default range ends below the compression limit of a model, not at it.
TEST(SesameTable, of_a_model_with_a_compression_limit_has_a_default_range) {
  for (const double slope : {1.30, 1.339, 1.4171, 1.489, 1.61}) {
    GrayConstants c;
    c.molar_mass = 0.0269815;
    c.reference_specific_volume = 1.0 / 2707.0;
    c.hugoniot_intercept = 5386;
    c.hugoniot_slope = slope;
    c.gruneisen = 2.1;
    c.gruneisen_slope = 1.6;
    c.electronic_heat_coefficient = 1.35e-3;
    c.melting_temperature = 1220;
    c.vapour_attraction = 3600;
    const test::GrayEos eos(c);
    EXPECT_NO_THROW((void)sesame_of(eos, {})) << slope;
  }
}

TEST_F(SesameModel, without_helmholtz_energy_has_no_entropy) {
  SesameMaterial m = read_sesame(path_);
  m.total.helmholtz.clear();
  const Sesame table(m, 300, "origin");
  const double rho0 = copper().reference_density();
  EXPECT_TRUE(std::isnan(table.state_at_temperature(1.1 * rho0, 900).specific_entropy));
  EXPECT_EQ(table.state_at_temperature(1.1 * rho0, 900).pressure,
            table_->state_at_temperature(1.1 * rho0, 900).pressure);
}

/// An ideal gas has p = (gamma - 1) c_v rho T and c^2 = gamma (gamma - 1) c_v T; the interpolation is exact
/// in both variables. The axes may begin at zero.
TEST(SesameTable, of_an_ideal_gas_is_exact_down_to_zero) {
  constexpr double gamma = 1.4, cv = 718;
  SesameMaterial m;
  m.number = 5030;
  m.reference_density = 1.2;
  m.total.density = {0, 0.5, 1.2, 3, 10};
  m.total.temperature = {0, 200, 450, 3000};
  for (const double T : m.total.temperature) {
    for (const double rho : m.total.density) {
      m.total.pressure.push_back((gamma - 1) * cv * rho * T);
      m.total.energy.push_back(cv * T);
    }
  }
  const Sesame gas(m, 300, "gas");
  EXPECT_FALSE(gas.condensed());
  for (const double rho : {1e-9, 0.3, 1.0, 9.0}) {
    for (const double T : {1.0, 250.0, 2500.0}) {
      const State s = gas.state(rho, cv * T);
      EXPECT_NEAR(s.temperature, T, 1e-10 * T);
      EXPECT_NEAR(s.pressure, (gamma - 1) * cv * rho * T, 1e-10 * s.pressure);
      const double c = std::sqrt(gamma * (gamma - 1) * cv * std::max(T, 300 * 1e-4));
      EXPECT_NEAR(s.sound_speed, c, 1e-9 * c);
      EXPECT_NEAR(s.gruneisen, gamma - 1, 1e-9);
    }
  }
  EXPECT_THROW((void)gas.state(0, 1e5), StateError);
}

TEST_F(SesameModel, is_a_model_of_materials) {
  const fs::path material = folder_ / "copper.toml";
  const auto declare = [&](const std::string& more) {
    std::ofstream(material) << "name = \"Copper\"\nsource = \"test\"\n[eos]\nmodel = \"sesame\"\n" << more;
  };
  declare("file = \"table.ses\"\nmaterial = 90029\n");
  const Material read = read_material(material);
  EXPECT_EQ(read.eos->model(), "sesame");
  EXPECT_TRUE(read.eos->condensed());
  EXPECT_THAT(read.companions, ElementsAre("table.ses"));
  EXPECT_NEAR(read.reference.density, copper().reference_density(), 1);
  declare("file = \"table.ses\"\nmaterial = 3337\n");
  EXPECT_THAT(message_of<InputError>([&] { (void)read_material(material); }),
              HasSubstr("holds no material 3337; it holds 90029"));
}

}  // namespace sesame_test
}  // namespace whipple::eos
