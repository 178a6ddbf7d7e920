// SPDX-License-Identifier: BSD-3-Clause
#include "src/quasi_static/system.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "src/quasi_static/loops.hpp"
#include "src/quasi_static/response.hpp"

namespace whipple::quasi_static {
namespace {

/// Relative asymmetry of K below which it is neglected: each iteration then reduces the residual by this factor at least.
constexpr double symmetric_below = 1e-3;

/// Lists the points of each node, in ascending order.
template <class AtNode>
void invert(const Reach& reach, std::size_t nodes, std::vector<std::size_t>& begin,
            std::vector<AtNode>& list) {
  begin.assign(nodes + 1, 0);
  for (const Reached& reached : reach.reached) ++begin[reached.node + 1];
  for (std::size_t i = 0; i < nodes; ++i) begin[i + 1] += begin[i];
  list.resize(reach.reached.size());
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  for (std::size_t p = 0; p < reach.size(); ++p) {
    const auto of_point = reach.of(p);
    for (std::size_t k = 0; k < of_point.size(); ++k) {
      list[next[of_point[k].node]++] = {static_cast<std::uint32_t>(p), static_cast<std::uint32_t>(k)};
    }
  }
}

/// Holds dF_k/du_a = slope of the components k of the deformation of a point on the displacement of a node: each
/// component depends on one direction only.
struct Slopes {
  std::array<int, 9> direction{};
  std::array<double, 9> slope{};
};
Slopes slopes_of(const Supports& supports, std::size_t p, const Reached& reached) {
  const int m = supports.strains();
  Slopes all;
  for (int k = 0; k < m; ++k) {
    const auto [row, column] = component(m, k);
    const auto i = static_cast<std::size_t>(k);
    if (row == 2 && m == 5) {  // the hoop of a ring
      all.direction[i] = 1;
      all.slope[i] = reached.n * supports.per_radius[p];
    } else {
      all.direction[i] = row;
      all.slope[i] = reached.gradient[column];
    }
  }
  return all;
}

}  // namespace

struct System::Solvers {
  Eigen::SimplicialLDLT<Sparse> symmetric;
  Eigen::SparseLU<Sparse> general;
  bool symmetric_is_analysed = false, general_is_analysed = false;
};

System::System(const Supports& supports, const Unknowns& unknowns, std::vector<double> border_modulus)
    : supports_(supports),
      unknowns_(unknowns),
      border_modulus_(std::move(border_modulus)),
      around_(2 * supports.most_along - 1),
      neighbours_(supports.nodes()),
      solvers_(std::make_unique<Solvers>()) {
  invert(supports.particles, supports.nodes(), at_begin_, at_node_);
  invert(supports.border, supports.nodes(), border_begin_, border_at_node_);
  for_each(supports.nodes(), [&](std::size_t node) {
    std::vector<std::uint32_t>& all = neighbours_[node];
    for (const AtNode& at : particles_at(node)) {
      for (const Reached& reached : supports_.particles.of(at.point)) all.push_back(reached.node);
    }
    for (const AtNode& at : border_at(node)) {
      for (const Reached& reached : supports_.border.of(at.point)) all.push_back(reached.node);
    }
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
  });
}

System::~System() = default;

std::vector<Matrix3> System::deformations(std::span<const Vector3> u) const {
  std::vector<Matrix3> f(supports_.particles.size());
  for_each(f.size(), [&](std::size_t p) {
    f[p].setIdentity();
    for (const Reached& reached : supports_.particles.of(p)) {
      f[p] += u[reached.node] * reached.gradient.transpose();
      if (!supports_.per_radius.empty())
        f[p](2, 2) += u[reached.node][1] * reached.n * supports_.per_radius[p];
    }
  });
  return f;
}

std::vector<Vector3> System::internal(std::span<const double> forces, std::span<const Vector3> u) const {
  const auto m = static_cast<std::size_t>(supports_.strains());
  std::vector<Matrix3> border(supports_.border.size(), Matrix3::Zero());
  for_each(border.size(), [&](std::size_t q) {
    for (const Reached& reached : supports_.border.of(q)) {
      border[q] += border_modulus_[q] * u[reached.node] * reached.gradient.transpose();
    }
  });
  std::vector<Vector3> sum(supports_.nodes());
  for_each(sum.size(), [&](std::size_t node) {
    sum[node].setZero();
    for (const AtNode& at : particles_at(node)) {
      const Slopes slopes = slopes_of(supports_, at.point, supports_.particles.of(at.point)[at.place]);
      for (std::size_t k = 0; k < m; ++k)
        sum[node][slopes.direction[k]] += slopes.slope[k] * forces[m * at.point + k];
    }
    for (const AtNode& at : border_at(node)) {
      sum[node] += border[at.point] * supports_.border.of(at.point)[at.place].gradient;
    }
  });
  return sum;
}

std::vector<Vector3> System::external(const Particles& particles,
                                      std::span<const Vector3> acceleration) const {
  std::vector<Vector3> sum(supports_.nodes(), Vector3::Zero());
  if (acceleration.empty()) return sum;
  for_each(sum.size(), [&](std::size_t node) {
    for (const AtNode& at : particles_at(node)) {
      sum[node] +=
          supports_.particles.of(at.point)[at.place].n * particles.mass[at.point] * acceleration[at.point];
    }
  });
  return sum;
}

Eigen::VectorXd System::on_unknowns(std::span<const Vector3> force) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(unknowns_.size()));
  for (std::size_t node = 0; node < force.size(); ++node) {
    for (int a = 0; a < supports_.components(); ++a) {
      const Component& c = unknowns_.of(node, a);
      if (c.unknown >= 0) sum[c.unknown] += c.sign * force[node][a];
    }
  }
  return sum;
}

