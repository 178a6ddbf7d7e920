// SPDX-License-Identifier: BSD-3-Clause
#include "src/analysis/analyse.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "src/analysis/bar.hpp"
#include "src/analysis/cloud.hpp"
#include "src/analysis/columns.hpp"
#include "src/analysis/fragments.hpp"
#include "src/analysis/frame.hpp"
#include "src/analysis/outflow.hpp"
#include "src/analysis/peaks.hpp"
#include "src/analysis/radiograph.hpp"
#include "src/analysis/surfaces.hpp"
#include "src/analysis/table.hpp"
#include "src/analysis/witness.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/log.hpp"

namespace whipple::analysis {
namespace {

namespace fs = std::filesystem;

constexpr double open = 0.1;  ///< fraction of a plate's thickness: with less it is perforated

/// Holds what the first snapshot tells about the bodies.
struct Start {
  Frame frame;
  std::vector<Extent> extents;        ///< of each body along the axis
  std::optional<std::size_t> target;  ///< the first body that the projectile hits
  double projectile_mass = 0.0, projectile_radius = 0.0, particle_mass = 0.0;
  std::vector<Columns> columns;          ///< of each body
  std::vector<std::uint64_t> near_axis;  ///< particles that begin within a quarter of the projectile's radius
};

Start start_of(const Run& run, const Snapshot& first, const Options& options) {
  // Where something moves at the start, the last snapshot says nothing about the axis.
  std::optional<Snapshot> last;
  if (std::ranges::all_of(run.bodies, [](const BodyInput& body) { return body.velocity.isZero(0.0); })) {
    last = read_snapshot(run.snapshots.back());
  }
  Start start{.frame = find_frame(run, first, options.axis, last ? &*last : nullptr),
              .extents = {},
              .target = {},
              .columns = {},
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
    start.projectile_mass += frame.copies() * first.mass[i];
    start.projectile_radius =
        std::max(start.projectile_radius,
                 frame.radius(first.position[i]) + 0.5 * run.bodies[frame.projectile].spacing);
    count += 1.0;
  }
  start.particle_mass = count > 0.0 ? start.projectile_mass / (frame.copies() * count) : 0.0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (frame.radius(first.position[i]) < 0.25 * start.projectile_radius)
      start.near_axis.push_back(first.id[i]);
  }
  // What follows is measured about the point that an oblique flight hits.
  if (start.target) start.frame = start.frame.at_face(start.extents[*start.target].lower);
  for (std::size_t b = 0; b < run.bodies.size(); ++b) {
    start.columns.emplace_back(first, start.frame, b, 2.0 * run.cell_size);
  }
  return start;
}

/// Median melted fraction of the material that began near the axis.
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
    row.push_back({fmt::format("axis_melted_fraction.{}", bodies[b].name), "1",
                   "median over the mass that began within a quarter of the projectile's radius of the axis",
                   weighted_quantile(of_body[b], 0.5)});
  }
  return row;
}

void append(Quantities& row, Quantities more) { row.insert(row.end(), more.begin(), more.end()); }

/// All measures of one snapshot.
Quantities measure(const Run& run, const Start& start, const Options& options, const OutflowHistory& outflow,
                   const Snapshot& snapshot) {
  const Frame& frame = start.frame;
  Quantities row = {{"time", "s", "of the snapshot", snapshot.time}};
  append(row, cloud_measures(snapshot, frame, start.target ? start.extents[*start.target] : Extent{}));
  for (std::size_t b = 0; b < run.bodies.size(); ++b) {
    append(row, body_measures(snapshot, frame, b, run.bodies[b], outflow.at(b, snapshot.time)));
    append(row, bar_measures(snapshot, frame, b, run.bodies[b], run.cell_size, options.diameter_at,
                             frame.wall && start.extents[b].upper > *frame.wall - 0.01 * run.cell_size));
  }
  const bool has_volumes = snapshot.scalar("density") != nullptr;
  if (start.target && has_volumes && !frame.wall) {
    const Extent& extent = start.extents[*start.target];
    const Crater crater = measure_crater(snapshot, frame, extent.lower, extent.upper, run.cell_size);
    append(row,
           {{"crater_depth", "m", "of the floor on the axis below the original surface", crater.depth},
            {"crater_radius", "m", "in the plane of the original surface", crater.radius},
            {"crater_diameter", "m", "in the plane of the original surface", 2.0 * crater.radius},
            {"crater_depth_over_diameter", "1", "depth over diameter", 0.5 * crater.depth / crater.radius}});
    for (std::size_t b = 0; b < run.bodies.size(); ++b) {
      if (b == frame.projectile) continue;
      const Hole hole = measure_hole(snapshot, frame.at_face(start.extents[b].lower), b,
                                     start.extents[b].length(), run.cell_size);
      const double least_left = start.columns[b].least_left(snapshot);
      const std::string& name = run.bodies[b].name;
      append(row, {{fmt::format("hole_diameter.{}", name), "m",
                    "within which less than half of the plate is left", hole.diameter},
                   {fmt::format("left_on_axis.{}", name), "1",
                    "share of the thickness left where the line of flight meets it", hole.left_on_axis},
                   {fmt::format("least_left.{}", name), "1",
                    "least share of the thickness left along any line through it", least_left},
                   {fmt::format("perforated.{}", name), "1",
                    "1: less than a tenth of the thickness is left along some line through it",
                    least_left < open ? 1.0 : 0.0}});
    }
  }
  return row;
}

