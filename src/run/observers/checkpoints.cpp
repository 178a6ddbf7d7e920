// SPDX-License-Identifier: BSD-3-Clause
#include "src/run/observers/checkpoints.hpp"

#include <fmt/format.h>

#include "src/core/base/log.hpp"
#include "src/run/checkpointing.hpp"
#include "src/run/restart.hpp"

namespace whipple::run {

namespace fs = std::filesystem;

void Checkpoints::after_step(const Moment& moment) {
  if (!moment.is_last() && !moment.requests.checkpoint && !moment.requests.stop()) return;
  if (moment.step() == last_step_) return;
  write(moment, directory_.checkpoint_folder());
  last_step_ = moment.step();
}

void Checkpoints::end(const Moment& moment, Outcome& outcome) {
  if (outcome.kind == Outcome::Kind::left_range) {  // the state left by the failing step
    const fs::path folder = directory_.failed_folder();
    try {
      write(moment, folder);
      outcome.message += fmt::format("\n  the state is saved in {}", folder.string());
    } catch (const std::exception& error) {
      outcome.message += fmt::format("\n  the state could not be saved: {}", error.what());
    }
  } else if (outcome.kind == Outcome::Kind::out_of_resources) {
    outcome.message +=
        io::list_checkpoints(directory_.checkpoint_folder()).empty()
            ? "; no checkpoint had been written"
            : fmt::format(
                  "; once the cause is gone resume from the last checkpoint with: whipple run --restart {}",
                  directory_.path().string());
  }
}

void Checkpoints::write(const Moment& moment, const fs::path& folder) const {
  const solver::Simulation& simulation = moment.simulation;
  io::CheckpointValues values = to_checkpoint(simulation.state());
  for (const auto& observer : moment.observers) observer->remember(values);
  values.texts["run_name"] = directory_.name();
  remember_input(simulation.setup(), values);
  const solver::Contents contents = simulation.contents();
  const fs::path path = io::write_checkpoint(folder, simulation.state().step, *contents.particles, values,
                                             simulation.communicator(), contents.meshes, contents.bars);
  log::detail("checkpoint {}", path.string());
}

}  // namespace whipple::run
