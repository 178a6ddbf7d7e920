// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "src/material/common.hpp"
#include "src/material/constitutive.hpp"
#include "src/material/failure/fragment_size.hpp"
#include "src/material/strength/foam.hpp"

/// Equation of state, strength and failure as one constitutive model (docs/theory/material.md).
namespace whipple::material {

/// Combines equation of state, strength and failure. The update is a list of parts, each a function of the chunk, which
/// is chosen once from the properties of the material.
class EosStrength final : public Constitutive {
 public:
  using Part = void (*)(const EosStrength& model, const Step& in, Chunk& out);

  EosStrength() = default;  ///< without parts, as input of `adapted`
  /// Chooses the parts of the update and declares their history fields.
  explicit EosStrength(const Material& material);

  [[nodiscard]] std::string_view model() const override { return "eos_strength"; }
  [[nodiscard]] std::string constants(const Material& material) const override;
  [[nodiscard]] std::shared_ptr<const Constitutive> adapted(const Material& material) const override;
  [[nodiscard]] double sound_speed(const Material& material, const eos::State& state) const override;
  void start(const eos::State& state, MaterialPoints& points, std::size_t begin,
             std::size_t end) const override;
  [[nodiscard]] double maximum_density(const Material& material, const Chunk& chunk,
                                       std::size_t k) const override;
  [[nodiscard]] double least_maximum_density(const Material& material) const override;
  void void_share(const Chunk& chunk, Lanes& share) const override;
  void update(const Step& in, Chunk& out) const override;

  void divide_energy(const Material& material, const MaterialPoints& points, std::size_t begin,
                     std::span<double> elastic, std::span<double> stored) const override;

  /// Advances the deviator and finds the energy that the equation of state takes. With `finish`, the update of a model
  /// that has a pressure of its own.
  void advance_deviator(const Step& in, Chunk& out) const;
  /// Applies failure and loss of strength at the new pressure; computes the sound speed.
  void finish(const Step& in, Chunk& out) const;

  /// Returns all fields that it may declare.
  static std::vector<HistoryField> fields();

  const strength::Foam* foam = nullptr;              ///< its strength, if that is one of a foam
  const failure::FragmentSize* fragments = nullptr;  ///< of its failure; null: failed points keep no size

  /// First lanes of the history fields; fields that are not declared have a lane that nothing else uses.
  static constexpr std::size_t undeclared = most_history - 1;
  std::size_t damage = undeclared, distension = undeclared, back_stress = undeclared, strain = undeclared,
              stored_cold_work = undeclared, threshold_stress = undeclared, fragment_size = undeclared;

 private:
  using Share = void (*)(const EosStrength& model, const Chunk& chunk, Lanes& share);

  /// The parts of the update, in the order of their sections.
  struct Parts {
    std::vector<Part> deviator, pressure, rest;
  };

  Parts parts_of(const Material& material, Energy energy) const;

  [[nodiscard]] const Parts& parts_for(const Step& in) const {
    return in.energy == Energy::from_grid ? from_grid_ : integrated_;
  }

  bool softens_ = false;            // damage reduces stiffness and strength
  double initial_threshold_ = 0.0;  // of materials with the field, Pa
  Parts from_grid_, integrated_;
  Share share_ = nullptr;  ///< null: that of `Constitutive`
};

}  // namespace whipple::material
