// SPDX-License-Identifier: BSD-3-Clause
#include "eos/models/thomas_fermi.hpp"

#include <algorithm>
#include <cmath>

#include "eos/models/atomic_units.hpp"

namespace whipple::eos {
namespace {

/// Holds values of Chebyshev's polynomials with two derivatives.
template <std::size_t n>
struct Polynomials {
  std::array<double, n> value{}, first{}, second{};

  explicit Polynomials(double x) {
    value[0] = 1;
    value[1] = x;
    first[1] = 1;
    for (std::size_t k = 2; k < n; ++k) {
      value[k] = 2 * x * value[k - 1] - value[k - 2];
      first[k] = 2 * value[k - 1] + 2 * x * first[k - 1] - first[k - 2];
      second[k] = 4 * first[k - 1] + 2 * x * second[k - 1] - second[k - 2];
    }
  }
};

/// Holds a function of l = ln V and m = ln T with derivatives.
struct Logarithmic {
  double f = 0, l = 0, m = 0, ll = 0, lm = 0, mm = 0, lmm = 0;
};

/// Sums the series of ln(-F).
Logarithmic sum(double log_volume, double log_temperature) {
  const ThomasFermiSeries& s = thomas_fermi_series();
  const auto rate = [](const std::array<double, 2>& limits) { return 2 / std::log(limits[1] / limits[0]); };
  const double a = rate(s.volumes), b = rate(s.temperatures);
  const Polynomials<ThomasFermiSeries::volume_terms> x(a * (log_volume - std::log(s.volumes[0])) - 1);
  const Polynomials<ThomasFermiSeries::temperature_terms> y(
      b * (log_temperature - std::log(s.temperatures[0])) - 1);
  // Sums over the temperature, all terms of the volume at once.
  constexpr std::size_t terms = ThomasFermiSeries::volume_terms;
  std::array<double, terms> c{}, c1{}, c2{};
  for (std::size_t k = 0; k < y.value.size(); ++k) {
    const double* row = &s.coefficients[k * terms];
    for (std::size_t i = 0; i < terms; ++i) {
      c[i] += row[i] * y.value[k];
      c1[i] += row[i] * y.first[k];
      c2[i] += row[i] * y.second[k];
    }
  }
  Logarithmic g;
  for (std::size_t i = 0; i < terms; ++i) {
    g.f += x.value[i] * c[i];
    g.l += x.first[i] * c[i];
    g.m += x.value[i] * c1[i];
    g.ll += x.second[i] * c[i];
    g.lm += x.first[i] * c1[i];
    g.mm += x.value[i] * c2[i];
    g.lmm += x.first[i] * c2[i];
  }
  return {g.f, a * g.l, b * g.m, a * a * g.ll, a * b * g.lm, b * b * g.mm, a * b * b * g.lmm};
}

/// Returns F = -exp(g) with its derivatives.
Logarithmic exponential(const Logarithmic& g) {
  const double F = -std::exp(g.f);
  return {F,
          F * g.l,
          F * g.m,
          F * (g.l * g.l + g.ll),
          F * (g.l * g.m + g.lm),
          F * (g.m * g.m + g.mm),
          F * ((g.l * g.m + g.lm) * g.m + g.lm * g.m + g.l * g.mm + g.lmm)};
}

}  // namespace

ThomasFermiElectrons::ThomasFermiElectrons(double atomic_number, double molar_mass)
    : volume_unit_(atomic::bohr * atomic::bohr * atomic::bohr / atomic_number * atomic::avogadro /
                   molar_mass),
      temperature_unit_(std::pow(atomic_number, 4.0 / 3.0) * atomic::hartree / atomic::boltzmann),
      energy_unit_(std::pow(atomic_number, 7.0 / 3.0) * atomic::hartree * atomic::avogadro / molar_mass) {}

double ThomasFermiElectrons::least_volume() const { return thomas_fermi_series().volumes[0] * volume_unit_; }
double ThomasFermiElectrons::least_temperature() const {
  return thomas_fermi_series().temperatures[0] * temperature_unit_;
}
double ThomasFermiElectrons::greatest_temperature() const {
  return thomas_fermi_series().temperatures[1] * temperature_unit_;
}

FreeEnergyTerms ThomasFermiElectrons::operator()(double V, double T) const {
  const double last = std::log(thomas_fermi_series().volumes[1]);
  const double l = std::log(V / volume_unit_), m = std::log(T / temperature_unit_);
  Logarithmic F = exponential(sum(std::min(l, last), m));
  if (l > last) {
    const double beyond = l - last;
    F = {F.f + F.l * beyond, F.l, F.m + F.lm * beyond, 0.0, F.lm, F.mm + F.lmm * beyond, F.lmm};
  }
  const double e = energy_unit_;
  return {.F = e * F.f,
          .F_V = e * F.l / V,
          .F_T = e * F.m / T,
          .F_VV = e * (F.ll - F.l) / (V * V),
          .F_VT = e * F.lm / (V * T),
          .F_TT = e * (F.mm - F.m) / (T * T)};
}

}  // namespace whipple::eos
