// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "src/transfer/shape_function.hpp"
#include "tests/verification/solver_problems.hpp"

/// Runs of the solver with its default scheme, and what is measured in them.
namespace whipple::verification::exact {

/// Tables of options for every case of the program, to compare methods; empty: the defaults.
inline std::string& options_of_all_cases() {
  static std::string options;
  return options;
}

/// A case that names no method: that of the solver's defaults.
/// @param end   s
/// @param text  domain and bodies
/// @param more  tables of options, if not the defaults
/// @param time  further keys of the table of the time
inline cases::Case default_case(double end, const std::string& text, const std::string& more = {},
                                const std::string& time = {}) {
  const std::string until = fmt::format("[time]\nend = {:.9g}\n", end);
  return cases::read_case_text(until + time + options_of_all_cases() + more + text, "exact.toml");
}

/// Writes the material of an ideal gas whose temperatures lie well within the range of the model.
/// @returns its file
inline std::string gas(double gamma) {
  return write_material(fmt::format("gas_{:.0f}", 100 * gamma), fmt::format(R"toml(
name = "gas"
source = "units of the verification problems"
[eos]
model = "ideal_gas"
source = "units of the verification problems"
reference_density = "1 kg/m^3"
heat_capacity_ratio = {:.17g}
heat_capacity = "1e-9 J/(kg K)"
reference_temperature = "1e3 K"
[strength]
model = "none"
)toml",
                                                                            gamma));
}

/// A simulation of seeded particles after `change` of their state (velocities, energies).
inline solver::Simulation start_with(const cases::Case& setup,
                                     const std::function<void(Particles&)>& change) {
  Particles particles = cases::seed(setup).particles;
  change(particles);
  solver::RunState state;
  state.ledger.initial = solver::totals_of(
      particles, transfer::affine_inertia(setup.transfer.shape_function, setup.domain.cell_size));
  return solver::Simulation(setup, std::move(particles), state, parallel::world());
}

/// Positions of the particles by id.
inline std::vector<Vector3> positions_by_id(const Particles& particles) {
  std::vector<Vector3> x(particles.size());
  for (std::size_t p = 0; p < x.size(); ++p) x[particles.id[p]] = particles.position[p];
  return x;
}

/// Mean over the mass.
class Mean {
 public:
  void add(double value, double mass) {
    sum_ += mass * value;
    mass_ += mass;
  }
  /// NaN of nothing.
  [[nodiscard]] double value() const { return sum_ / mass_; }
  [[nodiscard]] double mass() const { return mass_; }

 private:
  double sum_ = 0, mass_ = 0;
};

/// Means of layers of equal thickness, the first at depth 0.
class Layers {
 public:
  Layers(double thickness, std::size_t count) : thickness_(thickness), layers_(count) {}
  void add(double depth, double value, double mass) {
    const auto layer = static_cast<std::size_t>(std::max(0.0, depth / thickness_));
    if (layer < layers_.size()) layers_[layer].add(value, mass);
  }
  [[nodiscard]] std::vector<double> values() const {
    std::vector<double> values;
    for (const Mean& layer : layers_) values.push_back(layer.value());
    return values;
  }

 private:
  double thickness_;
  std::vector<Mean> layers_;
};

/// Absolute deviation from the exact solution, weighted by the volume of the material: the L1 norm over the
/// space that it fills, relative to the same norm of a scale.
class L1 {
 public:
  void add(double value, double exact, double volume, double scale = 1.0) {
    sum_ += volume * std::abs(value - exact);
    scale_ += volume * scale;
  }
  [[nodiscard]] double value() const { return sum_ / scale_; }

 private:
  double sum_ = 0, scale_ = 0;
};

}  // namespace whipple::verification::exact
