// SPDX-License-Identifier: BSD-3-Clause
#include "src/analysis/fragments.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>

#include "src/analysis/cloud.hpp"
#include "src/analysis/measures.hpp"
#include "src/core/base/error.hpp"
#include "src/core/parallel/threads.hpp"

namespace whipple::analysis {
namespace {

/// Union-find with the least index as root: roots only ever get a smaller parent, so a failed exchange is
/// tried again from the new root and the final components are the same whatever the order.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0U); }

  std::uint32_t find(std::uint32_t i) {
    while (true) {
      const std::uint32_t up = load(i);
      if (up == i) return i;
      const std::uint32_t further = load(up);
      // Halves the path; another thread may have done so already.
      std::uint32_t expected = up;
      at(i).compare_exchange_weak(expected, further, std::memory_order_relaxed);
      i = further;
    }
  }

  void unite(std::uint32_t a, std::uint32_t b) {
    while (true) {
      a = find(a);
      b = find(b);
      if (a == b) return;
      if (a < b) std::swap(a, b);
      std::uint32_t expected = a;
      if (at(a).compare_exchange_strong(expected, b, std::memory_order_relaxed)) return;
    }
  }

 private:
  std::atomic_ref<std::uint32_t> at(std::uint32_t i) { return std::atomic_ref<std::uint32_t>(parent_[i]); }
  std::uint32_t load(std::uint32_t i) { return at(i).load(std::memory_order_relaxed); }
  std::vector<std::uint32_t> parent_;
};

/// Points sorted by cells of edge `size`; cells in the order of their keys.
struct CellList {
  std::vector<std::uint64_t> keys;    ///< of the occupied cells, ascending
  std::vector<std::uint32_t> begins;  ///< of each cell in `order`, one more at the end
  std::vector<std::uint32_t> order;

  /// 21 bits per direction.
  static std::uint64_t key(std::uint64_t x, std::uint64_t y, std::uint64_t z) {
    return (x << 42U) | (y << 21U) | z;
  }

  CellList(std::span<const Vector3> points, double size) : order(points.size()) {
    Vector3 lower = Vector3::Constant(std::numeric_limits<double>::infinity()), upper = -lower;
    for (const Vector3& point : points) {
      lower = lower.cwiseMin(point);
      upper = upper.cwiseMax(point);
    }
    if (((upper - lower).array() / size > 2.0e6).any()) {
      throw InputError("the linking length of the fragments is too small for the extent of the material");
    }
    std::vector<std::uint64_t> of_point(points.size());
    parallel::for_each(points.size(), [&](std::size_t i) {
      // One cell of margin, so that neighbours have keys too.
      const Vector3 cell = ((points[i] - lower) / size).array().floor() + 1.0;
      of_point[i] = key(static_cast<std::uint64_t>(cell.x()), static_cast<std::uint64_t>(cell.y()),
                        static_cast<std::uint64_t>(cell.z()));
    });
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(of_point[a], a) < std::pair(of_point[b], b);
    });
    for (std::uint32_t i = 0; i < order.size(); ++i) {
      if (i > 0 && of_point[order[i]] == keys.back()) continue;
      keys.push_back(of_point[order[i]]);
      begins.push_back(i);
    }
    begins.push_back(static_cast<std::uint32_t>(order.size()));
  }

  [[nodiscard]] std::span<const std::uint32_t> members(std::size_t cell) const {
    return std::span(order).subspan(begins[cell], begins[cell + 1] - begins[cell]);
  }
};

}  // namespace

std::vector<std::uint32_t> connected_components(std::span<const Vector3> points, double distance) {
  std::vector<std::uint32_t> label(points.size());
  if (points.empty()) return label;
  const CellList cells(points, distance);
  DisjointSets sets(points.size());
  const double squared = distance * distance;
  parallel::for_each_chunk(cells.keys.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      const auto mine = cells.members(c);
      const auto link = [&](std::uint32_t a, std::uint32_t b) {
        if ((points[a] - points[b]).squaredNorm() < squared) sets.unite(a, b);
      };
      for (std::size_t i = 0; i < mine.size(); ++i) {
        for (std::size_t j = i + 1; j < mine.size(); ++j) link(mine[i], mine[j]);
      }
      // Half of the 26 neighbours: each pair of cells is met once.
      for (int n = 14; n < 27; ++n) {
        const auto step = [&](int by, unsigned shift) {
          return static_cast<std::uint64_t>(static_cast<std::int64_t>(by)) << shift;
        };
        const std::uint64_t key =
            cells.keys[c] + step(n / 9 - 1, 42U) + step(n / 3 % 3 - 1, 21U) + step(n % 3 - 1, 0U);
        const auto found = std::ranges::lower_bound(cells.keys, key);
        if (found == cells.keys.end() || *found != key) continue;
        const auto theirs = cells.members(static_cast<std::size_t>(found - cells.keys.begin()));
        for (const std::uint32_t a : mine) {
          for (const std::uint32_t b : theirs) link(a, b);
        }
      }
    }
  });
  parallel::for_each(points.size(),
                     [&](std::size_t i) { label[i] = sets.find(static_cast<std::uint32_t>(i)); });
  return label;
}

