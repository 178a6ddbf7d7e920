// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/checkpointing.hpp"

#include <fmt/format.h>

#include "src/base/error.hpp"

namespace whipple::solver {
namespace {

/// Calls f(name, member) for every number of the state: one list for writing and reading.
template <class State, class Function>
void for_each_real(State& state, Function&& f) {
  f("time", state.time);
  f("time_step", state.time_step);
  f("maximum_acceleration", state.maximum_acceleration);
  f("work", state.ledger.work);
  f("transfer_heat", state.ledger.transfer_heat);
  f("clamped_to_cold_curve", state.ledger.clamped_to_cold_curve);
  f("limited_volume_changes", state.ledger.limited_volume_changes);
  const auto totals = [&](const std::string& prefix, auto& t) {
    f(prefix + "_mass", t.mass);
    f(prefix + "_momentum_scale", t.momentum_scale);
    f(prefix + "_kinetic_energy", t.kinetic_energy);
    f(prefix + "_affine_kinetic_energy", t.affine_kinetic_energy);
    f(prefix + "_internal_energy", t.internal_energy);
  };
  totals("initial", state.ledger.initial);
  totals("outflow", state.ledger.outflow);
}

template <class State, class Function>
void for_each_vector(State& state, Function&& f) {
  f("initial_momentum", state.ledger.initial.momentum);
  f("outflow_momentum", state.ledger.outflow.momentum);
  f("wall_impulse", state.ledger.wall_impulse);
}

}  // namespace

io::CheckpointValues to_checkpoint(const RunState& state) {
  io::CheckpointValues values;
  values.integers["step"] = state.step;
  for_each_real(state, [&](const std::string& name, double value) { values.reals[name] = value; });
  for_each_vector(
      state, [&](const std::string& name, const Vector3& v) { values.arrays[name] = {v[0], v[1], v[2]}; });
  return values;
}

RunState from_checkpoint(const io::CheckpointValues& values) {
  RunState state;
  state.step = values.integer("step");
  for_each_real(state, [&](const std::string& name, double& value) { value = values.real(name); });
  for_each_vector(state, [&](const std::string& name, Vector3& v) {
    const std::vector<double>& stored = values.array(name);
    if (stored.size() != 3) {
      throw InputError(
          fmt::format("{}: array '{}' has {} entries, expected 3", values.source, name, stored.size()));
    }
    v = Vector3(stored[0], stored[1], stored[2]);
  });
  return state;
}

}  // namespace whipple::solver
