// SPDX-License-Identifier: BSD-3-Clause
// Attraction of the vapour of GRAY from a critical or boiling temperature (docs/theory/gray.md, section 4).
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "eos/models/gray_free_energy.hpp"
#include "eos/root.hpp"
#include "src/core/base/error.hpp"

namespace whipple::eos {
namespace {

constexpr double standard_atmosphere = 101325.0;  // Pa
/// R T_c V_b/a_y of the fluid without the join (G30).
constexpr double reduced_critical_temperature = 0.0943287;
/// Range of the searches on both sides of the critical point without the join, which shifts it.
constexpr double search_factor = 6.0;

}  // namespace

VapourDome::Search GrayFreeEnergy::dome_search() const {
  return {
      .fluid =
          [this](double V, double T) {
            const GrayPoint p = fluid(V, T);
            return FluidPoint{p.pressure, p.energy, p.entropy};
          },
      .isotherm =
          [this](double V, double T) {
            const GrayBranch b = fluid_branch(V, T);
            return IsothermPoint{b.pressure(T), b.pressure_by_volume(T)};
          },
      .dense_volume = std::max(0.6 * constants_.reference_specific_volume, least_volume_),
      // Away from V_J, where the kink of the join may cause a spurious loop.
      .loop_volume = 1.15 * join_volume_,
      .dilute_volume = 1e4 * constants_.reference_specific_volume,
      .gas_constant = gas_,
      .temperature_guess = reduced_critical_temperature * constants_.vapour_attraction / (gas_ * covolume_)};
}

void GrayFreeEnergy::solve_vapour_attraction() {
  GrayConstants& c = constants_;
  if (c.vapour == VapourCondition::attraction) return;
  const bool critical = c.vapour == VapourCondition::critical;
  const double T = critical ? c.critical_temperature : c.boiling_temperature;
  const char* const wanted = critical ? "critical_temperature" : "boiling_temperature";
  // Stronger attraction creates a loop where there was none, and lowers the saturation pressure: the excess
  // increases through zero at the required attraction.
  const auto excess = [&](double attraction) {
    c.vapour_attraction = attraction;
    const LoopPoint point = steepest_point(dome_search(), T);
    if (critical) return point.steepness;
    // Without a loop the temperature is supercritical: treated as a far too high pressure.
    constexpr double supercritical = -50.0;
    if (point.steepness <= 0) return supercritical;
    return std::log(standard_atmosphere / saturation(dome_search(), T, point.volume).pressure);
  };
  // With very weak attraction the join alone causes a loop, so that the root need not be the first crossing.
  const double without_join = gas_ * T * covolume_ / reduced_critical_temperature;
  constexpr double factor = 1.1;
  std::string nearest;
  double before = 0;
  for (double a = without_join / search_factor; a < search_factor * without_join; a *= factor) {
    const double now = excess(a);
    if (before < 0 && now >= 0) {
      c.vapour_attraction = find_root(excess, a / factor, a, "attraction of the vapour");
      if (!critical) return;
      // The loop may have vanished at a lower temperature: then this is not the top of the dome.
      const double top = critical_point(dome_search()).temperature;
      if (std::abs(top - T) < 1e-6 * T) return;
      nearest = fmt::format(": {:.6g} J m^3/kg^2 gives {:.6g} K", c.vapour_attraction, top);
    }
    before = now;
  }
  throw InputError(
      fmt::format("gray: no vapour_attraction gives a {} of {:.6g} K{}; a smaller join_volume_ratio may help",
                  wanted, T, nearest));
}

}  // namespace whipple::eos
