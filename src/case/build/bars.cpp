// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/build/bars.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "src/core/base/error.hpp"
#include "src/material/strength/elastic.hpp"
#include "src/material/strength/von_mises.hpp"

namespace whipple::cases {
namespace {

class BarShape final : public Shape {
 public:
  BarShape(const Bounds& bounds, double volume) : bounds_(bounds), volume_(volume) {}
  [[nodiscard]] bool contains(const Vector3&) const override { return false; }
  [[nodiscard]] Bounds bounds() const override { return bounds_; }
  [[nodiscard]] double volume() const override { return volume_; }
  [[nodiscard]] std::string toml() const override { return {}; }

 private:
  Bounds bounds_;
  double volume_;
};

double area_of(const Body& body) {
  const double d = body.discretization.bar_diameter;
  return 0.25 * std::numbers::pi * d * d;
}

bool is_hoop(const Case& setup, const Vector3& from, const Vector3& to) {
  return setup.geometry.is_axisymmetric() && from == to;
}

/// Calls f(from, to, number) for every bar of a body.
template <class Function>
void for_each_bar(const Body& body, Function&& f) {
  for (const BarRow& row : body.bars) {
    for (std::int64_t i = 0; i < row.count; ++i) {
      const Vector3 offset = static_cast<double>(i) * row.step;
      f(Vector3(row.from + offset), Vector3(row.to + offset), row.number);
    }
  }
}

}  // namespace

std::shared_ptr<const Shape> shape_of_bars(const Body& body) {
  const Vector3 everywhere = Vector3::Constant(std::numeric_limits<double>::infinity());
  Shape::Bounds bounds{everywhere, -everywhere};
  double length = 0.0;
  for_each_bar(body, [&](const Vector3& from, const Vector3& to, double number) {
    bounds = {bounds.lower.cwiseMin(from).cwiseMin(to), bounds.upper.cwiseMax(from).cwiseMax(to)};
    length += number * (from == to ? 2.0 * std::numbers::pi * from[1] : (to - from).norm());
  });
  return std::make_shared<BarShape>(bounds, area_of(body) * length);
}

std::optional<std::string> fault_of_bars(const Case& setup, const Body& bars) {
  for (const Body& body : setup.bodies) {
    if (!body.discretization.has_elements()) continue;
    bool inside = false;
    for_each_bar(bars, [&](const Vector3& from, const Vector3& to, double) {
      inside = inside || body.shape->contains(0.5 * (from + to));
    });
    if (!inside) continue;
    return fmt::format(
        "body \"{}\": its bars are in body \"{}\" of elements, whose inner nodes are not on the grid and "
        "would not interact with them: bars reinforce bodies of particles (discretization.method = "
        "\"particles\")",
        bars.name, body.name);
  }
  return std::nullopt;
}

std::optional<std::size_t> body_around_bars(const Case& setup, const Body& bars) {
  std::vector<double> inside(setup.bodies.size(), 0.0);
  for_each_bar(bars, [&](const Vector3& from, const Vector3& to, double) {
    const double length = std::max((to - from).norm(), 1e-9 * setup.domain.cell_size);  // of hoops
    const int parts = static_cast<int>(std::clamp(length / setup.domain.cell_size, 1.0, 1000.0));
    for (int i = 0; i < parts; ++i) {
      const Vector3 point = from + (i + 0.5) / parts * (to - from);
      for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
        if (setup.bodies[b].shape->contains(point)) inside[b] += length / parts;
      }
    }
  });
  const auto most = std::ranges::max_element(inside);
  if (most == inside.end() || !(*most > 0.0)) return std::nullopt;
  return static_cast<std::size_t>(most - inside.begin());
}

