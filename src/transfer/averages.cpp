// SPDX-License-Identifier: BSD-3-Clause
#include "src/transfer/averages.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "src/core/parallel/threads.hpp"

namespace whipple::transfer {
namespace {

using grid::BlockGrid;
using Members = std::span<const std::uint32_t>;

/// Averages quantities by volume over the cells of a slot. Lane 0 of the quantities of a particle is 1, so that lane 0
/// of a sum is the volume.
class CellMeans {
 public:
  explicit CellMeans(const BlockGrid& grid)
      : places_(grid.places(BlockGrid::Points::particles)), stencil_(grid.stencil()) {}

  /// Adds the quantities of the members, times volume, to the sums of their cells.
  /// @param quantities  quantities(k): those of member k
  template <class Quantities>
  void add(std::span<Lanes> sums, const Particles& particles, Members members,
           Quantities&& quantities) const {
    for (std::size_t k = 0; k < members.size(); ++k) {
      sums[cell(members[k])] += particles.volume[members[k]] * quantities(k);
    }
  }
  /// Calls use(k, means) with the means of the cell of each member.
  template <class Use>
  void use(std::span<const Lanes> sums, Members members, Use&& use) const {
    std::array<Lanes, grid::nodes_per_block> means;
    for (std::size_t i = 0; i < sums.size(); ++i) {
      if (sums[i][0] > 0.0) means[i] = sums[i] / broadcast(sums[i][0]);
    }
    for (std::size_t k = 0; k < members.size(); ++k) use(k, means[cell(members[k])]);
  }
  /// Does both, with sums over the members alone.
  template <class Quantities, class Use>
  void average(const Particles& particles, Members members, Quantities&& quantities, Use&& use) const {
    std::array<Lanes, grid::nodes_per_block> sums{};
    add(sums, particles, members, quantities);
    this->use(sums, members, use);
  }

 private:
  /// Returns the number of the cell of a particle in its block.
  [[nodiscard]] std::size_t cell(std::uint32_t p) const {
    const std::array<int, 3> first = places_[p].first_node(stencil_);
    const auto along = [&](std::size_t a) {
      return stencil_.planar && a == 2 ? 0 : first[a] + static_cast<int>(places_[p].from_first(a));
    };
    return static_cast<std::size_t>(stencil_.block().node(along(0), along(1), along(2)));
  }

