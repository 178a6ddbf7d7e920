// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "md_fitting/data_set/crystal_structure.hpp"
#include "md_fitting/data_set/record.hpp"

/// Records of static crystals.
namespace whipple::md {

/// Static crystal without pressure.
struct LatticePoint {
  Estimate lattice_constant{}, cohesive_energy{}, specific_volume{};

  static constexpr std::string_view protocol = "lattice";
  static constexpr std::array<Quantity<LatticePoint>, 0> conditions() { return {}; }
  static constexpr auto results() {
    using P = LatticePoint;
    return std::array{Quantity<P>{"lattice_constant", "m", "edge of the cubic cell", &P::lattice_constant},
                      Quantity<P>{"cohesive_energy", "J/kg", "energy relative to separate atoms, negative",
                                  &P::cohesive_energy},
                      Quantity<P>{"specific_volume", "m^3/kg", "", &P::specific_volume}};
  }
};

/// Static crystals of the metal's own and of the other structures at a volume.
struct ColdCurvePoint {
  double specific_volume = 0.0, temperature = 0.0;
  double pressure = 0.0, specific_internal_energy = 0.0;  ///< of its own structure
  std::optional<double> fcc_pressure{}, fcc_specific_internal_energy{}, bcc_pressure{},
      bcc_specific_internal_energy{}, hcp_pressure{}, hcp_specific_internal_energy{}, hcp_axial_ratio{};

  /// Members of another structure.
  struct Other {
    CrystalStructure structure;
    std::optional<double> ColdCurvePoint::* pressure;
    std::optional<double> ColdCurvePoint::* specific_internal_energy;
  };
  static constexpr std::array<Other, 3> others() {
    using P = ColdCurvePoint;
    return {{{CrystalStructure::fcc, &P::fcc_pressure, &P::fcc_specific_internal_energy},
             {CrystalStructure::bcc, &P::bcc_pressure, &P::bcc_specific_internal_energy},
             {CrystalStructure::hcp, &P::hcp_pressure, &P::hcp_specific_internal_energy}}};
  }

  static constexpr std::string_view protocol = "cold_curve";
  static constexpr auto conditions() {
    using P = ColdCurvePoint;
    return std::array{Quantity<P>{"specific_volume", "m^3/kg", "", &P::specific_volume},
                      Quantity<P>{"temperature", "K", "0", &P::temperature}};
  }
  static constexpr auto results() {
    using P = ColdCurvePoint;
    return std::array{
        Quantity<P>{"pressure", "Pa", "of the stable structure of the potential", &P::pressure},
        Quantity<P>{"specific_internal_energy", "J/kg", "of the stable structure",
                    &P::specific_internal_energy},
        Quantity<P>{"fcc_pressure", "Pa", "of another structure, where it exists; likewise those below",
                    &P::fcc_pressure},
        Quantity<P>{"fcc_specific_internal_energy", "J/kg", "", &P::fcc_specific_internal_energy},
        Quantity<P>{"bcc_pressure", "Pa", "", &P::bcc_pressure},
        Quantity<P>{"bcc_specific_internal_energy", "J/kg", "", &P::bcc_specific_internal_energy},
        Quantity<P>{"hcp_pressure", "Pa", "", &P::hcp_pressure},
        Quantity<P>{"hcp_specific_internal_energy", "J/kg", "", &P::hcp_specific_internal_energy},
        Quantity<P>{"hcp_axial_ratio", "", "c/a, relaxed", &P::hcp_axial_ratio}};
  }
};

/// Elastic constants of the static crystal at a volume.
struct ElasticPoint {
  double specific_volume = 0.0, temperature = 0.0;
  Estimate c11{}, c12{}, c44{}, bulk_modulus{}, shear_modulus_voigt{}, shear_modulus_reuss{},
      shear_modulus_hill{};
  double pressure = 0.0;

  static constexpr std::string_view protocol = "elastic";
  static constexpr auto conditions() {
    using P = ElasticPoint;
    return std::array{Quantity<P>{"specific_volume", "m^3/kg", "", &P::specific_volume},
                      Quantity<P>{"temperature", "K", "0", &P::temperature}};
  }
  static constexpr auto results() {
    using P = ElasticPoint;
    using enum IfMissing;
    return std::array{
        Quantity<P>{"pressure", "Pa", "", &P::pressure, keep_default},
        Quantity<P>{"c11", "Pa", "elastic constants of the cubic crystal", &P::c11, keep_default},
        Quantity<P>{"c12", "Pa", "", &P::c12, keep_default},
        Quantity<P>{"c44", "Pa", "", &P::c44, keep_default},
        Quantity<P>{"bulk_modulus", "Pa", "", &P::bulk_modulus},
        Quantity<P>{"shear_modulus_voigt", "Pa", "of a polycrystal at uniform strain",
                    &P::shear_modulus_voigt, keep_default},
        Quantity<P>{"shear_modulus_reuss", "Pa", "of a polycrystal at uniform stress",
                    &P::shear_modulus_reuss, keep_default},
        Quantity<P>{"shear_modulus_hill", "Pa", "mean of the two", &P::shear_modulus_hill}};
  }
};

/// Corrections for quantum nuclei at a volume and a temperature, from the vibrations of the static crystal.
struct QuantumPoint {
  double specific_volume = 0.0, temperature = 0.0;
  double quantum_free_energy = 0.0, quantum_energy = 0.0, quantum_heat_capacity = 0.0;
  Estimate quantum_pressure{};
  double zero_point_energy = 0.0;
  Estimate zero_point_pressure{};
  double debye_temperature = 0.0;
  Estimate vibration_gruneisen{};

  static constexpr std::string_view protocol = "quantum";
  static constexpr auto conditions() {
    using P = QuantumPoint;
    return std::array{Quantity<P>{"specific_volume", "m^3/kg", "", &P::specific_volume},
                      Quantity<P>{"temperature", "K", "", &P::temperature}};
  }
  static constexpr auto results() {
    using P = QuantumPoint;
    using enum IfMissing;
    return std::array{
        Quantity<P>{"quantum_free_energy", "J/kg", "quantum less classical; likewise the next three",
                    &P::quantum_free_energy, keep_default},
        Quantity<P>{"quantum_energy", "J/kg", "", &P::quantum_energy, keep_default},
        Quantity<P>{"quantum_heat_capacity", "J/(kg K)", "", &P::quantum_heat_capacity, keep_default},
        Quantity<P>{"quantum_pressure", "Pa", "", &P::quantum_pressure},
        Quantity<P>{"zero_point_energy", "J/kg", "", &P::zero_point_energy, keep_default},
        Quantity<P>{"zero_point_pressure", "Pa", "", &P::zero_point_pressure, keep_default},
        Quantity<P>{"debye_temperature", "K", "from the mean square of the frequencies",
                    &P::debye_temperature},
        Quantity<P>{"vibration_gruneisen", "", "of the mean logarithm of the frequencies",
                    &P::vibration_gruneisen, keep_default}};
  }
};

}  // namespace whipple::md
