// SPDX-License-Identifier: BSD-3-Clause
#include "src/analysis/analyse.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "src/analysis/arrivals.hpp"
#include "src/analysis/bar.hpp"
#include "src/analysis/cloud.hpp"
#include "src/analysis/fragments.hpp"
#include "src/analysis/frame.hpp"
#include "src/analysis/measures.hpp"
#include "src/analysis/outcome.hpp"
#include "src/analysis/outflow.hpp"
#include "src/analysis/peaks.hpp"
#include "src/analysis/radiograph.hpp"
#include "src/analysis/surfaces.hpp"
#include "src/analysis/table.hpp"
#include "src/analysis/wall.hpp"
#include "src/analysis/witness.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/log.hpp"

namespace whipple::analysis {
namespace {

namespace fs = std::filesystem;

/// Finds the fragments of a snapshot. @throws InputError naming the snapshot file
Fragments fragments_of(const SnapshotEntry& entry, const Snapshot& snapshot, const Run& run,
                       const Frame& frame, double link) {
  try {
    return find_fragments(snapshot, run.bodies, frame, link);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", entry.file.string(), error.what()));
  }
}

/// Holds the data of the bodies taken from the first snapshot.
struct Start {
  Frame frame;
  std::vector<Extent> extents;        ///< of each body, along the axis
  std::optional<std::size_t> target;  ///< the first body that the projectile hits
  double projectile_mass = 0.0, projectile_radius = 0.0, particle_mass = 0.0;
  std::vector<std::optional<Wall>> walls;    ///< of the bodies that may be perforated
  std::vector<std::optional<Judge>> judges;  ///< of these
  bool planar = false;                       ///< planar impact: there are no craters or holes
  std::vector<std::uint64_t> near_axis;      ///< particles starting within a quarter of the projectile radius
};

/// Returns whether all bodies fill the cross-section of the domain, as in a planar impact.
bool is_planar(const Run& run, const Snapshot& first, const Frame& frame) {
  std::vector<Vector3> lower(run.bodies.size(), Vector3::Constant(std::numeric_limits<double>::infinity())),
      upper;
  for (const Vector3& corner : lower) upper.push_back(-corner);
  for (std::size_t i = 0; i < first.size(); ++i) {
    const std::uint16_t b = first.body[i];
    lower[b] = lower[b].cwiseMin(first.position[i]);
    upper[b] = upper[b].cwiseMax(first.position[i]);
  }
  for (std::size_t b = 0; b < run.bodies.size(); ++b) {
    const double near = run.cell_size;
    for (const int a : frame.transverse) {
      if (frame.is_planar() && a == 2) continue;
      if (!(lower[b][a] < run.lower[a] + near && upper[b][a] > run.upper[a] - near)) return false;
    }
  }
  return true;
}

Start start_of(const Run& run, const Snapshot& first, const Options& options) {
  // The last snapshot is needed for the axis only if no body moves at the start.
  std::optional<Snapshot> last;
  if (std::ranges::all_of(run.bodies, [](const BodyInput& body) { return body.velocity.isZero(0.0); })) {
    last = read_snapshot(run.snapshots.back());
  }
  Start start{.frame = find_frame(run, first, options.axis, last ? &*last : nullptr),
              .extents = {},
              .target = {},
              .walls = {},
              .judges = {},
              .near_axis = {}};
  const Frame& frame = start.frame;
  for (std::size_t b = 0; b < run.bodies.size(); ++b) {
    start.extents.push_back(axial_extent(first, frame, b, run.bodies[b].spacing));
    if (b == frame.projectile || !std::isfinite(start.extents[b].lower)) continue;
    if (!start.target || start.extents[b].lower < start.extents[*start.target].lower) start.target = b;
  }
  double count = 0.0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (first.body[i] != frame.projectile) continue;
    start.projectile_mass += frame.images() * first.mass[i];
    start.projectile_radius =
        std::max(start.projectile_radius,
                 frame.radius(first.position[i]) + 0.5 * run.bodies[frame.projectile].spacing);
    count += 1.0;
  }
  start.particle_mass = count > 0.0 ? start.projectile_mass / (frame.images() * count) : 0.0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (frame.radius(first.position[i]) < 0.25 * start.projectile_radius)
      start.near_axis.push_back(first.id[i]);
  }
  start.planar = is_planar(run, first, frame);
  // All following measures refer to the point hit by an oblique flight.
  if (start.target) start.frame = start.frame.at_face(start.extents[*start.target].lower);
  start.walls.resize(run.bodies.size());  // judges refer to them
  start.judges.resize(run.bodies.size());
  for (std::size_t b = 0; b < run.bodies.size(); ++b) {
    if (b == frame.projectile || frame.wall || start.planar || first.scalar("density") == nullptr) continue;
    if (!std::isfinite(start.extents[b].lower)) continue;
    start.walls[b].emplace(run, first, start.frame, b);
    start.judges[b].emplace(run, first, frame, *start.walls[b]);
  }
  return start;
}

