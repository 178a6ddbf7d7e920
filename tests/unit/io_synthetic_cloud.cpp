// SPDX-License-Identifier: BSD-3-Clause
// Writes the folder of a made-up run with the writers of src/io: a quarter of a copper disk that goes through
// an aluminium plate and becomes a cloud in free flight. It is no physics; masses, momentum and energy of the
// cloud are known in closed form, so that the programs that read the folder can be tested:
//   every particle moves with constant velocity from time 0, total energy and mass are constant, the phase
//   depends on the specific internal energy only.
// usage: io_synthetic_cloud RUN_DIR [particles] [snapshots]        (also under mpiexec)
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/io/checkpoint.hpp"
#include "src/io/history.hpp"
#include "src/io/particle_series.hpp"
#include "src/io/ranks.hpp"
#include "src/io/run_directory.hpp"

namespace {

using namespace whipple;
using namespace whipple::io;

constexpr double end_time = 20e-6;
constexpr double disk_radius = 5.59e-3;
constexpr double disk_height = 3.45e-3;
constexpr double plate_radius = 20e-3;
constexpr double plate_thickness = 2.87e-3;
constexpr double impact_speed = 5550.0;

constexpr const char* input = R"(title = "Synthetic cloud: copper disk on aluminium plate"
[domain]
lower = ["0 m", "0 m", "-0.02 m"]
upper = ["0.04 m", "0.04 m", "0.12 m"]
cell_size = "0.0005 m"
[domain.boundary]
x_lower = "symmetry"
x_upper = "outflow"
y_lower = "symmetry"
y_upper = "outflow"
z_lower = "outflow"
z_upper = "outflow"
[time]
end = "2e-05 s"
courant = 0.5
scheme = "symplectic"
[transfer]
shape_function = "quadratic_bspline"
particle_update = "relaxed_affine"
[[body]]
name = "disk"
material = "copper_gray_md.toml"
velocity = ["0 m/s", "0 m/s", "5550 m/s"]
discretization = { method = "particles", per_cell = 8 }
shape = { cylinder = { center = ["0 m", "0 m", "-0.001725 m"], axis = "z", radius = "0.00559 m", height = "0.00345 m" } }
[[body]]
name = "plate"
material = "aluminium_gray_md.toml"
velocity = ["0 m/s", "0 m/s", "0 m/s"]
discretization = { method = "particles", per_cell = 8 }
shape = { cylinder = { center = ["0 m", "0 m", "0.001435 m"], axis = "z", radius = "0.02 m", height = "0.00287 m" } }
[output]
snapshot_every = "1e-06 s"
fields = ["pressure", "temperature", "density", "internal_energy", "phase", "plastic_strain", "failed"]
[provenance]
program = "io_synthetic_cloud"
threads = 2
)";

/// Velocity at launch: the plate is pushed out as a bubble over the disk, the rest of it stays.
Vector3 launch_velocity(const Vector3& x, bool disk) {
  const double r = std::hypot(x.x(), x.y());
  if (disk) {
    const double depth = (x.z() + disk_height) / disk_height;  // 0 rear, 1 front
    const double axial = impact_speed * (0.62 + 0.2 * depth - 0.12 * r / disk_radius);
    const double radial = 1900.0 * (r / disk_radius) * (0.3 + 0.7 * depth);
    return {radial * x.x() / (r + 1e-12), radial * x.y() / (r + 1e-12), axial};
  }
  const double hole = 1.5 * disk_radius;
  if (r > hole) return {0, 0, 0};
  const double angle = 1.35 * r / hole;
  const double speed = 5200.0 * (0.75 + 0.25 * x.z() / plate_thickness);
  const double radial = speed * std::sin(angle) * 0.62;
  return {radial * x.x() / (r + 1e-12), radial * x.y() / (r + 1e-12),
          speed * (0.35 + 0.65 * std::cos(angle))};
}

