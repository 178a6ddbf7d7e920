// SPDX-License-Identifier: BSD-3-Clause
#include "src/bench/reference_kernel.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

#include "src/core/base/error.hpp"
#include "src/core/base/vector_math.hpp"

namespace whipple::bench {
namespace {

// Copper: Johnson & Cook, Proc. 7th Int. Symp. Ballistics (1983) 541; Steinberg, UCRL-MA-106439 (1996). SI.
constexpr double density = 8930.0, bulk_speed = 3940.0, hugoniot_slope = 1.489, gruneisen = 2.02;
constexpr double shear_modulus = 47.7e9, heat_capacity = 383.0;
constexpr double yield_a = 90e6, yield_b = 292e6, yield_n = 0.31, rate_c = 0.025, thermal_m = 1.09;
constexpr double room = 293.0, melting = 1356.0;
constexpr double linear_viscosity = 0.25, quadratic_viscosity = 1.0;

constexpr double cell = 1e-3;       // m
constexpr double time_step = 5e-8;  // s
constexpr double amplitude = 40.0;  // m/s

constexpr double square(double a) { return a * a; }

}  // namespace

ReferenceKernel::ReferenceKernel(int edge)
    : edge_(edge), nodes_per_edge_(static_cast<std::size_t>(edge) + 1) {
  const std::size_t n = per_cell * static_cast<std::size_t>(edge) * static_cast<std::size_t>(edge) *
                        static_cast<std::size_t>(edge);
  for (std::vector<double>& field : field_) field.assign(n, 0.0);
  nodes_.resize(nodes_per_edge_ * nodes_per_edge_ * nodes_per_edge_);
  const double wave = 2.0 * std::numbers::pi / (edge * cell);
  std::size_t p = 0;
  for (int c = 0; c < edge * edge * edge; ++c) {
    const std::array<int, 3> corner = {c / (edge * edge), c / edge % edge, c % edge};
    for (int corner_of = 0; corner_of < 8; ++corner_of, ++p) {
      const std::array<int, 3> upper = {corner_of / 4, corner_of / 2 % 2, corner_of % 2};
      for (std::size_t a = 0; a < 3; ++a) field_[x + a][p] = (corner[a] + 0.25 + 0.5 * upper[a]) * cell;
      field_[vx][p] = amplitude * std::sin(wave * field_[y][p]);
      field_[vy][p] = amplitude * std::sin(wave * field_[z][p]);
      field_[vz][p] = amplitude * std::sin(wave * field_[z][p]);
      field_[volume][p] = cell * cell * cell / per_cell;
      field_[mass_][p] = density * field_[volume][p];
      field_[temperature][p] = room;
    }
  }
}

/// Calls f(nodes of the cell, i slowest; its first particle; its lower corner) for each cell.
template <class Function>
void ReferenceKernel::for_each_cell(Function&& f) {
  std::size_t first = 0;
  for (int i = 0; i < edge_; ++i) {
    for (int j = 0; j < edge_; ++j) {
      for (int k = 0; k < edge_; ++k, first += per_cell) {
        std::array<Node*, 8> corner;
        for (int c = 0; c < 8; ++c) {
          corner[static_cast<std::size_t>(c)] = &nodes_[node(i + c / 4, j + c / 2 % 2, k + c % 2)];
        }
        f(corner, first, std::array{i * cell, j * cell, k * cell});
      }
    }
  }
}

void ReferenceKernel::particles_to_grid() {
  for (Node& node : nodes_) node = {};
  constexpr Lanes y_at_0 = {1, 1, 0, 0}, y_slope = {-1, -1, 1, 1}, z_at_0 = {1, 0, 1, 0},
                  z_slope = {-1, 1, -1, 1};
  for_each_cell([&](const std::array<Node*, 8>& corner, std::size_t first,
                    const std::array<double, 3>& lower) {
    // The lanes hold mass, momentum and force of the nodes with i = 0 and i = 1.
    std::array<std::array<Lanes, 7>, 2> sum{};
    for (std::size_t p = first; p < first + per_cell; ++p) {
      const double fx = (field_[x][p] - lower[0]) / cell, fy = (field_[y][p] - lower[1]) / cell,
                   fz = (field_[z][p] - lower[2]) / cell;
      const Lanes ny = y_at_0 + fy * y_slope, nz = z_at_0 + fz * z_slope, yz = ny * nz;
      const Lanes slope_y = (y_slope / cell) * nz, slope_z = (z_slope / cell) * ny;
      const double m = field_[mass_][p], minus_volume = -field_[volume][p], mean = -field_[pressure][p];
      const double xx = minus_volume * (field_[sxx][p] + mean), yy = minus_volume * (field_[syy][p] + mean),
                   zz = minus_volume * (field_[szz][p] + mean), xy = minus_volume * field_[sxy][p],
                   yz_ = minus_volume * field_[syz][p], zx = minus_volume * field_[szx][p];
      for (std::size_t i = 0; i < 2; ++i) {
        const double nx = i == 0 ? 1.0 - fx : fx;
        const Lanes n = nx * yz, gx = (i == 0 ? -1.0 / cell : 1.0 / cell) * yz, gy = nx * slope_y,
                    gz = nx * slope_z, mn = m * n;
        sum[i][0] += mn;
        sum[i][1] += field_[vx][p] * mn;
        sum[i][2] += field_[vy][p] * mn;
        sum[i][3] += field_[vz][p] * mn;
        sum[i][4] += xx * gx + xy * gy + zx * gz;
        sum[i][5] += xy * gx + yy * gy + yz_ * gz;
        sum[i][6] += zx * gx + yz_ * gy + zz * gz;
      }
    }
    for (std::size_t i = 0; i < 2; ++i) {
      const auto inertia = transposed({sum[i][0], sum[i][1], sum[i][2], sum[i][3]});
      const auto force = transposed({sum[i][4], sum[i][5], sum[i][6], Lanes{}});
      for (std::size_t n = 0; n < 4; ++n) {
        corner[4 * i + n]->half[0] += inertia[n];
        corner[4 * i + n]->half[1] += force[n];
      }
    }
  });
}

void ReferenceKernel::advance_grid() {
  for (Node& node : nodes_) {
    const double mass = node.half[0][0];
    const Lanes momentum = {node.half[0][1], node.half[0][2], node.half[0][3], 0.0};
    node.half[1] *= time_step / mass;
    node.half[0] = momentum / mass + node.half[1];
  }
}

void ReferenceKernel::grid_to_particles() {
  for_each_cell([&](const std::array<Node*, 8>& corner, std::size_t first,
                    const std::array<double, 3>& lower) {
    // The differences along x are common to all particles of the cell.
    std::array<Node, 4> low, rise;
    for (std::size_t n = 0; n < 4; ++n) {
      for (std::size_t h = 0; h < 2; ++h) {
        low[n].half[h] = corner[n]->half[h];
        rise[n].half[h] = corner[4 + n]->half[h] - corner[n]->half[h];
      }
    }
    for (std::size_t p = first; p < first + per_cell; p += 4) {
      const Lanes fx = (load(&field_[x][p]) - lower[0]) / cell, fy = (load(&field_[y][p]) - lower[1]) / cell,
                  fz = (load(&field_[z][p]) - lower[2]) / cell;
      std::array<Lanes, 9> gradient;
      for (std::size_t c = 0; c < 3; ++c) {
        const auto at = [&](std::size_t n, std::size_t h) {
          return low[n].half[h][c] + fx * rise[n].half[h][c];
        };
        const Lanes v00 = at(0, 0), v01 = at(1, 0), up0 = at(2, 0) - v00, up1 = at(3, 0) - v01;
        const Lanes v0 = v00 + fy * up0, along_z = v01 + fy * up1 - v0;
        const auto slope = [&](std::size_t n) { return broadcast(rise[n].half[0][c]); };
        const Lanes x0 = slope(0) + fy * (slope(2) - slope(0)), x1 = slope(1) + fy * (slope(3) - slope(1));
        gradient[3 * c] = (x0 + fz * (x1 - x0)) / cell;
        gradient[3 * c + 1] = (up0 + fz * (up1 - up0)) / cell;
        gradient[3 * c + 2] = along_z / cell;
        const Lanes i0 = at(0, 1) + fy * (at(2, 1) - at(0, 1)), i1 = at(1, 1) + fy * (at(3, 1) - at(1, 1));
        store(&field_[vx + c][p], load(&field_[vx + c][p]) + i0 + fz * (i1 - i0));
        store(&field_[x + c][p], load(&field_[x + c][p]) + time_step * (v0 + fz * along_z));
      }
      update_stress(p, gradient);
    }
  });
}

/// Updates the stress of four particles; the gradient is given row by row.
inline void ReferenceKernel::update_stress(std::size_t first, const std::array<Lanes, 9>& l) {
  const auto of = [&](Field f) { return load(&field_[f][first]); };
  const auto put = [&](Field f, Lanes value) { store(&field_[f][first], value); };
  constexpr double dt = time_step;
  const Lanes trace = l[0] + l[4] + l[8], third = trace / 3.0;
  const Lanes dxy = 0.5 * (l[1] + l[3]), dyz = 0.5 * (l[5] + l[7]), dzx = 0.5 * (l[6] + l[2]);
  const Lanes wxy = 0.5 * (l[1] - l[3]), wyz = 0.5 * (l[5] - l[7]), wzx = 0.5 * (l[6] - l[2]);
  const Lanes a = of(sxx), b = of(syy), c = of(szz), d = of(sxy), e = of(syz), f = of(szx);
  // Jaumann rate: ds/dt = 2 G dev D + W s - s W
  constexpr double g2 = 2.0 * shear_modulus * dt;
  Lanes xx = a + g2 * (l[0] - third) + 2.0 * dt * (wxy * d - wzx * f);
  Lanes yy = b + g2 * (l[4] - third) + 2.0 * dt * (wyz * e - wxy * d);
  Lanes zz = c + g2 * (l[8] - third) + 2.0 * dt * (wzx * f - wyz * e);
  Lanes xy = d + g2 * dxy + dt * (wxy * (b - a) - wzx * e + wyz * f);
  Lanes yz = e + g2 * dyz + dt * (wyz * (c - b) - wxy * f + wzx * d);
  Lanes zx = f + g2 * dzx + dt * (wzx * (a - c) - wyz * d + wxy * e);
  const Lanes equivalent = sqrt(1.5 * (xx * xx + yy * yy + zz * zz) + 3.0 * (xy * xy + yz * yz + zx * zx));
  const Lanes deviatoric = l[0] * l[0] + l[4] * l[4] + l[8] * l[8] - trace * third;
  const Lanes rate = sqrt(2.0 / 3.0 * deviatoric + 4.0 / 3.0 * (dxy * dxy + dyz * dyz + dzx * dzx));
  const Lanes plastic = of(strain), tiny = broadcast(1e-12);
  const Lanes homologous = maximum((of(temperature) - room) / (melting - room), tiny);
  const Lanes hardening = yield_a + yield_b * exp(yield_n * natural_log(maximum(plastic, tiny)));
  const Lanes yield = hardening * (1.0 + rate_c * natural_log(maximum(rate, broadcast(1.0)))) *
                      (1.0 - minimum(exp(thermal_m * natural_log(homologous)), broadcast(1.0)));
  const Lanes increment = maximum((equivalent - yield) / (3.0 * shear_modulus), Lanes{});
  const Lanes kept = 1.0 - 3.0 * shear_modulus * increment / maximum(equivalent, broadcast(1.0));
  xx *= kept, yy *= kept, zz *= kept, xy *= kept, yz *= kept, zx *= kept;
  // Mie-Grueneisen along the Hugoniot, energy with the mean pressure of the step.
  const Lanes before = of(volume), change = before * (dt * trace), after = before + change, m = of(mass_);
  const Lanes closing = maximum(-cell * trace, Lanes{});
  const Lanes viscosity =
      m / after * closing * (quadratic_viscosity * closing + linear_viscosity * bulk_speed);
  const Lanes compression = 1.0 - density * after / m, over = 1.0 - hugoniot_slope * compression;
  const Lanes hugoniot = density * square(bulk_speed) * compression / (over * over);
  const Lanes cold = hugoniot * (1.0 - 0.5 * gruneisen * compression);
  const Lanes work = dt * before *
                     (0.5 * ((a + xx) * l[0] + (b + yy) * l[4] + (c + zz) * l[8]) + (d + xy) * dxy +
                      (e + yz) * dyz + (f + zx) * dzx);
  const Lanes without = of(energy) + (work - change * (0.5 * of(pressure) + viscosity)) / m;
  constexpr double stiffness = gruneisen * density;  // dp/de
  const Lanes p = (cold + stiffness * without) / (1.0 + 0.5 * stiffness * change / m);
  const Lanes now = without - 0.5 * p * change / m;
  put(sxx, xx), put(syy, yy), put(szz, zz), put(sxy, xy), put(syz, yz), put(szx, zx);
  put(volume, after), put(energy, now), put(strain, plastic + increment), put(pressure, p + viscosity);
  put(temperature, room + now / heat_capacity);
}

void ReferenceKernel::step() {
  particles_to_grid();
  advance_grid();
  grid_to_particles();
}

double ReferenceKernel::mass() const {
  double sum = 0.0;
  for (const double m : field_[mass_]) sum += m;
  return sum;
}

double ReferenceKernel::momentum(int component) const {
  double sum = 0.0;
  for (std::size_t p = 0; p < particles(); ++p) {
    sum += field_[mass_][p] * field_[vx + static_cast<std::size_t>(component)][p];
  }
  return sum;
}

double ReferenceKernel::kinetic_energy() const {
  double sum = 0.0;
  for (std::size_t p = 0; p < particles(); ++p) {
    const double speed2 = square(field_[vx][p]) + square(field_[vy][p]) + square(field_[vz][p]);
    sum += 0.5 * field_[mass_][p] * speed2;
  }
  return sum;
}

double ReferenceKernel::internal_energy() const {
  double sum = 0.0;
  for (std::size_t p = 0; p < particles(); ++p) sum += field_[mass_][p] * field_[energy][p];
  return sum;
}

double ReferenceKernel::largest_plastic_strain() const { return *std::ranges::max_element(field_[strain]); }

double measure_reference_kernel() {
  constexpr int edge = 32, parts = 6, steps = 5;
  ReferenceKernel kernel(edge);
  double best = std::numeric_limits<double>::infinity();
  for (int part = 0; part < parts; ++part) {
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < steps; ++i) kernel.step();
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  if (!(kernel.largest_plastic_strain() > 0.0)) throw InternalError("the reference kernel computed nothing");
  return best / steps / static_cast<double>(kernel.particles());
}

}  // namespace whipple::bench
