// SPDX-License-Identifier: BSD-3-Clause
// Two copper plates collide at 1 km/s: the pressure behind the shock by the Hugoniot of the equation of state, and by a
// simulation whose case is built here. Ends with 0 if they agree within 3 %.
#include <mpi.h>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>
#include <whipple/case/case.hpp>
#include <whipple/case/shapes.hpp>
#include <whipple/core/base/error.hpp>
#include <whipple/core/base/log.hpp>
#include <whipple/core/parallel/threads.hpp>
#include <whipple/eos/loci/hugoniot.hpp>
#include <whipple/material/material_file.hpp>
#include <whipple/solver/simulation.hpp>

namespace {

using whipple::Vector3;
namespace cases = whipple::cases;

constexpr double width = 0.1e-3, speed = 1e3;  // m, m/s

cases::Body plate(const char* name, double lower, double upper, double velocity) {
  cases::Body body;
  body.name = name;
  body.material = MATERIALS "/copper.toml";
  body.velocity = Vector3(0.0, 0.0, velocity);
  body.shape = std::make_shared<cases::Box>(Vector3(0.0, 0.0, lower), Vector3(width, width, upper));
  return body;
}

/// One column of cells between mirror planes.
cases::Case impact() {
  cases::Case setup;
  setup.domain.lower = Vector3(0.0, 0.0, -2e-3);
  setup.domain.upper = Vector3(width, width, 2e-3);
  setup.domain.cell_size = 0.5 * width;
  cases::Faces& faces = setup.domain.boundary;
  faces.x_lower = faces.x_upper = faces.y_lower = faces.y_upper = whipple::grid::Boundary::symmetry;
  setup.time.end = 0.15e-6;
  setup.bodies = {plate("flyer", -1e-3, 0.0, speed), plate("target", 0.0, 1e-3, 0.0)};
  return setup;
}

/// Mean pressure (Pa) of the particles of this rank within a distance (m) of the contact face, which moves at half the
/// speed of the flyer.
double pressure_near_contact(const whipple::solver::Simulation& simulation, double distance) {
  const whipple::Particles& particles = simulation.particles();
  const double face = 0.5 * speed * simulation.state().time;
  double sum = 0.0, volume = 0.0;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    if (std::abs(particles.position[p][2] - face) > distance) continue;
    sum += particles.pressure[p] * particles.volume[p];
    volume += particles.volume[p];
  }
  return sum / volume;
}

int compare() {
  const whipple::Material copper = whipple::read_material(MATERIALS "/copper.toml");
  const whipple::eos::EquationOfState& eos = *copper.eos;
  const whipple::eos::State hot = eos.state_at_temperature(eos.reference_density(), 1000.0);
  const double expected = whipple::eos::Hugoniot(eos).at_particle_velocity(0.5 * speed).state.pressure;
  std::printf("copper at %g kg/m^3 and 1000 K: %.3f GPa\n", hot.density, 1e-9 * hot.pressure);

  // Faults are data: each has its key and a text.
  cases::Case setup = impact();
  setup.time.end = -1.0;
  for (const whipple::InputFault& fault : cases::check(setup))
    std::printf("refused: %s: %s\n", fault.key.c_str(), fault.text.c_str());

  setup = cases::complete(impact());
  whipple::solver::Simulation simulation(setup, MPI_COMM_WORLD);
  while (simulation.state().time < setup.time.end) simulation.advance(setup.time.end);
  const double pressure = pressure_near_contact(simulation, 0.3e-3);
  std::printf("behind the shock: %.2f GPa in %lld steps, %.2f GPa by the Hugoniot\n", 1e-9 * pressure,
              static_cast<long long>(simulation.state().step), 1e-9 * expected);
  return std::abs(pressure / expected - 1.0) < 0.03 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  whipple::parallel::set_threads(1);
  whipple::log::set_sink(
      [](whipple::log::Kind, const std::string& message) { std::printf("log: %s\n", message.c_str()); });
  int code = 1;
  try {
    code = compare();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
  }
  MPI_Finalize();
  return code;
}
