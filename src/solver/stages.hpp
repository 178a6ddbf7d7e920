// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "src/solver/carriers/hexahedra.hpp"
#include "src/solver/carriers/particle_carrier.hpp"
#include "src/solver/carriers/trusses.hpp"
#include "src/solver/device/device_stage.hpp"
#include "src/solver/loads.hpp"
#include "src/solver/stages/activity.hpp"
#include "src/solver/stages/applied_loads.hpp"
#include "src/solver/stages/balance.hpp"
#include "src/solver/stages/contact.hpp"
#include "src/solver/stages/elements.hpp"
#include "src/solver/stages/fill.hpp"
#include "src/solver/stages/load_step.hpp"
#include "src/solver/stages/material.hpp"
#include "src/solver/stages/partition.hpp"
#include "src/solver/stages/plausibility.hpp"
#include "src/solver/stages/time_step.hpp"
#include "src/solver/stages/transfers.hpp"

namespace whipple::solver {

/// Holds the stages of a step, the carriers and the state that they share: the argument of a scheme. Stages hold
/// references to each other, so that this object cannot be moved.
struct Stages {
  Stages(const cases::Case& setup, MPI_Comm communicator, const RunState& run, std::vector<fem::Mesh> meshes,
         std::vector<fem::Bars> bars);
  Stages(const Stages&) = delete;
  Stages& operator=(const Stages&) = delete;

  State state;
  Loads loads;
  ParticleCarrier particles;
  Hexahedra hexahedra;
  Trusses trusses;
  Carriers carriers;  ///< the carriers that the case has
  AppliedLoads applied_loads;
  Activity activity;
  MaterialStage material;
  Transfers transfers;
  ContactStage contact;
  TimeStep time_step;
  Partition partition;
  ElementStage elements;
  FillWatch fill;
  LoadStep load_step;
  Balance balance;
  Plausibility plausibility;
  std::unique_ptr<DeviceStage> device;  ///< null: the stages step the particles
};

/// Performs one step of the scheme of the case, at most to the time `until` (s).
void advance(Stages& s, double until);

/// Assigns particles and nodes of elements to the grid at their present positions.
void bin_particles(Stages& s);

}  // namespace whipple::solver
