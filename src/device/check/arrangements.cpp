// SPDX-License-Identifier: BSD-3-Clause
#include "src/device/check/arrangements.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "src/device/problem.hpp"

namespace whipple::device::check {
namespace {

constexpr double courant = 0.2;  // of the time step

/// @throws WrongInput if nodes could not be numbered, as Cells would
void require_cells(const Problem& problem) {
  if (has_too_many_cells(problem))
    throw WrongInput("the domain of so many particles has too many cells for the device");
}

/// @throws WrongInput unless it has three dimensions
void require_space(const StoredState& state) {
  if (state.problem.dimension != Dimension::space)
    throw WrongInput(state.name + " is a section: times are measured in three dimensions");
}

void resize(PointsOnHost& points, std::size_t n) {
  for (std::vector<double>& column : points.numbers) column.resize(n);
  points.body.resize(n);
  points.origin.resize(n);
  for (std::size_t p = 0; p < n; ++p) points.origin[p] = static_cast<std::uint32_t>(p);
}

/// Returns a number from 0 to 1 that depends on two whole numbers only (splitmix64: G. L. Steele, D. Lea,
/// C. H. Flood, OOPSLA 2014).
double random_number(std::uint64_t i, std::uint64_t stream) {
  std::uint64_t z = (4 * i + stream + 1) * 0x9E3779B97F4A7C15ULL;
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
  return static_cast<double>((z ^ (z >> 31U)) >> 11U) * 0x1p-53;
}

}  // namespace

Arrangement repeated(const StoredState& state, std::size_t size) {
  require_space(state);
  const std::size_t n = state.start.size(), copies = std::max<std::size_t>(1, (size + n - 1) / n);
  const auto [low, high] = std::ranges::minmax(state.start.numbers[position]);
  const double cell = state.problem.cell_size;
  constexpr int block_edge = SpaceLattice::block_edge, gap = 2 * block_edge;  // cells
  const int blocks = static_cast<int>(std::ceil((high - low) / cell + gap)) / block_edge + 1;
  const int shift = blocks * block_edge;
  Arrangement all = {state.problem, {}, state.steps.front().dt};
  all.problem.cells[0] += static_cast<int>(copies - 1) * shift;
  require_cells(all.problem);
  resize(all.points, n * copies);
  for (std::size_t c = 0; c < state_components; ++c) {
    for (std::size_t copy = 0; copy < copies; ++copy) {
      const double by = c == position ? static_cast<double>(copy) * shift * cell : 0.0;
      for (std::size_t p = 0; p < n; ++p)
        all.points.numbers[c][copy * n + p] = state.start.numbers[c][p] + by;
    }
  }
  for (std::size_t p = 0; p < all.points.size(); ++p) all.points.body[p] = state.start.body[p % n];
  return all;
}

Arrangement scattered(const StoredState& state, std::size_t size, double per_cell) {
  require_space(state);
  const double cell = state.problem.cell_size;
  constexpr int margin = 4;  // cells
  const auto edge = static_cast<int>(std::ceil(std::cbrt(static_cast<double>(size) / per_cell)));
  Arrangement all = {state.problem, {}, 0.0};
  all.problem.lower = {0.0, 0.0, 0.0};
  all.problem.cells = {edge + 2 * margin, edge + 2 * margin, edge + 2 * margin};
  require_cells(all.problem);
  resize(all.points, size);
  const auto of_first = [&](std::uint32_t component) { return state.start.numbers[component].front(); };
  for (std::uint32_t c = 0; c < state_components; ++c) std::ranges::fill(all.points.numbers[c], of_first(c));
  std::ranges::fill(all.points.body, state.start.body.front());
  for (std::uint32_t c = velocity; c < mass; ++c) {
    if (c < extent) std::ranges::fill(all.points.numbers[c], 0.0);
  }
  const bool dense = per_cell >= 8.0;
  const auto rows = static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(size))));
  for (std::size_t p = 0; p < size; ++p) {
    const std::array<std::size_t, 3> row = {p / (rows * rows), p / rows % rows, p % rows};
    for (std::uint32_t a = 0; a < 3; ++a) {
      const double in_cells = dense ? (static_cast<double>(row[a]) + 0.5) * edge / static_cast<double>(rows)
                                    : random_number(p, a) * edge;
      all.points.numbers[position + a][p] = (margin + in_cells) * cell;
    }
  }
  all.dt = courant * cell / of_first(sound_speed);
  return all;
}

}  // namespace whipple::device::check
