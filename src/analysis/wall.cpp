// SPDX-License-Identifier: BSD-3-Clause
#include "src/analysis/wall.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

#include "src/analysis/measures.hpp"
#include "src/analysis/pieces.hpp"
#include "src/analysis/surfaces.hpp"

namespace whipple::analysis {
namespace {

/// Reduces the linking length so that two lattice planes one length apart do not touch: a layer of failed particles
/// between them separates.
constexpr double touching = 0.99;

/// Sets the fraction of the thickness below which a point of a wall counts as damaged.
constexpr double undamaged = 0.9;

/// Returns the distance within which particles of a body touch: one cell, within which they interact through the grid,
/// or 1.5 initial spacings if that is larger.
double reach_of(const Run& run, std::size_t body) {
  return std::max(run.cell_size, 1.5 * run.bodies[body].spacing);
}

/// Returns the frame of a body: along the axis of the flight, or along the thin direction of a plate if the flight has
/// a component in that direction.
Frame frame_of(const Run& run, const Snapshot& first, const Frame& flight, std::size_t body) {
  constexpr double thin = 0.5, component = 0.05;
  const double spacing = run.bodies[body].spacing;
  int axis = flight.axis;
  double least = thin * axial_extent(first, flight, body, spacing).length();
  for (const int a : flight.transverse) {
    if (flight.mirrored(a) || !(std::abs(flight.direction[a]) > component)) continue;
    const double length = axial_extent(first, flight.along(a), body, spacing).length();
    if (!(length < least)) continue;
    least = length;
    axis = a;
  }
  const Frame frame = flight.along(axis);
  return frame.at_face(axial_extent(first, frame, body, spacing).lower);
}

/// Returns the lower of the two cells nearest to a coordinate in cells; the other is the next one.
std::ptrdiff_t lower_cell(double x) { return static_cast<std::ptrdiff_t>(std::floor(x - 0.5)); }

}  // namespace

Wall::Wall(const Run& run, const Snapshot& first, const Frame& flight, std::size_t body)
    : run_(run),
      frame_(frame_of(run, first, flight, body)),
      body_(body),
      extent_(axial_extent(first, frame_, body, run.bodies[body].spacing)),
      reach_(reach_of(run, body)),
      columns_(first, frame_, body, 2.0 * run.cell_size) {
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (first.body[i] != body) continue;
    id_.push_back(first.id[i]);
    place_.push_back(first.position[i]);
    rim_ += columns_.inside(first.position[i]) ? 0.0 : 1.0;
  }
  if (!run.bodies[body].condensed) {
    never_ = "the body is a gas";
  } else if (!columns_.any()) {
    never_ = "the face of the body is too narrow: no column of two cells lies within its rim";
  }
  if (!never_.empty()) return;
  const std::array<double, 2> widths = columns_.widths();
  for (std::size_t a = 0; a < 2; ++a)
    cells_[a] = static_cast<std::size_t>(std::ceil(widths[a] / reach_ - 1e-9));
  for (std::size_t i = 0; i < cells_[0]; ++i) {
    for (std::size_t j = 0; j < cells_[1]; ++j) {
      Vector3 middle = Vector3::Zero();
      middle[frame_.transverse[0]] = columns_.lower()[0] + (static_cast<double>(i) + 0.5) * reach_;
      middle[frame_.transverse[1]] = columns_.lower()[1] + (static_cast<double>(j) + 0.5) * reach_;
      face_.push_back(columns_.inside(middle) ? 1 : 0);
      face_cells_ += face_.back();
    }
  }
  if (undecided(first).empty() && !remains(first).closed) {
    never_ = "the body is open along the axis from the start, or its particles do not touch";
  }
}

std::string Wall::undecided(const Snapshot& snapshot) const {
  if (!never_.empty()) return never_;
  if (snapshot.scalar("failed") == nullptr) return "the snapshots lack the field failed";
  return {};
}

/// Finds the connected pieces of the material that has neither failed nor melted, by decreasing number of particles.
std::vector<Wall::Piece> Wall::pieces(const Snapshot& snapshot) const {
  const std::vector<double>& failed = *snapshot.scalar("failed");
  const std::vector<double>* damage = snapshot.scalar("damage");
  const std::vector<double>* phase = snapshot.scalar("phase");
  Piece intact;
  std::vector<Vector3> points;
  for (std::uint32_t i = 0; i < snapshot.size(); ++i) {
    if (snapshot.body[i] != body_ || failed[i] > 0.0) continue;
    if (damage != nullptr && (*damage)[i] >= 1.0) continue;
    if (phase != nullptr && (*phase)[i] >= 2.0) continue;  // liquid, vapour
    intact.push_back(i);
    points.push_back(snapshot.position[i]);
  }
  const std::vector<std::uint32_t> label = connected_components(points, touching * reach_);
  std::vector<std::size_t> piece_of(label.size());
  std::vector<Piece> result;
  for (std::size_t k = 0; k < label.size(); ++k) {
    if (label[k] == k) {  // the first of its piece
      piece_of[k] = result.size();
      result.emplace_back();
    }
    result[piece_of[label[k]]].push_back(intact[k]);
  }
  std::ranges::stable_sort(result, std::greater{}, &Piece::size);
  return result;
}

