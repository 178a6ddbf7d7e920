// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/protocols/elastic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "md_fitting/lammps/units.hpp"
#include "md_fitting/protocols/catalogue.hpp"
#include "md_fitting/protocols/crystal.hpp"
#include "src/core/base/error.hpp"

namespace whipple::md {
namespace {

constexpr std::int64_t cells = 3;  // a perfect crystal has no size effect

using Stress = std::array<double, 6>;  // Pa, tension positive: xx yy zz xy xz yz

/// Holds a crystal that can be strained.
class StrainedCrystal {
 public:
  StrainedCrystal(const Potential& potential, double a)
      : crystal_(potential, a, cells, cells, cells), edge_(a * static_cast<double>(cells)) {
    Lammps& lammps = crystal_.lammps();
    lammps.command("change_box all triclinic");
    for (int i = 1; i <= 6; ++i) lammps.command("variable p{0} equal c_virial[{0}]", i);
    lammps.command(
        "thermo_style custom step pe vol c_virial c_displacement[4] c_virial[1] c_virial[2] c_virial[3] "
        "c_virial[4] c_virial[5] c_virial[6]");
  }
  Stress stress() {
    crystal_.evaluate();
    Stress stress{};
    for (std::size_t i = 0; i < 6; ++i) {
      stress[i] = -metal::bar * crystal_.lammps().variable(fmt::format("p{}", i + 1));
    }
    return stress;
  }
  Stress stretched(double strain) {
    crystal_.lammps().command("change_box all x final 0 {:.17g} remap units box", edge_ * (1.0 + strain));
    const Stress stress = this->stress();
    crystal_.lammps().command("change_box all x final 0 {:.17g} remap units box", edge_);
    return stress;
  }
  Stress sheared(double strain) {
    crystal_.lammps().command("change_box all xy final {:.17g} remap units box", edge_ * strain);
    const Stress stress = this->stress();
    crystal_.lammps().command("change_box all xy final 0 remap units box");
    return stress;
  }
  [[nodiscard]] const std::string& transcript() { return crystal_.lammps().transcript(); }

 private:
  Crystal crystal_;
  double edge_;
};

}  // namespace

Estimate extrapolate_to_zero(std::span<const double> x, std::span<const double> y) {
  const auto n = static_cast<double>(x.size());
  if (x.size() < 3 || x.size() != y.size()) throw InternalError("a line with error needs three points");
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sx += x[i], sy += y[i], sxx += x[i] * x[i], sxy += x[i] * y[i];
  }
  const double determinant = n * sxx - sx * sx;
  const double slope = (n * sxy - sx * sy) / determinant;
  const double value = (sy - slope * sx) / n;
  double squares = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) squares += std::pow(y[i] - value - slope * x[i], 2);
  const double error = std::sqrt(squares / (n - 2.0) * sxx / determinant);
  return {value, std::fmax(error, std::abs(value - y[0]))};
}

ElasticResult measure_elastic(const Potential& potential, double specific_volume, double largest_strain,
                              std::int64_t strains) {
  const double a =
      std::cbrt(metal::volume_per_atom(specific_volume, potential.mass()) * potential.atoms_per_cell());
  StrainedCrystal crystal(potential, a);
  ElasticResult result;
  const Stress rest = crystal.stress();
  result.pressure = -(rest[0] + rest[1] + rest[2]) / 3.0;
  std::vector<double> squares, c11, c12, c44;
  for (std::int64_t i = 1; i <= strains; ++i) {
    const double strain = largest_strain * static_cast<double>(i) / static_cast<double>(strains);
    // The difference between both signs cancels terms of even order in the strain.
    const Stress longer = crystal.stretched(strain);
    const Stress shorter = crystal.stretched(-strain);
    const Stress right = crystal.sheared(strain);
    const Stress left = crystal.sheared(-strain);
    squares.push_back(strain * strain);
    c11.push_back((longer[0] - shorter[0]) / (2.0 * strain));
    c12.push_back(0.5 * (longer[1] + longer[2] - shorter[1] - shorter[2]) / (2.0 * strain));
    c44.push_back((right[3] - left[3]) / (2.0 * strain));
  }
  result.c11 = extrapolate_to_zero(squares, c11);
  result.c12 = extrapolate_to_zero(squares, c12);
  result.c44 = extrapolate_to_zero(squares, c44);

  // Averages over the orientations of a polycrystal (Hill, Proc. Phys. Soc. A 65 (1952) 349).
  const std::array<double, 3> constants = {result.c11.value, result.c12.value, result.c44.value};
  const std::array<double, 3> errors = {result.c11.error, result.c12.error, result.c44.error};
  const auto moduli = [](const std::array<double, 3>& c) {
    const double tetragonal = c[0] - c[1];  // twice the other shear constant of a cubic crystal
    const double voigt = (tetragonal + 3.0 * c[2]) / 5.0;
    const double reuss = 5.0 * tetragonal * c[2] / (4.0 * c[2] + 3.0 * tetragonal);
    return std::array<double, 4>{(c[0] + 2.0 * c[1]) / 3.0, voigt, reuss, 0.5 * (voigt + reuss)};
  };
  const std::array<double, 4> values = moduli(constants);
  std::array<double, 4> variance{};
  for (std::size_t i = 0; i < 3; ++i) {
    std::array<double, 3> moved = constants;
    moved[i] += errors[i];
    const std::array<double, 4> change = moduli(moved);
    for (std::size_t k = 0; k < 4; ++k) variance[k] += std::pow(change[k] - values[k], 2);
  }
  const std::array<Estimate*, 4> targets = {&result.bulk_modulus, &result.shear_modulus_voigt,
                                            &result.shear_modulus_reuss, &result.shear_modulus_hill};
  for (std::size_t k = 0; k < 4; ++k) *targets[k] = {values[k], std::sqrt(variance[k])};
  result.transcript = crystal.transcript();
  return result;
}

void add_elastic(const Plan& plan, TaskList& list) {
  if (!plan.elastic) return;
  const ElasticPlan section = *plan.elastic;
  for (const double ratio : section.volume_ratio) {
    list.require_range(ratio);
    const double volume = ratio * list.potential().static_volume();
    list.add({conditions_of(ElasticPoint{.specific_volume = volume}),
              {{"largest_strain", fmt::format("{}", section.largest_strain)},
               {"strains", std::to_string(section.strains)}},
              {}},
             [&potential = list.potential(), section, volume](std::int64_t, const PointRecord*) {
               const ElasticResult result =
                   measure_elastic(potential, volume, section.largest_strain, section.strains);
               return TaskResult{results_of<ElasticPoint>(result),
                                 result.stable() ? "" : "the crystal is mechanically unstable",
                                 result.transcript};
             });
  }
}

}  // namespace whipple::md
