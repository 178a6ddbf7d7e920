// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "src/case/shapes/made.hpp"
#include "src/core/base/temporary_folder.hpp"
#include "src/solids/enclosure.hpp"
#include "src/solids/surface.hpp"

namespace whipple::solids {
class Inside;
}

namespace whipple::cases {

/// Names a surface in a file.
struct SurfaceKeys {
  static constexpr const char* name = "surface";
  std::string file;
  double unit = std::numeric_limits<double>::infinity();           ///< m; infinite: not given
  double triangle_size = std::numeric_limits<double>::infinity();  ///< m; infinite: not given
  std::string digest;

  static ParameterTable<SurfaceKeys> parameters();
};

/// Describes what a surface of triangles encloses, which may have holes (src/solids/inside.hpp).
class Surface final : public Shape, public Made<Surface, SurfaceKeys> {
 public:
  static constexpr const char* name = SurfaceKeys::name;
  static constexpr const char* summary =
      "what a surface of triangles encloses, from an STL, OBJ or PLY file, or the faces of a STEP file";

  /// Reads the file; a STEP file is triangulated, unless it is the copy of a run, which holds the triangles as well.
  /// @param resolution  m, of triangles of a STEP file without `triangle_size`; infinite: not known
  /// @throws InputError naming it: not found, unreadable, without a volume, a unit that is missing or not its own
  Surface(SurfaceKeys keys, const std::filesystem::path& folder,
          double resolution = std::numeric_limits<double>::infinity());

  [[nodiscard]] bool contains(const Vector3& point) const override;
  [[nodiscard]] Bounds bounds() const override { return {audit_.lower, audit_.upper}; }
  /// Returns the volume by the divergence theorem if all parts of the surface are closed and do not cross, otherwise by
  /// counting.
  [[nodiscard]] double volume() const override { return volume_; }
  /// Returns the thickness that 1 % of the area falls below, from points on the surface inwards to the next one.
  [[nodiscard]] double smallest_extent(const Vector3&) const override { return thickness_; }
  [[nodiscard]] std::optional<SourceFile> source() const override { return source_; }
  [[nodiscard]] std::vector<std::string> account() const override;
  [[nodiscard]] std::string toml() const override;

  [[nodiscard]] const solids::Audit& audit() const { return audit_; }

 private:
  /// Returns the triangles of the file, m.
  std::vector<solids::Triangle> read_triangles(double resolution);
  /// Finds or makes the file of triangles of a STEP file.
  void find_triangles();
  void measure_thickness();

  SurfaceKeys keys_;
  SourceFile source_;                            // of a STEP file with its triangles as a companion
  std::shared_ptr<const TemporaryFolder> made_;  // triangles of a STEP file
  solids::Audit audit_;
  std::shared_ptr<const solids::Inside> inside_;
  std::optional<solids::Enclosure> enclosure_;  // nothing: counted
  double volume_ = 0.0;
  double thickness_ = 0.0;
};

}  // namespace whipple::cases
