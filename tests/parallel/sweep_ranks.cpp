// SPDX-License-Identifier: BSD-3-Clause
// The order in which a step visits particles on several ranks.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <vector>

#include "src/case/case.hpp"
#include "src/transfer/sweep.hpp"
#include "tests/parallel/solver_ranks.hpp"
#include "tests/verification/contact_problems.hpp"

namespace whipple::solver {
namespace {

// Only stretches without a slot of the border may be worked on before what other ranks send is there.
TEST(SweepRanks, DivideInteriorAndBorderByTheirSlots) {
  using namespace verification;
  const cases::Case setup = cases::read_case_text(
      Method{}.time_toml(1e-6) + Method{}.toml() +
          "[domain]\nlower = [0, 0, 0]\nupper = [0.05, 0.05, 0.05]\ncell_size = "
          "0.001\n[[body]]\nname = \"block\"\n"
          "material = \"" +
          aluminium("aluminium_of_sweeps", "0.3 GPa") + "\"\nvelocity = [100, 0, 0]\nshape = { " +
          box(Vector3::Constant(5e-3), Vector3(45e-3, 20e-3, 15e-3)) + " }\n",
      "sweep.toml");
  Simulation together(setup, MPI_COMM_WORLD);
  together.advance(1e-6);
  const grid::BlockGrid& grid = together.grid();
  transfer::Sweep sweep(const_cast<grid::BlockGrid&>(grid));  // which it asks to make progress with messages
  const auto at_border = [&](const transfer::Stretch& stretch) {
    for (std::size_t slot = stretch.first_slot; slot < stretch.first_slot + stretch.balances.size(); ++slot) {
      if (!grid.particles_in(slot).empty() && grid.region(slot) == transfer::Region::border) return true;
    }
    return false;
  };
  std::vector<std::atomic<int>> visits(together.particles().size());
  std::array<std::atomic<int>, 2> stretches{};
  for (const transfer::Region region : {transfer::Region::border, transfer::Region::interior}) {
    sweep.for_each_stretch(region, [&](const transfer::Stretch& stretch) {
      EXPECT_EQ(at_border(stretch), region == transfer::Region::border);
      ++stretches[static_cast<std::size_t>(region)];
      for (const std::uint32_t p : stretch.particles) ++visits[p];
    });
  }
  EXPECT_TRUE(std::ranges::all_of(visits, [](const std::atomic<int>& times) { return times == 1; }));
  const bool alone = parallel::size(MPI_COMM_WORLD) == 1;
  EXPECT_EQ(stretches[static_cast<std::size_t>(transfer::Region::border)] == 0, alone);
}

}  // namespace
}  // namespace whipple::solver
