// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/protocols/liquid_vapour.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "md_fitting/lammps/units.hpp"
#include "md_fitting/protocols/catalogue.hpp"
#include "md_fitting/protocols/crystal.hpp"
#include "md_fitting/protocols/phase.hpp"
#include "md_fitting/protocols/statistics.hpp"
#include "src/core/base/error.hpp"

namespace whipple::md {
namespace {

constexpr std::int64_t frame_steps = 200;
constexpr std::int64_t pressure_interval = 10;
/// Minimum ratio of the density in the middle of the film to the largest density; an intact film has 1 except for
/// noise.
constexpr double least_centre_share = 0.75;
/// Temperature at which the film is prepared, as a fraction of the final one.
constexpr double prepared_share = 0.6;
constexpr std::int64_t preparation_steps = 2000;
constexpr double bin = 1.0;          // A
constexpr double least_core = 3.0;   // A: half of the film that is certainly melt
constexpr double least_space = 6.0;  // A: on either side
constexpr double least_vapour_atoms = 4.0;

/// Returns the distances of all atoms from the centre of the film.
std::vector<double> distances_from_film(const std::vector<double>& positions, double period) {
  std::vector<double> z(positions.size() / 3);
  for (std::size_t i = 0; i < z.size(); ++i) z[i] = positions[3 * i + 2];
  const double centre = circular_mean(z, period);
  for (double& place : z) {
    const double offset = place - centre;
    place = std::abs(offset - period * std::round(offset / period));
  }
  return z;
}

}  // namespace

double circular_mean(std::span<const double> places, double period) {
  double sine = 0.0, cosine = 0.0;
  for (const double place : places) {
    const double angle = 2.0 * std::numbers::pi * place / period;
    sine += std::sin(angle);
    cosine += std::cos(angle);
  }
  const double mean = std::atan2(sine, cosine) / (2.0 * std::numbers::pi) * period;
  return mean < 0.0 ? mean + period : mean;
}

Interface find_interface(std::span<const double> profile, double step) {
  const std::size_t n = profile.size();
  if (n < 10) throw StateError("the density profile is too short");
  const double liquid = mean(profile.first(std::max<std::size_t>(3, n / 10)));
  const double vapour = mean(profile.last(std::max<std::size_t>(3, n / 5)));
  if (liquid < least_centre_share * *std::max_element(profile.begin(), profile.end())) {
    throw StateError("the film has torn: it is thinner in its middle than elsewhere");
  }
  if (!(liquid > 1.5 * vapour) || liquid <= 0.0) {
    throw StateError("film and vapour do not separate: the temperature is too close to the critical one");
  }
  const auto falls_through = [&](std::size_t i, double level) {
    return profile[i] < level && profile[i - 1] >= level;
  };
  const auto between = [&](std::size_t i, double level) {
    const double share = (profile[i - 1] - level) / (profile[i - 1] - profile[i]);
    return step * (static_cast<double>(i - 1) + 0.5 + share);
  };
  const double difference = liquid - vapour;
  const double nearly_liquid = vapour + 0.9 * difference;
  const double nearly_vapour = vapour + 0.1 * difference;
  const double middle = vapour + 0.5 * difference;
  std::size_t place = 1;
  while (place < n && !falls_through(place, middle)) ++place;
  // Take both ends next to the middle: further away the noise of the plateaus also crosses 90 and 10 %.
  std::size_t inner = place;
  while (inner > 1 && !falls_through(inner, nearly_liquid)) --inner;
  std::size_t outer = place;
  while (outer + 1 < n && !falls_through(outer, nearly_vapour)) ++outer;
  if (place == n || !falls_through(inner, nearly_liquid) || !falls_through(outer, nearly_vapour)) {
    throw StateError("film and vapour do not separate: the density profile has no interface");
  }
  const double width = between(outer, nearly_vapour) - between(inner, nearly_liquid);
  return {between(place, middle), std::fmax(width, step)};
}

namespace {

/// Computes one run of the point, including the number of atoms in its vapour.
FilmRun measure_film(const Potential& potential, double temperature, const LiquidVapourPlan& section,
                     std::int64_t seed, std::string& transcript) {
  const double mass = potential.mass();
  const RunSize& size = section.size;
  const double dt = time_step(potential, 1.2, temperature, size);
  Crystal crystal(potential, 1.02 * potential.lattice_constant(), size.cells, size.cells, 2 * size.cells);
  Lammps& lammps = crystal.lammps();
  // Start from a melt without surface at zero pressure, well below the critical temperature so that it is cohesive;
  // then add the adjacent space and heat slowly. A film that starts hot or dense ruptures as it expands.
  const double cool = prepared_share * temperature;
  make_melt(crystal, cool, dt, seed);
  lammps.command("fix prepare all npt temp {0:.17g} {0:.17g} {1:.17g} iso 0.0 0.0 {2:.17g}", cool, 100 * dt,
                 1000 * dt);
  lammps.command("run {} post no", std::max<std::int64_t>(preparation_steps, size.equilibration_steps / 4));
  lammps.command("unfix prepare");
  crystal.evaluate();  // also takes every atom back into the box
  const double edge = std::cbrt(0.5 * lammps.variable("volume") * crystal.atoms());
  const double period = 2.0 * edge * (1.0 + section.gap);
  const double area = edge * edge;
  lammps.command("variable bottom equal zlo");
  const double bottom = lammps.variable("bottom");
  lammps.command("change_box all z final {:.17g} {:.17g} units box", bottom, bottom + period);
  for (const char* component : {"pxx", "pyy", "pzz"}) lammps.command("variable {0} equal {0}", component);
  lammps.command("thermo_style custom step temp pe vol c_virial c_displacement[4] pxx pyy pzz");
  lammps.command("thermo_modify norm no");
  lammps.command("fix integrate all nvt temp {:.17g} {:.17g} {:.17g}", cool, temperature, 100 * dt);
  lammps.command("run {} post no", size.equilibration_steps / 2);
  lammps.command("unfix integrate");
  lammps.command("fix integrate all nvt temp {0:.17g} {0:.17g} {1:.17g}", temperature, 100 * dt);
  lammps.command("run {} post no", size.equilibration_steps / 2);

  // Keep the positions, because the boundary of melt and vapour is known only from the mean profile.
  const auto frames = std::max<std::int64_t>(16, size.steps / frame_steps);
  std::vector<std::vector<double>> places;
  std::vector<double> normal, surface;
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    const auto part = crystal.sample({"pxx", "pyy", "pzz"}, pressure_interval, frame_steps);
    for (std::size_t i = 1; i < part[0].size(); ++i) {
      normal.push_back(metal::bar * part[2][i]);
      // Two surfaces carry the tangential stress along the film.
      surface.push_back(0.5 * period * metal::angstrom * metal::bar *
                        (part[2][i] - 0.5 * (part[0][i] + part[1][i])));
    }
    places.push_back(distances_from_film(lammps.gather("x"), period));
  }

