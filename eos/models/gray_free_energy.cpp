// SPDX-License-Identifier: BSD-3-Clause
// Condensed phases of GRAY. Equation numbers: docs/theory/gray.md.
#include "eos/models/gray_free_energy.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

#include "eos/models/gray_reference_pressure.hpp"
#include "src/core/base/error.hpp"

namespace whipple::eos {
namespace {

constexpr int table_intervals = 512;
/// Minimum distance to the pole y = 0 of the shock curve if the cold pressure does not turn over before.
constexpr double pole_margin = 0.03;
constexpr double greatest_compression = 0.9;     ///< x; tenfold compression
constexpr double checked_temperature = 30000.0;  ///< K: the heat capacity must be positive up to here

}  // namespace

GrayFreeEnergy::GrayFreeEnergy(const GrayConstants& constants) : constants_(resolved(constants)) {
  const GrayConstants& c = constants_;
  gas_ = GrayConstants::gas_constant / c.molar_mass;
  lattice_ = 3 * gas_;
  heat_coefficient_ = (c.electronic_heat_coefficient + c.anharmonic_heat_coefficient) / c.molar_mass;
  melting_entropy_ = c.melting_entropy / c.molar_mass;
  liquid_slope_ = c.liquid_heat_coefficient / c.molar_mass;
  const double T0 = c.reference_temperature, V0 = c.reference_specific_volume;
  shock_curve_ = {c.hugoniot_slope, c.hugoniot_quadratic, c.hugoniot_cubic};
  cold_energy_at_reference_ = -T0 * (lattice_ + heat_coefficient_ * T0 / 2);                       // (G4)
  cold_offset_ = T0 * T0 * heat_coefficient_ * (c.gruneisen - c.electronic_gruneisen) / (2 * V0);  // (G6)
  isochoric_ = c.melting != MeltingTransition::band;
  entropy_offset_ = -heat_coefficient_ * T0;  // zero entropy at (V0, T0)
  join_volume_ = c.join_volume_ratio * V0;
  covolume_ = c.covolume_ratio * V0;
  tabulate_cold_curve();
  prepare_vapour();
  check_heat_capacity();
  solve_vapour_attraction();
}

double GrayFreeEnergy::lattice_factor(double x) const {  // (G10)
  const double a = constants_.gruneisen_slope;
  return std::exp(a * x - (constants_.gruneisen - a) * std::log1p(-x));
}

template <class Number>
GrayFreeEnergy::Cold<Number> GrayFreeEnergy::cold_from_energy(Number x, Number energy) const {
  // dE_c/dx = V0 P_c turns (G9) into P_c = P1a + P_CC + q (E_c - E_0H)/V0 with q = gamma/(1 - x).
  const GrayConstants& c = constants_;
  const double V0 = c.reference_specific_volume;
  const auto [f, f1, f2] = gray_reference_pressure(x, shock_curve_, c.gruneisen, c.gruneisen_slope);
  const double scale = c.hugoniot_intercept * c.hugoniot_intercept / V0;
  const double excess = c.gruneisen - c.gruneisen_slope;
  const Number inverse = 1 / (1 - x), density = energy * (1 / V0);
  const Number q1 = excess * inverse * inverse, q2 = 2 * q1 * inverse,
               q = c.gruneisen_slope + excess * inverse;
  const Number p = scale * f + cold_offset_ + q * density;
  const Number p1 = scale * f1 + q1 * density + q * p;
  const Number p2 = scale * f2 + q2 * density + 2 * q1 * p + q * p1;
  return {energy, p, p1, p2};
}

void GrayFreeEnergy::tabulate_cold_curve() {
  const GrayConstants& c = constants_;
  const double V0 = c.reference_specific_volume;
  const double scale = c.hugoniot_intercept * c.hugoniot_intercept;  // V0 P1a = scale * f
  const auto integrand = [&](double x) {
    const double f = gray_reference_pressure(x, shock_curve_, c.gruneisen, c.gruneisen_slope).value;
    return (scale * f + V0 * cold_offset_) / lattice_factor(x);
  };
  const auto integral = [&](double from, double to) {
    return boost::math::quadrature::gauss<double, 10>::integrate(integrand, from, to);
  };
  const auto energy = [&](double x, double sum) {
    return lattice_factor(x) * (cold_energy_at_reference_ + sum);
  };

  // Compression limit (G29): the first x at which the cold pressure stops increasing.
  const double last = shock_curve_.limit(pole_margin, greatest_compression);
  constexpr int steps = 500;
  double limit = last, sum = 0, previous_slope = cold_from_energy(0.0, energy(0, 0)).p1;
  if (previous_slope <= 0) {
    throw InputError(
        "gray: the cold pressure does not rise with compression at V0; check hugoniot_intercept, gruneisen "
        "and "
        "the heat coefficients");
  }
  for (int i = 1; i <= steps; ++i) {
    const double x0 = last * (i - 1) / steps, x1 = last * i / steps;
    sum += integral(x0, x1);
    const double slope = cold_from_energy(x1, energy(x1, sum)).p1;
    if (slope <= 0) {
      limit = x0 + (x1 - x0) * previous_slope / (previous_slope - slope);
      break;
    }
    previous_slope = slope;
  }
  least_volume_ = V0 * (1 - limit);

  const double begin = 1 - c.join_volume_ratio, step = (limit - begin) / table_intervals;
  const auto node = [&](int i) { return begin + i * step; };
  const int origin = static_cast<int>(std::lround(-begin / step));  // node nearest to x = 0
  std::vector<double> sums(table_intervals + 1);
  sums[origin] = integral(0, node(origin));
  for (int i = origin; i < table_intervals; ++i) sums[i + 1] = sums[i] + integral(node(i), node(i + 1));
  for (int i = origin; i > 0; --i) sums[i - 1] = sums[i] - integral(node(i - 1), node(i));
  std::vector<HermiteTable::Node> nodes;
  for (int i = 0; i <= table_intervals; ++i) {
    const Cold<double> cold = cold_from_energy(node(i), energy(node(i), sums[i]));
    nodes.push_back({cold.e, V0 * cold.p, V0 * cold.p1});
  }
  table_ = HermiteTable(begin, step, std::move(nodes));
}

template <class Number>
BasicGrayIsochore<Number> GrayFreeEnergy::with_cold_curve(Number V, const Cold<Number>& cold_state) const {
  using std::exp;
  using whipple::exp;
  const GrayConstants& c = constants_;
  const double V0 = c.reference_specific_volume;
  const Number ratio = V * (1 / V0), x = 1 - ratio, density = 1 / V;
  BasicGrayIsochore<Number> result;
  result.V = V;
  result.log_ratio = natural_log(ratio);
  result.gruneisen = c.gruneisen - c.gruneisen_slope * x;                                        // (G2)
  result.heat_coefficient = heat_coefficient_ * exp(c.electronic_gruneisen * result.log_ratio);  // (G8)
  result.lindemann_exponent =
      2.0 / 3.0 - 2 * c.melting_gruneisen + 2 * c.melting_gruneisen_slope * x;  // (G12)
  result.melting_temperature =
      c.melting_temperature *
      exp(2 * c.melting_gruneisen_slope * x -
          2 * (c.melting_gruneisen - 1.0 / 3.0 - c.melting_gruneisen_slope) * result.log_ratio);  // (G11)

  const Number g = result.heat_coefficient, gamma = result.gruneisen;
  const double gamma_e = c.electronic_gruneisen;
  result.cold_curvature = cold_state.p2 * (1 / (V0 * V0));
  BasicGrayBranch<Number>& s = result.solid;  // (G1), (G3) with (G8)
  s.e0 = c.reference_energy + cold_state.e;
  s.e1 = Number{} + lattice_;
  s.e2 = 0.5 * g;
  s.p0 = cold_state.p;
  s.p1 = gamma * lattice_ * density;
  s.p2 = 0.5 * gamma_e * g * density;
  s.q0 = cold_state.p1 * (-1 / V0);
  s.q1 = lattice_ * (c.gruneisen_slope / V0 - gamma * density) * density;
  s.q2 = (gamma_e - 1) * s.p2 * density;
  return result;
}

template <class Number>
BasicGrayIsochore<Number> GrayFreeEnergy::isochore(Number V) const {
  const Number x = 1 - V * (1 / constants_.reference_specific_volume);
  return with_cold_curve(V, cold_from_energy(x, table_(x)));
}

GrayIsochore GrayFreeEnergy::isochore_of_cold_curve(double V, double energy, double pressure,
                                                    double pressure_by_volume) const {
  const Cold<double> cold{energy - constants_.reference_energy, pressure,
                          -pressure_by_volume * constants_.reference_specific_volume, 0.0};
  return with_cold_curve(V, cold);
}

template <class Number>
BasicGrayBranch<Number> GrayFreeEnergy::liquid_branch(const BasicGrayIsochore<Number>& iso) const {
  // E_l - E_s = T_m (dS - alpha/2) - alpha T^2/(2 T_m) (G16), P_l - P_s = -(lambda/V)(E_l - E_s) (G18).
  const Number density = 1 / iso.V, m = iso.lindemann_exponent * density;
  const Number m1 =
      -(2 * constants_.melting_gruneisen_slope / constants_.reference_specific_volume + m) * density;
  const Number heat = iso.melting_temperature * (melting_entropy_ - liquid_slope_ / 2);
  const Number slope = liquid_slope_ / (2 * iso.melting_temperature);
  BasicGrayBranch<Number> l = iso.solid;
  l.e0 += heat;
  l.e2 -= slope;
  l.p0 -= m * heat;
  l.p2 += m * slope;
  l.q0 -= (m1 + m * m) * heat;
  l.q2 += (m1 - m * m) * slope;
  return l;
}

template <class Number>
BasicGrayBranch<Number> GrayFreeEnergy::hot_liquid_branch(const BasicGrayIsochore<Number>& iso) const {
  // E_l - E_s = T_m [dS - alpha (1 - tau_G^2)/2] - tau_G alpha T (G17), pressure as above.
  const double tau = constants_.hot_liquid_ratio;
  const Number density = 1 / iso.V, m = iso.lindemann_exponent * density;
  const Number m1 =
      -(2 * constants_.melting_gruneisen_slope / constants_.reference_specific_volume + m) * density;
  const Number heat = iso.melting_temperature * (melting_entropy_ - liquid_slope_ * (1 - tau * tau) / 2);
  const double slope = tau * liquid_slope_;
  BasicGrayBranch<Number> l = iso.solid;
  l.e0 += heat;
  l.e1 -= slope;
  l.p0 -= m * heat;
  l.p1 += m * slope;
  l.q0 -= (m1 + m * m) * heat;
  l.q1 += m1 * slope;
  return l;
}

double GrayFreeEnergy::solid_entropy(const GrayIsochore& iso, double T) const {
  // S = 3R ln(T/T0) - 3R ln h + g_e T - g_e0 T0
  const GrayConstants& c = constants_;
  const double x = 1 - iso.V / c.reference_specific_volume;
  const double log_h = c.gruneisen_slope * x - (c.gruneisen - c.gruneisen_slope) * iso.log_ratio;
  return lattice_ * (std::log(T / c.reference_temperature) - log_h) + iso.heat_coefficient * T +
         entropy_offset_;
}

double GrayFreeEnergy::liquid_entropy_excess(double tau) const {
  // -phi'(tau) of (G15)
  const double tau_g = constants_.hot_liquid_ratio;
  if (tau <= tau_g) return melting_entropy_ - liquid_slope_ * tau;
  return melting_entropy_ - liquid_slope_ * tau_g * (1 + std::log(tau / tau_g));
}

// Width of the melting band, (G31) with the bound of (G32): delta = T_m s(k), s = (1 + k^4)^(-1/4) for k > 0, 1 for
// k <= 0, where 1/k = delta_T/T_m of (G31). Near and beyond the spinodal of the solid K_T -> 0, and (G31) alone
// would extend below T = 0; for k > 5, the intended range of (G31), the bound changes it by less than 0.04 %.
namespace {
template <class Number>
Number band_shape(Number k) {
  using std::sqrt;
  using whipple::sqrt;
  const Number positive = maximum(k, Number{});
  return 1 / sqrt(sqrt(1 + positive * positive * positive * positive));
}
}  // namespace

template <class Number>
Number GrayFreeEnergy::band_width(const BasicGrayIsochore<Number>& iso) const {
  const Number T = iso.melting_temperature, lambda = iso.lindemann_exponent;
  const double entropy = melting_entropy_ - liquid_slope_;
  const Number k = -iso.V * iso.V * iso.solid.pressure_by_volume(T) / (entropy * lambda * lambda * T);
  return T * band_shape(k);
}

template <class Number>
Number GrayFreeEnergy::band_width_slope(const BasicGrayIsochore<Number>& iso) const {
  const GrayConstants& c = constants_;
  const BasicGrayBranch<Number>& s = iso.solid;
  const double V0 = c.reference_specific_volume;
  const Number V = iso.V, density = 1 / V, T = iso.melting_temperature, lambda = iso.lindemann_exponent;
  const double lambda1 = -2 * c.melting_gruneisen_slope / V0;
  const Number T1 = lambda * T * density;
  const Number Q = s.pressure_by_volume(T);
  const Number q1_slope =
      2 * lattice_ * (iso.gruneisen * density - c.gruneisen_slope / V0) * (density * density);
  const Number q2_slope = (c.electronic_gruneisen - 2) * s.q2 * density;
  const Number Q1 = iso.cold_curvature + T * (q1_slope + T * q2_slope) + (s.q1 + 2 * s.q2 * T) * T1;
  const Number scale = (melting_entropy_ - liquid_slope_) * lambda * lambda * T, inverse = 1 / scale;
  const Number k = -V * V * Q * inverse;
  const Number k1 = -(2 * V * Q + V * V * Q1) * inverse - k * (2 * lambda1 / lambda + lambda * density);
  const Number shape = band_shape(k), squared = shape * shape, positive = maximum(k, Number{});
  const Number shape1 = -positive * positive * positive * squared * squared * shape;
  return T1 * shape + T * shape1 * k1;
}

template <class Number>
BasicGrayBand<Number> GrayFreeEnergy::band(const BasicGrayIsochore<Number>& iso) const {
  const Number half = isochoric_ ? Number{} : 0.5 * band_width(iso);
  const BasicGrayBranch<Number> l = liquid_branch(iso);
  BasicGrayBand<Number> b;
  b.T1 = iso.melting_temperature - half;
  b.T2 = iso.melting_temperature + half;
  b.E1 = iso.solid.energy(b.T1);
  b.E2 = l.energy(b.T2);
  b.P1 = iso.solid.pressure(b.T1);
  b.P2 = l.pressure(b.T2);
  return b;
}

template <class Number>
BasicGrayBandSlopes<Number> GrayFreeEnergy::band_slopes(const BasicGrayIsochore<Number>& iso,
                                                        const BasicGrayBand<Number>& band) const {
  const Number half = isochoric_ ? Number{} : 0.5 * band_width_slope(iso);
  const Number melting_slope = iso.lindemann_exponent * iso.melting_temperature / iso.V;
  const BasicGrayBranch<Number> l = liquid_branch(iso);
  BasicGrayBandSlopes<Number> d;
  d.T1 = melting_slope - half;
  d.T2 = melting_slope + half;
  d.E1 = iso.solid.energy_by_volume(band.T1) + iso.solid.heat_capacity(band.T1) * d.T1;
  d.E2 = l.energy_by_volume(band.T2) + l.heat_capacity(band.T2) * d.T2;
  d.P1 = iso.solid.pressure_by_volume(band.T1) + iso.solid.pressure_by_temperature(band.T1) * d.T1;
  d.P2 = l.pressure_by_volume(band.T2) + l.pressure_by_temperature(band.T2) * d.T2;
  return d;
}

// Instantiations for both number types.
template GrayIsochore GrayFreeEnergy::isochore(double) const;
template BasicGrayIsochore<Lanes> GrayFreeEnergy::isochore(Lanes) const;
template GrayBranch GrayFreeEnergy::liquid_branch(const GrayIsochore&) const;
template BasicGrayBranch<Lanes> GrayFreeEnergy::liquid_branch(const BasicGrayIsochore<Lanes>&) const;
template GrayBranch GrayFreeEnergy::hot_liquid_branch(const GrayIsochore&) const;
template BasicGrayBranch<Lanes> GrayFreeEnergy::hot_liquid_branch(const BasicGrayIsochore<Lanes>&) const;
template GrayBand GrayFreeEnergy::band(const GrayIsochore&) const;
template BasicGrayBand<Lanes> GrayFreeEnergy::band(const BasicGrayIsochore<Lanes>&) const;
template GrayBandSlopes GrayFreeEnergy::band_slopes(const GrayIsochore&, const GrayBand&) const;
template BasicGrayBandSlopes<Lanes> GrayFreeEnergy::band_slopes(const BasicGrayIsochore<Lanes>&,
                                                                const BasicGrayBand<Lanes>&) const;

GrayPoint GrayFreeEnergy::solid(double V, double T) const { return solid(isochore(V), T); }

GrayPoint GrayFreeEnergy::solid(const GrayIsochore& iso, double T) const {
  const GrayBranch& b = iso.solid;
  return {b.pressure(T),
          b.energy(T),
          solid_entropy(iso, T),
          b.heat_capacity(T),
          b.pressure_by_temperature(T),
          b.pressure_by_volume(T)};
}

GrayPoint GrayFreeEnergy::liquid(double V, double T) const { return liquid(isochore(V), T); }

GrayPoint GrayFreeEnergy::liquid(const GrayIsochore& iso, double T) const {
  const double tau = T / iso.melting_temperature;
  const GrayBranch b = tau > constants_.hot_liquid_ratio ? hot_liquid_branch(iso) : liquid_branch(iso);
  return {b.pressure(T),
          b.energy(T),
          solid_entropy(iso, T) + liquid_entropy_excess(tau),
          b.heat_capacity(T),
          b.pressure_by_temperature(T),
          b.pressure_by_volume(T)};
}

double GrayFreeEnergy::cold_pressure(double V) const { return isochore(V).solid.p0; }
double GrayFreeEnergy::gamma(double V) const {
  return constants_.gruneisen - constants_.gruneisen_slope * (1 - V / constants_.reference_specific_volume);
}
double GrayFreeEnergy::melting_temperature(double V) const {
  return with_cold_curve(V, Cold<double>{}).melting_temperature;
}

void GrayFreeEnergy::check_heat_capacity() const {
  const auto refuse = [&](const char* phase, double V, double T, double value) {
    throw InputError(fmt::format(
        "gray: the heat capacity of the {} is {:.4g} J/(kg K) at V/V0 = {:.3f} and {:.0f} K, but must be "
        "positive up "
        "to {:.0f} K; check electronic_heat_coefficient + anharmonic_heat_coefficient ({:.4g} J/(mol K^2)), "
        "liquid_heat_coefficient ({:.4g} J/(mol K)) and hot_liquid_ratio ({:.4g})",
        phase, value, V / constants_.reference_specific_volume, T, checked_temperature,
        constants_.electronic_heat_coefficient + constants_.anharmonic_heat_coefficient,
        constants_.liquid_heat_coefficient, constants_.hot_liquid_ratio));
  };
  constexpr int samples = 64;
  for (int i = 0; i <= samples; ++i) {
    const double V = least_volume_ + (join_volume_ - least_volume_) * i / samples;
    const GrayIsochore iso = isochore(V);
    // Heat capacities are linear in T: it is sufficient to check the ends of each branch.
    const double hot = constants_.hot_liquid_ratio * iso.melting_temperature;
    const double solid_end = std::min(1.5 * iso.melting_temperature, checked_temperature);
    const double liquid_end = std::min(hot, checked_temperature);
    if (const double cv = iso.solid.heat_capacity(solid_end); !(cv > 0)) refuse("solid", V, solid_end, cv);
    if (const double cv = liquid_branch(iso).heat_capacity(liquid_end); !(cv > 0))
      refuse("liquid", V, liquid_end, cv);
    for (const double T : {hot, checked_temperature}) {
      if (T < hot || hot > checked_temperature) continue;
      if (const double cv = hot_liquid_branch(iso).heat_capacity(T); !(cv > 0))
        refuse("hot liquid", V, T, cv);
    }
  }
  // Vapour: the term T D'' F_E of (G25) lowers the heat capacity below T_G(V_J), most at large volumes. With a
  // small electronic heat coefficient it may vanish there; a state of (V, E) then changes to the hot branch with a
  // jump in T (the complete model warns). Below T_G/2 this is rejected.
  for (const double ratio : {1.0, 1.5, 2.0, 4.0, 10.0, 1e3, 1e6}) {
    const double V = ratio * join_volume_;
    const double cool_end = std::min(0.5 * join_hot_temperature_, checked_temperature);
    if (const double cv = vapour_branch(V, false).heat_capacity(cool_end); !(cv > 0))
      refuse("vapour", V, cool_end, cv);
    if (join_hot_temperature_ > checked_temperature) continue;
    for (const double T : {join_hot_temperature_, checked_temperature}) {
      if (const double cv = vapour_branch(V, true).heat_capacity(T); !(cv > 0))
        refuse("hot vapour", V, T, cv);
    }
  }
}

}  // namespace whipple::eos
