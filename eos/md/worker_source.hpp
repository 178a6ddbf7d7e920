// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "eos/md/isochore_source.hpp"
#include "eos/md/simulated_crystal.hpp"
#include "md_fitting/data_set/data_set.hpp"

namespace whipple::eos {

/// Isochores from a store; what it lacks whipple-md computes as a process of its own. What is in the store
/// costs nothing but its reading.
class WorkerSource final : public IsochoreSource {
 public:
  /// Asks whipple-md for the lattice, by which the potential's tables are recognised in the store.
  /// @throws InputError if the potential cannot be used, or the store holds two different tables of its name
  WorkerSource(const SimulatedConstants& constants, const std::filesystem::path& store);

  [[nodiscard]] double static_volume() const override { return static_volume_; }
  [[nodiscard]] double molar_mass() const override { return molar_mass_; }
  std::vector<SimulatedIsochore> isochores(std::span<const double> volume_ratios) override;

 private:
  [[nodiscard]] std::string plan_of(std::span<const double> volume_ratios) const;
  void compute(std::span<const double> volume_ratios) const;
  /// The isochore if the store has all of it. @throws StateError if one of its points failed or melted
  [[nodiscard]] bool find(const std::vector<md::PointRecord>& points, double volume_ratio,
                          SimulatedIsochore& isochore) const;
  [[nodiscard]] bool mine(const md::PointRecord& point) const;

  SimulatedConstants constants_;
  std::filesystem::path store_;
  double static_volume_ = 0.0, molar_mass_ = 0.0;
};

}  // namespace whipple::eos
