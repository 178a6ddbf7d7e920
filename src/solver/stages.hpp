// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/solver/carriers/hexahedra.hpp"
#include "src/solver/carriers/particle_carrier.hpp"
#include "src/solver/carriers/trusses.hpp"
#include "src/solver/loads.hpp"
#include "src/solver/stages/activity.hpp"
#include "src/solver/stages/balance.hpp"
#include "src/solver/stages/contact.hpp"
#include "src/solver/stages/elements.hpp"
#include "src/solver/stages/fill.hpp"
#include "src/solver/stages/material.hpp"
#include "src/solver/stages/partition.hpp"
#include "src/solver/stages/plausibility.hpp"
#include "src/solver/stages/time_step.hpp"
#include "src/solver/stages/transfers.hpp"

namespace whipple::solver {

/// The stages of a step, the carriers and the state that they share: what a scheme is a function of. Stages refer to
/// one another, so that this stays where it is.
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
  Carriers carriers;  ///< those that the case has
  Activity activity;
  MaterialStage material;
  Transfers transfers;
  ContactStage contact;
  TimeStep time_step;
  Partition partition;
  ElementStage elements;
  FillWatch fill;
  Balance balance;
  Plausibility plausibility;
};

/// Makes one step of the scheme of the case; not beyond `until` (s).
void advance(Stages& s, double until);

/// Assigns particles and nodes of elements to the grid as they are now.
void bin_particles(Stages& s);

}  // namespace whipple::solver
