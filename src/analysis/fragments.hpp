// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "src/analysis/frame.hpp"
#include "src/analysis/table.hpp"

/// Fragments: connected components of the condensed particles (docs/theory/analysis.md, section 3).
namespace whipple::analysis {

/// Components of points closer than `distance` to each other: for every point the least index of its
/// component. Cell list and concurrent union-find; the result does not depend on the number of threads.
std::vector<std::uint32_t> connected_components(std::span<const Vector3> points, double distance);

struct Fragment {
  std::size_t particles = 0;
  double mass = 0.0;    ///< of the whole fragment; one cut by mirror planes is completed
  double copies = 1.0;  ///< how many such fragments the full problem has
  Vector3 position = Vector3::Zero(), velocity = Vector3::Zero();
  double temperature = 0.0;      ///< mean by mass, K; NaN if not written
  double melted_fraction = 0.0;  ///< NaN if not written
  double internal_energy = 0.0;  ///< J/kg, NaN if not written
  double volume = 0.0;           ///< m^3 with its voids, 0 if the density was not written
  std::uint16_t body = 0;        ///< of the largest fraction of the mass
  bool debris = false;           ///< faster than the threshold of debris
};

/// Fragments by decreasing mass. Vapour is none: particles of the phase vapour are left out.
/// @param link distance within which two particles belong together, m
std::vector<Fragment> find_fragments(const Snapshot& snapshot, const Frame& frame, double link);

Table fragment_table(const std::vector<Fragment>& fragments, const Frame& frame);

/// Number N(m) of debris fragments of at least mass m.
Table fragment_distribution(const std::vector<Fragment>& fragments);

/// Exponent b of N(m) ~ m^-b over masses from `least` on and its standard error, by maximum likelihood:
/// b = n / sum ln(m_i / least) (Clauset, Shalizi and Newman, SIAM Rev. 51 (2009) 661, eq. 3.1 with b = alpha
/// - 1).
struct Exponent {
  double value = 0.0, error = 0.0;
  double count = 0.0;  ///< fragments that entered
};
Exponent distribution_exponent(std::span<const std::pair<double, double>> mass_and_copies, double least);

/// Number, largest mass, mean mass and exponent of the debris fragments. The exponent counts fragments of at
/// least eight particles but for the largest one.
Quantities fragment_measures(const std::vector<Fragment>& fragments, double projectile_mass,
                             double particle_mass);

}  // namespace whipple::analysis
