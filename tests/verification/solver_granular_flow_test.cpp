// SPDX-License-Identifier: BSD-3-Clause
// Dense flow of dry grains down an incline (docs/theory/soil.md, section 4): the steady profile of Bagnold.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include "tests/verification/contact_problems.hpp"

namespace whipple::verification {
namespace {

/// A layer of glass beads on a rough incline. At tan(theta) = mu(I) the shear rate is (I/d) sqrt(phi g cos(theta) (H -
/// y)). The layer is periodic along the incline: three periods are computed, and the state of the middle one is copied to
/// the others before the sound from their free ends can reach it.
struct Layer {
  static constexpr double height = 0.04, period = 2.0 * height, margin = height, grain = 0.01;
  static constexpr double angle = 25.0 * std::numbers::pi / 180.0, gravity = 9.81;
  static constexpr double static_friction = 0.382, limiting_friction = 0.643, reference_number = 0.279;
  static constexpr double fraction = 0.6;
  int cells = 10;    ///< over the height
  double end = 0.3;  // s

  [[nodiscard]] static double inertial_number() {
    const double tangent = std::tan(angle);
    return reference_number * (tangent - static_friction) / (limiting_friction - tangent);
  }
  /// Returns the velocity at a height above the base, m/s.
  [[nodiscard]] static double velocity(double y) {
    const double rate = inertial_number() / grain * std::sqrt(fraction * gravity * std::cos(angle));
    return 2.0 / 3.0 * rate * (std::pow(height, 1.5) - std::pow(std::max(height - y, 0.0), 1.5));
  }
  [[nodiscard]] static std::string material() {
    return write_material("beads", R"toml(
name = "beads"
source = "Jop, Forterre and Pouliquen (2006)"
[eos]
model = "polynomial"
source = "test"
reference_density = "1470 kg/m^3"
C1 = "0.5 MPa"
C4 = 0
C5 = 0
C6 = 0
heat_capacity = "1000 J/(kg K)"
[strength]
model = "granular_flow"
source = "Jop, Forterre and Pouliquen (2006); large grains, so that the layer is slow"
shear_modulus = "0.3 MPa"
static_friction = 0.382
limiting_friction = 0.643
reference_number = 0.279
grain_size = "10 mm"
grain_density = "2450 kg/m^3"
)toml");
  }
  [[nodiscard]] cases::Case read() const {
    return cases::read_case_text(
        Method{}.time_toml(end) + Method{}.toml() +
            "[output]\nmaximum_energy_error = 1e9\n[domain]\ndimension = \"plane_strain\"\nlower = [0, "
            "0]\nupper = " +
            vector3({2.0 * margin + 3.0 * period, 1.5 * height, 0}) + "\ncell_size = " +
            number(height / cells) + "\nboundary = { y_lower = \"no_slip\" }\n[gravity]\nacceleration = " +
            vector3({0, -gravity * std::cos(angle), 0}) +
            "\n[[load]]\nacceleration = " + vector3({gravity * std::sin(angle), 0, 0}) + "\n" +
            BodyOptions{"beads", material(), box({margin, 0, -1}, {margin + 3.0 * period, height, 1}),
                        Vector3::Zero(),
                        "volumetric = \"cell\"\ninitial = { lithostatic = { surface = " + number(height) +
                            ", k0 = 1 } }\n"}
                .toml(),
        "incline.toml");
  }
};

/// Holds the three images of the particles of a periodic layer, by their ids.
class Images {
 public:
  explicit Images(const Particles& particles) {
    std::map<std::array<long, 2>, std::array<std::uint64_t, 3>> of_place;
    for (std::size_t p = 0; p < particles.size(); ++p) {
      const double x = (particles.position[p][0] - Layer::margin) / Layer::period;
      const double image = std::floor(x);
      of_place[{std::lround(1e6 * (x - image)), std::lround(1e9 * particles.position[p][1])}]
              [static_cast<std::size_t>(image)] = particles.id[p];
    }
    for (const auto& [place, ids] : of_place) triples_.push_back(ids);
  }
  /// Copies the state of the middle images, back in the middle period, to the outer ones.
  void repeat(Particles& particles) const {
    std::vector<std::size_t> of_id(particles.size());
    for (std::size_t p = 0; p < particles.size(); ++p) of_id[particles.id[p]] = p;
    for (const std::array<std::uint64_t, 3>& ids : triples_) {
      const std::size_t middle = of_id[ids[1]];
      const double x = (particles.position[middle][0] - Layer::margin) / Layer::period;
      particles.position[middle][0] = Layer::margin + Layer::period * (1.0 + x - std::floor(x));
      for (const std::size_t image : {0UL, 2UL}) {
        const std::size_t to = of_id[ids[image]];
        std::apply(
            [&](const auto&... field) {
              const auto copy = [&](auto& values) {
                if (!values.empty()) values[to] = values[middle];
              };
              (copy(field.of(particles)), ...);
            },
            Particles::fields());
        particles.id[to] = ids[image];
        particles.position[to][0] += (static_cast<double>(image) - 1.0) * Layer::period;
      }
    }
  }
  [[nodiscard]] const std::vector<std::array<std::uint64_t, 3>>& triples() const { return triples_; }

