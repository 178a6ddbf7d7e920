// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/core.h>

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

#include "eos/constant_heat_capacity.hpp"
#include "eos/cubic_table.hpp"
#include "src/base/error.hpp"

namespace whipple::eos {

/// rho Gamma = rho0 (constant + linear mu + quadratic mu^2) in compression, mu = rho/rho0 - 1.
struct GruneisenLaw {
  double constant = 0, linear = 0, quadratic = 0;
};

/// The reference state of a condensed model.
struct CondensedReference {
  double density, temperature, energy, heat_capacity;
};

/// Where a reference pressure is asked for: r = rho/rho0, mu = r - 1.
struct Compression {
  Lanes r, mu;
};
/// The pressure at e = 0 and its derivative by rho; `weight` is a factor with the poles of the cold energy.
/// 1/r too: a curve with a division of its own makes both in one.
struct ReferencePressure {
  Lanes value, slope, weight, inverse_r;
};

/// A solid with a reference pressure of its own in compression and a linear one in expansion
/// (docs/theory/equations_of_state.md, section 2.2):
///   compression: A(rho) of `Reference`, rho Gamma by the law;
///   expansion:   A = p0 + K mu, Gamma = its value at rho0.
/// The cold energy is tabulated in compression and a closed form in expansion.
/// @tparam Reference  ReferencePressure operator()(const Compression&) const
template <class Reference>
class GruneisenSolid {
 public:
  /// @param pressure, bulk_modulus  p0 and K of the expansion: those of A at rho0
  /// @param greatest_x              where the reference pressure ends at the latest
  /// @throws InputError if cold matter softens at no compression to speak of
  GruneisenSolid(std::string_view name, const Reference& reference, const GruneisenLaw& law,
                 const CondensedReference& state, double pressure, double bulk_modulus, double greatest_x)
      : reference_(reference), law_(law), state_(state) {
    const double rho0 = state.density, G = law.constant;
    A0_ = pressure - bulk_modulus;
    A1_ = bulk_modulus;
    inverse_density_ = 1 / rho0;
    B0_ = rho0 * law.constant;
    B1_ = rho0 * law.linear;
    B2_ = rho0 * law.quadratic;
    twice_quadratic_ = 2 * law.quadratic;
    inverse_volume_ = A0_ / ((1 + G) * rho0);
    constant_ = G > 0 ? A1_ / (G * rho0) : 0;
    power_ = state.energy + inverse_volume_ + constant_ - state.heat_capacity * state.temperature;
    tabulate_cold_energy(name, greatest_x);
  }

  [[nodiscard]] double maximum_density() const { return maximum_density_; }

  [[nodiscard]] LinearIsochore isochore(Lanes rho) const {
    const LanesMask compressed = rho > state_.density;
    const unsigned which = bits(compressed);
    if (which == 0) return expanded(rho);
    const LinearIsochore result = dense(rho);
    if (which == all_lanes) [[likely]]
      return result;
    return LinearIsochore::select(compressed, result, expanded(rho));
  }

  /// ln(T_s/T0)
  [[nodiscard]] double log_isentrope_temperature(double rho) const {
    const double rho0 = state_.density, logarithm = std::log(rho / rho0);
    if (rho <= rho0) return law_.constant * logarithm;
    const double x = 1 - rho0 / rho;
    return law_.constant * x + law_.linear * (logarithm - x) +
           law_.quadratic * (rho / rho0 - 1 - 2 * logarithm + x);
  }

