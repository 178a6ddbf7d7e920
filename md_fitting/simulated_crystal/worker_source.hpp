// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "eos/models/isochore_source.hpp"
#include "eos/models/simulated_crystal.hpp"
#include "md_fitting/data_set/data_set.hpp"

namespace whipple::md {

/// Provides isochores from a database; missing points are computed by a separate whipple-md process. Points in the
/// database are only read.
class WorkerSource final : public eos::IsochoreSource {
 public:
  /// Runs whipple-md for the lattice, whose point identifies the tables of the potential in the database.
  /// @throws InputError if the potential cannot be used, or if the database contains two different tables of its name
  WorkerSource(const eos::SimulatedConstants& constants, const std::filesystem::path& store);

  [[nodiscard]] double static_volume() const override { return static_volume_; }
  [[nodiscard]] double molar_mass() const override { return molar_mass_; }
  std::vector<eos::SimulatedIsochore> isochores(std::span<const double> volume_ratios) override;

 private:
  [[nodiscard]] std::string plan_of(std::span<const double> volume_ratios) const;
  void compute(std::span<const double> volume_ratios) const;
  /// Finds the isochore if the database contains all its points. @throws StateError if one of them failed or melted
  [[nodiscard]] bool find(const std::vector<PointRecord>& points, double volume_ratio,
                          eos::SimulatedIsochore& isochore) const;
  [[nodiscard]] bool mine(const PointRecord& point) const;

  eos::SimulatedConstants constants_;
  std::filesystem::path store_;
  double static_volume_ = 0.0, molar_mass_ = 0.0;
};

/// Returns the default database of a material: $XDG_CACHE_HOME/whipple/md, or ~/.cache/whipple/md, by element and
/// potential.
/// @throws InputError if neither variable is set
std::filesystem::path default_store(const eos::SimulatedConstants& constants);

/// Creates the source of a crystal from its database, or the default one (`eos::set_isochore_source`).
/// @throws InputError if the database has no absolute path, or as `WorkerSource` does
std::unique_ptr<eos::IsochoreSource> worker_source(const eos::SimulatedConstants& constants);

}  // namespace whipple::md
