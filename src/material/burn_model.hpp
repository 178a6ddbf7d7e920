// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "src/material/burn.hpp"
#include "src/material/eos_strength/eos_strength.hpp"

namespace whipple::material {

/// An explosive that burns (docs/theory/burn.md): its burn fraction follows lighting times, compression or a rate law,
/// and its pressure that fraction. Deviator and loss of strength are those of `EosStrength`, for which burnt is vapour.
class BurnModel final : public Constitutive {
 public:
  /// Holds the explosive alone: for `adapted`.
  explicit BurnModel(std::shared_ptr<const BurningExplosive> eos) : eos_(std::move(eos)) {}
  /// @param material  whose equation of state is `eos`
  BurnModel(const Material& material, std::shared_ptr<const BurningExplosive> eos);

  [[nodiscard]] std::string_view model() const override { return "burn"; }
  [[nodiscard]] std::string constants(const Material& material) const override {
    return solid_.constants(material);
  }
  /// Of a material with another equation of state, nothing burns.
  [[nodiscard]] std::shared_ptr<const Constitutive> adapted(const Material& material) const override;
  [[nodiscard]] double sound_speed(const Material& material, const eos::State& state) const override {
    return solid_.sound_speed(material, state);
  }
  void start(const eos::State& state, MaterialPoints& points, std::size_t begin,
             std::size_t end) const override {
    solid_.start(state, points, begin, end);
  }
  void void_share(const Chunk& chunk, Lanes& share) const override { solid_.void_share(chunk, share); }
  [[nodiscard]] const Explosive* explosive() const override { return &eos_->explosive(); }
  [[nodiscard]] double least_maximum_density(const Material& material) const override;
  [[nodiscard]] double maximum_density(const Material& material, const Chunk& chunk,
                                       std::size_t k) const override;
  void divide_energy(const Material& material, const MaterialPoints& points, std::size_t begin,
                     std::span<double> elastic, std::span<double> stored) const override {
    solid_.divide_energy(material, points, begin, elastic, stored);
  }
  void update(const Step& in, Chunk& out) const override;

  /// Fields that it declares besides those of `EosStrength`.
  static std::vector<HistoryField> fields();

 private:
  std::shared_ptr<const BurningExplosive> eos_;
  EosStrength solid_;
  std::size_t burn_fraction_ = 0, lighting_time_ = 0;  ///< lanes
};

}  // namespace whipple::material
