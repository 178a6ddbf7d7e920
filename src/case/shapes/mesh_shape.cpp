// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/shapes/mesh_shape.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "src/core/base/error.hpp"
#include "src/fem/hexahedron.hpp"
#include "src/fem/mesh_file.hpp"

namespace whipple::cases {
namespace {

class MeshShape final : public Shape {
 public:
  explicit MeshShape(fem::Hexahedra mesh) : mesh_(std::move(mesh)) {
    const Vector3 everywhere = Vector3::Constant(std::numeric_limits<double>::infinity());
    bounds_ = {everywhere, -everywhere};
    for (const fem::Corners& corners : mesh_.elements) {
      const Bounds box = box_of(corners);
      bounds_ = {bounds_.lower.cwiseMin(box.lower), bounds_.upper.cwiseMax(box.upper)};
      volume_ += volume_of(corners);
    }
    bins_per_axis_ = std::max(1, static_cast<int>(std::cbrt(static_cast<double>(mesh_.elements.size()))));
    bins_.resize(static_cast<std::size_t>(bins_per_axis_ * bins_per_axis_ * bins_per_axis_));
    for (std::uint32_t e = 0; e < mesh_.elements.size(); ++e) {
      const Bounds box = box_of(mesh_.elements[e]);
      const std::array<int, 3> from = bin_of(box.lower), to = bin_of(box.upper);
      for (int i = from[0]; i <= to[0]; ++i) {
        for (int j = from[1]; j <= to[1]; ++j) {
          for (int k = from[2]; k <= to[2]; ++k) bins_[index(i, j, k)].push_back(e);
        }
      }
    }
  }

  [[nodiscard]] bool contains(const Vector3& point) const override {
    if ((point.array() < bounds_.lower.array()).any() || (point.array() > bounds_.upper.array()).any()) {
      return false;
    }
    const std::array<int, 3> bin = bin_of(point);
    return std::ranges::any_of(bins_[index(bin[0], bin[1], bin[2])], [&](std::uint32_t e) {
      const Bounds box = box_of(mesh_.elements[e]);
      return (point.array() >= box.lower.array()).all() && (point.array() <= box.upper.array()).all() &&
             holds(mesh_.elements[e], point);
    });
  }
  [[nodiscard]] Bounds bounds() const override { return bounds_; }
  [[nodiscard]] double volume() const override { return volume_; }
  [[nodiscard]] std::string toml() const override { return "{}"; }  // the discretization names the file
  [[nodiscard]] std::optional<fem::Hexahedra> hexahedra(double, const Bounds&) const override {
    return mesh_;
  }

 private:
  [[nodiscard]] Bounds box_of(const fem::Corners& corners) const {
    Bounds box{mesh_.nodes[corners[0]], mesh_.nodes[corners[0]]};
    for (const std::uint32_t a : corners) {
      box = {box.lower.cwiseMin(mesh_.nodes[a]), box.upper.cwiseMax(mesh_.nodes[a])};
    }
    return box;
  }
  [[nodiscard]] fem::Modes<double> modes(const fem::Corners& corners, const Vector3& origin) const {
    std::array<Triple<double>, 8> x;
    for (std::size_t a = 0; a < 8; ++a) {
      const Vector3 p = mesh_.nodes[corners[a]] - origin;
      x[a] = {p[0], p[1], p[2]};
    }
    return fem::modes_of(x);
  }
  [[nodiscard]] double volume_of(const fem::Corners& corners) const {
    return fem::volume_of(modes(corners, Vector3::Zero()));
  }
  /// Solves for the natural coordinates of the point by Newton iteration; it is inside if all are in [-1, 1].
  [[nodiscard]] bool holds(const fem::Corners& corners, const Vector3& point) const {
    Vector3 xi = Vector3::Zero();
    constexpr int iterations = 20;
    for (int i = 0; i < iterations; ++i) {
      Vector3 residual = -point;
      for (std::size_t a = 0; a < 8; ++a) {
        const std::array<double, 3>& c = fem::corner_coordinates[a];
        residual +=
            0.125 * (1 + c[0] * xi[0]) * (1 + c[1] * xi[1]) * (1 + c[2] * xi[2]) * mesh_.nodes[corners[a]];
      }
      const auto j = fem::natural_gradient(modes(corners, point), xi[0], xi[1], xi[2]);
      Matrix3 jacobian;
      jacobian << j.x.x, j.y.x, j.z.x, j.x.y, j.y.y, j.z.y, j.x.z, j.y.z, j.z.z;
      const Vector3 step = jacobian.partialPivLu().solve(residual);
      xi -= step;
      if (!(xi.cwiseAbs().maxCoeff() < 10.0)) return false;
      if (step.norm() < 1e-12) break;
    }
    constexpr double at_faces = 1.0 + 1e-9;  // a point on the face between two elements is inside one of them
    return xi.cwiseAbs().maxCoeff() < at_faces;
  }
  [[nodiscard]] std::array<int, 3> bin_of(const Vector3& point) const {
    std::array<int, 3> bin{};
    for (int a = 0; a < 3; ++a) {
      const double share = (point[a] - bounds_.lower[a]) / (bounds_.upper[a] - bounds_.lower[a]);
      bin[static_cast<std::size_t>(a)] =
          std::clamp(static_cast<int>(share * bins_per_axis_), 0, bins_per_axis_ - 1);
    }
    return bin;
  }
  [[nodiscard]] std::size_t index(int i, int j, int k) const {
    return static_cast<std::size_t>((i * bins_per_axis_ + j) * bins_per_axis_ + k);
  }

  fem::Hexahedra mesh_;
  Bounds bounds_;
  double volume_ = 0.0;
  int bins_per_axis_ = 1;
  std::vector<std::vector<std::uint32_t>> bins_;
};

}  // namespace

std::unique_ptr<Shape> shape_of_mesh(const Discretization& control) {
  const fem::MeshFile file = fem::MeshFile::read(control.mesh, control.mesh_unit);
  std::string group = control.group;
  if (group.empty()) {
    const std::vector<std::string> names = file.group_names(3);
    if (names.size() != 1) {
      throw InputError(fmt::format("{}: has {} {}s of volumes, name one by discretization.group: {}",
                                   control.mesh, names.size(), file.called(), fmt::join(names, ", ")));
    }
    group = names.front();
  }
  return std::make_unique<MeshShape>(file.hexahedra(group));
}

}  // namespace whipple::cases