 private:
  std::vector<std::array<std::uint64_t, 3>> triples_;
};

/// Runs a layer from its exact state.
/// @returns root of the mean square of the error of the velocity of its particles, over the velocity of the surface
double profile_error(const Layer& layer) {
  const cases::Case setup = layer.read();
  Particles particles = cases::seed(setup).particles;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double y = particles.position[p][1], step = 1e-6 * Layer::height;
    particles.velocity[p] = {Layer::velocity(y), 0.0, 0.0};
    particles.affine_velocity[p](0, 1) =
        (Layer::velocity(y + step) - Layer::velocity(y - step)) / (2.0 * step);
    particles.deviatoric_stress[p].xy = std::tan(Layer::angle) * particles.pressure[p];
  }
  const Images images(particles);
  solver::Simulation simulation(setup, particles, {}, parallel::world());
  for (int step = 0; simulation.state().time < layer.end; ++step) {
    if (step % (2 * layer.cells) == 0) {  // sound crosses half a cell in a step
      particles = simulation.particles();
      images.repeat(particles);
      const solver::RunState state = simulation.state();
      simulation = solver::Simulation(setup, particles, state, parallel::world());
    }
    simulation.advance(layer.end);
  }
  particles = simulation.particles();
  std::vector<std::size_t> of_id(particles.size());
  for (std::size_t p = 0; p < particles.size(); ++p) of_id[particles.id[p]] = p;
  double square = 0.0;
  for (const std::array<std::uint64_t, 3>& ids : images.triples()) {
    const std::size_t p = of_id[ids[1]];
    const double error = particles.velocity[p][0] - Layer::velocity(particles.position[p][1]);
    square += error * error / static_cast<double>(images.triples().size());
  }
  return std::sqrt(square) / Layer::velocity(Layer::height);
}

// The surface has moved by more than the height, in 1.4 of the times u/(g cos(theta) (tan(theta) - mu_s)) in
// which the layer would come to its velocity from rest.
TEST(GranularFlowDownAnIncline, TheProfileIsThatOfBagnoldWithSecondOrder) {
  double coarse = 0.0;
  for (const int cells : {5, 10, 20}) {
    const double error = profile_error({.cells = cells});
    std::printf("%d cells: error %.3e of the velocity of the surface, %.4f m/s\n", cells, error,
                Layer::velocity(Layer::height));
    if (coarse > 0.0) {
      EXPECT_GT(std::log2(coarse / error), 1.8);  // order
    }
    coarse = error;
  }
  EXPECT_LT(coarse, 0.0025);
}

}  // namespace
}  // namespace whipple::verification
