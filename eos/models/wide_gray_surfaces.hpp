// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <vector>

#include "eos/models/fermi_cold_curve.hpp"
#include "eos/models/gray_free_energy.hpp"
#include "eos/models/gray_melting_curve.hpp"
#include "eos/models/thomas_fermi.hpp"
#include "src/core/base/parameter_table.hpp"

namespace whipple::eos {

/// Holds the constants of GRAY and of its continuation to high density and temperature.
struct WideGrayConstants {
  GrayConstants gray;
  double atomic_number = 0;       ///< Z
  double cold_join_ratio = 0.7;   ///< V/V0 at which the cold curve is continued to that of the electron gas
  double electron_onset = 10000;  ///< K, at which the electrons of GRAY begin to be replaced
  double electron_temperature = 60000;  ///< K, at which they are replaced

  static ParameterTable<WideGrayConstants> parameters();
};

/// Continues the free energies of the phases of GRAY to tenfold compression and to the plasma (docs/theory/gray.md,
/// section 12): F = F_GRAY + w(T) (F_TF - F_el), with the cold curve continued to that of the electron gas, F_TF the
/// thermal electrons of the Thomas-Fermi atom, F_el the electrons of GRAY and w a smooth step from 0 to 1. Below
/// `electron_onset` and above `cold_join_ratio` it is GRAY. SI per unit mass; V in m^3/kg, T in K.
class WideGraySurfaces {
 public:
  using Constants = WideGrayConstants;
  static constexpr std::string_view name = "gray_wide";
  static constexpr std::string_view summary =
      "GRAY continued to terapascals and to plasma, with the electrons of Thomas and Fermi";
  static constexpr double relative_cost = 80.0;
  static constexpr double intended_temperature = 1.2e6;  ///< K: 100 eV

  /// @throws InputError if the constants contradict each other, or a phase is not stable
  explicit WideGraySurfaces(const WideGrayConstants& constants);

  [[nodiscard]] const GrayFreeEnergy& gray() const { return gray_; }
  [[nodiscard]] GrayPoint solid(double V, double T) const;  ///< V <= V_J, stable or not
  [[nodiscard]] GrayPoint fluid(double V, double T) const;  ///< liquid and vapour
  /// Returns the temperature at which solid and liquid of one volume have equal free energies, V <= V_J: that of GRAY,
  /// since the electrons of both are the same.
  [[nodiscard]] double isochoric_melting_temperature(double V) const { return gray_.melting_temperature(V); }
  [[nodiscard]] double least_volume(const GrayMeltingCurve&) const { return least_volume_; }
  /// Returns the density at which the cold curve is continued (its bulk modulus has a kink there).
  [[nodiscard]] std::vector<double> kinks() const { return {1.0 / cold_.join_volume()}; }
  [[nodiscard]] double greatest_temperature() const { return electrons_.greatest_temperature(); }
  /// Returns the surfaces for the search of the melting curve; the result refers to this object.
  [[nodiscard]] SolidLiquidSurfaces melting_surfaces() const;

 private:
  [[nodiscard]] GrayIsochore isochore(double V) const;
  [[nodiscard]] GrayPoint liquid(double V, double T) const;
  /// Replaces the electrons of GRAY, whose free energy is -e2 T^2.
  [[nodiscard]] GrayPoint with_electrons(GrayPoint p, const GrayBranch& electrons, double V, double T) const;
  void check_stability() const;

  WideGrayConstants constants_;
  GrayFreeEnergy gray_;
  ThomasFermiElectrons electrons_;
  double least_volume_;
  FermiColdCurve cold_;
};

}  // namespace whipple::eos
