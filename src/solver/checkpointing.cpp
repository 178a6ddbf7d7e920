// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/checkpointing.hpp"

#include <fmt/format.h>

#include "src/base/error.hpp"

namespace whipple::solver {
namespace {

/// Calls f(name, number) for every number of the state: one list for writing and reading.
template <class State, class Function>
void for_each_real(State& state, Function&& f) {
  f("time", state.time);
  f("time_step", state.time_step);
  f("maximum_acceleration", state.maximum_acceleration);
  f("compression_rate", state.compression_rate);
  f("squeezed_beside_voids", state.squeezed_beside_voids);
  for_each_number(state.ledger, f);
}

}  // namespace

io::CheckpointValues to_checkpoint(const RunState& state) {
  io::CheckpointValues values;
  values.integers["step"] = state.step;
  values.integers["particles_at_rest"] = state.particles_at_rest;
  for_each_real(state, [&](const std::string& name, double value) { values.reals[name] = value; });
  return values;
}

RunState from_checkpoint(const io::CheckpointValues& values) {
  RunState state;
  state.step = values.integer("step");
  state.particles_at_rest = values.integer("particles_at_rest");
  for_each_real(state, [&](const std::string& name, double& value) { value = values.real(name); });
  return state;
}

}  // namespace whipple::solver
