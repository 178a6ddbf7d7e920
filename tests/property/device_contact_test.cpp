// SPDX-License-Identifier: BSD-3-Clause
// Contact of two velocity fields as devices compute it, called for one node after the other, against that of the host
// on the same particles: normals, gaps, motion, heat, balance, first touches.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "src/contact/contact.hpp"
#include "src/core/parallel/mpi.hpp"
#include "tests/property/device_contact_kernels.hpp"
#include "tests/property/device_contact_support.hpp"
#include "tests/property/transfer_support.hpp"

namespace whipple::device {
namespace {

using transfer::dx;
using Shape = transfer::QuadraticBSpline;
constexpr double kappa = 0.7, least_speed = 0.4;

/// Describes bodies of random particles and their contact.
struct Trial {
  std::array<grid::Boundary, 6> boundary{};
  contact::Response response = contact::Response::common_field;
  contact::Normal normal = contact::Normal::separating;
  double friction = 0.0;
  double dt = 0.02;
  double speed = 1.0;  ///< of approach of the bodies
  bool gap_test = true;
  double gap = 0.0;               ///< in cells
  double apart = -0.5;            ///< between the bodies, in cells
  std::vector<double> least{};    ///< relaxation rates of the fields, 1/s
  std::vector<double> rubbing{};  ///< Coulomb coefficients of the fields
  std::uint32_t fields = 2;
  double wall_friction = 0.0;
  double beta = -1.0;          ///< of all nodes; negative: by their sound speed
  std::uint32_t unbonded = 0;  ///< fields that are in contact with their images everywhere, one bit each
  std::array<std::int32_t, 3> cells = {22, 7, 5};
  bool regular =
      false;  ///< particles of one volume nearly on a lattice: nodes inside have no gradient of the volume

  [[nodiscard]] grid::Geometry geometry() const {
    grid::Geometry geometry = transfer::geometry(boundary);
    geometry.cells = cells;
    geometry.friction = wall_friction;
    return geometry;
  }
};

struct Bodies {
  Particles particles;
  std::vector<std::uint8_t> field;
};
Bodies bodies_of(const Trial& trial) {
  constexpr double width = 2.6;
  const grid::Geometry geometry = trial.geometry();
  Bodies bodies;
  Particles& q = bodies.particles;
  q = transfer::random_particles(900 * trial.fields, Vector3(-1.97, -0.98, 3.02),
                                 Vector3(-1.97 + width, 2.45, 2.95 + dx * trial.cells[2]), 17);
  for (std::size_t p = 0; p < q.size(); ++p) {
    const auto body = static_cast<std::uint32_t>(p % trial.fields);
    bodies.field.push_back(static_cast<std::uint8_t>(body));
    q.body[p] = body;
    if (trial.regular) {
      constexpr double spacing = 0.5 * dx;
      q.volume[p] = spacing * spacing * spacing;
      const std::size_t i = p / trial.fields;
      const std::array<std::size_t, 3> place = {i / 90, i / 9 % 10, i % 9};
      for (std::size_t a = 0; a < 3; ++a) {
        double& x = q.position[p][static_cast<int>(a)];
        x = geometry.lower[static_cast<int>(a)] + spacing * (static_cast<double>(place[a]) + 0.5) +
            1e-3 * x * spacing;
      }
    }
    q.position[p][0] += body * (width + trial.apart * dx);
    q.velocity[p][0] -= body * trial.speed;
    q.void_volume[p] = p % 4 == 0 ? 0.2 * q.volume[p] : 0.0;
    SymmetricTensor& e = q.extent[p];
    e.xy = 0.2 * e.zz, e.yz = -0.3 * e.zz, e.zx = 0.1 * e.zz;
    if (p % 7 == 0) e = {};
  }
  return bodies;
}

ContactConstants constants_of(const Trial& trial) {
  ContactConstants c{.response = trial.response == contact::Response::impulses
                                     ? ContactResponse::impulses
                                     : ContactResponse::common_field,
                     .normal = trial.normal == contact::Normal::collinear ? ContactNormal::collinear
                                                                          : ContactNormal::separating,
                     .gap_test = trial.gap_test,
                     .gap = trial.gap,
                     .dt = trial.dt};
  c.friction.fill(trial.friction);
  std::ranges::copy(trial.rubbing, c.friction.begin());
  std::ranges::copy(trial.least, c.least_relaxation_rate.begin());
  for (std::size_t face = 0; face < 6; ++face) {
    if (trial.boundary[face] != grid::Boundary::outflow) c.reflecting_faces |= 1U << face;
  }
  return c;
}

WallConstants walls_of(const Trial& trial) {
  WallConstants walls{.friction = trial.wall_friction, .dt = trial.dt};
  for (std::size_t face = 0; face < 6; ++face) {
    const grid::Boundary kind = trial.boundary[face];
    walls.kind[face] = static_cast<WallKind>(kind);  // in the same order
    if (kind != grid::Boundary::outflow && (trial.unbonded != 0 || grid::lets_part(kind)))
      walls.apart |= 1U << face;
  }
  return walls;
}

/// Counts what the nodes of a trial did, so that none of it is missed.
struct Counts {
  int gaps = 0, without_normal = 0;
};

class DeviceContact : public testing::Test {
 protected:
  Counts counts_;
  contact::Balance balance_;  // of the host
  double wall_heat_ = 0.0;    // of the host, J
  contact::FirstTouches::Outcome outcome_;