/// Computes the median melted fraction of the material that started near the axis.
Quantities axis_measures(const Snapshot& snapshot, const Start& start, const std::vector<BodyInput>& bodies) {
  const std::vector<double>* melted = snapshot.scalar("melted_fraction");
  if (melted == nullptr) return {};
  std::vector<std::vector<std::pair<double, double>>> of_body(bodies.size());
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    if (!std::ranges::binary_search(start.near_axis, snapshot.id[i])) continue;
    of_body[snapshot.body[i]].emplace_back((*melted)[i], snapshot.mass[i]);
  }
  Quantities row;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    row.push_back(measured("axis_melted_fraction", bodies[b].name,
                           bodies[b].phases ? weighted_quantile(of_body[b], 0.5) : nan));
  }
  return row;
}

void append(Quantities& row, Quantities more) { row.insert(row.end(), more.begin(), more.end()); }

/// Measures craters, holes and perforation of the bodies that may be struck, and the penetration depth of the bodies
/// flying at the first target.
Quantities surface_measures(const Run& run, Start& start, const Snapshot& snapshot) {
  Quantities row;
  double perforated = nan;  // the first target
  for (std::size_t b = 0; b < run.bodies.size(); ++b) {
    if (!start.walls[b]) continue;
    const std::string& name = run.bodies[b].name;
    const Extent& extent = start.walls[b]->extent();
    const Wall::Remains left = start.walls[b]->look(snapshot);
    const Quantities wall = start.walls[b]->measure(snapshot, left);
    start.judges[b]->add(snapshot, left);
    const bool open = wall.front().value == 1.0;
    if (b == *start.target) perforated = wall.front().value;
    const Crater crater = open ? Crater{.depth = nan, .radius = nan, .bulge = nan}
                               : measure_crater(snapshot, start.walls[b]->frame(), b, extent.lower,
                                                extent.upper, run.cell_size);
    std::string reason = open ? "the body is perforated" : "";
    if (crater.is_bulge)
      reason = "the body bulges: its rear face has moved more than half as far as its floor";
    append(row, {measured("crater_depth", name, crater.depth, reason),
                 measured("crater_radius", name, crater.radius, reason),
                 measured("crater_diameter", name, 2.0 * crater.radius, reason),
                 measured("crater_depth_over_diameter", name, 0.5 * crater.depth / crater.radius, reason),
                 measured("bulge", name, crater.bulge)});
    append(row, wall);
    append(row, start.judges[b]->measures());
  }
  if (!start.target || !start.walls[*start.target]) return row;
  const Frame& normal = start.walls[*start.target]->frame();
  const Extent& target = start.walls[*start.target]->extent();
  const double rest = normal.axial(run.bodies[*start.target].velocity);
  for (std::size_t b = 0; b < run.bodies.size(); ++b) {
    const bool flies_at = normal.axial(run.bodies[b].velocity) > rest &&
                          start.extents[b].lower < start.extents[*start.target].upper && b != *start.target;
    if (!flies_at) continue;
    const double depth = penetration_depth(snapshot, normal, b, run.bodies[b].spacing, target.lower);
    const bool through = perforated == 1.0 || (!(perforated == 0.0) && depth >= target.length());
    row.push_back(measured("penetration_depth", run.bodies[b].name, through ? nan : depth));
  }
  return row;
}

