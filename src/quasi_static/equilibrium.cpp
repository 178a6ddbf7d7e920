// SPDX-License-Identifier: BSD-3-Clause
#include "src/quasi_static/equilibrium.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

namespace whipple::quasi_static {
namespace {

double norm_of(std::span<const Vector3> forces) {
  double sum = 0.0;
  for (const Vector3& force : forces) sum += force.squaredNorm();
  return std::sqrt(sum);
}

/// Does work. @returns what it returns; its time, s, is added to `seconds`
template <class Work>
bool timed(double& seconds, Work&& work) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  const bool done = work();
  seconds += std::chrono::duration<double>(Clock::now() - begin).count();
  return done;
}

/// Holds displacements with their forces.
struct Trial {
  Eigen::VectorXd unknown;
  double given_factor = 0.0;
  std::vector<Vector3> u;
  std::vector<Matrix3> f;
  std::vector<double> forces;  // T of the particles
  std::vector<Vector3> internal;
  Eigen::VectorXd residual;
  double relative = 0.0;
};

class Newton {
 public:
  Newton(System& system, const Unknowns& unknowns, Response& response, const Supports& supports,
         std::span<const Vector3> external, const NewtonControl& control)
      : system_(system),
        unknowns_(unknowns),
        response_(response),
        strains_(static_cast<std::size_t>(supports.strains())),
        particles_(supports.particles.size()),
        external_(external),
        external_norm_(norm_of(external)),
        control_(control) {}

  Convergence find();

 private:
  /// Evaluates the forces of a trial. @returns whether they are defined
  bool evaluate(Trial& trial) {
    trial.u = unknowns_.displacements({trial.unknown.data(), static_cast<std::size_t>(trial.unknown.size())},
                                      trial.given_factor);
    trial.f = system_.deformations(trial.u);
    trial.forces.resize(particles_ * strains_);
    for (const Matrix3& f : trial.f) {
      if (!(f.determinant() > 0.2)) return false;
    }
    if (!response_.evaluate(trial.f, trial.forces)) return false;
    trial.internal = system_.internal(trial.forces, trial.u);
    std::vector<Vector3> imbalance = trial.internal;
    for (std::size_t i = 0; i < imbalance.size(); ++i) imbalance[i] -= external_[i];
    trial.residual = system_.on_unknowns(imbalance);
    const double scale = std::max(external_norm_, norm_of(trial.internal));
    trial.relative = scale > 0.0 ? trial.residual.norm() / scale : 0.0;
    return std::isfinite(trial.relative);
  }
  bool advance(Trial& at, Convergence& result);
  /// Returns the node with the largest component of the residual.
  [[nodiscard]] std::size_t worst_node(const Trial& trial) const;

  System& system_;
  const Unknowns& unknowns_;
  Response& response_;
  std::size_t strains_, particles_;
  std::span<const Vector3> external_;
  double external_norm_;
  NewtonControl control_;
};

/// Performs one iteration. @returns false if no shorter step has a defined state
bool Newton::advance(Trial& at, Convergence& result) {
  std::vector<double> tangents(particles_ * strains_ * strains_);
  timed(result.tangent_seconds, [&] {
    response_.tangents(at.f, at.forces, tangents);
    return true;
  });
  const double given_left = 1.0 - at.given_factor;
  Eigen::VectorXd du;
  if (!timed(result.linear_seconds, [&] { return system_.solve(tangents, at.residual, given_left, du); })) {
    return false;
  }
  constexpr int most_halvings = 4;
  constexpr double enough = 0.8;
  // The line search asks for less work of the residual on the increment, not for a smaller residual: material that is
  // bent far has residuals that rise before they fall. Nothing is asked where displacements are given.
  const double work = std::abs(at.residual.dot(du));
  Trial best;
  double least = std::numeric_limits<double>::infinity(), length = 1.0;
  bool found = false;
  for (int halving = 0; halving <= most_halvings; ++halving, length *= 0.5) {
    Trial next;
    next.unknown = at.unknown + length * du;
    next.given_factor = at.given_factor + length * given_left;
    if (!evaluate(next)) continue;
    const double left = std::abs(next.residual.dot(du));
    if (left < least) {
      least = left;
      best = std::move(next);
    }
    found = true;
    if (given_left > 0.0 || least <= enough * work) break;
  }
  if (found) at = std::move(best);
  return found;
}

std::size_t Newton::worst_node(const Trial& trial) const {
  std::size_t worst = 0;
  double most = -1.0;
  for (std::size_t node = 0; node < trial.internal.size(); ++node) {
    for (int a = 0; a < 3; ++a) {
      const std::int32_t unknown = unknowns_.of(node, a).unknown;
      if (unknown < 0 || !(std::abs(trial.residual[unknown]) > most)) continue;
      most = std::abs(trial.residual[unknown]);
      worst = node;
    }
  }
  return worst;
}

Convergence Newton::find() {
  Convergence result;
  Trial at;
  at.unknown = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(unknowns_.size()));
  at.given_factor = unknowns_.are_any_given() ? 0.0 : 1.0;
  bool defined = evaluate(at);
  if (defined) result.residuals.push_back(at.relative);
  while (defined && (at.given_factor < 1.0 || at.relative > control_.tolerance) &&
         result.iterations < control_.iterations) {
    defined = advance(at, result);
    ++result.iterations;
    if (defined) result.residuals.push_back(at.relative);
  }
  result.reached = defined && at.given_factor == 1.0 && at.relative <= control_.tolerance;
  if (result.reached) static_cast<void>(response_.evaluate(at.f, at.forces));
  result.worst_node = worst_node(at);
  result.u = std::move(at.u);
  result.f = std::move(at.f);
  result.internal = std::move(at.internal);
  return result;
}

}  // namespace

Convergence find_equilibrium(System& system, const Unknowns& unknowns, Response& response,
                             const Supports& supports, std::span<const Vector3> external,
                             const NewtonControl& control) {
  return Newton(system, unknowns, response, supports, external, control).find();
}

}  // namespace whipple::quasi_static
