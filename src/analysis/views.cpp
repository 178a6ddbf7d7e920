// SPDX-License-Identifier: BSD-3-Clause
#include "src/analysis/views.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <unordered_map>

#include "src/analysis/canvas.hpp"
#include "src/analysis/radiograph.hpp"

namespace whipple::analysis {
namespace {

constexpr const char* density = "density";
constexpr double fading = 0.3;  // of the brightness, from the nearest to the farthest visible point
constexpr double beyond_the_scale = 0.02;  // fraction of the moving mass outside of the scale, at each end

/// Describes a field of the views. Its values are those of the points; the value of an element is the mean over its
/// points.
struct ShownField {
  const char* name;
  bool on_scale = false;  ///< coloured by a scale with quantiles as ends; otherwise by classes
  std::vector<double> (*made)(const Snapshot&) = nullptr;  ///< null: the field of this name in the snapshot

  /// Returns the values of the field, nothing if the snapshot does not have it.
  [[nodiscard]] std::optional<std::vector<double>> values(const Snapshot& snapshot) const {
    if (made != nullptr) return made(snapshot);
    const std::vector<double>* stored = snapshot.scalar(name);
    return stored == nullptr ? std::nullopt : std::optional(*stored);
  }
};

const ShownField fields[] = {
    {"body", false, [](const Snapshot& s) { return std::vector<double>(s.body.begin(), s.body.end()); }},
    {"phase"},
    {"failed"},
    {"temperature", true},
    {"pressure", true},
    {"speed", true,
     [](const Snapshot& s) {
       std::vector<double> speeds;
       for (const Vector3& v : s.velocity) speeds.push_back(v.norm());
       return speeds;
     }},
    {"plastic_strain", true},
    {"damage", true},
    {"burn_fraction", true},
};

/// Reads a snapshot and keeps the fields that the views show.
Snapshot read_shown(const SnapshotEntry& entry) {
  Snapshot snapshot = read_snapshot(entry);
  std::erase_if(snapshot.scalars, [](const auto& scalar) {
    return scalar.first != density &&
           std::ranges::find(fields, scalar.first, &ShownField::name) == std::end(fields);
  });
  return snapshot;
}

/// Lists the items of a snapshot: points, then elements, each identified by the first of its eight points.
struct Scene {
  const Snapshot& snapshot;
  std::vector<std::size_t> points;    ///< those that are not part of elements
  std::vector<std::size_t> elements;  ///< first point of each

  explicit Scene(const Snapshot& of) : snapshot(of) {
    std::vector<bool> is_part(of.size(), false);
    for (const Hexahedron& element : of.hexahedra) {
      const auto first =
          static_cast<std::size_t>(std::ranges::lower_bound(of.id, element.first) - of.id.begin());
      elements.push_back(first);
      for (std::size_t k = 0; k < 8; ++k) is_part[first + k] = true;
    }
    for (std::size_t i = 0; i < of.size(); ++i) {
      if (!is_part[i]) points.push_back(i);
    }
  }
  [[nodiscard]] std::size_t size() const { return points.size() + elements.size(); }
  /// Returns the mean of the values at the points of an item.
  template <class Value>
  [[nodiscard]] Value mean(const std::vector<Value>& values, std::size_t item) const {
    if (item < points.size()) return values[points[item]];
    const std::size_t first = elements[item - points.size()];
    Value sum = values[first];
    for (std::size_t k = 1; k < 8; ++k) sum += values[first + k];
    return sum / 8.0;
  }
};

/// Holds the projection of all views, with limits common to all times, so that growth is visible.
struct Projection {
  const Frame& frame;
  PictureLimits limits;
  double pixel = 0.0;  ///< m
  std::size_t rows = 0, columns = 0;

