// SPDX-License-Identifier: BSD-3-Clause
// Closed forms of dT/df of load steps (docs/theory/quasi_static.md, eq. 9 to 13) beside central differences of the update
// itself, for every law that has one, in every state of its return.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "eos/model_equation_of_state.hpp"
#include "eos/models/mie_gruneisen.hpp"
#include "src/material/hyperelastic/model.hpp"
#include "src/material/hyperelastic/neo_hookean.hpp"
#include "src/material/strength/drucker_prager.hpp"
#include "src/material/strength/elastic.hpp"
#include "src/material/strength/von_mises.hpp"
#include "src/quasi_static/response.hpp"

namespace whipple::quasi_static {
namespace tangent_test {

constexpr double bulk = 1e9, shear = 4e8;  // Pa
constexpr std::size_t count = 300;

std::shared_ptr<const eos::EquationOfState> hot_solid() {
  eos::MieGruneisenConstants law;
  law.reference_density = 2000.0;
  law.hugoniot_intercept = std::sqrt(bulk / law.reference_density);
  law.hugoniot_slope = 1.5;
  law.gruneisen = 2.0;  // the heat of a step acts on its pressure
  law.heat_capacity = 100.0;
  return std::make_shared<eos::ModelEquationOfState<eos::MieGruneisen>>(law);
}

template <class Model, class Law>
Material solid(Law law) {
  if constexpr (requires { law.youngs_modulus; }) law.shear_modulus = shear;
  return make_material("solid", hot_solid(), std::make_shared<const Model>(law));
}

Particles particles_of(const Material& material) {
  Particles points;
  resize(points, count);
  std::ranges::fill(points.mass, 1.0);
  initialise(material, points, 0, count);
  return points;
}

/// Returns random deformations of a step that has components in the plane (4), those and the hoop (5), or all (9).
std::vector<Matrix3> deformations(int strains, double size, double volume, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> at(-1.0, 1.0);
  std::vector<Matrix3> all(count, Matrix3::Identity());
  for (Matrix3& f : all) {
    for (int k = 0; k < strains; ++k) {
      const auto [row, column] = component(strains, k);
      f(row, column) += size * at(random);
    }
    const double growth = 1.0 + volume * at(random);
    for (int a = 0; a < (strains == 4 ? 2 : 3); ++a) f(a, a) *= growth;
  }
  return all;
}

struct Errors {
  double largest = 0.0;  // of a tangent, over that of the stiffest component
  std::size_t flowing = 0, open = 0, dilating = 0, kinks = 0;
  std::vector<bool> off = std::vector<bool>(count, false);  // points with an error above 1e-4
};

/// Deforms points twice, and compares their tangents in the second step with central differences.
Errors errors_of(const Material& material, int strains, double size, double volume) {
  Particles points = particles_of(material);
  const UpdateSettings settings{
      .time_step = 1.0, .cell_size = 1.0, .linear_viscosity = 0.0, .quadratic_viscosity = 0.0};
  const std::vector<Group> groups = {{&material, 0, count, settings}};
  const auto m = static_cast<std::size_t>(strains);
  std::vector<double> forces(m * count), above = forces, below = forces;
  Response first(points, groups, strains);
  EXPECT_TRUE(first.evaluate(deformations(strains, size, volume, 1), forces));
  static_cast<MaterialPoints&>(points) = first.trial();

  Response response(points, groups, strains);
  const std::vector<Matrix3> f = deformations(strains, size, volume, 2);
  EXPECT_TRUE(response.evaluate(f, forces));
  Errors errors;
  for (std::size_t p = 0; p < count; ++p) {
    errors.flowing += response.trial().plastic_strain[p] > points.plastic_strain[p] ? 1 : 0;
    errors.open += response.trial().void_volume[p] > 0.0 ? 1 : 0;
  }
  if (response.trial().history.find("distension") != nullptr) {
    const std::vector<double>&then = points.history.scalar("distension"),
          &now = response.trial().history.scalar("distension");
    for (std::size_t p = 0; p < count; ++p) errors.dilating += now[p] > then[p] ? 1 : 0;
  }
  std::vector<double> closed(m * m * count, std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(closed_tangents(groups[0], points, response.trial(), f, strains, closed));
  constexpr double step = 1e-6;
  for (int k = 0; k < strains; ++k) {
    const auto [row, column] = component(strains, k);
    std::vector<Matrix3> moved = f;
    for (Matrix3& one : moved) one(row, column) += step;
    static_cast<void>(response.evaluate(moved, above));
    for (Matrix3& one : moved) one(row, column) -= 2.0 * step;
    static_cast<void>(response.evaluate(moved, below));
    for (std::size_t p = 0; p < count; ++p) {
      for (std::size_t i = 0; i < m; ++i) {
        const double stiffness = points.volume[p] * (bulk + 4.0 / 3.0 * shear);
        const double ahead = (above[m * p + i] - forces[m * p + i]) / step,
                     behind = (forces[m * p + i] - below[m * p + i]) / step;
        if (std::abs(ahead - behind) > 2e-3 * stiffness) {  // begins to flow, or to part, between them
          ++errors.kinks;
          continue;
        }
        const double error =
            std::abs(closed[(m * p + i) * m + static_cast<std::size_t>(k)] - 0.5 * (ahead + behind)) /
            stiffness;
        if (!(error <= errors.largest)) errors.largest = error;
        if (error > 1e-4) errors.off[p] = true;
      }
    }
  }
  return errors;
}

TEST(ClosedTangents, AreThoseOfTheUpdate) {
  strength::VonMises hardening;
  hardening.yield_stress = 2e6;
  hardening.hardening_modulus = 1e8;
  strength::VonMises plateau = hardening;
  plateau.maximum_flow_stress = 2.1e6;
  strength::DruckerPrager cone;
  cone.friction_angle = 0.5;
  cone.cohesion = 2e5;
  strength::DruckerPrager capped = cone, dilating = cone;
  capped.maximum_strength = 3e6;
  dilating.dilation_angle = 0.2;
  material::NeoHookean rubber;
  rubber.shear_modulus = shear;
  struct Of {
    std::string name;
    Material material;
    double size, volume, bound;
    bool flows, opens, dilates;
  };
  const auto elastic = solid<strength::ElasticModel>(strength::Elastic{});
  for (const Of& of :
       {Of{"elastic", elastic, 0.1, 0.05, 1e-8, false, false, false},
        Of{"von Mises", solid<strength::VonMisesModel>(hardening), 5e-3, 1e-2, 1e-7, true, false, false},
        Of{"plateau", solid<strength::VonMisesModel>(plateau), 5e-3, 1e-2, 1e-7, true, false, false},
        Of{"cone", solid<strength::DruckerPragerModel>(cone), 5e-3, 5e-3, 1e-2, true, true, false},
        Of{"cone with a cap", solid<strength::DruckerPragerModel>(capped), 5e-3, 5e-3, 1e-2, true, true,
           false},
        Of{"dilating cone", solid<strength::DruckerPragerModel>(dilating), 5e-3, 5e-3, 1e-2, true, true,
           true},
        Of{"neo-Hookean",
           make_material("rubber", hot_solid(),
                         std::make_shared<const material::HyperelasticModel<material::NeoHookean>>(rubber)),
           0.1, 0.05, 1e-8, false, false, false}}) {
    for (const int strains : {4, 5, 9}) {
      const Errors errors = errors_of(of.material, strains, of.size, of.volume);
      std::printf(
          "%s, %d components: largest error %.1e, of %zu points %zu flow, %zu are open, %zu dilate; %zu "
          "kinks\n",
          of.name.c_str(), strains, errors.largest, count, errors.flowing, errors.open, errors.dilating,
          errors.kinks);
      EXPECT_LE(errors.kinks, 20U) << of.name;  // of up to 24,300 numbers
      // A gap that has just closed in tension makes the point stiffer by its share of the volume.
      if (!of.dilates) {
        EXPECT_LE(std::ranges::count(errors.off, true), 1) << of.name;
      }
      EXPECT_LT(errors.largest, of.bound) << of.name << " " << strains;
      EXPECT_EQ(errors.flowing > count / 10, of.flows) << of.name;
      EXPECT_EQ(errors.open > count / 20, of.opens) << of.name;
      EXPECT_EQ(errors.dilating > count / 20, of.dilates) << of.name;
    }
  }
}

}  // namespace tangent_test
}  // namespace whipple::quasi_static