  void compare(const Trial& trial) {
    Bodies bodies = bodies_of(trial);
    const Particles& q = bodies.particles;
    const grid::Geometry geometry = trial.geometry();
    grid::BlockGrid grid(geometry, parallel::world());
    OnDevice on(geometry, q, bodies.field, trial.fields);
    set_planes(trial, grid, on.lattice);
    transfer::bin<Shape>(grid, q);
    grid.separate_fields(Shape::stencil, {q.position, bodies.field}, {}, trial.fields);
    transfer::particles_to_grid(transfer::smoothed<Shape>(), q, grid);

    contact::Contact contact({.response = trial.response,
                              .normal = trial.normal,
                              .friction = trial.friction,
                              .friction_of_field = trial.rubbing,
                              .gap_test = trial.gap_test,
                              .gap = trial.gap,
                              .least_relaxation_rate = trial.least});
    contact.find_surfaces(Shape::kind, q, {}, grid, trial.dt);
    contact::Surfaces surfaces;
    surfaces.find(trial.normal, Shape::kind, q, {}, grid, trial.dt);
    contact::GridUpdate update;
    contact::FirstTouches touches(trial.fields);
    touches.begin_step(trial.dt, least_speed);
    update.mirror_contact().watch(touches);
    update.mirror_contact().find_surfaces(Shape::kind, q, {}, grid, trial.dt);

    on.copy_sums(grid);
    const ContactConstants constants = constants_of(trial);
    Pairs pairs;
    pairs.find(on, constants);
    counts_ = {};
    compare_surfaces(grid, surfaces, on, pairs);
    const WallConstants walls = walls_of(trial);
    WallNodes at_walls;
    at_walls.find(on, walls);

    update.solve_momentum(grid, trial.dt, {.kappa = kappa, .fixed = trial.beta});
    on.copy_motion(grid);
    at_walls.remember(on);
    balance_ = contact.apply(grid, trial.dt, touches);
    const ContactBalance balance = pairs.apply(on, constants);
    update.share_step(grid);
    const double wall_heat = at_walls.meet(on, walls);
    wall_heat_ = update.take_contact_heat();
    outcome_ = touches.end_step(parallel::world());
    on.for_each_node(grid, [&](const Node& node, const grid::Node& host) {
      const auto i_node = static_cast<std::uint32_t>(&node - on.lattice.nodes);
      if (on.lattice.is_image(on.lattice.place_of(i_node), on.lattice.field_of(i_node))) return;
      const Lanes a = host.motion.velocity_and_relaxation, b = host.motion.increment_and_heat;
      for (int c = 0; c < 4; ++c) {
        const auto i = static_cast<std::size_t>(c);
        EXPECT_NEAR(node.n[i], a[c], 1e-12 * (1.0 + std::abs(a[c])));
        EXPECT_NEAR(node.n[4 + i], b[c], 1e-12 * (1.0 + std::abs(b[c])));
      }
    });
    const auto near = [](double value, double reference) {
      EXPECT_NEAR(value, reference, 1e-12 * std::abs(reference) + 1e-14);
    };
    near(balance.contact_heat, balance_.contact_heat);
    near(balance.friction_heat, balance_.friction_heat);
    near(balance.impulse, balance_.impulse);
    near(balance.friction_impulse, balance_.friction_impulse);
    EXPECT_EQ(balance.crowded, 0.0);
    near(wall_heat, wall_heat_);
    compare_touches(trial, pairs, at_walls);
  }