  std::span<const grid::PlaceInStencil> places_;
  grid::Stencil stencil_;
};

/// Holds the particles of an averaged body in a slot of a stretch.
struct InStretch {
  std::size_t slot;  ///< of the grid
  std::uint32_t body;
  std::size_t first;  ///< place of the first member in the stretch
  Members members;
};

/// Calls f(InStretch) for each averaged body in each slot of a stretch.
template <class Function>
void for_each_averaged_body(const Particles& particles, const BlockGrid& grid, const AveragedBodies& bodies,
                            const Stretch& stretch, Function&& f) {
  std::size_t begin = 0;  // of the slot, in the stretch
  for (std::size_t i = 0; i < stretch.balances.size(); ++i) {
    const std::size_t slot = stretch.first_slot + i;
    const Members of_slot = grid.particles_in(slot);
    for_each_averaged_body(particles, of_slot, bodies,
                           [&](std::uint32_t body, std::size_t first, Members members) {
                             f(InStretch{slot, body, begin + first, members});
                           });
    begin += of_slot.size();
  }
}

/// Returns trace of the gradient and volume rate of a particle of a stretch, in lanes 1 and 2.
Lanes volume_rates(const Stretch& stretch, std::size_t place) {
  return Lanes{1.0, stretch.gradients[place].trace(), stretch.volume_rates[place], 0.0};
}

/// Replaces the traces of the gradients of a stretch by their means, and calls settle(slot of the stretch, particle,
/// change of its mean volume rate).
template <class Settle>
void average(const Particles& particles, const BlockGrid& grid, const AveragedBodies& bodies,
             SharedCells& shared, const Stretch& stretch, Settle&& settle) {
  const CellMeans cells(grid);
  for_each_averaged_body(particles, grid, bodies, stretch, [&](const InStretch& part) {
    const auto quantities = [&](std::size_t k) { return volume_rates(stretch, part.first + k); };
    const auto use = [&](std::size_t k, const Lanes& means) {
      const std::size_t place = part.first + k;
      Matrix3& gradient = stretch.gradients[place];
      gradient.diagonal().array() += (means[1] - gradient.trace()) / 3.0;
      settle(part.slot - stretch.first_slot, part.members[k], means[2] - stretch.volume_rates[place]);
    };
    const std::span<const Lanes> of_ranks = shared.of(part.slot, bodies.number(part.body));
    if (of_ranks.empty()) {
      cells.average(particles, part.members, quantities, use);
    } else {
      cells.use(of_ranks, part.members, use);
    }
  });
}

}  // namespace

void average_stress(const Particles& particles, BlockGrid& grid, const AveragedBodies& bodies,
                    SharedCells& shared, std::span<double> mean_stress) {
  const CellMeans cells(grid);
  shared.clear();
  parallel::for_each_uneven(grid.slots(), [&](std::size_t slot) {
    const Members of_slot = grid.particles_in(slot);
    for (const std::uint32_t p : of_slot) {
      mean_stress[p] = -(particles.pressure[p] + particles.artificial_viscosity[p]);
    }
    for_each_averaged_body(particles, of_slot, bodies, [&](std::uint32_t body, std::size_t, Members members) {
      const auto quantities = [&](std::size_t k) { return Lanes{1.0, mean_stress[members[k]], 0.0, 0.0}; };
      const std::span<Lanes> of_ranks = shared.of(slot, bodies.number(body));
      if (!of_ranks.empty()) return cells.add(of_ranks, particles, members, quantities);
      cells.average(particles, members, quantities,
                    [&](std::size_t k, const Lanes& means) { mean_stress[members[k]] = means[1]; });
    });
  });
  shared.add_ranks(grid);
  parallel::for_each_uneven(grid.slots(), [&](std::size_t slot) {
    if (!shared.divide(slot)) return;
    for_each_averaged_body(
        particles, grid.particles_in(slot), bodies, [&](std::uint32_t body, std::size_t, Members members) {
          const std::span<const Lanes> of_ranks = shared.of(slot, bodies.number(body));
          if (of_ranks.empty()) return;
          cells.use(of_ranks, members,
                    [&](std::size_t k, const Lanes& means) { mean_stress[members[k]] = means[1]; });
        });
  });
}

void sum_volume_rate(const Particles& particles, const BlockGrid& grid, const AveragedBodies& bodies,
                     SharedCells& shared, const Stretch& stretch) {
  const CellMeans cells(grid);
  for_each_averaged_body(particles, grid, bodies, stretch, [&](const InStretch& part) {
    const std::span<Lanes> of_ranks = shared.of(part.slot, bodies.number(part.body));
    if (of_ranks.empty()) return;
    cells.add(of_ranks, particles, part.members,
              [&](std::size_t k) { return volume_rates(stretch, part.first + k); });
  });
}

void average_volume_rate(const Particles& particles, const BlockGrid& grid, const AveragedBodies& bodies,
                         SharedCells& shared, const Stretch& stretch) {
  average(particles, grid, bodies, shared, stretch, [](std::size_t, std::uint32_t, double) {});
}

void average_volume_rate_and_work(Particles& particles, const BlockGrid& grid, const AveragedBodies& bodies,
                                  SharedCells& shared, const Stretch& stretch, double dt) {
  average(particles, grid, bodies, shared, stretch, [&](std::size_t slot, std::uint32_t p, double change) {
    const double volume_change = change * particles.volume[p] * dt,
                 viscous_work = -particles.artificial_viscosity[p] * volume_change,
                 work = viscous_work - particles.pressure[p] * volume_change;
    particles.specific_internal_energy[p] += work / particles.mass[p];
    stretch.balances[slot].work += work;
    stretch.balances[slot].viscous_work += viscous_work;
  });
}

}  // namespace whipple::transfer
