// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <vector>

#include "src/device/cells.hpp"
#include "src/device/contact/stage.hpp"
#include "src/device/engine.hpp"
#include "src/device/gather.hpp"
#include "src/device/nodes.hpp"
#include "src/device/passes.hpp"
#include "src/device/peak.hpp"
#include "src/device/rates.hpp"
#include "src/device/scatter.hpp"
#include "src/device/store.hpp"
#include "src/device/strain.hpp"

namespace whipple::device {

/// Steps the particles with the kernels of a space: HostSpace, or that of a graphics processor. The order of the kernels
/// is that of solver::step_symplectic (docs/theory/mpm.md, 4).
/// @tparam Lattice  SpaceLattice, or SectionLattice in two dimensions
template <class Space, class Lattice>
class Stepper final : public Engine {
 public:
  Stepper(const Problem& problem, const PointsOnHost& points)
      : problem_(problem), cells_(problem), contact_(problem) {
    store_.upload(points);
    upload(initial_density_, problem_.initial_density);
    upload(tables_, problem_.tables);
    upload(field_of_body_, problem_.field_of_body);
    upload(conducting_, problem_.conducting);
    upload(domains_, problem_.domains);
    upload(materials_, problem_.materials);
    reflecting_ = problem_.reflecting_faces();
  }

  Outcome step(const StepInput& input) override {
    const double dt = input.dt;
    outcome_ = {};
    timed(Stage::bins, [&] { bin(input.sorts); });
    if constexpr (Lattice::planar) {
      space_.for_each(store_.points().size, FindSections{store_.points(), lattice().has_rings});
    }
    if (input.looks_at_fill) {
      outcome_.beside_voids = mass_beside_voids(space_, cells_, store_.points(), problem_, reflecting_);
    }
    timed(Stage::conduction, [&] { conduct(dt); });
    timed(Stage::scatter, [&] { scatter(input.acceleration); });
    if constexpr (Lattice::planar) {
      if (lattice().has_rings) {
        outcome_.hoop_impulse =
            -dt * space_.reduce(store_.points().size, SumHoopForce{store_.points()}).sum[0];
      }
    }
    timed(Stage::contact,
          [&] { contact_.find(space_, lattice(), store_.points(), dt, input.least_closing_speed); });
    timed(Stage::grid, [&] { solve_momentum(dt); });
    timed(Stage::contact, [&] {
      contact_.remember(space_, lattice());
      contact_.apply(space_, lattice(), outcome_);
      contact_.meet_images(space_, lattice(), outcome_);
    });
    timed(Stage::grid, [&] { copy_mirrors(dt); });
    timed(Stage::gather, [&] { move(input); });
    timed(Stage::material, [&] {
      if (follows_domains()) {
        space_.for_each(store_.points().size, DeformDomains{store_.points(), domains_.data(), dt});
      }
      strain_all<Space>(space_, store_.points(), problem_.materials, materials_.data(), tables_.data(),
                        {.dt = dt, .time = input.end});
    });
    timed(Stage::material, [&] { hold_back(); });
    timed(Stage::ends, [&] { end_step(); });
    return outcome_;
  }

  void set_frame(const Triple<double>& velocity) override { frame_ = velocity; }
  EndOfStep measure() override {
    store_.clear_results(space_);
    return space_.reduce(store_.points().size, ends());
  }
  std::vector<BodyFigures> figures() override {
    return figures_of_bodies(space_, store_.points(), materials_.data(),
                             static_cast<std::uint32_t>(problem_.field_of_body.size()));
  }
  bool must_divide() override {
    return follows_domains() && any_too_long(space_, store_.points(), domains_.data(), problem_);
  }
  void upload(const PointsOnHost& points) override { store_.upload(points); }
  void download(PointsOnHost& points) override { store_.download(space_, points); }
  double rate_of_most(double total_mass, double share, double least, double largest) override {
    return device::rate_of_most(space_, store_.points(), total_mass, share, least, largest);
  }
  [[nodiscard]] std::size_t size() const override { return store_.points().size; }
  [[nodiscard]] std::size_t slots() const override { return lattice().slots; }
  [[nodiscard]] std::size_t bytes() const override {
    return space_.bytes() + store_.bytes() + cells_.bytes() + contact_.bytes() + brought_.bytes() +
           tables_.bytes();
  }
  [[nodiscard]] std::string device() const override { return space_.name(); }
  Rates rates() override { return measured_rates<Space>(space_); }
  void measure_stages(bool measure) override {
    measures_ = measure;
    times_ = {};
  }
  [[nodiscard]] const std::array<double, stage_count>& stage_times() const override { return times_; }

 private:
  template <class T>
  using Array = typename Space::template Array<T>;
  template <class Work>
  void timed(Stage stage, Work&& of_stage) {
    if (!measures_) return of_stage();
    const auto begin = std::chrono::steady_clock::now();
    of_stage();
    space_.synchronize();
    const std::chrono::duration<double> lasted = std::chrono::steady_clock::now() - begin;
    times_[static_cast<std::size_t>(stage)] += lasted.count();
  }
  template <class T>
  static void upload(Array<T>& to, const std::vector<T>& from) {
    to.reserve(std::max<std::size_t>(from.size(), 1));
    to.upload(from.data(), from.size());
  }

