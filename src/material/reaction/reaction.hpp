// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "src/core/base/parameter_table.hpp"
#include "src/core/base/words.hpp"

/// Rate laws by which an explosive burns to its products (docs/theory/burn.md, section 4).
namespace whipple::reaction {

/// Holds points of an explosive over a step (SI units).
struct State {
  double time_step;                     ///< s
  std::span<const double> compression;  ///< rho/rho0 at the end of the step
  /// Common pressure of reactant and products at the beginning of the step, Pa.
  std::span<const double> pressure;
};

/// Selects the condition that couples reactant and products while a point burns.
enum class Closure : std::uint8_t {
  volume,       ///< both fill the point: their pressures are added with the weights 1 - F and F
  equilibrium,  ///< they share its volume and energy at one pressure and temperature
};
constexpr std::array<Word<Closure>, 2> words(Closure) {
  return {{{Closure::volume, "volume"}, {Closure::equilibrium, "equilibrium"}}};
}

/// Interface of the rate laws: the burnt mass fraction F follows the state of the point, dF/dt = r(F, rho, p).
class Reaction {
 public:
  virtual ~Reaction() = default;

  [[nodiscard]] virtual std::string_view model() const = 0;
  [[nodiscard]] virtual Closure closure() const = 0;
  /// Advances the burn fractions over the step at constant compression and pressure; they do not decrease.
  virtual void advance(const State& state, std::span<double> burnt) const = 0;
  /// Returns all constants with units as lines of a table [reaction].
  [[nodiscard]] virtual std::string constants() const = 0;
};

/// Implements the interface for a law. `Law` has name, parameters(), closure, require_consistent() and advance().
template <class Law>
class ReactionModel final : public Reaction {
 public:
  /// @throws InputError if the constants are inconsistent
  explicit ReactionModel(const Law& law) : law_(law) { law_.require_consistent(); }
  [[nodiscard]] std::string_view model() const override { return Law::name; }
  [[nodiscard]] Closure closure() const override { return law_.closure; }
  void advance(const State& state, std::span<double> burnt) const override { law_.advance(state, burnt); }
  [[nodiscard]] std::string constants() const override {
    Law copy = law_;
    return fmt::format("model = \"{}\"\n{}", Law::name, to_toml(whipple::bind(Law::parameters(), copy)));
  }

 private:
  Law law_;
};

}  // namespace whipple::reaction
