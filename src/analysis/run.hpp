// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "src/core/base/tensor.hpp"
#include "src/grid/geometry.hpp"

/// Measures of a finished or running run, from run.toml and the snapshots alone (docs/theory/analysis.md).
/// SI.
namespace whipple::analysis {

/// Holds what the input tells about a body.
struct BodyInput {
  std::string name;
  Vector3 velocity = Vector3::Zero();  ///< initial, m/s
  double spacing = 0.0;                ///< initial distance of the particles, m
  double size = 0.0;                   ///< smallest extent by its shape, m; NaN if the shape states none
  bool phases = true;     ///< its equation of state knows phases; otherwise all of it counts as solid
  bool condensed = true;  ///< it begins as condensed material, not as a gas
};

struct SnapshotEntry {
  std::filesystem::path file;
  double time = 0.0;                         ///< s
  std::size_t bodies = 65536;                ///< of the run: particles of others are refused
  Vector3 frame_velocity = Vector3::Zero();  ///< m/s, taken off all velocities, and its way off all positions
  /// The domain and as much again around it, m: points beyond are those of a damaged file.
  Vector3 lower = Vector3::Constant(-1e300), upper = Vector3::Constant(1e300);
};

/// The folder of a run.
struct Run {
  std::filesystem::path folder;
  std::string title;
  double cell_size = 0.0;
  Vector3 lower = Vector3::Zero(), upper = Vector3::Zero();  ///< corners of the domain
  grid::Dimension dimension = grid::Dimension::space;
  /// Position of the mirror plane normal to each axis, if there is one (the lower one of two). The axis of rings and
  /// the plane of two dimensions are none: masses are those of whole rings, or of a slice.
  std::array<std::optional<double>, 3> mirror_planes;
  /// A face of the domain that material does not pass.
  struct Wall {
    double position = 0.0;
    bool holds = true;  ///< a mirror plane, which material does not leave either
  };
  std::array<std::array<std::optional<Wall>, 2>, 3> walls;  ///< lower and upper, of each axis
  /// Velocity of the target at the start, m/s. Bodies and snapshots are relative to it, so that no measure depends on the
  /// frame in which the case was written; 0 where walls or mirror planes across it hold the frame.
  Vector3 frame_velocity = Vector3::Zero();
  std::vector<BodyInput> bodies;
  std::vector<SnapshotEntry> snapshots;

  /// Returns a corner of the domain at a time (s), in the frame of the target.
  [[nodiscard]] Vector3 lower_at(double time) const { return lower - time * frame_velocity; }
  [[nodiscard]] Vector3 upper_at(double time) const { return upper - time * frame_velocity; }
};

/// Reads run.toml and the index of the snapshots.
/// @throws InputError if the folder is not that of a run
Run read_run(const std::filesystem::path& folder);

/// A finite element of a snapshot, for pictures: its eight points have the numbers from `first` on.
struct Hexahedron {
  std::uint64_t first = 0;
  std::array<std::uint32_t, 8> corners{};  ///< in Snapshot::nodes, in the order of VTK
};

/// Holds the particles at one time, in the order of their numbers: results do not depend on ranks and threads that
/// wrote them. An element counts as eight particles, a bar as one.
struct Snapshot {
  double time = 0.0;
  std::vector<Vector3> position, velocity;
  std::vector<double> mass;
  std::vector<std::uint16_t> body;
  std::vector<std::uint64_t> id;
  std::map<std::string, std::vector<double>> scalars;  ///< the other fields of one number, as far as written
  std::vector<Vector3> nodes;                          ///< of the elements, m
  std::vector<Hexahedron> hexahedra;

  [[nodiscard]] std::size_t size() const { return mass.size(); }
  /// A field of one number, nullptr if it was not written.
  [[nodiscard]] const std::vector<double>* scalar(const std::string& name) const;
  /// Volume (m^3) of a particle with its voids; 0 if the density was not written.
  [[nodiscard]] std::vector<double> volumes() const;
};

/// Returns the file of the elements at the time of a snapshot, which is there if the run has any; empty if the snapshot
/// is not called as one of particles.
std::filesystem::path elements_file(const SnapshotEntry& entry);

/// @throws InputError if the file is not that of a snapshot of this run: arrays of other lengths, bodies that
/// the case does not have, numbers that are not finite, points far outside of the domain, masses that are not positive
Snapshot read_snapshot(const SnapshotEntry& entry);

}  // namespace whipple::analysis
