// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "src/solver/carriers/carrier.hpp"
#include "src/solver/loads.hpp"

namespace whipple::solver {

/// Carries the bodies of bars: their nodes move with the velocity field of the grid (docs/theory/fem.md, section 6;
/// afemp.md, section 4).
class Trusses : public Carrier {
 public:
  Trusses(State& state, const Loads& loads, std::vector<fem::Bars> bars)
      : Carrier(state), loads_(loads), bars_(std::move(bars)) {}

  /// Returns this rank's bars, with copies of the nodes that it shares with other ranks.
  [[nodiscard]] const std::vector<fem::Bars>& bars() const { return bars_; }

  [[nodiscard]] bool empty() const override { return bars_.empty(); }
  void compute_forces() override;
  void collect() override;
  [[nodiscard]] double critical_time_step() const override;
  std::string advance() override;
  void remove_outside() override;
  void add_totals(Totals& sum) override;
  void add_phases(std::span<PhaseMasses> of_body) const override;
  void add_figures(Figures& figures) const override;
  [[nodiscard]] double largest_speed(const Vector3& frame) override;
  [[nodiscard]] std::size_t bytes() const override;
  [[nodiscard]] double mass_in(const cases::LoadedRegion& region) const override;
  void for_each_point(const std::function<void(const Point& point)>& visit) const override;
  [[nodiscard]] std::string count_text(std::size_t body) const override;
  void keep_share() override;
  void gather() override;
  void share_out() override;
  void save(Contents& contents) const override;
  void show(View& view) const override { view.bars = bars_; }

 private:
  void connect();

  const Loads& loads_;
  std::vector<fem::Bars> bars_;
  std::vector<std::vector<Vector3>> acceleration_;  // of the nodes of each body by loads, in the current step
  double hoop_force_ = 0.0;                         // N, radial, of the hoops of all bodies
  std::size_t first_ = 0;                           // index of their first node in State::transition
};

}  // namespace whipple::solver