 private:
  [[nodiscard]] Compression compression(Lanes rho) const {
    const Lanes r = rho * inverse_density_;
    return {r, r - 1.0};
  }
  [[nodiscard]] LinearIsochore dense(Lanes rho) const {
    const Compression c = compression(rho);
    const ReferencePressure A = reference_(c);
    // rho Gamma and its slope; x = 1 - rho0/rho
    return {A.inverse_r * inverse_density_,  cold_energy_(c.mu * A.inverse_r) * A.weight, A.value, A.slope,
            B0_ + c.mu * (B1_ + c.mu * B2_), law_.linear + twice_quadratic_ * c.mu};
  }
  // Of its own: the registers of the compressed side need not survive the call of pow.
  [[nodiscard, gnu::noinline, gnu::pure]] LinearIsochore expanded(Lanes rho) const {
    const double G = law_.constant;
    const Lanes V = 1.0 / rho, r = rho * inverse_density_;
    Lanes cold_energy = -inverse_volume_ * state_.density * V - constant_;
    if (G > 0) {
      cold_energy += power_ * pow(r, broadcast(G));
    } else {
      cold_energy += power_ + A1_ * inverse_density_ * natural_log(r);
    }
    return {V, cold_energy, A0_ + A1_ * r, broadcast(A1_ * inverse_density_), G * rho, broadcast(G)};
  }

  /// e_c = e_s - c_v T_s on the isentrope through the reference state: de_s/dx = (A + B e_s)/rho0 with the
  /// integrating factor T_s/T0  (E3). The model ends where the coldest matter softens, c^2 = 0.
  void tabulate_cold_energy(std::string_view name, double greatest_x) {
    const double rho0 = state_.density, heat = state_.heat_capacity;
    const auto density = [&](double x) { return rho0 / (1 - x); };
    const auto factor = [&](double x) { return std::exp(log_isentrope_temperature(density(x))); };
    const auto integrand = [&](double x) {
      return reference_(compression(broadcast(density(x)))).value[0] / (rho0 * factor(x));
    };
    // The integral from 0 to the ends of fine intervals; between them one quadrature more.
    using Gauss = boost::math::quadrature::gauss<double, 10>;
    constexpr int intervals = 2048;
    const double step = greatest_x / intervals;
    std::vector<double> integral{0};
    const auto cold_energy = [&](double x) {
      const int i = std::min(static_cast<int>(x / step), static_cast<int>(integral.size()) - 1);
      const double rest = x > i * step ? Gauss::integrate(integrand, i * step, x) : 0;
      return factor(x) *
             (state_.energy + integral[static_cast<std::size_t>(i)] + rest - heat * state_.temperature);
    };
    double last = 0;
    for (int i = 1; i <= intervals; ++i) {
      integral.push_back(integral.back() + Gauss::integrate(integrand, (i - 1) * step, i * step));
      const Response r =
          dense(broadcast(density(i * step))).response(broadcast(cold_energy(i * step) + heat));
      const double V = 1 / density(i * step);
      if (r.by_density[0] + r.pressure[0] * V * V * r.by_energy[0] < 0) break;
      last = i * step;
    }
    maximum_density_ = density(last);
    if (maximum_density_ < 1.01 * rho0) {
      throw InputError(
          fmt::format("{}: cold matter softens at {:.4g} kg/m^3, at no compression to speak of; check the "
                      "constants of the curve and of the Grueneisen parameter",
                      name, maximum_density_));
    }
    cold_energy_ = CubicTable(
        [&](double x) { return cold_energy(x) / reference_(compression(broadcast(density(x)))).weight[0]; },
        last, heat * state_.temperature);
  }

  Reference reference_;
  GruneisenLaw law_;
  CondensedReference state_;
  double A0_ = 0, A1_ = 0;  ///< A = A0 + A1 rho/rho0 in expansion
  double B0_ = 0, B1_ = 0, B2_ = 0,
         twice_quadratic_ = 0;                            ///< rho Gamma = B0 + B1 mu + B2 mu^2 in compression
  double inverse_density_ = 0;                            ///< 1/rho0
  double power_ = 0, inverse_volume_ = 0, constant_ = 0;  ///< (E4)
  double maximum_density_ = 0;
  CubicTable cold_energy_;  ///< e_c/weight over x, in compression
};

}  // namespace whipple::eos
