// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "src/core/parallel/mpi.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/material/constitutive.hpp"
#include "src/material/material.hpp"
#include "src/solver/carriers/carrier.hpp"

/// Sums and maxima common to the carriers.
namespace whipple::solver {

/// Returns the maximum speed (m/s) relative to a velocity (m/s).
inline double largest_speed_of(const std::vector<Vector3>& velocity, const Vector3& frame) {
  return std::sqrt(parallel::maximum(velocity.size(), 0.0,
                                     [&](std::size_t p) { return (velocity[p] - frame).squaredNorm(); }));
}

/// Adds the energy that material points can release.
inline void add_releasable_of(const MaterialPoints& points, Releasable& sum) {
  const auto of_mass = [&](std::size_t p) {
    const double c = points.sound_speed[p], work = points.pressure[p] * points.volume[p] / points.mass[p];
    return std::max(points.specific_internal_energy[p], 0.0) +
           (c > 0.0 ? 2.0 * (work / c) * (work / c) : 0.0);
  };
  sum.energy +=
      parallel::sum<double>(points.mass.size(), [&](std::size_t p) { return points.mass[p] * of_mass(p); });
  sum.largest = parallel::maximum(points.mass.size(), sum.largest, of_mass);
}

/// Updates the maximum speed.
inline void add_speeds(const std::vector<Vector3>& velocity, Figures& figures) {
  figures.speed = std::max(figures.speed, largest_speed_of(velocity, Vector3::Zero()));
}

/// Updates the figures with the state of material points.
inline void add_state(const MaterialPoints& points, Figures& figures) {
  const auto largest = [](const std::vector<double>& values, double so_far) {
    return parallel::maximum(values.size(), so_far, [&](std::size_t p) { return values[p]; });
  };
  figures.pressure = largest(points.pressure, figures.pressure);
  figures.temperature = largest(points.temperature, figures.temperature);
  if (const History* stored = points.history.find("stored_cold_work")) {
    const auto& energy = std::get<std::vector<double>>(stored->values);
    figures.stored_cold_work +=
        parallel::sum<double>(energy.size(), [&](std::size_t p) { return points.mass[p] * energy[p]; });
  }
}

/// Holds parts of the internal energy of material points that are not heat (J).
struct EnergyParts {
  double elastic = 0.0, stored = 0.0;
  EnergyParts& operator+=(const EnergyParts& other) {
    elastic += other.elastic;
    stored += other.stored;
    return *this;
  }
};

/// Adds the elastic and the stored energy of material points.
/// @param body_of  body of a point, whose material is that of the same index
template <class BodyOf>
void add_energy_parts(const MaterialPoints& points,
                      std::span<const std::shared_ptr<const Material>> materials, const BodyOf& body_of,
                      Figures& figures) {
  constexpr std::size_t most = material::chunk_size;
  const EnergyParts sum =
      parallel::sum_of_chunks<EnergyParts>(points.mass.size(), [&](std::size_t begin, std::size_t end) {
        EnergyParts of_chunk;
        std::array<double, most> elastic, stored;
        for (std::size_t first = begin, last = begin; first < end; first = last) {
          const std::size_t body = body_of(first), limit = std::min(end, first + most);
          for (last = first + 1; last < limit && body_of(last) == body;) ++last;
          const std::size_t n = last - first;
          const Material& material = *materials[body];
          material.constitutive->divide_energy(material, points, first, std::span(elastic.data(), n),
                                               std::span(stored.data(), n));
          for (std::size_t k = 0; k < n; ++k) {
            of_chunk.elastic += points.mass[first + k] * elastic[k];
            of_chunk.stored += points.mass[first + k] * stored[k];
          }
        }
        return of_chunk;
      });
  figures.elastic_energy += sum.elastic;
  figures.stored_energy += sum.stored;
}

/// Returns the memory of all fields, bytes.
template <class Points>
std::size_t bytes_of(const Points& points) {
  std::size_t bytes = 0;
  for_each_field(points, [&](const auto& field) {
    const auto& values = field.of(points);
    bytes += values.size() * sizeof(values[0]);
  });
  return bytes;
}

/// Visits the element nodes of a body.
template <class Visit>
void visit_nodes(const fem::Nodes& nodes, std::size_t body, const State& state, const Visit& visit) {
  const double sound_speed = state.setup.materials[body]->reference.sound_speed;
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    visit({body, nodes.position[a], nodes.velocity[a], sound_speed, false, nodes.mass[a]});
  }
}

/// Returns the mass (kg) of the nodes of a body in a region; of a node on several ranks the contribution of this one.
inline double mass_of_nodes(const fem::Nodes& nodes, std::size_t body, const cases::LoadedRegion& region) {
  double mass = 0.0;
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    if (region.contains(body, nodes.position[a])) mass += nodes.mass[a];
  }
  return mass;
}

/// Sums a number over all ranks. Collective.
inline std::size_t sum_over_ranks(MPI_Comm communicator, std::size_t of_rank) {
  auto count = static_cast<double>(of_rank);
  parallel::sum(communicator, std::span(&count, 1));
  return static_cast<std::size_t>(count);
}

}  // namespace whipple::solver