std::size_t System::offset(std::size_t node, std::size_t other) const {
  const auto &from = supports_.places[node], &to = supports_.places[other];
  const int middle = supports_.most_along - 1;
  const int x = to[0] - from[0] + middle, y = to[1] - from[1] + middle, z = to[2] - from[2] + middle;
  const int flat = supports_.components() == 3 ? (x * around_ + y) * around_ + z : x * around_ + y;
  return static_cast<std::size_t>(flat);
}

void System::add_rows(std::size_t node, std::span<const double> tangents, std::span<Matrix3> blocks) const {
  const auto m = static_cast<std::size_t>(supports_.strains());
  for (const AtNode& at : particles_at(node)) {
    const auto reach = supports_.particles.of(at.point);
    const Slopes own = slopes_of(supports_, at.point, reach[at.place]);
    const double* const tangent = &tangents[m * m * at.point];
    std::array<std::array<double, 9>, 3> rows{};  // B_i^T dT/df
    for (std::size_t k = 0; k < m; ++k) {
      std::array<double, 9>& row = rows[static_cast<std::size_t>(own.direction[k])];
      for (std::size_t l = 0; l < m; ++l) row[l] += own.slope[k] * tangent[m * k + l];
    }
    for (const Reached& other : reach) {
      Matrix3& block = blocks[offset(node, other.node)];
      const Slopes slopes = slopes_of(supports_, at.point, other);
      for (std::size_t l = 0; l < m; ++l) {
        for (std::size_t a = 0; a < 3; ++a)
          block(static_cast<int>(a), slopes.direction[l]) += rows[a][l] * slopes.slope[l];
      }
    }
  }
  for (const AtNode& at : border_at(node)) {
    const auto reach = supports_.border.of(at.point);
    for (const Reached& other : reach) {
      blocks[offset(node, other.node)].diagonal().array() +=
          border_modulus_[at.point] * reach[at.place].gradient.dot(other.gradient);
    }
  }
}

bool System::solve(std::span<const double> tangents, const Eigen::VectorXd& residual, double given_factor,
                   Eigen::VectorXd& du) {
  const int d = supports_.components();
  const auto n = static_cast<Eigen::Index>(unknowns_.size());
  const auto blocks_around =
      static_cast<std::size_t>(d == 3 ? around_ * around_ * around_ : around_ * around_);
  std::vector<std::vector<Eigen::Triplet<double>>> rows(supports_.nodes());
  std::vector<Vector3> by_given(supports_.nodes(), Vector3::Zero());
  for_each(supports_.nodes(), [&](std::size_t node) {
    std::vector<Matrix3> blocks(blocks_around, Matrix3::Zero());
    add_rows(node, tangents, blocks);
    for (const std::uint32_t other : neighbours_[node]) {
      const Matrix3& block = blocks[offset(node, other)];
      for (int a = 0; a < d; ++a) {
        const Component& row = unknowns_.of(node, a);
        if (row.unknown < 0) continue;
        for (int b = 0; b < d; ++b) {
          const Component& column = unknowns_.of(other, b);
          if (column.unknown < 0) {
            by_given[node][a] += block(a, b) * given_factor * column.given;
          } else {
            rows[node].emplace_back(row.unknown, column.unknown, row.sign * column.sign * block(a, b));
          }
        }
      }
    }
  });
  std::vector<Eigen::Triplet<double>> all;
  for (const auto& row : rows) all.insert(all.end(), row.begin(), row.end());
  Sparse stiffness(n, n);
  stiffness.setFromTriplets(all.begin(), all.end());
  const Eigen::VectorXd right = -residual - on_unknowns(by_given);
  const Sparse transposed = stiffness.transpose();
  const double scale = stiffness.coeffs().abs().maxCoeff();
  const Sparse skew = stiffness - transposed;
  Solvers& s = *solvers_;
  if (skew.coeffs().abs().maxCoeff() < symmetric_below * scale) {
    const Sparse mean = 0.5 * (stiffness + transposed);
    if (!std::exchange(s.symmetric_is_analysed, true)) s.symmetric.analyzePattern(mean);
    s.symmetric.factorize(mean);
    if (s.symmetric.info() == Eigen::Success) {
      du = s.symmetric.solve(right);
      if (du.allFinite()) return true;
    }
  }
  if (!std::exchange(s.general_is_analysed, true)) s.general.analyzePattern(stiffness);
  s.general.factorize(stiffness);
  if (s.general.info() != Eigen::Success) return false;
  du = s.general.solve(right);
  return du.allFinite();
}

}  // namespace whipple::quasi_static
