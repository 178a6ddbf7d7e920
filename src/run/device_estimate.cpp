// SPDX-License-Identifier: BSD-3-Clause
#include "src/run/device_estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/base/text.hpp"
#include "src/device/engine.hpp"
#include "src/device/lattice.hpp"
#include "src/solver/device/device.hpp"

namespace whipple::run {
namespace {

std::size_t count_different(std::vector<std::uint64_t>& keys) {
  std::ranges::sort(keys);
  const auto [first, last] = std::ranges::unique(keys);
  return static_cast<std::size_t>(first - keys.begin());
}

/// Counts the blocks and cells that the particles reach, as device::FindPlaces does.
template <class Lattice>
void count_places(const solver::Simulation& simulation, const device::Problem& problem,
                  device::StepSize& size) {
  const auto lattice = device::lattice_of<Lattice>(problem);
  const Particles& particles = simulation.particles();
  std::vector<std::uint64_t> cells, blocks;
  cells.reserve(particles.size());
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const Vector3& x = particles.position[p];
    const device::Place first = Lattice::first_node(lattice.in_cells({x[0], x[1], x[2]}));
    const std::uint32_t field = problem.field_of_body[particles.body[p]];
    cells.push_back(std::uint64_t{lattice.block_at(field, first)} * device::block_nodes +
                    Lattice::inside(first));
  }
  size.cells = static_cast<double>(count_different(cells));
  cells.resize(static_cast<std::size_t>(size.cells));
  for (const std::uint64_t cell : cells) {
    const auto block = static_cast<std::uint32_t>(cell / device::block_nodes);
    const device::Place first =
        lattice.place_in(block, static_cast<std::uint32_t>(cell % device::block_nodes));
    constexpr int last = device::stencil_edge - 1, last_z = Lattice::stencil_edge_z - 1;
    for (int corner = 0; corner < 8; ++corner) {
      blocks.push_back(lattice.block_at(
          block / lattice.blocks_of_field(),
          {first.x + ((corner & 1) != 0 ? last : 0), first.y + ((corner & 2) != 0 ? last : 0),
           first.z + ((corner & 4) != 0 ? last_z : 0)}));
    }
  }
  size.slots = static_cast<double>(count_different(blocks));
  size.blocks = device::count_blocks(problem);
}

}  // namespace

void require_device_case(const cases::Case& setup) {
  if (auto faults = solver::device_faults(setup); !faults.empty()) throw InputError(std::move(faults));
}

DeviceEstimate estimate_device(const solver::Simulation& simulation, double bandwidth) {
  const device::Problem problem = simulation.device_problem();
  DeviceEstimate estimate;
  device::StepSize& size = estimate.size;
  size.particles = static_cast<double>(simulation.particle_count());
  size.reflects = problem.reflecting_faces() != 0;
  size.fields = problem.fields;
  size.conducts = problem.shock_conduction > 0.0;
  size.planar = problem.dimension != device::Dimension::space;
  if (size.planar) {
    count_places<device::SectionLattice>(simulation, problem, size);
  } else {
    count_places<device::SpaceLattice>(simulation, problem, size);
  }
  estimate.need = device::memory_need(size);
  device::StepSize dispersed = size;
  dispersed.cells = size.particles;
  dispersed.slots = std::min(8.0 * size.particles, size.blocks);
  estimate.dispersed = device::memory_need(dispersed);
  estimate.most_particles = forecast_splitting(simulation).most_particles;
  estimate.least_bytes = device::cost_of_step(size).least_bytes;
  estimate.card = device::find_card();
  if (bandwidth > 0.0) {
    estimate.bandwidth = bandwidth;
  } else if (estimate.card) {
    estimate.bandwidth = device::card_rates().bandwidth;
    estimate.is_measured = true;
  }
  return estimate;
}

void set_time(DeviceEstimate& estimate, const Forecast& forecast) {
  estimate.least_time =
      forecast.least_steps * estimate.size.particles * estimate.least_bytes / estimate.bandwidth;
}

std::string device_text(const DeviceEstimate& e) {
  std::string text = e.card ? fmt::format("device: {}, {} of {} free\n", e.card->name,
                                          format_bytes(e.card->free_memory), format_bytes(e.card->memory))
                            : std::string("device: this machine has no graphics processor\n");
  text += fmt::format(
      "device memory: {} at the start ({:.0f} bytes per particle, {:.0f} per block with nodes, {:.0f} per "
      "cell with "
      "particles: {:.0f} blocks, {:.0f} cells), at most {} if all particles were alone in their cells{}\n",
      format_bytes(e.need.all), e.need.per_particle, e.need.per_slot, e.need.per_cell, e.size.slots,
      e.size.cells, format_bytes(e.dispersed.all),
      e.most_particles > e.size.particles
          ? fmt::format(", {:.1f} times as much after all divisions", e.most_particles / e.size.particles)
          : std::string());
  if (e.card && e.need.all > e.card->free_memory)
    text += "warning: the device has less memory than the start needs\n";
  if (!(e.least_time > 0.0)) return text;
  text += fmt::format(
      "device time: more than {} (lower bound: the fewest steps, {:.0f} bytes per particle and step, over "
      "{:.2f} TB/s, "
      "{})\n",
      e.least_time < 60.0 ? fmt::format("{:.2g} s", e.least_time) : format_duration(e.least_time),
      e.least_bytes, 1e-12 * e.bandwidth, e.is_measured ? "measured" : "assumed: --bandwidth");
  return text;
}

nlohmann::json device_json(const DeviceEstimate& e) {
  nlohmann::json json = {{"memory", e.need.all},
                         {"memory_dispersed", e.dispersed.all},
                         {"most_particles", e.most_particles},
                         {"bytes_per_particle", e.need.per_particle},
                         {"bytes_per_block", e.need.per_slot},
                         {"bytes_per_cell", e.need.per_cell},
                         {"blocks", e.size.slots},
                         {"cells", e.size.cells},
                         {"least_bytes_per_particle_step", e.least_bytes},
                         {"bandwidth", e.bandwidth},
                         {"bandwidth_is_measured", e.is_measured},
                         {"card", nullptr}};
  if (e.least_time > 0.0) json["least_seconds"] = e.least_time;
  if (e.card)
    json["card"] = {{"name", e.card->name}, {"memory", e.card->memory}, {"free", e.card->free_memory}};
  return json;
}

}  // namespace whipple::run
