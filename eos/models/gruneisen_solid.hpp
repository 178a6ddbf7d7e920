// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/core.h>

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

#include "eos/constant_heat_capacity.hpp"
#include "eos/fourfold_table.hpp"
#include "eos/models/gruneisen_point.hpp"
#include "src/core/base/error.hpp"

namespace whipple::eos {

/// Holds rho Gamma = rho0 (constant + linear mu + quadratic mu^2) in compression, mu = rho/rho0 - 1.
struct GruneisenLaw {
  double constant = 0, linear = 0, quadratic = 0;
};

/// Holds the reference state of a condensed model.
struct CondensedReference {
  double density, temperature, energy, heat_capacity;
};

/// Holds the pressure at e = 0 and its derivative with respect to mu.
struct ReferencePressure {
  double value, slope;
};

/// Holds four densities of a GruneisenSolid: p = A + B e, c^2 = C + D e.
struct TabulatedIsochore {
  Lanes density, cold_energy, A, B, C, D;

  [[nodiscard]] Response response(Lanes energy) const {
    const Lanes pressure = A + B * energy, squared = C + D * energy;
    return {pressure, squared - pressure * B / (density * density), B, squared};
  }
};

/// Models a solid with a given reference pressure in compression and a linear one in expansion
/// (docs/theory/equations_of_state.md, section 2.2):
///   compression: A(rho) of `Reference`, rho Gamma by the law;
///   expansion:   A = p0 + K mu, Gamma = its value at rho0.
/// A batch reads A, C, D of c^2 = C + D e, and e_c from one table; less dense material is computed from closed forms.
/// @tparam Reference  ReferencePressure operator()(double mu) const, mu = rho/rho0 - 1
template <class Reference>
class GruneisenSolid {
 public:
  /// @param pressure, bulk_modulus  p0 and K of the expansion: those of A at rho0
  /// @param greatest_x              upper limit of the range of the reference pressure
  /// @throws InputError if cold material softens at negligible compression
  GruneisenSolid(std::string_view name, const Reference& reference, const GruneisenLaw& law,
                 const CondensedReference& state, double pressure, double bulk_modulus, double greatest_x)
      : reference_(reference), law_(law), state_(state) {
    const double rho0 = state.density, G = law.constant;
    A0_ = pressure - bulk_modulus;
    A1_ = bulk_modulus;
    inverse_density_ = 1 / rho0;
    inverse_volume_ = A0_ / ((1 + G) * rho0);
    constant_ = G > 0 ? A1_ / (G * rho0) : 0;
    power_ = state.energy + inverse_volume_ + constant_ - state.heat_capacity * state.temperature;
    B0_ = broadcast(rho0 * G);
    expanded_slope_ = broadcast(G);
    linear_ = broadcast(law.linear);
    quadratic_ = broadcast(law.quadratic / rho0);
    least_density_ = least_tabulated * rho0;
    tabulate(name, greatest_x);
  }

  [[nodiscard]] double maximum_density() const { return maximum_density_; }

  /// Returns the smallest density of the table.
  [[nodiscard]] double least_usual_density() const { return least_density_; }
  using Places = FourfoldTable::Places;
  /// Finds the positions of densities within the table; `usual_isochore` returns the values there.
  void find(Lanes rho, Places& places) const { table_.find(rho, places); }
  [[nodiscard]] TabulatedIsochore usual_isochore(Lanes rho, const Places& places) const {
    const auto [A, C, D, cold_energy] = table_(places);
    const Lanes distance = rho - state_.density, compressed = linear_ + quadratic_ * distance;
    return {rho, cold_energy, A, B0_ + distance * select_negative(distance, expanded_slope_, compressed), C,
            D};
  }
  [[nodiscard]] TabulatedIsochore isochore(Lanes rho) const {
    const Lanes inside = maximum(rho, broadcast(least_density_));
    Places places;
    find(inside, places);
    TabulatedIsochore result = usual_isochore(inside, places);
    const LanesMask thin = rho < least_density_;
    if (bits(thin) == 0) return result;
    const TabulatedIsochore closed = expanded(rho);
    result.density = rho;
    result.cold_energy = thin ? closed.cold_energy : result.cold_energy;
    result.A = thin ? closed.A : result.A;
    result.B = thin ? closed.B : result.B;
    result.C = thin ? closed.C : result.C;
    result.D = thin ? closed.D : result.D;
    return result;
  }

  /// Returns the constants of an evaluation point by point, whose table is appended to an array of numbers.
  /// @param least_temperature  K, @param least_squared  least c^2, m^2/s^2
  [[nodiscard]] GruneisenPoint point(double least_temperature, double least_squared,
                                     std::vector<double>& numbers) const {
    GruneisenPoint result = {.cells = static_cast<std::uint32_t>(numbers.size()),
                             .first = table_.first(),
                             .per_width = table_.per_width(),
                             .least_density = least_density_,
                             .maximum_density = maximum_density_,
                             .density = state_.density,
                             .B0 = B0_[0],
                             .linear = linear_[0],
                             .quadratic = quadratic_[0],
                             .gruneisen = law_.constant,
                             .A0 = A0_,
                             .A1 = A1_,
                             .power = power_,
                             .inverse_volume = inverse_volume_,
                             .constant = constant_,
                             .heat_capacity = state_.heat_capacity,
                             .least_temperature = least_temperature,
                             .least_squared = least_squared};
    table_.append_to(numbers);
    return result;
  }

