// SPDX-License-Identifier: BSD-3-Clause
// Vibrations of crystals and what their quanta add to classical nuclei: against exact harmonic crystals and
// oscillators, elastic constants, and forces in molecular dynamics.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "md_fitting/lammps/units.hpp"
#include "md_fitting/protocols/bath.hpp"
#include "md_fitting/protocols/catalogue.hpp"
#include "md_fitting/protocols/crystal.hpp"
#include "md_fitting/protocols/elastic.hpp"
#include "md_fitting/protocols/statistics.hpp"
#include "md_fitting/protocols/vibrations.hpp"
#include "src/core/base/error.hpp"
#include "tests/unit/md_mpi_environment.hpp"

namespace whipple::md {
namespace {

constexpr double hbar = 1.054571817e-34;
constexpr double boltzmann = 1.380649e-23;
constexpr double mass = 63.55;

const Potential& mishin() {
  static const Potential potential = Potential::load("copper_mishin_2001", "Cu");
  return potential;
}

/// An fcc crystal whose nearest neighbours are tied by springs of stiffness 1 eV/A^2.
ForceConstants springs(std::int64_t cells) {
  ForceConstants crystal{.cells = cells, .mass = mass, .sites = {}, .matrices = {}};
  for (std::int64_t x = 0; x < 2 * cells; ++x) {
    for (std::int64_t y = 0; y < 2 * cells; ++y) {
      for (std::int64_t z = 0; z < 2 * cells; ++z) {
        if ((x + y + z) % 2 != 0) continue;
        std::array<double, 9> matrix{};
        const auto nearest = [&](std::int64_t i) { return i > cells ? i - 2 * cells : i; };
        const std::array<std::int64_t, 3> way = {nearest(x), nearest(y), nearest(z)};
        const std::int64_t square = way[0] * way[0] + way[1] * way[1] + way[2] * way[2];
        for (std::size_t i = 0; i < 3; ++i) {
          if (square == 0) matrix[4 * i] = 4.0;
          for (std::size_t k = 0; square == 2 && k < 3; ++k) {
            matrix[3 * i + k] = -0.5 * static_cast<double>(way[i] * way[k]);
          }
        }
        crystal.sites.push_back({x, y, z});
        crystal.matrices.push_back(matrix);
      }
    }
  }
  return crystal;
}

/// Square of the angular frequency (1/s^2) of one atom's mass on a spring of 1 eV/A^2.
double unit_square() { return metal::electron_volt / 1e-20 / (mass * metal::dalton); }

// Born, von Karman: along [100] m w^2 = 8 k sin^2(q a/4) for longitudinal and 4 k sin^2(q a/4) for transverse
// waves; none is faster than the longitudinal one at the end of the zone; and the sum of the squares is the
// trace.
TEST(Vibrations, OfSpringsBetweenNeighboursAreExact) {
  for (const std::int64_t cells : {3, 4}) {
    const ForceConstants crystal = springs(cells);
    const auto atoms = static_cast<double>(crystal.sites.size());
    std::vector<double> frequencies = vibration_frequencies(crystal);
    // Every wave vector occurs twice.
    EXPECT_EQ(frequencies.size(), 2 * (3 * crystal.sites.size() - 3));
    std::ranges::sort(frequencies);
    EXPECT_NEAR(std::pow(frequencies.back(), 2) / unit_square(), 8.0, 1e-9);
    for (std::int64_t j = 1; j <= cells; ++j) {
      const double sine =
          std::sin(std::numbers::pi * static_cast<double>(j) / static_cast<double>(2 * cells));
      for (const double stiffness : {8.0, 4.0}) {
        const double expected = std::sqrt(stiffness * sine * sine * unit_square());
        const auto next = std::ranges::lower_bound(frequencies, expected * (1.0 - 1e-9));
        ASSERT_NE(next, frequencies.end()) << cells << " " << j << " " << stiffness;
        EXPECT_NEAR(*next / expected, 1.0, 1e-9) << cells << " " << j << " " << stiffness;
      }
    }
    double squares = 0.0;
    for (const double w : frequencies) squares += w * w;
    EXPECT_NEAR(squares / static_cast<double>(frequencies.size()) / unit_square(),
                4.0 * atoms / (atoms - 1.0), 1e-9);
  }
}

TEST(Vibrations, OfAnUnstableCrystalAreRefused) {
  ForceConstants crystal = springs(3);
  for (auto& matrix : crystal.matrices) {
    for (double& value : matrix) value = -value;
  }
  EXPECT_THROW(vibration_frequencies(crystal), StateError);
}

// F = kT ln[2 sinh(x/2)] less kT ln x, and what follows from it, at any x; the leading term of Wigner and
// Kirkwood for hot oscillators, the zero-point energy for cold ones.
TEST(QuantumExcess, IsThatOfExactOscillators) {
  const double w = 3e13;
  const std::array<double, 1> one = {w};
  for (const double x : {1e-3, 0.0199, 0.0201, 0.3, 1.0, 3.0, 12.0}) {
    const double T = hbar * w / (boltzmann * x);
    const QuantumExcess excess = quantum_excess(one, T);
    const double kT = boltzmann * T;
    if (x > 0.1) {
      EXPECT_NEAR(excess.free_energy, kT * (std::log(2.0 * std::sinh(0.5 * x)) - std::log(x)), 1e-12 * kT)
          << x;
      EXPECT_NEAR(excess.energy, hbar * w * (0.5 + 1.0 / std::expm1(x)) - kT, 1e-12 * kT) << x;
    }
    const double step = 1e-3 * T;
    const auto F = [&](double t) { return quantum_excess(one, t).free_energy; };
    const auto E = [&](double t) { return quantum_excess(one, t).energy; };
    EXPECT_NEAR((F(T) - T * (F(T + step) - F(T - step)) / (2 * step)) / excess.energy, 1.0, 1e-5) << x;
    EXPECT_NEAR((E(T + step) - E(T - step)) / (2 * step) / excess.heat_capacity, 1.0, 1e-5) << x;
  }
  const double hot = 100.0 * hbar * w / boltzmann;
  EXPECT_NEAR(quantum_excess(one, hot).free_energy, hbar * hbar * w * w / (24.0 * boltzmann * hot),
              1e-5 * quantum_excess(one, hot).free_energy);
  const double cold = 0.01 * hbar * w / boltzmann;
  EXPECT_NEAR(quantum_excess(one, cold).energy, 0.5 * hbar * w - boltzmann * cold, 1e-12 * hbar * w);
}

// A uniform shift of the crystal costs nothing, and the slowest transverse wave along [100] has the speed
// (C44/rho)^1/2, less the dispersion of a chain.
TEST(ForceConstants, OfCopperGiveItsElasticConstants) {
  std::string transcript;
  constexpr std::int64_t cells = 6;
  const double volume = mishin().static_volume();
  const ForceConstants crystal = measure_force_constants(mishin(), volume, cells, 0.005, transcript);
  std::array<double, 9> sum{};
  for (const auto& matrix : crystal.matrices) {
    for (std::size_t i = 0; i < 9; ++i) sum[i] += matrix[i];
  }
  for (const double value : sum) EXPECT_NEAR(value, 0.0, 1e-6);
  const std::vector<double> frequencies = vibration_frequencies(crystal);
  const double a = mishin().lattice_constant() * metal::angstrom;
  const double q = 2.0 * std::numbers::pi / (static_cast<double>(cells) * a);
  const double c44 = measure_elastic(mishin(), volume, 0.002, 3).c44.value;
  const double chain = std::sin(q * a / 4.0) / (q * a / 4.0);
  const double expected = q * std::sqrt(c44 * volume) * chain;
  const double nearest =
      *std::ranges::min_element(frequencies, {}, [&](double w) { return std::abs(w - expected); });
  EXPECT_NEAR(nearest / expected, 1.0, 0.03);
  EXPECT_NE(transcript.find("displace_atoms"), std::string::npos);
}

// The mean square force of classical atoms, <f^2> = kT tr(d^2 U/du^2), is what Wigner and Kirkwood correct
// by: in a run at 100 K it is that of the static force constants.
TEST(ForceConstants, AreThoseOfMolecularDynamics) {
  std::string transcript;
  const ForceConstants constants =
      measure_force_constants(mishin(), mishin().static_volume(), 4, 0.005, transcript);
  const auto self = std::ranges::find(constants.sites, std::array<std::int64_t, 3>{0, 0, 0});
  const auto& matrix = constants.matrices[static_cast<std::size_t>(self - constants.sites.begin())];
  const double temperature = 100.0;
  Crystal crystal(mishin(), mishin().lattice_constant(), 4, 4, 4);
  Lammps& lammps = crystal.lammps();
  lammps.command("timestep 0.002");
  lammps.command("velocity all create {} 7 mom yes rot no dist gaussian", 2.0 * temperature);
  lammps.command("fix integrate all nve");
  couple_to_bath(lammps, temperature, 0.002, 7);
  lammps.command("run 1000 post no");
  lammps.command("unfix bath");  // whose forces are not those of the potential
  lammps.command("variable square atom fx*fx+fy*fy+fz*fz");
  lammps.command("compute square all reduce ave v_square");
  lammps.command("variable force_square equal c_square");
  lammps.command("thermo_style custom step temp pe vol c_virial c_displacement[4] c_square");
  const auto series = crystal.sample({"force_square", "kinetic_temperature"}, 10, 4000);
  const double thermal = metal::boltzmann * mean(series[1]) * (crystal.atoms() - 1.0) / crystal.atoms();
  EXPECT_NEAR(mean(series[0]) / (thermal * (matrix[0] + matrix[4] + matrix[8])), 1.0, 0.04);
}

std::map<std::string, Estimate> quantum_point(const std::string& keys) {
  auto document = input::Document::from_text(
      "element = \"Cu\"\npotential = \"copper_mishin_2001\"\n[quantum]\n" + keys, "plan.toml");
  const Plan plan = read_plan(document);
  for (const Task& task : make_tasks(plan, mishin())) {
    if (task.protocol == "quantum") return task.compute(nullptr).results;
  }
  return {};
}

// Copper at room temperature: half of Dulong and Petit's excess is that of a Debye crystal of the stated
// temperature, the pressure is that of Grueneisen's law, and nothing depends on the size of the crystal.
TEST(Quantum, CorrectionOfCopper) {
  auto large = quantum_point("volume_ratio = [1.0]\ntemperature = [\"293 K\"]\ncells = 6\n");
  auto small = quantum_point("volume_ratio = [1.0]\ntemperature = [\"293 K\"]\ncells = 4\n");
  for (const char* name : {"quantum_energy", "quantum_pressure", "zero_point_energy", "debye_temperature"}) {
    EXPECT_NEAR(small[name].value / large[name].value, 1.0, 0.01) << name;
  }
  const double theta = large["debye_temperature"].value;
  EXPECT_NEAR(theta, 330.0, 25.0);  // of copper, from its heat capacity near room temperature: 310 to 340 K
  const double R = 8.314462618 / 0.06355;
  const double x = theta / 293.0;
  // 3RT (x^2/20 - x^4/1680 ...), with a spectrum other than Debye's in the second term.
  EXPECT_NEAR(large["quantum_energy"].value, 3.0 * R * 293.0 * (x * x / 20.0 - std::pow(x, 4) / 1680.0),
              0.005 * large["quantum_energy"].value);
  EXPECT_NEAR(large["quantum_heat_capacity"].value, -3.0 * R * x * x / 20.0, 0.07 * 3.0 * R * x * x / 20.0);
  EXPECT_NEAR(large["zero_point_energy"].value, 9.0 / 8.0 * R * theta, 0.03 * 9.0 / 8.0 * R * theta);
  const double gruneisen = large["vibration_gruneisen"].value;
  EXPECT_NEAR(gruneisen, 1.93,
              0.2);  // dP/dE of isochores in molecular dynamics (docs/theory/fit.md, section 5)
  EXPECT_NEAR(large["quantum_pressure"].value * mishin().static_volume() / large["quantum_energy"].value,
              gruneisen, 0.1 * gruneisen);
  EXPECT_LT(large["quantum_pressure"].error, 0.01 * large["quantum_pressure"].value);
}

}  // namespace
}  // namespace whipple::md
