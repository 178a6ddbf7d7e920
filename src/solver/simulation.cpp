// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/simulation.hpp"

#include <array>
#include <utility>

#include "src/afemp/transition.hpp"
#include "src/case/build/placement.hpp"
#include "src/case/build/seeding.hpp"
#include "src/case/build/tables.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/log.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/io/ranks.hpp"
#include "src/solver/carriers/domains.hpp"
#include "src/solver/carriers/explosives.hpp"
#include "src/solver/device/problem.hpp"
#include "src/solver/stages.hpp"

namespace whipple::solver {

/// Returns the case as the default device runs it: with tables of the models that it does not have in closed form.
static cases::Case on_default_device(cases::Case setup, MPI_Comm communicator) {
  if (!is_device(default_device())) return setup;
  evaluate_by_tables(setup);
  cases::tabulate_materials(setup, io::Ranks(communicator));
  return setup;
}

Simulation::Simulation(const cases::Case& of_case, MPI_Comm communicator) {
  const cases::Case setup = on_default_device(of_case, communicator);
  if (parallel::rank(communicator) == 0) {
    for (const std::string& text : cases::placement_warnings(setup)) log::warning("{}", text);
    for (const std::string& text : setup.contact_fields.warnings) log::warning("{}", text);
    for (const std::string& text : setup.contact_fields.remarks) log::info("{}", text);
  }
  cases::Seeding seeding = cases::seed(setup, parallel::rank(communicator), parallel::size(communicator));
  for (fem::Mesh& mesh : seeding.meshes) afemp::mark_surface(mesh, setup.geometry);
  stages_ = std::make_unique<Stages>(setup, communicator, RunState{}, std::move(seeding.meshes),
                                     std::move(seeding.bars));
  state_ = &stages_->state;
  state_->particles = std::move(seeding.particles);
  state_->bodies = std::move(seeding.bodies);
  for (Carrier* carrier : stages_->carriers) carrier->keep_share();
  stages_->particles.complete_seeded(domains::are_needed(*state_, stages_->contact.may_meet_images()));
  stages_->load_step.begin_run();
  use(default_device());
  stages_->balance.sum();
  begin_accounts();
  Ledger& ledger = state_->run.ledger;
  // Planes have stopped the nodes on them: the initial momentum includes the momentum that these lost.
  ledger.initial.momentum -= seeding.wall_impulse;
  ledger.wall_impulse += seeding.wall_impulse;
  stages_->applied_loads.weigh();
  stages_->plausibility.begin();
}

Simulation::Simulation(const cases::Case& of_case, Particles particles, const RunState& state,
                       MPI_Comm communicator, std::vector<fem::Mesh> meshes, std::vector<fem::Bars> bars)
    : stages_(std::make_unique<Stages>(on_default_device(of_case, communicator), communicator, state,
                                       std::move(meshes), std::move(bars))),
      state_(&stages_->state) {
  state_->particles = std::move(particles);
  const bool begins = state.step == 0 && !(state.ledger.initial.mass > 0.0);
  if (begins) stages_->particles.add_fields_of_motion();
  for (Carrier* carrier : stages_->carriers) carrier->gather();
  stages_->particles.complete_read(domains::are_needed(*state_, stages_->contact.may_meet_images()));
  stages_->load_step.begin_run();
  use(default_device());
  stages_->balance.sum();
  if (state.step == 0) {
    if (begins) begin_accounts();
    stages_->applied_loads.weigh();
    stages_->plausibility.begin();
  }
}

Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

/// Begins the accounts of a run with the present material.
void Simulation::begin_accounts() {
  Ledger& ledger = state_->run.ledger;
  ledger.initial = state_->totals;
  // The chemical energy of explosives counts as exchanged from the first step.
  std::array<double, 1> chemical_energy = {Explosives(*state_).chemical_energy()};
  parallel::sum(state_->communicator, chemical_energy);
  ledger.largest_heating = chemical_energy[0];
}

void Simulation::use(Device device) {
  if (!is_device(device)) return;
  stages_->device = std::make_unique<DeviceStage>(*state_, stages_->contact, device);
  state_->device = stages_->device.get();
}

void Simulation::synchronize() const {
  if (state_->device != nullptr) state_->device->synchronize();
}

void Simulation::advance(double until) { solver::advance(*stages_, until); }

void Simulation::add_load(Load load) {
  if (state_->device != nullptr && !load.of_all) {
    throw InputError("load \"" + load.name + "\" differs from point to point: a device does not compute it");
  }
  stages_->loads.add(std::move(load));
}

bool Simulation::is_one_with_image(std::size_t body, std::size_t face) const {
  return stages_->contact.is_one_with_image(body, face);
}

std::vector<const Carrier*> Simulation::carriers() const {
  synchronize();
  return {stages_->carriers.begin(), stages_->carriers.end()};
}

void Simulation::add_figures(std::span<PhaseMasses> of_body, Figures& figures) const {
  for (const Carrier* carrier : stages_->carriers) {
    carrier->add_phases(of_body);
    carrier->add_figures(figures);
  }
}

const std::vector<fem::Mesh>& Simulation::meshes() const { return stages_->hexahedra.meshes(); }

const std::vector<fem::Bars>& Simulation::bars() const { return stages_->trusses.bars(); }

View Simulation::view() const {
  synchronize();
  View view;
  for (const Carrier* carrier : stages_->carriers) carrier->show(view);
  return view;
}

Contents Simulation::contents() const {
  synchronize();
  Contents contents;
  for (const Carrier* carrier : stages_->carriers) carrier->save(contents);
  return contents;
}

std::size_t Simulation::bytes() const {
  std::size_t bytes =
      state_->grid.bytes() + (state_->device != nullptr ? state_->device->engine().bytes() : 0);
  for (const Carrier* carrier : stages_->carriers) bytes += carrier->bytes();
  return bytes;
}

device::Problem Simulation::device_problem() const {
  return solver::device_problem(*state_, stages_->contact);
}

double Simulation::next_event() const { return stages_->activity.next_event(); }

double Simulation::accurate_time_step() { return stages_->time_step.accurate(); }

double Simulation::least_fill(double pressure) {
  synchronize();
  bin_particles(*stages_);
  return stages_->fill.least(pressure);
}

}  // namespace whipple::solver