const Vector3* Wall::place_of(std::uint64_t id) const {
  const auto found = std::ranges::lower_bound(id_, id);
  return found == id_.end() || *found != id ? nullptr
                                            : &place_[static_cast<std::size_t>(found - id_.begin())];
}

Vector3 Wall::shift_of(const Snapshot& snapshot, const Piece& piece) const {
  Vector3 sum = Vector3::Zero();
  double count = 0.0;
  for (const std::uint32_t i : piece) {
    const Vector3* place = place_of(snapshot.id[i]);
    if (place == nullptr) continue;
    sum += snapshot.position[i] - *place;
    count += 1.0;
  }
  if (count > 0.0) sum /= count;
  sum[frame_.axis] = 0.0;
  for (const int a : frame_.transverse) {
    if (frame_.mirrored(a) || frame_.dimension == grid::Dimension::axisymmetric) sum[a] = 0.0;
  }
  return sum;
}

/// Fills the cells around the particles of a piece and searches for a path of empty cells, over the face of the body,
/// from before the piece to behind it. Every particle fills the eight nearest cells: openings narrower than about two
/// cells are not detected.
bool Wall::closes(const Snapshot& snapshot, const Piece& piece, const Vector3& shift) const {
  if (4 * piece.size() < face_cells_) return false;  // cannot cover the face
  double front = std::numeric_limits<double>::infinity(), rear = -front;
  for (const std::uint32_t i : piece) {
    front = std::min(front, frame_.axial(snapshot.position[i]));
    rear = std::max(rear, frame_.axial(snapshot.position[i]));
  }
  front -= 2.0 * reach_;
  const std::size_t n0 = cells_[0], n1 = cells_[1];
  const auto layers = static_cast<std::size_t>(std::ceil((rear - front) / reach_)) + 2;
  enum : std::uint8_t { empty, filled, reached };
  std::vector<std::uint8_t> cells(n0 * n1 * layers, empty);
  const auto index = [&](std::size_t i, std::size_t j, std::size_t layer) {
    return (layer * n0 + i) * n1 + j;
  };
  for (const std::uint32_t p : piece) {
    std::array<std::ptrdiff_t, 2> at{};
    for (std::size_t a = 0; a < 2; ++a) {
      const int axis = frame_.transverse[a];
      at[a] = lower_cell((snapshot.position[p][axis] - shift[axis] - columns_.lower()[a]) / reach_);
    }
    const std::ptrdiff_t along = lower_cell((frame_.axial(snapshot.position[p]) - front) / reach_);
    for (std::ptrdiff_t i = at[0]; i < at[0] + 2; ++i) {
      for (std::ptrdiff_t j = at[1]; j < at[1] + 2; ++j) {
        if (i < 0 || j < 0 || i >= static_cast<std::ptrdiff_t>(n0) || j >= static_cast<std::ptrdiff_t>(n1))
          continue;
        for (std::ptrdiff_t k = along; k < along + 2; ++k) {
          cells[index(static_cast<std::size_t>(i), static_cast<std::size_t>(j),
                      static_cast<std::size_t>(k))] = filled;
        }
      }
    }
  }
  std::vector<std::array<std::size_t, 3>> open;
  const auto enter = [&](std::size_t i, std::size_t j, std::size_t layer) {
    if (i >= n0 || j >= n1 || layer >= layers || face_[i * n1 + j] == 0) return;
    std::uint8_t& cell = cells[index(i, j, layer)];
    if (cell != empty) return;
    cell = reached;
    open.push_back({i, j, layer});
  };
  for (std::size_t i = 0; i < n0; ++i) {
    for (std::size_t j = 0; j < n1; ++j) enter(i, j, 0);
  }
  while (!open.empty()) {
    const auto [i, j, layer] = open.back();
    open.pop_back();
    if (layer + 1 == layers) return false;
    enter(i, j, layer + 1);
    enter(i, j, layer - 1);  // wraps below 0: beyond the last one
    enter(i + 1, j, layer);
    enter(i - 1, j, layer);
    enter(i, j + 1, layer);
    enter(i, j - 1, layer);
  }
  return true;
}

Wall::Remains Wall::remains(const Snapshot& snapshot) const {
  Remains result;
  result.wall.assign(snapshot.size(), 0);
  result.front.assign(snapshot.size(), 0);
  const std::vector<Piece> all = pieces(snapshot);
  if (all.empty()) return result;
  result.shift = shift_of(snapshot, all.front());
  const auto take = [&](const Piece& piece) {
    for (const std::uint32_t i : piece) result.wall[i] = 1;
  };
  // Layers separated by a spall plane may each close the body.
  const Piece* front = nullptr;
  double foremost = std::numeric_limits<double>::infinity();
  for (const Piece& piece : all) {
    if (!closes(snapshot, piece, shift_of(snapshot, piece))) continue;
    take(piece);
    double place = 0.0;
    for (const std::uint32_t i : piece) place += frame_.axial(snapshot.position[i]);
    place /= static_cast<double>(piece.size());
    if (!(place < foremost)) continue;
    foremost = place;
    front = &piece;
  }
  result.closed = front != nullptr;
  if (result.closed) {
    for (const std::uint32_t i : *front) result.front[i] = 1;
    return result;
  }
  // Debris is not attached to the rim, from which only small pieces may originate.
  constexpr double much = 0.1;
  for (const Piece& piece : all) {
    const auto from_rim =
        std::ranges::count_if(piece, [&](std::uint32_t i) { return began_on_rim(snapshot.id[i]); });
    if (static_cast<double>(from_rim) >= much * rim_ || &piece == &all.front()) take(piece);
  }
  return result;
}

