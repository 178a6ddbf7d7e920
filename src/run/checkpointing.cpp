// SPDX-License-Identifier: BSD-3-Clause
#include "src/run/checkpointing.hpp"

#include "src/solver/accounts.hpp"
#include "src/solver/simulation.hpp"

namespace whipple::run {
namespace {

/// Calls f(name, number) for every real number of the state; the same list is used for writing and reading.
template <class State, class Function>
void for_each_real(State& state, Function&& f) {
  f("time", state.time);
  f("time_step", state.time_step);
  f("unclipped_step", state.unclipped_step);
  f("largest_step", state.largest_step);
  f("maximum_acceleration", state.maximum_acceleration);
  f("compression_rate", state.compression_rate);
  f("first_touch", state.first_touch);
  f("releasable_energy", state.releasable_energy);
  f("reference_speed", state.reference_speed);
  f("squeezed_beside_voids", state.squeezed_beside_voids);
  for_each_number(state.ledger, f);
}

/// Splits words of bits into halves, which double precision holds exactly.
std::vector<double> halves(const std::vector<std::uint64_t>& words) {
  std::vector<double> halves;
  for (const std::uint64_t word : words) {
    halves.push_back(static_cast<double>(word >> 32U));
    halves.push_back(static_cast<double>(word & 0xffffffffU));
  }
  return halves;
}

/// Calls f(first number) for every row of an array with `width` numbers per row.
/// @throws InputError naming the array if its last row is incomplete
template <class Function>
void for_each_row(const io::CheckpointValues& values, const std::string& name, std::ptrdiff_t width,
                  Function&& f) {
  const std::vector<double>& numbers = values.array(name);
  if (std::ssize(numbers) % width != 0) {
    throw InputError(fmt::format("the checkpoint has {} numbers in \"{}\": expected a multiple of {}",
                                 numbers.size(), name, width));
  }
  for (auto n = numbers.begin(); n != numbers.end(); n += width) f(n);
}

/// Joins the halves of words of bits.
std::vector<std::uint64_t> words(const std::vector<double>& halves) {
  std::vector<std::uint64_t> words;
  for (std::size_t i = 0; i + 1 < halves.size(); i += 2) {
    words.push_back(static_cast<std::uint64_t>(halves[i]) << 32U | static_cast<std::uint64_t>(halves[i + 1]));
  }
  return words;
}

}  // namespace

io::CheckpointValues to_checkpoint(const solver::RunState& state) {
  io::CheckpointValues values;
  values.integers["step"] = state.step;
  values.integers["particles_at_rest"] = state.particles_at_rest;
  values.arrays["touched"] = halves(state.touched);
  values.arrays["loaded_mass"] = state.loaded_mass;
  std::vector<double>& outflow = values.arrays["outflow_of_body"];
  for (const solver::BodyOutflow& out : state.outflow_of_body) {
    outflow.insert(outflow.end(), {out.mass, out.momentum[0], out.momentum[1], out.momentum[2], out.energy});
  }
  std::vector<double>& driven = values.arrays["driven_bodies"];
  for (const solver::DrivenBody& body : state.driven) {
    for (const Vector3& v : {body.velocity, body.acceleration, body.spin, body.spin_acceleration}) {
      driven.insert(driven.end(), v.begin(), v.end());
    }
    driven.push_back(body.time_step);
  }
  std::vector<double>& gauged = values.arrays["gauged_impulses"];
  for (const solver::GaugedImpulse& of : state.gauged) {
    for (const Vector3& v : {of.impulse, of.moment}) gauged.insert(gauged.end(), v.begin(), v.end());
  }
  for_each_real(state, [&](const std::string& name, double value) { values.reals[name] = value; });
  return values;
}

solver::RunState from_checkpoint(const io::CheckpointValues& values) {
  solver::RunState state;
  state.step = values.integer("step");
  state.particles_at_rest = values.integer("particles_at_rest");
  state.touched = words(values.array("touched"));
  state.loaded_mass = values.array("loaded_mass");
  for_each_row(values, "outflow_of_body", 5,
               [&](auto n) { state.outflow_of_body.push_back({n[0], {n[1], n[2], n[3]}, n[4]}); });
  for_each_row(values, "driven_bodies", 13, [&](auto n) {
    const auto vector = [&](std::size_t at) { return Vector3(n[at], n[at + 1], n[at + 2]); };
    state.driven.push_back({vector(0), vector(3), vector(6), vector(9), n[12]});
  });
  for_each_row(values, "gauged_impulses", 6, [&](auto n) {
    state.gauged.push_back({Vector3(n[0], n[1], n[2]), Vector3(n[3], n[4], n[5])});
  });
  for_each_real(state, [&](const std::string& name, double& value) { value = values.real(name); });
  return state;
}

}  // namespace whipple::run
