// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/protocols/task_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/core/base/error.hpp"
#include "src/core/base/hash.hpp"
#include "src/core/base/units.hpp"

namespace whipple::md {
namespace {

/// Returns the provenance common to all points of a plan.
std::map<std::string, std::string> common_settings(const Plan& plan, const Potential& potential) {
  std::map<std::string, std::string> settings = {
      {"element", potential.element()},
      {"molar_mass", fmt::format("{}", 1e-3 * potential.mass())},
      {"potential", potential.name()},
      {"potential_file", potential.file().filename().string()},
      {"potential_sha256", potential.hash()},
      {"potential_source", potential.source()},
      {"structure", std::string(word_of(potential.structure()))},
      {"static_specific_volume", fmt::format("{}", potential.static_volume())},
      {"density_table_end", fmt::format("{}", potential.table_end())},
      {"lammps_version", std::to_string(lammps_release())},
      {"ranks", std::to_string(plan.ranks_per_point)},
      {"plan_seed", std::to_string(plan.seed)}};
  if (std::isfinite(potential.validity().pressure)) {
    settings["validity_pressure"] = fmt::format("{:.4g} GPa", 1e-9 * potential.validity().pressure);
    settings["validity_reason"] = potential.validity().reason;
  }
  return settings;
}

/// Returns everything on which the numbers of a point depend, as text.
std::string identity(const Task& task) {
  // Names and file locations change no number; all other entries may.
  static const std::set<std::string> without_effect = {
      "potential",         "potential_file",    "potential_source", "static_specific_volume",
      "density_table_end", "validity_pressure", "validity_reason"};
  std::string text = "protocol=" + task.protocol + "\ndependency=" + task.dependency + "\n";
  for (const auto& [name, value] : task.conditions) text += fmt::format("condition {}={}\n", name, value);
  for (const auto& [name, value] : task.provenance) {
    if (!without_effect.contains(name)) text += fmt::format("{}={}\n", name, value);
  }
  return text;
}

}  // namespace

TaskList::TaskList(const Plan& plan, const Potential& potential)
    : potential_(potential), common_(common_settings(plan, potential)) {}

void TaskList::begin_protocol(const std::string& name, int revision) {
  protocol_ = name;
  revision_ = revision;
}

void TaskList::fault(const std::string& text) {
  faults_ += fmt::format("{}{}: {}", faults_.empty() ? "" : "\n", protocol_, text);
}

void TaskList::require_range(double volume_ratio) {
  try {
    potential_.require_range(volume_ratio);
  } catch (const InputError& error) {
    fault(error.what());
  }
}

void TaskList::require_box(const PointRequest& request) {
  const auto cells = request.settings.find("cells");
  if (cells == request.settings.end()) return;
  const auto volume = request.conditions.find(std::string(name_of(&StatePoint::specific_volume)));
  const double ratio = volume == request.conditions.end() ? 1.0 : volume->second / potential_.static_volume();
  const double width = std::stod(cells->second) * potential_.lattice_constant() * std::cbrt(ratio);
  if (width >= potential_.cutoff()) return;
  fault(fmt::format(
      "a box of {} cells is {:.2f} angstrom wide at V/V0 = {:.3f}, less than the cutoff of {}, {:.2f} "
      "angstrom: atoms would interact with their own images; use cells = {} or more",
      cells->second, width, ratio, potential_.name(), potential_.cutoff(),
      static_cast<int>(std::ceil(std::stod(cells->second) * potential_.cutoff() / width))));
}

std::string TaskList::add(const PointRequest& request, Compute compute) {
  require_box(request);
  Task task;
  task.protocol = protocol_;
  task.conditions = request.conditions;
  task.dependency = request.dependency;
  task.provenance = common_;
  task.provenance.insert(request.settings.begin(), request.settings.end());
  task.provenance["revision"] = std::to_string(revision_);
  task.key = sha256(identity(task));
  const std::int64_t seed = seed_from(task.key);
  task.provenance["seed"] = std::to_string(seed);
  task.precision = request.precision;
  task.extend = [key = task.key, compute](const PointRecord* dependency, int segment) {
    return compute(seed_from(sha256(fmt::format("{} {}", key, segment))), dependency);
  };
  task.compute = [seed, compute = std::move(compute)](const PointRecord* dependency) {
    return compute(seed, dependency);
  };
  std::string key = task.key;
  if (keys_.insert(key).second) tasks_.push_back(std::move(task));
  return key;
}

std::string TaskList::first_key(std::string_view protocol) const {
  const auto found =
      std::find_if(tasks_.begin(), tasks_.end(), [&](const Task& task) { return task.protocol == protocol; });
  return found == tasks_.end() ? std::string{} : found->key;
}

std::vector<Task> TaskList::take() {
  if (!faults_.empty()) throw InputError(faults_);
  return std::move(tasks_);
}

std::map<std::string, std::string> size_settings(const RunSize& size) {
  return {{"cells", std::to_string(size.cells)},
          {"equilibration_steps", std::to_string(size.equilibration_steps)},
          {"steps", std::to_string(size.steps)},
          {"time_step", size.time_step > 0.0 ? fmt::format("{} s", size.time_step) : "automatic"}};
}

std::string with_validity(std::string message, const PointRecord& point) {
  const auto limit = point.provenance.find("validity_pressure");
  if (limit == point.provenance.end()) return message;
  const auto result = point.results.find(std::string(name_of(&StatePoint::pressure)));
  const auto condition = point.conditions.find(std::string(name_of(&CoexistencePoint::pressure)));
  if (result == point.results.end() && condition == point.conditions.end()) return message;
  const double pressure = result != point.results.end() ? result->second.value : condition->second;
  if (pressure <= units::parse_quantity(limit->second, "Pa")) return message;
  return fmt::format("{}{}beyond the validity of the potential, {} ({})", message,
                     message.empty() ? "" : "; ", limit->second, point.origin("validity_reason"));
}

std::string structure_remark(double crystal_share, bool solid, double displacement) {
  constexpr double lindemann = 0.2;  // crystals melt at 0.15, overheated ones without surfaces a little above
  constexpr double whole = 0.9;      // a cavity or stacking fault involves more than a tenth of the atoms
  if (!solid) return fmt::format("the crystal melted (fraction of crystal {:.2f})", crystal_share);
  if (crystal_share < whole) {
    return fmt::format("the crystal has defects or a cavity (fraction of crystal {:.2f})", crystal_share);
  }
  if (displacement > lindemann) {
    return fmt::format(
        "atoms move {:.2f} of the distance of their neighbours, and crystals melt at 0.15: an overheated "
        "or unstable crystal",
        displacement);
  }
  return {};
}

}  // namespace whipple::md