  [[nodiscard]] const Lattice& lattice() const { return cells_.lattice(); }
  [[nodiscard]] EndStep ends() const {
    return {.points = store_.points(),
            .lower = problem_.lower,
            .upper = problem_.upper(),
            .faces = problem_.faces,
            .inertia = problem_.inertia(),
            .frame = frame_};
  }

  /// The order of sums at nodes, and every bit with it, is that of the particles in memory.
  void bin(bool sorts) {
    cells_.bin(space_, store_.points(), field_of_body_.data());
    if (sorts) {
      store_.sort(space_, cells_.order(), problem_.field_of_body.size());
      cells_.bin(space_, store_.points(), field_of_body_.data());
    }
    outcome_.slots = lattice().slots, outcome_.cells = lattice().stencil_cells;
  }

  void conduct(double dt) {
    if (!(problem_.shock_conduction > 0.0)) return;
    constexpr double per_inertia = 4.0;  // of quadratic B-splines, 1/dx^2
    outcome_.conducted_heat = exchange_heat(space_, cells_,
                                            {.points = store_.points(),
                                             .bodies = conducting_.data(),
                                             .cell_size = problem_.cell_size,
                                             .per_rate = per_inertia * dt / problem_.cell_size,
                                             .scale = problem_.shock_conduction,
                                             .onset = problem_.conduction_onset,
                                             .rise = problem_.conduction_rise});
  }

  void scatter(const Triple<double>& acceleration) {
    space_.for_each(cells_.stencils(),
                    SumCells<Lattice>{lattice(), store_.points(), acceleration, cells_.sums()});
    space_.for_each(cells_.nodes(), SumNodes<Lattice>{lattice(), cells_.sums(), lattice().nodes});
    if (reflecting_ == 0) return;
    brought_.reserve(cells_.nodes());
    space_.for_each(cells_.nodes(), Copy<Node>{lattice().nodes, brought_.data()});
  }

  void solve_momentum(double dt) {
    at_mirrors<FoldMirror>(space_, cells_);
    at_mirrors<RestrictToMirror>(space_, cells_);
    space_.for_each(cells_.nodes(), SolveMomentum<Lattice>{.lattice = lattice(),
                                                           .dt = dt,
                                                           .rate = problem_.kappa * dt / problem_.cell_size,
                                                           .role = contact_.roles(),
                                                           .keeps_all_masses = contact_.meets_images()});
  }

  void copy_mirrors(double dt) {
    if (reflecting_ == 0) return;
    at_mirrors<CopyMirror>(space_, cells_, true);
    outcome_.plane_impulse =
        space_.reduce(cells_.nodes(), ImpulseAtMirrors<Lattice>{lattice(), brought_.data(), dt, reflecting_})
            .sum;
    outcome_.wall_heat = contact_.heat_of_images(space_, lattice(), brought_.data());
  }

  void move(const StepInput& input) {
    space_.for_each(store_.points().size, MoveParticles<Lattice>{.lattice = lattice(),
                                                                 .points = store_.points(),
                                                                 .cell_of_ordered = cells_.cell_of_ordered(),
                                                                 .initial_density = initial_density_.data(),
                                                                 .losses = problem_.losses,
                                                                 .acceleration = input.acceleration,
                                                                 .dt = input.dt});
  }

  [[nodiscard]] bool follows_domains() const {
    return std::ranges::any_of(problem_.domains, &DomainsOfBody::deform);
  }
  void hold_back() {
    if (std::ranges::none_of(problem_.domains, &DomainsOfBody::hold)) return;
    outcome_.held_pressures =
        space_
            .reduce(store_.points().size,
                    HoldBackPressure{store_.points(), domains_.data(), problem_.domain_limits})
            .sum[0];
  }

  void end_step() {
    const std::size_t size = store_.points().size;
    const auto bodies = static_cast<std::uint32_t>(problem_.field_of_body.size());
    outcome_.sums = space_.reduce(size, ends());
    constexpr auto squeezed = static_cast<std::size_t>(std::countr_zero(event::squeezed));
    for (std::uint32_t b = 0; b < bodies && outcome_.sums.sum[StepSums::first_event + squeezed] > 0.0; ++b) {
      outcome_.squeezed.push_back(space_.reduce(size, MarkedMass{store_.points(), b, event::squeezed}));
    }
    if (!(outcome_.sums.sum[StepSums::leaving] > 0.0)) return;
    for (std::uint32_t b = 0; b < bodies; ++b) {
      outcome_.outflow.push_back(space_.reduce(size, Outflow{store_.points(), b, problem_.inertia()}));
    }
    store_.remove_leaving(space_);
  }

  Problem problem_;
  Space space_;
  Cells<Space, Lattice> cells_;
  Contact<Space, Lattice> contact_;
  Store<Space> store_;
  Outcome outcome_;
  bool measures_ = false;
  std::array<double, stage_count> times_{};
  Triple<double> frame_{};
  std::uint32_t reflecting_ = 0;  // faces with mirror planes or walls, one bit each
  Array<double> initial_density_, tables_;
  Array<std::uint8_t> field_of_body_;
  Array<ConductingBody> conducting_;
  Array<DomainsOfBody> domains_;
  Array<MaterialConstants> materials_;
  Array<Node> brought_;  // sums of the particles before folding
};

}  // namespace whipple::device
