// SPDX-License-Identifier: BSD-3-Clause
#include "src/transfer/averages.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "src/core/parallel/threads.hpp"

namespace whipple::transfer {
namespace {

using grid::BlockGrid;
using Members = std::span<const std::uint32_t>;

/// Calls f(first, members) for the particles of each averaged body in a slot, which follow one another.
/// @param first  place of the members among the particles of the slot
template <class Function>
void for_each_averaged_body(const Particles& particles, Members of_slot, const AveragedBodies& bodies,
                            Function&& f) {
  for (std::size_t first = 0, end = 0; first < of_slot.size(); first = end) {
    const std::uint32_t body = particles.body[of_slot[first]];
    for (end = first + 1; end < of_slot.size() && particles.body[of_slot[end]] == body;) ++end;
    if (bodies.contain(body)) f(first, of_slot.subspan(first, end - first));
  }
}

/// Averages a quantity by volume over the cells of a slot.
class CellMeans {
 public:
  explicit CellMeans(const BlockGrid& grid)
      : places_(grid.places(BlockGrid::Points::particles)),
        stencil_(grid.stencil()),
        sums_(static_cast<std::size_t>(stencil_.block().edge * stencil_.block().edge *
                                       stencil_.block().edge_z)) {}

  /// Replaces the quantity of each member by the mean of its cell.
  /// @param value  value(k): reference to that of member k
  template <class Value>
  void average(const Particles& particles, Members members, Value&& value) {
    std::ranges::fill(sums_, Sum{});
    for (std::size_t k = 0; k < members.size(); ++k) {
      Sum& sum = of_cell(members[k]);
      const double volume = particles.volume[members[k]];
      sum.volume += volume;
      sum.product += volume * value(k);
    }
    for (Sum& sum : sums_) {
      if (sum.volume > 0.0) sum.product /= sum.volume;
    }
    for (std::size_t k = 0; k < members.size(); ++k) value(k) = of_cell(members[k]).product;
  }

 private:
  struct Sum {
    double volume = 0.0, product = 0.0;
  };
  Sum& of_cell(std::uint32_t p) {
    const std::array<int, 3> first = places_[p].first_node(stencil_);
    const auto along = [&](std::size_t a) {
      return stencil_.planar && a == 2 ? 0 : first[a] + static_cast<int>(places_[p].from_first(a));
    };
    const int cell = stencil_.block().node(along(0), along(1), along(2));
    return sums_[static_cast<std::size_t>(cell)];
  }

  std::span<const grid::PlaceInStencil> places_;
  grid::Stencil stencil_;
  std::vector<Sum> sums_;
};

/// Replaces the traces of the gradients of a stretch by their means, and calls settle(slot of the stretch, place in the
/// stretch, particle, change of its mean volume rate).
template <class Settle>
void average(const Particles& particles, const BlockGrid& grid, const AveragedBodies& bodies,
             const Stretch& stretch, Settle&& settle) {
  CellMeans means(grid);
  std::vector<double> trace, rate;
  std::size_t begin = 0;  // of the slot, in the stretch
  for (std::size_t i = 0; i < stretch.balances.size(); ++i) {
    const Members of_slot = grid.particles_in(stretch.first_slot + i);
    for_each_averaged_body(particles, of_slot, bodies, [&](std::size_t first, Members members) {
      const std::span<Matrix3> gradients = stretch.gradients.subspan(begin + first, members.size());
      const std::span<const double> own = stretch.volume_rates.subspan(begin + first, members.size());
      trace.resize(members.size());
      for (std::size_t k = 0; k < members.size(); ++k) trace[k] = gradients[k].trace();
      rate.assign(own.begin(), own.end());
      means.average(particles, members, [&](std::size_t k) -> double& { return trace[k]; });
      means.average(particles, members, [&](std::size_t k) -> double& { return rate[k]; });
      for (std::size_t k = 0; k < members.size(); ++k) {
        gradients[k].diagonal().array() += (trace[k] - gradients[k].trace()) / 3.0;
        settle(i, members[k], rate[k] - own[k]);
      }
    });
    begin += of_slot.size();
  }
}

}  // namespace

AveragedBodies::AveragedBodies(std::vector<std::uint8_t> is_averaged)
    : is_averaged_(std::move(is_averaged)),
      any_(std::ranges::any_of(is_averaged_, [](std::uint8_t averaged) { return averaged != 0; })) {}

void average_stress(const Particles& particles, const BlockGrid& grid, const AveragedBodies& bodies,
                    std::span<double> mean_stress) {
  parallel::for_each_uneven(grid.slots(), [&](std::size_t slot) {
    const Members of_slot = grid.particles_in(slot);
    for (const std::uint32_t p : of_slot) {
      mean_stress[p] = -(particles.pressure[p] + particles.artificial_viscosity[p]);
    }
    for_each_averaged_body(particles, of_slot, bodies, [&](std::size_t, Members members) {
      CellMeans(grid).average(particles, members,
                              [&](std::size_t k) -> double& { return mean_stress[members[k]]; });
    });
  });
}

void average_volume_rate(const Particles& particles, const BlockGrid& grid, const AveragedBodies& bodies,
                         const Stretch& stretch) {
  average(particles, grid, bodies, stretch, [](std::size_t, std::uint32_t, double) {});
}

void average_volume_rate_and_work(Particles& particles, const BlockGrid& grid, const AveragedBodies& bodies,
                                  const Stretch& stretch, double dt) {
  average(particles, grid, bodies, stretch, [&](std::size_t slot, std::uint32_t p, double change) {
    const double volume_change = change * particles.volume[p] * dt,
                 viscous_work = -particles.artificial_viscosity[p] * volume_change,
                 work = viscous_work - particles.pressure[p] * volume_change;
    particles.specific_internal_energy[p] += work / particles.mass[p];
    stretch.balances[slot].work += work;
    stretch.balances[slot].viscous_work += viscous_work;
  });
}

}  // namespace whipple::transfer
