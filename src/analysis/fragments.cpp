// SPDX-License-Identifier: BSD-3-Clause
#include "src/analysis/fragments.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "src/analysis/cloud.hpp"
#include "src/analysis/measures.hpp"
#include "src/analysis/pieces.hpp"
#include "src/core/parallel/threads.hpp"

namespace whipple::analysis {
namespace {

/// Holds the fields that fragments are computed from; nullptr if not written.
struct Written {
  const Snapshot& snapshot;
  Links links;
  const std::vector<double>* phase = snapshot.scalar("phase");
  const std::vector<double>* failed = snapshot.scalar("failed");
  const std::vector<double>* temperature = snapshot.scalar("temperature");
  const std::vector<double>* melted = snapshot.scalar("melted_fraction");
  const std::vector<double>* energy = snapshot.scalar("internal_energy");
  std::vector<double> volume = snapshot.volumes();

  [[nodiscard]] bool has_failed(std::uint32_t i) const {
    return links == Links::intact && failed != nullptr && (*failed)[i] > 0.0;
  }
};

/// Sums up a piece and completes it at the mirror planes that it touches.
Fragment sum_up(std::span<const std::uint32_t> members, const Written& fields, const Frame& frame,
                double link) {
  const Snapshot& snapshot = fields.snapshot;
  Fragment fragment;
  std::array<double, 3> to_plane{nan, nan, nan};
  double heat = 0.0, melt = 0.0, internal = 0.0;
  for (const std::uint32_t i : members) {
    const double m = snapshot.mass[i];
    ++fragment.particles;
    fragment.mass += m;
    fragment.position += m * snapshot.position[i];
    fragment.velocity += m * snapshot.velocity[i];
    fragment.volume += fields.volume[i];
    heat += fields.temperature != nullptr ? m * (*fields.temperature)[i] : nan;
    melt += fields.melted != nullptr ? m * (*fields.melted)[i] : nan;
    internal += fields.energy != nullptr ? m * (*fields.energy)[i] : nan;
    if (fields.has_failed(i)) continue;
    ++fragment.intact;
    for (std::size_t p = 0; p < frame.cuts.size(); ++p) {
      const double distance = std::abs(snapshot.position[i][frame.cuts[p].axis] - frame.cuts[p].position);
      to_plane[p] = std::isnan(to_plane[p]) ? distance : std::min(to_plane[p], distance);
    }
  }
  fragment.body = snapshot.body[members.front()];
  fragment.temperature = heat / fragment.mass;
  fragment.melted_fraction = melt / fragment.mass;
  fragment.internal_energy = internal / fragment.mass;
  fragment.position /= fragment.mass;
  fragment.velocity /= fragment.mass;
  for (std::size_t p = 0; p < frame.cuts.size(); ++p) {
    // A fragment within the linking length of its image is connected to it: half of the fragment was in the model.
    if (2.0 * to_plane[p] >= link) {
      fragment.copies *= 2.0;
      if (frame.cuts[p].axis != frame.axis) fragment.forward *= 2.0;
      continue;
    }
    fragment.mass *= 2.0;
    fragment.volume *= 2.0;
    fragment.position[frame.cuts[p].axis] = frame.cuts[p].position;
    fragment.velocity[frame.cuts[p].axis] = 0.0;
  }
  fragment.debris = frame.axial(fragment.velocity) > frame.debris_speed();
  return fragment;
}

}  // namespace

Fragments find_fragments(const Snapshot& snapshot, std::span<const BodyInput> bodies, const Frame& frame,
                         double link, Links links) {
  const Written fields{snapshot, links};
  Fragments found;
  found.of_body.resize(bodies.size());
  std::vector<std::vector<std::uint32_t>> condensed(bodies.size());
  for (std::uint32_t i = 0; i < snapshot.size(); ++i) {
    const std::uint16_t b = snapshot.body[i];
    found.of_body[b].mass += frame.images() * snapshot.mass[i];
    // Gases and vapour form no pieces.
    if (!bodies[b].condensed || (fields.phase != nullptr && (*fields.phase)[i] == 3.0)) continue;
    condensed[b].push_back(i);
  }
  if (links == Links::intact && fields.failed == nullptr) {
    found.unknown = "the snapshots have no field \"failed\"";
    return found;
  }
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const std::vector<std::uint32_t>& mine = condensed[b];
    std::vector<Vector3> points;
    std::vector<bool> failed;
    for (const std::uint32_t i : mine) {
      points.push_back(snapshot.position[i]);
      failed.push_back(fields.has_failed(i));
    }
    const std::vector<std::uint32_t> piece = pieces_of(points, failed, link);
    // Groups the members of each piece, in the order of the particle numbers, with loose particles at the end.
    std::vector<std::uint32_t> order(mine.size()), begins, members;
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](auto x, auto y) { return piece[x] < piece[y]; });
    std::uint32_t connected = 0;
    for (; connected < order.size() && piece[order[connected]] != loose; ++connected) {
      if (connected == 0 || piece[order[connected]] != piece[order[connected - 1]])
        begins.push_back(connected);
    }
    for (const std::uint32_t k : order) members.push_back(mine[k]);
    std::vector<Fragment> all(begins.size());
    begins.push_back(connected);
    parallel::for_each_chunk(all.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f) {
        all[f] =
            sum_up(std::span(members).subspan(begins[f], begins[f + 1] - begins[f]), fields, frame, link);
      }
    });
    OfBody& of = found.of_body[b];
    for (std::uint32_t k = connected; k < members.size(); ++k) {
      of.loose += frame.images() * snapshot.mass[members[k]];
    }
    for (const Fragment& fragment : all) {
      const double in_all = fragment.copies * fragment.mass;
      // A fragment on a mirror plane has as many particles again beyond it.
      if (static_cast<double>(fragment.intact) * frame.images() / fragment.copies < least_particles) {
        of.loose += in_all;
        continue;
      }
      of.pieces += fragment.copies;
      of.connected += in_all;
      found.list.push_back(fragment);
    }
  }
  std::ranges::stable_sort(found.list, std::greater{}, &Fragment::mass);
  return found;
}

