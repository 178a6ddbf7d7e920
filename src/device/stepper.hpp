// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <utility>

#include "src/core/base/error.hpp"
#include "src/device/bins.hpp"
#include "src/device/conduction.hpp"
#include "src/device/contact/apply.hpp"
#include "src/device/contact/nodes.hpp"
#include "src/device/contact/sums.hpp"
#include "src/device/contact/surfaces.hpp"
#include "src/device/engine.hpp"
#include "src/device/gather.hpp"
#include "src/device/nodes.hpp"
#include "src/device/peak.hpp"
#include "src/device/rates.hpp"
#include "src/device/scatter.hpp"
#include "src/device/strain.hpp"

namespace whipple::device {

/// Steps the particles with the kernels of a space: HostSpace, or that of a graphics processor. The order of the kernels
/// is that of solver::step_symplectic (docs/theory/mpm.md, 4).
template <class Space>
class Stepper final : public Engine {
 public:
  Stepper(const Problem& problem, const PointsOnHost& points) : problem_(problem) {
    inform();
    upload(points);
  }

  Outcome step(double dt, double end, double least_closing_speed) override {
    outcome_ = {};
    least_closing_speed_ = least_closing_speed;
    timed(Stage::bins, [&] { bin(); });
    timed(Stage::conduction, [&] { conduct(dt); });
    timed(Stage::scatter, [&] { scatter(); });
    timed(Stage::contact, [&] { find_contact(dt); });
    timed(Stage::grid, [&] { solve_momentum(dt); });
    timed(Stage::contact, [&] { apply_contact(); });
    timed(Stage::grid, [&] { copy_mirrors(dt); });
    timed(Stage::gather, [&] {
      space_.for_each(points_.size, MoveParticles{.lattice = lattice_,
                                                  .points = points_,
                                                  .cell_of_ordered = cell_of_ordered_.data(),
                                                  .initial_density = initial_density_.data(),
                                                  .losses = problem_.losses,
                                                  .dt = dt});
    });
    timed(Stage::material, [&] { strain(dt, end); });
    timed(Stage::ends, [&] { end_step(); });
    return outcome_;
  }

  void set_frame(const Triple<double>& velocity) override { frame_ = velocity; }
  EndOfStep measure() override {
    for (std::uint32_t c = work; c < all_components; ++c) {
      space_.for_each(points_.size, Fill<double>{points_.numbers + c * points_.stride, 0.0});
    }
    return space_.reduce(points_.size, ends());
  }

  void download(PointsOnHost& points) override;
  double rate_of_most(double total_mass, double share, double least, double largest) override {
    return device::rate_of_most(space_, points_, total_mass, share, least, largest);
  }
  [[nodiscard]] std::size_t size() const override { return points_.size; }
  [[nodiscard]] std::size_t bytes() const override;
  [[nodiscard]] std::size_t slots() const override { return lattice_.slots; }
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
  static constexpr int sort_every = 20;  ///< steps; particles move less than a cell in them

