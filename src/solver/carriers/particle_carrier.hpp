// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "src/solver/carriers/carrier.hpp"

namespace whipple::solver {

/// Carries the particles, `State::particles`. Their forces and motion are computed by the transfers (Transfers).
class ParticleCarrier : public Carrier {
 public:
  using Carrier::Carrier;

  /// Prepares the fields that the case requires in newly created particles.
  /// @param extent  whether domains are required
  void complete_seeded(bool extent);
  /// Prepares the particles of a checkpoint.
  /// @throws InputError if a field that the case requires is missing
  void complete_read(bool extent);

  /// Adds to the particles of another run the fields of motion that its scheme had not: at rest, without stores. Call
  /// before `complete_read`.
  void add_fields_of_motion();

  /// Returns the maximum sum of sound speed and velocity component on this rank, m/s.
  double fastest();
  /// Sorts by body (so that a body is a contiguous range), then by block, then by stencil.
  void sort();
  /// Restores order and ranges after particles were added, removed or moved.
  void reallocated();

  [[nodiscard]] bool empty() const override { return false; }
  void remove_outside() override;
  /// Removes products of explosives below the minimum pressure of the case, if it specifies one, and counts them as
  /// outflow.
  void retire_products();
  void add_totals(Totals& sum) override;
  void add_phases(std::span<PhaseMasses> of_body) const override;
  void add_figures(Figures& figures) const override;
  [[nodiscard]] double largest_speed(const Vector3& frame) override;
  void add_releasable(Releasable& sum) const override;
  [[nodiscard]] std::size_t particle_count() const override;
  [[nodiscard]] std::uint64_t largest_particle_id() const override;
  [[nodiscard]] std::size_t bytes() const override;
  [[nodiscard]] double mass_in(const cases::LoadedRegion& region) const override;
  void for_each_point(const std::function<void(const Point& point)>& visit) const override;
  void for_each_part(const SelectElement& select,
                     const std::function<void(const Part& part)>& visit) const override;
  [[nodiscard]] std::string count_text(std::size_t body) const override;
  void save(Contents& contents) const override { contents.particles = &state_.particles; }
  void show(View& view) const override { view.particles = &state_.particles; }

 private:
  /// Holds values of each chunk of particles from step to step; those of inactive chunks remain valid.
  template <class Value>
  struct KeptByChunk {
    std::vector<Value> values;
    std::size_t arrangement = 0;  // of the particles at that time
  };
  [[nodiscard]] std::vector<std::uint8_t> stays_since(std::size_t& arrangement) const;
  void require_fields(bool extent) const;
  /// Removes particles (ascending) and counts them as outflow.
  void remove_as_outflow(const std::vector<std::uint32_t>& leaving);

  KeptByChunk<Totals> totals_;
  KeptByChunk<double> fastest_;                     // m/s
  KeptByChunk<double> largest_squares_;             // of speeds in the frame below, m^2/s^2
  Vector3 frame_of_speeds_ = Vector3::Zero();       // m/s
  std::vector<std::uint32_t> by_stencil_, sorted_;  // of the last sort; the memory is reused
  SortBuffers sort_buffers_;
};

}  // namespace whipple::solver
