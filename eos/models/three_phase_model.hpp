// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "eos/equation_of_state.hpp"
#include "eos/models/corrected_gray_surfaces.hpp"
#include "eos/models/gray_melting_curve.hpp"
#include "eos/models/wide_gray_surfaces.hpp"
#include "eos/vapour_dome.hpp"

namespace whipple::eos {

/// Implements the phases of GRAY - solid, equilibrium melting, liquid, vapour - for free energies that differ from those
/// of GRAY: corrected ones (docs/theory/gray.md, section 11) and those of a wide range (section 12). A point takes
/// microseconds: runs evaluate it by a table.
///
/// Explicit policies at the limits are those of Gray: too cold points are limited and counted, the sound speed has a
/// least value in the loop of the vapour, states out of range are NaN and counted.
/// @tparam Surfaces  CorrectedGraySurfaces or WideGraySurfaces
template <class Surfaces>
class ThreePhaseModel {
 public:
  using Constants = typename Surfaces::Constants;
  static constexpr std::string_view name = Surfaces::name;
  static constexpr std::string_view summary = Surfaces::summary;
  static constexpr double relative_cost = Surfaces::relative_cost;
  static constexpr double least_temperature = 1.0;                                ///< K
  static constexpr double intended_temperature = Surfaces::intended_temperature;  ///< K
  static constexpr double least_sound_speed_ratio = 0.01;  ///< of the Hugoniot intercept
  static ParameterTable<Constants> parameters() { return Constants::parameters(); }

  /// @throws InputError if the constants contradict each other, or the phases have no equilibrium
  explicit ThreePhaseModel(const Constants& constants);
  ThreePhaseModel(const ThreePhaseModel&) = delete;  // melting curve and dome refer to the surfaces
  ThreePhaseModel& operator=(const ThreePhaseModel&) = delete;

  [[nodiscard]] const Constants& constants() const { return constants_; }
  [[nodiscard]] const Surfaces& surfaces() const { return surfaces_; }
  [[nodiscard]] const GrayMeltingCurve& melting_curve() const { return melting_curve_; }
  [[nodiscard]] const VapourDome& dome() const { return dome_; }

  [[nodiscard]] double reference_density() const { return 1.0 / constants_.gray.reference_specific_volume; }
  [[nodiscard]] double reference_temperature() const { return constants_.gray.reference_temperature; }
  /// Returns E(V0, T0).
  [[nodiscard]] double reference_energy() const { return reference_energy_; }
  [[nodiscard]] double maximum_density() const { return 1.0 / least_volume_; }
  /// Returns the densities of kinks of the surfaces and at the ends of equilibrium melting: of the solid on the last tie
  /// line in tension and, if the model goes beyond it, of the densest liquid on the curve.
  [[nodiscard]] std::vector<double> kinks() const;
  /// Returns the energy of the coldest state at a density. @throws StateError above the compression limit
  [[nodiscard]] double minimum_energy(double density) const {
    return state_at_temperature(density, least_temperature).specific_internal_energy;
  }
  RangeReport evaluate(const Batch& batch) const;
  [[nodiscard]] State state(double density, double specific_internal_energy) const;
  [[nodiscard]] State state_at_temperature(double density, double temperature) const;

 private:
  enum class Phase : std::uint8_t {
    solid,
    melting,
    isochoric_melting,
    liquid,
    hot_liquid,
    vapour,
    hot_vapour
  };
  struct Point;
  struct Edges;
  [[nodiscard]] Point at_energy(double V, double E) const;
  [[nodiscard]] Point at_temperature(double V, double T) const;
  [[nodiscard]] Edges melting_edges(double V) const;
  void fill(Point& point, const GrayPoint& state, Phase phase) const;
  void fill_solid(Point& point, const GrayPoint& state) const { fill(point, state, Phase::solid); }
  void fill_fluid(Point& point, const GrayPoint& state) const;
  void fill_mixture(Point& point) const;
  void fill_isochoric(Point& point, double temperature) const;
  [[nodiscard]] State full_state(const Point& point) const;
  [[nodiscard]] double sound_speed(double squared) const;

  Constants constants_;
  Surfaces surfaces_;
  GrayMeltingCurve melting_curve_;
  VapourDome dome_;
  double least_volume_ = 0, least_squared_sound_speed_ = 0;
  double join_melting_temperature_ = 0, reference_energy_ = 0;
};

extern template class ThreePhaseModel<CorrectedGraySurfaces>;
extern template class ThreePhaseModel<WideGraySurfaces>;
using CorrectedGray = ThreePhaseModel<CorrectedGraySurfaces>;
using WideGray = ThreePhaseModel<WideGraySurfaces>;

}  // namespace whipple::eos
