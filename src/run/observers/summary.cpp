// SPDX-License-Identifier: BSD-3-Clause
#include "src/run/observers/summary.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>

#include "src/core/base/log.hpp"
#include "src/core/base/simd.hpp"
#include "src/core/base/text.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/core/parallel/threads.hpp"

namespace whipple::run {
namespace {

constexpr double much_unresolved = 0.05;  // of the kinetic energy
constexpr double nearly_at_rest = 0.05;   // of the kinetic energy at the start

std::string profile_as_json(const Moment& moment, const solver::Profile& profile) {
  const solver::Simulation& simulation = moment.simulation;
  nlohmann::json stages = nlohmann::json::array();
  for (const solver::Profile::Stage& stage : profile.stages()) {
    stages.push_back({{"stage", stage.name}, {"seconds", stage.seconds}, {"calls", stage.calls}});
  }
  return nlohmann::json({{"wall_seconds", moment.wall_time},
                         {"ranks", parallel::size(simulation.communicator())},
                         {"threads", parallel::threads()},
                         {"device", kernel_set() == KernelSet::plain ? "reference" : "cpu"},
                         {"steps", moment.step()},
                         {"particles", simulation.particle_count()},
                         {"elements", simulation.element_count()},
                         {"bytes_of_first_rank", simulation.bytes()},
                         {"stages", stages}})
      .dump(2);
}

void tell(const Moment& moment) {
  const solver::Ledger& ledger = moment.simulation.state().ledger;
  const solver::Totals& totals = moment.simulation.totals();
  log::info("{} steps to t = {:.6g} s in {}; energy error {:.2e}, momentum error {:.2e}, outflow {:.3g} kg",
            moment.step(), moment.time(), format_duration(moment.wall_time), ledger.energy_error(totals),
            ledger.momentum_error(totals), ledger.outflow.mass);
  for (const solver::Limiter& limiter : solver::limiters) {
    const double count = ledger.*(limiter.count);
    if (count > 0.0) log::info("{}: {:.0f} times", limiter.meaning, count);
  }
  // Of bodies that have come to rest the remainder is no motion of fragments.
  const bool at_rest = totals.kinetic_energy < nearly_at_rest * ledger.initial.kinetic_energy;
  if (totals.unresolved_share() > much_unresolved && !at_rest) {
    log::info(
        "motion that the cells do not resolve has {:.3g} % of the kinetic energy of the motion that they "
        "resolve: finer cells would change the result",
        100.0 * totals.unresolved_share());
  }
}

}  // namespace

void Summary::end(const Moment& moment, Outcome& outcome) {
  if (outcome.kind != Outcome::Kind::done && outcome.kind != Outcome::Kind::stopped) return;
  ranks_.on_root([&] {
    io::write_text_atomically(directory_.profile_file(), profile_as_json(moment, profile_));
    if (outcome.kind == Outcome::Kind::stopped) {
      log::info("{} at step {}, t = {:.6g} s; resume with: whipple run --restart {}", outcome.message,
                moment.step(), moment.time(), directory_.path().string());
    }
    tell(moment);
  });
}

}  // namespace whipple::run