std::vector<Fragment> find_fragments(const Snapshot& snapshot, const Frame& frame, double link) {
  const std::vector<double>* phase = snapshot.scalar("phase");
  const std::vector<double>* temperature = snapshot.scalar("temperature");
  const std::vector<double>* melted = snapshot.scalar("melted_fraction");
  const std::vector<double>* energy = snapshot.scalar("internal_energy");
  const std::vector<double> volume = snapshot.volumes();
  std::vector<std::uint32_t> condensed;
  std::vector<Vector3> points;
  for (std::uint32_t i = 0; i < snapshot.size(); ++i) {
    if (phase != nullptr && (*phase)[i] == 3.0) continue;
    condensed.push_back(i);
    points.push_back(snapshot.position[i]);
  }
  const std::vector<std::uint32_t> label = connected_components(points, link);
  // Members of one fragment behind each other, in the order of the particle numbers.
  std::vector<std::uint32_t> order(label.size()), begins;
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return label[a] < label[b]; });
  for (std::uint32_t k = 0; k < order.size(); ++k) {
    if (k == 0 || label[order[k]] != label[order[k - 1]]) begins.push_back(k);
  }
  std::vector<Fragment> fragments(begins.size());
  begins.push_back(static_cast<std::uint32_t>(order.size()));
  parallel::for_each_chunk(fragments.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      Fragment& fragment = fragments[f];
      std::vector<double> by_body;
      std::array<double, 3> to_plane{nan, nan, nan};
      double heat = 0.0, melt = 0.0, internal = 0.0;
      for (std::uint32_t k = begins[f]; k < begins[f + 1]; ++k) {
        const std::uint32_t i = condensed[order[k]];
        const double m = snapshot.mass[i];
        ++fragment.particles;
        fragment.mass += m;
        fragment.position += m * snapshot.position[i];
        fragment.velocity += m * snapshot.velocity[i];
        fragment.volume += volume[i];
        heat += temperature != nullptr ? m * (*temperature)[i] : nan;
        melt += melted != nullptr ? m * (*melted)[i] : nan;
        internal += energy != nullptr ? m * (*energy)[i] : nan;
        if (by_body.size() <= snapshot.body[i]) by_body.resize(snapshot.body[i] + 1U);
        by_body[snapshot.body[i]] += m;
        for (std::size_t p = 0; p < frame.planes.size(); ++p) {
          const double distance =
              std::abs(snapshot.position[i][frame.planes[p].axis] - frame.planes[p].position);
          to_plane[p] = std::isnan(to_plane[p]) ? distance : std::min(to_plane[p], distance);
        }
      }
      fragment.temperature = heat / fragment.mass;
      fragment.melted_fraction = melt / fragment.mass;
      fragment.internal_energy = internal / fragment.mass;
      fragment.position /= fragment.mass;
      fragment.velocity /= fragment.mass;
      fragment.body = static_cast<std::uint16_t>(std::ranges::max_element(by_body) - by_body.begin());
      for (std::size_t p = 0; p < frame.planes.size(); ++p) {
        // A fragment and its image within the linking length are one: half of it was in the model.
        if (2.0 * to_plane[p] >= link) {
          fragment.copies *= 2.0;
          continue;
        }
        fragment.mass *= 2.0;
        fragment.volume *= 2.0;
        fragment.position[frame.planes[p].axis] = frame.planes[p].position;
        fragment.velocity[frame.planes[p].axis] = 0.0;
      }
      fragment.debris = frame.axial(fragment.velocity) > frame.debris_speed();
    }
  });
  std::ranges::stable_sort(fragments, std::greater{}, &Fragment::mass);
  return fragments;
}

Table fragment_table(const std::vector<Fragment>& fragments, const Frame& frame) {
  Table table{.name = "fragments",
              .meaning = "connected pieces of condensed material at the last snapshot, by decreasing mass",
              .label = {},
              .labels = {},
              .columns = {}};
  for (const Fragment& f : fragments) {
    const Vector3 offset = f.position - frame.centre;
    table.append({{"mass", "kg",
                   "of one fragment, completed at mirror planes; in axisymmetry of the whole ring", f.mass},
                  {"copies", "1", "such fragments in the full problem", f.copies},
                  {"particles", "1", "particles in the model", static_cast<double>(f.particles)},
                  {"body", "1", "body of the largest fraction of the mass", static_cast<double>(f.body)},
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
    number += fragments[i].copies;
    mass += fragments[i].copies * fragments[i].mass;
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
  double count = 0.0, logarithms = 0.0;
  for (const auto& [mass, copies] : mass_and_copies) {
    if (mass < least) continue;
    count += copies;
    logarithms += copies * std::log(mass / least);
  }
  if (!(logarithms > 0.0)) return {nan, nan, count};
  const double value = count / logarithms;
  return {value, value / std::sqrt(count), count};
}

Quantities fragment_measures(const std::vector<Fragment>& fragments, double projectile_mass,
                             double particle_mass) {
  std::vector<std::pair<double, double>> debris;
  double number = 0.0, mass = 0.0, resolved = 0.0;
  for (const Fragment& f : fragments) {
    if (!f.debris) continue;
    debris.emplace_back(f.mass, f.copies);
    number += f.copies;
    if (f.particles >= 8) resolved += f.copies;
    mass += f.copies * f.mass;
  }
  const double largest = debris.empty() ? 0.0 : debris.front().first;
  // Masses are multiples of that of a particle: half of one below the least takes the place of the sum over
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
