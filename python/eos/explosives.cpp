// SPDX-License-Identifier: BSD-3-Clause
#include "eos/loci/detonation_products.hpp"
#include "python/eos/bindings.hpp"
#include "python/eos/states.hpp"

namespace whipple::python {
namespace {

/// Holds detonation products with the material that owns their equation of state.
struct Detonation {
  explicit Detonation(const Material& explosive) : material(explosive), products(*material.eos) {}
  Material material;
  eos::DetonationProducts products;
};

Shocks wave(const Detonation& d) {
  Shocks shocks = make<Shocks>(d.material.eos, Points{}, 2);
  const eos::ShockState shock = d.products.wave();
  shocks.states[0] = shock.state;
  shocks.further[0][0] = shock.shock_velocity;
  shocks.further[1][0] = shock.particle_velocity;
  return shocks;
}

Isentropes expansion(const Detonation& d, const Numbers& volume) {
  const Points points = broadcast({volume});
  Isentropes result = make<Isentropes>(d.material.eos, points, 1);
  const std::span<const double> values = points.column(0);
  py::gil_scoped_release unlocked;
  const auto states = d.products.expansion({values.begin(), values.end()});
  for (std::size_t i = 0; i < states.size(); ++i) {
    result.states[i] = states[i].state;
    result.further[0][i] = states[i].riemann_velocity;
  }
  return result;
}

Impact contact(const Detonation& d, const Material& inert) {
  eos::ImpedanceMatch match;
  {
    py::gil_scoped_release unlocked;
    match = d.products.contact(eos::Hugoniot(*inert.eos));
  }
  Impact result{{},
                {match.pressure},
                {match.velocity},
                make<States>(d.material.eos, Points{}, 0),
                make<States>(inert.eos, Points{}, 0),
                {match.right_shock_velocity}};
  result.left.states[0] = match.left;
  result.right.states[0] = match.right;
  return result;
}

py::dict cylinder(const Detonation& d, const Numbers& displacement, double inner_radius, double wall,
                  double wall_density) {
  const Points points = broadcast({displacement});
  const std::span<const double> values = points.column(0);
  std::vector<eos::CylinderWall> walls;
  {
    py::gil_scoped_release unlocked;
    walls =
        eos::cylinder_test(d.products, {inner_radius, wall, wall_density}, {values.begin(), values.end()});
  }
  py::dict result;
  const auto add = [&](const char* name, double eos::CylinderWall::* member) {
    std::vector<double> column;
    for (const eos::CylinderWall& w : walls) column.push_back(w.*member);
    result[name] = array_of(points.shape, column);
  };
  add("displacement", &eos::CylinderWall::displacement);
  add("radial_speed", &eos::CylinderWall::radial_speed);
  add("material_speed", &eos::CylinderWall::material_speed);
  add("angle", &eos::CylinderWall::angle);
  add("volume", &eos::CylinderWall::volume);
  add("pressure", &eos::CylinderWall::pressure);
  return result;
}

py::object gurney_speed(eos::GurneyShape shape, const Numbers& gurney_velocity, const Numbers& mass_ratio) {
  const Points points = broadcast({gurney_velocity, mass_ratio});
  std::vector<double> speeds;
  for (std::size_t i = 0; i < points.size; ++i) {
    speeds.push_back(eos::gurney_speed(shape, points.column(0)[i], points.column(1)[i]));
  }
  return array_of(points.shape, speeds);
}

}  // namespace

void add_explosives(py::module_& module, py::class_<Material>& material) {
  using eos::GurneyShape;
  py::enum_<GurneyShape> shapes(module, "GurneyShape", "Arrangements of metal and explosive.");
  for (const auto& [word, shape] : eos::gurney_shapes) shapes.value(word, shape);

  py::class_<Detonation>(
      module, "Detonation",
      "The products of an explosive behind a plane detonation wave, and what they drive (SI units;\n"
      "volumes relative to that of the explosive).")
      .def_property_readonly(
          "wave", &wave, "Chapman-Jouguet state of the products; shock_velocity is the detonation velocity.")
      .def_property_readonly(
          "volume", [](const Detonation& d) { return d.products.chapman_jouguet_volume(); },
          "Relative volume of the Chapman-Jouguet state.")
      .def_property_readonly(
          "adiabatic_exponent", [](const Detonation& d) { return d.products.adiabatic_exponent(); },
          "rho c^2/p of the Chapman-Jouguet state, without unit.")
      .def("expansion", &expansion, py::arg("volume"),
           "Compute products on the isentrope from the Chapman-Jouguet state at rising relative volumes.\n\n"
           "energy counts from the zero of the products, so that energy over that of the reference state is "
           "the\n"
           "fraction of the explosive's energy that they still hold.")
      .def(
          "gurney_velocity",
          [](const Detonation& d, double volume) { return d.products.gurney_velocity(volume); },
          py::arg("volume") = 7.0,
          "Compute Gurney's velocity (m/s) from the energy given off up to a relative volume.")
      .def("contact", &contact, py::arg("inert"),
           "Compute pressure and velocity where the wave meets inert material at normal incidence.\n\n"
           "The property projectile of the result holds the products, target the inert material.")
      .def(
          "cylinder", &cylinder, py::arg("displacement"), py::kw_only(), py::arg("inner_radius") = 12.7e-3,
          py::arg("wall") = 2.6e-3, py::arg("wall_density") = 8930.0,
          "Compute the wall of a cylinder test at displacements (m) of its outer surface, by steady flow.\n\n"
          "inner_radius, wall: radius of the charge and thickness of the tube, m; wall_density: kg/m^3.\n"
          "A dictionary of arrays: displacement (m), radial_speed of the outer surface and material_speed of "
          "the\n"
          "wall (m/s), angle (rad), relative volume and pressure (Pa) of the products.");
  material.def(
      "detonation", [](const Material& m) { return Detonation(m); }, py::call_guard<py::gil_scoped_release>(),
      "Compute the detonation wave of an explosive. Raises InputError for other materials.");
  module.def("gurney_speed", &gurney_speed, py::arg("shape"), py::arg("gurney_velocity"),
             py::arg("mass_ratio"),
             "Compute the speed (m/s) of driven metal by Gurney's formulas.\n\n"
             "gurney_velocity: m/s; mass_ratio: mass of the metal over that of the explosive.");
}

}  // namespace whipple::python
