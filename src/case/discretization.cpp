// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/discretization.hpp"

#include <fmt/format.h>

#include <cmath>

#include "src/case/case.hpp"
#include "src/core/base/text.hpp"
#include "src/transfer/shape_function.hpp"

namespace whipple::cases {

ParameterTable<Discretization> Discretization::parameters() {
  using D = Discretization;
  return {
      choice("method", &D::method,
             "particles | eight-node hexahedra | hexahedra that become particles when distorted "
             "([body.conversion]) | trusses (reinforcement bars) that carry axial forces and move with the "
             "surrounding material ([[body.bar]])")
          .optional(),
      integer("per_cell", &D::per_cell, range::between(1, 1000), "particles per full cell: 1, 8, 27 or 64")
          .optional(),
      choice("lattice", &D::lattice,
             "places of the particles in a cell at the start: at the middles of equal parts of it | eight "
             "(in the "
             "plane four) in as many layers along every axis, for solids that cross many cells")
          .optional(),
      boolean("partial_volumes", &D::partial_volumes,
              "particles at curved or oblique surfaces have the part of their volume that is inside the body")
          .optional("true"),
      real("element_size", &D::element_size, "m", range::positive(), "edge of the elements, at most 2 cells")
          .optional("cell_size"),
      choice("element", &D::element,
             "quadrature: one point with hourglass control | 2 x 2 x 2 points with the mean volumetric "
             "strain of "
             "the element")
          .optional(),
      choice("hourglass", &D::hourglass,
             "hourglass control: proportional to the amplitude | to the rate of the modes")
          .optional(),
      real("hourglass_coefficient", &D::hourglass_coefficient, "", range::between(0.0, 1.0),
           "hourglass coefficient: fraction of the largest stiffness or of the critical damping")
          .optional(),
      text("mesh", &D::mesh,
           "file of Gmsh (2.2 or 4.1), Abaqus or VTK (.vtu, .vtk) with the hexahedra of the body instead of "
           "a shape: its finite elements, or what its particles fill")
          .optional(),
      real("mesh_unit", &D::mesh_unit, "m", range::positive(), "length of a unit of the mesh file")
          .optional(),
      text("group", &D::group,
           "physical group (Gmsh), element set (Abaqus) or array and value (VTK: \"body 1\") in the mesh "
           "file; empty: the only one")
          .optional(),
      real("bar_diameter", &D::bar_diameter, "m", range::non_negative(), "diameter of the bars").optional(),
      real("bar_failure_strain", &D::bar_failure_strain, "", range::positive(),
           "plastic strain at which a bar breaks")
          .optional("never")};
}

double Discretization::size(double cell_size) const {
  return std::isfinite(element_size) ? element_size : cell_size;
}

ParameterTable<Conversion> Conversion::parameters() {
  using C = Conversion;
  return {
      real("plastic_strain", &C::plastic_strain, "", range::positive(),
           "equivalent plastic strain above which an element becomes particles")
          .optional("never"),
      real("time_step_ratio", &C::time_step_ratio, "", range::between(0.0, 1.0),
           "ratio of its stable time step to that of the grid below which an element becomes particles; 0: "
           "never")
          .optional(),
      real("jacobian", &C::jacobian, "", range::between(0.0, 1.0),
           "ratio of its smallest to its mean Jacobian below which an element becomes particles; 0: never")
          .optional(),
      boolean("failed", &C::failed, "an element becomes particles when its material has failed").optional()};
}

ParameterTable<ElementRange> ElementRange::parameters() {
  using R = ElementRange;
  return {
      choice(
          "beyond", &R::beyond,
          "an element that leaves its valid range becomes particles | is deleted, counted as outflow | stops "
          "the run")
          .optional(),
      real("jacobian", &R::jacobian, "", range::between(0.0, 1.0),
           "smallest valid ratio of the Jacobian at a corner to the mean one")
          .optional(),
      real("time_step_ratio", &R::time_step_ratio, "", range::between(0.0, 1.0),
           "smallest valid ratio of its stable time step to that of the grid; 0: any")
          .optional(),
      real("hourglass_share", &R::hourglass_share, "", range::positive(),
           "largest valid ratio of its hourglass energy to its internal energy (an element in bending stores "
           "hourglass energy only)")
          .optional("any"),
      real("speed", &R::speed, "m/s", range::positive(), "largest valid speed of its nodes").optional("any"),
      real("plastic_strain", &R::plastic_strain, "", range::positive(),
           "largest valid equivalent plastic strain; with beyond = \"remove\" elements are eroded")
          .optional("any"),
      boolean("failed", &R::failed, "an element whose material has failed is beyond its range").optional(),
      choice(
          "pieces", &R::pieces,
          "with beyond = \"remove\": pieces of the body that deletion has parted do not feel each other | "
          "touch "
          "each other as bodies do: the largest one in the velocity field of the body, fifteen in fields of "
          "their own, further ones in these in turn")
          .optional()};
}

ParameterTable<BarRow> BarRow::parameters() {
  using B = BarRow;
  return {vector("from", &B::from, "m", range::any(), "first end"),
          vector("to", &B::to, "m", range::any(),
                 "second end; on a mirror plane for a bar that continues through it"),
          integer("count", &B::count, range::between(1, 100000), "number of parallel bars").optional(),
          vector("step", &B::step, "m", range::any(), "offset from one bar to the next").optional(),
          real("number", &B::number, "", range::positive(),
               "in two dimensions: how many such bars a metre of depth, or all of the ring, holds; equal "
               "ends in an axisymmetric domain are a hoop")
              .optional()};
}

ParameterTable<NodeCondition> NodeCondition::parameters() {
  using N = NodeCondition;
  return {vector("lower", &N::lower, "m", range::any(), "corner of a box that contains the nodes initially"),
          vector("upper", &N::upper, "m", range::any(), "opposite corner of the box"),
          text_list("directions", &N::directions, {"x", "y", "z"}, "prescribed directions"),
          vector("velocity", &N::velocity, "m/s", range::any(), "prescribed velocity").optional()};
}

void Discretization::read_rest(input::Table& table) {
  partial_volumes_given = table.has("partial_volumes");
  if (!mesh.empty()) mesh = std::filesystem::absolute(table.folder() / mesh).lexically_normal().string();
}

namespace {

void check_elements(const Discretization& control, const Case& setup, const Faults& faults) {
  if (setup.time.scheme != Scheme::symplectic) {
    faults.add("method",
               fmt::format("finite elements work with time.scheme = \"symplectic\" only, not \"{}\"",
                           word_of(setup.time.scheme)));
  }
  if (!transfer::carries_affine_field(setup.transfer.shape_function)) {
    faults.add("method", fmt::format("finite elements work with B-splines only, not with "
                                     "transfer.shape_function = \"{}\"",
                                     word_of(setup.transfer.shape_function)));
  }
  if (setup.heat.conduction) {
    faults.add("method", "finite elements do not conduct heat: heat.conduction must be off");
  }
  if (control.is_bars()) {
    if (!(control.bar_diameter > 0.0)) faults.add("method", "bars need a 'bar_diameter'");
    if (!control.mesh.empty()) faults.add("mesh", "bars are listed in [[body.bar]], not in a 'mesh'");
  }
  if (control.partial_volumes) {
    faults.add("partial_volumes", "'partial_volumes' belongs to bodies of particles");
  }
  const double size = control.size(setup.domain.cell_size);
  if (!(size <= 2.0 * setup.domain.cell_size)) {
    faults.add("element_size",
               fmt::format("'element_size' is {} m; the grid, which carries contact and conversion, takes "
                           "elements of at most 2 cells, {} m",
                           size, 2.0 * setup.domain.cell_size));
  }
}

/// Adds faults for layered lattices. A ring must be at the radius that balances a uniform pressure, so it cannot be
/// offset.
void check_layers(const Discretization& control, const Case& setup, const Faults& faults) {
  if (setup.geometry.is_axisymmetric()) {
    faults.add("lattice",
               "lattice = \"layered\" works in three dimensions and in the plane, not for the rings of "
               "an axisymmetric domain");
  }
  if (!control.has_particles() && !control.converts()) {
    faults.add("lattice", fmt::format("'lattice' belongs to bodies of particles and of elements that become "
                                      "particles; method = \"{}\" has none",
                                      word_of(control.method)));
  }
}

}  // namespace

void Discretization::check(const Case& setup, const Faults& faults) const {
  const double edge = std::cbrt(static_cast<double>(per_cell));
  if (std::abs(edge - std::round(edge)) > 1e-9) {
    faults.add("per_cell", fmt::format("'per_cell' is {}, expected a cube: 1, 8, 27, 64", per_cell));
  }
  if (lattice == Arrangement::layered) check_layers(*this, setup, faults);
  if (has_elements() || is_bars()) {
    check_elements(*this, setup, faults);
  }
  if (utf8(mesh) != mesh) {  // run.toml contains the path, and TOML strings are UTF-8
    faults.add("mesh",
               fmt::format("'mesh' is {}: a run could not name this file again: rename what is not UTF-8",
                           utf8(mesh)));
  }
  if (mesh.empty() && !group.empty()) {
    faults.add("group", "'group' names a group of a mesh file: give 'mesh' as well");
  }
}

}  // namespace whipple::cases