/// Measures one snapshot.
Quantities measure(const Run& run, Start& start, const Options& options, const OutflowHistory& outflow,
                   const Snapshot& snapshot) {
  const Frame& frame = start.frame;
  Quantities row = {measured("time", snapshot.time)};
  append(row, cloud_measures(snapshot, frame,
                             start.target ? std::optional(start.extents[*start.target]) : std::nullopt,
                             run.bodies));
  for (std::size_t b = 0; b < run.bodies.size(); ++b) {
    append(row, body_measures(snapshot, frame, b, run.bodies[b], outflow.at(b, snapshot.time)));
    append(row, bar_measures(snapshot, frame, b, run.bodies[b], run.cell_size, options.diameter_at,
                             frame.wall && frame.wall_holds &&
                                 start.extents[b].upper > *frame.wall - 0.01 * run.cell_size));
  }
  append(row, surface_measures(run, start, snapshot));
  return row;
}

/// Sets front and radius to NaN from the time at which the outermost debris comes within a cell of the border of the
/// domain, as debris that leaves cannot be followed.
void end_at_the_border(const Run& run, const Frame& frame, Table& series) {
  const auto cut = [&](const char* outermost, std::initializer_list<const char*> names,
                       const std::function<double(double)>& limit) {
    bool reached = false;
    const std::vector<double> position = series[outermost], time = series["time"];
    for (std::size_t k = 0; k < position.size(); ++k) {
      reached = reached || position[k] >= limit(time[k]);
      for (Column& column : series.columns) {
        const bool named = std::ranges::any_of(names, [&](const char* name) { return column.name == name; });
        if (reached && named) column.values[k] = nan;
      }
    }
  };
  const int z = frame.axis;
  cut("foremost", {"front", "foremost", "cloud_length", "cloud_length_over_width"}, [&](double time) {
    return (frame.sign > 0.0 ? run.upper_at(time)[z] : -run.lower_at(time)[z]) - run.cell_size;
  });
  cut("outermost", {"radius", "outermost", "cloud_length_over_width"}, [&](double time) {
    double side = std::numeric_limits<double>::infinity();
    for (const int a : frame.transverse) {
      if (frame.is_planar() && a == 2) continue;
      side = std::min(side, run.upper_at(time)[a] - frame.centre[a] - run.cell_size);
      if (!frame.mirrored(a) && frame.dimension != grid::Dimension::axisymmetric)
        side = std::min(side, frame.centre[a] - run.lower_at(time)[a] - run.cell_size);
    }
    return side;
  });
}

/// Returns evenly spread indices that include the first and the last.
std::vector<std::size_t> spread(std::size_t n, int count) {
  std::vector<std::size_t> chosen;
  const auto m = std::min(static_cast<std::size_t>(std::max(count, 1)), n);
  for (std::size_t k = 0; k < m; ++k) {
    chosen.push_back(m == 1 ? n - 1 : (k * (n - 1) + (m - 1) / 2) / (m - 1));
  }
  return chosen;
}

