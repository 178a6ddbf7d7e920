// SPDX-License-Identifier: BSD-3-Clause
#include "src/run/runner.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>

#include "src/core/base/error.hpp"
#include "src/core/base/log.hpp"
#include "src/core/base/progress.hpp"
#include "src/core/base/resource_error.hpp"
#include "src/core/base/text.hpp"
#include "src/io/background_writer.hpp"
#include "src/io/element_series.hpp"
#include "src/io/history.hpp"
#include "src/io/particle_series.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/run/checkpointing.hpp"
#include "src/run/gauges.hpp"
#include "src/run/restart.hpp"
#include "src/run/signals.hpp"
#include "src/solver/simulation.hpp"

namespace whipple::run {
namespace {

using Clock = std::chrono::steady_clock;
namespace fs = std::filesystem;

constexpr int out_of_time_code = 124;  // that of timeout(1)

/// Names in checkpoints of the rows that the tables have.
constexpr const char* history_rows = "history_rows";
constexpr const char* gauges_rows = "gauges_rows";

/// J, part of the internal energy of these points.
double stored_cold_work(const MaterialPoints& points) {
  return parallel::sum<double>(points.stored_cold_work.size(),
                               [&](std::size_t p) { return points.mass[p] * points.stored_cold_work[p]; });
}

/// Figures of all ranks. Collective.
std::vector<io::HistoryValue> history_row(const solver::Simulation& simulation) {
  const solver::RunState& state = simulation.state();
  const solver::Totals& t = simulation.totals();
  const Particles& particles = simulation.particles();
  const std::vector<setup::Body>& bodies = simulation.setup().bodies;
  std::vector<solver::PhaseMasses> by_body =
      solver::phase_masses(particles, simulation.meshes(), simulation.bars(), bodies.size());
  sum_over_ranks(simulation.communicator(), by_body);
  solver::PhaseMasses all;
  for (const solver::PhaseMasses& body : by_body) all += body;
  const auto largest = [](const std::vector<double>& values, double so_far) {
    return parallel::maximum(values.size(), so_far, [&](std::size_t p) { return values[p]; });
  };
  const auto fastest = [](const std::vector<Vector3>& velocity, double so_far) {
    return std::sqrt(parallel::maximum(velocity.size(), so_far * so_far,
                                       [&](std::size_t p) { return velocity[p].squaredNorm(); }));
  };
  constexpr double none = -std::numeric_limits<double>::infinity();
  std::array<double, 3> maxima = {fastest(particles.velocity, 0.0), largest(particles.pressure, none),
                                  largest(particles.temperature, none)};
  for (const fem::Mesh& mesh : simulation.meshes()) {
    maxima = {fastest(mesh.nodes.velocity, maxima[0]), largest(mesh.points.pressure, maxima[1]),
              largest(mesh.points.temperature, maxima[2])};
  }
  parallel::maximum(simulation.communicator(), maxima);
  std::vector<io::HistoryValue> row = {
      {"step", "", static_cast<double>(state.step)},
      {"time", "s", state.time},
      {"dt", "s", state.time_step},
      {"mass", "kg", t.mass},
      {"kinetic_energy", "J", t.kinetic_energy},
      {"affine_kinetic_energy", "J", t.affine_kinetic_energy},
      {"internal_energy", "J", t.internal_energy},
      {"unresolved_energy", "J", t.unresolved_energy},
      {"unresolved_share", "1", t.unresolved_share()},
      {"total_energy", "J", t.energy()},
      {"energy_error", "1", state.ledger.energy_error(t)},
      {"momentum_x", "kg m/s", t.momentum[0]},
      {"momentum_y", "kg m/s", t.momentum[1]},
      {"momentum_z", "kg m/s", t.momentum[2]},
      {"momentum_error", "1", state.ledger.momentum_error(t)},
      {"viscous_work", "J", state.ledger.viscous_work},
      {"plastic_work", "J", state.ledger.plastic_work},
      {"transfer_heat", "J", state.ledger.transfer_heat},
      {"unresolved_kept", "J", state.ledger.unresolved_kept},
      {"unresolved_returned", "J", state.ledger.unresolved_returned},
      {"conducted_heat", "J", state.ledger.conducted_heat},
      {"contact_heat", "J", state.ledger.contact_heat},
      {"friction_heat", "J", state.ledger.friction_heat},
      {"contact_impulse", "N s", state.ledger.contact_impulse},
      {"friction_impulse", "N s", state.ledger.friction_impulse},
      {"outflow_mass", "kg", state.ledger.outflow.mass},
      {"outflow_energy", "J", state.ledger.outflow.energy()},
      {"wall_impulse_x", "N s", state.ledger.wall_impulse[0]},
      {"wall_impulse_y", "N s", state.ledger.wall_impulse[1]},
      {"wall_impulse_z", "N s", state.ledger.wall_impulse[2]},
      {"mass_solid", "kg", all.mass[0]},
      {"mass_melting", "kg", all.mass[1]},
      {"mass_liquid", "kg", all.mass[2]},
      {"mass_vapour", "kg", all.mass[3]},
      {"failed_mass", "kg", all.failed},
      {"maximum_speed", "m/s", maxima[0]},
      {"maximum_pressure", "Pa", maxima[1]},
      {"maximum_temperature", "K", maxima[2]},
      {"squeezed_beside_voids", "kg", state.squeezed_beside_voids},
      {"particles", "1", static_cast<double>(simulation.particle_count())},
  };
  for (const solver::Limiter& limiter : solver::limiters) row.push_back({limiter.name, "1", state.ledger.*(limiter.count)});
  if (simulation.setup().has_elements()) {
    row.push_back({"elements", "1", static_cast<double>(simulation.element_count())});
    row.push_back({"converted_mass", "kg", state.ledger.converted_mass});
    row.push_back({"conversion_heat", "J", state.ledger.conversion_heat});
    row.push_back({"hourglass_energy", "J", t.hourglass_energy});
  }
  if (std::ranges::any_of(simulation.setup().materials,
                          [](const auto& material) { return material->stores_cold_work(); })) {
    std::array<double, 1> stored = {stored_cold_work(particles)};
    for (const fem::Mesh& mesh : simulation.meshes()) stored[0] += stored_cold_work(mesh.points);
    parallel::sum(simulation.communicator(), stored);
    row.push_back({"stored_cold_work", "J", stored[0]});
  }
  if (simulation.setup().has_bars()) {
    std::array<double, 3> sums{};
    for (const fem::Bars& bars : simulation.bars()) {
      sums[0] += static_cast<double>(bars.elements.size());
      sums[1] += static_cast<double>(std::ranges::count(bars.elements.broken, 1));
      sums[2] += fem::internal_energy(bars);
    }
    parallel::sum(simulation.communicator(), sums);
    row.push_back({"bars", "1", sums[0]});
    row.push_back({"broken_bars", "1", sums[1]});
    row.push_back({"bar_energy", "J", sums[2]});
  }
  static constexpr std::array<const char*, 4> phases = {"mass_solid", "mass_melting", "mass_liquid",
                                                        "mass_vapour"};
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    for (std::size_t i = 0; i < phases.size(); ++i) {
      row.push_back({fmt::format("{}.{}", phases[i], bodies[b].name), "kg", by_body[b].mass[i]});
    }
  }
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const solver::BodyOutflow& out = state.outflow_of_body[b];
    const std::string& name = bodies[b].name;
    row.push_back({"outflow_mass." + name, "kg", out.mass});
    row.push_back({"outflow_momentum_x." + name, "kg m/s", out.momentum[0]});
    row.push_back({"outflow_momentum_y." + name, "kg m/s", out.momentum[1]});
    row.push_back({"outflow_momentum_z." + name, "kg m/s", out.momentum[2]});
    row.push_back({"outflow_energy." + name, "J", out.energy});
  }
  return row;
}