Particles launch(std::size_t n) {
  const double disk_volume = std::numbers::pi * disk_radius * disk_radius * disk_height / 4;
  const double plate_volume = std::numbers::pi * plate_radius * plate_radius * plate_thickness / 4;
  const double spacing = std::cbrt((disk_volume + plate_volume) / static_cast<double>(n));
  std::mt19937 random(1);
  std::normal_distribution<double> scatter(0.0, 60.0);
  Particles p;
  const auto add = [&](const Vector3& x, bool disk) {
    const std::size_t i = p.size();
    resize(p, i + 1);
    const double density = disk ? 8930.0 : 2700.0;
    p.id[i] = i;
    p.body[i] = disk ? 0 : 1;
    p.position[i] = x;
    p.velocity[i] = launch_velocity(x, disk);
    const bool moves = p.velocity[i].norm() > 0;
    if (moves) p.velocity[i] += Vector3(scatter(random), scatter(random), scatter(random));
    p.volume[i] = spacing * spacing * spacing;
    p.mass[i] = density * p.volume[i];
    const double r = std::hypot(x.x(), x.y()) / disk_radius;
    const double energy =
        !moves ? 2e4 : 2.4e6 * std::exp(-r * r) * (disk ? 0.6 + 0.6 * (1 + x.z() / disk_height) : 1.0);
    p.specific_internal_energy[i] = energy;
    p.temperature[i] = 300.0 + energy / (disk ? 480.0 : 1100.0);
    p.melted_fraction[i] = std::clamp((energy - 6e5) / 3e5, 0.0, 1.0);
    p.vaporised_fraction[i] = std::clamp((energy - 1.6e6) / 8e5, 0.0, 1.0);
    p.pressure[i] = moves ? 1e8 * std::exp(-r) : 0.0;
    p.failed[i] = moves && i % 10 == 0 ? 1 : 0;
    p.plastic_strain[i] = moves ? 3.0 * std::exp(-r) : 0.01;
  };
  const auto fill = [&](double radius, double lower, double upper, bool disk) {
    for (double z = lower + spacing / 2; z < upper; z += spacing) {
      for (double y = spacing / 2; y < radius; y += spacing) {
        for (double x = spacing / 2; x < radius; x += spacing) {
          if (x * x + y * y < radius * radius) add({x, y, z}, disk);
        }
      }
    }
  };
  fill(disk_radius, -disk_height, 0, true);
  fill(plate_radius, 0, plate_thickness, false);
  return p;
}

struct Totals {
  double mass = 0, kinetic = 0, internal = 0, failed = 0, speed = 0, pressure = 0, temperature = 0;
  double by_phase[2][4] = {};
  Vector3 momentum{0, 0, 0};
};

Totals totals(const Particles& p) {
  Totals t;
  for (std::size_t i = 0; i < p.size(); ++i) {
    t.mass += p.mass[i];
    t.kinetic += 0.5 * p.mass[i] * p.velocity[i].squaredNorm();
    t.internal += p.mass[i] * p.specific_internal_energy[i];
    t.momentum += p.mass[i] * p.velocity[i];
    if (p.failed[i] != 0) t.failed += p.mass[i];
    t.speed = std::max(t.speed, p.velocity[i].norm());
    t.pressure = std::max(t.pressure, p.pressure[i]);
    t.temperature = std::max(t.temperature, p.temperature[i]);
    t.by_phase[p.body[i]][static_cast<int>(phase(p.melted_fraction[i], p.vaporised_fraction[i]))] +=
        p.mass[i];
  }
  return t;
}