  [[nodiscard]] bool is_mirrored() const {
    return frame.mirrored(frame.transverse[0]) || frame.dimension == grid::Dimension::axisymmetric;
  }
  /// Returns the coordinates relative to the axis: axial, upward, and toward the viewer, m.
  [[nodiscard]] Vector3 coordinates(const Vector3& position) const {
    const Vector3 offset = position - frame.centre;
    return {frame.axial(offset), offset[frame.transverse[0]], -offset[frame.transverse[1]]};
  }
  /// Returns the position in the picture (pixels). @param side  -1: for the image below the axis
  [[nodiscard]] Vector3 place(const Vector3& coordinates, double side, bool from_outside) const {
    const bool both = from_outside && frame.mirrored(frame.transverse[1]);
    return {(coordinates[0] - limits.lower_axial) / pixel, (side * coordinates[1] - limits.lower_up) / pixel,
            (both ? std::abs(coordinates[2]) : coordinates[2]) / pixel};
  }
};

// Taller pictures have coarser pixels: nobody sees more on a page, and their number would have no bound.
constexpr double most_rows_per_column = 2.0;

Projection projection_of(const Frame& frame, const std::vector<Snapshot>& snapshots, std::size_t columns) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Projection projection{.frame = frame, .limits = {infinity, -infinity, 0.0, 0.0}};
  PictureLimits& limits = projection.limits;
  for (const Snapshot& snapshot : snapshots) limits.include(snapshot, frame);
  if (!std::isfinite(limits.lower_axial)) limits = {0.0, 1.0, projection.is_mirrored() ? -1.0 : 0.0, 1.0};
  const double pad = 0.04 * std::max(limits.upper_axial - limits.lower_axial, 1e-12);
  limits.lower_axial -= pad;
  limits.upper_axial += pad;
  limits.lower_up -= pad;
  limits.upper_up += pad;
  const double width = limits.upper_axial - limits.lower_axial, height = limits.upper_up - limits.lower_up;
  const double most_rows = most_rows_per_column * static_cast<double>(columns);
  projection.columns = columns;
  projection.pixel = width / static_cast<double>(columns);
  if (height > most_rows * projection.pixel) {  // a cloud that is wider than it is long
    projection.pixel = height / most_rows;
    projection.columns =
        std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(width / projection.pixel)));
  }
  projection.rows = static_cast<std::size_t>(std::ceil(height / projection.pixel));
  return projection;
}

/// Counts points in the cells of a cubic lattice.
class CellCounts {
 public:
  CellCounts(const std::vector<Vector3>& positions, double width, bool planar)
      : width_(width), deep_(planar ? 0 : 1) {
    for (const Vector3& x : positions) ++counts_[key(cell_of(x))];
  }
  /// Returns the number of points in the cell of a position and in its neighbours.
  [[nodiscard]] double around(const Vector3& x) const {
    const std::array<std::int64_t, 3> cell = cell_of(x);
    std::size_t points = 0;
    for (std::int64_t i = -1; i <= 1; ++i) {
      for (std::int64_t j = -1; j <= 1; ++j) {
        for (std::int64_t k = -deep_; k <= deep_; ++k) {
          const auto found = counts_.find(key({cell[0] + i, cell[1] + j, cell[2] + k}));
          if (found != counts_.end()) points += found->second;
        }
      }
    }
    return static_cast<double>(points);
  }

 private:
  [[nodiscard]] std::array<std::int64_t, 3> cell_of(const Vector3& x) const {
    std::array<std::int64_t, 3> cell{};
    for (std::size_t a = 0; a < 3; ++a) {
      cell[a] = static_cast<std::int64_t>(
          std::floor(std::clamp(x[static_cast<Eigen::Index>(a)] / width_, -1e5, 1e5)));
    }
    return cell;
  }
  /// Cells are limited to 100,000 from the origin; positions farther away are assigned to the outermost cells.
  static std::uint64_t key(const std::array<std::int64_t, 3>& cell) {
    constexpr std::int64_t middle = 1 << 20;
    return static_cast<std::uint64_t>(cell[0] + middle) << 42U |
           static_cast<std::uint64_t>(cell[1] + middle) << 21U | static_cast<std::uint64_t>(cell[2] + middle);
  }

  double width_;
  std::int64_t deep_;
  std::unordered_map<std::uint64_t, std::size_t> counts_;
};

/// Returns the diameters (m) of the points of a scene, limited to 24 pixels or to the median edge, whichever is larger:
/// points of thin debris and gas would otherwise hide the items behind.
std::vector<double> diameters_of(const Scene& scene, const Frame& frame, double pixel) {
  constexpr double widest = 24.0;  // pixels
  const Snapshot& snapshot = scene.snapshot;
  const std::vector<double>* densities = snapshot.scalar(density);
  if (densities == nullptr) return std::vector<double>(scene.points.size(), 0.0);
  std::vector<Vector3> positions;
  std::vector<double> edges;
  for (const std::size_t i : scene.points) {
    positions.push_back(snapshot.position[i]);
    edges.push_back(frame.edge(snapshot.mass[i] / std::max((*densities)[i], 1e-3), snapshot.position[i]));
  }
  std::vector<double> diameters = drawn_diameters(positions, edges, frame.is_planar());
  if (edges.empty()) return diameters;
  std::ranges::nth_element(edges, edges.begin() + std::ssize(edges) / 2);
  const double most = std::max(edges[edges.size() / 2], widest * pixel);
  for (double& diameter : diameters) diameter = std::min(diameter, most);
  return diameters;
}