std::string profile_as_json(solver::Simulation& simulation, double wall_seconds) {
  nlohmann::json stages = nlohmann::json::array();
  for (const solver::Profile::Stage& stage : simulation.profile().stages()) {
    stages.push_back({{"stage", stage.name}, {"seconds", stage.seconds}, {"calls", stage.calls}});
  }
  return nlohmann::json({{"wall_seconds", wall_seconds},
                         {"ranks", parallel::size(simulation.communicator())},
                         {"threads", parallel::threads()},
                         {"steps", simulation.state().step},
                         {"particles", simulation.particle_count()},
                         {"elements", simulation.element_count()},
                         {"bytes_of_first_rank", simulation.bytes()},
                         {"stages", stages}})
      .dump(2);
}

/// The run's input as it stands in every snapshot: without the time of the start, so that a run that is
/// repeated writes the same bytes.
std::string input_without_start(const fs::path& file) {
  std::string text = io::read_text(file);
  constexpr std::string_view key = "\nstarted = ";
  if (const std::size_t begin = text.rfind(key); begin != std::string::npos) {
    text.erase(begin, text.find('\n', begin + 1) - begin);
  }
  return text;
}

io::SeriesOptions series_options(const setup::Case& setup, const io::RunDirectory& directory,
                                 const fs::path& folder) {
  io::SeriesOptions options{.folder = folder,
                            .name = directory.name(),
                            .fields = setup.output.fields,
                            .material_of_body = {},
                            .provenance = {{"input", input_without_start(directory.input_file())}}};
  // Bodies of one material share its number: that of its first body.
  for (const auto& material : setup.materials) {
    const auto first = std::ranges::find(setup.materials, material);
    options.material_of_body.push_back(static_cast<std::uint16_t>(first - setup.materials.begin()));
  }
  return options;
}