Quantities piece_measures(const Fragments& fragments, std::span<const BodyInput> bodies) {
  Quantities row;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const OfBody& of = fragments.of_body[b];
    const bool there = bodies[b].condensed && of.mass > 0.0 && fragments.unknown.empty();
    const std::string reason = bodies[b].condensed ? fragments.unknown : "a gas has no fragments";
    row.push_back(measured("piece_count", bodies[b].name, there ? of.pieces : nan, reason));
    row.push_back(measured("piece_mass", bodies[b].name, there ? of.connected / of.pieces : nan, reason));
    row.push_back(measured("loose_fraction", bodies[b].name, there ? of.loose / of.mass : nan, reason));
    std::vector<std::pair<double, double>> masses;
    for (const Fragment& f : fragments.list) {
      if (f.body == b && there) masses.emplace_back(f.mass, f.copies);
    }
    const Weibull weibull = weibull_distribution(masses);
    row.push_back(measured("piece_exponent", bodies[b].name, weibull.exponent, reason));
    row.push_back(measured("piece_exponent_error", bodies[b].name, weibull.error, reason));
    row.push_back(measured("piece_scale", bodies[b].name, weibull.scale, reason));
  }
  return row;
}

Quantities fragment_size_measures(const Snapshot& snapshot, std::span<const BodyInput> bodies) {
  const std::vector<double>* size = snapshot.scalar("fragment_size");
  if (size == nullptr) return {};
  std::vector<std::vector<std::pair<double, double>>> of_body(bodies.size());
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    if ((*size)[i] > 0.0) of_body[snapshot.body[i]].emplace_back((*size)[i], snapshot.mass[i]);
  }
  Quantities row;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    row.push_back(measured("fragment_size", bodies[b].name, weighted_quantile(of_body[b], 0.5)));
    row.push_back(measured("fragment_size_16", bodies[b].name, weighted_quantile(of_body[b], 0.16)));
    row.push_back(measured("fragment_size_84", bodies[b].name, weighted_quantile(of_body[b], 0.84)));
  }
  return row;
}

