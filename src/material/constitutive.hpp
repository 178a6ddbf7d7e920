// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
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

/// The law of a material: how stress, temperature and history of a point follow its motion. One virtual call per chunk
/// of points. Around it, update.cpp collects the points, changes their volume, convects their history fields, computes
/// the artificial viscosity, and writes the new state back. A model has no state of its own besides its constants and
/// may be shared by threads. Implementations: `EosStrength` (eos_strength/),
/// `BurnModel`, and those of constitutive_catalogue.cpp.
class Constitutive {
 public:
  virtual ~Constitutive() = default;

  [[nodiscard]] virtual std::string_view model() const = 0;
  /// All constants with units as tables of a material file (provenance in output files).
  [[nodiscard]] virtual std::string constants(const Material& material) const = 0;
  /// The same model for a material whose parts have changed.
  /// @throws InputError if the parts of the material do not go together
  [[nodiscard]] virtual std::shared_ptr<const Constitutive> adapted(const Material& material) const = 0;

  /// Longitudinal sound speed (m/s) of an undisturbed point in a state.
  [[nodiscard]] virtual double sound_speed(const Material& material, const eos::State& state) const = 0;
  /// Sets the history of the points [begin, end) that start from a state; their other fields are set, their history is
  /// neutral.
  virtual void start(const eos::State& /*state*/, MaterialPoints& /*points*/, std::size_t /*begin*/,
                     std::size_t /*end*/) const {}

  /// Fraction of a change of the whole volume that goes to the voids of each point with voids: all of it where the point
  /// has failed, else its porosity.
  virtual void void_share(const Chunk& chunk, Lanes& share) const;
  /// Returns the explosive that burns by this model; null: nothing burns.
  [[nodiscard]] virtual const Explosive* explosive() const { return nullptr; }
  /// Returns the density (kg/m^3) at which the equation of state of point k of a chunk ends.
  [[nodiscard]] virtual double maximum_density(const Material& material, const Chunk& chunk,
                                               std::size_t k) const;
  /// Returns the least of these that a point may have.
  [[nodiscard]] virtual double least_maximum_density(const Material& material) const;
  /// Advances a chunk over the step.
  /// @param in   state at the beginning of the step, motion and settings: read only
  /// @param out  the points after `gather`, with the new volume, density and artificial viscosity, and convected
  ///             history. The model sets deviator, `acting_pressure`, temperature, sound speed and history, and, where
  ///             it has them, plastic strain, phases, failure and voids; reports events and dissipation.
  virtual void update(const Step& in, Chunk& out) const = 0;

  /// A history field and the first of its lanes in `Chunk::history`.
  struct Slot {
    HistoryField field;
    std::size_t lane;
  };
  [[nodiscard]] const std::vector<Slot>& history() const { return history_; }

 protected:
  /// Declares a history field.
  /// @returns the first of its lanes
  /// @throws InternalError if the fields of the model have more components than a chunk has lanes
  std::size_t declare(const HistoryField& field);

 private:
  std::vector<Slot> history_;
  std::size_t lanes_ = 0;
};

}  // namespace material
}  // namespace whipple