/// The series of snapshots of a run.
struct Snapshots {
  io::ParticleSeries particles;
  std::optional<io::ElementSeries> elements;  // of cases with bodies of elements or bars

  Snapshots(const setup::Case& setup, const io::RunDirectory& directory, const fs::path& folder)
      : particles(series_options(setup, directory, folder), parallel::world()) {
    if (setup.has_elements() || setup.has_bars())
      elements.emplace(series_options(setup, directory, folder), parallel::world());
  }
  void restart(double time) {
    particles.restart(time);
    if (elements) elements->restart(time);
  }
  void write(const solver::Simulation& simulation) {
    particles.write(simulation.particles(), simulation.state().time);
    if (elements) elements->write(simulation.meshes(), simulation.bars(), simulation.state().time);
  }
  /// Takes the state of now; what is returned writes it. Of a run on one rank.
  [[nodiscard]] std::function<void()> prepare(const solver::Simulation& simulation) {
    const double time = simulation.state().time;
    const std::function<void()> of_elements =
        elements ? elements->prepare(simulation.meshes(), simulation.bars(), time) : std::function<void()>();
    return [of_particles = particles.prepare(simulation.particles(), time), of_elements] {
      of_particles();
      if (of_elements) of_elements();
    };
  }
};

/// The loop of a run and everything that it writes.
class Runner {
 public:
  Runner(const setup::Case& setup, const io::RunDirectory& directory, const RunOptions& options,
         const io::Ranks& ranks)
      : directory_(directory),
        ranks_(ranks),
        wall_time_(options.wall_time),
        simulation_(setup, parallel::world()),
        series_(setup, directory, directory.path()),
        recorder_(setup.gauges.all(), simulation_) {
    if (ranks_.is_root()) {
      history_.emplace(directory.history_file());
      gauges_.emplace(gauges_file());
    }
    write_snapshot();
    append_history();
    append_gauges();
  }

  Runner(const setup::Case& setup, const io::RunDirectory& directory, io::Checkpoint checkpoint,
         const std::string& changed_input, const RunOptions& options, const io::Ranks& ranks)
      : directory_(directory),
        ranks_(ranks),
        wall_time_(options.wall_time),
        simulation_(resume(setup, checkpoint, parallel::world())),
        series_(setup, with_input(directory, changed_input, ranks), directory.path()),
        recorder_(setup.gauges.all(), checkpoint.values),
        snapshots_(checkpoint.values.integer("snapshots")) {
    ranks_.on_root([&] {
      const auto reopen = [&](const fs::path& file, const char* rows) {
        io::History table = io::History::restart(file, simulation_.state().step);
        const std::int64_t expected = checkpoint.values.integer(rows);
        if (table.rows() != expected && !options.force) {
          throw InputError(
              fmt::format("{}: has {} rows up to step {} of the checkpoint, but {} were written; bring the file "
                          "back, or go on without them: whipple run --restart {} --force",
                          file.string(), table.rows(), simulation_.state().step, expected,
                          directory.path().string()));
        }
        return table;
      };
      history_.emplace(reopen(directory.history_file(), history_rows));
      gauges_.emplace(reopen(gauges_file(), gauges_rows));
    });
    series_.restart(simulation_.state().time);
    log::info("restarted from {} at step {}, t = {:.6g} s", checkpoint.path.string(),
              simulation_.state().step, simulation_.state().time);
  }

  /// @throws ResourceError where disk or memory do not suffice
  int run() {
    try {
      return steps();
    } catch (const InputError& error) {  // the input was read: a file that cannot be written
      throw ResourceError(go_on_later(error.what()));
    } catch (const std::bad_alloc&) {
      throw ResourceError(go_on_later("the memory that this process may use is exhausted"));
    }
  }

