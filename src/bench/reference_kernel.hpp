// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "src/core/base/registers.hpp"

namespace whipple::bench {

/// Implements the minimum work of a step of the material point method, hand-written for one problem as a reference for
/// times of the code: a dense block of metal, eight particles in each cell and sorted by cell, linear functions, FLIP,
/// update stress last; Johnson-Cook strength with rate and temperature, Mie-Grueneisen with implicit energy, artificial
/// viscosity, Jaumann rate. It has no bodies, blocks, boundaries, failure, phases, ledger, error checks or sorting. The
/// particle-to-grid transfer is vectorised over the nodes of a cell, the grid-to-particle transfer over its particles.
class ReferenceKernel {
 public:
  /// Creates a cube with `edge` cells along each edge, at rest except for a smooth velocity field.
  explicit ReferenceKernel(int edge);

  /// Computes one step; the total displacement of particles must not exceed a quarter of a cell.
  void step();

  [[nodiscard]] std::size_t particles() const { return field_[0].size(); }
  [[nodiscard]] double mass() const;
  /// Returns the momentum in N s, component 0 to 2.
  [[nodiscard]] double momentum(int component) const;
  /// Returns the kinetic energy of the particles in J.
  [[nodiscard]] double kinetic_energy() const;
  [[nodiscard]] double internal_energy() const;
  [[nodiscard]] double largest_plastic_strain() const;

 private:
  /// Lists the 18 numbers of a particle.
  enum Field : std::size_t {
    x,
    y,
    z,
    vx,
    vy,
    vz,
    sxx,
    syy,
    szz,
    sxy,
    syz,
    szx,
    volume,
    mass_,
    energy,
    strain,
    pressure,
    temperature,
    fields
  };
  struct alignas(64) Node {
    std::array<Lanes, 2> half;  ///< mass and momentum, force; later velocity and its increment
  };
  static constexpr std::size_t per_cell = 8;

  [[nodiscard]] std::size_t node(int i, int j, int k) const {
    return (static_cast<std::size_t>(i) * nodes_per_edge_ + static_cast<std::size_t>(j)) * nodes_per_edge_ +
           static_cast<std::size_t>(k);
  }
  template <class Function>
  void for_each_cell(Function&& f);
  void particles_to_grid();
  void advance_grid();
  void grid_to_particles();
  void update_stress(std::size_t first, const std::array<Lanes, 9>& gradient);

  int edge_;
  std::size_t nodes_per_edge_;
  std::array<std::vector<double>, fields> field_;
  std::vector<Node> nodes_;
};

/// Returns the time (s) per particle and step of the kernel with a quarter of a million particles on one thread, best
/// of several runs.
double measure_reference_kernel();

}  // namespace whipple::bench
