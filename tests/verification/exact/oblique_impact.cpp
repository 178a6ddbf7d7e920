// SPDX-License-Identifier: BSD-3-Clause
#include "tests/verification/exact/oblique_impact.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "src/transfer/shape_function.hpp"
#include "tests/verification/exact/runs.hpp"

namespace whipple::verification::exact {
namespace {

/// About the origin, of the motion of the particles and of their affine fields (kg m^2/s).
struct AngularMomentum {
  Vector3 of_motion = Vector3::Zero(), of_fields = Vector3::Zero();
  [[nodiscard]] Vector3 total() const { return of_motion + of_fields; }
};

AngularMomentum angular_momentum(const Particles& q, double inertia) {
  AngularMomentum sum;
  for (std::size_t p = 0; p < q.size(); ++p) {
    sum.of_motion += q.mass[p] * q.position[p].cross(q.velocity[p]);
    if (q.affine_velocity.empty()) continue;
    const Matrix3& c = q.affine_velocity[p];
    sum.of_fields += q.mass[p] * inertia * Vector3(c(2, 1) - c(1, 2), c(0, 2) - c(2, 0), c(1, 0) - c(0, 1));
  }
  return sum;
}

}  // namespace

ObliqueImpact oblique_cubes() { return {"cubes of aluminium, 1 km/s", false, 1000, 3e-3, 6e-6}; }
ObliqueImpact oblique_spheres() { return {"spheres of aluminium, 3 km/s", true, 3000, 3e-3, 4e-6}; }

Result run(const ObliqueImpact& impact, double cell, const std::string& affine_field) {
  const std::string material =
      impact.spheres
          ? aluminium(
                "oblique_spall", "0.3 GPa",
                "[[failure]]\nmodel = \"tensile_pressure\"\nsource = \"test\"\nspall_strength = \"1 GPa\"\n")
          : aluminium("oblique", "0.3 GPa");
  std::string text = fmt::format(R"(
[domain]
lower = [-0.04, -0.04, -0.04]
upper = [0.04, 0.04, 0.04]
cell_size = {:.9g}
)",
                                 cell);
  constexpr double radius = 3e-3;
  // Spheres touch where the line of their centres is two radii long.
  const double apart =
      impact.spheres ? std::sqrt(4 * radius * radius - impact.offset * impact.offset) : 2 * radius;
  const Vector3 shift(0.23e-3, 0.11e-3, 0.07e-3);
  for (const double side : {-1.0, 1.0}) {
    const Vector3 centre = shift + 0.5 * side * Vector3(apart, impact.offset, 0);
    text += fmt::format(R"(
[[body]]
name = "{}"
material = "{}"
velocity = [{}, 0, 0]
)",
                        side < 0 ? "left" : "right", material, -0.5 * side * impact.speed);
    if (impact.spheres) {
      text += fmt::format("shape = {{ sphere = {{ center = [{:.9g}, {:.9g}, {:.9g}], radius = {:.9g} }} }}\n",
                          centre[0], centre[1], centre[2], radius);
    } else {
      const Vector3 a = centre.array() - radius, b = centre.array() + radius;
      text += fmt::format(
          "shape = {{ box = {{ lower = [{:.9g}, {:.9g}, {:.9g}], upper = [{:.9g}, {:.9g}, {:.9g}] }} }}\n",
          a[0], a[1], a[2], b[0], b[1], b[2]);
    }
  }
  const std::string more =
      affine_field.empty() ? "" : "[transfer]\naffine_field = \"" + affine_field + "\"\n";
  solver::Simulation simulation(default_case(impact.end, text, more), parallel::world());
  const double inertia = transfer::affine_inertia(simulation.setup().transfer.shape_function, cell);
  const Vector3 at_start = angular_momentum(simulation.particles(), inertia).total();
  const std::size_t count = simulation.particles().size();
  EnergyWatch watch;
  double worst = 0, momentum = 0;
  run_to(simulation, impact.end, [&](const solver::Simulation& now) {
    watch(now);
    momentum = std::max(momentum, now.state().ledger.momentum_error(now.totals()));
    const Vector3 change = angular_momentum(now.particles(), inertia).total() - at_start;
    worst = std::max(worst, change.norm() / at_start.norm());
  });
  const AngularMomentum at_end = angular_momentum(simulation.particles(), inertia);
  Result result{
      fmt::format("{:g} mm{}", 1e3 * cell, affine_field.empty() ? "" : ", " + affine_field), cell, {}, {}};
  result.add("change of the angular momentum over that at the start", 0,
             (at_end.total() - at_start).dot(at_start) / at_start.squaredNorm());
  result.add("largest change on the way", 0, worst);
  result.add("fraction of the affine fields at the end", 0,
             at_end.of_fields.dot(at_start) / at_start.squaredNorm());
  result.add("particles lost", 0, static_cast<double>(count - simulation.particles().size()));
  result.add("largest momentum error", 0, momentum);
  result.add("largest energy error", 0, watch.worst);
  return result;
}

}  // namespace whipple::verification::exact
