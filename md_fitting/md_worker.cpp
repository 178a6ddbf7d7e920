// SPDX-License-Identifier: BSD-3-Clause
// whipple-md: computes the missing points of a molecular-dynamics plan, alone or under mpirun.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <mpi.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "md_fitting/elements/element_defaults.hpp"
#include "md_fitting/elements/needs.hpp"
#include "md_fitting/lammps/empty_working_folder.hpp"
#include "md_fitting/plan/plan.hpp"
#include "md_fitting/protocols/budget.hpp"
#include "md_fitting/protocols/campaign.hpp"
#include "md_fitting/protocols/critical_point.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/log.hpp"
#include "src/core/base/progress.hpp"
#include "src/core/base/surroundings.hpp"

namespace whipple::md {
namespace {

struct Options {
  std::string plan;
  std::string store;
  bool retry_failed = false;
  bool describe = false;
  bool of_material = false;
  bool quiet = false;
  bool verbose = false;
};

/// Checks on rank 0 that the database is writable and broadcasts the result to all ranks.
void require_writable_on_all(const std::filesystem::path& store, int rank) {
  std::string fault;
  if (rank == 0) {
    try {
      require_writable(store);
    } catch (const InputError& error) {
      fault = error.what();
    }
  }
  int length = static_cast<int>(fault.size());
  MPI_Bcast(&length, 1, MPI_INT, 0, MPI_COMM_WORLD);
  fault.resize(static_cast<std::size_t>(length));
  MPI_Bcast(fault.data(), length, MPI_CHAR, 0, MPI_COMM_WORLD);
  if (length > 0) throw InputError(fault);
}

/// Reports the expected cost of the missing points, and whether it exceeds the limit of the plan.
void report_estimate(const Plan& plan, const std::vector<Task>& tasks, const Potential& potential,
                     const std::filesystem::path& store) {
  std::set<std::string> present;
  if (std::filesystem::exists(store)) {
    for (const PointRecord& point : read_store(store)) {
      if (point.done()) present.insert(point.key);
    }
  }
  std::map<std::string, double> time = planned_atom_steps(tasks, present, potential);
  const double work = total(time);
  if (work == 0.0) return;
  const double speed = atom_steps_per_second(potential);
  for (auto& [protocol, share] : time) share /= speed;
  log::info("estimate: {:.2g} atom-steps at {:.2g} per second of one processor, {}", work, speed,
            time_split(time));
  if (plan.processor_time > 0.0 && total(time) > plan.processor_time) {
    log::warning("that is more than the processor_time of the plan, {:.1f} min", plan.processor_time / 60.0);
  }
}

/// Reports, before the work, which data a fit of GRAY will not find in the database, and their alternative source.
void report_what_a_fit_lacks(const Plan& plan) {
  const bool melts = !plan.coexistences.empty();
  const bool boils =
      plan.liquid_vapour && plan.liquid_vapour->temperature.size() >= elements::least_saturations;
  const elements::ElementDefaults table = elements::element_defaults(plan.element);
  const std::vector<std::string> missing =
      elements::missing_constants(elements::FitModel::gray, table, {.melting = melts, .vapour = boils});
  if (!missing.empty()) {
    log::warning(
        "a fit of GRAY will lack {} of {}: neither these points nor the program know them; options of "
        "whipple "
        "fit, or points: {}",
        fmt::join(missing, ", "), plan.element, elements::remedies(missing));
    return;
  }
  std::vector<std::string> defaults = {"heat of the electrons"};
  if (!melts) defaults.emplace_back("melting temperature (no [[coexistence]])");
  if (!boils) {
    defaults.push_back(
        fmt::format("vapour (no [liquid_vapour] of {} temperatures)", elements::least_saturations));
  }
  log::info("whipple fit will take from the table of {} what these points do not determine: {}", plan.element,
            fmt::join(defaults, ", "));
}

/// Reports the cost of the points.
void report_time(const CampaignSummary& summary, const Plan& plan) {
  const double used = total(summary.processor_time);
  if (used == 0.0) return;
  log::info("processor time in points: {}{}", time_split(summary.processor_time),
            plan.processor_time > 0.0
                ? fmt::format("; the plan allows {:.1f} min", plan.processor_time / 60.0)
                : "");
}

void report(const CampaignSummary& summary, const std::string& store) {
  if (summary.molten > 0) {
    log::warning(
        "{} states of isotherms and isochores melted: they are stored as such and are no data for a solid",
        summary.molten);
  }
  if (summary.computed + summary.failed + summary.blocked == 0 && summary.left == 0) {
    log::info("nothing to compute: all {} points are in {}", summary.present, store);
    return;
  }
  log::info("{}: {} points computed, {} were there", store, summary.computed, summary.present);
  if (summary.elapsed > 0.0) {
    log::info(
        "time of the workers: {:.1f} % in points, {:.2f} % waiting for each other, {:.2f} % for the rest",
        100.0 * summary.busy / summary.elapsed, 100.0 * summary.waiting / summary.elapsed,
        100.0 * (1.0 - (summary.busy + summary.waiting) / summary.elapsed));
  }
  if (summary.failed > 0) log::warning("{} points failed; their messages are in the store", summary.failed);
  if (summary.blocked > 0) log::warning("{} points wait for a point that failed", summary.blocked);
  if (summary.left > 0) {
    log::warning(
        "{} points failed in an earlier call and were left alone; --retry-failed computes them again",
        summary.left);
  }
}

/// Reports the critical point if the plan has enough points for it.
void report_critical_point(const std::filesystem::path& store) {
  const std::vector<Saturation> points = saturations(read_store(store));
  if (points.size() < 3) return;
  try {
    const CriticalPoint point = estimate_critical_point(points);
    log::info("critical point estimated from {} temperatures: {:.0f} +- {:.0f} K, {:.0f} +- {:.0f} kg/m^3",
              points.size(), point.temperature.value, point.temperature.error, point.density.value,
              point.density.error);
  } catch (const StateError& error) {
    log::warning("no critical point estimated: {}", error.what());
  }
}

int run_plan(const Options& options) {
  int rank = 0;
  int ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  Plan plan = read_plan(options.plan);
  plan.folder = std::filesystem::absolute(plan.folder.empty() ? "." : plan.folder);
  const std::filesystem::path store = std::filesystem::absolute(options.store);
  const EmptyWorkingFolder working_folder;
  // Errors of the potential, or of states outside its range, are errors of the plan; with a damaged potential
  // LAMMPS loses the atoms of a disintegrating crystal.
  const auto of_plan = [&](const auto& call) {
    try {
      return call();
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: error: {}", options.plan, error.what()));
    } catch (const LammpsError& error) {
      throw InputError(
          fmt::format("{}: error: potential {}: {}", options.plan, plan.potential, error.what()));
    }
  };
  Potential potential = of_plan([&] {
    // The remaining word, least_energy, specifies none.
    return Potential::load(plan.potential, plan.element, plan.folder,
                           value_of<CrystalStructure>(plan.structure), {plan.pair_style, plan.pair_coeff});
  });
  if (plan.validity_pressure > 0.0) potential.state_validity({plan.validity_pressure, "stated in the plan"});
  const std::vector<Task> tasks = of_plan([&] { return make_tasks(plan, potential); });
  require_writable_on_all(store, rank);
  if (rank == 0) {
    log::info("{}: {} points, potential {} ({}), {} rank{}", plan.title.empty() ? options.plan : plan.title,
              tasks.size(), potential.name(), potential.file().filename().string(), ranks,
              ranks == 1 ? "" : "s");
    log::detail(
        "{} of {} ends at V/V0 = {:.3f}, usable down to {:.3f}; static {} with a0 = {:.4f} angstrom, cutoff "
        "{:.2f} angstrom",
        potential.has_tables() ? "density table" : "range", potential.name(), potential.table_end(),
        potential.least_volume_ratio(), word_of(potential.structure()), potential.lattice_constant(),
        potential.cutoff());
    if (!potential.remark().empty()) log::warning("{}", potential.remark());
    if (std::isfinite(potential.validity().pressure)) {
      log::info("states of {} beyond {:.0f} GPa are flagged: {}", potential.name(),
                1e-9 * potential.validity().pressure, potential.validity().reason);
    }
    if (!potential.has_tables() && potential.table_end() == 0.0) {
      log::warning(
          "{}: its functions are not open, so that nothing is known of where their fit ends; its static "
          "crystal resists compression down to V/V0 = {:.2f}",
          potential.name(), potential.least_volume_ratio());
    }
  }
  if (rank == 0) {
    of_plan([&] {
      if (!options.of_material) report_what_a_fit_lacks(plan);
      report_estimate(plan, tasks, potential, store);
    });
  }
  const CampaignSummary summary = run_campaign(tasks, store, MPI_COMM_WORLD, options.retry_failed,
                                               static_cast<int>(plan.ranks_per_point));
  if (rank == 0) {
    report(summary, options.store);
    report_time(summary, plan);
    if (plan.liquid_vapour) report_critical_point(store);
  }
  if (summary.code != 0) {
    if (rank == 0) log::warning("the plan is incomplete; repeat the call to compute what is missing");
    return summary.code;
  }
  const bool complete = summary.failed + summary.blocked + summary.left + summary.molten == 0;
  return static_cast<int>(complete ? ExitCode::success : ExitCode::state);
}

int body(int argc, char** argv) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  Options options;
  CLI::App app("Computes what is missing of a plan of molecular-dynamics points and adds it to a store",
               "whipple-md");
  app.add_option("plan", options.plan, "The plan (PLAN.toml)");
  app.add_option("-o,--output", options.store, "The store (default: PLAN.md.h5 in the present folder)");
  app.add_flag("--retry-failed", options.retry_failed, "Compute points again that failed in an earlier call");
  app.add_flag("--describe", options.describe,
               "Print every key of a plan with unit, range, default and meaning");
  // Used by md_fitting/simulated_crystal, whose points are for a material of the model md, not for a fit.
  app.add_flag("--of-material", options.of_material, "Say nothing of a fit")->group("");
  app.add_flag("--quiet", options.quiet, "Warnings and errors only");
  app.add_flag("--verbose", options.verbose, "More detail");
  app.footer("Example:\n  mpirun -n 2 whipple-md cases/md/copper_mishin_short.toml -o copper.md.h5");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const bool help = error.get_exit_code() == 0;
    if (rank == 0) app.exit(error);
    return static_cast<int>(help ? ExitCode::success : ExitCode::input);
  }
  if (options.quiet) log::set_level(log::Level::quiet);
  if (options.verbose) log::set_level(log::Level::verbose);
  set_progress_visible(!options.quiet);
  if (options.describe) {
    if (rank == 0) fmt::print("{}", describe_plan());
    return 0;
  }
  if (options.plan.empty()) throw InputError("name a plan: whipple-md PLAN.toml [-o STORE.md.h5]");
  if (options.store.empty()) options.store = std::filesystem::path(options.plan).stem().string() + ".md.h5";
  return run_plan(options);
}

