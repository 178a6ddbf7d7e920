// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "src/case/build/seeding.hpp"
#include "src/case/case.hpp"

namespace whipple::sph {

struct Options {
  double smoothing = 1.3;          ///< h over the distance of the particles
  double courant = 0.3;            ///< time step over h/(c + 1.2 (alpha c + beta mu))
  double linear_viscosity = 1.0;   ///< alpha of Monaghan's viscosity
  double quadratic_viscosity = 2;  ///< beta
  double artificial_stress = 0.3;  ///< share of the tension that pushes near particles apart; 0: none
};

/// Smoothed particle hydrodynamics in space beside which the material point method is measured: the same particles and
/// the same `update_material`, at a fixed smoothing length. Sums of J. J. Monaghan (Rep. Prog. Phys. 68 (2005) 1703) with
/// the cubic spline, density by continuity, pairwise artificial viscosity and artificial stress (J. Comput. Phys. 159
/// (2000) 290) of the mean stress,
///   dv_i/dt = sum_j m_j [s_i/rho_i^2 + s_j/rho_j^2 - (Pi_ij + R_ij f_ij^4) 1] grad W_ij,
/// and a velocity gradient that is exact for linear fields by the inverse of sum_j V_j (x_j - x_i) grad W_ij. Half of the
/// work of each pair on the mean of the velocities before and after a step becomes internal energy of either: the total
/// energy is exact. Faces of kind `symmetry` mirror; other faces do not exist. Bodies touch through the sums.
class Simulation {
 public:
  /// Starts from the particles of a case in space.
  explicit Simulation(const cases::Case& setup, const Options& options = {});

  /// Computes one step, at most to a time (s).
  void advance(double until);

  [[nodiscard]] double time() const { return time_; }
  [[nodiscard]] const Particles& particles() const { return particles_; }
  /// Gives access to the particles before the first step.
  [[nodiscard]] Particles& particles() { return particles_; }
  [[nodiscard]] const std::vector<cases::BodySummary>& bodies() const { return bodies_; }
  [[nodiscard]] double spacing() const { return spacing_; }
  [[nodiscard]] double kinetic_energy() const;
  [[nodiscard]] double internal_energy() const;
  [[nodiscard]] std::size_t pairs() const { return pairs_.size(); }
  /// Returns the velocity gradients (1/s) of the last step.
  [[nodiscard]] const std::vector<Matrix3>& gradients() const { return gradient_; }

 private:
  /// Two particles within reach, or a particle and the image of another (or of itself) at planes of symmetry.
  struct Pair {
    std::uint32_t i, j;
    std::uint8_t image;  ///< bits of the axes that are mirrored, 0: the particle itself
  };
  /// Geometry and force of a pair in this step.
  struct Link {
    Vector3 apart;       ///< x_i - x_j, m
    Vector3 force;       ///< on i, N
    double slope = 0.0;  ///< grad W = slope apart
  };

  [[nodiscard]] Vector3 mirrored(const Vector3& v, std::uint8_t image) const;
  [[nodiscard]] Vector3 mirrored_point(const Vector3& x, std::uint8_t image) const;
  [[nodiscard]] double volume(std::size_t i) const {
    return particles_.volume[i] + particles_.void_volume[i];
  }
  void find_pairs();
  void find_forces();
  void heat_and_find_gradients(double dt);

  const cases::Case& setup_;
  Options options_;
  Particles particles_;
  std::vector<cases::BodySummary> bodies_;
  double spacing_ = 0.0, length_ = 0.0, time_ = 0.0;
  std::array<bool, 3> mirror_{};  ///< at the lower face
  std::vector<Pair> pairs_;
  std::vector<Link> links_;
  std::vector<Matrix3> stress_, gradient_, shape_;  ///< stress over density, m^2/s^2
  std::vector<Vector3> force_, before_, found_at_;
  std::vector<double> closing_, pushing_;  ///< largest mu, m/s; R of artificial stress over density, m^2/s^2
};

}  // namespace whipple::sph
