// SPDX-License-Identifier: BSD-3-Clause
#include "src/run/observers/summary.hpp"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <string>

#include "src/core/base/json.hpp"
#include "src/core/base/log.hpp"
#include "src/core/base/simd.hpp"
#include "src/core/base/text.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/material/fluid.hpp"
#include "src/solver/accounts.hpp"
#include "src/solver/carriers/domains.hpp"

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
  return json_text(nlohmann::json({{"wall_seconds", moment.wall_time},
                                   {"ranks", parallel::size(simulation.communicator())},
                                   {"threads", parallel::threads()},
                                   {"device", kernel_set() == KernelSet::plain ? "reference" : "cpu"},
                                   {"steps", moment.step()},
                                   {"particles", simulation.particle_count()},
                                   {"elements", simulation.element_count()},
                                   {"bytes_of_first_rank", simulation.bytes()},
                                   {"stages", stages}}),
                   2);
}

/// Returns the fraction of the unresolved energy that is carried by freely expanded fluid: continuous, with less than
/// half its initial density. The particles of such fluid have separated unless they were split. Collective.
double share_of_expanded_fluid(const solver::Simulation& simulation) {
  const cases::Case& setup = simulation.setup();
  const Particles& particles = simulation.particles();
  if (!(simulation.totals().unresolved_energy > 0.0)) return 0.0;  // the same on all ranks
  std::array<double, 1> carried = {0.0};
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    const Material& material = *setup.materials[b];
    const Fluidity fluid = fluidity(material);
    const double initial_density = setup.bodies[b].initial.of(material).density;
    const std::size_t first = simulation.bodies()[b].first;
    carried[0] += parallel::sum<double>(simulation.bodies()[b].count, [&](std::size_t i) {
      const std::size_t p = first + i;
      const bool expanded =
          has_thinned(particles, p, initial_density) && is_continuous_fluid(fluid, particles, p);
      return expanded ? particles.mass[p] * particles.unresolved_energy[p] : 0.0;
    });
  }
  parallel::sum(simulation.communicator(), carried);
  return carried[0] / simulation.totals().unresolved_energy;
}

/// Prints the summary of the run.
/// @param expanded  fraction of the unresolved energy that is carried by freely expanded fluid
void tell(const Moment& moment, double expanded) {
  const solver::Ledger& ledger = moment.simulation.state().ledger;
  const solver::Totals& totals = moment.simulation.totals();
  log::info("{} steps to t = {:.6g} s in {}; energy error {:.2e}, momentum error {:.2e}, outflow {:.3g} kg",
            moment.step(), moment.time(), format_duration(moment.wall_time), ledger.energy_error(totals),
            ledger.momentum_error(totals), ledger.outflow.mass);
  for (const solver::Account& account : solver::accounts) {
    const double count = ledger.*account.sum;
    if (solver::is_limiter(account.shown) && count > 0.0)
      log::info("{}: {:.0f} times", account.meaning, count);
  }
  // For bodies that have come to rest, the remaining unresolved energy is not motion of fragments.
  const bool at_rest = totals.kinetic_energy < nearly_at_rest * ledger.initial.kinetic_energy;
  if (totals.unresolved_share() > much_unresolved && !at_rest) {
    const bool parted = expanded > 0.5 && !solver::domains::may_divide(moment.simulation.setup());
    log::info(
        "motion that the cells do not resolve has {:.3g} % of the kinetic energy of the motion that they "
        "resolve: {}",
        100.0 * totals.unresolved_share(),
        parted ? "most of it is lost heat of expanding fluid whose particles have parted; "
                 "splitting.length above 0 keeps them together, finer cells do not"
               : "finer cells would change the result");
  }
}

}  // namespace

void Summary::end(const Moment& moment, Outcome& outcome) {
  if (outcome.kind != Outcome::Kind::done && outcome.kind != Outcome::Kind::stopped) return;
  const double expanded = share_of_expanded_fluid(moment.simulation);
  ranks_.on_root([&] {
    io::write_text_atomically(directory_.profile_file(), profile_as_json(moment, profile_));
    if (outcome.kind == Outcome::Kind::stopped) {
      log::info("{} at step {}, t = {:.6g} s; resume with: whipple run --restart {}", outcome.message,
                moment.step(), moment.time(), directory_.path().string());
    }
    if (outcome.kind == Outcome::Kind::done && !outcome.message.empty()) log::info("{}", outcome.message);
    tell(moment, expanded);
  });
}

}  // namespace whipple::run