/// Draws a scene; labels are the indices of its items. @param outside  view from outside; otherwise a section through
/// the axis along the picture plane
Canvas draw(const Scene& scene, const std::vector<double>& diameters, const Projection& projection,
            bool outside) {
  const Snapshot& snapshot = scene.snapshot;
  const Frame& frame = projection.frame;
  const bool whole = outside || frame.is_planar();
  Canvas canvas(projection.rows, projection.columns);
  std::vector<Corners> shown;
  std::vector<std::uint32_t> number;  // of the items of the elements shown
  for (std::size_t e = 0; e < scene.elements.size(); ++e) {
    const std::size_t item = scene.points.size() + e;
    if (!whole && projection.coordinates(scene.mean(snapshot.position, item))[2] > 0.0) continue;
    shown.push_back(snapshot.hexahedra[e].corners);
    number.push_back(static_cast<std::uint32_t>(item));
  }
  const std::vector<Face> faces = surface_faces(shown);
  for (const double side : {1.0, -1.0}) {
    if (side < 0.0 && !projection.is_mirrored()) break;
    std::vector<std::array<Vector3, 4>> corners;
    std::vector<std::uint32_t> labels;
    for (const Face& face : faces) {
      std::array<Vector3, 4>& places = corners.emplace_back();
      for (std::size_t k = 0; k < 4; ++k) {
        const Vector3& node = snapshot.nodes[face.corners[k]];
        places[k] = projection.place(projection.coordinates(node), side, outside);
      }
      labels.push_back(number[face.element]);
    }
    canvas.faces(corners, labels);
    for (std::size_t item = 0; item < scene.points.size(); ++item) {
      const std::size_t i = scene.points[item];
      const Vector3 coordinates = projection.coordinates(snapshot.position[i]);
      if (!whole && coordinates[2] > 0.0) continue;
      canvas.sphere(projection.place(coordinates, side, outside), 0.5 * diameters[item] / projection.pixel,
                    static_cast<std::uint32_t>(item));
    }
  }
  canvas.shade(frame.is_planar() ? 0.0 : fading);
  return canvas;
}

/// Writes a picture: `light` and `seen` (0: nothing, otherwise the number of an item, from 1 on, in the lists of the
/// fields).
void write_picture(const Canvas& canvas, const Scene& scene, std::span<const ShownField> shown,
                   const hdf5::Group& group) {
  constexpr int deflate = 4;
  const hdf5::Slab all = hdf5::Slab::whole(canvas.rows());
  const hdf5::Storage image{.columns = canvas.columns(), .deflate = deflate};
  group.write<float>("light", canvas.light(), all, image);
  std::vector<std::uint32_t> items = canvas.seen();
  std::ranges::sort(items);
  items.erase(std::ranges::unique(items).begin(), items.end());
  if (!items.empty() && items.back() == Canvas::nothing) items.pop_back();
  std::vector<std::uint32_t> seen;
  for (const std::uint32_t label : canvas.seen()) {
    const auto found = std::ranges::lower_bound(items, label);
    seen.push_back(label == Canvas::nothing ? 0 : static_cast<std::uint32_t>(found - items.begin()) + 1);
  }
  group.write<std::uint32_t>("seen", seen, all, image);
  for (const ShownField& field : shown) {
    const auto values = field.values(scene.snapshot);
    if (!values) continue;
    std::vector<float> of_items;
    for (const std::uint32_t item : items) of_items.push_back(static_cast<float>(scene.mean(*values, item)));
    group.write<float>(field.name, of_items, hdf5::Slab::whole(of_items.size()), {.deflate = deflate});
  }
}

/// Writes the ends of the scale of a field: the widest range over all times except the first, which is before the
/// impact, between two quantiles over the moving mass. A field that is zero everywhere has no scale.
void write_scale(const ShownField& field, const std::vector<Snapshot>& snapshots, const Frame& frame,
                 const hdf5::Group& group) {
  std::vector<double> ends;
  bool is_zero = true;
  for (std::size_t k = 0; k < snapshots.size(); ++k) {
    const Snapshot& snapshot = snapshots[k];
    const auto values = field.values(snapshot);
    if (!values) return;
    is_zero = is_zero && std::ranges::all_of(*values, [](double value) { return value == 0.0; });
    if (k == 0 && snapshots.size() > 1) continue;
    const auto moves = [&](std::size_t i) { return snapshot.velocity[i].norm() > 0.05 * frame.impact_speed; };
    bool any = false;  // stationary cold walls set no scale, unless there is nothing else
    for (std::size_t i = 0; i < snapshot.size() && !any; ++i) any = moves(i);
    std::vector<std::pair<double, double>> value_and_mass;
    for (std::size_t i = 0; i < snapshot.size(); ++i) {
      if (!any || moves(i)) value_and_mass.emplace_back((*values)[i], snapshot.mass[i]);
    }
    if (value_and_mass.empty()) continue;
    const double low = weighted_quantile(value_and_mass, beyond_the_scale),
                 high = weighted_quantile(value_and_mass, 1.0 - beyond_the_scale);
    ends =
        ends.empty() ? std::vector{low, high} : std::vector{std::min(ends[0], low), std::max(ends[1], high)};
  }
  if (is_zero || ends.empty()) return;
  group.write<double>(field.name, ends, hdf5::Slab::whole(2));
}

}  // namespace

