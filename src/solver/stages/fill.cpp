// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/stages/fill.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "src/core/base/log.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/transfer/fill.hpp"

namespace whipple::solver {
namespace {

constexpr std::int64_t look_every = 20;    // steps
constexpr int looks_to_warn = 3;           // consecutive
constexpr double share_to_warn_of = 1e-2;  // of the mass

}  // namespace

bool FillWatch::is_due() const { return state_.run.step % look_every == 0; }

void FillWatch::look() {
  if (is_due()) state_.profile.time("fill", [&] { judge(mass_beside_voids()); });
}

double FillWatch::mass_beside_voids() const {
  const auto is_pressed = [&](std::size_t p) {
    const double c = state_.particles.sound_speed[p];
    return state_.particles.failed[p] == 0 && state_.particles.pressure[p] * state_.particles.volume[p] >
                                                  strong * state_.particles.mass[p] * c * c;
  };
  const bool any = !parallel::where(state_.particles.size(), is_pressed).empty();
  if (!parallel::any(state_.communicator, any)) return 0.0;
  const std::vector<double> fill = transfer::fill_of_cells(state_.particles, state_.transition, state_.grid);
  std::array<double, 1> mass = {parallel::sum<double>(state_.particles.size(), [&](std::size_t p) {
    return fill[p] < filled && is_pressed(p) ? state_.particles.mass[p] : 0.0;
  })};
  parallel::sum(state_.communicator, mass);
  return mass[0];
}

void FillWatch::judge(double mass) {
  state_.run.squeezed_beside_voids = mass;
  // A shock that breaks out of a surface compresses a layer next to the void outside for a few steps.
  looks_at_voids_ = mass < share_to_warn_of * state_.totals.mass ? 0 : looks_at_voids_ + 1;
  if (looks_at_voids_ < looks_to_warn || warned_) return;
  warned_ = true;
  if (parallel::rank(state_.communicator) != 0) return;
  log::warning(
      "step {}, t = {:.4g} us: {:.3g} g of intact material are under high pressure in cells that they do "
      "not "
      "fill: "
      "where bodies or layers meet across a gap in one velocity field, pressures come out too high",
      state_.run.step, 1e6 * state_.run.time, 1e3 * mass);
}

double FillWatch::least(double pressure) const {
  const std::vector<double> fill = transfer::fill_of_cells(state_.particles, state_.transition, state_.grid);
  std::array<double, 1> least = {-1e300};
  for (std::size_t p = 0; p < fill.size(); ++p) {
    if (state_.particles.pressure[p] > pressure) least[0] = std::max(least[0], -fill[p]);
  }
  parallel::maximum(state_.communicator, least);
  return -least[0];
}

}  // namespace whipple::solver