Table pieces_by_distance(const Snapshot& snapshot, std::span<const BodyInput> bodies, const Frame& frame,
                         double cell) {
  Table table{.name = "pieces_by_distance",
              .meaning = "connected pieces of all particles at the last snapshot, failed or not",
              .label = "body",
              .labels = {},
              .columns = {}};
  for (const double link : {1.25, 1.5, 2.0}) {
    const Fragments found = find_fragments(snapshot, bodies, frame, link * cell, Links::nearness);
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      if (!bodies[b].condensed) continue;
      const OfBody& of = found.of_body[b];
      table.append({{"link", "1", "distance within which particles are connected, in cells", link},
                    {"pieces", "1", "pieces of at least four particles", of.pieces},
                    {"loose_fraction", "1", "fraction of the mass in smaller ones", of.loose / of.mass}},
                   bodies[b].name);
    }
  }
  return table;
}

Table fragment_table(const std::vector<Fragment>& fragments, const Frame& frame) {
  Table table{.name = "fragments",
              .meaning = "fragments of the bodies at the last snapshot, by decreasing mass",
              .label = {},
              .labels = {},
              .columns = {}};
  for (const Fragment& f : fragments) {
    const Vector3 offset = f.position - frame.centre;
    table.append({{"mass", "kg",
                   "of one fragment, completed at mirror planes; in axisymmetry of the whole ring", f.mass},
                  {"copies", "1", "such fragments in the full problem", f.copies},
                  {"particles", "1", "particles in the model", static_cast<double>(f.particles)},
                  {"intact", "1", "those that have not failed", static_cast<double>(f.intact)},
                  {"body", "1", "number of the body in the case, from 0", static_cast<double>(f.body)},
                  {"debris", "1", "1: faster forward than 5 % of the impact speed", f.debris ? 1.0 : 0.0},
                  {"axial", "m", "axial coordinate of the centre of mass", frame.axial(offset)},
                  {"radius", "m", "distance of the centre of mass from the axis", frame.radius(f.position)},
                  {"x", "m", "centre of mass", f.position.x()},
                  {"y", "m", "centre of mass", f.position.y()},
                  {"z", "m", "centre of mass", f.position.z()},
                  {"velocity_x", "m/s", "velocity of the centre of mass", f.velocity.x()},
                  {"velocity_y", "m/s", "velocity of the centre of mass", f.velocity.y()},
                  {"velocity_z", "m/s", "velocity of the centre of mass", f.velocity.z()},
                  {"diameter", "m", "of the sphere of the same volume",
                   frame.is_planar() ? nan : 2.0 * std::cbrt(f.volume * 0.238732414637843)},
                  {"temperature", "K", "mean by mass", f.temperature},
                  {"melted_fraction", "1", "mass fraction of liquid and vapour", f.melted_fraction},
                  {"internal_energy", "J/kg", "mean by mass", f.internal_energy}});
  }
  return table;
}

Table fragment_distribution(const std::vector<Fragment>& fragments) {
  Table table{.name = "fragment_distribution",
              .meaning = "number of debris fragments of at least a mass",
              .label = {},
              .labels = {},
              .columns = {}};
  double number = 0.0, mass = 0.0;
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    if (!fragments[i].debris) continue;
    number += fragments[i].forward;
    mass += fragments[i].forward * fragments[i].mass;
    const auto next = std::find_if(fragments.begin() + static_cast<std::ptrdiff_t>(i) + 1, fragments.end(),
                                   [](const Fragment& f) { return f.debris; });
    if (next != fragments.end() && next->mass == fragments[i].mass) continue;  // one row per mass
    table.append({{"mass", "kg", "mass m of a fragment", fragments[i].mass},
                  {"number", "1", "fragments of at least m", number},
                  {"cumulative_mass", "kg", "mass of fragments of at least m", mass}});
  }
  return table;
}

