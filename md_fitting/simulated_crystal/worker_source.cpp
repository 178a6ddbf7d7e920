// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/simulated_crystal/worker_source.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <set>

#include "md_fitting/data_set/points.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/log.hpp"
#include "src/core/base/text.hpp"
#include "src/core/process/mpirun.hpp"

namespace whipple::md {
namespace {

bool same(double a, double b) { return std::abs(a - b) <= 1e-9 * std::abs(b); }

}  // namespace

WorkerSource::WorkerSource(const eos::SimulatedConstants& constants, const std::filesystem::path& store)
    : constants_(constants), store_(store) {
  compute({});
  std::set<std::string> tables;
  for (const PointRecord& point : read_store(store_)) {
    if (point.kind() != PointKind::lattice || !mine(point)) continue;
    tables.insert(point.origin("potential_sha256"));
    static_volume_ = point.origin_number("static_specific_volume");
    molar_mass_ = point.origin_number("molar_mass");
  }
  if (tables.size() != 1) {
    throw InputError(fmt::format(
        "{}: the store contains {} different tables under the name of the potential '{}': use another store",
        store_.string(), tables.size(), constants_.potential));
  }
}

bool WorkerSource::mine(const PointRecord& point) const {
  const auto is = [&](const char* entry, const std::string& value) {
    const auto found = point.provenance.find(entry);
    return found != point.provenance.end() && found->second == value;
  };
  if (!is("element", constants_.element) || !is("potential", constants_.potential)) return false;
  if (point.kind() == PointKind::lattice || point.kind() == PointKind::cold_curve) return true;
  return is("cells", std::to_string(constants_.cells)) && is("steps", std::to_string(constants_.steps)) &&
         is("equilibration_steps", std::to_string(constants_.equilibration_steps)) &&
         is("plan_seed", std::to_string(constants_.seed)) && is("ranks", "1");
}

std::string WorkerSource::plan_of(std::span<const double> volume_ratios) const {
  std::string text = fmt::format("element = {}\npotential = {}\nseed = {}\n", toml_string(constants_.element),
                                 toml_string(constants_.potential), constants_.seed);
  if (volume_ratios.empty()) return text;
  text += fmt::format("[cold_curve]\nvolume_ratio = [{}]\n", fmt::join(volume_ratios, ", "));
  for (const double ratio : volume_ratios) {
    text += fmt::format(
        "[[isochore]]\nvolume_ratio = {}\ntemperature = [\"{} K\"]\ncells = {}\nequilibration_steps = "
        "{}\nsteps = "
        "{}\n",
        ratio, fmt::join(constants_.temperature, " K\", \""), constants_.cells,
        constants_.equilibration_steps, constants_.steps);
  }
  return text;
}

void WorkerSource::compute(std::span<const double> volume_ratios) const {
  std::error_code ignored;
  std::filesystem::create_directories(store_.parent_path(), ignored);
  const std::filesystem::path plan =
      store_.parent_path() / fmt::format(".{}.{}.toml", store_.filename().string(), getpid());
  write_text_atomically(plan, plan_of(volume_ratios));
  std::vector<std::string> program = {"whipple-md", plan.string(), "-o", store_.string(), "--of-material"};
  if (log::level() != log::Level::verbose) program.emplace_back("--quiet");
  const int code = process::run_alone(program, {{"OMP_NUM_THREADS", "1"}});
  std::filesystem::remove(plan, ignored);
  // A point that failed is in the database with its message.
  if (code != 0 && code != static_cast<int>(ExitCode::state)) {
    throw InputError(fmt::format("whipple-md ended with code {} for potential '{}' of {}", code,
                                 constants_.potential, constants_.element));
  }
}

bool WorkerSource::find(const std::vector<PointRecord>& points, double volume_ratio,
                        eos::SimulatedIsochore& isochore) const {
  isochore = {};
  isochore.volume = volume_ratio * static_volume_;
  bool cold = false;
  for (const double temperature : constants_.temperature) {
    bool found = false;
    for (const PointRecord& point : points) {
      const bool crystal = point.kind() == PointKind::cold_curve;
      if ((!crystal && point.kind() != PointKind::isochore) || !mine(point) ||
          !same(condition(point, &StatePoint::specific_volume), isochore.volume)) {
        continue;
      }
      if (!crystal && !same(condition(point, &StatePoint::temperature), temperature)) continue;
      if (!point.done()) throw StateError(fmt::format("{}: {}", point.label(), point.message));
      if (crystal) {
        const auto rest = read_as<ColdCurvePoint>(point);
        isochore.cold_pressure = rest.pressure;
        isochore.cold_energy = rest.specific_internal_energy;
        cold = true;
        continue;
      }
      constexpr double whole = 0.9;  // crystal fraction: a cavity or a fault involves more than a tenth
      const auto state = read_as<StatePoint>(point);
      if (!state.solid || state.crystal_share < whole) {
        throw StateError(fmt::format("{}: {}", point.label(), point.message));
      }
      const Estimate &pressure = state.pressure, &energy = state.specific_internal_energy;
      isochore.states.push_back({temperature, pressure.value, pressure.error, energy.value, energy.error});
      found = true;
      break;
    }
    if (!found) return false;
  }
  return cold;
}

std::vector<eos::SimulatedIsochore> WorkerSource::isochores(std::span<const double> volume_ratios) {
  std::vector<eos::SimulatedIsochore> isochores(volume_ratios.size());
  std::vector<double> missing;
  std::vector<PointRecord> points = read_store(store_);
  for (std::size_t i = 0; i < volume_ratios.size(); ++i) {
    if (!find(points, volume_ratios[i], isochores[i])) missing.push_back(volume_ratios[i]);
  }
  if (missing.empty()) return isochores;
  log::info("{}: simulating {} states at V/Vs = {}", constants_.potential,
            missing.size() * constants_.temperature.size(), fmt::join(missing, ", "));
  compute(missing);
  points = read_store(store_);
  for (std::size_t i = 0; i < volume_ratios.size(); ++i) {
    if (!find(points, volume_ratios[i], isochores[i])) {
      throw StateError(fmt::format("whipple-md brought no complete isochore at V/Vs = {}", volume_ratios[i]));
    }
  }
  return isochores;
}

std::filesystem::path default_store(const eos::SimulatedConstants& constants) {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  const char* home = std::getenv("HOME");
  std::filesystem::path folder;
  if (cache != nullptr && *cache != '\0') {
    folder = cache;
  } else if (home != nullptr && *home != '\0') {
    folder = std::filesystem::path(home) / ".cache";
  } else {
    throw InputError("neither XDG_CACHE_HOME nor HOME is set: give 'store'");
  }
  const std::string potential = std::filesystem::path(constants.potential).filename().string();
  return folder / "whipple" / "md" / fmt::format("{}_{}.md.h5", constants.element, potential);
}

std::unique_ptr<eos::IsochoreSource> worker_source(const eos::SimulatedConstants& constants) {
  const std::filesystem::path store =
      constants.store.empty() ? default_store(constants) : std::filesystem::path(constants.store);
  if (!store.is_absolute()) {
    throw InputError(fmt::format("store = \"{}\": expected an absolute path: copies of the material share it",
                                 constants.store));
  }
  return std::make_unique<WorkerSource>(constants, store);
}

}  // namespace whipple::md
