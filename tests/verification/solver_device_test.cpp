// SPDX-License-Identifier: BSD-3-Clause
// The step on a device, emulated by the threads of the host, beside the kernels of the host (docs/manual/devices.md). With
// WHIPPLE_TEST_DEVICE=gpu the device is a card.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "src/case/build/tables.hpp"
#include "src/core/base/error.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/io/ranks.hpp"
#include "src/solver/device/device.hpp"
#include "tests/unit/temporary_folder.hpp"
#include "tests/verification/same_state.hpp"

namespace whipple::verification {
namespace {

using solver::Device;
using solver::Simulation;

/// Lets simulations use a device as long as it exists.
class OnDevice {
 public:
  explicit OnDevice(Device device) : former_(std::exchange(solver::default_device(), device)) {}
  OnDevice(const OnDevice&) = delete;
  OnDevice& operator=(const OnDevice&) = delete;
  ~OnDevice() { solver::default_device() = former_; }

 private:
  Device former_;
};

/// The device that is compared with the host.
Device tested() {
  const char* const word = std::getenv("WHIPPLE_TEST_DEVICE");
  return word != nullptr && std::string_view(word) == "gpu" ? Device::gpu : Device::emulated;
}

/// A problem, and what is seen of the differences after one and two hundred steps.
struct Problem {
  std::string name, text;
  double after_one, after_many;  ///< bounds of the differences, relative to the greatest value of a field
};
// NOLINTNEXTLINE(readability-identifier-naming): the name that GoogleTest looks for
void PrintTo(const Problem& problem, std::ostream* out) { *out << problem.name; }

constexpr const char* common = R"([transfer]
rest_tolerance = 0.0
[output]
maximum_energy_error = 1e-12
)";

std::string body(const std::string& name, const std::string& material, const std::string& velocity,
                 const std::string& shape, const std::string& more = {}) {
  return "[[body]]\nname = \"" + name + "\"\nmaterial = \"" + material + "\"\nvelocity = " + velocity +
         "\nshape = { " + shape + " }\n" + more;
}

/// A ball that flies at a wall of some kind, followed by another that is aside of the plane of symmetry.
Problem ball_at_wall(const std::string& wall) {
  return {wall,
          std::string(common) +
              "[domain]\nlower = [\"0 mm\", \"0 mm\", \"-6 mm\"]\nupper = [\"16 mm\", \"6 mm\", \"6 mm\"]\n"
              "cell_size = \"1 mm\"\n" +
              (wall == "friction" ? "friction = 0.3\n" : "") + "boundary = { x_lower = \"" + wall +
              "\", y_lower = \"symmetry\" }\n[time]\nend = \"1 ms\"\n" +
              body("ball", "copper_johnson_cook.toml", "[\"-500 m/s\", \"0 m/s\", \"150 m/s\"]",
                   "sphere = { center = [\"3.3 mm\", \"0 mm\", \"0 mm\"], radius = \"3 mm\" }") +
              body("second", "lead_mie_gruneisen.toml", "[\"-600 m/s\", \"0 m/s\", \"0 m/s\"]",
                   "sphere = { center = [\"8.4 mm\", \"2.4 mm\", \"0.7 mm\"], radius = \"2 mm\" }"),
          1e-12, 1e-8};
}

/// A disk through a plate, both with melting and boiling, as tables; particles of fluids are divided.
Problem melting() {
  const std::string table = "equation_of_state = \"table\"\n";
  return {
      "melting",
      std::string(common) +
          "[domain]\nlower = [\"0 mm\", \"0 mm\", \"-6 mm\"]\nupper = [\"9 mm\", \"9 mm\", \"10 mm\"]\n"
          "cell_size = \"0.75 mm\"\nboundary = { x_lower = \"symmetry\", y_lower = \"symmetry\" }\n"
          "[time]\nend = \"1 ms\"\n" +
          body("disk", "lead.toml", "[\"0 m/s\", \"0 m/s\", \"8 km/s\"]",
               "cylinder = { center = [\"0 mm\", \"0 mm\", \"-1.5 mm\"], axis = \"z\", radius = \"3 mm\", "
               "height = \"3 mm\" }",
               table) +
          body("plate", "aluminium.toml", "[\"0 m/s\", \"0 m/s\", \"0 m/s\"]",
               "box = { lower = [\"0 mm\", \"0 mm\", \"0 mm\"], upper = [\"8 mm\", \"8 mm\", \"2.25 mm\"] }",
               table),
      1e-10, 1e-6};
}

/// A block that slides on a slab under gravity.
Problem incline() {
  return {
      "incline",
      std::string(common) +
          "[contact]\nmethod = \"multi_field\"\nfriction = 0.2\n"
          "[gravity]\nacceleration = [\"5e5 m/s^2\", \"-866025 m/s^2\", \"0 m/s^2\"]\n"
          "[domain]\nlower = [\"0 mm\", \"0 mm\", \"0 mm\"]\nupper = [\"20 mm\", \"12 mm\", \"1 mm\"]\n"
          "cell_size = \"1 mm\"\nboundary = { x_lower = \"symmetry\", x_upper = \"symmetry\", y_lower = "
          "\"no_slip\", z_lower = \"symmetry\", z_upper = \"symmetry\" }\n[time]\nend = \"1 ms\"\n" +
          body("slab", "aluminium_6061_mie_gruneisen.toml", "[\"0 m/s\", \"0 m/s\", \"0 m/s\"]",
               "box = { lower = [\"0 mm\", \"0 mm\", \"0 mm\"], upper = [\"20 mm\", \"4 mm\", \"1 mm\"] }") +
          body("block", "aluminium_6061_mie_gruneisen.toml", "[\"0 m/s\", \"0 m/s\", \"0 m/s\"]",
               "box = { lower = [\"4.3 mm\", \"4 mm\", \"0 mm\"], upper = [\"12.3 mm\", \"9 mm\", \"1 mm\"] "
               "}"),
      1e-11, 1e-8};
}

/// A ball on the axis that meets the edge of a hole, both as tables with melting and boiling, in axisymmetry; particles of
/// fluids are divided.
Problem rings() {
  const std::string table = "equation_of_state = \"table\"\n";
  return {"rings",
          std::string(common) +
              "[domain]\ndimension = \"axisymmetric\"\nlower = [\"-10 mm\", \"0 mm\"]\n"
              "upper = [\"32 mm\", \"20 mm\"]\ncell_size = \"0.5 mm\"\n[time]\nend = \"1 ms\"\n" +
              body("ball", "lead.toml", "[\"8 km/s\", \"0 m/s\"]",
                   "sphere = { center = [\"-3.1 mm\", \"0 mm\", \"0 mm\"], radius = \"3 mm\" }", table) +
              body("plate", "aluminium.toml", "[\"0 m/s\", \"0 m/s\"]",
                   "tube = { base = [\"0 mm\", \"0 mm\", \"0 mm\"], axis = \"x\", height = \"2.25 mm\", "
                   "inner_radius = \"0.6 mm\", outer_radius = \"10 mm\" }",
                   table),
          1e-10, 1e-6};
}

/// A bar that strikes a wall from which it may part, and a ring around its end that it opens, in axisymmetry.
Problem bar_in_ring() {
  return {"bar_in_ring",
          std::string(common) +
              "[domain]\ndimension = \"axisymmetric\"\nlower = [\"0 mm\", \"0 mm\"]\nupper = [\"14 mm\", "
              "\"11 mm\"]\n"
              "cell_size = \"0.5 mm\"\nboundary = { x_lower = \"separating\" }\n[time]\nend = \"1 ms\"\n" +
              body("bar", "copper_johnson_cook.toml", "[\"-600 m/s\", \"0 m/s\"]",
                   "cylinder = { center = [\"5.7 mm\", \"0 mm\", \"0 mm\"], axis = \"x\", radius = \"4 mm\", "
                   "height = "
                   "\"11 mm\" }") +
              body("ring", "aluminium_6061_mie_gruneisen.toml", "[\"0 m/s\", \"0 m/s\"]",
                   "tube = { base = [\"0.4 mm\", \"0 mm\", \"0 mm\"], axis = \"x\", height = \"3 mm\", "
                   "inner_radius = "
                   "\"4.2 mm\", outer_radius = \"7 mm\" }"),
          1e-12, 1e-8};
}

/// A rod that falls obliquely on a wall with friction, followed by a second one, in plane strain.
Problem section_at_wall() {
  return {"section_at_wall",
          std::string(common) +
              "[domain]\ndimension = \"plane_strain\"\nlower = [\"0 mm\", \"0 mm\"]\nupper = [\"16 mm\", \"8 "
              "mm\"]\n"
              "cell_size = \"0.5 mm\"\nfriction = 0.3\nboundary = { x_lower = \"friction\", y_lower = "
              "\"symmetry\", "
              "y_upper = \"no_slip\" }\n[time]\nend = \"1 ms\"\n" +
              body("rod", "copper_johnson_cook.toml", "[\"-500 m/s\", \"150 m/s\"]",
                   "cylinder = { center = [\"3.3 mm\", \"2.2 mm\", \"0 mm\"], axis = \"z\", radius = \"3 "
                   "mm\", height = "
                   "\"4 mm\" }") +
              body("second", "lead_mie_gruneisen.toml", "[\"-600 m/s\", \"0 m/s\"]",
                   "cylinder = { center = [\"8.4 mm\", \"2.9 mm\", \"0 mm\"], axis = \"z\", radius = \"2 "
                   "mm\", height = "
                   "\"4 mm\" }"),
          1e-12, 1e-8};
}

cases::Case read(const Problem& problem) {
  cases::Case setup = cases::read_case_text(problem.text, "device.toml");
  cases::tabulate_materials(setup, io::Ranks(parallel::world()));
  return setup;
}

void advance(Simulation& simulation, int steps) {
  for (int i = 0; i < steps; ++i) simulation.advance(simulation.setup().time.end);
}

/// Returns the particles in the order of their numbers, or of their places if some have been divided: halves get their
/// numbers in the order of the particles in memory, which a device sorts in its own way.
std::vector<std::size_t> ordered(const Particles& particles) {
  std::vector<std::size_t> order(particles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const Vector3 along(1.0, 1.37, 2.11);  // no direction of symmetry
  if (std::ranges::max(particles.generation) == 0) {
    std::ranges::sort(order, {}, [&](std::size_t p) { return particles.id[p]; });
  } else {
    std::ranges::sort(order, {}, [&](std::size_t p) { return along.dot(particles.position[p]); });
  }
  return order;
}

/// Returns the smallest magnitude of a field that is no round-off, by its unit.
double scale_of(const std::string& unit) {
  if (unit == "Pa") return 1e9;
  if (unit == "J/kg") return 1e4;
  if (unit == "m/s") return 1e2;
  if (unit == "1/s") return 1e5;
  return 0.0;
}

/// Returns the largest difference of any field of two sets of particles, over the largest value of the field.
double largest_difference(const Particles& a, const Particles& b) {
  EXPECT_EQ(a.size(), b.size());
  if (a.size() != b.size()) return 1.0;
  const std::vector<std::size_t> of_a = ordered(a), of_b = ordered(b);
  double largest = 0.0;
  for_each_field(a, [&](const auto& field) {
    if (std::string_view(field.name) == "id") return;
    const auto& x = field.of(a);
    const auto& y = field.of(b);
    using Value = typename std::decay_t<decltype(x)>::value_type;
    if (x.empty() || x.size() != y.size()) {
      EXPECT_EQ(x.size(), y.size()) << field.name;
      return;
    }
    double difference = 0.0, scale = scale_of(field.unit);
    // NOLINTNEXTLINE(bugprone-sizeof-expression): Value may be double
    constexpr std::size_t numbers = std::is_arithmetic_v<Value> ? 1 : sizeof(Value) / sizeof(double);
    const auto number = [](const Value& value, std::size_t k) {
      if constexpr (std::is_arithmetic_v<Value>) {
        return static_cast<double>(value);
      } else {
        return reinterpret_cast<const double*>(&value)[k];
      }
    };
    for (std::size_t i = 0; i < of_a.size(); ++i) {
      for (std::size_t k = 0; k < numbers; ++k) {
        const double u = number(x[of_a[i]], k), v = number(y[of_b[i]], k);
        difference = std::max(difference, std::abs(u - v));
        scale = std::max(scale, std::abs(u));
      }
    }
    if (scale > 0.0) largest = std::max(largest, difference / scale);
  });
  return largest;
}

/// Returns how often the particles have been copied to the host.
long fetches(Simulation& simulation) {
  const std::deque<solver::Profile::Stage>& stages = simulation.profile().stages();
  const auto found = std::ranges::find(stages, "device to host", &solver::Profile::Stage::name);
  return found == stages.end() ? 0 : found->calls;
}

/// Returns the largest difference of what the history shows, relative to the mass or the
/// energy; speeds, pressures and temperatures to 1 km/s, 1 GPa, 1000 K.
double difference_of_figures(const Simulation& host, const Simulation& device) {
  const auto figures_of = [](const Simulation& simulation) {
    std::vector<solver::PhaseMasses> masses(simulation.setup().bodies.size());
    solver::Figures f;
    simulation.add_figures(masses, f);
    const double mass = simulation.totals().mass,
                 energy = simulation.totals().internal_energy + simulation.totals().kinetic_energy;
    std::vector<double> values = {f.speed / 1e3,
                                  f.pressure / 1e9,
                                  f.temperature / 1e3,
                                  f.elastic_energy / energy,
                                  f.stored_energy / energy,
                                  f.stored_cold_work / energy};
    for (const solver::PhaseMasses& of_body : masses) {
      for (const double phase : of_body.mass) values.push_back(phase / mass);
      values.push_back(of_body.failed / mass);
    }
    return values;
  };
  const std::vector<double> expected = figures_of(host), found = figures_of(device);
  double largest = 0.0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    largest = std::max(largest, std::abs(found[i] - expected[i]));
  }
  return largest;
}

class DeviceStep : public testing::TestWithParam<Problem> {};

TEST_P(DeviceStep, IsThatOfTheHost) {
  const cases::Case setup = read(GetParam());
  Simulation host(setup, parallel::world());
  const OnDevice on_device(tested());
  Simulation device(setup, parallel::world());
  const auto compare = [&](int steps) {
    advance(host, steps);
    advance(device, steps);
    EXPECT_EQ(device.state().step, host.state().step);
    EXPECT_NEAR(device.state().time, host.state().time, 1e-8 * host.state().time);
    const long fetched = fetches(device);
    EXPECT_LT(difference_of_figures(host, device), steps == 1 ? GetParam().after_one : GetParam().after_many);
    EXPECT_EQ(fetches(device), fetched);
    return largest_difference(host.particles(), device.particles());
  };
  const double one = compare(1), many = compare(199);
  std::printf(
      "%s: %zu particles, largest difference of a field after one step %.1e, after 200 %.1e; energy "
      "error %.1e\n",
      GetParam().name.c_str(), device.particle_count(), one, many,
      device.state().ledger.energy_error(device.totals()));
  EXPECT_LT(one, GetParam().after_one);
  EXPECT_LT(many, GetParam().after_many);
  EXPECT_LT(std::abs(device.state().ledger.energy_error(device.totals())), 1e-12);
  EXPECT_LT(device.state().ledger.momentum_error(device.totals()), 1e-12);
}
INSTANTIATE_TEST_SUITE_P(Of, DeviceStep,
                         testing::Values(ball_at_wall("separating"), ball_at_wall("symmetry"),
                                         ball_at_wall("no_slip"), ball_at_wall("friction"), melting(),
                                         incline(), rings(), bar_in_ring(), section_at_wall()),
                         [](const auto& info) { return info.param.name; });

TEST(OnADevice, GivesTheSameBitsOnAnyNumberOfThreads) {
  const OnDevice on_device(tested());
  const int threads = parallel::threads();
  const cases::Case setup = read(ball_at_wall("friction"));
  parallel::set_threads(1);
  Simulation one(setup, parallel::world());
  advance(one, 60);
  parallel::set_threads(3);
  Simulation three(setup, parallel::world());
  advance(three, 60);
  parallel::set_threads(threads);
  expect_same(one, three);
  EXPECT_EQ(one.state().ledger.contact_heat, three.state().ledger.contact_heat);
}

TEST(OnADevice, OutputsChangeNoBitAndARestartGoesOnAsTheRun) {
  const OnDevice on_device(tested());
  const TemporaryFolder folder;
  const cases::Case setup = read(melting());
  Simulation whole(setup, parallel::world()), watched(setup, parallel::world());
  advance(whole, 55);
  for (int i = 0; i < 5; ++i) {
    advance(watched, 5);
    EXPECT_GT(watched.particles().size(), 0U);  // fetches them
  }
  const std::filesystem::path file = save(watched, folder.path());
  Simulation resumed = restored(setup, file, parallel::world());
  advance(watched, 30);
  advance(resumed, 30);
  expect_same(whole, watched);
  expect_same(whole, resumed);
}

TEST(OnADevice, SharesItsCheckpointsWithTheHost) {
  const TemporaryFolder folder;
  const cases::Case setup = read(ball_at_wall("separating"));
  Simulation host(setup, parallel::world());
  advance(host, 60);
  const auto switched = [&](Device first, Device then) {
    std::filesystem::path file;
    {
      const OnDevice device(first);
      Simulation simulation(setup, parallel::world());
      advance(simulation, 30);
      file = save(simulation, folder.path());
    }
    const OnDevice device(then);
    Simulation resumed = restored(setup, file, parallel::world());
    advance(resumed, 30);
    return largest_difference(host.particles(), resumed.particles());
  };
  EXPECT_LT(switched(Device::cpu, tested()), 1e-9);
  EXPECT_LT(switched(tested(), Device::cpu), 1e-9);
}

TEST(OnADevice, ParticlesThatLeaveAreBooked) {
  Problem problem = ball_at_wall("separating");
  problem.text.replace(problem.text.find("\"separating\""), 12, "\"outflow\"");
  const cases::Case setup = read(problem);
  Simulation host(setup, parallel::world());
  const OnDevice on_device(tested());
  Simulation device(setup, parallel::world());
  advance(host, 120);
  advance(device, 120);
  EXPECT_LT(device.particle_count(),
            0.9 * static_cast<double>(Simulation(setup, parallel::world()).particle_count()));
  EXPECT_LT(largest_difference(host.particles(), device.particles()), 1e-9);
  EXPECT_NEAR(device.state().ledger.outflow.mass, host.state().ledger.outflow.mass,
              1e-12 * host.state().ledger.outflow.mass);
  EXPECT_NEAR(device.state().outflow_of_body[0].energy, host.state().outflow_of_body[0].energy,
              1e-9 * host.state().outflow_of_body[0].energy);
  EXPECT_LT(std::abs(device.state().ledger.energy_error(device.totals())), 1e-12);
}

TEST(DeviceFaults, NameWhatADeviceDoesNotCompute) {
  struct Refused {
    std::string from, to, key;
  };
  const Problem problem = ball_at_wall("separating");
  const auto faults_of = [&](const std::string& from, const std::string& to) {
    Problem changed = problem;
    changed.text.replace(changed.text.find(from), from.size(), to);
    std::string keys;
    for (const InputFault& fault : solver::device_faults(read(changed))) {
      EXPECT_THAT(fault.text, testing::HasSubstr("device")) << fault.key;
      keys += fault.key + " ";
    }
    return keys;
  };
  EXPECT_EQ(faults_of("[time]", "[time]"), "");
  EXPECT_THAT(faults_of("[time]", "[time]\nscheme = \"musl\""), testing::HasSubstr("time.scheme"));
  EXPECT_THAT(faults_of("[transfer]", "[transfer]\nshape_function = \"cubic_bspline\""),
              testing::HasSubstr("transfer.shape_function"));
  EXPECT_THAT(faults_of("[transfer]", "[transfer]\nparticle_update = \"apic\""),
              testing::HasSubstr("transfer.particle_update"));
  EXPECT_THAT(faults_of("[transfer]", "[transfer]\naffine_field = \"turned\""),
              testing::HasSubstr("transfer.affine_field"));
  EXPECT_THAT(faults_of("[transfer]", "[transfer]\nrandom_shift = true"),
              testing::HasSubstr("transfer.random_shift"));
  EXPECT_THAT(faults_of("[transfer]", "[transfer]\nfree_flight = true"),
              testing::HasSubstr("transfer.free_flight"));
  EXPECT_THAT(faults_of("[transfer]", "[dissipation]\nlosses = \"heat\"\n[transfer]"),
              testing::HasSubstr("dissipation.losses"));
  EXPECT_THAT(faults_of("[transfer]", "[contact]\nnormal = \"logistic_regression\"\n[transfer]"),
              testing::HasSubstr("contact.normal"));
  EXPECT_THAT(
      faults_of("[transfer]", "[[load]]\nacceleration = [\"1 m/s^2\", \"0 m/s^2\", \"0 m/s^2\"]\n[transfer]"),
      testing::HasSubstr("load"));
  EXPECT_THAT(faults_of("name = \"ball\"", "name = \"ball\"\nvolumetric = \"cell\""),
              testing::HasSubstr("body.0.volumetric"));
  EXPECT_THAT(faults_of("copper_johnson_cook.toml", "concrete_35mpa_rht.toml"),
              testing::HasSubstr("body.0.material"));
}

}  // namespace
}  // namespace whipple::verification