/// Front and radius are unknown from the time on at which the outermost debris comes within a cell of the
/// border of the domain: what leaves cannot be followed.
void end_at_the_border(const Run& run, const Frame& frame, Table& series) {
  const auto cut = [&](const char* outermost, std::initializer_list<const char*> names, double limit) {
    bool reached = false;
    const std::vector<double> position = series[outermost];
    for (std::size_t k = 0; k < position.size(); ++k) {
      reached = reached || position[k] >= limit;
      for (Column& column : series.columns) {
        const bool named = std::ranges::any_of(names, [&](const char* name) { return column.name == name; });
        if (reached && named) column.values[k] = nan;
      }
    }
  };
  const int z = frame.axis;
  const double border = frame.sign > 0.0 ? run.upper[z] : -run.lower[z];
  cut("foremost", {"front", "foremost", "cloud_length", "cloud_length_over_width"}, border - run.cell_size);
  double side = std::numeric_limits<double>::infinity();
  for (const int a : frame.transverse) {
    side = std::min(side, run.upper[a] - frame.centre[a] - run.cell_size);
    if (!frame.mirrored(a)) side = std::min(side, frame.centre[a] - run.lower[a] - run.cell_size);
  }
  cut("outermost", {"radius", "outermost", "cloud_length_over_width"}, side);
}

/// Evenly spread indices, the first and the last among them.
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

/// Writes what programs that show the run need of its input, so that they do not read it by rules of their own.
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

/// The last row of the series and what is known only when all snapshots were seen.
Quantities final_values(const Table& series, const Run& run, const Start& start) {
  Quantities row;
  for (const Column& column : series.columns) {
    row.push_back({column.name, column.unit, column.meaning, column.values.back()});
  }
  const auto set = [&](const char* name, const char* of) {
    std::ranges::find(row, name, &Quantity::name)->value = final_slope(series["time"], series[of]);
  };
  set("front_speed", "front");
  set("rear_speed", "rear");
  set("expansion_speed", "radius");
  const auto value = [&](const char* name) { return std::ranges::find(row, name, &Quantity::name)->value; };
  const double speed = start.frame.impact_speed > 0.0 ? start.frame.impact_speed : nan;
  append(
      row,
      {{"impact_speed", "m/s", "relative speed of the fastest and the slowest body at the start",
        start.frame.impact_speed},
       {"impact_angle", "rad", "of their relative velocity with the axis, 0 for a normal impact",
        start.frame.impact_angle},
       {"front_speed_over_impact_speed", "1", "ratio", value("front_speed") / speed},
       {"radial_speed_over_impact_speed", "1", "ratio", value("radial_speed") / speed}});
  const BodyInput& projectile = run.bodies[start.frame.projectile];
  row.push_back({"projectile_size", "m", "smallest extent of the projectile by its shape in the case",
                 projectile.velocity.isZero(0.0) ? nan : projectile.size});
  for (const BodyInput& body : run.bodies) {
    const std::string name = "front_velocity." + body.name;
    if (std::ranges::find(series.columns, name, &Column::name) == series.columns.end()) continue;
    row.push_back({"pullback." + body.name, "m/s",
                   "fall of the velocity of the forward surface from its maximum to the following minimum",
                   pullback(series[name])});
  }
  return row;
}

/// Says why values are missing.
void explain(const Quantities& values, bool planar) {
  struct Reason {
    const char* begin;
    const char* text;
  };
  constexpr std::array<Reason, 8> reasons = {
      {{"projectile_size", "nothing moves at the start, or the shape states no extent"},
       {"crater_", "no floor of a crater in the first target: it is open on the axis, or nothing has hit it"},
       {"hole_", "the plate has no matter left, or no edge of a hole that ends inside of it"},
       {"front", "no debris flies forward, or it has come to the border of the domain"},
       {"foremost", "no debris flies forward, or it has come to the border of the domain"},
       {"radi", "no debris flies forward, or it has come to the border of the domain"},
       {"outermost", "no debris flies forward, or it has come to the border of the domain"},
       {"pullback", "the forward surface was not slowed by a tenth after its greatest velocity"}}};
  constexpr const char* of_rings = "in two dimensions a connected piece of the section is a ring or a bar, no fragment";
  std::map<std::string, std::vector<std::string>> missing;
  for (const Quantity& value : values) {
    if (std::isfinite(value.value)) continue;
    const auto reason =
        std::ranges::find_if(reasons, [&](const Reason& r) { return value.name.starts_with(r.begin); });
    const bool fragment = planar && value.name.find("fragment") != std::string::npos;
    missing[fragment ? of_rings : reason == reasons.end() ? "nothing to measure it on" : reason->text].push_back(
        value.name);
  }
  for (const auto& [text, names] : missing) log::info("not measured: {} ({})", fmt::join(names, ", "), text);
}

