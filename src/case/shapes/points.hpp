// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "src/case/shapes/made.hpp"
#include "src/solids/bins.hpp"
#include "src/solids/point_file.hpp"

namespace whipple::cases {

/// Names particles in a file.
struct PointsKeys {
  static constexpr const char* name = "points";
  std::string file;
  double unit = std::numeric_limits<double>::infinity();       ///< m; infinite: those of the headings
  double mass_unit = std::numeric_limits<double>::infinity();  ///< kg; infinite: that of the heading
  solids::SizeColumn size = solids::SizeColumn::whichever;
  double density = std::numeric_limits<double>::infinity();  ///< kg/m^3; infinite: that of the body
  std::string digest;

  static ParameterTable<PointsKeys> parameters();
};

/// Describes the particles of a body that a file gives. The volume of each is its mass over the density of the body at
/// the start, or given; the region is that of cubes (in two dimensions: squares) of these volumes about the positions,
/// parallel to the axes.
class Points final : public Shape, public Made<Points, PointsKeys> {
 public:
  static constexpr const char* name = PointsKeys::name;
  static constexpr const char* summary =
      "particles with positions and masses or volumes from a CSV or VTU file, taken as they are";

  /// Reads the file. Until they are `settled`, cubes of masses have an estimated size.
  /// @throws InputError naming file and line: not found, unreadable, without particles (src/solids/point_file.hpp)
  Points(PointsKeys keys, const std::filesystem::path& folder);

  [[nodiscard]] bool contains(const Vector3& point) const override;
  [[nodiscard]] Bounds bounds() const override { return bounds_; }
  /// Returns the sum of the volumes.
  [[nodiscard]] double volume() const override { return volume_; }
  [[nodiscard]] bool fills_lattice() const override { return true; }
  [[nodiscard]] std::span<const GivenParticle> particles() const override { return particles_; }
  [[nodiscard]] std::string source_of(std::size_t particle) const override {
    return read_->list.where(particle);
  }
  [[nodiscard]] std::unique_ptr<Shape> settled(const Settling& settling) const override;
  [[nodiscard]] std::optional<SourceFile> source() const override { return read_->source; }
  [[nodiscard]] std::vector<std::string> account() const override;
  [[nodiscard]] std::string toml() const override;

 private:
  struct Read {
    SourceFile source;
    solids::PointList list;
  };

  /// Sets bounds, volume and the bins from the particles.
  void measure();

  PointsKeys keys_;
  std::shared_ptr<const Read> read_;
  bool is_settled_ = false, is_planar_ = false;
  std::vector<GivenParticle> particles_;
  std::optional<solids::Bins> bins_;  // of `particles_`
  Bounds bounds_;
  double volume_ = 0.0;
};

/// Returns the edge (m) of the cube, or square, that is the mean volume, or area, of given particles.
double mean_edge(std::span<const GivenParticle> particles, bool is_planar);

/// Returns the largest edge (m) of given particles.
double largest_edge(std::span<const GivenParticle> particles);

}  // namespace whipple::cases