 private:
  int steps() {
    const setup::Case& setup = simulation_.setup();
    const double end = setup.time.end;
    const Signals signals;
    std::optional<Progress> progress;
    if (ranks_.is_root()) {
      progress.emplace("run", end);
      progress->start_from(simulation_.state().time);
    }
    const Clock::time_point begin = Clock::now();
    Clock::time_point last_checkpoint = begin;
    Requests requests;
    while (simulation_.state().time < end && !requests.end()) {
      advance(end);
      const solver::RunState& state = simulation_.state();
      const bool last = state.time >= end;
      if (last || state.step % setup.output.history_every == 0) append_history();
      if (last || state.step % setup.output.gauges_every == 0) append_gauges();
      const double next_snapshot = setup.output.snapshot_every * static_cast<double>(snapshots_);
      if (last || (setup.output.snapshot_every > 0.0 && state.time >= next_snapshot)) write_snapshot();
      const double since = seconds_since(last_checkpoint);
      const bool due = setup.output.checkpoint_every > 0.0 && since >= setup.output.checkpoint_every;
      requests = agree({.signal = signals.end_requested(),
                        .checkpoint = due || signals.checkpoint_requested(),
                        .out_of_time = wall_time_ > 0.0 && seconds_since(begin) >= wall_time_});
      if (last || requests.checkpoint || requests.end()) {
        write_checkpoint(directory_.checkpoint_folder());
        last_checkpoint = Clock::now();
      }
      if (progress) {
        progress->update(
            state.time,
            fmt::format("step {}, t = {:.3f} us, dt = {:.2f} ns, {} particles, dE/E = {:.1e}", state.step,
                        1e6 * state.time, 1e9 * state.time_step, simulation_.particle_count(),
                        state.ledger.energy_error(simulation_.totals())));
      }
    }
    progress.reset();  // ends its line before the summary
    const double wall = seconds_since(begin);
    ranks_.on_root([&] {
      io::write_text_atomically(directory_.profile_file(), profile_as_json(simulation_, wall));
      report_end(requests, wall);
    });
    if (simulation_.state().time >= end) return 0;
    return requests.signal != 0 ? 128 + requests.signal : out_of_time_code;
  }

  /// What asks the loop for something, on any rank.
  struct Requests {
    int signal = 0;
    bool checkpoint = false;
    bool out_of_time = false;
    [[nodiscard]] bool end() const { return signal != 0 || out_of_time; }
  };

  /// A signal may reach the ranks in different steps, and clocks differ: all do what one of them asks for.
  [[nodiscard]] Requests agree(const Requests& own) const {
    std::array<double, 3> numbers = {static_cast<double>(own.signal), own.checkpoint ? 1.0 : 0.0,
                                     own.out_of_time ? 1.0 : 0.0};
    parallel::maximum(simulation_.communicator(), numbers);
    return {static_cast<int>(numbers[0]), numbers[1] > 0.0, numbers[2] > 0.0};
  }

  /// The next restart goes on with the changed input.
  static const io::RunDirectory& with_input(const io::RunDirectory& directory, const std::string& changed,
                                            const io::Ranks& ranks) {
    ranks.on_root([&] {
      if (!changed.empty()) directory.write_input(changed);
    });
    return directory;
  }

