// SPDX-License-Identifier: BSD-3-Clause
#include "eos/vapour_dome.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <utility>

#include "eos/root.hpp"
#include "src/core/base/error.hpp"

namespace whipple::eos {
namespace {

constexpr int scan_points = 240;
/// sqrt(1 - T/T_c) of the hottest row: T = 0.9999 T_c.
constexpr double least_distance = 0.01;

double spaced(double from, double to, int i, int n) {
  return from * std::pow(to / from, static_cast<double>(i) / n);
}

double gibbs(const FluidPoint& p, double V, double T) { return p.energy - T * p.entropy + p.pressure * V; }

}  // namespace

VapourDome::VapourDome(const Search& search)
    : search_(search), critical_(whipple::eos::critical_point(search)) {
  // Near the critical point V_l and V_v vary like sqrt(1 - T/T_c): rows uniform in that distance keep them smooth.
  const double far = std::sqrt(1 - search_.least_reduced_temperature);
  rows_.reserve(search_.rows);
  for (int i = 0; i < search_.rows; ++i) {
    const double distance = far + (least_distance - far) * i / (search_.rows - 1);
    rows_.push_back(saturation_at(critical_.temperature * (1 - distance * distance)));
    const Saturation& row = rows_.back();
    tie_lines_.push_back({row.liquid_volume, 1 / (row.vapour_volume - row.liquid_volume), row.liquid_energy,
                          row.vapour_energy - row.liquid_energy});
  }
}

LoopPoint steepest_point(const VapourDome::Search& search, double T) {
  const auto slope = [&](double log_volume) {
    const double V = std::exp(log_volume);
    return V * V * search.isotherm(V, T).pressure_by_volume;
  };
  const double first = std::log(search.loop_volume), last = std::log(100 * search.loop_volume);
  int best = 0;
  double greatest = -INFINITY;
  for (int i = 0; i <= scan_points; ++i) {
    const double value = slope(first + (last - first) * i / scan_points);
    if (value > greatest) {
      greatest = value;
      best = i;
    }
  }
  const double step = (last - first) / scan_points;
  const double centre = first + best * step;
  const auto [log_volume, negative] = boost::math::tools::brent_find_minima(
      [&](double x) { return -slope(x); }, std::max(first, centre - step), std::min(last, centre + step), 40);
  return {std::exp(log_volume), -negative};
}

CriticalPoint critical_point(const VapourDome::Search& search) {
  // Find the lowest temperature without a loop: hotter isotherms may decrease again at the join of the model.
  const auto steepness = [&](double T) { return steepest_point(search, T).steepness; };
  const double lowest = search.temperature_guess / 6, highest = 6 * search.temperature_guess;
  double low = lowest, high = 0;
  if (!(lowest > 1e-6)) throw InputError("no critical point: the vapour constants put it at no temperature");
  for (double T = lowest; T <= highest; T *= 1.1) {
    if (steepness(T) > 0) {
      low = T;
    } else {
      high = T;
      break;
    }
  }
  if (high <= lowest) {
    throw InputError(fmt::format(
        "no critical point between {:.0f} and {:.0f} K; check the vapour constants vapour_attraction and "
        "covolume_ratio, or try a smaller join_volume_ratio",
        lowest, highest));
  }
  const double T = find_root(steepness, low, high, "critical temperature", 40);
  const double volume = steepest_point(search, T).volume;
  const FluidPoint point = search.fluid(volume, T);
  return {T, point.pressure, volume, point.energy};
}

Saturation saturation(const VapourDome::Search& search, double T, double volume_in_loop) {
  const auto slope = [&](double V) { return search.isotherm(V, T).pressure_by_volume; };
  const auto pressure = [&](double V) { return search.isotherm(V, T).pressure; };
  // Search from a volume in the loop outwards to the first volume where P decreases again: the spinodals of this
  // loop, even if the join of the model causes another loop elsewhere.
  // Where a cold isotherm has further loops at negative pressure, the vapour begins at the first maximum with a positive
  // one: material is unstable between them too.
  const auto spinodal = [&](double start, double outer, bool of_vapour) {
    double inside = start, last = 0;
    bool in_loop = slope(inside) >= 0;
    for (int i = 1; i <= scan_points; ++i) {
      const double V = spaced(start, outer, i, scan_points);
      const bool rises = slope(V) >= 0;
      if (in_loop && !rises) {
        last = find_root(slope, inside, V, "spinodal");
        if (!of_vapour || pressure(last) > 0) return last;
      }
      in_loop = rises || (in_loop && last == 0);
      inside = V;
    }
    return last;
  };
  const double liquid_spinodal = spinodal(volume_in_loop, search.dense_volume, false);
  double vapour_spinodal = spinodal(volume_in_loop, search.dilute_volume, true);
  if (!(liquid_spinodal > 0) || !(vapour_spinodal > 0)) {
    throw InputError(
        fmt::format("no liquid-vapour loop at {:.0f} K; check the vapour constants (vapour_attraction, "
                    "covolume_ratio, join_volume_ratio)",
                    T));
  }
  if (!(pressure(vapour_spinodal) > 0)) {
    throw InputError(fmt::format(
        "the vapour of {:.0f} K has its largest pressure, {:.3g} Pa, at {:.4g} m^3/kg: no saturated vapour",
        T, pressure(vapour_spinodal), vapour_spinodal));
  }
  const double spinodal_pressure = pressure(liquid_spinodal);

  const auto liquid_volume = [&](double p) {
    return find_root([&](double V) { return pressure(V) - p; }, search.dense_volume, liquid_spinodal,
                     "volume of the saturated liquid");
  };
  const auto vapour_volume = [&](double p) {
    const double ideal = 2 * search.gas_constant * T / p;
    return find_root([&](double V) { return pressure(V) / p - 1; }, vapour_spinodal,
                     std::max(ideal, 2 * vapour_spinodal), "volume of the saturated vapour");
  };
  // The Gibbs energy of the liquid minus that of the vapour decreases with P, d(dG)/dP = V_l - V_v < 0.
  const auto difference = [&](double log_pressure) {
    const double p = std::exp(log_pressure);
    const double Vl = liquid_volume(p), Vv = vapour_volume(p);
    return gibbs(search.fluid(Vl, T), Vl, T) - gibbs(search.fluid(Vv, T), Vv, T);
  };
  // The liquid boils below the largest pressure of its vapour. Where it would not, what lies at that maximum is no vapour
  // but a bend of the isotherm within the dome: the vapour begins at a later one.
  const auto highest = [&] { return std::log(pressure(vapour_spinodal)) - 1e-12; };
  while (difference(highest()) > 0) {
    const double next = spinodal(1.0001 * vapour_spinodal, search.dilute_volume, true);
    if (!(next > vapour_spinodal) || !(pressure(next) > 0)) break;
    vapour_spinodal = next;
  }
  const double upper = highest();
  double lower = spinodal_pressure > 0 ? std::log(spinodal_pressure) + 1e-12 : upper - 1;
  if (spinodal_pressure <= 0) {
    while (difference(lower) < 0 && lower > upper - 600) lower -= 2 * (upper - lower);
  }
  const double p = std::exp(find_root(difference, lower, upper, "vapour pressure"));

  Saturation s;
  s.temperature = T;
  s.pressure = p;
  s.liquid_volume = liquid_volume(p);
  s.vapour_volume = vapour_volume(p);
  const FluidPoint l = search.fluid(s.liquid_volume, T), v = search.fluid(s.vapour_volume, T);
  s.liquid_energy = l.energy;
  s.liquid_entropy = l.entropy;
  s.vapour_energy = v.energy;
  s.vapour_entropy = v.entropy;
  return s;
}

Saturation VapourDome::saturation_at(double temperature) const {
  return saturation(search_, temperature, critical_.specific_volume);
}

double VapourDome::vaporised_fraction(double V, double E) const {
  // Fraction required by the volume at a row, and the energy of that mixture, extrapolated linearly out of the
  // dome.
  const auto colder = [&](const TieLine& s) {
    const double x = s.fraction(V);
    return x >= 0 && x <= 1 && s.energy(x) < E;
  };
  const TieLine& coldest = tie_lines_.front();
  if (V <= coldest.liquid_volume) return 0.0;
  // Last row inside the dome at V with less energy than E.
  const auto next = std::partition_point(tie_lines_.begin(), tie_lines_.end(), colder);
  if (next == tie_lines_.begin()) return std::clamp(coldest.fraction(V), 0.0, 1.0);
  const TieLine& below = *(next - 1);
  const double x0 = below.fraction(V);
  if (next == tie_lines_.end()) return std::clamp(x0, 0.0, 1.0);
  const double x1 = next->fraction(V);
  const double e0 = below.energy(x0), e1 = next->energy(x1);
  if (!(e1 > e0)) return std::clamp(x0, 0.0, 1.0);
  return std::clamp(x0 + (x1 - x0) * std::min(1.0, (E - e0) / (e1 - e0)), 0.0, 1.0);
}

VapourDome VapourDome::transformed(double factor, double energy) const {
  VapourDome result = *this;
  Search& search = result.search_;
  search.fluid = [of = search_.fluid, factor, energy](double V, double T) {
    const FluidPoint p = of(V / factor, T);
    return FluidPoint{p.pressure, factor * p.energy + energy, factor * p.entropy};
  };
  search.isotherm = [of = search_.isotherm, factor](double V, double T) {
    const IsothermPoint p = of(V / factor, T);
    return IsothermPoint{p.pressure, p.pressure_by_volume / factor};
  };
  for (double* volume : {&search.dense_volume, &search.loop_volume, &search.dilute_volume,
                         &search.gas_constant, &result.critical_.specific_volume}) {
    *volume *= factor;
  }
  result.critical_.energy = factor * critical_.energy + energy;
  for (Saturation& s : result.rows_) {
    for (double* volume : {&s.liquid_volume, &s.vapour_volume, &s.liquid_entropy, &s.vapour_entropy}) {
      *volume *= factor;
    }
    for (double* value : {&s.liquid_energy, &s.vapour_energy}) *value = factor * *value + energy;
  }
  return result;
}

std::optional<Saturation> VapourDome::at_temperature(double temperature) const {
  if (!(temperature >= rows_.front().temperature && temperature <= rows_.back().temperature))
    return std::nullopt;
  return saturation_at(temperature);
}

std::optional<Saturation> VapourDome::at_pressure(double pressure) const {
  if (!(pressure >= rows_.front().pressure && pressure <= rows_.back().pressure)) return std::nullopt;
  const auto above = std::partition_point(rows_.begin(), rows_.end(),
                                          [&](const Saturation& s) { return s.pressure < pressure; });
  if (above == rows_.begin()) return rows_.front();
  const double T = find_root([&](double t) { return std::log(saturation_at(t).pressure / pressure); },
                             (above - 1)->temperature, above->temperature, "saturation temperature", 40);
  return saturation_at(T);
}

}  // namespace whipple::eos
