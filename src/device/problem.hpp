// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "src/device/conduction.hpp"
#include "src/device/contact/constants.hpp"
#include "src/device/contact/walls.hpp"
#include "src/device/domains.hpp"
#include "src/device/ends.hpp"
#include "src/device/gather.hpp"
#include "src/device/lattice.hpp"
#include "src/device/material/material_constants.hpp"

/// What a device must know of a run, in numbers only.
namespace whipple::device {

/// Describes the run: the symplectic scheme with quadratic B-splines, affine fields and stores.
struct Problem {
  Dimension dimension = Dimension::space;
  double cell_size = 0.0;  ///< m
  Triple<double> lower{};  ///< m
  std::array<int, 3> cells{};
  std::array<FaceKind, 6> faces{};
  std::array<Mirror, 6> mirrors{};
  double slope_smoothing = 0.0;
  double kappa = 0.0;  ///< of the relaxation of affine fields
  LossConstants losses{};
  double shock_conduction = 0.0, conduction_onset = 0.0, conduction_rise = 1.0;  ///< 0: no conduction
  /// Of material beside voids: pressure over rho c^2 above which it counts, fraction of the cells that it should fill.
  double strong_pressure = 0.0, filled = 0.0;
  std::uint32_t fields = 1;
  ContactConstants contact{};
  WallConstants walls{};
  DomainLimits domain_limits{};

  // Of each body.
  std::vector<std::uint8_t> field_of_body;
  std::vector<double> initial_density;  ///< kg/m^3
  std::vector<ConductingBody> conducting;
  std::vector<DomainsOfBody> domains;
  std::vector<MaterialConstants> materials;
  std::vector<double> tables;  ///< of all materials

  /// Returns the inertia of affine fields per mass, m^2.
  [[nodiscard]] double inertia() const { return 0.25 * cell_size * cell_size; }
  /// Returns the faces with mirror planes or walls, one bit each.
  [[nodiscard]] std::uint32_t reflecting_faces() const {
    std::uint32_t reflecting = 0;
    for (std::size_t face = 0; face < 6; ++face) {
      if (faces[face] != FaceKind::outflow) reflecting |= 1U << face;
    }
    return reflecting;
  }
  /// Returns the upper corner of the domain, m.
  [[nodiscard]] Triple<double> upper() const {
    return {lower.x + cells[0] * cell_size, lower.y + cells[1] * cell_size, lower.z + cells[2] * cell_size};
  }
};

/// Returns the lattice of a problem, without nodes and particles.
template <class Lattice>
Lattice lattice_of(const Problem& problem) {
  Lattice lattice;
  lattice.cell_size = problem.cell_size;
  lattice.lower = problem.lower;
  lattice.cells = problem.cells;
  for (std::size_t a = 0; a < 3; ++a) {
    const int edge = Lattice::edge_along(static_cast<int>(a));
    lattice.blocks[a] = (problem.cells[a] + edge - 1) / edge + 2;
  }
  if constexpr (Lattice::planar) lattice.blocks[2] = 1;
  lattice.mirrors = problem.mirrors;
  lattice.slope_smoothing = problem.slope_smoothing;
  lattice.fields = problem.fields;
  lattice.has_rings = problem.dimension == Dimension::axisymmetric;
  return lattice;
}

/// Counts the blocks of the domain, for all fields.
inline double count_blocks(const Problem& problem) {
  const std::array<int, 3> blocks = problem.dimension == Dimension::space
                                        ? lattice_of<SpaceLattice>(problem).blocks
                                        : lattice_of<SectionLattice>(problem).blocks;
  double count = problem.fields;
  for (const int along : blocks) count *= along;
  return count;
}
/// Returns whether its nodes can be numbered.
inline bool has_too_many_cells(const Problem& problem) {
  constexpr double numbers = 4294967296.0;
  return count_blocks(problem) * block_nodes >= numbers;
}

/// Holds the particles on the host, component by component.
struct PointsOnHost {
  std::array<std::vector<double>, state_components> numbers;
  std::vector<std::uint32_t> body;
  std::vector<std::uint32_t> origin;  ///< place of each at the exchange before this one

  [[nodiscard]] std::size_t size() const { return body.size(); }
};

}  // namespace whipple::device