/// Terminates all ranks with an error, since it need not reach the others, which may wait for this one. Rank 0
/// encounters most errors as well and prints them; another rank prints only if rank 0 does not terminate it soon.
void end_all_ranks(int rank, const std::exception& error) {
  if (rank != 0) std::this_thread::sleep_for(std::chrono::seconds(2));
  fmt::print(stderr, "{}\n", message_for_user("whipple-md", error));
  std::fflush(nullptr);
  MPI_Abort(MPI_COMM_WORLD, static_cast<int>(exit_code(error)));
}

/// Runs the program on one of several ranks.
int body_of_a_rank(int argc, char** argv) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  try {
    return body(argc, argv);
  } catch (const std::exception& error) {
    end_all_ranks(rank, error);
    throw;
  }
}

}  // namespace
}  // namespace whipple::md

int main(int argc, char** argv) {
  whipple::repair_surroundings();
  const int refused = whipple::run_guarded(
      "whipple-md",
      [](int, char**) {
        whipple::require_room_for_mpi();
        whipple::let_mpi_start_alone();
        return 0;
      },
      argc, argv);
  if (refused != 0) return refused;
  MPI_Init(&argc, &argv);
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const int code = whipple::run_guarded(
      "whipple-md", ranks == 1 ? whipple::md::body : whipple::md::body_of_a_rank, argc, argv);
  MPI_Finalize();
  return code;
}
