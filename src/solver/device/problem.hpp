// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/device/problem.hpp"
#include "src/solver/stages/contact.hpp"
#include "src/solver/state.hpp"

namespace whipple::solver {

/// Describes a run as a device needs it; `device_faults` of its case must be empty.
device::Problem device_problem(const State& state, const ContactStage& contact);

/// Copies particles to the columns of a device.
void to_columns(const Particles& particles, device::PointsOnHost& points);
/// Copies the columns of a device to the particles, which take their order; those that have left are removed.
void from_columns(const device::PointsOnHost& points, Particles& particles);

}  // namespace whipple::solver
