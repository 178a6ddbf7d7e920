// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "src/contact/node_fields.hpp"

namespace whipple::contact {

/// Computes the common motion of bodies under compression at a node: they move together along the normal between them
/// for the fraction of the step in which they are in contact and are free otherwise (docs/theory/contact.md, equations
/// 4.1 to 4.11). Processes one node at a time and reuses its memory. Fields without relaxation (beta = 0) would retain
/// their velocity difference; they require impulses.
class Pressing {
 public:
  /// Returns theta (4.2), the fraction of the step in which two fields are in contact.
  /// @param normal  unit vector from a to b
  /// @param open    distance of their surfaces, m; <= 0: they touch
  /// @param dt      time step, s
  [[nodiscard]] static double share(const Side& a, const Side& b, const Vector3& normal, double open,
                                    double dt);

  /// Begins a node with these fields, which must outlive `apply`.
  void begin(std::span<Side> sides);
  /// Adds a pair of sides, by their numbers, that are in contact for a positive fraction of the step.
  /// @param normal    unit vector from a to b
  /// @param share     theta (4.2)
  /// @param friction  Coulomb coefficient of the pair
  void add(std::size_t a, std::size_t b, const Vector3& normal, double share, double friction);
  /// Changes velocities, increments and relaxations of the fields under compression and adds dissipation and impulses
  /// to the balance.
  void apply(Balance& balance);
  /// Returns whether any fields are under compression, after `apply`.
  [[nodiscard]] bool presses() const { return !pairs_.empty(); }
  /// Returns the energy (J) lost by all changes of the fields since `begin`, during and after `apply` (4.7). Requires
  /// that fields are under compression.
  [[nodiscard]] double lost() const;

 private:
  /// Describes two fields that touch, or would within the step.
  struct Pair {
    std::size_t a, b;
    Vector3 normal;
    double mass;          // reduced, kg
    double share;         // theta (4.2), fraction of the step in contact
    double friction;      // Coulomb coefficient
    double velocity = 0;  // impulse that equalises the velocities, N s
    double forces = 0;    // impulse that equalises the increments, N s
    double given = 0;     // normal impulse on b, N s
    double dragged = 0;   // tangential impulse, N s
  };
  /// Holds the motion of a field before contact.
  struct Former {
    Vector3 velocity, increment;
    double logarithm;    // ln(1 - beta)
    std::size_t leader;  // first of the fields connected under compression
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
  std::vector<double> relaxation_;  // of each side: common beta (4.3)
};

}  // namespace whipple::contact