void write_radiographs(const Run& run, const Frame& frame, const Options& options, const hdf5::Group& root) {
  RadiographOptions film{.pixel = options.pixel > 0.0 ? options.pixel : 0.5 * run.cell_size,
                         .spot = options.spot,
                         .attenuation = {}};
  constexpr double aluminium_150_kev = 0.01378;
  for (const BodyInput& body : run.bodies) {
    const auto given = options.attenuation.find(body.name);
    film.attenuation.push_back(given == options.attenuation.end() ? aluminium_150_kev : given->second);
  }
  const std::vector<std::size_t> chosen = spread(run.snapshots.size(), options.radiographs);
  PictureLimits limits;
  for (const std::size_t k : chosen) limits.include(read_snapshot(run.snapshots[k]), frame);
  const hdf5::Group group = root.create_group("radiographs", hdf5::Order::creation);
  group.set_attribute("pixel", film.pixel);
  group.set_attribute("spot", film.spot);
  for (const std::size_t k : chosen) {
    const Radiograph picture = take_radiograph(read_snapshot(run.snapshots[k]), frame, limits, film);
    const hdf5::Group one = group.create_group(fmt::format("{:06}", k));
    one.set_attribute("time", picture.time);
    one.set_attribute("lower_axial", picture.lower_axial);
    one.set_attribute("lower_up", picture.lower_up);
    const auto write = [&](const std::string& name, const std::vector<double>& image, const char* unit) {
      const std::vector<float> narrow(image.begin(), image.end());
      one.write<float>(name, narrow, hdf5::Slab::whole(picture.rows),
                       {.columns = picture.columns, .deflate = 1})
          .set_attribute("unit", std::string_view(unit));
    };
    for (std::size_t b = 0; b < run.bodies.size(); ++b) {
      write("areal_density." + run.bodies[b].name, picture.areal_density[b], "kg/m^2");
    }
    write("transmission", picture.transmission, "1");
  }
}

/// Writes the input that programs displaying the run need, so that they do not have to parse the case.
void write_case(const Run& run, const hdf5::Group& root) {
  std::vector<std::string> names;
  for (const BodyInput& body : run.bodies) names.push_back(body.name);
  root.set_attribute("title", std::string_view(run.title));
  root.set_attribute("bodies", std::string_view(fmt::format("{}", fmt::join(names, "\n"))));
  root.set_attribute("cell_size", run.cell_size);
}

void write_frame(const Run& run, const Start& start, const hdf5::Group& root) {
  const Frame& frame = start.frame;
  const hdf5::Group group = root.create_group("frame");
  group.set_attribute("axis", static_cast<std::int64_t>(frame.axis));
  group.set_attribute("sign", frame.sign);
  group.set_attribute("up", static_cast<std::int64_t>(frame.transverse[0]));
  group.set_attribute("sight", static_cast<std::int64_t>(frame.transverse[1]));
  group.set_attribute("copies", frame.copies());
  group.set_attribute("dimension", word_of(frame.dimension));
  group.set_attribute("impact_speed", frame.impact_speed);
  group.set_attribute("impact_angle", frame.impact_angle);
  group.set_attribute("projectile", std::string_view(run.bodies[frame.projectile].name));
  for (int a = 0; a < 3; ++a) group.set_attribute(fmt::format("centre_{}", "xyz"[a]), frame.centre[a]);
  for (const Plane& plane : frame.planes) {
    group.set_attribute(fmt::format("plane_{}", "xyz"[plane.axis]), plane.position);
  }
}

/// Collects the final values: the last row of the series, and values that require all snapshots.
/// @param last  measures of the last snapshot
Quantities final_values(const Table& series, const Quantities& last, const Run& run, const Start& start) {
  Quantities row;
  for (const Column& column : series.columns) {
    // The series may end before its last row; the default reason of the measure then applies.
    const auto found = std::ranges::find(last, column.name, &Quantity::name);
    const std::size_t dot = column.name.find('.');
    const double value = column.values.back();
    const std::string reason = found == last.end() ? std::string() : found->reason;
    row.push_back(dot == std::string::npos
                      ? measured(column.name, value, reason)
                      : measured(column.name.substr(0, dot), column.name.substr(dot + 1), value, reason));
  }
  const auto of = [&](const char* name) { return std::ranges::find(row, name, &Quantity::name); };
  for (const auto& [position, speed] : analysis::speeds) {
    // Without its position, a speed would be that of an earlier time.
    const double slope =
        std::isfinite(of(position)->value) ? final_slope(series["time"], series[position]) : nan;
    *of(speed) = measured(speed, slope);
  }
  const Frame& frame = start.frame;
  const double speed = frame.impact_speed > 0.0 ? frame.impact_speed : nan;
  append(row,
         {measured("target_velocity", frame.axial(run.frame_velocity) + 0.0), measured("impact_speed", speed),
          measured("impact_angle", speed > 0.0 ? frame.impact_angle : nan),
          measured("front_speed_over_impact_speed", of("front_speed")->value / speed),
          measured("radial_speed_over_impact_speed", of("radial_speed")->value / speed)});
  const BodyInput& projectile = run.bodies[frame.projectile];
  row.push_back(measured("projectile_size", projectile.velocity.isZero(0.0) ? nan : projectile.size));
  for (const BodyInput& body : run.bodies) {
    const std::string name = "front_velocity." + body.name;
    if (std::ranges::find(series.columns, name, &Column::name) == series.columns.end()) continue;
    row.push_back(measured("pullback", body.name, pullback(series[name])));
  }
  return row;
}