  static void set_planes(const Trial& trial, grid::BlockGrid& grid, SpaceLattice& lattice) {
    std::array<grid::FieldSet, 6> bonded;
    bonded.fill(grid::FieldSet::from(trial.fields));
    for (std::size_t face = 0; face < 6; ++face) {
      const grid::Boundary kind = trial.boundary[face];
      for (unsigned field = 0; field < trial.fields; ++field) {
        if ((trial.unbonded >> field & 1U) == 0) bonded[face] |= grid::FieldSet::of(field);
      }
      lattice.mirrors[face] = {.active = grid.geometry().mirrors(face),
                               .reverses_all = kind == grid::Boundary::no_slip,
                               .fields = ~trial.unbonded};
    }
    grid.bond_at_planes(bonded);
  }

  /// Compares normals and gaps at all nodes that the host has separate for both fields.
  void compare_surfaces(const grid::BlockGrid& grid, const contact::Surfaces& surfaces, const OnDevice& on,
                        Pairs& pairs) {
    std::vector<std::uint8_t> seen(pairs.pair.size(), 0);
    for (std::size_t c = 0; c < grid.contact_slots().size(); ++c) {
      const grid::BlockCoordinate& block = grid.coordinate(grid.contact_slots()[c]);
      for (int i = 0; i < grid::nodes_per_block; ++i) {
        const contact::Surfaces::Gap host = surfaces.at(c, 0, static_cast<std::size_t>(i));
        const Place at = {block[0] * 4 + i / 16, block[1] * 4 + i / 4 % 4, block[2] * 4 + i % 4};
        const std::int32_t node = on.lattice.node_at(0, at);
        const auto found = std::ranges::find_if(pairs.pair, [&](const ContactPair& pair) {
          return static_cast<std::int32_t>(pair.first) == node;
        });
        if (found == pairs.pair.end()) {
          EXPECT_TRUE(host.normal.isZero(0.0));
          continue;
        }
        const auto number = static_cast<std::size_t>(found - pairs.pair.begin());
        seen[number] = 1;
        const Gap gap = pairs.surfaces().gap(number);
        EXPECT_EQ(gap.any(), !host.normal.isZero(0.0));
        if (!gap.any()) {
          ++counts_.without_normal;
          continue;
        }
        ++counts_.gaps;
        EXPECT_NEAR(gap.normal.x, host.normal[0], 1e-12);
        EXPECT_NEAR(gap.normal.y, host.normal[1], 1e-12);
        EXPECT_NEAR(gap.normal.z, host.normal[2], 1e-12);
        EXPECT_NEAR(gap.width, host.width, 1e-12 * dx);
      }
    }
    EXPECT_EQ(std::ranges::count(seen, 0), 0);
  }
  /// The approaches that decide have the outcome of all of them.
  void compare_touches(const Trial& trial, const Pairs& pairs, const WallNodes& at_walls) const {
    contact::FirstTouches touches(trial.fields);
    touches.begin_step(trial.dt, least_speed);
    const auto tell = [&](const std::vector<Approach>& approach, std::uint32_t kinds, auto&& see) {
      const std::size_t chunks =
          (approach.size() + FindDecidingApproaches::chunk - 1) / FindDecidingApproaches::chunk;
      std::vector<DecidingApproaches> deciding(kinds * chunks), of_all(kinds);
      const FindDecidingApproaches find{approach.data(), approach.size(), kinds,
                                        trial.dt,        least_speed,     deciding.data()};
      for (std::size_t i = 0; i < deciding.size(); ++i) {
        find(i);
        find.combine(of_all[i % kinds], deciding[i]);
      }
      for (const DecidingApproaches& of_kind : of_all) {
        for (const Approach& one : {of_kind.soonest, of_kind.hardest}) see(one);
      }
    };
    tell(pairs.approach, 1, [&](const Approach& one) { touches.see(0, 1, one.open, one.closing); });
    tell(at_walls.approach, 6,
         [&](const Approach& one) { touches.see_face(one.pair, one.open, one.closing); });
    const contact::FirstTouches::Outcome outcome = touches.end_step(parallel::world());
    EXPECT_EQ(outcome.hard, outcome_.hard);
    EXPECT_NEAR(outcome.next, outcome_.next, 1e-12 * outcome_.next);
  }
};

constexpr auto outflow = grid::Boundary::outflow, symmetry = grid::Boundary::symmetry,
               no_slip = grid::Boundary::no_slip;
/// The bodies reach all faces but the upper one of x.
constexpr std::array<std::array<grid::Boundary, 6>, 4> boundaries = {
    {{},
     {outflow, outflow, outflow, outflow, outflow, symmetry},
     {symmetry, outflow, symmetry},
     {outflow, outflow, symmetry, outflow, no_slip, outflow}}};

TEST_F(DeviceContact, OfCommonFieldsIsThatOfTheHost) {
  for (const auto& boundary : boundaries) {
    for (const double friction : {0.0, 0.3}) {
      compare({.boundary = boundary, .friction = friction, .cells = {22, 7, 9}});
      EXPECT_GT(counts_.gaps, 150);
      EXPECT_GT(balance_.impulse, 1.0);
      EXPECT_EQ(balance_.friction_impulse > 0.0, friction > 0.0);
      EXPECT_TRUE(outcome_.hard);
    }
  }
}

TEST_F(DeviceContact, OfImpulsesIsThatOfTheHost) {
  for (const auto& boundary : boundaries) {
    for (const double friction : {0.0, 0.3}) {
      compare({.boundary = boundary, .response = contact::Response::impulses, .friction = friction});
      EXPECT_GT(balance_.impulse, 1.0);
      EXPECT_EQ(balance_.friction_impulse > 0.0, friction > 0.0);
    }
  }
}

// Rates near those of the nodes: impulses stop some of them.
// The increments of the step are as large as the velocities: bodies part, and friction must not add energy.
TEST_F(DeviceContact, OfStrongForcesIsThatOfTheHost) {
  for (const auto& boundary : boundaries) {
    for (const contact::Response response : {contact::Response::common_field, contact::Response::impulses}) {
      for (const double friction : {0.2, 1e3})
        compare({.boundary = boundary,
                 .response = response,
                 .friction = friction,
                 .dt = 5.0,
                 .cells = {22, 7, 9}});
    }
  }
}

// Most nodes need no normals, except near reflecting faces.
TEST_F(DeviceContact, OfPartingBodiesIsThatOfTheHost) {
  for (const auto& boundary : boundaries) {
    compare({.boundary = boundary, .friction = 0.3, .speed = -3.0, .cells = {22, 7, 9}});
    EXPECT_GT(counts_.without_normal, 4);
  }
}

TEST_F(DeviceContact, OfLooseMaterialIsThatOfTheHost) {
  double with_lower_rate = -1.0;
  for (const double rate : {0.0, 1.45 * kappa / dx, 1e3}) {
    compare({.boundary = boundaries[2], .friction = 0.3, .least = {0.0, rate}, .rubbing = {0.2, 0.5}});
    EXPECT_GT(balance_.contact_heat, with_lower_rate);
    with_lower_rate = balance_.contact_heat;
  }
}

TEST_F(DeviceContact, AcrossGapsIsThatOfTheHost) {
  for (const contact::Normal normal : {contact::Normal::collinear, contact::Normal::separating}) {
    for (const double apart : {0.3, 0.9}) {
      for (const bool gap_test : {true, false}) {
        compare({.normal = normal, .friction = 0.3, .gap_test = gap_test, .gap = 0.05, .apart = apart});
        EXPECT_GT(counts_.gaps, 100);
      }
    }
  }
}

// Normals are undefined inside of the bodies.
TEST_F(DeviceContact, OfBodiesInEachOtherIsThatOfTheHost) {
  compare({.friction = 0.3, .apart = -5.3, .regular = true});
  EXPECT_GT(counts_.gaps, 50);
  EXPECT_GT(counts_.without_normal, 5);
}

TEST_F(DeviceContact, ForeseesTouchesAsTheHost) {
  compare({.apart = 1.8});
  EXPECT_EQ(balance_.impulse, 0.0);
  EXPECT_FALSE(outcome_.hard);
  EXPECT_LT(outcome_.next, 1.0);
  EXPECT_GT(outcome_.next, Trial().dt);
}

constexpr auto separating = grid::Boundary::separating, rough = grid::Boundary::friction;

TEST_F(DeviceContact, WithImagesIsThatOfTheHost) {
  const std::array<grid::Boundary, 6> rooms[] = {{symmetry, outflow, outflow, outflow, outflow, outflow},
                                                 {separating, outflow, outflow, separating, outflow, outflow},
                                                 {rough, outflow, rough, symmetry, outflow, separating},
                                                 {no_slip, outflow, outflow, outflow, outflow, outflow},
                                                 {symmetry, outflow, separating, symmetry, no_slip, rough}};
  for (const auto& boundary : rooms) {
    for (const std::uint32_t unbonded : {1U, 2U, 3U}) {
      for (const double beta : {-1.0, 0.0}) {
        compare({.boundary = boundary,
                 .friction = 0.3,
                 .wall_friction = 0.3,
                 .beta = beta,
                 .unbonded = unbonded});
      }
    }
  }
}

// Nodes on the opposite plane, with whose image the material is continuous, do not cross it.
TEST_F(DeviceContact, WithImagesInACellBetweenPlanesIsThatOfTheHost) {
  for (const auto& [lower, upper] :
       {std::pair{separating, symmetry}, std::pair{rough, no_slip}, std::pair{no_slip, separating}}) {
    for (const std::uint32_t unbonded : {0U, 2U}) {
      compare({.boundary = {outflow, outflow, outflow, outflow, lower, upper},
               .friction = 0.3,
               .wall_friction = 0.3,
               .unbonded = unbonded,
               .cells = {22, 7, 1}});
      EXPECT_NE(wall_heat_, 0.0);
    }
  }
}

TEST_F(DeviceContact, CountsPlacesOfMoreThanTwoFields) {
  const Trial trial{.apart = -4.0, .fields = 3};
  const Bodies bodies = bodies_of(trial);
  const grid::Geometry geometry = trial.geometry();
  grid::BlockGrid grid(geometry, parallel::world());
  transfer::bin<Shape>(grid, bodies.particles);
  grid.separate_fields(Shape::stencil, {bodies.particles.position, bodies.field}, {}, 3);
  transfer::particles_to_grid(transfer::smoothed<Shape>(), bodies.particles, grid);
  OnDevice on(geometry, bodies.particles, bodies.field, 3);
  on.copy_sums(grid);
  Pairs pairs;
  pairs.find(on, constants_of(trial));
  contact::GridUpdate update;
  update.solve_momentum(grid, trial.dt, {.kappa = kappa});
  int several = 0;
  for (const std::uint32_t slot : grid.contact_slots()) {
    for (std::size_t i = 0; i < grid::nodes_per_block; ++i) {
      int reached = 0;
      grid.fields(slot).for_each([&](unsigned field) {
        reached += grid.nodes(slot, field)[i].motion.mass_for_contact() > 0.0 ? 1 : 0;
      });
      several += reached > 2 ? 1 : 0;
    }
  }
  on.copy_motion(grid);
  EXPECT_GT(several, 20);
  EXPECT_EQ(pairs.apply(on, constants_of(trial)).crowded, several);
  EXPECT_LT(several, static_cast<int>(pairs.pair.size()));
}

}  // namespace
}  // namespace whipple::device
