// SPDX-License-Identifier: BSD-3-Clause
#include "src/run/observers/snapshots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include "src/core/base/files.hpp"
#include "src/core/base/log.hpp"
#include "src/core/parallel/threads.hpp"

namespace whipple::run {
namespace {

namespace fs = std::filesystem;

constexpr const char* next_name = "snapshots";  // in checkpoints

/// Returns the run's input without its start time, so that a repeated run writes identical files.
std::string input_without_start(const fs::path& file) {
  std::string text = read_text(file);
  constexpr std::string_view key = "\nstarted = ";
  if (const std::size_t begin = text.rfind(key); begin != std::string::npos) {
    text.erase(begin, text.find('\n', begin + 1) - begin);
  }
  return text;
}

io::SeriesOptions series_options(const cases::Case& setup, const io::RunDirectory& directory,
                                 const fs::path& folder) {
  io::SeriesOptions options{.folder = folder,
                            .name = directory.name(),
                            .fields = setup.output.fields,
                            .material_of_body = {},
                            .provenance = {{"input", input_without_start(directory.input_file())}},
                            .geometry = setup.geometry};
  // Bodies of one material share its number: that of the first such body.
  for (const auto& material : setup.materials) {
    const auto first = std::ranges::find(setup.materials, material);
    options.material_of_body.push_back(static_cast<std::uint16_t>(first - setup.materials.begin()));
  }
  return options;
}

constexpr double tolerance = 1e-6;  // of the interval: times closer to its end are at its end

/// Returns the number of the first multiple of an interval after a time.
std::int64_t next_multiple(double time, double every) {
  return every > 0.0 ? static_cast<std::int64_t>(std::floor(time / every + tolerance)) + 1 : 1;
}

}  // namespace

SnapshotFiles::SnapshotFiles(const cases::Case& setup, const io::RunDirectory& directory,
                             const fs::path& folder, MPI_Comm communicator)
    : particles_(series_options(setup, directory, folder), communicator) {
  if (setup.has_elements() || setup.has_bars())
    elements_.emplace(series_options(setup, directory, folder), communicator);
}

void SnapshotFiles::restart(double time) {
  particles_.restart(time);
  if (elements_) elements_->restart(time);
}

void SnapshotFiles::write(const solver::Simulation& simulation) {
  const solver::View view = simulation.view();
  const double time = simulation.state().time;
  particles_.write(*view.particles, time);
  if (elements_) elements_->write(view.meshes, view.bars, time);
}

std::function<void()> SnapshotFiles::prepare(const solver::Simulation& simulation) {
  const solver::View view = simulation.view();
  const double time = simulation.state().time;
  const std::function<void()> of_elements =
      elements_ ? elements_->prepare(view.meshes, view.bars, time) : std::function<void()>();
  return [of_particles = particles_.prepare(*view.particles, time), of_elements] {
    of_particles();
    if (of_elements) of_elements();
  };
}

void Snapshots::begin(const Moment& moment) {
  every_ = moment.schedule.snapshot_every;
  write(moment);
}

void Snapshots::resume(const Moment& moment, const io::CheckpointValues& values) {
  every_ = moment.schedule.snapshot_every;
  // The number in the checkpoint refers to the interval at that time, which may have been shorter.
  next_ = std::min(values.integer(next_name), next_multiple(moment.time(), every_));
  files_.restart(moment.time());
}

void Snapshots::after_step(const Moment& moment) {
  if (const double every = moment.schedule.snapshot_every; every != every_) {
    every_ = every;
    next_ = next_multiple(moment.time(), every);
  }
  const bool due = every_ > 0.0 && moment.time() >= every_ * (static_cast<double>(next_) - tolerance);
  if (moment.is_last() || due || moment.asks_for(Act::snapshot)) write(moment);
}

void Snapshots::write(const Moment& moment) {
  if (moment.step() == last_step_) return;
  // Ranks write collectively, through MPI. Without a free core, a writer thread delays the threads of a step, which
  // wait for one another, by more than the duration of the writing.
  if (ranks_.is_parallel() || parallel::free_cores() == 0) {
    writer_.wait();
    files_.write(moment.simulation);
  } else {
    writer_.start(files_.prepare(moment.simulation));
  }
  next_ = next_multiple(moment.time(), every_);
  last_step_ = moment.step();
}

double Snapshots::next_time() const {
  return every_ > 0.0 ? every_ * static_cast<double>(next_) : std::numeric_limits<double>::infinity();
}

void Snapshots::remember(io::CheckpointValues& values) {
  writer_.wait();  // HDF5 is not used from two threads at the same time
  values.integers[next_name] = next_;
}

void Snapshots::end(const Moment& moment, Outcome& outcome) {
  if (outcome.kind == Outcome::Kind::out_of_resources) return;
  writer_.wait();
  if (outcome.kind == Outcome::Kind::left_range) {  // the earlier snapshots of the run stay valid
    const fs::path folder = directory_.failed_folder();
    ranks_.on_root([&] { fs::create_directories(folder); });
    SnapshotFiles(moment.simulation.setup(), directory_, folder, moment.simulation.communicator())
        .write(moment.simulation);
  } else if (ranks_.is_root()) {
    log::info("wrote {} ({} snapshots: open {} in ParaView)", directory_.path().string(),
              files_.particles().size(), files_.particles().index_path().string());
  }
}

}  // namespace whipple::run
