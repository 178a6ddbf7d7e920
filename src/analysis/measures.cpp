// SPDX-License-Identifier: BSD-3-Clause
#include "src/analysis/measures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <sstream>

#include "src/core/base/csv.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"

namespace whipple::analysis {
namespace {

constexpr std::string_view no_debris = "no debris flies forward, or it has come to the border of the domain";
constexpr std::string_view no_target = "no debris flies forward, or there is no target";
constexpr std::string_view no_phases = "the body has left the domain, or its equation of state has no phases";
constexpr std::string_view no_crater = "no floor: the body is open on the axis or is not struck";
constexpr std::string_view no_bulge = "the body is perforated, or nothing of it is left on the axis";
constexpr std::string_view bar_gone = "fewer than three cells of the bar are left";
constexpr std::string_view no_fragments = "too few fragments of the debris";
constexpr std::string_view no_sizes = "nothing of the body failed while it expanded, or it keeps no size";
constexpr std::string_view no_peaks = "no particle of the body began at these depths near the axis";
constexpr std::string_view no_hits = "no debris hits the plate";
constexpr std::string_view no_arrivals = "nothing has passed the plane";
constexpr std::string_view gone = "all of the body has left the domain";

// clang-format off
constexpr auto table = std::to_array<Measure>({
    {"time", "s", "time of the snapshot", ""},
    // Debris cloud.
    {"front", "m", "axial coordinate beyond which 0.1 % of the debris lies", no_debris},
    {"foremost", "m", "axial coordinate of the foremost particle of the debris", no_debris},
    {"rear", "m", "axial coordinate below which 0.1 % of the debris lies", no_debris},
    {"radius", "m", "distance from the axis beyond which 0.1 % of the debris lies", no_debris},
    {"outermost", "m", "distance of the outermost particle of the debris from the axis", no_debris},
    {"radial_speed", "m/s", "speed away from the axis that 0.1 % of the debris exceeds", no_debris},
    {"mean_velocity", "m/s", "mean axial velocity of the debris", no_debris},
    {"half_angle", "rad", "of the cone of directions that holds 95 % of the kinetic energy of the debris", no_debris},
    {"cloud_length", "m", "from the rear face of the first target to the front", no_target},
    {"cloud_length_over_width", "1", "cloud length over twice the radius", no_target},
    {"debris_mass", "kg", "mass of the debris", ""},
    {"mass_behind", "kg", "mass farther behind the rear face of the first target than a quarter of its thickness", no_target},
    {"axial_50", "m", "axial coordinate that half of this mass exceeds", no_target},
    {"radius_50", "m", "distance from the axis that half of this mass exceeds", no_target},
    {"axial_90", "m", "axial coordinate that 10 % of this mass exceeds", no_target},
    {"radius_90", "m", "distance from the axis that 10 % of this mass exceeds", no_target},
    {"axial_99", "m", "axial coordinate that 1 % of this mass exceeds", no_target},
    {"radius_99", "m", "distance from the axis that 1 % of this mass exceeds", no_target},
    {"melted_mass", "kg", "mass of liquid and vapour in bodies that have phases", "no equation of state has phases"},
    {"melted_fraction", "1", "mass fraction of liquid and vapour in bodies that have phases", "no equation of state has phases"},
    {"debris_melted_fraction", "1", "mass fraction of liquid and vapour in the debris of bodies that have phases", "no debris of bodies that have phases"},
    {"vaporised_mass", "kg", "mass of vapour in bodies that have phases", "no equation of state has phases"},
    {"vaporised_fraction", "1", "mass fraction of vapour in bodies that have phases", "no equation of state has phases"},
    {"debris_vaporised_fraction", "1", "mass fraction of vapour in the debris of bodies that have phases", "no debris of bodies that have phases"},
    {"front_speed", "m/s", "change of the front in time; the final value over the last third of the snapshots", no_debris},
    {"rear_speed", "m/s", "change of the rear in time; the final value over the last third of the snapshots", no_debris},
    {"expansion_speed", "m/s", "change of the radius in time; the final value over the last third of the snapshots", no_debris},
    {"front_speed_over_impact_speed", "1", "front speed over impact speed", no_debris},
    {"radial_speed_over_impact_speed", "1", "radial speed over impact speed", no_debris},
    // The impact.
    {"target_velocity", "m/s", "axial velocity of the target at the start, whose frame all other measures refer to; 0 against a wall", ""},
    {"impact_speed", "m/s", "relative speed of the fastest and the slowest body at the start", "nothing moves at the start"},
    {"impact_angle", "rad", "angle of their relative velocity with the axis; 0: normal impact", "nothing moves at the start"},
    {"projectile_size", "m", "smallest extent of the projectile by its shape in the case", "nothing moves at the start, or the shape states no extent"},
    // Bodies.
    {"mean_velocity.BODY", "m/s", "axial momentum over mass, with what has left the domain", gone},
    {"outflow_mass.BODY", "kg", "mass that has left the domain: counts in mean_velocity.BODY and in nothing else", ""},
    {"axial_length.BODY", "m", "extent along the axis", gone},
    {"front_velocity.BODY", "m/s", "mean axial velocity of the outermost layer of particles ahead", gone},
    {"pullback.BODY", "m/s", "fall of front_velocity.BODY from its maximum to the following minimum", "the forward surface was not slowed by a tenth after its maximum velocity"},
    {"solid_fraction.BODY", "1", "mass fraction of the particles of the phase solid", no_phases},
    {"melting_fraction.BODY", "1", "mass fraction of the particles of the phase melting", no_phases},
    {"liquid_fraction.BODY", "1", "mass fraction of the particles of the phase liquid", no_phases},
    {"vapour_fraction.BODY", "1", "mass fraction of the particles of the phase vapour", no_phases},
    {"melted_fraction.BODY", "1", "mass fraction of liquid and vapour", no_phases},
    {"median_melted_fraction.BODY", "1", "median of the melted fraction over the mass: surface layers have no weight", no_phases},
    {"axis_melted_fraction.BODY", "1", "median of the melted fraction over the mass that began within a quarter of the projectile's radius of the axis", "nothing of the body began near the axis, or its equation of state has no phases"},
    // Craters, penetration, holes.
    {"crater_depth.BODY", "m", "depth of the body's own floor on the axis below its original surface", no_crater},
    {"crater_radius.BODY", "m", "radius in the plane of the original surface", no_crater},
    {"crater_diameter.BODY", "m", "diameter in the plane of the original surface", no_crater},
    {"crater_depth_over_diameter.BODY", "1", "depth of the crater over its diameter", no_crater},
    {"bulge.BODY", "m", "how far the rear face has moved on the axis, of the material that begins at the floor; negative: material has come off behind", no_bulge},
    {"penetration_depth.BODY", "m", "depth of the deepest point of a body that flies at the first target below the target's original surface (0.1 % of its mass lies deeper); 0 before it arrives", "the target is perforated or cannot be decided to be whole, or the body has left the domain"},
    {"perforated.BODY", "1", "1: a path leads through the body, 0: connected material of it closes every path", "see the reason given with the value"},
    {"least_left.BODY", "1", "smallest fraction of the thickness that connected material keeps along any line through the body", "see perforated.BODY"},
    {"left_on_axis.BODY", "1", "fraction of the thickness that connected material keeps where the line of flight meets the body", "see perforated.BODY"},
    {"hole_diameter.BODY", "m", "diameter about the line of flight within which less than half of the thickness is left, of a perforated body", "the body is not perforated"},
    {"damaged_area.BODY", "m^2", "area of the face where connected material keeps less than 0.9 of the thickness", "see perforated.BODY"},
    {"spall_mass.BODY", "kg", "mass of the body's material that has come off behind it, of a body that is not perforated", "see perforated.BODY"},
    {"defeated.BODY", "1", "outcome of a struck wall: 1 perforated or with detached spall, 0 neither (shields.md); not a number as long as it is undecided", "see the reason given with the value"},
    {"outcome_time.BODY", "s", "time at which its outcome was decided", "see defeated.BODY"},
    // Bars against a wall.
    {"length.BODY", "m", "length of a bar that flies at a wall: from its end at the wall to the far end", bar_gone},
    {"foot_diameter.BODY", "m", "diameter of a bar at its end at the wall, extrapolated from the three layers of a cell above it", bar_gone},
    {"contact_diameter.BODY", "m", "diameter of a bar where it lies at the wall: of the circle with the cross-section of the layer of a cell there", bar_gone},
    {"largest_diameter.BODY", "m", "largest diameter of a bar, which is that of its rim where that curls off the wall: 0.1 % of the mass lies further from the axis", bar_gone},
    {"diameter_at.BODY", "m", "diameter of a bar at the distance from that end that was asked for", "the bar is shorter than that"},
    {"foot_temperature.BODY", "K", "mean temperature of a bar within a particle spacing of that end and two of the axis", bar_gone},
    {"foot_plastic_strain.BODY", "1", "mean plastic strain of a bar within a particle spacing of that end and two of the axis", bar_gone},
    // Spall, rods.
    {"spall_thickness.BODY", "m", "initial thickness of the material ahead of the foremost gap at least half as wide as the largest, in a planar impact", "there is no gap with a layer of particles ahead of it"},
    {"largest_gap.BODY", "m", "largest gap between layers of particles along the axis in a planar impact; 0: none", gone},
    {"residual_length_ratio.BODY", "1", "length of the part that keeps 0.9 of its initial speed and half of its initial section, from the rear end on, over the initial length", "the first snapshot does not show the body at its initial speed"},
    {"residual_speed_ratio.BODY", "1", "mean speed of that part along the initial direction over the initial speed", "nothing of the body keeps 0.9 of its initial speed"},
    // Fragments.
    {"piece_count.BODY", "1", "number of fragments: at least four connected intact particles, with what has failed beside them; in two dimensions of pieces of the section", gone},
    {"piece_mass.BODY", "kg", "mean mass of the fragments of the body", "the body has no fragments"},
    {"loose_fraction.BODY", "1", "fraction of its mass in no fragment, without vapour", gone},
    {"fragment_size.BODY", "m", "median over the mass of the size that failed material kept (`[[failure]] model = \"fragment_size\"`; output field fragment_size)", no_sizes},
    {"fragment_size_16.BODY", "m", "size that 16 % of that mass lies below", no_sizes},
    {"fragment_size_84.BODY", "m", "size that 84 % of that mass lies below", no_sizes},
    {"piece_exponent.BODY", "1", "b of N(m) = N exp(-(m/m_c)^b) of the masses of the fragments of the body, the largest one included; in two dimensions of pieces of the section", "the body has fewer than three fragments, or all have one mass"},
    {"piece_exponent_error.BODY", "1", "standard error of this b", "the body has fewer than three fragments, or all have one mass"},
    {"piece_scale.BODY", "kg", "m_c of the same distribution", "the body has fewer than three fragments, or all have one mass"},
    {"debris_fragments", "1", "number of fragments of the debris", ""},
    {"debris_fragments_resolved", "1", "number of those of at least eight particles", ""},
    {"largest_fragment", "kg", "mass of the largest fragment of the debris", "there is no debris"},
    {"largest_fragment_over_projectile", "1", "mass of the largest fragment of the debris over that of the projectile", "there is no debris"},
    {"mean_fragment", "kg", "mean mass of the fragments of the debris", "there is no debris"},
    {"fragment_exponent", "1", "b of N(m) ~ m^-b from eight particles on, without the largest fragment", no_fragments},
    {"fragment_exponent_error", "1", "standard error of b", no_fragments},
    // With --peak-decay.
    {"peak_pressure_contact", "Pa", "mean peak over depths of 0 to 0.6 radii of the projectile", no_peaks},
    {"peak_pressure_contact_wide", "Pa", "mean peak over depths of 0 to 1.2 radii of the projectile", no_peaks},
    {"peak_pressure_exponent", "1", "n of P ~ depth^-n over 2 to 5 diameters of the projectile", no_peaks},
    {"peak_pressure_4_diameters", "Pa", "peak at 4 diameters of the projectile, from the same fit", no_peaks},
    // With --witness.
    {"witness_mass", "kg", "debris that hits the witness plate", ""},
    {"witness_momentum", "kg m/s", "axial momentum that hits the witness plate", ""},
    {"witness_energy", "J", "kinetic energy that hits the witness plate", ""},
    {"witness_first", "s", "time of the first hit", no_hits},
    {"witness_last", "s", "time of the last hit", no_hits},
    // With --loads.
    {"loads_mass", "kg", "mass that has passed the plane", ""},
    {"loads_momentum", "kg m/s", "axial momentum that has passed the plane", ""},
    {"loads_energy", "J", "kinetic energy that has passed the plane", ""},
    {"loads_first", "s", "time of the first arrival", no_arrivals},
    {"loads_last", "s", "time of the last arrival", no_arrivals},
    {"loads_under_way", "kg", "mass of the debris before the plane at the end", ""},
});
// clang-format on

constexpr std::string_view of_body = ".BODY";

Quantity made(const Measure& measure, std::string name, double value, std::string reason) {
  Quantity quantity{std::move(name), std::string(measure.unit), std::string(measure.meaning), value};
  if (std::isfinite(value)) return quantity;
  quantity.value = nan;  // removes the sign of NaN, and infinities
  quantity.reason = reason.empty() ? std::string(measure.missing) : std::move(reason);
  return quantity;
}

}  // namespace

std::span<const Measure> measures() { return table; }

Quantity measured(std::string_view name, double value, std::string reason) {
  const auto found = std::ranges::find(table, name, &Measure::name);
  if (found == table.end()) throw InternalError(fmt::format("there is no measure {}", name));
  return made(*found, std::string(name), value, std::move(reason));
}

Quantity measured(std::string_view name, const std::string& body, double value, std::string reason) {
  const std::string key = fmt::format("{}{}", name, of_body);
  const auto found = std::ranges::find(table, key, &Measure::name);
  if (found == table.end()) throw InternalError(fmt::format("there is no measure {}", key));
  return made(*found, fmt::format("{}.{}", name, body), value, std::move(reason));
}

std::string measures_as_markdown() {
  std::string text = "| quantity | unit | meaning |\n| --- | --- | --- |\n";
  for (const Measure& measure : table) {
    text += fmt::format("| `{}` | {} | {} |\n", measure.name, measure.unit, measure.meaning);
  }
  return text;
}

void write_quantities(const Quantities& values, const std::filesystem::path& folder) {
  std::string text = "quantity,value,unit,meaning,reason\n";
  for (const Quantity& q : values) {
    text += fmt::format("{},{},{},{},{}\n", csv_cell(q.name), q.value, q.unit, csv_cell(q.meaning),
                        csv_cell(q.reason));
  }
  write_text_atomically(folder / "quantities.csv", text);
}

Quantities read_quantities(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "quantities.csv";
  std::istringstream lines(read_text(file));
  Quantities all;
  std::string line;
  std::getline(lines, line);  // names of the columns
  while (std::getline(lines, line)) {
    const std::vector<std::string> cells = csv_cells(line);
    double value = 0.0;
    const bool is_row =
        cells.size() >= 5 &&
        std::from_chars(cells[1].data(), cells[1].data() + cells[1].size(), value).ec == std::errc();
    if (!is_row) throw InputError(fmt::format("{}: error: no row of measures: {}", file.string(), line));
    all.push_back({cells[0], cells[2], cells[3], value, cells[4]});
  }
  return all;
}

}  // namespace whipple::analysis
