// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <filesystem>
#include <string>

#include "src/io/checkpoint.hpp"
#include "src/run/checkpointing.hpp"
#include "src/solver/simulation.hpp"

/// States that must be the same bit for bit, and restarts.
namespace whipple::verification {

template <class Points>
void expect_same(const Points& a, const Points& b) {
  for_each_field(a, [&](const auto& field) {
    const auto& x = field.of(a);
    const auto& y = field.of(b);
    ASSERT_EQ(x.size(), y.size()) << field.name;
    EXPECT_TRUE(x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0) << field.name;
  });
}

inline void expect_same(const solver::Simulation& a, const solver::Simulation& b) {
  EXPECT_EQ(a.state().time, b.state().time);
  expect_same(a.particles(), b.particles());
  ASSERT_EQ(a.meshes().size(), b.meshes().size());
  for (std::size_t m = 0; m < a.meshes().size(); ++m) {
    expect_same(a.meshes()[m].nodes, b.meshes()[m].nodes);
    expect_same(a.meshes()[m].elements, b.meshes()[m].elements);
    expect_same(a.meshes()[m].points, b.meshes()[m].points);
  }
  ASSERT_EQ(a.bars().size(), b.bars().size());
  for (std::size_t m = 0; m < a.bars().size(); ++m) {
    expect_same(a.bars()[m].nodes, b.bars()[m].nodes);
    expect_same(a.bars()[m].elements, b.bars()[m].elements);
  }
}

/// Writes a checkpoint of a simulation into a folder. Collective.
inline std::filesystem::path save(const solver::Simulation& simulation, const std::filesystem::path& folder) {
  const solver::Contents contents = simulation.contents();
  return io::write_checkpoint(folder, simulation.state().step, *contents.particles,
                              run::to_checkpoint(simulation.state()), simulation.communicator(),
                              contents.meshes, contents.bars);
}

/// Goes on from a checkpoint. Collective.
inline solver::Simulation restored(const cases::Case& setup, const std::filesystem::path& file,
                                   MPI_Comm communicator) {
  io::Checkpoint checkpoint = io::read_checkpoint(file, communicator);
  return solver::Simulation(setup, std::move(checkpoint.particles), run::from_checkpoint(checkpoint.values),
                            communicator, std::move(checkpoint.meshes), std::move(checkpoint.bars));
}

}  // namespace whipple::verification
