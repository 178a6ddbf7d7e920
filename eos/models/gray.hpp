// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "eos/equation_of_state.hpp"
#include "eos/models/gray_free_energy.hpp"
#include "eos/models/gray_melting_curve.hpp"
#include "eos/vapour_dome.hpp"

namespace whipple::eos {

/// Implements GRAY, a three-phase equation of state of metals (solid, melting band, liquid, hot liquid, vapour)
/// from one Helmholtz free energy; docs/theory/gray.md. Code that needs only the surfaces of the phases (a fit)
/// uses GrayFreeEnergy.
///
/// Explicit policies at the limits:
///  - energy below that of `least_temperature` on its isochore: T is limited to it, the point is counted, E is kept;
///  - c^2 < `least_sound_speed_ratio`^2 C^2 (in the van der Waals loop, where c^2 < 0): c is limited to that value;
///  - equilibrium melting is followed into tension until the liquid reaches V_J; isochores beyond the solid
///  of that last tie line, with less energy than on it, melt isochorically (docs/theory/gray.md, section 3);
///  - density above `maximum_density()` or an energy beyond the model: results are NaN, the point is counted.
class Gray {
 public:
  using Constants = GrayConstants;
  static constexpr std::string_view name = "gray";
  static constexpr std::string_view summary =
      "GRAY three-phase equation of state: solid, melting band, liquid, hot liquid, vapour";
  static constexpr double relative_cost = 2.0;
  static constexpr double least_temperature = 1.0;         ///< K
  static constexpr double least_sound_speed_ratio = 0.01;  ///< of the Hugoniot intercept
  static ParameterTable<Constants> parameters() { return gray_parameters(); }

  /// @throws InputError naming the constants that contradict each other
  explicit Gray(const Constants& constants);
  Gray(const Gray&) = delete;  // the dome refers to the free energy
  Gray& operator=(const Gray&) = delete;

  [[nodiscard]] const Constants& constants() const { return surface_.constants(); }
  [[nodiscard]] const GrayFreeEnergy& free_energy() const { return surface_; }
  [[nodiscard]] const VapourDome& dome() const { return dome_; }
  /// Returns the equilibrium of solid and liquid; none unless melting = "equilibrium".
  [[nodiscard]] const std::optional<GrayMeltingCurve>& melting_curve() const { return melting_curve_; }

  [[nodiscard]] double reference_density() const { return 1.0 / constants().reference_specific_volume; }
  [[nodiscard]] double reference_temperature() const { return constants().reference_temperature; }
  [[nodiscard]] double reference_energy() const { return constants().reference_energy; }
  [[nodiscard]] double maximum_density() const { return 1.0 / least_volume_; }

  /// Returns the density of the solid on the last tie line, where equilibrium melting ends.
  [[nodiscard]] std::vector<double> kinks() const {
    if (!melting_curve_) return {};
    return {1.0 / melting_curve_->coldest().solid_volume};
  }

  /// Returns the energy of the coldest state at a density.
  /// @throws StateError above the compression limit
  [[nodiscard]] double minimum_energy(double density) const {
    return state_at_temperature(density, least_temperature).specific_internal_energy;
  }

  RangeReport evaluate(const Batch& batch) const;
  [[nodiscard]] State state(double density, double specific_internal_energy) const;
  [[nodiscard]] State state_at_temperature(double density, double temperature) const;

  // The same at (V, T) in m^3/kg and K, in the stable phase.
  /// @throws StateError out of range
  [[nodiscard]] double pressure(double V, double T) const {
    return state_at_temperature(1.0 / V, T).pressure;
  }
  [[nodiscard]] double energy(double V, double T) const {
    return state_at_temperature(1.0 / V, T).specific_internal_energy;
  }
  [[nodiscard]] double melting_temperature(double V) const { return surface_.melting_temperature(V); }
  [[nodiscard]] double gamma(double V) const { return surface_.gamma(V); }

 private:
  /// Lists the phases. Isochoric melting occurs in stretched metal in addition to equilibrium melting; it is a
  /// separate phase, because its states do not join those of the melting curve.
  enum class Phase { solid, melting, isochoric_melting, liquid, hot_liquid, vapour, hot_vapour };
  struct Point;
  struct FourPoints;
  /// Holds the edges of the melting region on one isochore.
  struct Edges : GrayBand {
    bool tangent = false;  ///< equilibrium of two volumes between them, not (G31) or (G26); P1, P2 not set
  };
  /// @param above  whether the point is above the lower edge, (T1, E1)
  template <class Above>
  [[nodiscard]] Edges melting_edges(const GrayIsochore& isochore, const Above& above) const;
  [[nodiscard]] FourPoints four_points(Lanes V, Lanes E) const;
  [[nodiscard]] Point point(double V, double E) const;
  /// Evaluates a point with a melting curve, at half the melting temperature and above, V <= V_J.
  [[nodiscard]] Point equilibrium_point(double V, double E) const;
  [[nodiscard]] Point point_at_temperature(double V, double T) const;
  [[nodiscard]] State full_state(const Point& point) const;
  [[nodiscard]] double sound_speed(double squared) const;
  [[nodiscard]] double fluid_melted_fraction(double T) const;

  GrayFreeEnergy surface_;
  VapourDome dome_;
  std::optional<GrayMeltingCurve> melting_curve_;
  double least_volume_;
  double least_squared_sound_speed_;
};

}  // namespace whipple::eos
