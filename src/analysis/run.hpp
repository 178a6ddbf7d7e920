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

/// Input and snapshots of a finished or running run, from run.toml and the snapshots alone (docs/theory/analysis.md).
/// SI units.
namespace whipple::analysis {

/// Describes a body by its input.
struct BodyInput {
  std::string name;
  Vector3 velocity = Vector3::Zero();  ///< initial, m/s
  double spacing = 0.0;                ///< initial distance of the particles, m
  double size = 0.0;      ///< smallest extent of its shape, m; NaN if the shape does not provide one
  bool phases = true;     ///< its equation of state has phases; otherwise the whole body counts as solid
  bool condensed = true;  ///< it is initially condensed, not a gas
};

struct SnapshotEntry {
  std::filesystem::path file;
  double time = 0.0;           ///< s
  std::size_t bodies = 65536;  ///< number of bodies of the run; particles of others are rejected
  Vector3 frame_velocity = Vector3::Zero();  ///< m/s, subtracted from velocities; displacement from positions
  /// Bounds the domain enlarged by its size on each side, m: points beyond indicate a damaged file.
  Vector3 lower = Vector3::Constant(-1e300), upper = Vector3::Constant(1e300);
};

/// Describes a run by the contents of its folder.
struct Run {
  std::filesystem::path folder;
  std::string title;
  double cell_size = 0.0;                                    ///< m, of the small cells
  bool has_two_levels = false;                               ///< and twice as large ones elsewhere
  Vector3 lower = Vector3::Zero(), upper = Vector3::Zero();  ///< corners of the domain
  grid::Dimension dimension = grid::Dimension::space;
  /// Holds the position of the mirror plane normal to each axis, if there is one (the lower one of two). The symmetry
  /// axis and the plane of two-dimensional problems are excluded: masses are those of whole rings, or of a slice.
  std::array<std::optional<double>, 3> mirror_planes;
  /// Describes a face of the domain that is impermeable to material.
  struct Wall {
    double position = 0.0;
    bool holds = true;  ///< a mirror plane, from which material does not separate either
  };
  std::array<std::array<std::optional<Wall>, 2>, 3> walls;  ///< lower and upper, for each axis
  /// Holds the velocity of the target at the start, m/s. Bodies and snapshots are relative to it, so that measures do
  /// not depend on the frame in which the case was written; 0 where walls or mirror planes normal to it fix the frame.
  Vector3 frame_velocity = Vector3::Zero();
  std::vector<BodyInput> bodies;
  std::vector<SnapshotEntry> snapshots;

  /// Returns a corner of the domain at a time (s), in the frame of the target.
  [[nodiscard]] Vector3 lower_at(double time) const { return lower - time * frame_velocity; }
  [[nodiscard]] Vector3 upper_at(double time) const { return upper - time * frame_velocity; }
};

/// Reads run.toml and the index of the snapshots.
/// @throws InputError if the folder is not a run folder
Run read_run(const std::filesystem::path& folder);

/// Describes a finite element of a snapshot, for pictures: its eight points are numbered from `first` on.
struct Hexahedron {
  std::uint64_t first = 0;
  std::array<std::uint32_t, 8> corners{};  ///< indices into Snapshot::nodes, in VTK order
};

/// Holds the particles at one time, in the order of their numbers, so that results do not depend on the ranks and
/// threads that wrote them. An element counts as eight particles, a bar as one.
struct Snapshot {
  double time = 0.0;
  std::vector<Vector3> position, velocity;
  std::vector<double> mass;
  std::vector<std::uint16_t> body;
  std::vector<std::uint64_t> id;
  std::map<std::string, std::vector<double>> scalars;  ///< the other scalar fields that were written
  std::vector<Vector3> nodes;                          ///< of the elements, m
  std::vector<Hexahedron> hexahedra;

  [[nodiscard]] std::size_t size() const { return mass.size(); }
  /// Returns a scalar field, nullptr if it was not written.
  [[nodiscard]] const std::vector<double>* scalar(const std::string& name) const;
  /// Returns the volumes (m^3) of the particles including voids; 0 if the density was not written.
  [[nodiscard]] std::vector<double> volumes() const;
};

/// Returns the file of the elements at the time of a snapshot, which exists if the run has elements; empty if the name
/// of the snapshot is not that of a particle file.
std::filesystem::path elements_file(const SnapshotEntry& entry);

/// Reads a snapshot.
/// @throws InputError if the file is not a snapshot of this run: arrays of different lengths, bodies that the case does
/// not have, non-finite numbers, points far outside of the domain, non-positive masses
Snapshot read_snapshot(const SnapshotEntry& entry);

}  // namespace whipple::analysis
