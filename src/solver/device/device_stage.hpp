// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "src/device/engine.hpp"
#include "src/solver/device/device.hpp"
#include "src/solver/stages/contact.hpp"
#include "src/solver/state.hpp"

namespace whipple::solver {

/// Keeps the particles of a run on a device and steps them there. The particles of State are those of the last
/// `synchronize`; totals and bounds of the time step come from the device.
class DeviceStage {
 public:
  /// Copies the particles to the device.
  /// @throws InputError if the program has none of this kind, StateError if there is none
  DeviceStage(State& state, ContactStage& contact, Device device);
  ~DeviceStage();

  /// Performs the present step and books its sums.
  /// @param accurate_step  time step that the state allows, s
  /// @param acceleration   of all particles by loads, m/s^2
  /// @param looks_at_fill  whether to look for material under pressure in cells that it does not fill
  /// @returns its mass at the beginning of the step (kg), 0 if not asked for
  double step(double accurate_step, const Vector3& acceleration, bool looks_at_fill);
  /// Copies the particles to State, unless they are there already.
  void synchronize();
  /// Returns whether particles of fluids must be divided before the step.
  bool must_divide();
  /// Copies the particles of State to the device.
  void upload();

  [[nodiscard]] double fastest() const { return measured_.largest[device::StepSums::speed]; }
  [[nodiscard]] Totals totals() const;
  [[nodiscard]] std::size_t particle_count() const { return engine_->size(); }
  /// Adds what the history shows of the particles.
  void add_phases(std::span<PhaseMasses> of_body);
  void add_figures(Figures& figures);
  /// Returns the largest speed (m/s) in a frame of reference.
  double largest_speed(const Vector3& frame);
  /// Returns the closing rate (1/s) that at most the fraction `share` of the mass exceeds (device/rates.hpp).
  double rate_of_most(double share, double least, double largest);
  [[nodiscard]] device::Engine& engine() { return *engine_; }

 private:
  const std::vector<device::BodyFigures>& figures();
  void book(const device::Outcome& outcome);
  void require_two_fields(const device::Outcome& outcome) const;
  void require_valid(const device::Outcome& outcome);
  [[noreturn]] void fail(double first, const std::string& reason);

  State& state_;
  ContactStage& contact_;
  device::PointsOnHost points_;
  std::unique_ptr<device::Engine> engine_;
  device::EndOfStep measured_;
  Vector3 frame_ = Vector3::Zero();
  std::array<double, device::stage_count> times_{};  // of the stages, s
  std::vector<device::BodyFigures> figures_;         // empty: not those of the present state
  bool is_current_ = true;                           // the particles of State are those of the device
};

}  // namespace whipple::solver
