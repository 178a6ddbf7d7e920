// SPDX-License-Identifier: BSD-3-Clause
#include "src/contact/pressing.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace whipple::contact {
namespace {

constexpr int sweeps_of_friction = 8;  // over the pairs, where more than two fields are under compression
/// Minimum of (1 - theta)/theta where several pairs are in contact: keeps their equations regular if the normals of
/// three fields are parallel.
constexpr double least_compliance = 1e-10;

}  // namespace

void Pressing::begin(std::span<Side> sides) {
  sides_ = sides;
  pairs_.clear();
}

double Pressing::share(const Side& a, const Side& b, const Vector3& normal, double open, double dt) {
  if (open <= 0.0) return 1.0;
  const double closing = -normal.dot(b.after() - a.after()) * dt;
  return closing > open ? 1.0 - open / closing : 0.0;
}

void Pressing::add(std::size_t a, std::size_t b, const Vector3& normal, double share, double friction) {
  const double first = sides_[a].mass, second = sides_[b].mass;
  pairs_.push_back({.a = a,
                    .b = b,
                    .normal = normal,
                    .mass = first * second / (first + second),
                    .share = share,
                    .friction = friction});
}

void Pressing::apply(Balance& balance) {
  if (pairs_.empty()) return;
  former_.clear();
  for (std::size_t s = 0; s < sides_.size(); ++s) {
    const Side& side = sides_[s];
    if (side.mass < no_mass) {
      former_.push_back({Vector3::Zero(), Vector3::Zero(), 0.0, s});
    } else {
      former_.push_back({side.before(), side.increment(), std::log1p(-side.relaxation()), s});
    }
  }
  do {
    find_common_relaxation();
    solve();
  } while (drop_tension());
  if (pairs_.empty()) return;
  mix(balance);
  const int repeat = pairs_.size() > 1 ? sweeps_of_friction : 1;
  for (int sweep = 0; sweep < repeat; ++sweep) {
    for (Pair& pair : pairs_) balance.friction_heat += pair.friction > 0.0 ? drag(pair) : 0.0;
  }
  for (const Pair& pair : pairs_) balance.friction_impulse += pair.dragged;
}

std::size_t Pressing::leader(std::size_t side) const {
  while (former_[side].leader != side) side = former_[side].leader;
  return side;
}

/// Computes the common relaxation (4.3) of all fields that are connected under compression, directly or through others.
void Pressing::find_common_relaxation() {
  for (std::size_t s = 0; s < sides_.size(); ++s) former_[s].leader = s;
  for (const Pair& pair : pairs_) {
    const std::size_t a = leader(pair.a), b = leader(pair.b);
    former_[std::max(a, b)].leader = std::min(a, b);
  }
  relaxation_.assign(sides_.size(), 0.0);
  for (std::size_t s = 0; s < sides_.size(); ++s) {
    if (sides_[s].mass < no_mass) continue;
    const std::size_t first = leader(s);
    if (first != s) {
      relaxation_[s] = relaxation_[first];
      continue;
    }
    double mass = 0.0, sum = 0.0;
    bool equal = true;  // as in schemes that prescribe the relaxation
    for (std::size_t t = s; t < sides_.size(); ++t) {
      if (leader(t) != s || sides_[t].mass < no_mass) continue;
      mass += sides_[t].mass;
      sum += sides_[t].mass * former_[t].logarithm;
      equal = equal && sides_[t].relaxation() == sides_[s].relaxation();
    }
    relaxation_[s] = equal ? sides_[s].relaxation() : -std::expm1(sum / mass);
  }
}

/// Solves (4.9) for the impulses of the pairs, which leave the fraction 1 - theta of the relative normal motion of each
/// pair. In units of sqrt(mu), in which the diagonal of the matrix is 1 + (1 - theta)/theta.
void Pressing::solve() {
  const std::size_t count = pairs_.size();
  if (count == 1) {
    Pair& pair = pairs_.front();
    pair.velocity = pair.share * pair.mass * pair.normal.dot(between(pair, &Former::velocity));
    pair.forces = pair.share * pair.mass * pair.normal.dot(between(pair, &Former::increment));
  } else if (count > 1) {
    const auto n = static_cast<Eigen::Index>(count);
    Eigen::MatrixXd matrix(n, n);
    Eigen::MatrixX2d right(n, 2);
    for (Eigen::Index k = 0; k < n; ++k) {
      const Pair& of_k = pairs_[static_cast<std::size_t>(k)];
      for (Eigen::Index l = 0; l <= k; ++l) {
        const Pair& of_l = pairs_[static_cast<std::size_t>(l)];
        double inverse = 0.0;  // of the mass that both impulses accelerate
        if (of_k.a == of_l.a) inverse += 1.0 / sides_[of_k.a].mass;
        if (of_k.b == of_l.b) inverse += 1.0 / sides_[of_k.b].mass;
        if (of_k.a == of_l.b) inverse -= 1.0 / sides_[of_k.a].mass;
        if (of_k.b == of_l.a) inverse -= 1.0 / sides_[of_k.b].mass;
        matrix(k, l) = matrix(l, k) =
            std::sqrt(of_k.mass) * std::sqrt(of_l.mass) * inverse * of_k.normal.dot(of_l.normal);
      }
      matrix(k, k) = 1.0 + std::max((1.0 - of_k.share) / of_k.share, least_compliance);
      const double root = std::sqrt(of_k.mass);
      right(k, 0) = root * of_k.normal.dot(between(of_k, &Former::velocity));
      right(k, 1) = root * of_k.normal.dot(between(of_k, &Former::increment));
    }
    const Eigen::MatrixX2d impulses = matrix.ldlt().solve(right);
    for (Eigen::Index k = 0; k < n; ++k) {
      Pair& pair = pairs_[static_cast<std::size_t>(k)];
      pair.velocity = std::sqrt(pair.mass) * impulses(k, 0);
      pair.forces = std::sqrt(pair.mass) * impulses(k, 1);
    }
  }
  for (Pair& pair : pairs_) pair.given = -(pair.forces + relaxation_[pair.a] * pair.velocity);  // (4.5)
}

