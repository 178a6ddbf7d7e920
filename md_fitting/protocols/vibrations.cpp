// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/protocols/vibrations.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "md_fitting/lammps/units.hpp"
#include "md_fitting/protocols/crystal.hpp"
#include "src/core/base/error.hpp"

namespace whipple::md {
namespace {

/// Returns ln[sinh(x/2)/(x/2)]: quantum minus classical free energy of an oscillator over k T.
double excess_free_energy(double x) {
  if (x < 0.02) return x * x / 24.0 * (1.0 - x * x / 120.0);
  return 0.5 * x + std::log1p(-std::exp(-x)) - std::log(x);
}

/// Returns (x/2) coth(x/2) - 1, the same for the energy.
double excess_energy(double x) {
  if (x < 0.02) return x * x / 12.0 * (1.0 - x * x / 60.0);
  return 0.5 * x / std::tanh(0.5 * x) - 1.0;
}

/// Returns [(x/2)/sinh(x/2)]^2 - 1, the same for the heat capacity over k.
double excess_heat_capacity(double x) {
  if (x < 0.02) return -x * x / 12.0 * (1.0 - x * x / 20.0);
  const double decay = std::exp(-x);
  return x * x * decay / ((1.0 - decay) * (1.0 - decay)) - 1.0;
}

}  // namespace

std::vector<double> vibration_frequencies(const ForceConstants& constants) {
  const std::int64_t n = constants.cells;
  const std::int64_t period = 2 * n;
  std::vector<double> cosines;
  for (std::int64_t i = 0; i < period; ++i) {
    cosines.push_back(std::cos(std::numbers::pi * static_cast<double>(i) / static_cast<double>(n)));
  }
  // Converts the eigenvalues, eV/(A^2 g/mol), to squared angular frequencies.
  const double to_square =
      metal::electron_volt / (metal::angstrom * metal::angstrom) / (constants.mass * metal::dalton);
  std::vector<double> frequencies;
  // Wave vectors 2 pi/(n a) (h, k, l): over [0, 2n) each of the N different ones of fcc or bcc occurs equally
  // often.
  for (std::int64_t h = 0; h < period; ++h) {
    for (std::int64_t k = 0; k < period; ++k) {
      for (std::int64_t l = 0; l < period; ++l) {
        Eigen::Matrix3d dynamical = Eigen::Matrix3d::Zero();
        bool translation = true;
        for (std::size_t site = 0; site < constants.sites.size(); ++site) {
          const auto& place = constants.sites[site];
          const std::int64_t phase =
              (((h * place[0] + k * place[1] + l * place[2]) % period) + period) % period;
          translation = translation && phase == 0;
          dynamical += cosines[static_cast<std::size_t>(phase)] *
                       Eigen::Map<const Eigen::Matrix3d>(constants.matrices[site].data());
        }
        if (translation) continue;  // all atoms move together
        const Eigen::Matrix3d symmetric = 0.5 * (dynamical + dynamical.transpose());
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(symmetric, Eigen::EigenvaluesOnly);
        for (const double value : solver.eigenvalues()) {
          if (!(value > 0.0)) {
            throw StateError(fmt::format(
                "the crystal is unstable: a vibration of wave vector 2 pi/({} a) ({}, {}, {}) has the "
                "squared frequency {:.3g} THz^2",
                n, h, k, l, value * to_square / std::pow(2e12 * std::numbers::pi, 2)));
          }
          frequencies.push_back(std::sqrt(value * to_square));
        }
      }
    }
  }
  return frequencies;
}

QuantumExcess quantum_excess(std::span<const double> frequencies, double temperature) {
  if (frequencies.empty()) throw InternalError("a crystal has vibrations");
  QuantumExcess sum;
  for (const double frequency : frequencies) {
    const double x = si::hbar * frequency / (si::boltzmann * temperature);
    sum.free_energy += excess_free_energy(x);
    sum.energy += excess_energy(x);
    sum.heat_capacity += excess_heat_capacity(x);
  }
  const double each = si::boltzmann / static_cast<double>(frequencies.size());
  return {each * temperature * sum.free_energy, each * temperature * sum.energy, each * sum.heat_capacity};
}

ForceConstants measure_force_constants(const Potential& potential, double specific_volume, std::int64_t cells,
                                       double displacement, std::string& transcript) {
  const double a =
      std::cbrt(metal::volume_per_atom(specific_volume, potential.mass()) * potential.atoms_per_cell());
  Crystal crystal(potential, a, cells, cells, cells);
  Lammps& lammps = crystal.lammps();
  crystal.evaluate();
  ForceConstants result{.cells = cells, .mass = potential.mass(), .sites = {}, .matrices = {}};
  const std::vector<double> places = lammps.gather("x");
  const std::size_t atoms = places.size() / 3;
  result.sites.resize(atoms);
  result.matrices.resize(atoms);
  for (std::size_t atom = 0; atom < atoms; ++atom) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      result.sites[atom][axis] = std::llround(2.0 * (places[3 * atom + axis] - places[axis]) / a);
    }
  }
  lammps.command("group moved id 1");
  const auto forces_at = [&](std::size_t axis, double distance) {
    std::array<double, 3> way{};
    way[axis] = distance;
    const auto move = [&](double sign) {
      lammps.command("displace_atoms moved move {:.17g} {:.17g} {:.17g} units box", sign * way[0],
                     sign * way[1], sign * way[2]);
    };
    move(1.0);
    crystal.evaluate();
    std::vector<double> forces = lammps.gather("f");
    move(-1.0);
    return forces;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::vector<double> forward = forces_at(axis, displacement);
    const std::vector<double> backward = forces_at(axis, -displacement);
    for (std::size_t atom = 0; atom < atoms; ++atom) {
      for (std::size_t k = 0; k < 3; ++k) {
        result.matrices[atom][3 * axis + k] =
            -(forward[3 * atom + k] - backward[3 * atom + k]) / (2.0 * displacement);
      }
    }
  }
  transcript += lammps.transcript();
  return result;
}

}  // namespace whipple::md