/// Returns whether the wall has reached an end of the domain along the axis, beyond which it cannot be followed.
bool Wall::at_border(const Snapshot& snapshot, const Remains& remains) const {
  double lower = run_.lower_at(snapshot.time)[frame_.axis], upper = run_.upper_at(snapshot.time)[frame_.axis];
  if (frame_.sign < 0.0) std::tie(lower, upper) = std::pair(-upper, -lower);
  lower += run_.cell_size;
  upper -= run_.cell_size;
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    if (remains.wall[i] == 0) continue;
    const double z = frame_.axial(snapshot.position[i]);
    if ((z < lower && extent_.lower > lower) || (z > upper && extent_.upper < upper)) return true;
  }
  return false;
}

std::optional<std::size_t> Wall::cell_at(const Vector3& position, const Vector3& shift) const {
  std::array<std::size_t, 2> at{};
  for (std::size_t a = 0; a < 2; ++a) {
    const int axis = frame_.transverse[a];
    const double x = std::floor((position[axis] - shift[axis] - columns_.lower()[a]) / reach_);
    if (!(x >= 0.0 && x < static_cast<double>(cells_[a]))) return std::nullopt;
    at[a] = static_cast<std::size_t>(x);
  }
  return at[0] * cells_[1] + at[1];
}

double Wall::cell_area(std::size_t cell) const {
  if (frame_.dimension == grid::Dimension::space) return frame_.copies() * reach_ * reach_;
  const std::size_t ring = cell / cells_[1];
  const double inner = columns_.lower()[0] + static_cast<double>(ring) * reach_;
  return frame_.ring_area(inner, inner + reach_);
}

bool Wall::began_on_rim(std::uint64_t id) const {
  const Vector3* place = place_of(id);
  return place != nullptr && !columns_.inside(*place);
}

double Wall::spall_mass(const Snapshot& snapshot, const Remains& remains) const {
  // Rear surface of the remaining wall, by cells over the face; where nothing is left, the initial rear face of the
  // body.
  std::vector<double> rear(face_cells(), -std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    if (remains.wall[i] == 0) continue;
    if (const auto cell = cell_at(snapshot.position[i], remains.shift))
      rear[*cell] = std::max(rear[*cell], frame_.axial(snapshot.position[i]));
  }
  double mass = 0.0;
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    if (snapshot.body[i] != body_ || remains.wall[i] != 0) continue;
    const auto cell = cell_at(snapshot.position[i], remains.shift);
    const double own = cell ? rear[*cell] : -std::numeric_limits<double>::infinity();
    const double limit = std::isfinite(own) ? own : extent_.upper;
    if (frame_.axial(snapshot.position[i]) > limit + reach_) mass += frame_.copies() * snapshot.mass[i];
  }
  return mass;
}

Wall::Remains Wall::look(const Snapshot& snapshot) {
  Remains left;
  left.undecided = undecided(snapshot);
  if (!left.undecided.empty()) return left;
  left = remains(snapshot);
  // A bulge that has left the domain looks like a hole; a hole found earlier remains one.
  if (!perforated_ && at_border(snapshot, left)) {
    left.undecided = "the wall has come to the border of the domain";
    return left;
  }
  perforated_ = perforated_ || !left.closed;
  return left;
}

Quantities Wall::measure(const Snapshot& snapshot, const Remains& left) const {
  const std::string& name = run_.bodies[body_].name;
  const std::string& reason = left.undecided;
  if (!reason.empty()) {
    Quantities row;
    for (const char* measure :
         {"perforated", "least_left", "left_on_axis", "hole_diameter", "damaged_area", "spall_mass"})
      row.push_back(measured(measure, name, nan, reason));
    return row;
  }
  const Hole hole = measure_hole(snapshot, frame_, left.wall, extent_.length(), run_.cell_size);
  const double diameter = left.closed || !(hole.diameter > 0.0) ? nan : hole.diameter;
  return {
      measured("perforated", name, left.closed ? 0.0 : 1.0),
      measured("least_left", name, columns_.least_left(snapshot, left.wall, left.shift)),
      measured("left_on_axis", name, hole.left_on_axis),
      measured("hole_diameter", name, diameter,
               left.closed ? "the body is not perforated"
                           : "no hole about the line of flight that ends within the body"),
      measured("damaged_area", name, columns_.area_below(undamaged, snapshot, left.wall, left.shift)),
      measured("spall_mass", name, left.closed ? spall_mass(snapshot, left) : nan, "the body is perforated")};
}

}  // namespace whipple::analysis
