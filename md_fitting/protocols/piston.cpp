// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/protocols/piston.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "md_fitting/lammps/units.hpp"
#include "md_fitting/protocols/catalogue.hpp"
#include "md_fitting/protocols/crystal.hpp"
#include "md_fitting/protocols/hugoniot_guess.hpp"
#include "src/core/base/error.hpp"

namespace whipple::md {
namespace {

/// Fraction of slipped atoms below which the compression is elastic.
constexpr double least_slipped_share = 0.05;
constexpr int frames = 60;
/// Distance travelled by the front, as a fraction of the crystal, so that the rear surface has no effect.
constexpr double run_share = 0.75;
constexpr std::size_t parts = 5;
constexpr double velocity_unit = metal::angstrom / metal::picosecond;  // m/s

double slope(std::span<const double> x, std::span<const double> y) {
  const auto n = static_cast<double>(x.size());
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sx += x[i], sy += y[i], sxx += x[i] * x[i], sxy += x[i] * y[i];
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

/// Estimates the state behind a shock of given particle velocity.
HugoniotGuess guess_at_velocity(const Potential& potential, const ReferenceState& reference,
                                double velocity) {
  double larger = reference.specific_volume.value;
  double smaller = least_guess_volume(potential, reference);
  const auto particle = [&](double volume) {
    return std::sqrt(std::fmax(0.0, guess_hugoniot(potential, reference, volume).pressure) *
                     (reference.specific_volume.value - volume));
  };
  if (particle(smaller) < velocity) {
    throw StateError(fmt::format("no shock with a particle velocity of {} m/s down to V/V0 = {:.2f}",
                                 velocity, smaller / larger));
  }
  while (larger - smaller > 1e-5 * larger) {
    const double middle = 0.5 * (larger + smaller);
    (particle(middle) < velocity ? larger : smaller) = middle;
  }
  return guess_hugoniot(potential, reference, smaller);
}

/// Assigns atoms to layers by their positions before the shock.
class Layers {
 public:
  Layers(const std::vector<double>& positions, double spacing) : index_(positions.size() / 3) {
    for (std::size_t i = 0; i < index_.size(); ++i) {
      index_[i] = static_cast<std::size_t>(std::fmax(0.0, std::floor(positions[3 * i + 2] / spacing)));
      count_ = std::max(count_, index_[i] + 1);
    }
  }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::size_t of(std::size_t atom) const { return index_[atom]; }
  /// Returns the layer means of one component of a per-atom vector.
  [[nodiscard]] std::vector<double> mean(const std::vector<double>& vectors, std::size_t component) const {
    std::vector<double> sum(count_), number(count_);
    for (std::size_t i = 0; i < index_.size(); ++i) {
      sum[index_[i]] += vectors[3 * i + component];
      number[index_[i]] += 1.0;
    }
    for (std::size_t k = 0; k < count_; ++k) sum[k] /= std::fmax(number[k], 1.0);
    return sum;
  }

 private:
  std::vector<std::size_t> index_;
  std::size_t count_ = 0;
};

}  // namespace

double slipped_share(std::span<const double> before, std::span<const double> after,
                     std::span<const std::size_t> atoms, double period, double lattice_constant) {
  const double limit = 0.5 * lattice_constant / std::sqrt(6.0);
  std::size_t slipped = 0;
  for (const std::size_t i : atoms) {
    double square = 0.0;
    for (std::size_t c = 0; c < 2; ++c) {
      const double d = after[3 * i + c] - before[3 * i + c];
      square += std::pow(d - period * std::round(d / period), 2);
    }
    if (square > limit * limit) ++slipped;
  }
  return atoms.empty() ? 0.0 : static_cast<double>(slipped) / static_cast<double>(atoms.size());
}

double front_position(std::span<const double> layer_velocity, double velocity) {
  const double half = -0.5 * velocity;
  for (std::size_t k = layer_velocity.size(); k-- > 1;) {
    const double behind = layer_velocity[k - 1];
    const double before = layer_velocity[k];
    if (behind > half && before <= half) {
      return static_cast<double>(k - 1) + (behind - half) / (behind - before);
    }
  }
  return -1.0;
}

Estimate late_slope(std::span<const double> x, std::span<const double> y) {
  const std::size_t size = 2 * x.size() / 3;
  if (size < 3 * parts) throw InternalError("too few samples for a slope with error");
  x = x.last(size);
  y = y.last(size);
  Estimate result{slope(x, y), 0.0};
  double mean = 0.0, squares = 0.0;
  for (std::size_t p = 0; p < parts; ++p) {
    const std::size_t first = p * size / parts;
    const std::size_t length = (p + 1) * size / parts - first;
    const double s = slope(x.subspan(first, length), y.subspan(first, length));
    mean += s / parts;
    squares += s * s / parts;
  }
  result.error = std::sqrt(std::fmax(0.0, squares - mean * mean) / (parts - 1));
  return result;
}

PistonResult measure_piston(const Potential& potential, const ReferenceState& reference,
                            double reference_temperature, double particle_velocity, const PistonPlan& section,
                            std::int64_t seed) {
  const double mass = potential.mass();
  const double v0 = reference.specific_volume.value;
  const HugoniotGuess guess = guess_at_velocity(potential, reference, particle_velocity);
  potential.require_range(guess.specific_volume / potential.static_volume());
  const double dt = time_step(potential, guess.specific_volume / potential.static_volume(), guess.temperature,
                              section.size);
  const double a = std::cbrt(metal::volume_per_atom(v0, mass) * potential.atoms_per_cell());
  const double spacing = 0.5 * a;  // of the layers of fcc and bcc along [001]
  const double length = a * static_cast<double>(section.length);

  Crystal crystal(potential, a, section.size.cells, section.size.cells, section.length);
  Lammps& lammps = crystal.lammps();
  // Centre the layers in their slices: no thermal motion moves an atom across the periodic boundary.
  lammps.command("displace_atoms all move 0 0 {:.17g} units box", 0.5 * spacing);
  lammps.command("timestep {:.17g}", dt);
  lammps.command("velocity all create {:.17g} {} mom yes rot no dist gaussian", 2.0 * reference_temperature,
                 seed);
  lammps.command("fix rest all nvt temp {0:.17g} {0:.17g} {1:.17g}", reference_temperature, 100 * dt);
  lammps.command("run {} post no", section.size.equilibration_steps);
  lammps.command("unfix rest");
  const std::vector<double> before = lammps.gather("x");
  const Layers layers(before, spacing);
  lammps.command("change_box all boundary p p f");
  lammps.command("change_box all z final 0 {:.17g} units box", length + 4.0 * a);
  lammps.command("velocity all set NULL NULL {:.17g} sum yes units box", -particle_velocity / velocity_unit);
  lammps.command("fix mirror all wall/reflect zlo EDGE");
  lammps.command("fix move all nve");

  const double fastest = v0 * std::sqrt(guess.pressure / (v0 - guess.specific_volume));  // m/s
  const double duration = run_share * length / (fastest / velocity_unit);                // ps
  const auto frame_steps = std::max<std::int64_t>(1, std::llround(duration / dt / frames));
  std::vector<double> time, front;
  std::vector<double> velocities;
  for (int frame = 1; frame <= frames; ++frame) {
    lammps.command("run {} post no", frame_steps);
    velocities = lammps.gather("v");
    for (double& component : velocities) component *= velocity_unit;
    const double place = front_position(layers.mean(velocities, 2), particle_velocity);
    if (place < 0.0) continue;
    if (place > 0.95 * static_cast<double>(layers.count())) break;
    time.push_back(static_cast<double>(frame * frame_steps) * dt * metal::picosecond);
    // Distance in the material ahead of the shock: its rate is Us, independent of the motion behind.
    front.push_back((place + 0.5) * spacing * metal::angstrom);
  }
  if (front.size() < frames / 2) throw StateError("no shock front was seen to run through the crystal");
  PistonResult result;
  result.particle_velocity = particle_velocity;
  result.shock_velocity = late_slope(time, front);
  const double shock = result.shock_velocity.value;
  if (!(shock > particle_velocity)) throw StateError("the shock front does not run ahead of the piston");
  // Momentum jump condition (equation 9).
  result.pressure = {reference.pressure + shock * particle_velocity / v0,
                     result.shock_velocity.error * particle_velocity / v0};

  // Average behind the front, away from the mirror, which heats adjacent layers, and from the front.
  const double reach = front.back() / metal::angstrom / spacing;
  const auto first = static_cast<std::size_t>(0.2 * reach);
  const auto last = static_cast<std::size_t>(0.8 * reach);
  const std::array<std::vector<double>, 3> flow = {layers.mean(velocities, 0), layers.mean(velocities, 1),
                                                   layers.mean(velocities, 2)};
  const std::vector<double> positions = lammps.gather("x");
  const std::vector<double> height = layers.mean(positions, 2);
  double squares = 0.0, number = 0.0;
  std::vector<double> layer_temperature(layers.count()), layer_atoms(layers.count());
  for (std::size_t i = 0; 3 * i < velocities.size(); ++i) {
    const std::size_t k = layers.of(i);
    for (std::size_t c = 0; c < 3; ++c) {
      layer_temperature[k] += std::pow(velocities[3 * i + c] - flow[c][k], 2);
    }
    layer_atoms[k] += 1.0;
  }
  const double per_kelvin = metal::specific_energy(metal::boltzmann, mass);  // k/m, J/(kg K)
  std::vector<double> temperatures;
  for (std::size_t k = first; k < last; ++k) {
    const double t = layer_temperature[k] / (3.0 * (layer_atoms[k] - 1.0)) / per_kelvin;
    temperatures.push_back(t);
    squares += t * t;
    number += 1.0;
  }
  if (temperatures.size() < 4) throw StateError("too few layers behind the shock front");
  double mean = 0.0;
  for (const double t : temperatures) mean += t / number;
  result.temperature = {mean, std::sqrt(std::fmax(0.0, squares / number - mean * mean) / (number - 1.0))};
  const double area = std::pow(a * static_cast<double>(section.size.cells), 2);
  const double volume = area * (height[last] - height[first]);
  double inside = 0.0;
  for (std::size_t k = first; k < last; ++k) inside += layer_atoms[k];
  std::vector<std::size_t> behind;
  for (std::size_t i = 0; 3 * i < positions.size(); ++i) {
    if (layers.of(i) >= first && layers.of(i) < last) behind.push_back(i);
  }
  result.slipped_share =
      slipped_share(before, positions, behind, a * static_cast<double>(section.size.cells), a);
  result.elastic = result.slipped_share < least_slipped_share;
  result.density = 1.0 / metal::specific_volume(volume / inside, mass);

  lammps.command("region behind block INF INF INF INF {:.17g} {:.17g} units box", height[first],
                 height[last]);
  lammps.command("group behind region behind");
  lammps.command("compute stress behind stress/atom NULL");
  lammps.command("compute mean_stress behind reduce ave c_stress[1] c_stress[2] c_stress[3]");
  for (int i = 1; i <= 3; ++i) lammps.command("variable s{0} equal c_mean_stress[{0}]", i);
  lammps.command("thermo_style custom step c_mean_stress[1] c_mean_stress[2] c_mean_stress[3]");
  crystal.evaluate();
  const double normal = lammps.variable("s3");
  result.shear_stress_share = 1.0 - 0.5 * (lammps.variable("s1") + lammps.variable("s2")) / normal;
  result.transcript = lammps.transcript();
  return result;
}

void add_piston(const Plan& plan, TaskList& list) {
  if (!plan.piston) return;
  const PistonPlan& section = *plan.piston;
  const Potential& potential = list.potential();
  for (const double velocity : section.particle_velocity) {
    const ReferenceState at_rest = static_reference(potential);
    try {
      list.require_range(guess_at_velocity(potential, at_rest, velocity).specific_volume /
                         potential.static_volume());
    } catch (const StateError& error) {
      list.fault(error.what());
    }
    PointRequest request{conditions_of(PistonPoint{.particle_velocity = velocity}),
                         size_settings(section.size), list.first_key(ZeroPressurePoint::protocol)};
    request.settings["length"] = std::to_string(section.length);
    request.settings.erase("steps");  // the run length is set by the travel of the front
    list.add(request, [&potential, section, velocity](std::int64_t seed, const PointRecord* zero_pressure) {
      const ReferenceState reference = reference_state(*zero_pressure);
      const double temperature = read_as<ZeroPressurePoint>(*zero_pressure).temperature;
      const PistonResult shock = measure_piston(potential, reference, temperature, velocity, section, seed);
      return TaskResult{results_of<PistonPoint>(shock),
                        shock.elastic ? "elastic: no datum for an equation of state" : "", shock.transcript};
    });
  }
}

}  // namespace whipple::md
