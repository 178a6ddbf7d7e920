// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "eos/equation_of_state.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/parameter_table.hpp"

/// Defines modifiers, which wrap equations of state (docs/theory/equations_of_state.md, "Modifiers").
namespace whipple::eos {

/// Forwards all functions to the modified model; a modifier overrides some of them. `model` and the first lines of
/// `constants` remain those of the modified model, followed by a table for each modifier: together they form the
/// `[eos]` of a material file.
class Modified : public EquationOfState {
 public:
  explicit Modified(std::shared_ptr<const EquationOfState> base) : base_(std::move(base)) {}

  [[nodiscard]] std::string_view model() const override { return base_->model(); }
  [[nodiscard]] double reference_density() const override { return base_->reference_density(); }
  [[nodiscard]] double reference_temperature() const override { return base_->reference_temperature(); }
  [[nodiscard]] double reference_energy() const override { return base_->reference_energy(); }
  [[nodiscard]] bool has_phases() const override { return base_->has_phases(); }
  [[nodiscard]] double relative_cost() const override { return base_->relative_cost(); }
  [[nodiscard]] double maximum_density() const override { return base_->maximum_density(); }
  [[nodiscard]] double minimum_energy(double density) const override {
    return base_->minimum_energy(density);
  }
  [[nodiscard]] double least_temperature() const override { return base_->least_temperature(); }
  [[nodiscard]] const VapourDome* vapour_dome() const override { return base_->vapour_dome(); }
  [[nodiscard]] std::vector<double> kinks() const override { return base_->kinks(); }
  [[nodiscard]] double initial_distension() const override { return base_->initial_distension(); }
  void crush_pressure(std::span<const double> distension, std::span<double> pressure) const override {
    base_->crush_pressure(distension, pressure);
  }

 protected:
  [[nodiscard]] const EquationOfState& base() const { return *base_; }
  [[nodiscard]] const std::shared_ptr<const EquationOfState>& shared_base() const { return base_; }

  template <class M>
  [[nodiscard]] std::string constants_with_table(typename M::Constants values) const {
    return base_->constants() + "\n[[eos.modifier]]\nmodel = \"" + std::string(M::name) + "\"\n" +
           to_toml(whipple::bind(M::parameters(), values));
  }
  /// Returns the surface on which `base()` unloads, wrapped in a modifier of the same kind.
  template <class M>
  [[nodiscard]] std::unique_ptr<EquationOfState> unloading_with(const State& from,
                                                                const typename M::Constants& values) const {
    std::shared_ptr<const EquationOfState> inner = base_->unloading(from);
    if (!inner) return nullptr;
    return std::make_unique<M>(std::move(inner), values);
  }

 private:
  std::shared_ptr<const EquationOfState> base_;
};

/// Size of the scratch arrays of a modifier that passes different densities or energies to the modified model: on
/// the stack, since batches do not allocate.
inline constexpr std::size_t modifier_chunk = 256;
using ModifierScratch = std::array<double, modifier_chunk>;

/// Returns the entries [first, first + size) of a batch.
inline Batch part_of(const Batch& batch, std::size_t first, std::size_t size) {
  const auto part = [&](auto span) { return span.empty() ? span : span.subspan(first, size); };
  return {part(batch.density),
          part(batch.specific_internal_energy),
          part(batch.pressure),
          part(batch.temperature),
          part(batch.sound_speed),
          part(batch.melted_fraction),
          part(batch.vaporised_fraction),
          part(batch.distension)};
}

/// Calls f(part of the batch) for chunks that fit the scratch arrays and merges the reports, with indices of the batch.
template <class Function>
RangeReport in_chunks(const Batch& batch, Function&& f) {
  RangeReport report;
  for (std::size_t first = 0; first < batch.density.size(); first += modifier_chunk) {
    RangeReport of_part = f(part_of(batch, first, std::min(modifier_chunk, batch.density.size() - first)));
    if (of_part.first != RangeReport::none) of_part.first += first;
    report.merge(of_part);
  }
  return report;
}

}  // namespace whipple::eos
