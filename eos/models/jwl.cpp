// SPDX-License-Identifier: BSD-3-Clause
// Equation numbers: docs/theory/equations_of_state.md.
#include "eos/models/jwl.hpp"

#include <fmt/core.h>

#include <cmath>

#include "eos/constant_heat_capacity_batch.hpp"
#include "eos/detonation.hpp"
#include "src/core/base/log.hpp"

namespace whipple::eos {

template class ConstantHeatCapacity<JwlCurve>;

namespace {

// Published sets give D to four digits, the pressure to three; a set with larger deviations is not self-consistent.
constexpr double velocity_tolerance = 0.005;
constexpr double pressure_tolerance = 0.02;

}  // namespace

ParameterTable<JwlConstants> JwlCurve::parameters() {
  using C = JwlConstants;
  return {
      real("reference_density", &C::reference_density, "kg/m^3", range::positive(), "rho0 of the explosive"),
      real("pressure_1", &C::pressure_1, "Pa", range::positive(), "A"),
      real("pressure_2", &C::pressure_2, "Pa", range::any(), "B"),
      real("exponent_1", &C::exponent_1, "", range::positive(), "R1, of exp(-R1 rho0/rho)"),
      real("exponent_2", &C::exponent_2, "", range::positive(), "R2"),
      real("gruneisen", &C::gruneisen, "", range::positive(), "omega, Grueneisen parameter"),
      real("detonation_energy", &C::detonation_energy, "J/m^3", range::positive(),
           "E0, energy set free per volume of the explosive"),
      real("heat_capacity", &C::heat_capacity, "J/(kg K)", range::positive(),
           "c_v of the products, constant"),
      real("detonation_velocity", &C::detonation_velocity, "m/s", range::non_negative(),
           "D, to check the constants against")
          .optional("none"),
      real("chapman_jouguet_pressure", &C::chapman_jouguet_pressure, "Pa", range::non_negative(),
           "p_CJ, to check the constants against")
          .optional("none"),
  };
}

JwlCurve::JwlCurve(const Constants& constants) : constants_(constants) {
  const LinearIsochore explosive = isochore(broadcast(reference_density()));
  reference_temperature_ = (reference_energy() - explosive.cold_energy[0]) / constants_.heat_capacity;
  if (!(reference_temperature_ > 1)) {
    throw InputError(
        fmt::format("jwl: detonation_energy ({:.4g} J/m^3) is below the cold energy of the products at the "
                    "density of the "
                    "explosive ({:.4g} J/m^3); check the constants and their energy zero",
                    constants_.detonation_energy, explosive.cold_energy[0] * reference_density()));
  }
  const Response r = explosive.response(broadcast(reference_energy()));
  reference_sound_speed_ = std::sqrt(r.squared_sound_speed[0]);
  check_detonation();
}

void JwlCurve::check_detonation() const {
  const auto products = [this](double density, double energy) {
    const Response r = isochore(broadcast(density)).response(broadcast(energy));
    State s;
    s.density = density;
    s.pressure = r.pressure[0];
    s.sound_speed = std::sqrt(r.squared_sound_speed[0]);
    return s;
  };
  const auto compare = [](const char* what, double given, double found, double tolerance, const char* unit) {
    if (given > 0 && std::abs(found / given - 1) > tolerance) {
      log::warning(
          "jwl: the constants yield {} {:.5g} {}, not the {:.5g} {} given: they belong to different sets",
          what, found, unit, given, unit);
    }
  };
  try {
    const ChapmanJouguet cj =
        chapman_jouguet(products, {reference_density(), reference_energy()}, maximum_density());
    compare("a detonation velocity of", constants_.detonation_velocity, cj.detonation_velocity,
            velocity_tolerance, "m/s");
    compare("a Chapman-Jouguet pressure of", constants_.chapman_jouguet_pressure, cj.state.pressure,
            pressure_tolerance, "Pa");
  } catch (const StateError& error) {
    throw InputError(fmt::format("jwl: {}; check the constants", error.what()));
  }
}

double JwlCurve::log_isentrope_temperature(double rho) const {
  return constants_.gruneisen * std::log(rho / reference_density());
}

}  // namespace whipple::eos