Exponent distribution_exponent(std::span<const std::pair<double, double>> mass_and_copies, double least) {
  double count = 0.0, logarithms = 0.0, independent = 0.0;
  for (const auto& [mass, copies] : mass_and_copies) {
    if (mass < least) continue;
    independent += 1.0;
    count += copies;
    logarithms += copies * std::log(mass / least);
  }
  if (!(logarithms > 0.0)) return {nan, nan, count};
  const double value = count / logarithms;
  return {value, value / std::sqrt(independent), count};
}

Weibull weibull_distribution(std::span<const std::pair<double, double>> mass_and_copies) {
  if (mass_and_copies.size() < 3) return {nan, nan, nan};
  const double largest =
      std::ranges::max_element(mass_and_copies, {}, &std::pair<double, double>::first)->first;
  double count = 0.0, squares = 0.0, logarithms = 0.0;
  for (const auto& [mass, copies] : mass_and_copies) {
    count += copies;
    squares += copies * copies;
    logarithms += copies * std::log(mass / largest);
  }
  double power = 0.0;  // sum c m^b at the last b
  const auto excess = [&](double b) {
    double moment = 0.0;
    power = 0.0;
    for (const auto& [mass, copies] : mass_and_copies) {
      const double of_one = copies * std::pow(mass / largest, b);
      power += of_one;
      moment += of_one * std::log(mass / largest);
    }
    return moment / power - 1.0 / b - logarithms / count;
  };
  double lower = 0.05, upper = 50.0;  // increases with b
  if (!(excess(lower) < 0.0 && excess(upper) > 0.0))
    return {nan, nan, nan};  // equal masses have no greatest likelihood
  for (int iteration = 0; iteration < 60; ++iteration) {
    const double b = 0.5 * (lower + upper);
    (excess(b) < 0.0 ? lower : upper) = b;
  }
  const double b = 0.5 * (lower + upper);
  excess(b);
  return {b, b * std::sqrt(6.0 * squares) / (std::numbers::pi * count),
          largest * std::pow(power / count, 1.0 / b)};
}

Quantities fragment_measures(const std::vector<Fragment>& fragments, double projectile_mass,
                             double particle_mass) {
  std::vector<std::pair<double, double>> debris;
  double number = 0.0, mass = 0.0, resolved = 0.0;
  for (const Fragment& f : fragments) {
    if (!f.debris) continue;
    debris.emplace_back(f.mass, f.forward);
    number += f.forward;
    if (f.particles >= 8) resolved += f.forward;
    mass += f.forward * f.mass;
  }
  const double largest = debris.empty() ? 0.0 : debris.front().first;
  // Masses are multiples of the particle mass; a minimum smaller by half a particle mass approximates the sum over
  // multiples (Clauset et al., eq. 3.7).
  const std::span<const std::pair<double, double>> smaller =
      debris.empty() ? std::span<const std::pair<double, double>>{} : std::span(debris).subspan(1);
  const Exponent exponent = distribution_exponent(smaller, 7.5 * particle_mass);
  return {measured("debris_fragments", number),
          measured("debris_fragments_resolved", resolved),
          measured("largest_fragment", debris.empty() ? nan : largest),
          measured("largest_fragment_over_projectile", debris.empty() ? nan : largest / projectile_mass),
          measured("mean_fragment", number > 0.0 ? mass / number : nan),
          measured("fragment_exponent", exponent.value),
          measured("fragment_exponent_error", exponent.error)};
}

}  // namespace whipple::analysis