std::vector<std::size_t> shown_snapshots(const std::vector<SnapshotEntry>& entries, int at_most) {
  std::vector<std::size_t> numbers;
  const auto count = std::min(entries.size(), static_cast<std::size_t>(std::max(at_most, 0)));
  for (std::size_t k = 0; k < count; ++k) {
    const double part = count == 1 ? 0.0 : static_cast<double>(k) / static_cast<double>(count - 1);
    const double first = entries.front().time, wanted = first + (entries.back().time - first) * part * part;
    const auto nearest = std::ranges::min_element(
        entries, {}, [&](const SnapshotEntry& entry) { return std::abs(entry.time - wanted); });
    numbers.push_back(static_cast<std::size_t>(nearest - entries.begin()));
  }
  numbers.erase(std::ranges::unique(numbers).begin(), numbers.end());
  return numbers;
}

std::vector<double> drawn_diameters(const std::vector<Vector3>& positions, const std::vector<double>& edges,
                                    bool planar) {
  // Computes mean distances in the smallest of several boxes, three cells wide, that holds enough points: small for
  // compact fragments, large for thin debris. The widths of the cells are in median edges.
  constexpr std::array widths = {1.5, 3.0, 6.0};
  const double enough = planar ? 5.0 : 12.0;
  constexpr double connected = 5.0,
                   apart = 7.0;  // edges: distances up to which spheres touch, and from which they do not
  std::vector<double> diameters = edges;
  if (positions.empty()) return diameters;
  std::vector<double> sorted = edges;
  std::ranges::nth_element(sorted, sorted.begin() + std::ssize(sorted) / 2);
  const double edge = sorted[sorted.size() / 2];
  if (!(edge > 0.0)) return diameters;
  std::vector<std::size_t> left(positions.size());
  std::iota(left.begin(), left.end(), std::size_t{0});
  for (const double width : widths) {
    const CellCounts counts(positions, width * edge, planar);
    std::erase_if(left, [&](std::size_t i) {
      const double points = counts.around(positions[i]);
      if (points < enough) return false;
      const double each = planar ? std::sqrt(9.0 / points) : std::cbrt(27.0 / points);
      const double distance = width * edge * each / edges[i];
      const double reached =
          distance < connected ? distance
                               : connected - (connected - 1.0) * (distance - connected) / (apart - connected);
      diameters[i] = edges[i] * std::max(1.0, reached);
      return true;
    });
  }
  // The cross-section of a ring of thin debris grows without bound; an isolated one is not drawn as a ball of that
  // width.
  if (planar) {
    for (const std::size_t i : left) diameters[i] = std::min(diameters[i], edge);
  }
  return diameters;
}

void write_views(const Run& run, const Frame& frame, const ViewOptions& options, const hdf5::Group& root) {
  std::vector<Snapshot> snapshots;
  for (const std::size_t number : shown_snapshots(run.snapshots, options.times)) {
    snapshots.push_back(read_shown(run.snapshots[number]));
  }
  if (snapshots.empty()) return;
  const Projection projection = projection_of(frame, snapshots, options.columns);
  const hdf5::Group group = root.create_group("views");
  group.set_attribute("lower_axial", projection.limits.lower_axial);
  group.set_attribute("upper_axial", projection.limits.upper_axial);
  group.set_attribute("lower_up", projection.limits.lower_up);
  group.set_attribute("upper_up", projection.limits.upper_up);
  const hdf5::Group scales = group.create_group("scales");
  for (const ShownField& field : fields) {
    if (field.on_scale) write_scale(field, snapshots, frame, scales);
  }
  const hdf5::Group times = group.create_group("times");
  for (std::size_t k = 0; k < snapshots.size(); ++k) {
    const Scene scene(snapshots[k]);
    const hdf5::Group at = times.create_group(fmt::format("{:04}", k));
    at.set_attribute("time", snapshots[k].time);
    at.set_attribute("items", static_cast<std::int64_t>(scene.size()));
    const std::vector<double> diameters = diameters_of(scene, frame, projection.pixel);
    write_picture(draw(scene, diameters, projection, false), scene, fields, at.create_group("section"));
    if (frame.is_planar()) continue;
    write_picture(draw(scene, diameters, projection, true), scene, std::span(fields).first(1),
                  at.create_group("outside"));
  }
}

}  // namespace whipple::analysis
