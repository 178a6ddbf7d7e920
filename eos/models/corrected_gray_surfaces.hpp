// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "eos/models/free_energy_spline.hpp"
#include "eos/models/gray_free_energy.hpp"
#include "eos/models/gray_melting_curve.hpp"
#include "src/core/base/parameter_table.hpp"

namespace whipple::eos {

/// Holds one smooth part of a free energy as it is written to a material: grid and coefficients.
struct CorrectionConstants {
  double least_volume_ratio = 0, greatest_volume_ratio = 0;  ///< V/V0
  double temperature = 0;                                    ///< T* of u = T/(T + T*), K
  std::int64_t temperatures = 0;                             ///< functions of the temperature
  std::vector<double> coefficients;                          ///< in units of C^2, temperature fastest

  /// @param prefix  of the names
  static ParameterTable<CorrectionConstants> parameters(const std::string& prefix, const std::string& of);
  /// Returns the grid of material of the given constants. @throws InputError for a torn row of coefficients
  [[nodiscard]] FreeEnergyGrid grid(const GrayConstants& gray) const;
};

/// Holds the constants of GRAY with corrections of its free energies.
struct CorrectedGrayConstants {
  GrayConstants gray;
  CorrectionConstants common;  ///< of both solid and fluid
  CorrectionConstants fluid;   ///< of the fluid in addition

  static ParameterTable<CorrectedGrayConstants> parameters();
};

/// Adds smooth corrections to the free energies of the phases of GRAY (docs/theory/gray.md, section 11): one that solid
/// and fluid have in common, and one of the fluid alone. SI per unit mass; V in m^3/kg, T in K.
class CorrectedGraySurfaces {
 public:
  /// @throws InputError if the constants contradict each other
  explicit CorrectedGraySurfaces(const CorrectedGrayConstants& constants);

  using Constants = CorrectedGrayConstants;
  static constexpr std::string_view name = "gray_corrected";
  static constexpr std::string_view summary =
      "GRAY with smooth corrections of its free energies, fitted to simulations";
  static constexpr double relative_cost = 80.0;
  static constexpr double intended_temperature = 1e5;  ///< K

  [[nodiscard]] const GrayFreeEnergy& gray() const { return gray_; }
  /// Returns the volume of the densest liquid on the melting curve: at the limit of the solid, that in equilibrium with
  /// it.
  [[nodiscard]] static double least_volume(const GrayMeltingCurve& curve) {
    return curve.hottest().liquid_volume;
  }
  [[nodiscard]] static std::vector<double> kinks() { return {}; }
  [[nodiscard]] static double greatest_temperature() { return 1e7; }  ///< K, of the search for a temperature
  [[nodiscard]] GrayPoint solid(double V, double T) const;            ///< V <= V_J, stable or not
  [[nodiscard]] GrayPoint fluid(double V, double T) const;            ///< liquid and vapour
  /// Returns the temperature at which solid and liquid of one volume have equal free energies, V <= V_J.
  /// @throws InputError if there is none near that of GRAY
  [[nodiscard]] double isochoric_melting_temperature(double V) const;
  /// Returns the surfaces for the search of the melting curve; the result refers to this object.
  [[nodiscard]] SolidLiquidSurfaces melting_surfaces() const;

 private:
  [[nodiscard]] GrayPoint liquid(double V, double T) const;  ///< continued beyond V_J

  GrayFreeEnergy gray_;
  FreeEnergySpline common_, fluid_;
};

}  // namespace whipple::eos
