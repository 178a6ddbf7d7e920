// SPDX-License-Identifier: BSD-3-Clause
#include "src/fem/bars.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "src/core/base/error.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/fem/lists.hpp"

namespace whipple::fem {
namespace {

bool is_hoop(const Bars& bars, std::size_t b) { return bars.elements.ends[b][0] == bars.elements.ends[b][1]; }

/// Returns the difference of a field at the two ends; for a hoop its radial part, the difference from the axis.
Vector3 between_ends(const Bars& bars, std::size_t b, const std::vector<Vector3>& field) {
  const auto& ends = bars.elements.ends[b];
  if (is_hoop(bars, b)) return {0.0, field[ends[1]][1], 0.0};
  return field[ends[1]] - field[ends[0]];
}

Vector3 along(const Bars& bars, std::size_t b) { return between_ends(bars, b, bars.nodes.position); }

/// Returns the length of a bar or the circumference of a hoop, m.
double length_of(const Bars& bars, std::size_t b) {
  return (is_hoop(bars, b) ? 2.0 * std::numbers::pi : 1.0) * along(bars, b).norm();
}

/// Returns the initial volume, m^3.
double volume(const Bars& bars, std::size_t b) { return bars.elements.mass[b] / bars.material.density; }

/// Returns the elastic energy of a bar, J.
double elastic_energy(const Bars& bars, std::size_t b) {
  return bars.elements.stress[b] * bars.elements.stress[b] / (2.0 * bars.material.young) * volume(bars, b);
}

/// Computes the stress at the end of a step from the logarithmic strain increment: elastic trial, return to the yield
/// stress (eq. 6.2).
/// @returns the work that becomes heat, J
double update_stress(Bars& bars, std::size_t b, double strain_increment) {
  BarElements& e = bars.elements;
  const BarMaterial& m = bars.material;
  if (e.broken[b] != 0) return 0.0;
  const double trial = e.stress[b] + m.young * strain_increment;
  const double excess = std::abs(trial) - (m.yield_stress + m.hardening_modulus * e.plastic_strain[b]);
  if (!(excess > 0.0)) {
    e.stress[b] = trial;
    return 0.0;
  }
  const double plastic = excess / (m.young + m.hardening_modulus);
  e.stress[b] = trial - std::copysign(m.young * plastic, trial);
  e.plastic_strain[b] += plastic;
  double heat = std::abs(e.stress[b]) * plastic * volume(bars, b);
  if (e.plastic_strain[b] > m.failure_strain) {
    e.broken[b] = 1;
    heat += elastic_energy(bars, b);
    e.stress[b] = 0.0;  // the elastic energy becomes heat; the internal energy is unchanged
  }
  return heat;
}

}  // namespace

Bars make_bars(const Lines& lines, double area, const BarMaterial& material, const std::string& name,
               std::uint32_t body, std::uint64_t first_node_id, std::uint64_t first_element_id) {
  if (lines.elements.empty()) throw InputError(name + ": there are no bars");
  for (const auto& [what, value] :
       {std::pair{"density", material.density}, std::pair{"Young's modulus", material.young},
        std::pair{"yield stress", material.yield_stress}, std::pair{"cross-section", area}}) {
    if (!(value > 0.0))
      throw InputError(fmt::format("{}: the {} of bars must be positive, not {:.6g}", name, what, value));
  }
  if (!(material.hardening_modulus >= 0.0) || !(material.failure_strain > 0.0)) {
    throw InputError(name + ": bars need a hardening modulus of at least 0 and a positive failure strain");
  }
  Bars bars;
  bars.material = material;
  bars.body = body;
  resize(bars.nodes, lines.nodes.size());
  resize(bars.elements, lines.elements.size());
  std::iota(bars.nodes.id.begin(), bars.nodes.id.end(), first_node_id);
  std::iota(bars.elements.id.begin(), bars.elements.id.end(), first_element_id);
  bars.nodes.position = lines.nodes;
  for (auto* zero : {&bars.nodes.velocity, &bars.nodes.force, &bars.nodes.prescribed}) {
    std::ranges::fill(*zero, Vector3::Zero());
  }
  bars.elements.ends = lines.elements;
  for (std::size_t b = 0; b < bars.elements.size(); ++b) {
    for (const std::uint32_t node : lines.elements[b]) {
      if (node >= lines.nodes.size()) {
        throw InputError(fmt::format("{}: bar {}: node {} does not exist, there are {}", name, b, node,
                                     lines.nodes.size()));
      }
    }
    const double length = length_of(bars, b);
    if (!(length > 0.0) || !std::isfinite(length))
      throw InputError(fmt::format("{}: bar {} has no length", name, b));
    bars.elements.reference_length[b] = length;
    bars.elements.mass[b] = material.density * area * length * lines.number[b];
  }
  connect(bars);
  lump_masses(bars);
  const auto unused = std::ranges::find(bars.nodes.mass, 0.0);
  if (unused != bars.nodes.mass.end()) {
    throw InputError(fmt::format("{}: node {} belongs to no bar", name, unused - bars.nodes.mass.begin()));
  }
  return bars;
}

void connect(Bars& bars) {
  const auto& ends = bars.elements.ends;
  list_by_item(
      ends.empty() ? std::span<const std::uint32_t>() : std::span(ends.front().data(), 2 * ends.size()),
      bars.nodes.size(), bars.first_end, bars.node_ends);
  bars.axial_force.resize(ends.size());
}

void lump_masses(Bars& bars) {
  std::ranges::fill(bars.nodes.mass, 0.0);
  for (std::size_t b = 0; b < bars.elements.size(); ++b) {
    for (const std::uint32_t a : bars.elements.ends[b]) bars.nodes.mass[a] += 0.5 * bars.elements.mass[b];
  }
}

double critical_time_step(const Bars& bars) {
  const double speed = std::sqrt(bars.material.young / bars.material.density);
  return 1.0 / parallel::maximum(bars.elements.size(), 0.0, [&](std::size_t b) {
           return bars.elements.broken[b] != 0 ? 0.0 : speed / along(bars, b).norm();
         });
}

double internal_forces(Bars& bars) {
  parallel::for_each(bars.elements.size(), [&](std::size_t b) {
    const Vector3 x = along(bars, b);
    bars.axial_force[b] = (-bars.elements.stress[b] * volume(bars, b) / x.squaredNorm()) * x;
  });
  parallel::for_each(bars.nodes.size(), [&](std::size_t a) {
    Vector3 force = Vector3::Zero();
    for (std::uint32_t k = bars.first_end[a]; k < bars.first_end[a + 1]; ++k) {
      const std::uint32_t end = bars.node_ends[k];
      if (end % 2 == 0 && is_hoop(bars, end / 2)) continue;  // the first end is the axis
      force += (end % 2 == 1 ? 1.0 : -1.0) * bars.axial_force[end / 2];
    }
    bars.nodes.force[a] = force;
  });
  return parallel::sum<double>(
      bars.elements.size(), [&](std::size_t b) { return is_hoop(bars, b) ? bars.axial_force[b][1] : 0.0; });
}

BarWork deform(Bars& bars, const Motion& motion, double dt) {
  if (motion.end.size() != bars.nodes.size() || motion.mean.size() != bars.nodes.size()) {
    throw InternalError("fem::deform: velocities do not fit the bars");
  }
  return parallel::sum<BarWork>(bars.elements.size(), [&](std::size_t b) {
    const Vector3 x = along(bars, b);
    const Vector3 end = x + dt * between_ends(bars, b, motion.end);
    const double rate = x.dot(between_ends(bars, b, motion.mean)) / x.squaredNorm();  // of the strain
    const double work = dt * volume(bars, b) * bars.elements.stress[b] * rate;
    bars.elements.internal_energy[b] += work;
    const double strain = 0.5 * std::log(end.squaredNorm() / x.squaredNorm());
    return BarWork{work, update_stress(bars, b, strain)};
  });
}

void add_heat(Bars& bars, std::span<const double> node_heat) {
  parallel::for_each(bars.elements.size(), [&](std::size_t b) {
    for (const std::uint32_t a : bars.elements.ends[b]) {
      bars.elements.internal_energy[b] += 0.5 * bars.elements.mass[b] / bars.nodes.mass[a] * node_heat[a];
    }
  });
}

void remove_bars(Bars& bars, std::span<const std::uint8_t> removed) {
  std::vector<std::uint32_t> kept_bars, kept_nodes, number(bars.nodes.size(), 0);
  std::vector<std::uint8_t> used(bars.nodes.size(), 0);
  for (std::uint32_t b = 0; b < removed.size(); ++b) {
    if (removed[b] != 0) continue;
    kept_bars.push_back(b);
    for (const std::uint32_t a : bars.elements.ends[b]) used[a] = 1;
  }
  for (std::uint32_t a = 0; a < bars.nodes.size(); ++a) {
    if (used[a] == 0) continue;
    number[a] = static_cast<std::uint32_t>(kept_nodes.size());
    kept_nodes.push_back(a);
  }
  const auto keep = [](auto& points, const std::vector<std::uint32_t>& kept) {
    for_each_field(points, [&](const auto& field) {
      auto& values = field.of(points);
      for (std::size_t i = 0; i < kept.size(); ++i) values[i] = values[kept[i]];
      values.resize(kept.size());
    });
  };
  keep(bars.elements, kept_bars);
  keep(bars.nodes, kept_nodes);
  for (auto& ends : bars.elements.ends) ends = {number[ends[0]], number[ends[1]]};
  connect(bars);
  lump_masses(bars);
}

double elastic_energy(const Bars& bars) {
  return parallel::sum<double>(bars.elements.size(), [&](std::size_t b) { return elastic_energy(bars, b); });
}

double internal_energy(const Bars& bars) {
  return parallel::sum<double>(bars.elements.size(),
                               [&](std::size_t b) { return bars.elements.internal_energy[b]; });
}

}  // namespace whipple::fem
