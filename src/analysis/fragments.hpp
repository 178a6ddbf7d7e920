// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "src/analysis/frame.hpp"
#include "src/analysis/table.hpp"

/// Fragments: pieces of bodies that break (docs/theory/analysis.md, section 3).
namespace whipple::analysis {

struct Fragment {
  std::size_t particles = 0;  ///< in the model
  std::size_t intact = 0;     ///< of these have not failed
  double mass = 0.0;          ///< of the whole fragment; one cut by mirror planes is completed
  double copies = 1.0;        ///< how many such fragments the full problem has
  Vector3 position = Vector3::Zero(), velocity = Vector3::Zero();
  double temperature = 0.0;      ///< mean by mass, K; NaN if not written
  double melted_fraction = 0.0;  ///< NaN if not written
  double internal_energy = 0.0;  ///< J/kg, NaN if not written
  double volume = 0.0;           ///< m^3 with its voids, 0 if the density was not written
  std::uint16_t body = 0;
  bool debris = false;  ///< faster than the threshold of debris
};

/// Intact particles that a fragment has at least, with their images.
constexpr double least_particles = 4.0;

/// Sums of a body over the full problem.
struct OfBody {
  double pieces = 0.0;
  double mass = 0.0;       ///< kg, with vapour
  double connected = 0.0;  ///< kg in fragments
  double loose = 0.0;      ///< kg of condensed material in none
};

/// What holds the particles of a fragment together.
enum class Links {
  intact,   ///< those that have not failed and are near; what has failed belongs to the nearest of them
  nearness  ///< all that are near, failed or not
};

struct Fragments {
  std::vector<Fragment> list;  ///< by decreasing mass
  std::string unknown;         ///< why there are none although bodies may have broken; empty: they were found
  std::vector<OfBody> of_body;  ///< of each body
};

/// Finds the fragments of each body. Gases and particles of the phase vapour belong to none.
/// Without the field `failed` none is found with `Links::intact`, as it is not known what has broken.
/// @param link distance within which particles are connected, and a failed one belongs to the nearest of them, m
/// @throws InputError if the distance is too small for the extent of the material
Fragments find_fragments(const Snapshot& snapshot, std::span<const BodyInput> bodies, const Frame& frame,
                         double link, Links links = Links::intact);

/// Number and mean mass of the fragments of each body, and the fraction of its mass that belongs to none.
Quantities piece_measures(const Fragments& fragments, std::span<const BodyInput> bodies);

/// Pieces of each body by distance alone, of particles that have failed or not, for links of 1.25, 1.5 and 2 cells: where the
/// numbers agree with each other and with that of the fragments, all gaps are open.
/// @param cell  cell size, m
Table pieces_by_distance(const Snapshot& snapshot, std::span<const BodyInput> bodies, const Frame& frame,
                         double cell);

Table fragment_table(const std::vector<Fragment>& fragments, const Frame& frame);

/// Number N(m) of debris fragments of at least mass m.
Table fragment_distribution(const std::vector<Fragment>& fragments);

/// Exponent b of N(m) ~ m^-b over masses from `least` on and its standard error, by maximum likelihood:
/// b = n / sum ln(m_i / least) (Clauset, Shalizi and Newman, SIAM Rev. 51 (2009) 661, eq. 3.1 with b = alpha
/// - 1), error b / sqrt(number of the fragments in the model): mirror images tell nothing more.
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