/// Logs why values are missing.
void explain(const Quantities& values) {
  std::map<std::string, std::vector<std::string>> missing;
  for (const Quantity& value : values) {
    if (!std::isfinite(value.value)) missing[value.reason].push_back(value.name);
  }
  for (const auto& [text, names] : missing) log::info("not measured: {} ({})", fmt::join(names, ", "), text);
}

/// Logs which bodies have no phases at any temperature.
void explain_phases(const Run& run) {
  std::vector<std::string> names;
  for (const BodyInput& body : run.bodies) {
    if (!body.phases) names.push_back(body.name);
  }
  if (names.empty()) return;
  log::info(
      "the equations of state of {} have no phases: these bodies count in no mass or fraction of a phase",
      fmt::join(names, ", "));
}

void require_bodies(const Run& run, const Options& options) {
  std::vector<std::string> known, asked;
  for (const BodyInput& body : run.bodies) known.push_back(body.name);
  for (const auto& [name, value] : options.attenuation) asked.push_back(name);
  if (!options.peak_decay.empty()) asked.push_back(options.peak_decay);
  if (!options.loads.empty()) asked.push_back(options.loads);
  for (const std::string& name : asked) {
    if (std::ranges::find(known, name) != known.end()) continue;
    throw InputError(fmt::format("the run has no body \"{}\" (bodies: {})", name, fmt::join(known, ", ")));
  }
}

std::size_t body_named(const Run& run, const std::string& name) {
  return static_cast<std::size_t>(std::ranges::find(run.bodies, name, &BodyInput::name) - run.bodies.begin());
}

/// Returns the plane of the requested loads: two cells before the face of the body, where arriving material is still in
/// free flight.
std::optional<Arrivals> arrivals_at(const Run& run, const Start& start, const Options& options) {
  if (!options.loads.empty()) {
    const std::size_t wall = body_named(run, options.loads);
    const Frame frame =
        start.walls[wall] ? start.walls[wall]->frame() : start.frame.at_face(start.extents[wall].lower);
    const double face = start.walls[wall] ? start.walls[wall]->extent().lower : start.extents[wall].lower;
    return Arrivals(frame, face - 2.0 * run.cell_size, wall);
  }
  if (!options.loads_at) return {};
  return Arrivals(start.frame.at_face(*options.loads_at), *options.loads_at);
}

}  // namespace

