// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Sparse>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "src/quasi_static/supports.hpp"
#include "src/quasi_static/unknowns.hpp"

namespace whipple::quasi_static {

/// Assembles forces and stiffness of the nodes of a load step (eq. 2 to 5) and solves for the unknowns. Every row is
/// summed by one thread in a fixed order.
class System {
 public:
  /// @param border_modulus  stiffness of the border times its volume, J, of each of its points
  System(const Supports& supports, const Unknowns& unknowns, std::vector<double> border_modulus);
  ~System();
  System(const System&) = delete;
  System& operator=(const System&) = delete;

  /// Returns the deformation gradients of the particles for displacements (m) of the nodes (eq. 1).
  [[nodiscard]] std::vector<Matrix3> deformations(std::span<const Vector3> u) const;
  /// Returns the internal forces (N) on the nodes, with those of the border.
  /// @param forces  T of the particles, as of Response::evaluate
  [[nodiscard]] std::vector<Vector3> internal(std::span<const double> forces,
                                              std::span<const Vector3> u) const;
  /// Returns the external forces (N) on the nodes by accelerations (m/s^2) of the particles.
  [[nodiscard]] std::vector<Vector3> external(const Particles& particles,
                                              std::span<const Vector3> acceleration) const;
  /// Returns forces of the nodes as those on the unknowns, N.
  [[nodiscard]] Eigen::VectorXd on_unknowns(std::span<const Vector3> force) const;

  /// Solves K du = -residual for the increments (m) of the unknowns; given displacements change by `given_factor` times
  /// their value.
  /// @param tangents  dT/df of the particles, as of Response::differentiate
  /// @returns false if K is singular
  bool solve(std::span<const double> tangents, const Eigen::VectorXd& residual, double given_factor,
             Eigen::VectorXd& du);

 private:
  using Sparse = Eigen::SparseMatrix<double>;
  struct Solvers;
  struct AtNode {
    std::uint32_t point;
    std::uint32_t place;  ///< of the node among those of the point
  };

  /// Returns the rows of a node: a 3x3 block for each node around it.
  void add_rows(std::size_t node, std::span<const double> tangents, std::span<Matrix3> blocks) const;
  [[nodiscard]] std::size_t offset(std::size_t node, std::size_t other) const;
  [[nodiscard]] std::span<const AtNode> particles_at(std::size_t node) const {
    return std::span(at_node_).subspan(at_begin_[node], at_begin_[node + 1] - at_begin_[node]);
  }
  [[nodiscard]] std::span<const AtNode> border_at(std::size_t node) const {
    return std::span(border_at_node_)
        .subspan(border_begin_[node], border_begin_[node + 1] - border_begin_[node]);
  }

  const Supports& supports_;
  const Unknowns& unknowns_;
  std::vector<double> border_modulus_;
  int around_;  // nodes along a direction that may share a point with one
  std::vector<std::size_t> at_begin_, border_begin_;
  std::vector<AtNode> at_node_, border_at_node_;  // particles and border points that reach each node
  std::vector<std::vector<std::uint32_t>> neighbours_;
  std::unique_ptr<Solvers> solvers_;
};

}  // namespace whipple::quasi_static
