// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "eos/equation_of_state.hpp"
#include "src/material/kinematics.hpp"
#include "src/particles/material_points.hpp"

namespace whipple {

struct Explosive;
struct Material;

namespace material {

struct Chunk;
struct Step;

/// Interface of the constitutive models: computes stress, temperature and history of points from their motion, with one
/// virtual call per chunk of points. update.cpp performs the common parts: it collects the points, changes their
/// volume, convects their history fields, computes the artificial viscosity, and writes the new state back. A model has
/// no state except its constants and may be shared by threads. Implementations: `EosStrength` (eos_strength/),
/// `BurnModel`, and those of constitutive_catalogue.cpp.
class Constitutive {
 public:
  virtual ~Constitutive() = default;

  [[nodiscard]] virtual std::string_view model() const = 0;
  /// Returns all constants with units as tables of a material file (provenance in output files).
  [[nodiscard]] virtual std::string constants(const Material& material) const = 0;
  /// Returns the same model for a material whose parts have changed.
  /// @throws InputError if the parts of the material are incompatible
  [[nodiscard]] virtual std::shared_ptr<const Constitutive> adapted(const Material& material) const = 0;

  /// Returns the longitudinal sound speed (m/s) of an undisturbed point in a state.
  [[nodiscard]] virtual double sound_speed(const Material& material, const eos::State& state) const = 0;
  /// Sets the history of the points [begin, end) in an initial state; their other fields are set, their history has
  /// neutral values.
  virtual void start(const eos::State& /*state*/, MaterialPoints& /*points*/, std::size_t /*begin*/,
                     std::size_t /*end*/) const {}

  /// Computes the fraction of a change of the total volume by which the voids of each point change: 1 if the point has
  /// failed, otherwise its porosity.
  virtual void void_share(const Chunk& chunk, Lanes& share) const;
  /// Returns the explosive that burns by this model; null: nothing burns.
  [[nodiscard]] virtual const Explosive* explosive() const { return nullptr; }
  /// Returns the density (kg/m^3) at which the equation of state of point k of a chunk ends.
  [[nodiscard]] virtual double maximum_density(const Material& material, const Chunk& chunk,
                                               std::size_t k) const;
  /// Returns the least of these that a point may have.
  [[nodiscard]] virtual double least_maximum_density(const Material& material) const;
  /// Advances a chunk over the step.
  /// @param in   state at the beginning of the step, motion and settings; read only
  /// @param out  the points after `gather`, with the new volume, density and artificial viscosity, and convected
  /// history. The model sets deviator, `acting_pressure`, temperature, sound speed and history and, where it has them,
  /// plastic strain, phases, failure and voids; reports events and dissipation.
  virtual void update(const Step& in, Chunk& out) const = 0;

  /// Computes the energies of at most `chunk_size` points from `begin` on that are not heat (J/kg): the elastic energy
  /// of the deviator, and what the history of the material stores (cold work, stress that relaxes). The rest is that of
  /// the equation of state.
  virtual void divide_energy(const Material& material, const MaterialPoints& points, std::size_t begin,
                             std::span<double> elastic, std::span<double> stored) const = 0;

  /// Holds a history field and the index of its first lane in `Chunk::history`.
  struct Slot {
    HistoryField field;
    std::size_t lane;
  };
  [[nodiscard]] const std::vector<Slot>& history() const { return history_; }

 protected:
  /// Declares a history field.
  /// @returns index of its first lane
  /// @throws InternalError if the fields of the model have more components than a chunk has lanes
  std::size_t declare(const HistoryField& field);

 private:
  std::vector<Slot> history_;
  std::size_t lanes_ = 0;
};

}  // namespace material
}  // namespace whipple