void require_bodies(const Run& run, const Options& options) {
  std::vector<std::string> known, asked;
  for (const BodyInput& body : run.bodies) known.push_back(body.name);
  for (const auto& [name, value] : options.attenuation) asked.push_back(name);
  if (!options.peak_decay.empty()) asked.push_back(options.peak_decay);
  for (const std::string& name : asked) {
    if (std::ranges::find(known, name) != known.end()) continue;
    throw InputError(
        fmt::format("error: the run has no body \"{}\" (bodies: {})", name, fmt::join(known, ", ")));
  }
}

}  // namespace

void analyse(const Run& run, const Options& options, const fs::path& folder) {
  if (run.snapshots.empty())
    throw InputError(fmt::format("{}: error: has no snapshots", run.folder.string()));
  require_bodies(run, options);
  const Snapshot first = read_snapshot(run.snapshots.front());
  const Start start = start_of(run, first, options);
  const Frame& frame = start.frame;

  std::optional<PeakDecay> peaks;
  if (!options.peak_decay.empty()) {
    const auto body = static_cast<std::size_t>(
        std::ranges::find(run.bodies, options.peak_decay, &BodyInput::name) - run.bodies.begin());
    peaks.emplace(first, frame, body, 1.5 * run.cell_size, start.extents[body].lower);
  }
  Table series{
      .name = "series", .meaning = "measures of every snapshot", .label = {}, .labels = {}, .columns = {}};
  if (first.scalar("density") == nullptr) {
    log::warning("the snapshots have no density: no crater, holes, perforation or profile");
  }
  const OutflowHistory outflow(run);
  Snapshot last;
  for (const SnapshotEntry& entry : run.snapshots) {
    last = read_snapshot(entry);
    series.append(measure(run, start, options, outflow, last));
    if (peaks) peaks->add(last);
  }
  end_at_the_border(run, frame, series);
  add_speeds(series);

  Quantities values = final_values(series, run, start);
  append(values, axis_measures(last, start, run.bodies));
  for (std::size_t b = 0; b < run.bodies.size(); ++b) {
    append(values, spall_measures(first, last, frame, b, run.bodies[b]));
    append(values, rod_measures(first, last, b, run.bodies[b], run.cell_size));
  }
  const double link = options.link > 0.0 ? options.link : run.cell_size;
  const std::vector<Fragment> fragments = find_fragments(last, frame, link);
  Quantities of_fragments = fragment_measures(fragments, start.projectile_mass, start.particle_mass);
  if (frame.is_planar()) {
    for (Quantity& value : of_fragments) value.value = nan;
  }
  append(values, std::move(of_fragments));

  std::vector<Table> tables = {std::move(series), body_table(last, frame, run.bodies),
                               fragment_table(fragments, frame), fragment_distribution(fragments)};
  if (last.scalar("density") != nullptr) tables.push_back(diameter_profile(last, frame, run));
  if (peaks) {
    tables.push_back(peaks->profile(run.cell_size));
    append(values, peaks->measures(2.0 * start.projectile_radius));
  }
  if (options.witness) {
    Witness witness = witness_plate(last, frame, {.position = *options.witness, .ring = 2.0 * run.cell_size});
    append(values, witness.totals);
    tables.push_back(std::move(witness.rings));
    tables.push_back(std::move(witness.flux));
  }
  explain(values, frame.is_planar());
  Table quantities{.name = "quantities",
                   .meaning = "final values",
                   .label = "quantity",
                   .labels = {},
                   .columns = {{"value", "", "in the SI unit of the column `unit` of analysis.h5", {}}}};
  for (const Quantity& value : values) {
    quantities.labels.push_back(value.name);
    quantities.columns[0].values.push_back(value.value);
  }
  tables.push_back(std::move(quantities));

  fs::create_directories(folder);
  PartialFile partial(folder / "analysis.h5");
  hdf5::File file = hdf5::File::create(partial.path(), hdf5::File::Compatibility::compact);
  file.root.set_attribute("format", std::string_view("whipple-analysis"));
  file.root.set_attribute("version", std::int64_t{1});
  file.root.set_attribute("unit_system", std::string_view("SI"));
  write_case(run, file.root);
  write_frame(run, start, file.root);
  for (const Table& table : tables) {
    write_hdf5(table, file.root);
    write_csv(table, folder);
  }
  const hdf5::Group group = file.root.open_group("quantities");
  for (const Quantity& value : values) group.set_attribute(value.name, value.value);
  write_radiographs(run, frame, options, file.root);
  file.close();
  partial.publish();
}

}  // namespace whipple::analysis
