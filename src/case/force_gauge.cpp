// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/force_gauge.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "src/case/case.hpp"

namespace whipple::cases {

ParameterTable<ForceGauge> ForceGauge::parameters() {
  using G = ForceGauge;
  return {text("name", &G::name, "name of its columns in gauges.csv"),
          text("body", &G::body, "body on which walls and other bodies act").optional(),
          choice("face", &G::face, "face of the domain on which the material acts").optional("none"),
          vector("about", &G::about, "m", range::any(), "point to which the moment refers").optional()};
}

std::span<const Section<ForceGauge>> ForceGauge::sections() {
  static const std::vector<Section<ForceGauge>> all = {
      section<&ForceGauge::box>("box", ", the patch of the face inside it")};
  return all;
}

void ForceGauge::check(const Case& setup, const Faults& faults) const {
  check_name_of_gauge(name, faults);
  const auto others = {std::ranges::count(setup.force_gauges.begin(),
                                          setup.force_gauges.begin() + (this - setup.force_gauges.data()),
                                          name, &ForceGauge::name),
                       std::ranges::count(setup.all_gauges(), name, &Gauge::name)};
  if (!name.empty() && std::ranges::any_of(others, [](auto count) { return count > 0; }))
    faults.add("name", fmt::format("two gauges are called \"{}\"", name));
  if (setup.transfer.particle_update == ParticleUpdate::fmpm) {
    faults.add(
        "",
        "forces are those of the nodes, which particle_update = \"fmpm\" changes after contact: choose "
        "another one");
  }
  if (body.empty() == (face == Face::none)) {
    faults.add("", fmt::format("a force is that on a 'body' or that on a 'face': {} given",
                               body.empty() ? "none" : "both"));
    return;
  }
  if (box && face == Face::none) faults.add("box", "'box' is that of a patch of a 'face'");
  if (!body.empty() && std::ranges::count(setup.bodies, body, &Body::name) == 0) {
    std::string names;
    for (const Body& known : setup.bodies) names += (names.empty() ? "" : ", ") + known.name;
    faults.add("body", fmt::format("there is no body \"{}\" (accepted: {})", body, names));
  }
  if (setup.domain.is_planar() && face != Face::none && static_cast<int>(face) / 2 == 2) {
    faults.add("face", "in two dimensions there is no face across z");
  } else if (face != Face::none && setup.geometry.cell_size > 0.0) {
    check_face(setup, faults);
  }
}

/// Adds faults for a face that transmits no force, and for a patch that is no part of the face.
void ForceGauge::check_face(const Case& setup, const Faults& faults) const {
  const grid::Geometry& geometry = setup.geometry;
  const auto number = static_cast<std::size_t>(face);
  if (geometry.is_axisymmetric() && face == Face::y_lower) {
    faults.add("face", "no force acts on the axis of rings: it has no area");
  } else if (geometry.boundary[number] == grid::Boundary::outflow) {
    faults.add("face",
               fmt::format("'{}' is of kind \"outflow\": material passes it without a force", word_of(face)));
  }
  if (!box) return;
  const int across = static_cast<int>(face) / 2;
  for (int a = 0; a < (geometry.is_planar() ? 2 : 3); ++a) {
    const double plane = static_cast<int>(face) % 2 == 0 ? geometry.lower[a] : geometry.upper(a);
    const double from = a == across ? plane : geometry.lower[a], to = a == across ? plane : geometry.upper(a);
    const double tolerance = a == across ? -geometry.tolerance() : geometry.tolerance();
    if (box->lower[a] < to - tolerance && box->upper[a] > from + tolerance) continue;
    faults.add("box", fmt::format(
                          "the patch touches no part of '{}', which is at {} = {:.6g} m to {:.6g} m: the box "
                          "has {:.6g} m to {:.6g} m",
                          word_of(face), "xyz"[a], from, to, box -> lower[a], box -> upper[a]));
  }
}

std::size_t ForceGauge::body_number(const Case& setup) const {
  return static_cast<std::size_t>(std::ranges::find(setup.bodies, body, &Body::name) - setup.bodies.begin());
}

void check_bodies_of_force_gauges(const Case& setup, const Faults& faults) {
  for (std::size_t i = 0; i < setup.force_gauges.size(); ++i) {
    const ForceGauge& gauge = setup.force_gauges[i];
    if (gauge.body.empty()) continue;
    const std::size_t own = gauge.body_number(setup);
    if (!has_inertia(setup.time.scheme)) {  // the force that holds the nodes of a driven body
      if (!setup.bodies[own].driven) {
        faults.in("force_gauge")
            .in(i)
            .add("body",
                 fmt::format("body \"{}\" is not driven: load steps without inertia know the forces on "
                             "driven bodies and on faces",
                             gauge.body));
      }
      continue;
    }
    for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
      if (b == own || setup.contact_fields.of_body[b] != setup.contact_fields.of_body[own]) continue;
      faults.in("force_gauge")
          .in(i)
          .add("body",
               fmt::format(
                   "body \"{}\" shares its velocity field with body \"{}\", so that no force acts between "
                   "them: give them contact (contact.method = \"multi_field\", no common contact group)",
                   gauge.body, setup.bodies[b].name));
      break;
    }
  }
}

}  // namespace whipple::cases
