// SPDX-License-Identifier: BSD-3-Clause
// Material that flies towards mirror planes and walls: it does not act on them before contact, and then as strongly as
// if it had touched from the start (docs/theory/mpm.md, section 3).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/parallel/threads.hpp"
#include "tests/unit/temporary_folder.hpp"
#include "tests/verification/contact_problems.hpp"
#include "tests/verification/same_state.hpp"

namespace whipple::verification {
namespace {

constexpr double dx = 1e-4;                 // m
constexpr double cells = 20.0;              // of the slab
constexpr double sticking_distance = 0.02;  // cells before a no-slip wall: half of its gap

/// Returns the exact pressure of aluminium that is stopped by a wall.
double wall_pressure(double speed) { return 2785.0 * (5328.0 + 1.338 * speed) * speed; }
double shock_speed(double speed) { return 5328.0 + 1.338 * speed; }

std::string soft_aluminium() { return aluminium("soft_aluminium", "1 kPa"); }

std::string body(const std::string& name, const std::string& material, const std::string& shape,
                 const Vector3& velocity = Vector3::Zero(), const std::string& more = {}) {
  return "[[body]]\nname = \"" + name + "\"\nmaterial = \"" + material +
         "\"\nvelocity = " + vector3(velocity) + "\nshape = { " + shape + " }\n" + more;
}

/// A slab in a column of one cell, initially `gap` cells in front of a wall at x = 0 to which it flies.
struct Column {
  std::string wall = "symmetry";
  double gap = 0.0;      // cells
  double speed = 500.0;  // m/s
  Method method{};
  std::string more = {};  // of the body

