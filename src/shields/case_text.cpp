// SPDX-License-Identifier: BSD-3-Clause
#include "src/shields/case_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/core/base/text.hpp"
#include "src/shields/alloys.hpp"

namespace whipple::shields {
namespace {

std::string mm(double length) { return fmt::format("\"{:.8g} mm\"", 1e3 * length); }
std::string us(double time) { return fmt::format("\"{:.6g} us\"", 1e6 * time); }

std::string point(const std::array<double, 3>& at) {
  return fmt::format("[{}, {}, {}]", mm(at[0]), mm(at[1]), mm(at[2]));
}

std::string heading_of(const Impact& impact) {
  const Projectile& sphere = impact.projectile;
  std::string sheets;
  for (const Bumper& bumper : impact.shield.bumpers)
    sheets += fmt::format("{:.4g} mm {}, {:.4g} mm apart, ", 1e3 * bumper.sheet.thickness, bumper.sheet.alloy,
                          1e3 * bumper.spacing);
  if (impact.shield.foam.density > 0.0)
    sheets += fmt::format("foam of {:.4g} kg/m^3, ", impact.shield.foam.density);
  sheets += fmt::format("{:.4g} mm {}", 1e3 * impact.shield.wall.thickness, impact.shield.wall.alloy);
  const double angle = sphere.angle * 180.0 / std::numbers::pi;
  return fmt::format("{}{}{:.4g} mm {} sphere at {:.4g} km/s{} on {}", impact.name,
                     impact.name.empty() ? "" : ": ", 1e3 * sphere.diameter, sphere.alloy,
                     1e-3 * sphere.velocity, angle > 0.0 ? fmt::format(", {:.3g} degrees", angle) : "",
                     sheets);
}

std::string body_text(const std::string& name, std::string_view material, const std::string& shape,
                      const std::string& rest = "") {
  return fmt::format("\n[[body]]\nname = \"{}\"\nmaterial = \"{}\"\n{}shape = {{ {} }}\n", name, material,
                     rest, shape);
}

std::string plate_shape(const Plate& plate, bool oblique) {
  if (oblique)
    return fmt::format("box = {{ lower = {}, upper = {} }}",
                       point({plate.along[0], -plate.radius, plate.front}),
                       point({plate.along[1], plate.radius, plate.front + plate.thickness}));
  return fmt::format("cylinder = {{ center = {}, axis = \"z\", radius = {}, height = {} }}",
                     point({0.0, 0.0, plate.front + 0.5 * plate.thickness}), mm(plate.radius),
                     mm(plate.thickness));
}

std::string foam_shape(const Impact& impact, const Layout& layout, bool oblique) {
  const Plate& foam = *layout.foam;
  if (layout.foam_model == FoamModel::layer) return plate_shape(foam, oblique);
  const double rear = foam.front + foam.thickness;
  return fmt::format(
      "foam = {{ lower = {}, upper = {}, cell = {}, structure = \"voronoi\", form = \"open\", "
      "relative_density = {:.6g}, seed = {} }}",
      point({oblique ? foam.along[0] : 0.0, 0.0, foam.front}),
      point({oblique ? foam.along[1] : foam.radius, foam.radius, rear}), mm(impact.shield.foam.cell),
      impact.shield.foam.density / alloy_named(impact.shield.foam.alloy).density, layout.seed);
}

std::string_view foam_material(const Foam& foam, FoamModel model) {
  return model == FoamModel::struts ? material_of(foam.alloy)
                                    : "aluminium_foam_6101_t6_layer_mie_gruneisen.toml";
}

std::string domain_text(const Layout& layout, bool oblique) {
  std::string text = "\n[domain]\n";
  if (layout.model == Model::section) text += "dimension = \"axisymmetric\"\naxis = \"z\"\n";
  text += fmt::format("lower = {}\nupper = {}\ncell_size = {}\n", point(layout.lower), point(layout.upper),
                      mm(layout.cell_size));
  if (layout.model == Model::space)
    text +=
        fmt::format("boundary = {{ {}y_lower = \"symmetry\" }}\n", oblique ? "" : "x_lower = \"symmetry\", ");
  return text;
}

const Sheet& sheet_of(const Shield& shield, std::size_t plate) {
  return plate < shield.bumpers.size() ? shield.bumpers[plate].sheet : shield.wall;
}

}  // namespace

std::string case_text(const Impact& impact, const Layout& layout) {
  const Projectile& sphere = impact.projectile;
  const bool oblique = sphere.angle > 0.0;
  const double v_x = sphere.velocity * std::sin(sphere.angle), v_z = sphere.velocity * std::cos(sphere.angle);
  std::string text = fmt::format("# Written by whipple shield. Cell size: {}.\n", layout.chosen_by);
  const std::string thin = not_resolved(layout);
  if (!thin.empty()) text += fmt::format("# Not resolved: {}.\n", thin);
  for (const std::string& remark : remarks_on_materials(impact, layout))
    text += fmt::format("# {}\n", remark);
  text += fmt::format("title = {}\n", toml_string(heading_of(impact)));
  text += domain_text(layout, oblique);
  text += fmt::format("\n[time]\nend = {}\n", us(layout.end));
  text += body_text("sphere", material_of(sphere.alloy),
                    fmt::format("sphere = {{ center = {}, radius = {} }}",
                                point({0.0, 0.0, -0.5 * sphere.diameter}), mm(0.5 * sphere.diameter)),
                    fmt::format("velocity = [\"{:.8g} m/s\", \"0 m/s\", \"{:.8g} m/s\"]\n", v_x, v_z));
  for (std::size_t k = 0; k < layout.plates.size(); ++k) {
    const Plate& plate = layout.plates[k];
    text += body_text(plate.name, material_of(sheet_of(impact.shield, k).alloy), plate_shape(plate, oblique));
  }
  if (layout.foam)
    text += body_text(layout.foam->name, foam_material(impact.shield.foam, layout.foam_model),
                      foam_shape(impact, layout, oblique));
  text += "\n[[stop]]\nwhen = \"decided\"  # docs/manual/shields.md, \"Outcome\"\nbody = \"wall\"\n";
  text += fmt::format(
      "\n[output]\nsnapshot_every = {}\nfields = [\"density\", \"temperature\", \"plastic_strain\", "
      "\"failed\"]\n",
      us(layout.snapshot_every));
  return text;
}

std::string study_text(const Impact& impact, const Layout& layout, const std::vector<double>& speeds,
                       const std::array<double, 2>& between) {
  std::vector<std::string> values;
  for (const double speed : speeds) values.push_back(fmt::format("\"{:.8g} m/s\"", speed));
  return fmt::format(
      "# Written by whipple shield: the largest sphere that the wall stops, as its radius, at each speed.\n"
      "# {}\n"
      "case = \"case.toml\"\n\n"
      "[[vary]]\nkey = \"body.0.velocity.2\"\nvalues = [{}]\n\n"
      "[[quantity]]\nname = \"defeated.wall\"\n[[quantity]]\nname = \"outcome_time.wall\"\n\n"
      "[find]\nkey = \"body.0.shape.sphere.radius\"\nbetween = [{}, {}]\nquantity = \"defeated.wall\"\n"
      "crosses = \"0.5\"\ntolerance = {}\nscan = 3\n\n"
      "[bands]\ncell_sizes = [{}, {}]\noffsets = [0, 0.3333, 0.6667]\n\n"
      "[run]\njobs = 2\nthreads = 1\nkeep = \"tables\"\n",
      toml_string(heading_of(impact)), fmt::join(values, ", "), mm(0.5 * between[0]), mm(0.5 * between[1]),
      mm(0.05 * 0.5 * std::sqrt(between[0] * between[1])), mm(layout.cell_size), mm(layout.cell_size / 1.4));
}

std::vector<std::string> remarks_on_materials(const Impact& impact, const Layout& layout) {
  std::vector<std::string> remarks;
  const auto remark_on = [&](const std::string& part, const std::string& name) {
    const Alloy& alloy = alloy_named(name);
    if (!alloy.remark.empty())
      remarks.push_back(fmt::format("{} of {}: {}: {}", part, alloy.name, alloy.material, alloy.remark));
  };
  remark_on("Sphere", impact.projectile.alloy);
  for (const Bumper& bumper : impact.shield.bumpers) remark_on("Bumper", bumper.sheet.alloy);
  remark_on("Wall", impact.shield.wall.alloy);
  if (layout.foam && layout.foam_model == FoamModel::struts) remark_on("Foam", impact.shield.foam.alloy);
  return remarks;
}

}  // namespace whipple::shields