  /// Returns ln(T_s/T0).
  [[nodiscard]] double log_isentrope_temperature(double rho) const {
    const double rho0 = state_.density, logarithm = std::log(rho / rho0);
    if (rho <= rho0) return law_.constant * logarithm;
    const double x = 1 - rho0 / rho;
    return law_.constant * x + law_.linear * (logarithm - x) +
           law_.quadratic * (rho / rho0 - 1 - 2 * logarithm + x);
  }

 private:
  static constexpr double least_tabulated = 0.375;  ///< of rho0

  /// Returns A, C and D in compression.
  [[nodiscard]] std::array<double, 3> compressed(double rho) const {
    const double rho0 = state_.density, mu = (rho - rho0) / rho0;
    const ReferencePressure A = reference_(mu);
    const double B = rho0 * (law_.constant + mu * (law_.linear + mu * law_.quadratic)),
                 work = B / (rho * rho);
    return {A.value, A.slope / rho0 + A.value * work, law_.linear + 2 * law_.quadratic * mu + B * work};
  }
  [[nodiscard, gnu::noinline, gnu::pure]] TabulatedIsochore expanded(Lanes rho) const {
    const double G = law_.constant;
    const Lanes V = 1.0 / rho, r = rho * inverse_density_, A = A0_ + A1_ * r, work = G * V;
    Lanes cold_energy = -inverse_volume_ * state_.density * V - constant_;
    if (G > 0) {
      cold_energy += power_ * pow(r, broadcast(G));
    } else {
      cold_energy += power_ + A1_ * inverse_density_ * natural_log(r);
    }
    return {rho, cold_energy, A, G * rho, A1_ * inverse_density_ + A * work, broadcast(G * (1 + G))};
  }

  /// Tabulates e_c = e_s - c_v T_s on the isentrope through the reference state: de_s/dx = (A + B e_s)/rho0 with
  /// the integrating factor T_s/T0  (E3). The model ends where the coldest material softens, c^2 = 0.
  void tabulate(std::string_view name, double greatest_x) {
    const double rho0 = state_.density, heat = state_.heat_capacity;
    const auto require_compression = [&](const char* what, double end) {  // of the volume
      if (end >= 1 - 1 / 1.01) return;
      throw InputError(fmt::format(
          "{}: {} at {:.4g} kg/m^3, at no compression to speak of; check the constants of the curve "
          "and of the Grueneisen parameter",
          name, what, rho0 / (1 - end)));
    };
    require_compression("the curve ends", greatest_x);
    const auto mu = [](double x) { return x / (1 - x); };
    const auto factor = [&](double x) { return std::exp(log_isentrope_temperature(rho0 / (1 - x))); };
    const auto integrand = [&](double x) { return reference_(mu(x)).value / (rho0 * factor(x)); };
    // Integrate from 0 to the ends of fine intervals, with a further quadrature between them.
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
      const double x = i * step;
      const auto [A, C, D] = compressed(rho0 / (1 - x));
      if (C + D * (cold_energy(x) + heat) < 0) break;
      last = x;
    }
    maximum_density_ = rho0 / (1 - last);
    require_compression("cold material softens", last);
    const double thermal = heat * state_.temperature;
    table_ = FourfoldTable(
        [&](double rho) {
          const TabulatedIsochore i = expanded(broadcast(rho));
          return FourfoldTable::Values{i.A[0], i.C[0], i.D[0], i.cold_energy[0]};
        },
        [&](double rho) {
          const auto [A, C, D] = compressed(rho);
          return FourfoldTable::Values{A, C, D, cold_energy(1 - rho0 / rho)};
        },
        least_density_, rho0, maximum_density_, {A1_ + rho0 * thermal, A1_ / rho0 + thermal, 1, thermal});
  }

  Reference reference_;
  GruneisenLaw law_;
  CondensedReference state_;
  double A0_ = 0, A1_ = 0;                                  ///< A = A0 + A1 rho/rho0 in expansion
  Lanes B0_{}, expanded_slope_{}, linear_{}, quadratic_{};  ///< of B as functions of rho - rho0
  double inverse_density_ = 0;                              ///< 1/rho0
  double power_ = 0, inverse_volume_ = 0, constant_ = 0;    ///< (E4)
  double maximum_density_ = 0, least_density_ = 0;
  FourfoldTable table_;  ///< A, C, D, e_c over rho - rho0
};

}  // namespace whipple::eos
