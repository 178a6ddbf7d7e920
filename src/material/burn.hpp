// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "eos/equation_of_state.hpp"
#include "src/core/base/words.hpp"
#include "src/material/reaction/reaction.hpp"

/// Programmed burn of explosives (docs/theory/burn.md).
namespace whipple {

/// What raises the burn fraction of a point.
enum class BurnMode : std::uint8_t {
  both,    ///< the time since its lighting, or its compression as soon as the front is two cells away
  time,    ///< the time since its lighting
  volume,  ///< its compression, wherever it is; the time near the detonators only
};
constexpr std::array<Word<BurnMode>, 3> words(BurnMode) {
  return {{{BurnMode::both, "both"}, {BurnMode::time, "time"}, {BurnMode::volume, "volume"}}};
}

/// What an update needs to know of the burn of a case.
struct BurnSettings {
  BurnMode mode = BurnMode::both;
  double width = 0.0;  ///< m, over which a detonation front burns
  double early = 0.0;  ///< m, ahead of the front, from where on compression counts in mode "both"
};

/// An explosive: equations of state of what it is and of what it becomes, and the detonation between (SI).
/// The energy of the products counts from their own zero, that of the unreacted explosive from the explosive
/// at rest: it then holds `stored_energy` besides.
struct Explosive {
  std::shared_ptr<const eos::EquationOfState> products, unreacted;  ///< never null
  std::shared_ptr<const reaction::Reaction>
      reaction;                ///< by which it burns from pressure; null: by detonation alone
  bool estimated = false;      ///< `unreacted` was estimated from the detonation velocity
  double density = 0.0;        ///< kg/m^3, at rest
  double stored_energy = 0.0;  ///< Q, J/kg, that the explosive at rest holds above the zero of the products
  double detonation_velocity =
      0.0;  ///< D, m/s, of the Chapman-Jouguet state of the products, or what replaces it
  double chapman_jouguet_volume = 0.0;    ///< specific volume over that at rest
  double chapman_jouguet_pressure = 0.0;  ///< Pa
};

/// Puts an explosive together and finds its Chapman-Jouguet state.
/// @param unreacted  null: Mie-Grueneisen with c0 = 0.35 D, slope 1.8, Grueneisen parameter 0.7
/// @param reaction   null: none; takes `unreacted`
/// @throws InputError if the products cannot detonate, have phases or pores, if the unreacted explosive has
///         them or no state of zero pressure, or if the two differ in the density at rest by more than a
///         thousandth
std::shared_ptr<const Explosive> make_explosive(std::shared_ptr<const eos::EquationOfState> products,
                                                std::shared_ptr<const eos::EquationOfState> unreacted,
                                                std::shared_ptr<const reaction::Reaction> reaction = nullptr);

/// Equation of state of an explosive that burns, with the burn fraction F of each point:
///   p = (1 - F) p_u(rho, e - Q) + F p_p(rho, e),  T alike,  c^2 = (1 - F) c_u^2 + F c_p^2,
/// or, with a rate law that says so, both at one pressure and temperature (eos/mixture_of_two.hpp). F changes
/// the pressure, never the energy. Whoever does not know F sees the unreacted explosive. Burnt is vapour, as
/// far as phases are concerned.
class BurningExplosive final : public eos::EquationOfState {
 public:
  explicit BurningExplosive(std::shared_ptr<const Explosive> explosive);
  [[nodiscard]] const Explosive& explosive() const { return *explosive_; }
  [[nodiscard]] const std::shared_ptr<const Explosive>& shared_explosive() const { return explosive_; }

  /// Evaluates points that have burnt so far.
  /// @param burnt  F of each point
  eos::RangeReport evaluate(const eos::Batch& batch, std::span<const double> burnt) const;
  /// The same with the work of the pressure (EquationOfState::integrate), of at most 256 points.
  eos::RangeReport integrate(const eos::Batch& batch, std::span<double> energy,
                             std::span<const double> half_change, std::span<const double> burnt) const;

  [[nodiscard]] std::string_view model() const override { return "burning_explosive"; }
  [[nodiscard]] double reference_density() const override { return explosive_->density; }
  [[nodiscard]] double reference_temperature() const override {
    return explosive_->unreacted->reference_temperature();
  }
  [[nodiscard]] double reference_energy() const override {
    return explosive_->unreacted->reference_energy() + explosive_->stored_energy;
  }
  [[nodiscard]] bool has_phases() const override { return true; }
  [[nodiscard]] double relative_cost() const override { return in_equilibrium_ ? 3.0 : 1.2; }
  [[nodiscard]] double maximum_density() const override { return explosive_->unreacted->maximum_density(); }
  [[nodiscard]] double minimum_energy(double density) const override {
    return explosive_->unreacted->minimum_energy(density) + explosive_->stored_energy;
  }
  [[nodiscard]] double least_temperature() const override {
    return explosive_->unreacted->least_temperature();
  }
  using eos::EquationOfState::integrate;
  eos::RangeReport evaluate(const eos::Batch& batch) const override;
  [[nodiscard]] eos::State state(double density, double specific_internal_energy) const override;
  [[nodiscard]] eos::State state_at_temperature(double density, double temperature) const override;
  [[nodiscard]] std::string constants() const override { return explosive_->products->constants(); }

 private:
  [[nodiscard]] eos::State with_store(eos::State state) const;
  /// Of at most 256 points.
  eos::RangeReport evaluate_at_one_volume(const eos::Batch& batch, std::span<const double> burnt) const;
  eos::RangeReport evaluate_in_equilibrium(const eos::Batch& batch, std::span<const double> burnt) const;

  std::shared_ptr<const Explosive> explosive_;
  bool in_equilibrium_;  ///< reactant and products, while they burn
};

}  // namespace whipple
