// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/body_state.hpp"

#include <cmath>
#include <optional>

#include "src/core/base/random_bits.hpp"

namespace whipple::cases {
namespace {

std::optional<double> if_given(double value) {
  return std::isinf(value) ? std::nullopt : std::optional(value);
}

}  // namespace

ParameterTable<Lithostatic> Lithostatic::parameters() {
  return {real("surface", &Lithostatic::surface, "m", range::any(),
               "coordinate of the free surface along the axis of gravity, not below the body"),
          real("k0", &Lithostatic::k0, "", range::any(),
               "horizontal over vertical stress: nu/(1 - nu) of elastic rest, 1 - sin(phi) of soil "
               "deposited, 1 of a fluid")};
}

std::span<const Section<InitialState>> InitialState::sections() {
  static const std::array all = {
      section<&InitialState::lithostatic>("lithostatic", ", in equilibrium with the gravity of the case")};
  return all;
}

ParameterTable<InitialState> InitialState::parameters() {
  using I = InitialState;
  return {
      real("pressure", &I::pressure, "Pa", range::any(), "pressure").optional("0, of a gas its reference"),
      real("temperature", &I::temperature, "K", range::positive(), "temperature")
          .optional("reference temperature"),
      real("density", &I::density, "kg/m^3", range::positive(), "density").optional("from the others")};
}

bool InitialState::gives_state() const {
  return std::isfinite(pressure) || std::isfinite(temperature) || std::isfinite(density);
}

eos::State InitialState::of(const Material& material) const {
  if (!gives_state()) return material.reference;
  return initial_state(material, if_given(density), if_given(temperature), if_given(pressure));
}

ParameterTable<Failure> Failure::parameters() {
  return {choice("cracks", &Failure::cracks,
                 "failed material stays in the one velocity field of the body | the faces of a crack have a "
                 "velocity field each: they part, and press on one another")
              .optional()};
}

ParameterTable<FailureScatter> FailureScatter::parameters() {
  using S = FailureScatter;
  return {
      real("weibull_modulus", &S::weibull_modulus, "", range::positive(), "m of the Weibull distribution"),
      integer("seed", &S::seed, range::between(0, 1e18), "seed of the scatter").optional(),
      real("reference_volume", &S::reference_volume, "m^3", range::positive(),
           "volume to which the thresholds refer: larger particles fail earlier")
          .optional("no effect of size")};
}

bool FailureScatter::given() const { return std::isfinite(weibull_modulus); }

double FailureScatter::factor(std::uint64_t id, double volume) const {
  const double m = weibull_modulus;
  const double size = std::isfinite(reference_volume) ? reference_volume / volume : 1.0;
  const double of_mean_one = std::pow(-std::log(uniform(static_cast<std::uint64_t>(seed), id)), 1.0 / m) /
                             std::tgamma(1.0 + 1.0 / m);
  return of_mean_one * std::pow(size, 1.0 / m);
}

ParameterTable<StrengthScatter> StrengthScatter::parameters() {
  using S = StrengthScatter;
  return {real("least", &S::least, "", {.lower = 0.0, .upper = 1.0, .lower_open = true},
               "least factor of the flow stress; factors are uniform between it and 1"),
          integer("seed", &S::seed, range::between(0, 1e18), "seed of the scatter").optional()};
}

double StrengthScatter::factor(std::uint64_t id) const {
  return least + (1.0 - least) * uniform(static_cast<std::uint64_t>(seed), id);
}

}  // namespace whipple::cases
