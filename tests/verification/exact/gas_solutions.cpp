// SPDX-License-Identifier: BSD-3-Clause
#include "tests/verification/exact/gas_solutions.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace whipple::verification::exact {

double RiemannProblem::jump(const GasState& state, double pressure, double& slope) const {
  const double g = gamma_, p0 = state.pressure;
  if (pressure > p0) {  // shock: Toro, eq. 4.6
    const double a = 2 / ((g + 1) * state.density), b = (g - 1) / (g + 1) * p0;
    const double root = std::sqrt(a / (pressure + b));
    slope = root * (1 - 0.5 * (pressure - p0) / (pressure + b));
    return (pressure - p0) * root;
  }
  const double c = std::sqrt(g * p0 / state.density);  // rarefaction: eq. 4.26
  slope = std::pow(pressure / p0, -(g + 1) / (2 * g)) / (state.density * c);
  return 2 * c / (g - 1) * (std::pow(pressure / p0, (g - 1) / (2 * g)) - 1);
}

RiemannProblem::RiemannProblem(const GasState& left, const GasState& right, double gamma)
    : left_(left), right_(right), gamma_(gamma) {
  pressure_ = 0.5 * (left.pressure + right.pressure);
  double by_left = 0, by_right = 0, slope_left = 0, slope_right = 0;
  for (int i = 0; i < 60; ++i) {
    by_left = jump(left, pressure_, slope_left);
    by_right = jump(right, pressure_, slope_right);
    const double next =
        pressure_ - (by_left + by_right + right.velocity - left.velocity) / (slope_left + slope_right);
    pressure_ = std::max(next, 1e-3 * pressure_);
  }
  velocity_ = 0.5 * (left.velocity + right.velocity + by_right - by_left);
}

GasState RiemannProblem::right_of_contact(const GasState& ahead, double velocity, double ray) const {
  const double g = gamma_, ratio = pressure_ / ahead.pressure;
  const double c = std::sqrt(g * ahead.pressure / ahead.density);
  if (ratio > 1) {
    const double shock =
        ahead.velocity + c * std::sqrt((g + 1) / (2 * g) * ratio + (g - 1) / (2 * g));  // eq. 4.59
    const double mu = (g - 1) / (g + 1);
    if (ray > shock) return ahead;
    return {ahead.density * (ratio + mu) / (mu * ratio + 1), velocity, pressure_};
  }
  const double behind = c * std::pow(ratio, (g - 1) / (2 * g));
  if (ray > ahead.velocity + c) return ahead;
  if (ray < velocity + behind) return {ahead.density * std::pow(ratio, 1 / g), velocity, pressure_};
  const double u = 2 / (g + 1) * (-c + 0.5 * (g - 1) * ahead.velocity + ray);  // eq. 4.63
  const double inside = ray - u;
  return {ahead.density * std::pow(inside / c, 2 / (g - 1)), u,
          ahead.pressure * std::pow(inside / c, 2 * g / (g - 1))};
}

GasState RiemannProblem::at(double ray) const {
  if (ray > velocity_) return right_of_contact(right_, velocity_, ray);
  const GasState mirrored{left_.density, -left_.velocity, left_.pressure};
  GasState state = right_of_contact(mirrored, -velocity_, -ray);
  state.velocity = -state.velocity;
  return state;
}

GasState Noh::at(double radius, double time) const {
  const double squeezed = (gamma + 1) / (gamma - 1);
  if (radius < shock_radius(time)) {
    const double density = std::pow(squeezed, dimensions);
    return {density, 0.0, 0.5 * (gamma - 1) * density};
  }
  return {std::pow(1 + time / radius, dimensions - 1), -1.0, 0.0};
}

Sedov::Similar Sedov::similar(double x) const {
  const double g = gamma_;
  // The points crowd at the centre, where the radius grows with the tenth root of v: x^10 makes it even.
  const double from_centre = (0.8 / (g + 1) - 0.4 / g) * std::pow(x, 10), v = 0.4 / g + from_centre;
  constexpr double j = 3, k = 5;  // spherical; k = j + 2
  const double a = k * (g + 1) / 4, b = (g + 1) / (g - 1), c = k * g / 2;
  const double d = k * (g + 1) / (k * (g + 1) - 2 * (2 + j * (g - 1))), e = (2 + j * (g - 1)) / 2;
  const double a0 = 2 / k, a2 = -(g - 1) / (2 * (g - 1) + j);
  const double a1 = k * g / (2 + j * (g - 1)) * (2 * j * (2 - g) / (g * k * k) - a2);
  const double a3 = j / (2 * (g - 1) + j), a4 = a1 * k / (2 - g), a5 = -2 / (2 - g);
  const double x1 = a * v, x2 = b * c * from_centre, x3 = d * (1 - e * v), x4 = b * (1 - c / g * v);
  const double radius = std::pow(x1, -a0) * std::pow(x2, -a2) * std::pow(x3, -a1);
  return {radius, x1 * radius, std::pow(x2, a3) * std::pow(x3, a4) * std::pow(x4, a5),
          std::pow(x1, a0 * j) * std::pow(x3, a4 - 2 * a1) * std::pow(x4, 1 + a5)};
}

Sedov::Sedov(double energy, double density, double gamma)
    : energy_(energy), density_(density), gamma_(gamma) {
  // Energy inside a shock of radius 1 m at 1 s in gas of 1 kg/m^3.
  const double shock = 0.4;
  const double u2 = 2 * shock / (gamma + 1), rho2 = (gamma + 1) / (gamma - 1),
               p2 = 2 * shock * shock / (gamma + 1);
  double kinetic = 0, internal = 0;
  constexpr int points = 100000;
  Similar last{};
  for (int i = 0; i <= points; ++i) {
    const double x = static_cast<double>(i) / points;
    const Similar now = similar(x);
    const double shell = 4 * std::numbers::pi / 3 * (std::pow(now.radius, 3) - std::pow(last.radius, 3));
    const auto mean = [&](auto&& of) { return 0.5 * shell * (of(now) + of(last)); };
    if (i > 0) {
      kinetic +=
          mean([&](const Similar& s) { return 0.5 * rho2 * s.density * u2 * u2 * s.velocity * s.velocity; });
      internal += mean([&](const Similar& s) { return p2 * s.pressure / (gamma - 1); });
    }
    last = now;
  }
  alpha_ = kinetic + internal;
  kinetic_share_ = kinetic / alpha_;
}

double Sedov::shock_radius(double time) const {
  return std::pow(energy_ * time * time / (alpha_ * density_), 0.2);
}

GasState Sedov::at(double radius, double time) const {
  const double front = shock_radius(time), speed = 0.4 * front / time, ratio = radius / front;
  if (ratio > 1) return {density_, 0, 0};
  double low = 0, high = 1;  // the radius grows with x
  for (int i = 0; i < 60; ++i) {
    const double x = 0.5 * (low + high);
    (similar(x).radius < ratio ? low : high) = x;
  }
  const Similar s = similar(0.5 * (low + high));
  return {density_ * (gamma_ + 1) / (gamma_ - 1) * s.density, 2 * speed / (gamma_ + 1) * s.velocity,
          2 * density_ * speed * speed / (gamma_ + 1) * s.pressure};
}

}  // namespace whipple::verification::exact