  [[nodiscard]] double touch() const { return gap * dx / speed; }
  [[nodiscard]] cases::Case read(double end) const {
    const double front = -gap * dx, rear = front - cells * dx;
    const std::string side = number(dx);
    return cases::read_case_text(
        method.time_toml(end) + method.toml() + "[output]\nmaximum_energy_error = 10.0\n[domain]\nlower = [" +
            number(-50 * dx) + ", 0, 0]\nupper = [0, " + side + ", " + side + "]\ncell_size = " + side +
            "\nboundary = { x_upper = \"" + wall +
            "\", y_lower = \"symmetry\", y_upper = \"symmetry\", z_lower = \"symmetry\", z_upper = "
            "\"symmetry\" }\n[[body]]\nname = \"slab\"\nmaterial = \"" +
            soft_aluminium() + "\"\nvelocity = [" + number(speed) + ", 0, 0]\n" + more +
            "shape = { box = { lower = [" + number(rear) + ", 0, 0], upper = [" + number(front) + ", " +
            side + ", " + side + "] } }\n",
        "column.toml");
  }
};

struct Hit {
  double peak = 0.0;     // largest pressure / exact
  double early = 0.0;    // cells of approach remaining at the beginning of the step with the first pressure
  double step = 0.0;     // cells of approach in that step
  double plateau = 0.0;  // mean pressure of the middle of the shocked material / exact
  double before = 0.0;   // largest impulse on the body before contact / its momentum
  double impulse_error = 0.0, energy_error = 0.0;
  double contact_heat = 0.0;  // fraction of the kinetic energy
  int steps = 0;
};

Hit hit(const Column& column) {
  const double us = shock_speed(column.speed), exact = wall_pressure(column.speed);
  const double end = column.touch() + 0.85 * cells * dx / us;
  solver::Simulation simulation(column.read(end), parallel::world());
  const Vector3 momentum = simulation.totals().momentum;
  Hit result;
  double first = -1.0;
  EnergyWatch watch;
  run_to(simulation, end, [&](const solver::Simulation& s) {
    watch(s);
    ++result.steps;
    const double p = *std::ranges::max_element(s.particles().pressure);
    result.peak = std::max(result.peak, p / exact);
    if (first < 0.0 && p > 0.02 * exact) {
      first = s.state().time - s.state().time_step;
      result.step = s.state().time_step * column.speed / dx;
    }
    const Vector3 impulse = s.state().ledger.wall_impulse;
    if (s.state().time < column.touch() - sticking_distance * dx / column.speed) {
      result.before = std::max(result.before, impulse.norm() / momentum.norm());
    }
    result.impulse_error =
        std::max(result.impulse_error, (s.totals().momentum - momentum - impulse).norm() / momentum.norm());
  });
  result.early = (column.touch() - first) * column.speed / dx;
  result.energy_error = watch.worst;
  result.contact_heat =
      simulation.state().ledger.contact_heat / (0.5 * simulation.totals().mass * column.speed * column.speed);
  double sum = 0.0;
  int count = 0;
  const Particles& q = simulation.particles();
  for (std::size_t p = 0; p < q.size(); ++p) {
    // Material keeps its order: by its mass from the front
    const double depth = -q.position[p][0] / dx * (us / (us - column.speed));
    if (depth < 3.0 || depth > 12.0) continue;
    sum += q.pressure[p];
    ++count;
  }
  result.plateau = sum / count / exact;
  return result;
}

void print(const Column& column, const Hit& h) {
  std::printf(
      "%-10s %5.0f m/s gap %4.1f: peak %.3f, plateau %.3f, first %+.3f cells early, before %.1e, impulse "
      "%.1e, "
      "energy %.1e, heat %.1e, %d steps\n",
      column.wall.c_str(), column.speed, column.gap, h.peak, h.plateau, h.early, h.before, h.impulse_error,
      h.energy_error, h.contact_heat, h.steps);
}

/// Compares a slab that flies across the gap with the run in which it touches the wall at the start.
void expect_as_touching(const Column& column, const Hit& touching, double peak, double plateau) {
  // Without relaxation impulses stop the nodes (3.11), which causes less oscillation than a common field.
  const double below = column.method.particle_update == "flip" ? 0.35 : peak;
  const Hit h = hit(column);
  print(column, h);
  SCOPED_TRACE(column.wall + ", gap " + number(column.gap) + ", speed " + number(column.speed) + ", " +
               column.method.scheme + " " + column.method.shape_function + " " +
               column.method.particle_update);
  EXPECT_LT(h.peak / touching.peak, 1.0 + peak);
  EXPECT_GT(h.peak / touching.peak, 1.0 - below);
  EXPECT_NEAR(h.plateau / touching.plateau, 1.0, plateau);
  EXPECT_LT(h.early, std::max(0.1, h.step));
  EXPECT_GT(h.early, -0.1);
  EXPECT_LT(h.before, 1e-13);
  EXPECT_LT(h.impulse_error, 1e-12);
  EXPECT_LT(h.energy_error, column.method.scheme == "symplectic" ? 1e-13 : 0.1);
}

TEST(WallContact, ActsWhenMatterTouchesAndAsIfItHadTouchedFromTheStart) {
  for (const char* wall : {"symmetry", "separating", "no_slip"}) {
    for (const double speed : {200.0, 500.0, 2000.0, 6000.0}) {
      const Hit touching = hit({.wall = wall, .speed = speed});
      for (const double gap : {0.1, 0.5, 1.0, 2.0, 5.0, 20.0}) {
        if (speed < 300.0 && gap > 10.0) continue;  // many steps for the same
        // Above 1 km/s the first step in contact, which is a full one after a flight and a twentieth at the start,
        // raises the peak of the first layer.
        expect_as_touching({.wall = wall, .gap = gap, .speed = speed}, touching, speed > 1e3 ? 0.1 : 0.05,
                           0.02);
      }
    }
  }
}

// The damping of PIC and APIC depends on the number of steps, so all runs begin with a full one; a fold across the gap
// gives 3.6 times the pressure.
TEST(WallContact, DoesSoWithEveryShapeFunctionUpdateAndScheme) {
  for (const char* shape : {"gimp", "convected_gimp", "quadratic_bspline", "cubic_bspline"}) {
    for (const char* update : {"flip", "pic", "relaxed_affine", "apic"}) {
      const bool affine = std::string(update) == "relaxed_affine" || std::string(update) == "apic";
      if (affine && std::string(shape).find("gimp") != std::string::npos) continue;
      Method method{.shape_function = shape, .particle_update = update};
      method.first_step = 1.0;
      const Hit touching = hit({.method = method});
      expect_as_touching({.gap = 2.3, .method = method}, touching, 0.15, 0.15);
    }
  }
  for (const char* scheme : {"usf", "usl", "musl"}) {
    const Method method{.scheme = scheme, .particle_update = "flip"};
    const Hit touching = hit({.method = method});
    expect_as_touching({.gap = 2.3, .method = method}, touching, 0.15, 0.15);
  }
  const Method full_matrix{.scheme = "usl", .particle_update = "fmpm"};
  expect_as_touching({.gap = 2.3, .method = full_matrix}, hit({.method = full_matrix}), 0.15, 0.15);
}

/// Returns the momentum after two transits and one more, over the initial one: 1 exactly for a separating wall.
double rebound(const std::string& wall, double gap) {
  constexpr double cell = 1e-3, length = 0.04, speed = 10.0;
  const double c = std::sqrt(5328.0 * 5328.0 + 4.0 / 3.0 * 27.6e9 / 2785.0);
  const double end = gap * cell / speed + 3.0 * length / c;
  const cases::Case setup = cases::read_case_text(
      Method{}.time_toml(end) + Method{}.toml() +
          "[domain]\nlower = [0, 0, 0]\nupper = [0.06, 0.001, 0.001]\n" +
          "cell_size = 0.001\nboundary = { x_lower = \"" + wall +
          "\", y_lower = \"symmetry\", y_upper = \"symmetry\", z_lower = \"symmetry\", z_upper = "
          "\"symmetry\" }\n" +
          body("bar", elastic_aluminium(), box({gap * cell, 0, 0}, {gap * cell + length, cell, cell}),
               {-speed, 0, 0}),
      "rebound.toml");
  solver::Simulation simulation(setup, parallel::world());
  run_to(simulation, end);
  EXPECT_LT(simulation.state().ledger.momentum_error(simulation.totals()), 1e-12);
  return simulation.totals().momentum[0] / (simulation.totals().mass * speed);
}

// A bar that started in front of the plane leaves it without sticking; one that touched it at the start is continuous
// with its image, and a no-slip wall holds both.
TEST(WallContact, LetsABodyGoThatCame) {
  const double lets_go = rebound("separating", 0.0);
  std::printf("rebound: separating wall, touching %.4f\n", lets_go);
  EXPECT_NEAR(lets_go, 1.0, 0.08);
  for (const char* wall : {"separating", "symmetry"}) {
    const double momentum = rebound(wall, 0.3);
    std::printf("rebound: %s wall across 0.3 cells %.4f\n", wall, momentum);
    EXPECT_NEAR(momentum, lets_go, 0.02);
  }
  EXPECT_LT(rebound("symmetry", 0.0), 0.2);
  EXPECT_LT(rebound("no_slip", 0.3), 0.2);
}

/// Two slabs in a column, or one in front of a mirror plane in the middle between them.
struct MeetingSlabs {
  bool half;
  double gap, speed;  // cells of each slab from the middle, m/s
  std::string contact;
  [[nodiscard]] solver::Simulation simulation(double end) const {
    std::string text =
        Method{}.time_toml(end) + Method{}.toml() + contact + "[domain]\nlower = [-0.004, 0, 0]\n" +
        "upper = " + vector3({half ? 0.0 : 0.004, dx, dx}) + "\ncell_size = " + number(dx) + "\n" +
        (half ? std::string(column_sides)
                    .replace(std::string(column_sides).find('{') + 1, 0, " x_upper = \"symmetry\",")
              : std::string(column_sides));
    const double near = gap * dx, far = near + cells * dx;
    text += body("left", soft_aluminium(), box({-far, 0, 0}, {-near, dx, dx}), {speed, 0, 0});
    if (!half) {
      text += body("right", soft_aluminium(), box({near, 0, 0}, {far, dx, dx}), {-speed, 0, 0});
    }
    return solver::Simulation(cases::read_case_text(text, "slabs.toml"), parallel::world());
  }
};

/// Returns the largest difference of the positions (m) and energies (relative to v^2) of the left slab.
std::pair<double, double> difference(const solver::Simulation& a, const solver::Simulation& b, double speed) {
  double position = 0.0, energy = 0.0;
  const Particles &x = a.particles(), &y = b.particles();
  for (std::size_t p = 0; p < x.size(); ++p) {
    for (std::size_t q = 0; q < y.size(); ++q) {
      if (y.id[q] != x.id[p]) continue;
      position = std::max(position, (x.position[p] - y.position[q]).norm());
      energy = std::max(energy, std::abs(x.specific_internal_energy[p] - y.specific_internal_energy[q]));
    }
  }
  return {position, energy / (speed * speed)};
}

// Contact with the image equals contact with a real image: the common field along the normal where bodies are under
// compression.
TEST(WallContact, EqualsContactWithARealImage) {
  for (const double gap : {0.0, 0.5, 2.3}) {
    constexpr double speed = 500.0;
    const double end = gap * dx / speed + 1.6 * cells * dx / shock_speed(speed);
    const std::string contact = "[contact]\nmethod = \"auto\"\n";
    std::optional<solver::Simulation> full;
    full.emplace(MeetingSlabs{false, gap, speed, contact}.simulation(end));
    // Two slabs that touch at the start have separate fields; half of them is continuous with its image.
    if (gap == 0.0) continue;
    solver::Simulation half = MeetingSlabs{true, gap, speed, {}}.simulation(end);
    double worst = 0.0, worst_energy = 0.0;
    for (int step = 0; half.state().time < end && full->state().time < end; ++step) {
      half.advance(end);
      full->advance(end);
      const auto [position, energy] = difference(half, *full, speed);
      worst = std::max(worst, position / dx);
      worst_energy = std::max(worst_energy, energy);
      ASSERT_LT(position, 1e-10 * dx) << "gap " << gap << ", step " << step;
      ASSERT_LT(energy, 1e-10) << "gap " << gap << ", step " << step;
    }
    std::printf("slab at a plane against two, gap %.1f: positions %.1e cells, energies %.1e\n", gap, worst,
                worst_energy);
  }
}

// The same for a sphere and its image, except for the normals that two bodies have at nodes off the plane, which are
// inclined.
TEST(WallContact, OfASphereIsThatOfTwo) {
  constexpr double cell = 1e-3, speed = 1500.0, radius = 3e-3, gap = 0.3e-3, end = 5e-6;
  const auto simulate = [&](bool half) {
    std::string text =
        Method{}.time_toml(end) + Method{}.toml() +
        "[contact]\nmethod = \"auto\"\nnormal = \"collinear\"\nfriction = 0\n" +
        "[domain]\nlower = [-0.012, -0.008, -0.008]\nupper = " + vector3({half ? 0.0 : 0.012, 0.008, 0.008}) +
        "\ncell_size = " + number(cell) + "\n" + (half ? "boundary = { x_upper = \"symmetry\" }\n" : "");
    const std::string partial = "discretization = { method = \"particles\", partial_volumes = true }\n";
    text += body("left", soft_aluminium(), sphere({-radius - gap, 0, 0}, radius), {speed, 0, 0}, partial);
    if (!half)
      text += body("right", soft_aluminium(), sphere({radius + gap, 0, 0}, radius), {-speed, 0, 0}, partial);
    return cases::read_case_text(text, "spheres.toml");
  };
  std::optional<solver::Simulation> half, full;
  half.emplace(simulate(true), parallel::world());
  full.emplace(simulate(false), parallel::world());
  run_to(*half, end);
  run_to(*full, end);
  const double impulse = -half->state().ledger.wall_impulse[0] / half->state().ledger.initial.momentum[0];
  const double of_two =
      1.0 - sums_of(full->particles(), 0, 0.0).momentum[0] / half->state().ledger.initial.momentum[0];
  const double heat = half->totals().internal_energy, heat_of_two = 0.5 * full->totals().internal_energy;
  const auto pressure = [](const solver::Simulation& s) {
    return *std::ranges::max_element(s.particles().maximum_pressure);
  };
  std::printf(
      "sphere at a plane, of two: impulse %.4f, %.4f of the momentum; internal energy %.3f, %.3f J; "
      "largest pressure %.2f, %.2f GPa\n",
      impulse, of_two, heat, heat_of_two, 1e-9 * pressure(*half), 1e-9 * pressure(*full));
  EXPECT_NEAR(impulse, of_two, 0.02 * of_two);
  EXPECT_NEAR(heat, heat_of_two, 0.015 * half->state().ledger.initial.kinetic_energy);
}

// A slab on a mirror plane is continuous with its image, in pressure and in tension: half of a slab that two others hit
// from both sides.
TEST(WallContact, MatterOnAPlaneAtTheStartIsOneWithItsImage) {
  constexpr double speed = 500.0, end = 2.2e-6;
  const auto simulate = [&](bool half) {
    std::string sides = column_sides;
    if (half) sides.replace(sides.find('{') + 1, 0, " x_upper = \"symmetry\",");
    std::string text = Method{}.time_toml(end) + Method{}.toml() + "[contact]\nmethod = \"none\"\n" +
                       "[domain]\nlower = [-0.008, 0, 0]\nupper = " + vector3({half ? 0.0 : 0.008, dx, dx}) +
                       "\ncell_size = " + number(dx) + "\n" + sides;
    const double thick = 20 * dx, flyer = 10 * dx;
    text += body("slab", soft_aluminium(), box({-thick, 0, 0}, {half ? 0.0 : thick, dx, dx}));
    text += body("left", soft_aluminium(), box({-thick - flyer, 0, 0}, {-thick, dx, dx}), {speed, 0, 0});
    if (!half) {
      text += body("right", soft_aluminium(), box({thick, 0, 0}, {thick + flyer, dx, dx}), {-speed, 0, 0});
    }
    return solver::Simulation(cases::read_case_text(text, "slab.toml"), parallel::world());
  };
  solver::Simulation half = simulate(true), full = simulate(false);
  double tension = 0.0;
  const auto near_plane = [](const solver::Simulation& s) {
    double sum = 0.0;
    int count = 0;
    const Particles& q = s.particles();
    for (std::size_t p = 0; p < q.size(); ++p) {
      if (q.position[p][0] < -dx || q.position[p][0] > 0.0) continue;
      sum += q.pressure[p];
      ++count;
    }
    return sum / std::max(count, 1);
  };
  while (half.state().time < end) {
    half.advance(end);
    full.advance(end);
    const double p = near_plane(half);
    tension = std::min(tension, p);
    ASSERT_NEAR(p, near_plane(full), 1e-6 * 4e9) << "t = " << half.state().time;
  }
  std::printf("tension at the plane: %.2f GPa\n", 1e-9 * tension);
  EXPECT_LT(tension, -1e9);
}

/// Returns a case of a block that flies obliquely into the corner of three walls, with another one next to it in the
/// same field or a separate one.
cases::Case corner(const std::string& contact, const std::string& z_lower, double end) {
  constexpr double cell = 1e-3;
  return cases::read_case_text(
      Method{}.time_toml(end) + Method{}.toml() + contact +
          "[domain]\nlower = [0, 0, 0]\nupper = [0.012, 0.012, 0.012]\ncell_size = 0.001\nboundary = { "
          "x_lower = "
          "\"symmetry\", y_lower = \"separating\", z_lower = \"" +
          z_lower + "\" }\n" +
          body("block", aluminium("corner_aluminium", "0.3 GPa"),
               box({0.4 * cell, 0.9 * cell, 0.7 * cell}, {4.4 * cell, 4.9 * cell, 4.7 * cell}),
               {-700, -1500, -800}) +
          body("second", aluminium("corner_aluminium", "0.3 GPa"),
               box({0.3 * cell, 5.6 * cell, 0.7 * cell}, {4.3 * cell, 8.6 * cell, 4.7 * cell}),
               {-700, -2500, -300}),
      "corner.toml");
}

TEST(WallContact, IsExactWherePlanesAndBodiesMeetAndTheSameByThreadsAndRestart) {
  constexpr double end = 2.5e-6;
  const std::string none = "[contact]\nmethod = \"none\"\n",
                    own = "[contact]\nmethod = \"multi_field\"\nfriction = 0.2\n";
  for (const auto& [contact, z_lower] :
       {std::pair(none, "separating"), std::pair(none, "no_slip"), std::pair(own, "no_slip")}) {
    const cases::Case setup = corner(contact, z_lower, end);
    solver::Simulation simulation(setup, parallel::world());
    const Vector3 momentum = simulation.totals().momentum;
    EnergyWatch watch;
    const TemporaryFolder folder;
    std::filesystem::path checkpoint;
    const int threads = parallel::threads();
    run_to(simulation, end, [&](const solver::Simulation& s) {
      watch(s);
      const Vector3 error = s.totals().momentum - momentum - s.state().ledger.wall_impulse;
      EXPECT_LT(error.norm(), 1e-12 * momentum.norm());
      if (s.state().step == 60) checkpoint = save(s, folder.path());
    });
    std::printf("corner: energy error %.1e, contact heat %.1e of the energy, %d steps\n", watch.worst,
                simulation.state().ledger.contact_heat / simulation.state().ledger.initial.energy(),
                static_cast<int>(simulation.state().step));
    EXPECT_LT(watch.worst, 1e-13);
    // Where a no-slip plane meets another plane, their couplings do not commute (docs/theory/mpm.md, section 3).
    const double least =
        std::string(z_lower) == "no_slip" ? -0.015 * simulation.totals().internal_energy : 0.0;
    EXPECT_GT(simulation.state().ledger.contact_heat, least);
    ASSERT_FALSE(checkpoint.empty());
    parallel::set_threads(2);
    solver::Simulation again(setup, parallel::world());
    run_to(again, end);
    parallel::set_threads(threads);
    expect_same(simulation, again);
    solver::Simulation restarted = restored(setup, checkpoint, parallel::world());
    run_to(restarted, end);
    expect_same(simulation, restarted);
  }
}

// Between planes one cell apart nodes held by one plane are the images of nodes beyond the other.
TEST(WallContact, KeepsEnergyAndMomentumOfAGasThatFillsACellBetweenTwoPlanes) {
  constexpr double end = 1.5e-6;
  for (const char* wall : {"symmetry", "no_slip", "separating"}) {
    for (const char* method : {"particle_update = \"relaxed_affine\"", "particle_update = \"flip\"",
                               "particle_update = \"flip\"\nshape_function = \"cubic_bspline\"",
                               "particle_update = \"flip\"\nshape_function = \"gimp\""}) {
      for (const double lower : {0.0, 0.25}) {  // mm; on a plane at the start, or on none
        SCOPED_TRACE(std::string(wall) + ", " + method + ", " + number(lower) + " mm");
        const std::string planes = "x_lower = \"symmetry\", x_upper = \"symmetry\", y_lower = \"" +
                                   std::string(wall) + "\", y_upper = \"" + wall +
                                   "\", z_lower = \"symmetry\", z_upper = \"symmetry\"";
        const cases::Case setup = cases::read_case_text(
            "[domain]\nlower = [\"0 mm\", \"0 mm\", \"0 mm\"]\nupper = [\"8 mm\", \"1 mm\", \"1 mm\"]\n"
            "cell_size = \"1 mm\"\nboundary = { " +
                planes + " }\n[time]\nend = " + number(end) + "\n[transfer]\n" + method +
                "\n[output]\nmaximum_energy_error = 10.0\n" +
                body("gas", "tnt.toml",
                     "box = { lower = [\"2 mm\", \"" + number(lower) +
                         " mm\", \"0 mm\"], upper = [\"5 mm\", \"" + number(lower + 0.5) +
                         " mm\", \"1 mm\"] }",
                     {0, 100, 0}, "detonation = \"instantaneous\"\ndiscretization = { per_cell = 64 }\n"),
            "narrow.toml");
        solver::Simulation simulation(setup, parallel::world());
        const Vector3 momentum = simulation.totals().momentum;
        EnergyWatch watch;
        run_to(simulation, end, [&](const solver::Simulation& s) {
          watch(s);
          const Vector3 error = s.totals().momentum - momentum - s.state().ledger.wall_impulse;
          EXPECT_LT(error.norm(), 1e-11 * momentum.norm());
        });
        EXPECT_LT(watch.worst, 1e-12);
      }
    }
  }
}

/// Elements next to particles in a column of two cells: nodes of elements near particles move with the grid.
TEST(WallContact, StopsElementsThatMoveWithTheGridWhereTheirFacetsTouch) {
  constexpr double speed = 500.0, gap = 2.3;
  const double length = 10 * dx, touch = gap * dx / speed, end = touch + 0.8 * length / shock_speed(speed);
  std::string sides = column_sides;
  sides.replace(sides.find('{') + 1, 0, " x_upper = \"separating\",");
  const cases::Case setup = cases::read_case_text(
      Method{}.time_toml(end) + Method{}.toml() + "[domain]\nlower = [-0.004, 0, 0]\nupper = " +
          vector3({0.0, 4 * dx, dx}) + "\ncell_size = " + number(dx) + "\n" + sides +
          body("particles", soft_aluminium(), box({-gap * dx - length, 0, 0}, {-gap * dx, 2 * dx, dx}),
               {speed, 0, 0}) +
          body("elements", soft_aluminium(), box({-gap * dx - length, 2 * dx, 0}, {-gap * dx, 4 * dx, dx}),
               {speed, 0, 0}, "discretization = { method = \"finite_elements\" }\n"),
      "elements.toml");
  solver::Simulation simulation(setup, parallel::world());
  const Vector3 momentum = simulation.totals().momentum;
  double peak = 0.0, before = 0.0;
  EnergyWatch watch;
  run_to(simulation, end, [&](const solver::Simulation& s) {
    watch(s);
    for (const double p : s.particles().pressure) peak = std::max(peak, p);
    for (const double p : s.meshes()[0].points.pressure) peak = std::max(peak, p);
    const Vector3 impulse = s.state().ledger.wall_impulse;
    if (s.state().time < touch) before = std::max(before, impulse.norm() / momentum.norm());
    EXPECT_LT((s.totals().momentum - momentum - impulse).norm(), 1e-12 * momentum.norm());
  });
  std::printf("elements beside particles: peak %.3f, impulse before %.1e, energy %.1e\n",
              peak / wall_pressure(speed), before, watch.worst);
  EXPECT_LT(before, 1e-13);
  EXPECT_LT(watch.worst, 1e-13);
  EXPECT_NEAR(peak / wall_pressure(speed), 1.25, 0.15);
}

}  // namespace
}  // namespace whipple::verification