  template <class Work>
  void timed(Stage stage, Work&& of_stage) {
    if (!measures_) return of_stage();
    const auto begin = std::chrono::steady_clock::now();
    of_stage();
    space_.synchronize();
    times_[static_cast<std::size_t>(stage)] +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
  template <class T>
  static void upload(Array<T>& to, const std::vector<T>& from) {
    to.reserve(std::max<std::size_t>(from.size(), 1));
    to.upload(from.data(), from.size());
  }

  void inform();
  void upload(const PointsOnHost& points);
  void bin();
  void find_cells();
  void rearrange(const std::uint32_t* order, std::size_t size);
  void conduct(double dt);
  void scatter();
  void find_contact(double dt);
  void solve_momentum(double dt);
  void apply_contact();
  void copy_mirrors(double dt);
  void strain(double dt, double end);
  void end_step();
  void remove_leaving();
  template <class Kernel>
  void at_mirrors(bool reverse = false) {
    for (int n = 0; n < 6; ++n) {
      const int face = reverse ? 5 - n : n;
      if (!lattice_.mirrors[static_cast<std::size_t>(face)].active) continue;
      space_.for_each(node_count(), Kernel{lattice_, plane_of(lattice_, face)});
    }
  }
  [[nodiscard]] std::size_t node_count() const { return std::size_t{lattice_.slots} * block_nodes; }
  [[nodiscard]] bool has_mirrors() const {
    return std::ranges::any_of(lattice_.mirrors, [](const Mirror& m) { return m.active; });
  }
  [[nodiscard]] EndStep ends() const {
    const auto upper = [this](double from, std::size_t a) {
      return from + problem_.cells[a] * problem_.cell_size;
    };
    return {.points = points_,
            .lower = problem_.lower,
            .upper = {upper(problem_.lower.x, 0), upper(problem_.lower.y, 1), upper(problem_.lower.z, 2)},
            .faces = problem_.faces,
            .inertia = problem_.inertia(),
            .frame = frame_};
  }

  Problem problem_;
  Space space_;
  Outcome outcome_;
  bool measures_ = false;
  std::array<double, stage_count> times_{};
  int steps_to_sort_ = 0;
  Triple<double> frame_{};

  Points points_;
  Array<double> numbers_, spare_;
  Array<std::uint32_t> body_, origin_, spare_indices_;
  Array<double> initial_density_, tables_;
  Array<std::uint8_t> field_of_body_;
  Array<ConductingBody> conducting_;
  Array<MaterialConstants> materials_;

  Lattice lattice_;
  Array<std::uint32_t> keys_, order_, reached_, before_, block_of_slot_, cell_begin_, cell_of_ordered_,
      first_;
  Array<std::int32_t> slot_of_block_, cell_at_node_, nodes_of_cell_;
  Array<Node> nodes_, brought_, cell_sums_;

  double least_closing_speed_ = 0.0;  ///< of contacts that limit the time step, m/s
  ContactSurfaces surfaces_{};
  Array<ContactRole> role_;
  Array<std::uint32_t> flags_;
  Array<ContactPair> pairs_;
  Array<VolumeGradient> gradients_;
  Array<CandidateNormals> normals_;
  Array<Extents> extents_;
  Array<ContactBalance> balances_;
  Array<Approach> approaches_;
  Array<DecidingApproaches> deciding_;
};

template <class Space>
void Stepper<Space>::inform() {
  upload(initial_density_, problem_.initial_density);
  upload(tables_, problem_.tables);
  upload(field_of_body_, problem_.field_of_body);
  upload(conducting_, problem_.conducting);
  upload(materials_, problem_.materials);
  lattice_.cell_size = problem_.cell_size;
  lattice_.lower = problem_.lower;
  lattice_.cells = problem_.cells;
  for (std::size_t a = 0; a < 3; ++a) {
    lattice_.blocks[a] = (problem_.cells[a] + block_edge - 1) / block_edge + 2;
  }
  lattice_.mirrors = problem_.mirrors;
  lattice_.slope_smoothing = problem_.slope_smoothing;
  lattice_.fields = problem_.fields;
  const double places = static_cast<double>(lattice_.blocks_of_field()) * problem_.fields * block_nodes;
  if (places >= 4294967296.0) throw StateError("the domain has too many cells for the device");
  const std::size_t blocks = std::size_t{lattice_.blocks_of_field()} * problem_.fields;
  reached_.reserve(blocks);
  slot_of_block_.reserve(blocks);
}

template <class Space>
void Stepper<Space>::upload(const PointsOnHost& points) {
  const std::size_t n = points.size();
  points_ = {.stride = n, .size = n};
  numbers_.reserve(all_components * n);
  points_.numbers = numbers_.data();
  for (std::size_t c = 0; c < state_components; ++c) {
    numbers_.upload(points.numbers[c].data(), n, c * n);
  }
  upload(body_, points.body);
  std::vector<std::uint32_t> origin(n);
  for (std::size_t p = 0; p < n; ++p) origin[p] = static_cast<std::uint32_t>(p);
  upload(origin_, origin);
  points_.body = body_.data();
  points_.origin = origin_.data();
  for (Array<std::uint32_t>* of : {&keys_, &order_, &first_, &cell_of_ordered_, &spare_indices_})
    of->reserve(n);
  spare_.reserve(n);
}

template <class Space>
void Stepper<Space>::download(PointsOnHost& points) {
  const std::size_t n = points_.size;
  std::vector<std::uint32_t> origin(n), body(n);
  origin_.download(origin.data(), n);
  body_.download(body.data(), n);
  std::vector<std::uint32_t> place(n);  // of each particle, by its origin
  {
    std::vector<std::uint32_t> at(n == 0 ? 0 : *std::ranges::max_element(origin) + std::size_t{1}, 0);
    for (const std::uint32_t o : origin) at[o] = 1;
    std::uint32_t next = 0;
    for (std::uint32_t& flag : at) flag = flag != 0 ? next++ : 0;
    for (std::size_t p = 0; p < n; ++p) place[p] = at[origin[p]];
  }
  points.body.resize(n);
  points.origin.resize(n);
  for (std::size_t p = 0; p < n; ++p) {
    points.body[place[p]] = body[p];
    points.origin[place[p]] = origin[p];
  }
  std::vector<double> column(n);
  for (std::size_t c = 0; c < state_components; ++c) {
    numbers_.download(column.data(), n, c * points_.stride);
    points.numbers[c].resize(n);
    for (std::size_t p = 0; p < n; ++p) points.numbers[c][place[p]] = column[p];
  }
  origin_.upload(place.data(), n);
}

template <class Space>
std::size_t Stepper<Space>::bytes() const {
  const auto sum = [](const auto&... arrays) { return (arrays.bytes() + ...); };
  return sum(numbers_, spare_, body_, origin_, spare_indices_, tables_, keys_, order_, reached_, before_,
             block_of_slot_, cell_begin_, cell_of_ordered_, first_, slot_of_block_, cell_at_node_,
             nodes_of_cell_, nodes_, brought_, cell_sums_, role_, flags_, pairs_, gradients_, normals_,
             extents_, balances_, approaches_, deciding_);
}

/// Assigns the particles to blocks and cells at their present positions.
template <class Space>
void Stepper<Space>::bin() {
  const std::size_t n = points_.size, blocks = std::size_t{lattice_.blocks_of_field()} * lattice_.fields;
  before_.reserve(std::max(blocks, n));
  space_.for_each(blocks, Fill<std::uint32_t>{reached_.data(), 0});
  space_.for_each(
      n, FindPlaces{lattice_, points_, field_of_body_.data(), keys_.data(), order_.data(), reached_.data()});
  lattice_.slots = space_.scan(reached_.data(), before_.data(), blocks);
  block_of_slot_.reserve(lattice_.slots);
  space_.for_each(blocks,
                  NumberSlots{reached_.data(), before_.data(), slot_of_block_.data(), block_of_slot_.data()});
  lattice_.slot_of_block = slot_of_block_.data();
  lattice_.block_of_slot = block_of_slot_.data();
  space_.sort(keys_, order_, n, static_cast<unsigned>(std::bit_width(blocks * block_nodes - 1)));
  if (steps_to_sort_-- <= 0) {
    rearrange(order_.data(), n);
    space_.for_each(n, Iota{order_.data()});
    steps_to_sort_ = sort_every - 1;
  }
  find_cells();
}

template <class Space>
void Stepper<Space>::find_cells() {
  const std::size_t n = points_.size, nodes = node_count();
  nodes_.reserve(nodes);
  cell_at_node_.reserve(nodes);
  space_.for_each(n, FlagCells{keys_.data(), first_.data()});
  const std::uint32_t cells = space_.scan(first_.data(), before_.data(), n);
  cell_begin_.reserve(cells + std::size_t{1});
  nodes_of_cell_.reserve(std::size_t{cells} * stencil_nodes);
  cell_sums_.reserve(std::size_t{cells} * stencil_nodes);
  space_.for_each(nodes, Fill<std::int32_t>{cell_at_node_.data(), nowhere});
  lattice_.stencil_cells = cells;
  lattice_.nodes = nodes_.data();
  lattice_.cell_at_node = cell_at_node_.data();
  lattice_.cell_begin = cell_begin_.data();
  lattice_.nodes_of_cell = nodes_of_cell_.data();
  lattice_.order = order_.data();
  space_.for_each(n, NumberCells{lattice_, keys_.data(), first_.data(), before_.data(), cell_begin_.data(),
                                 cell_at_node_.data(), cell_of_ordered_.data()});
  space_.for_each(1, Fill<std::uint32_t>{cell_begin_.data() + cells, static_cast<std::uint32_t>(n)});
  space_.for_each(std::size_t{cells} * stencil_nodes,
                  ListNodes{lattice_, keys_.data(), nodes_of_cell_.data()});
  outcome_.slots = lattice_.slots;
  outcome_.cells = cells;
}

/// Sorts the particles in memory: those at positions of the order become the first `size`.
template <class Space>
void Stepper<Space>::rearrange(const std::uint32_t* order, std::size_t size) {
  for (std::size_t c = 0; c < state_components; ++c) {
    double* const column = points_.numbers + c * points_.stride;
    space_.for_each(size, Gather<double>{column, order, spare_.data()});
    space_.for_each(size, Copy<double>{spare_.data(), column});
  }
  for (std::uint32_t* of : {points_.body, points_.origin}) {
    space_.for_each(size, Gather<std::uint32_t>{of, order, spare_indices_.data()});
    space_.for_each(size, Copy<std::uint32_t>{spare_indices_.data(), of});
  }
}

template <class Space>
void Stepper<Space>::conduct(double dt) {
  if (!(problem_.shock_conduction > 0.0)) return;
  constexpr double per_inertia = 4.0;  // of quadratic B-splines, 1/dx^2
  const Exchange exchange = {.points = points_,
                             .bodies = conducting_.data(),
                             .cell_size = problem_.cell_size,
                             .per_rate = per_inertia * dt / problem_.cell_size,
                             .scale = problem_.shock_conduction,
                             .onset = problem_.conduction_onset,
                             .rise = problem_.conduction_rise};
  if (!(space_.reduce(points_.size, AnyConducts{exchange}).largest[0] > 0.0)) return;
  space_.for_each(std::size_t{lattice_.stencil_cells} * stencil_nodes,
                  SumCapacity{lattice_, exchange, cell_sums_.data()});
  space_.for_each(node_count(), SumNodes{lattice_, cell_sums_.data(), nodes_.data()});
  at_mirrors<FoldCapacity>();
  space_.for_each(node_count(), ShareOfNode{nodes_.data()});
  at_mirrors<CopyShares>(true);
  outcome_.conducted_heat =
      space_.reduce(points_.size, ExchangeHeat{lattice_, exchange, cell_of_ordered_.data()}).sum[0];
}

template <class Space>
void Stepper<Space>::scatter() {
  space_.for_each(std::size_t{lattice_.stencil_cells} * stencil_nodes,
                  SumCells{lattice_, points_, cell_sums_.data()});
  space_.for_each(node_count(), SumNodes{lattice_, cell_sums_.data(), nodes_.data()});
  if (!has_mirrors()) return;
  brought_.reserve(node_count());
  space_.for_each(node_count(), Copy<Node>{nodes_.data(), brought_.data()});
}

template <class Space>
void Stepper<Space>::solve_momentum(double dt) {
  at_mirrors<FoldMirror>();
  at_mirrors<RestrictToMirror>();
  space_.for_each(node_count(), SolveMomentum{lattice_, dt, problem_.kappa * dt / problem_.cell_size,
                                              problem_.fields < 2 ? nullptr : role_.data()});
}

/// Finds the pairs of nodes at which two fields meet, and the surfaces of the material there, from the sums of particles.
template <class Space>
void Stepper<Space>::find_contact(double dt) {
  if (problem_.fields < 2) return;
  const std::size_t nodes = node_count();
  role_.reserve(nodes);
  flags_.reserve(nodes);
  before_.reserve(nodes);
  space_.for_each(nodes, FindContactRoles{lattice_, role_.data()});
  space_.for_each(nodes, FlagFirstOfPair{role_.data(), flags_.data()});
  const std::uint32_t pairs = space_.scan(flags_.data(), before_.data(), nodes);
  problem_.contact.dt = dt;
  surfaces_.count = pairs;
  if (pairs == 0) return;
  pairs_.reserve(pairs);
  normals_.reserve(pairs);
  gradients_.reserve(std::size_t{2} * pairs);
  extents_.reserve(std::size_t{2} * pairs);
  balances_.reserve(pairs);
  approaches_.reserve(pairs);
  surfaces_ = {.pairs = pairs_.data(),
               .count = pairs,
               .gradients = gradients_.data(),
               .normals = normals_.data(),
               .extents = extents_.data()};
  space_.for_each(nodes, ListContactPairs{lattice_, role_.data(), before_.data(), pairs_.data()});
  space_.for_each(std::size_t{2} * pairs, SumVolumeGradients{lattice_, points_, surfaces_});
  space_.for_each(pairs, ChooseNormals{lattice_, problem_.contact, surfaces_});
  space_.for_each(std::size_t{2} * pairs, FindExtents{lattice_, points_, surfaces_});
}

template <class Space>
void Stepper<Space>::apply_contact() {
  const std::size_t pairs = surfaces_.count;
  if (problem_.fields < 2 || pairs == 0) return;
  space_.for_each(pairs,
                  ApplyContact{lattice_, problem_.contact, surfaces_, balances_.data(), approaches_.data()});
  outcome_.contact = space_.reduce(pairs, SumBalances{balances_.data()}).sum;
  if (outcome_.contact[4] > 0.0) {
    throw StateError(
        "more than two bodies meet at a node: a device computes contact of two velocity fields (--device cpu "
        "computes any number; contact_group joins bodies in one field)");
  }
  const auto of_fields = static_cast<std::uint32_t>(pairs_of_fields(problem_.fields));
  const FindDecidingApproaches find = {.approach = approaches_.data(),
                                       .count = pairs,
                                       .pairs = of_fields,
                                       .dt = problem_.contact.dt,
                                       .least_speed = least_closing_speed_,
                                       .deciding = nullptr};
  const std::size_t found =
      (pairs + FindDecidingApproaches::chunk - 1) / FindDecidingApproaches::chunk * of_fields;
  deciding_.reserve(found);
  FindDecidingApproaches into = find;
  into.deciding = deciding_.data();
  space_.for_each(found, into);
  std::vector<DecidingApproaches> parts(found);
  deciding_.download(parts.data(), found);
  outcome_.approaches.assign(parts.begin(), parts.begin() + of_fields);
  for (std::size_t i = of_fields; i < found; ++i) find.combine(outcome_.approaches[i % of_fields], parts[i]);
}

template <class Space>
void Stepper<Space>::copy_mirrors(double dt) {
  if (!has_mirrors()) return;
  at_mirrors<CopyMirror>(true);
  outcome_.plane_impulse = space_.reduce(node_count(), ImpulseAtMirrors{lattice_, brought_.data(), dt}).sum;
}

template <class Space>
void Stepper<Space>::strain(double dt, double end) {
  strain_all<Space>(space_, points_, problem_.materials, materials_.data(), tables_.data(),
                    {.dt = dt, .time = end});
}

template <class Space>
void Stepper<Space>::end_step() {
  outcome_.sums = space_.reduce(points_.size, ends());
  constexpr auto squeezed = static_cast<std::size_t>(std::countr_zero(event::squeezed));
  if (outcome_.sums.sum[StepSums::first_event + squeezed] > 0.0) {
    for (std::uint32_t b = 0; b < problem_.field_of_body.size(); ++b) {
      outcome_.squeezed.push_back(space_.reduce(points_.size, MarkedMass{points_, b, event::squeezed}));
    }
  }
  if (outcome_.sums.sum[StepSums::leaving] > 0.0) remove_leaving();
}

template <class Space>
void Stepper<Space>::remove_leaving() {
  const std::size_t bodies = problem_.field_of_body.size(), n = points_.size;
  for (std::uint32_t b = 0; b < bodies; ++b) {
    outcome_.outflow.push_back(space_.reduce(n, Outflow{points_, b, problem_.inertia()}));
  }
  space_.for_each(n, FlagStaying{points_, first_.data()});
  const std::uint32_t left = space_.scan(first_.data(), before_.data(), n);
  space_.for_each(n, ListFlagged{first_.data(), before_.data(), order_.data()});
  rearrange(order_.data(), left);
  points_.size = left;
}

}  // namespace whipple::device
