// SPDX-License-Identifier: BSD-3-Clause
#include "src/run/run.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>

#include "src/case/build/tables.hpp"
#include "src/case/remarks.hpp"
#include "src/case/shapes/source_file.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/log.hpp"
#include "src/core/base/text.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/io/checkpoint.hpp"
#include "src/io/run_directory.hpp"
#include "src/material/material_file.hpp"
#include "src/run/directory_control.hpp"
#include "src/run/material_copies.hpp"
#include "src/run/observers/checkpoints.hpp"
#include "src/run/observers/gauges.hpp"
#include "src/run/observers/history.hpp"
#include "src/run/observers/input_record.hpp"
#include "src/run/observers/progress.hpp"
#include "src/run/observers/snapshots.hpp"
#include "src/run/observers/status_file.hpp"
#include "src/run/observers/stop_conditions.hpp"
#include "src/run/observers/summary.hpp"
#include "src/run/preparation.hpp"
#include "src/run/replay_control.hpp"
#include "src/run/restart.hpp"
#include "src/run/runner.hpp"
#include "src/run/signal_control.hpp"
#include "src/run/status.hpp"
#include "src/solver/device/device.hpp"
#include "src/solver/simulation.hpp"

namespace whipple::run {
namespace {

namespace fs = std::filesystem;

/// Names a run after the folder of its case, or after the file if that is not called case.toml. Names are UTF-8 because
/// indices of snapshots contain them.
std::string run_name(const fs::path& case_file) {
  const std::string stem = utf8(case_file.stem().string(), "_");
  if (stem != "case") return stem;
  const std::string folder = utf8(fs::absolute(case_file).parent_path().filename().string(), "_");
  return folder.empty() ? stem : folder;
}

std::string provenance(const cases::Case& setup, const std::string& program, int ranks) {
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  return fmt::format(
      "\n[provenance]\nprogram = {}\ncase_file = {}\nmachine = {}\nranks = {}\nthreads = {}\nstarted = {}\n",
      toml_string(program), toml_string(setup.file.string()), toml_string(host.data()), ranks,
      parallel::threads(),
      toml_string(fmt::format("{:%Y-%m-%d %H:%M:%S}", fmt::localtime(std::chrono::system_clock::to_time_t(
                                                          std::chrono::system_clock::now())))));
}

io::RunDirectory new_directory(const cases::Case& setup, const fs::path& path, const RunOptions& options,
                               const io::Ranks& ranks) {
  const std::string name = run_name(setup.file);
  std::optional<io::RunDirectory> created;
  ranks.on_root([&] {
    created = io::RunDirectory::create(path, name, options.force);
    const io::RunDirectory& directory = *created;
    const std::vector<std::string> copies = material_copies(setup);
    fs::create_directories(directory.path() / "materials");
    for (std::size_t b = 0; b < copies.size(); ++b) {
      io::write_text_atomically(directory.path() / copies[b], material_text(setup.materials[b]->file));
      for (const fs::path& companion : setup.materials[b]->companions) {
        const fs::path copy = (directory.path() / copies[b]).parent_path() / companion;
        fs::create_directories(copy.parent_path());
        fs::copy_file(setup.materials[b]->file.parent_path() / companion, copy,
                      fs::copy_options::overwrite_existing);
      }
    }
    for (const cases::Body& body : setup.bodies) cases::keep_sources(*body.shape, directory.path());
    directory.write_input(cases::to_toml(setup, copies) + provenance(setup, options.program, ranks.count()));
  });
  return created ? *created : io::RunDirectory::open(path, name);
}

/// Builds the tables of the materials, and checks that there is the device and that it computes what the case asks for.
/// @throws InputError that says what is missing, or with all that it does not compute
void prepare_materials(cases::Case& setup, const io::Ranks& ranks) {
  const bool on_device = is_device(solver::default_device());
  solver::require(solver::default_device());
  if (on_device) solver::evaluate_by_tables(setup);
  cases::tabulate_materials(setup, ranks);
  if (!on_device) return;
  if (ranks.is_parallel()) throw InputError("--device: a device computes a run on one rank");
  if (auto faults = solver::device_faults(setup); !faults.empty()) throw InputError(std::move(faults));
}

fs::path output_directory(const RunOptions& options, const fs::path& case_file) {
  return options.output_directory.empty() ? fs::path("run") / run_name(case_file) : options.output_directory;
}

/// Lists the observers of a run, in the order in which they are called after a step.
Observers observers_of(solver::Simulation& simulation, const io::RunDirectory& directory,
                       const RunOptions& options, const io::Ranks& ranks) {
  const cases::Case& setup = simulation.setup();
  const Table::Options history{directory.history_file(), "history_rows", &Schedule::history_every,
                               options.force};
  const Table::Options gauges{directory.gauges_file(), "gauges_rows", &Schedule::gauges_every, options.force};
  Observers all;
  all.push_back(std::make_unique<ProgressBar>(ranks));
  all.push_back(std::make_unique<Summary>(directory, simulation.profile(), ranks));
  all.push_back(std::make_unique<InputRecord>(directory, ranks));
  all.push_back(std::make_unique<HistoryTable>(setup, history, ranks));
  all.push_back(std::make_unique<GaugeTable>(gauges, ranks));
  auto snapshots = std::make_unique<Snapshots>(setup, directory, simulation.communicator());
  auto conditions = std::make_unique<StopConditions>(setup, directory, *snapshots, ranks);
  all.push_back(std::move(snapshots));
  all.push_back(std::move(conditions));
  all.push_back(std::make_unique<Checkpoints>(directory));
  all.push_back(std::make_unique<StatusFile>(directory, options.program, ranks));
  return all;
}

/// Runs the steps under the control of signals and of files in the run directory.
/// @param replay  requests to repeat; null: those in the run directory are executed
/// @returns the exit code
int run_with_controls(Runner& runner, const io::RunDirectory& directory, const io::Ranks& ranks,
                      ReplayControl* replay = nullptr) {
  SignalControl signals(ranks.is_parallel());
  std::vector<RunControl*> controls = {&signals};
  std::optional<DirectoryControl> requests;
  ranks.on_root([&] {
    controls.push_back(replay != nullptr ? static_cast<RunControl*>(replay) : &requests.emplace(directory));
  });
  return runner.run(controls);
}

/// Runs a case from its start. @returns the exit code
int begin(const RunOptions& options, MPI_Comm communicator) {
  const io::Ranks ranks(communicator);
  std::optional<ReplayControl> replay;
  if (!options.replay.empty()) replay.emplace(options.replay);  // on every rank: all raise its errors
  cases::Case setup = cases::read_case(options.case_file, options.overrides);
  require_known_columns(setup, options.overrides);
  require_memory(setup, communicator);
  prepare_materials(setup, ranks);
  std::optional<io::Checkpoint> start;
  if (!options.start_from.empty()) {
    start.emplace(io::read_latest_checkpoint(options.start_from / "checkpoint", communicator));
    require_same_bodies(setup, start->values);
  }
  const io::RunDirectory directory =
      new_directory(setup, output_directory(options, options.case_file), options, ranks);
  if (ranks.is_root()) log::set_file(directory.log_file());
  log::info("{}: {}", setup.title.empty() ? directory.name() : setup.title, directory.path().string());
  for (const std::string& remark : cases::remarks(setup)) log::warning("{}", remark);
  solver::Simulation simulation =
      start ? start_from(setup, *start, communicator) : solver::Simulation(setup, communicator);
  if (start) log::info("begins with the state of {}", start->path.string());
  require_disk(simulation, directory, 3, ranks);
  Runner runner(simulation, observers_of(simulation, directory, options, ranks), options.wall_time);
  runner.begin();
  return run_with_controls(runner, directory, ranks, replay ? &*replay : nullptr);
}

/// Returns whether a run has written everything at its end, its status last. Collective.
bool is_complete(const fs::path& folder, const io::Ranks& ranks, MPI_Comm communicator) {
  double complete = 0.0;  // 1 on the root if it is
  ranks.on_root([&] {
    try {
      complete = read_status(folder).state == Activity::done ? 1.0 : 0.0;
    } catch (const InputError&) {  // without its status it is not
    }
  });
  return parallel::maximum(communicator, complete) > 0.0;
}

/// Continues a run from its latest checkpoint. @returns the exit code
int go_on(const RunOptions& options, MPI_Comm communicator) {
  const io::Ranks ranks(communicator);
  std::shared_ptr<const FileLock> lock;  // before reading anything that another run may write
  ranks.on_root([&] { lock = io::lock_run(options.output_directory); });
  cases::Case setup = cases::read_case(options.output_directory / "run.toml", options.overrides);
  require_known_columns(setup, options.overrides);
  io::Checkpoint checkpoint =
      io::read_latest_checkpoint(options.output_directory / "checkpoint", communicator);
  const int ended_by = StopConditions::ended_by(setup, checkpoint.values);
  if (ended_by > 0 && is_complete(options.output_directory, ranks, communicator)) {
    static_cast<void>(require_same_input(setup, checkpoint.values));
    log::info("{} has ended because {}: nothing to do; --set stop='[]' goes on without conditions",
              options.output_directory.string(),
              setup.stops[static_cast<std::size_t>(ended_by - 1)].in_words());
    return 0;
  }
  prepare_materials(setup, ranks);
  const io::RunDirectory directory =
      io::RunDirectory::open(options.output_directory, checkpoint.values.text("run_name"));
  if (ranks.is_root()) log::set_file(directory.log_file());
  ranks.on_root([&] { directory.remove_partial_files(); });
  solver::Simulation simulation = resume(setup, checkpoint, communicator);
  if (!options.overrides.empty()) {  // for the next restart
    ranks.on_root([&] {
      directory.write_input(cases::to_toml(setup, material_copies(setup)) +
                            provenance(setup, options.program, ranks.count()));
    });
  }
  require_disk(simulation, directory, 1, ranks);
  Runner runner(simulation, observers_of(simulation, directory, options, ranks), options.wall_time);
  runner.resume(checkpoint.values, ended_by);
  log::info("restarted from {} at step {}, t = {:.6g} s", checkpoint.path.string(), simulation.state().step,
            simulation.state().time);
  return run_with_controls(runner, directory, ranks);
}

}  // namespace

int run_case(const RunOptions& options, MPI_Comm communicator) {
  if (parallel::rank(communicator) != 0) log::set_level(log::Level::quiet);
  set_threads(options.threads, communicator);
  return options.restart ? go_on(options, communicator) : begin(options, communicator);
}

}  // namespace whipple::run
