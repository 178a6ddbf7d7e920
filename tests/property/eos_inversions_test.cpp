// SPDX-License-Identifier: BSD-3-Clause
// State -> pair of variables -> the same state, for every model and material of the library at random states;
// what cannot be inverted is refused with the reason.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "eos/inversions.hpp"
#include "src/core/base/error.hpp"
#include "src/material/material_file.hpp"
#include "tests/unit/eos_impact_constants.hpp"

namespace whipple::eos::test {
namespace {

template <class M>
std::function<std::shared_ptr<const EquationOfState>()> with(const typename M::Constants& constants) {
  return [constants] { return std::make_shared<ModelEquationOfState<M>>(constants); };
}

struct Count {
  int asked = 0;
  int same = 0;     ///< inverted to the same state
  int another = 0;  ///< inverted to another state of the same pair
  int refused = 0;  ///< with an explanation
};

/// A stable state: positive bulk modulus, sound speed and heat capacity, energy above the coldest. Without a
/// Grueneisen coefficient (ceramics, concrete) the pressure says nothing about the energy.
bool stable(const State& s) {
  return s.isothermal_bulk_modulus > 1e-3 * std::abs(s.pressure) && s.heat_capacity > 0 &&
         std::isfinite(s.heat_capacity) && s.gruneisen >= 0;
}

/// The names alone, in their order: each of the tests is a process that lists all of them.
std::vector<std::filesystem::path> files_of_the_library() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(library_folders().front()))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

/// A material of the library, or a model on published constants.
struct Named {
  std::string name;
  std::function<std::shared_ptr<const EquationOfState>()> build;
};
/// As GoogleTest shows the parameter.
void PrintTo(const Named& named, std::ostream* out) { *out << named.name; }

std::vector<Named> equations_of_state() {
  std::vector<Named> all = {
      {"tillotson", with<Tillotson>(aluminium_tillotson())},    {"jwl", with<Jwl>(tnt())},
      {"polynomial", with<Polynomial>(aluminium_polynomial())}, {"ideal_gas", with<IdealGas>(air())},
      {"murnaghan", with<Murnaghan>(copper_murnaghan())},       {"tait", with<Tait>(water_tait())}};
  for (const std::filesystem::path& file : files_of_the_library())
    all.push_back({"library_" + file.stem().string(), [file] { return read_material(file).eos; }});
  return all;
}

TEST(InversionsOfTheLibrary, AreOfEachOfItsMaterials) {
  std::vector<std::filesystem::path> files;
  for (const LibraryMaterial& entry : library_materials()) files.push_back(entry.file);
  std::ranges::sort(files);
  EXPECT_EQ(files, files_of_the_library());
}

class Inversions : public ::testing::TestWithParam<Named> {
 protected:
  Inversions() : owner(GetParam().build()), eos(*owner) {}

  /// Counts what the inversion of one state does; anything but the pair that was asked for is a failure.
  template <class Invert>
  void ask(Count& count, const State& s, const char* pair, const Invert& invert,
           std::initializer_list<double State::*> asked) const {
    ++count.asked;
    try {
      const State t = invert();
      const double scale = std::abs(s.pressure) + s.density * s.sound_speed * s.sound_speed;
      for (const auto quantity : asked) {
        // The entropy of a cold state is known as well as its energy: round-off de/T.
        const double size =
            quantity == &State::pressure ? scale
            : quantity == &State::specific_entropy
                ? std::abs(s.specific_entropy) + 1e-6 * std::abs(s.specific_internal_energy) / s.temperature
                : s.density;
        EXPECT_NEAR((t.*quantity - s.*quantity) / size, 0, 1e-8)
            << pair << ": rho " << s.density << ", e " << s.specific_internal_energy << ", " << s.phase;
      }
      const double thermal = s.heat_capacity * s.temperature;
      const bool same = std::abs(t.density / s.density - 1) < 1e-8 &&
                        std::abs(t.specific_internal_energy - s.specific_internal_energy) <
                            1e-8 * (std::abs(s.specific_internal_energy) + thermal + scale / s.density);
      ++(same ? count.same : count.another);
    } catch (const StateError& error) {
      ++count.refused;
      EXPECT_GT(std::string(error.what()).size(), 30u) << error.what();
    }
  }

  std::shared_ptr<const EquationOfState> owner;
  const EquationOfState& eos;
};

TEST_P(Inversions, GiveBackTheState) {
  std::mt19937 random(20);
  std::uniform_real_distribution<double> uniform(0, 1);
  const bool thermal = std::isfinite(eos.reference_temperature());
  Count pressure_temperature, pressure_density, entropy_density;
  const double thinnest = 0.05,
               densest = std::min(0.98 * eos.maximum_density() / eos.reference_density(), 3.0);
  int states = 0;
  for (int i = 0; i < 4000 && states < 1500; ++i) {
    const double density = eos.reference_density() *
                           std::exp(std::log(thinnest) + uniform(random) * std::log(densest / thinnest));
    State s;
    try {
      if (thermal) {
        const double coldest = std::max(eos.least_temperature(), 5.0);
        s = eos.state_at_temperature(density, coldest * std::exp(uniform(random) * std::log(3e4 / coldest)));
      } else {
        s = eos.state(density, eos.minimum_energy(density) + 5e6 * std::pow(uniform(random), 2));
      }
    } catch (const StateError&) {
      continue;  // outside the model
    }
    if (!stable(s)) continue;
    ++states;
    if (s.gruneisen > 0) {
      ask(pressure_density, s, "(p, rho)", [&] { return state_at_pressure(eos, density, s.pressure); },
          {&State::pressure, &State::density});
    }
    if (std::isfinite(s.specific_entropy)) {
      ask(entropy_density, s, "(s, rho)", [&] { return state_at_entropy(eos, density, s.specific_entropy); },
          {&State::specific_entropy, &State::density});
    }
    if (thermal) {
      const double start = density * (0.97 + 0.06 * uniform(random));
      if (start >= eos.maximum_density()) continue;
      ask(pressure_temperature, s, "(p, T)",
          [&] { return state_at_pressure_and_temperature(eos, s.pressure, s.temperature, start); },
          {&State::pressure, &State::temperature});
    }
  }
  EXPECT_GT(states, 300);
  const auto mostly_the_same = [](const Count& count, const char* pair, double share) {
    EXPECT_GE(count.same, share * count.asked)
        << pair << ": " << count.same << " the same, " << count.another << " another, " << count.refused
        << " refused of " << count.asked;
  };
  // On an isochore of vapour whose heat capacity vanishes (docs/theory/gray.md, section 8) T jumps, and S and
  // P with it: another state of the pair, or none.
  mostly_the_same(entropy_density, "(s, rho)", 0.98);
  mostly_the_same(pressure_density, "(p, rho)", 0.98);
  // A start 3 % away may lie beyond a spinodal, or where the isotherm has another branch.
  mostly_the_same(pressure_temperature, "(p, T)", 0.97);
}

INSTANTIATE_TEST_SUITE_P(Catalogue, Inversions, ::testing::ValuesIn(equations_of_state()),
                         [](const auto& named) { return named.param.name; });

}  // namespace
}  // namespace whipple::eos::test
