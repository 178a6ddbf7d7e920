// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/joint/potential_errors.hpp"

#include "md_fitting/fit/discrepancy.hpp"
#include "md_fitting/fit/laws.hpp"

namespace whipple::fit {

using Eigen::Index;
using Eigen::MatrixXd;

void DeviatingRows::add(Index row, double deviation, double where) {
  rows.push_back(row);
  size.push_back(deviation);
  place.push_back(where);
}

void DeviatingRows::finish(const char* name, double length, double spread,
                           std::vector<VarianceComponent>& components) const {
  if (rows.empty()) return;
  const auto count = static_cast<Index>(rows.size());
  MatrixXd covariance = MatrixXd::Zero(count, count);
  add_discrepancy(smooth(size, place, length), rows_from(0, rows.size()), covariance);
  components.push_back(
      {std::string("potential, ") + name, Deviation::potential, 0, rows, std::move(covariance), spread});
}

std::vector<VarianceComponent> potential_deviations(const SolidProblem& problem, const Observations& data,
                                                    const SolidConstants& constants,
                                                    const PotentialErrors& errors) {
  const eos::GrayConstants& gray = constants.gray;
  const double v0 = gray.reference_specific_volume;
  DeviatingRows shock, gruneisen, anharmonic, melting, fusion;
  std::size_t window = 0, isochore = 0, state = 0, melt = 0, latent = 0;
  for (const Datum& datum : problem.data()) {
    switch (datum.kind) {
      case DataKind::volume:
      case DataKind::isotherm:
        break;  // V0 is measured; the isotherm is no datum of GRAY
      case DataKind::shock: {
        const auto [us, up] = SolidProblem::velocities(problem.window()[window++], v0);
        shock.add(datum.begin, errors.shock_velocity * us, up);
        break;
      }
      case DataKind::isochore: {
        const Isochore& curve = data.isochores[isochore];
        const ThermalState& cold = curve.states.front();
        const ThermalState& hot = curve.states[state];
        const double ratio = curve.volume / v0;
        gruneisen.add(datum.begin,
                      errors.gruneisen * gamma(gray, curve.volume) / curve.volume *
                          (hot.energy.value - cold.energy.value),
                      ratio);
        anharmonic.add(datum.begin + 1,
                       errors.anharmonic *
                           (hot.temperature * hot.temperature - cold.temperature * cold.temperature) /
                           (2.0 * data.molar_mass),
                       ratio);
        if (++state == curve.states.size()) {
          ++isochore;
          state = 0;
        }
        break;
      }
      case DataKind::melting: {
        const MeltingPoint& point = data.melting[melt++];
        melting.add(datum.begin, errors.melting * point.temperature.value, point.solid_volume.value / v0);
        break;
      }
      case DataKind::fusion: {
        while (!data.melting[latent].latent_heat) ++latent;
        const MeltingPoint& point = data.melting[latent++];
        fusion.add(datum.begin, errors.fusion * point.latent_heat->value, point.solid_volume.value / v0);
        break;
      }
    }
  }
  std::vector<VarianceComponent> components;
  shock.finish("shock velocity", errors.particle_velocity, errors.spread, components);
  gruneisen.finish("Grueneisen parameter", errors.volume_ratio, errors.spread, components);
  anharmonic.finish("anharmonic heat", errors.volume_ratio, errors.spread, components);
  melting.finish("melting temperature", errors.volume_ratio, errors.spread, components);
  fusion.finish("heat of fusion", errors.volume_ratio, errors.spread, components);
  return components;
}

}  // namespace whipple::fit
