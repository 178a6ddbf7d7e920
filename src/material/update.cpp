// SPDX-License-Identifier: BSD-3-Clause
#include "src/material/update.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "src/material/common.hpp"

namespace whipple {
namespace {

using material::Chunk;
using material::chunk_size;
using material::Step;

/// Updates `count` points in chunks.
/// @param gradient_of  gradient_of(first, count): matrices or components of `count` points from `first`
template <class IndexOf, class GradientOf>
MaterialReport update_all(const Material& material, MaterialPoints& points, std::size_t count,
                          IndexOf index_of, GradientOf gradient_of, const UpdateSettings& settings,
                          material::Energy energy) {
  const material::Constitutive& model = *material.constitutive;
  Chunk chunk;
  for (std::size_t first = 0; first < count; first += chunk_size) {
    chunk.size = std::min(chunk_size, count - first);
    for (std::size_t k = 0; k < chunk.size; ++k) chunk.index[k] = index_of(first + k);
    chunk.find_runs();
    Step step{material, points, {}, {}, {}, settings, energy};
    std::tie(step.gradient, step.components) = gradient_of(first, chunk.size);
    if (settings.heating == HeatingViscosity::of_affine_field) {
      step.affine_divergence = settings.affine_divergence.subspan(first, chunk.size);
    }
    gather(step, chunk);
    advance_volume(step, chunk);
    advance_viscosity(step, chunk);
    model.update(step, chunk);
    find_compression_rate(step, chunk);
    scatter(step, chunk, points);
  }
  return chunk.report;
}

auto by_matrices(std::span<const Matrix3> gradient) {
  return [=](std::size_t first, std::size_t count) {
    return std::pair(gradient.subspan(first, count), GradientComponents{});
  };
}

auto by_components(const GradientComponents& gradient) {
  return [=](std::size_t first, std::size_t) {
    GradientComponents from = gradient;
    for (const double*& component : from) component += first;
    return std::pair(std::span<const Matrix3>(), from);
  };
}

}  // namespace

void MaterialReport::merge(const MaterialReport& other) {
  equation_of_state.merge(other.equation_of_state);
  undefined += other.undefined;
  first_undefined = std::min(first_undefined, other.first_undefined);
  limited_volume_changes += other.limited_volume_changes;
  limited_densities += other.limited_densities;
  points += other.points;
  mass += other.mass;
  squeezed += other.squeezed;
  squeezed_mass += other.squeezed_mass;
  first_squeezed = std::min(first_squeezed, other.first_squeezed);
  limited_void_steps += other.limited_void_steps;
  limited_bulking += other.limited_bulking;
  compression_rate = std::max(compression_rate, other.compression_rate);
  plastic_work += other.plastic_work;
  dissipation += other.dissipation;
  plastic_heat += other.plastic_heat;
  viscous_heat += other.viscous_heat;
  for (std::size_t code = 0; code < failed.size(); ++code) failed[code] += other.failed[code];
}

MaterialReport update_material(const Material& material, MaterialPoints& points, std::size_t begin,
                               std::size_t end, std::span<const Matrix3> velocity_gradient,
                               const UpdateSettings& settings) {
  return update_all(
      material, points, end - begin, [=](std::size_t k) { return begin + k; }, by_matrices(velocity_gradient),
      settings, material::Energy::from_grid);
}

MaterialReport update_material(const Material& material, MaterialPoints& points, std::size_t begin,
                               std::size_t end, const GradientComponents& velocity_gradient,
                               const UpdateSettings& settings) {
  return update_all(
      material, points, end - begin, [=](std::size_t k) { return begin + k; },
      by_components(velocity_gradient), settings, material::Energy::from_grid);
}

MaterialReport update_material(const Material& material, MaterialPoints& points,
                               std::span<const std::uint32_t> indices,
                               std::span<const Matrix3> velocity_gradient, const UpdateSettings& settings) {
  return update_all(
      material, points, indices.size(), [=](std::size_t k) { return std::size_t{indices[k]}; },
      by_matrices(velocity_gradient), settings, material::Energy::from_grid);
}

MaterialReport update_material_and_energy(const Material& material, MaterialPoints& points, std::size_t begin,
                                          std::size_t end, std::span<const Matrix3> velocity_gradient,
                                          const UpdateSettings& settings) {
  return update_all(
      material, points, end - begin, [=](std::size_t k) { return begin + k; }, by_matrices(velocity_gradient),
      settings, material::Energy::integrated);
}

MaterialReport update_material_and_energy(const Material& material, MaterialPoints& points,
                                          std::span<const std::uint32_t> indices,
                                          std::span<const Matrix3> velocity_gradient,
                                          const UpdateSettings& settings) {
  return update_all(
      material, points, indices.size(), [=](std::size_t k) { return std::size_t{indices[k]}; },
      by_matrices(velocity_gradient), settings, material::Energy::integrated);
}

}  // namespace whipple
