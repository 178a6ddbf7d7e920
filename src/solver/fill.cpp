// SPDX-License-Identifier: BSD-3-Clause
// Does material under pressure fill its cells (docs/theory/contact.md, 7)?
#include "src/transfer/fill.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "src/core/base/log.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/solver/simulation.hpp"

namespace whipple::solver {
namespace {

constexpr std::int64_t look_every = 20;    // steps
constexpr int looks_to_warn = 3;           // one after the other
constexpr double strong = 0.1;             // pressure over rho c^2
constexpr double filled = 0.85;            // of cells that material under pressure should fill
constexpr double share_to_warn_of = 1e-2;  // of the mass

}  // namespace

/// Sums the intact material that is squeezed although its cells hold voids: a mark of bodies that act on each
/// other across a gap, which energy and momentum do not show. Every 20 steps.
void Simulation::look_at_fill() {
  if (state_.step % look_every != 0) return;
  profile_.time("fill", [&] {
    const auto is_pressed = [&](std::size_t p) {
      const double c = particles_.sound_speed[p];
      return particles_.failed[p] == 0 &&
             particles_.pressure[p] * particles_.volume[p] > strong * particles_.mass[p] * c * c;
    };
    const bool any = !parallel::where(particles_.size(), is_pressed).empty();
    if (!parallel::any(communicator_, any)) {
      state_.squeezed_beside_voids = 0.0;
      return;
    }
    const std::vector<double> fill = transfer::fill_of_cells(particles_, transition_, grid_);
    std::array<double, 1> mass = {parallel::sum<double>(particles_.size(), [&](std::size_t p) {
      return fill[p] < filled && is_pressed(p) ? particles_.mass[p] : 0.0;
    })};
    parallel::sum(communicator_, mass);
    state_.squeezed_beside_voids = mass[0];
    // A shock that breaks out of a surface squeezes a layer beside the void outside for a few steps.
    looks_at_voids_ = mass[0] < share_to_warn_of * totals_.mass ? 0 : looks_at_voids_ + 1;
    if (looks_at_voids_ < looks_to_warn || warned_of_voids_) return;
    warned_of_voids_ = true;
    if (parallel::rank(communicator_) != 0) return;
    log::warning(
        "step {}, t = {:.4g} us: {:.3g} g of intact matter are under high pressure in cells that they do not "
        "fill: "
        "where bodies or layers meet across a gap in one velocity field, pressures come out too high",
        state_.step, 1e6 * state_.time, 1e3 * mass[0]);
  });
}

double Simulation::least_fill(double pressure) {
  bin_particles();
  const std::vector<double> fill = transfer::fill_of_cells(particles_, transition_, grid_);
  std::array<double, 1> least = {-1e300};
  for (std::size_t p = 0; p < fill.size(); ++p) {
    if (particles_.pressure[p] > pressure) least[0] = std::max(least[0], -fill[p]);
  }
  parallel::maximum(communicator_, least);
  return -least[0];
}

}  // namespace whipple::solver
