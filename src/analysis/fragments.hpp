// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "src/analysis/frame.hpp"
#include "src/analysis/table.hpp"

/// Fragments: connected pieces of bodies that break (docs/theory/analysis.md, section 3).
namespace whipple::analysis {

struct Fragment {
  std::size_t particles = 0;  ///< in the model
  std::size_t intact = 0;     ///< number of these that have not failed
  double mass = 0.0;          ///< of the whole fragment; a fragment cut by mirror planes is completed
  double forward = 1.0;       ///< how many of its copies fly the same way along the axis, itself included
  double copies = 1.0;        ///< number of such fragments in the full problem
  Vector3 position = Vector3::Zero(), velocity = Vector3::Zero();
  double temperature = 0.0;      ///< mass-weighted mean, K; NaN if not written
  double melted_fraction = 0.0;  ///< NaN if not written
  double internal_energy = 0.0;  ///< J/kg, NaN if not written
  double volume = 0.0;           ///< m^3 including voids, 0 if the density was not written
  std::uint16_t body = 0;
  bool debris = false;  ///< faster than the threshold of debris
};

/// Sets the minimum number of intact particles of a fragment, including images.
constexpr double least_particles = 4.0;

/// Holds sums of a body over the full problem.
struct OfBody {
  double pieces = 0.0;
  double mass = 0.0;       ///< kg, including vapour
  double connected = 0.0;  ///< kg in fragments
  double loose = 0.0;      ///< kg of condensed material that belongs to no fragment
};

/// Selects how the particles of a fragment are connected.
enum class Links {
  intact,   ///< intact particles within the linking length; failed ones belong to the nearest intact one
  nearness  ///< all particles within the linking length, failed or not
};

struct Fragments {
  std::vector<Fragment> list;   ///< by decreasing mass
  std::string unknown;          ///< why none were found although bodies may have broken; empty: found
  std::vector<OfBody> of_body;  ///< of each body
};

/// Finds the fragments of each body. Gases and particles in the vapour phase belong to none. With `Links::intact`, none
/// is found without the field `failed`.
/// @param link linking length: distance within which particles are connected, and within which a failed particle
/// belongs to the nearest intact one, m
/// @throws InputError if the distance is too small for the extent of the material
Fragments find_fragments(const Snapshot& snapshot, std::span<const BodyInput> bodies, const Frame& frame,
                         double link, Links links = Links::intact);

/// Computes number, mean mass and Weibull distribution of the fragments of each body, and the fraction of its mass that
/// belongs to no fragment.
Quantities piece_measures(const Fragments& fragments, std::span<const BodyInput> bodies);

/// Computes the sizes that 16, 50 and 84 % of the mass of each body that has a size lie below, by the field
/// `fragment_size` that its points keep (docs/theory/cracks.md, eq. 8). Nothing if the field was not written.
Quantities fragment_size_measures(const Snapshot& snapshot, std::span<const BodyInput> bodies);

/// Tabulates pieces of each body by distance alone, of failed and intact particles, for linking lengths of 1.25, 1.5
/// and 2 cells. If the numbers agree with each other and with the number of fragments, all cracks are open.
/// @param cell  cell size, m
Table pieces_by_distance(const Snapshot& snapshot, std::span<const BodyInput> bodies, const Frame& frame,
                         double cell);

Table fragment_table(const std::vector<Fragment>& fragments, const Frame& frame);

/// Tabulates the number N(m) of debris fragments with a mass of at least m.
Table fragment_distribution(const std::vector<Fragment>& fragments);

/// Holds the exponent b of N(m) ~ m^-b for masses of at least `least` and its standard error, by maximum likelihood: b
/// = n / sum ln(m_i / least) (Clauset, Shalizi and Newman, SIAM Rev. 51 (2009) 661, eq. 3.1 with b = alpha - 1), error
/// b / sqrt(number of fragments in the model), as mirror images are not independent.
struct Exponent {
  double value = 0.0, error = 0.0;
  double count = 0.0;  ///< number of fragments included
};
Exponent distribution_exponent(std::span<const std::pair<double, double>> mass_and_copies, double least);

/// Holds the Weibull distribution N(m) = N exp(-(m/m_c)^b) of fragments.
struct Weibull {
  double exponent = 0.0,
         error = 0.0;  ///< b and its standard error; NaN of fewer than three fragments of the model
  double scale = 0.0;  ///< m_c, kg
};
/// Fits a Weibull distribution by maximum likelihood with the copies c as weights: sum c m^b ln m / sum c m^b - 1/b =
/// sum c ln m / sum c, m_c^b = sum c m^b / sum c. Mirror images are no further observations: the variance of b is
/// (6/pi^2) b^2/n, that of large samples, with n = (sum c)^2 / sum c^2.
Weibull weibull_distribution(std::span<const std::pair<double, double>> mass_and_copies);

/// Computes number, largest mass, mean mass and exponent of the debris fragments. The exponent includes fragments of at
/// least eight particles, without the largest one.
Quantities fragment_measures(const std::vector<Fragment>& fragments, double projectile_mass,
                             double particle_mass);

}  // namespace whipple::analysis