  static double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
  }

  void append_history() {
    const std::vector<io::HistoryValue> row = history_row(simulation_);
    ranks_.on_root([&] { history_->append(row); });
  }

  [[nodiscard]] fs::path gauges_file() const { return directory_.path() / "gauges.csv"; }

  void append_gauges() {
    if (recorder_.empty()) return;
    const std::vector<io::HistoryValue> row = recorder_.row(simulation_);
    ranks_.on_root([&] { gauges_->append(row); });
  }

  void advance(double end) {
    try {
      simulation_.advance(end);
    } catch (const StateError& error) {
      throw StateError(fmt::format("{}\n  {}", error.what(), save_failed_state()));
    }
  }

  /// What is said of a run that stopped for want of something: its checkpoints are good.
  [[nodiscard]] std::string go_on_later(const std::string& reason) const {
    const bool any = !io::list_checkpoints(directory_.checkpoint_folder()).empty();
    return fmt::format(
        "{}\n  stopped at step {}, t = {:.6g} s; {}", reason, simulation_.state().step,
        simulation_.state().time,
        any ? fmt::format("once there is room go on from the last checkpoint with: whipple run "
                          "--restart {}",
                          directory_.path().string())
            : "no checkpoint had been written");
  }

  /// The state as the failing step left it, in a folder of its own: checkpoints and snapshots of the run stay
  /// good.
  std::string save_failed_state() {
    const fs::path folder = directory_.path() / "failed";
    try {
      write_checkpoint(folder);
      Snapshots(simulation_.setup(), directory_, folder).write(simulation_);
      return fmt::format("the state is saved in {}", folder.string());
    } catch (const std::exception& error) {
      return fmt::format("the state could not be saved: {}", error.what());
    }
  }

  void write_snapshot() {
    // Ranks write together, by calls of MPI; and a writer that takes turns with the threads of the steps,
    // which wait for one another, holds them up for longer than it takes.
    if (ranks_.is_parallel() || parallel::free_cores() == 0) {
      writer_.wait();
      series_.write(simulation_);
    } else {
      writer_.start(series_.prepare(simulation_));
    }
    const double every = simulation_.setup().output.snapshot_every;
    // The next multiple of the interval, also when a step was longer than it.
    snapshots_ =
        every > 0.0 ? static_cast<std::int64_t>(std::floor(simulation_.state().time / every)) + 1 : 1;
  }

  void write_checkpoint(const fs::path& folder) {
    writer_.wait();
    io::CheckpointValues values = to_checkpoint(simulation_.state());
    values.integers["snapshots"] = snapshots_;
    const auto rows_of = [&](const std::optional<io::History>& table) {
      return std::stoll(ranks_.broadcast(table ? fmt::format("{}", table->rows()) : ""));
    };
    values.integers[history_rows] = rows_of(history_);
    values.integers[gauges_rows] = rows_of(gauges_);
    recorder_.to_checkpoint(values);
    values.texts["run_name"] = directory_.name();
    remember_input(simulation_.setup(), values);
    // What the checkpoint counts must not be lost where it is kept.
    ranks_.on_root([&] {
      history_->force_to_disk();
      gauges_->force_to_disk();
    });
    const fs::path path = io::write_checkpoint(
        folder, simulation_.state().step, simulation_.particles(), values, simulation_.communicator(),
        simulation_.meshes_for_checkpoint(), simulation_.bars_for_checkpoint());
    log::detail("checkpoint {}", path.string());
  }

  void report_end(const Requests& requests, double wall) {
    const solver::RunState& state = simulation_.state();
    const solver::Totals& totals = simulation_.totals();
    if (requests.end() && state.time < simulation_.setup().time.end) {
      const std::string by =
          requests.signal != 0 ? fmt::format("signal {}", requests.signal) : "the limit of wall time";
      log::info("stopped by {} at step {}, t = {:.6g} s; go on with: whipple run --restart {}", by,
                state.step, state.time, directory_.path().string());
    }
    log::info("{} steps to t = {:.6g} s in {}; energy error {:.2e}, momentum error {:.2e}, outflow {:.3g} kg",
              state.step, state.time, format_duration(wall), state.ledger.energy_error(totals),
              state.ledger.momentum_error(totals), state.ledger.outflow.mass);
    for (const solver::Limiter& limiter : solver::limiters) {
      const double count = state.ledger.*(limiter.count);
      if (count > 0.0) log::info("{}: {:.0f} times", limiter.meaning, count);
    }
    if (totals.unresolved_share() > 0.05) {
      log::info(
          "{:.2g} % of the kinetic energy is motion that the cells do not resolve: finer cells would change "
          "the "
          "result",
          100.0 * totals.unresolved_share());
    }
    log::info("wrote {} ({} snapshots: open {} in ParaView)", directory_.path().string(),
              series_.particles.size(), series_.particles.index_path().string());
  }

  io::RunDirectory directory_;
  io::Ranks ranks_;
  double wall_time_;  // s, 0: no limit
  solver::Simulation simulation_;
  Snapshots series_;
  io::BackgroundWriter writer_;  // of the series
  GaugeRecorder recorder_;
  std::optional<io::History> history_;  // on the root
  std::optional<io::History> gauges_;   // on the root
  std::int64_t snapshots_ = 0;          // multiple of the interval at which the next snapshot is due
};

}  // namespace

int run_steps(const setup::Case& setup, const io::RunDirectory& directory, const RunOptions& options,
              const io::Ranks& ranks) {
  return Runner(setup, directory, options, ranks).run();
}

int run_steps(const setup::Case& setup, const io::RunDirectory& directory, io::Checkpoint checkpoint,
              const std::string& changed_input, const RunOptions& options, const io::Ranks& ranks) {
  return Runner(setup, directory, std::move(checkpoint), changed_input, options, ranks).run();
}

}  // namespace whipple::run