std::vector<HistoryValue> history_row(int step, double time, const Totals& t, std::size_t particles) {
  const double drift = 1e-12 * std::sin(step);  // round-off, as in a run
  std::vector<HistoryValue> row = {{"step", "", static_cast<double>(step)},
                                   {"time", "s", time},
                                   {"dt", "s", 2e-8 * (1 - 0.3 * std::exp(-time / 2e-6))},
                                   {"mass", "kg", t.mass},
                                   {"kinetic_energy", "J", t.kinetic},
                                   {"affine_kinetic_energy", "J", 0.0},
                                   {"internal_energy", "J", t.internal},
                                   {"total_energy", "J", t.kinetic + t.internal},
                                   {"energy_error", "1", drift},
                                   {"momentum_x", "kg m/s", t.momentum.x()},
                                   {"momentum_y", "kg m/s", t.momentum.y()},
                                   {"momentum_z", "kg m/s", t.momentum.z()},
                                   {"momentum_error", "1", std::abs(drift)},
                                   {"outflow_mass", "kg", 0.0},
                                   {"failed_mass", "kg", t.failed},
                                   {"maximum_speed", "m/s", t.speed},
                                   {"maximum_pressure", "Pa", t.pressure},
                                   {"maximum_temperature", "K", t.temperature},
                                   {"particles", "1", static_cast<double>(particles)}};
  const char* phases[4] = {"mass_solid", "mass_melting", "mass_liquid", "mass_vapour"};
  const char* bodies[2] = {"disk", "plate"};
  for (int k = 0; k < 4; ++k) row.push_back({phases[k], "kg", t.by_phase[0][k] + t.by_phase[1][k]});
  for (int body = 0; body < 2; ++body) {
    for (int k = 0; k < 4; ++k) {
      row.push_back({fmt::format("{}.{}", phases[k], bodies[body]), "kg", t.by_phase[body][k]});
    }
  }
  return row;
}

int write_cloud(int argc, char** argv) {
  if (argc < 2) throw InputError("usage: io_synthetic_cloud RUN_DIR [particles] [snapshots]");
  const MPI_Comm world = parallel::world();
  const Ranks ranks(world);
  const auto n = static_cast<std::size_t>(argc > 2 ? std::atol(argv[2]) : 20'000);
  const int snapshots = argc > 3 ? std::atoi(argv[3]) : 11;
  const std::filesystem::path path = argv[1];
  ranks.on_root([&] { RunDirectory::create(path, "cloud", true).write_input(input); });

  const Particles all = launch(n);
  const Totals sums = totals(all);
  std::vector<std::uint32_t> order;  // of this rank
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (static_cast<int>(i % static_cast<std::size_t>(ranks.count())) == ranks.rank()) {
      order.push_back(static_cast<std::uint32_t>(i));
    }
  }
  Particles start = all;
  SortBuffers buffers;
  reorder(start, order, buffers);

  ParticleSeries series({.folder = path,
                         .name = "cloud",
                         .fields = default_output_fields(),
                         .material_of_body = {0, 1},
                         .provenance = {{"version", "0.1.0"}, {"input", input}}},
                        world);
  Particles now = start;
  for (int k = 0; k < snapshots; ++k) {
    const double time = end_time * k / std::max(snapshots - 1, 1);
    for (std::size_t i = 0; i < now.size(); ++i)
      now.position[i] = start.position[i] + time * start.velocity[i];
    Particles written = now;
    if (k == 0) {  // before the impact all of it is whole and solid
      std::ranges::fill(written.failed, std::uint8_t{0});
      std::ranges::fill(written.melted_fraction, 0.0);
      std::ranges::fill(written.vaporised_fraction, 0.0);
    }
    series.write(written, time);
  }
  CheckpointValues values;
  values.reals = {{"time", end_time}};
  values.integers = {{"step", 1000}};
  write_checkpoint(path / "checkpoint", 1000, now, values, world);
  if (ranks.is_root()) {
    io::History history(path / "history.csv");
    for (int step = 0; step <= 1000; step += 4)
      history.append(history_row(step, end_time * step / 1000, sums, all.size()));
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return whipple::run_guarded("io_synthetic_cloud", write_cloud, argc, argv);
}