  std::vector<double> profile(static_cast<std::size_t>(0.5 * period / bin));
  for (const auto& frame : places) {
    for (const double distance : frame) {
      const auto k = static_cast<std::size_t>(distance / bin);
      if (k < profile.size()) profile[k] += 1.0 / (2.0 * bin * area * static_cast<double>(places.size()));
    }
  }
  const Interface interface = find_interface(profile, bin);
  const double core = interface.place - interface.width;
  const double space = interface.place + interface.width;
  if (core < least_core || 0.5 * period - space < least_space) {
    throw StateError(fmt::format(
        "film and vapour do not separate: the interface at {:.1f} A is {:.1f} A wide in a "
        "period of {:.1f} A; the temperature is too close to the critical one, or the film too thin",
        interface.place, interface.width, period));
  }
  std::vector<double> liquid, vapour;
  for (const auto& frame : places) {
    const auto inside = std::count_if(frame.begin(), frame.end(), [&](double d) { return d < core; });
    const auto outside = std::count_if(frame.begin(), frame.end(), [&](double d) { return d > space; });
    liquid.push_back(static_cast<double>(inside) / (2.0 * core * area));
    vapour.push_back(static_cast<double>(outside) / (2.0 * (0.5 * period - space) * area));
  }
  transcript += lammps.transcript();
  const double density = 1.0 / metal::specific_volume(1.0, mass);  // kg/m^3 of one atom per A^3
  return {{.temperature = temperature,
           .liquid_density = {density * mean(liquid), 0.0},
           .vapour_density = {density * mean(vapour), 0.0},
           .vapour_pressure = {mean(normal), 0.0},
           .surface_energy = {mean(surface), 0.0},
           .interface_width = {interface.width * metal::angstrom, 0.0}},
          mean(vapour) * 2.0 * (0.5 * period - space) * area};
}

}  // namespace

ReplicaSet<FilmRun> measure_liquid_vapour(const Potential& potential, double temperature,
                                          const LiquidVapourPlan& section, std::int64_t seed) {
  auto set =
      run_replicas<FilmRun>(section.replicas, seed, [&](std::int64_t own_seed, std::string& transcript) {
        return measure_film(potential, temperature, section, own_seed, transcript);
      });
  // Apply the criterion to the mean: selecting among the runs would keep those with the denser vapour.
  const double atoms = set.mean(&FilmRun::vapour_atoms).value;
  if (atoms < least_vapour_atoms) {
    throw StateError(fmt::format(
        "the vapour holds {:.1f} atoms on average next to an interface of {:.1f} A width: too few "
        "below about 0.7 "
        "of the critical temperature, or in so small a box",
        atoms, set.mean(&FilmRun::interface_width).value / metal::angstrom));
  }
  return set;
}

void add_liquid_vapour(const Plan& plan, TaskList& list) {
  if (!plan.liquid_vapour) return;
  const LiquidVapourPlan section = *plan.liquid_vapour;
  for (const double temperature : section.temperature) {
    PointRequest request{
        conditions_of(LiquidVapourPoint{.temperature = temperature}), size_settings(section.size), {}};
    request.settings["gap"] = fmt::format("{}", section.gap);
    request.settings["replicas"] = std::to_string(section.replicas);
    list.add(request, [&potential = list.potential(), section, temperature](std::int64_t seed,
                                                                            const PointRecord*) {
      return to_result<LiquidVapourPoint>(measure_liquid_vapour(potential, temperature, section, seed));
    });
  }
}

}  // namespace whipple::md
