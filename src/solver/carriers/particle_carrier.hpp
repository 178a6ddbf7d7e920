// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "src/solver/carriers/carrier.hpp"

namespace whipple::solver {

/// The particles, `State::particles`. Their forces and their motion are those of the transfers (Transfers).
class ParticleCarrier : public Carrier {
 public:
  using Carrier::Carrier;

  /// Prepares the fields that the case needs of particles that have just been seeded.
  /// @param extent  do they need domains?
  void complete_seeded(bool extent);
  /// Prepares particles of a checkpoint.
  /// @throws InputError if they have no field that the case needs
  void complete_read(bool extent);

  /// Returns the greatest sum of sound speed and velocity component, m/s, of this rank.
  double fastest();
  /// Sorts by body (so that a material is a range), then by block, then by stencil.
  void sort();
  /// Puts all in order after particles came, went or changed their places.
  void reallocated();

  [[nodiscard]] bool empty() const override { return false; }
  void remove_outside() override;
  /// Removes products of explosives below the pressure of the case and counts them as outflow; where the case has one.
  void retire_products();
  void add_totals(Totals& sum) override;
  void add_phases(std::span<PhaseMasses> of_body) const override;
  void add_figures(Figures& figures) const override;
  [[nodiscard]] double largest_speed(const Vector3& frame) override;
  void add_releasable(Releasable& sum) const override;
  [[nodiscard]] std::size_t particle_count() const override { return state_.particles.size(); }
  [[nodiscard]] std::uint64_t largest_particle_id() const override;
  [[nodiscard]] std::size_t bytes() const override;
  void for_each_point(const std::function<void(const Point& point)>& visit) const override;
  void for_each_part(const SelectElement& select,
                     const std::function<void(const Part& part)>& visit) const override;
  [[nodiscard]] std::string count_text(std::size_t body) const override;
  void save(Contents& contents) const override { contents.particles = &state_.particles; }
  void show(View& view) const override { view.particles = &state_.particles; }

 private:
  /// Values of each chunk of particles that are kept from step to step: those of material at rest stay.
  template <class Value>
  struct KeptByChunk {
    std::vector<Value> values;
    std::size_t arrangement = 0;  // of the particles then
  };
  [[nodiscard]] std::vector<std::uint8_t> stays_since(std::size_t& arrangement) const;
  void require_fields(bool extent) const;
  /// Removes particles, numbers ascending, and counts them as outflow.
  void remove_as_outflow(const std::vector<std::uint32_t>& leaving);

  KeptByChunk<Totals> totals_;
  KeptByChunk<double> fastest_;                     // m/s
  KeptByChunk<double> largest_squares_;             // of speeds in the frame below, m^2/s^2
  Vector3 frame_of_speeds_ = Vector3::Zero();       // m/s
  std::vector<std::uint32_t> by_stencil_, sorted_;  // of the last sort; their memory is kept for the next
  SortBuffers sort_buffers_;
};

}  // namespace whipple::solver