fem::BarMaterial bar_material(const Material& material, const Body& body) {
  const strength::Strength& strength = *material.strength;
  const bool elastic = strength.model() == strength::Elastic::name;
  const auto refuse = [&](const std::string& why) {
    throw InputError(fmt::format("body \"{}\": bars of {}: {}", body.name, material.name, why));
  };
  if (!elastic && strength.model() != strength::VonMises::name) {
    refuse(fmt::format("their strength is elastic or von_mises, not {}", strength.model()));
  }
  if (!material.failure.empty()) {
    refuse("they do not use the failure criteria of a material: set discretization.bar_failure_strain");
  }
  const std::array density = {material.reference.density}, temperature = {material.reference.temperature};
  const std::array pressure = {0.0}, rate = {0.0};
  const auto at = [&](double plastic_strain) {
    const std::array strain = {plastic_strain};
    std::array value = {0.0};
    strength.flow_stress({density, pressure, temperature, strain}, rate, value);
    return value[0];
  };
  const std::array intact = {0.0};
  std::array shear = {0.0};
  strength.shear_modulus({density, pressure, temperature, intact}, shear);
  const double bulk = material.reference_bulk_modulus;
  fem::BarMaterial bar{.density = material.reference.density,
                       .young = 9.0 * bulk * shear[0] / (3.0 * bulk + shear[0]),
                       .failure_strain = body.discretization.bar_failure_strain};
  if (elastic) return bar;
  bar.yield_stress = at(0.0);
  bar.hardening_modulus = at(1.0) - bar.yield_stress;
  if (strength.kinematic_modulus() != 0.0 ||
      std::abs(at(0.5) - 0.5 * (at(0.0) + at(1.0))) > 1e-9 * bar.yield_stress) {
    refuse("they harden linearly and isotropically: no maximum_flow_stress, no kinematic hardening");
  }
  return bar;
}

std::vector<fem::Bars> make_bars(const Case& setup, std::uint64_t first_node_id,
                                 std::uint64_t first_element_id) {
  std::vector<fem::Bars> all;
  std::uint64_t node_id = first_node_id, bar_id = first_element_id;
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    const Body& body = setup.bodies[b];
    if (!body.discretization.is_bars()) continue;
    const double size = body.discretization.size(setup.domain.cell_size);
    fem::Lines lines;
    for_each_bar(body, [&](const Vector3& from, const Vector3& to, double number) {
      if (is_hoop(setup, from, to)) {
        const auto node = static_cast<std::uint32_t>(lines.nodes.size());
        lines.nodes.push_back(from);
        lines.add({node, node}, number);
        return;
      }
      const auto parts = static_cast<std::uint32_t>(std::max(1.0, std::round((to - from).norm() / size)));
      const auto first = static_cast<std::uint32_t>(lines.nodes.size());
      for (std::uint32_t i = 0; i <= parts; ++i) {
        lines.nodes.emplace_back(from + static_cast<double>(i) / parts * (to - from));
        if (i > 0) lines.add({first + i - 1, first + i}, number);
      }
    });
    const Shape::Bounds bounds = body.shape->bounds();
    const double tolerance = 1e-9 * setup.geometry.cell_size;
    for (int axis = 0; axis < 3; ++axis) {
      if (bounds.lower[axis] < setup.geometry.lower[axis] - tolerance ||
          bounds.upper[axis] > setup.geometry.upper(axis) + tolerance) {
        throw InputError(
            fmt::format("body \"{}\": its bars reach out of the domain along {}; let those that go "
                        "through a mirror plane end there",
                        body.name, "xyz"[axis]));
      }
    }
    fem::Bars& bars = all.emplace_back(fem::make_bars(
        lines, area_of(body), bar_material(*setup.materials[b], body), fmt::format("body \"{}\"", body.name),
        static_cast<std::uint32_t>(b), node_id, bar_id));
    node_id += bars.nodes.size();
    bar_id += bars.elements.size();
    const Vector3 center = 0.5 * (bounds.lower + bounds.upper);
    std::ranges::fill(bars.nodes.affine_velocity, Matrix3::Zero());
    std::ranges::fill(bars.nodes.in_transition, std::uint8_t{1});
    for (std::size_t a = 0; a < bars.nodes.size(); ++a) {
      bars.nodes.velocity[a] = body.velocity_at(bars.nodes.position[a], center);
    }
  }
  return all;
}

}  // namespace whipple::cases
