// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "src/contact/node_fields.hpp"

namespace whipple::contact {

/// Bodies that press on one another at a node move as one along the normal between them, for the fraction of the
/// step in which they touch; else each is free (docs/theory/contact.md, equations 4.1 to 4.11). It works on
/// one node at a time and keeps its memory from one to the next. Fields without relaxation (beta = 0) would
/// keep what they were apart by; they need other impulses.
class Pressing {
 public:
  /// theta (4.2): fraction of the step in which two fields touch.
  /// @param normal  unit vector from a to b
  /// @param open    m, distance of their surfaces; <= 0: they touch
  [[nodiscard]] static double share(const Side& a, const Side& b, const Vector3& normal, double open,
                                    double dt);

  /// Begins with a node where these fields meet; they must outlive `apply`.
  void begin(std::span<Side> sides);
  /// Two of them, numbers of the sides, touch for a fraction of the step above 0.
  /// @param friction  Coulomb's coefficient of the two
  void add(std::size_t a, std::size_t b, const Vector3& normal, double share, double friction);
  /// Changes velocities, increments and relaxations of the fields that press, and accounts for what that takes.
  void apply(Balance& balance);
  /// Returns whether fields are under compression, after `apply`.
  [[nodiscard]] bool presses() const { return !pairs_.empty(); }
  /// J: what all changes of the fields since `begin`, of `apply` and after it, lose (4.7). If fields press.
  [[nodiscard]] double lost() const;

 private:
  /// Two fields that touch, or would in the step.
  struct Pair {
    std::size_t a, b;
    Vector3 normal;
    double mass;          // reduced, kg
    double share;         // theta (4.2): of the step in which they touch
    double friction;      // Coulomb's coefficient
    double velocity = 0;  // impulse that makes the velocities common, N s
    double forces = 0;    // the same of the increments
    double given = 0;     // normal impulse on b, N s
    double dragged = 0;   // tangential impulse, N s
  };
  /// A field as it came to the node.
  struct Former {
    Vector3 velocity, increment;
    double logarithm;    // of 1 - beta
    std::size_t leader;  // of the fields that press on one another, the first
  };

  [[nodiscard]] Vector3 between(const Pair& pair, Vector3 Former::* value) const {
    return former_[pair.b].*value - former_[pair.a].*value;
  }
  void find_common_relaxation();
  void solve();
  bool drop_tension();
  void mix(Balance& balance);
  double drag(Pair& pair);
  std::size_t leader(std::size_t side) const;

  std::span<Side> sides_;
  std::vector<Pair> pairs_;
  std::vector<Former> former_;      // of each side
  std::vector<double> relaxation_;  // of each side: beta that it has in common with others
};

}  // namespace whipple::contact
