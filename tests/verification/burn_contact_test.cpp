// SPDX-License-Identifier: BSD-3-Clause
// Products of an explosive against metal: the impedance match.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "eos/detonation.hpp"
#include "eos/loci/detonation_products.hpp"
#include "src/material/material_file.hpp"
#include "tests/verification/burn_columns.hpp"
#include "tests/verification/exact/runs.hpp"

namespace whipple::verification {
namespace {

/// Writes the file of a metal without strength.
/// @returns its path
std::string fluid_metal(const std::string& name, double density, double intercept, double slope,
                        double gruneisen) {
  return write_material(name, fmt::format(R"toml(
name = "{}"
source = "verification"
[eos]
model = "mie_gruneisen"
source = "verification"
reference_density = "{} kg/m^3"
hugoniot_intercept = "{} m/s"
hugoniot_slope = {}
gruneisen = {}
heat_capacity = "400 J/(kg K)"
[strength]
model = "none"
)toml",
                                          name, density, intercept, slope, gruneisen));
}

// Products in a uniform Chapman-Jouguet state, moving with its velocity, meet metal: between the two waves that leave
// the contact are the pressure and velocity of the impedance match, without the decay of a Taylor wave. Cubic
// functions, as the quadratic ones are 1 to 2 % low because of the noise behind shocks (docs/theory/burn.md, 7).
TEST(BurntProducts, MeetMetalAtTheImpedanceMatch) {
  constexpr double length = 0.02, h = 2.5e-4, end = 1.6e-6;
  const auto tnt = read_material("tnt").eos;
  const eos::DetonationProducts products(*tnt);
  const eos::ChapmanJouguet& cj = products.chapman_jouguet();
  for (const std::string& file : {fluid_metal("fluid_copper", 8930, 3940, 1.489, 1.99),
                                  fluid_metal("fluid_aluminium", 2703, 5350, 1.34, 2.0)}) {
    SCOPED_TRACE(file);
    const auto metal = read_material(file).eos;
    const eos::ImpedanceMatch match = products.contact(eos::Hugoniot(*metal));
    std::string text = column("tnt", length, h, "detonation = \"instantaneous\"\n");
    text.replace(text.find("0.022"), 5, "0.036");
    text += fmt::format(
        "[[body]]\nname = \"metal\"\nmaterial = \"{}\"\nshape = {{ box = {{ lower = [{}, 0], upper = [0.036, "
        "{}] }} }}\n",
        file, length, h);
    const cases::Case setup =
        exact::default_case(end, text, "[transfer]\nshape_function = \"cubic_bspline\"\n");
    solver::Simulation simulation = exact::start_with(setup, [&](Particles& q) {
      for (std::size_t p = 0; p < q.size(); ++p) {
        if (q.body[p] != 0) continue;
        q.mass[p] *= cj.state.density / tnt->reference_density();
        q.specific_internal_energy[p] = cj.state.specific_internal_energy;
        q.pressure[p] = cj.state.pressure;
        q.velocity[p][0] = cj.particle_velocity;
      }
    });
    run_to(simulation, end);
    const Particles& q = simulation.particles();
    exact::Mean pressure[2], velocity[2];  // of products and metal
    for (std::size_t p = 0; p < q.size(); ++p) {
      const double ahead = q.position[p][0] - (length + match.velocity * end);
      if (std::abs(ahead) < 2 * h || ahead > 5e-3 || ahead < -3e-3) continue;
      pressure[q.body[p]].add(q.pressure[p], q.mass[p]);
      velocity[q.body[p]].add(q.velocity[p][0], q.mass[p]);
    }
    for (const int side : {0, 1}) {
      EXPECT_NEAR(pressure[side].value() / match.pressure, 1.0, 0.01) << side;
      EXPECT_NEAR(velocity[side].value() / match.velocity, 1.0, 0.01) << side;
      std::printf("side %d: pressure %.4f and velocity %.4f of the match\n", side,
                  pressure[side].value() / match.pressure, velocity[side].value() / match.velocity);
    }
  }
}

}  // namespace
}  // namespace whipple::verification