/// Removes the pair with the strongest tension, if there is one: surfaces transmit no tension.
/// @returns whether the remaining pairs must be solved again
bool Pressing::drop_tension() {
  if (pairs_.empty()) return false;
  const auto least = std::ranges::min_element(pairs_, {}, &Pair::given);
  if (least->given > 0.0) return false;
  pairs_.erase(least);
  return !pairs_.empty();
}

/// Evaluates (4.7) from the fields. With nearly parallel normals of several pairs the sum over the pairs would omit the
/// round-off of their impulses.
double Pressing::lost() const {
  const Vector3 frame = former_[pairs_.front().a].velocity;
  double sum = 0.0;
  for (std::size_t s = 0; s < sides_.size(); ++s) {
    if (sides_[s].mass < no_mass) continue;
    const double beta = relaxation_[s];
    const Vector3 velocity = former_[s].velocity - frame, shift = sides_[s].before() - former_[s].velocity;
    const Vector3 increment = sides_[s].increment(), change = increment - former_[s].increment;
    sum += sides_[s].mass * ((velocity + shift).dot(change + beta * shift) + 0.5 * increment.dot(change) -
                             (1.0 - beta) * shift.dot(increment));
  }
  return -sum;
}

/// Applies (4.4) and the heat (4.6) to the fields.
void Pressing::mix(Balance& balance) {
  for (const Pair& pair : pairs_) {
    for (const bool of_b : {false, true}) {
      Side& side = sides_[of_b ? pair.b : pair.a];
      const Vector3 per_mass = (of_b ? -1.0 : 1.0) / side.mass * pair.normal;
      side.shift_velocity(pair.velocity * per_mass);
      const Vector3 change = pair.forces * per_mass;
      side.node->motion.accelerate(change);
      side.node->motion.set_relaxation(relaxation_[of_b ? pair.b : pair.a]);
    }
  }
  double rest = pairs_.size() > 1 ? lost() : 0.0;
  const auto heat_of = [&](const Pair& pair) {
    const double v = pair.velocity, d = pair.forces;
    return (1.0 - pair.share) / (pair.share * pair.mass) * (0.5 * d * d + relaxation_[pair.a] * v * (v + d));
  };
  if (pairs_.size() > 1) {
    for (const Pair& pair : pairs_) rest -= heat_of(pair);
  }
  for (const Pair& pair : pairs_) {
    const double heat = heat_of(pair) + rest / static_cast<double>(pairs_.size());
    balance.contact_heat += heat;
    balance.impulse += pair.given;
    sides_[pair.a].heat += 0.5 * heat;
    sides_[pair.b].heat += 0.5 * heat;
  }
}

/// Applies the friction of a pair (4.10), (4.11).
/// @returns its dissipation, J
double Pressing::drag(Pair& pair) {
  Side &a = sides_[pair.a], &b = sides_[pair.b];
  const auto tangential = [&](const Vector3& v) { return Vector3(v - pair.normal.dot(v) * pair.normal); };
  const Vector3 slip = tangential(b.after() - a.after());
  const double speed2 = slip.squaredNorm();
  if (!(speed2 > 0.0)) return 0.0;
  // Velocity z of (4.10), by which the work of an impulse on the field is computed
  const auto power = [&](std::size_t s) {
    const double beta = relaxation_[s];
    return Vector3(beta * sides_[s].before() + (1.0 - beta) * former_[s].velocity + sides_[s].increment() -
                   0.5 * former_[s].increment);
  };
  const Vector3 mean = power(pair.b) - power(pair.a);
  const double grip = 2.0 * pair.mass * std::max(slip.dot(mean) / speed2, 0.0);
  const double limit = std::max(pair.friction * pair.given - pair.dragged, 0.0) / std::sqrt(speed2);
  const double held = std::min({pair.mass, grip, limit});
  const Vector3 impulse = -held * slip;
  b.push(impulse);
  a.push(-impulse);
  pair.dragged += impulse.norm();
  const double heat = -impulse.dot(mean) - 0.5 * impulse.squaredNorm() / pair.mass;
  a.heat += 0.5 * heat;
  b.heat += 0.5 * heat;
  return heat;
}

}  // namespace whipple::contact