void analyse(const Run& run, const Options& options, const fs::path& folder) {
  if (run.snapshots.empty())
    throw InputError(fmt::format("{}: error: has no snapshots", run.folder.string()));
  require_bodies(run, options);
  const Snapshot first = read_snapshot(run.snapshots.front());
  Start start = start_of(run, first, options);
  const Frame& frame = start.frame;

  std::optional<PeakDecay> peaks;
  if (!options.peak_decay.empty()) {
    const std::size_t body = body_named(run, options.peak_decay);
    peaks.emplace(first, frame, body, 1.5 * run.cell_size, start.extents[body].lower);
  }
  std::optional<Arrivals> arrivals = arrivals_at(run, start, options);
  Table series{
      .name = "series", .meaning = "measures of every snapshot", .label = {}, .labels = {}, .columns = {}};
  if (first.scalar("density") == nullptr) {
    log::warning("the snapshots have no density: no crater, holes, perforation or profile");
  }
  const OutflowHistory outflow(run);
  const double link = options.link > 0.0 ? options.link : 1.5 * run.cell_size;
  if (run.has_two_levels && !(options.link > 0.0)) {
    log::warning(
        "the run has two cell sizes: fragments are what lies within 1.5 small cells, and material in large "
        "cells, "
        "whose particles are twice as far apart, parts at half of the stretch: fragments should be in the "
        "regions, "
        "or choose --link");
  }
  Snapshot last;
  Fragments fragments;
  Quantities row;
  for (const SnapshotEntry& entry : run.snapshots) {
    last = read_snapshot(entry);
    row = measure(run, start, options, outflow, last);
    fragments = fragments_of(entry, last, run, frame, link);
    append(row, piece_measures(fragments, run.bodies));
    append(row, fragment_size_measures(last, run.bodies));
    series.append(row);
    if (peaks) peaks->add(last);
    if (arrivals) arrivals->add(last);
  }
  end_at_the_border(run, frame, series);
  add_speeds(series);

  Quantities values = final_values(series, row, run, start);
  append(values, axis_measures(last, start, run.bodies));
  for (std::size_t b = 0; b < run.bodies.size(); ++b) {
    append(values, spall_measures(first, last, frame, b, run.bodies[b], start.planar));
    append(values, rod_measures(first, last, b, run.bodies[b], run.cell_size));
  }
  Quantities of_fragments = fragment_measures(fragments.list, start.projectile_mass, start.particle_mass);
  const std::string none =
      frame.is_planar() ? "in two dimensions a piece of the section is a ring or a bar: see piece_count"
                        : fragments.unknown;
  if (!none.empty()) {
    for (Quantity& value : of_fragments) {
      value.value = nan;
      value.reason = none;
    }
  }
  append(values, std::move(of_fragments));

  std::vector<Table> tables = {std::move(series), body_table(last, frame, run.bodies),
                               fragment_table(fragments.list, frame), fragment_distribution(fragments.list)};
  if (options.by_distance) tables.push_back(pieces_by_distance(last, run.bodies, frame, run.cell_size));
  if (last.scalar("density") != nullptr) tables.push_back(diameter_profile(last, frame, run));
  if (peaks) {
    tables.push_back(peaks->profile(run.cell_size));
    append(values, peaks->measures(2.0 * start.projectile_radius));
  }
  const auto add_loads = [&](Loads loads) {
    append(values, std::move(loads.totals));
    tables.push_back(std::move(loads.rings));
    tables.push_back(std::move(loads.flux));
  };
  const double ring = 2.0 * run.cell_size;
  if (options.witness) add_loads(witness_plate(last, frame, {.position = *options.witness, .ring = ring}));
  if (arrivals) add_loads(arrivals->loads(ring));
  explain(values);
  explain_phases(run);

  make_folder(folder);
  PartialFile partial(folder / "analysis.h5");
  hdf5::File file = hdf5::File::create(partial.path(), hdf5::File::Compatibility::compact);
  file.root.set_attribute("format", std::string_view("whipple-analysis"));
  file.root.set_attribute("version", std::int64_t{1});
  file.root.set_attribute("unit_system", std::string_view("SI"));
  write_case(run, file.root);
  write_frame(run, start, file.root);
  for (const Table& table : tables) write_hdf5(table, file.root);
  const hdf5::Group group = file.root.create_group("quantities");
  for (const Quantity& value : values) group.set_attribute(value.name, value.value);
  write_radiographs(run, frame, options, file.root);
  write_views(run, frame, options.views, file.root);
  file.close();
  // All output is computed before any existing file is replaced.
  for (const Table& table : tables) write_csv(table, folder);
  write_quantities(values, folder);
  partial.publish();
}

}  // namespace whipple::analysis
