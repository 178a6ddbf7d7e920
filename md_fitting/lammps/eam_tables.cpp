// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/lammps/eam_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/core/base/error.hpp"

namespace whipple::md {
namespace {

/// Interpolates cubically through the four nearest points of an equidistant table; beyond the end it extrapolates
/// with the last slope, as LAMMPS does.
double interpolate(const std::vector<double>& table, double step, double x) {
  const double position = x / step;
  const auto last = static_cast<double>(table.size() - 1);
  if (position >= last) {
    const std::size_t n = table.size();
    return table[n - 1] + (table[n - 1] - table[n - 2]) * (position - last);
  }
  const double first = std::clamp(std::floor(position) - 1.0, 0.0, last - 3.0);
  const auto i = static_cast<std::size_t>(first);
  const double t = position - first;
  return table[i] * (t - 1) * (t - 2) * (t - 3) / -6.0 + table[i + 1] * t * (t - 2) * (t - 3) / 2.0 +
         table[i + 2] * t * (t - 1) * (t - 3) / -2.0 + table[i + 3] * t * (t - 1) * (t - 2) / 6.0;
}

/// Calls visit(r) for every neighbour within the cutoff of an atom of the crystal.
template <class Visit>
void for_each_neighbour(const EamTables& tables, double a, const Visit& visit) {
  // Cubic lattices in units of a/2: fcc has all sites with an even sum of the coordinates, bcc all sites
  // whose coordinates are all even or all odd.
  const bool fcc = tables.structure == CrystalStructure::fcc;
  const int reach = static_cast<int>(std::ceil(2.0 * tables.cutoff / a));
  for (int x = -reach; x <= reach; ++x) {
    for (int y = -reach; y <= reach; ++y) {
      for (int z = -reach; z <= reach; ++z) {
        const bool site = fcc ? (x + y + z) % 2 == 0 : (x - y) % 2 == 0 && (y - z) % 2 == 0;
        const double r = 0.5 * a * std::sqrt(static_cast<double>(x * x + y * y + z * z));
        if (site && r > 0.0 && r < tables.cutoff) visit(r);
      }
    }
  }
}

/// Calls visit(r) for every neighbour within the cutoff (A) of an atom of hcp with the ideal axial ratio: layers
/// ABAB, each a triangular lattice of distance d (A).
template <class Visit>
void for_each_hexagonal_neighbour(double cutoff, double d, const Visit& visit) {
  const int reach = static_cast<int>(std::ceil(1.3 * cutoff / d)) + 1;
  for (int layer = -reach; layer <= reach; ++layer) {
    const double shift = layer % 2 == 0 ? 0.0 : 1.0 / 3.0;  // of both lattice vectors
    for (int i = -reach; i <= reach; ++i) {
      for (int j = -reach; j <= reach; ++j) {
        const double u = i + shift, v = j + shift, w = layer * std::sqrt(2.0 / 3.0);
        const double r = d * std::sqrt(u * u + u * v + v * v + w * w);
        if (r > 1e-6 * d && r < cutoff) visit(r);
      }
    }
  }
}

}  // namespace

double EamTables::density_end() const { return density_step * static_cast<double>(embedding.size() - 1); }

double EamTables::hexagonal_energy(double volume) const {
  const double d = std::cbrt(std::sqrt(2.0) * volume);
  double sum = 0.0;
  double pair = 0.0;
  for_each_hexagonal_neighbour(cutoff, d, [&](double r) {
    sum += interpolate(density, radius_step, r);
    pair += interpolate(radius_times_pair, radius_step, r) / r;
  });
  return interpolate(embedding, density_step, sum) + 0.5 * pair;
}

double EamTables::crystal_density(double a) const {
  double sum = 0.0;
  for_each_neighbour(*this, a, [&](double r) { sum += interpolate(density, radius_step, r); });
  return sum;
}

double EamTables::crystal_energy(double a) const {
  double pair = 0.0;
  for_each_neighbour(*this, a, [&](double r) { pair += interpolate(radius_times_pair, radius_step, r) / r; });
  return interpolate(embedding, density_step, crystal_density(a)) + 0.5 * pair;
}

double EamTables::static_lattice_constant() const {
  double lower = header_lattice_constant > 0.0 ? 0.85 * header_lattice_constant : 2.0;
  double upper = header_lattice_constant > 0.0 ? 1.15 * header_lattice_constant : 8.0;
  // A coarse search brackets the minimum energy, because the cutoff causes shallow secondary minima.
  constexpr int samples = 240;
  const double step = (upper - lower) / samples;
  int best = 0;
  double least = crystal_energy(lower);
  for (int i = 1; i <= samples; ++i) {
    const double energy = crystal_energy(lower + i * step);
    if (energy < least) least = energy, best = i;
  }
  if (best == 0 || best == samples) {
    throw InputError(
        fmt::format("the static {} crystal of {} has no energy minimum for lattice constants {} ... {} A",
                    word_of(structure), element, lower, upper));
  }
  upper = lower + (best + 1) * step;
  lower = lower + (best - 1) * step;
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  while (upper - lower > 1e-7) {
    const double left = upper - golden * (upper - lower);
    const double right = lower + golden * (upper - lower);
    (crystal_energy(left) < crystal_energy(right) ? upper : lower) =
        crystal_energy(left) < crystal_energy(right) ? right : left;
  }
  return 0.5 * (lower + upper);
}

double EamTables::volume_ratio_at(double target) const {
  const double a0 = static_lattice_constant();
  double inside = a0;
  double outside = a0 * std::cbrt(0.1);
  if (crystal_density(inside) >= target) return 1.0;
  if (crystal_density(outside) < target) return 0.0;
  while (inside - outside > 1e-6 * a0) {
    const double middle = 0.5 * (inside + outside);
    (crystal_density(middle) < target ? inside : outside) = middle;
  }
  return std::pow(inside / a0, 3);
}

}  // namespace whipple::md
