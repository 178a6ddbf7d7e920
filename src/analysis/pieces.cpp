// SPDX-License-Identifier: BSD-3-Clause
#include "src/analysis/pieces.hpp"

#include <algorithm>
#include <atomic>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "src/core/base/error.hpp"
#include "src/core/parallel/threads.hpp"

namespace whipple::analysis {
namespace {

/// Implements union-find with the smallest index as root: roots only ever get a smaller parent, so a failed exchange is
/// retried from the new root and the final components do not depend on the order.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0U); }

  std::uint32_t find(std::uint32_t i) {
    while (true) {
      const std::uint32_t up = load(i);
      if (up == i) return i;
      const std::uint32_t further = load(up);
      // Halves the path; another thread may have done so already.
      std::uint32_t expected = up;
      at(i).compare_exchange_weak(expected, further, std::memory_order_relaxed);
      i = further;
    }
  }

  void unite(std::uint32_t a, std::uint32_t b) {
    while (true) {
      a = find(a);
      b = find(b);
      if (a == b) return;
      if (a < b) std::swap(a, b);
      std::uint32_t expected = a;
      if (at(a).compare_exchange_strong(expected, b, std::memory_order_relaxed)) return;
    }
  }

 private:
  std::atomic_ref<std::uint32_t> at(std::uint32_t i) { return std::atomic_ref<std::uint32_t>(parent_[i]); }
  std::uint32_t load(std::uint32_t i) { return at(i).load(std::memory_order_relaxed); }
  std::vector<std::uint32_t> parent_;
};

/// Holds points sorted by cells of edge `size`, with the cells in the order of their keys.
class CellList {
 public:
  CellList(std::span<const Vector3> points, double size) : order_(points.size()), size_(size) {
    for (const Vector3& point : points) {
      lower_ = lower_.cwiseMin(point);
      upper_ = upper_.cwiseMax(point);
    }
    if (((upper_ - lower_).array() / size > most).any()) {
      throw InputError(
          "fragments: the linking length is too small for the extent of the material (whipple analyse "
          "--link)");
    }
    std::vector<std::uint64_t> of_point(points.size());
    parallel::for_each(points.size(), [&](std::size_t i) { of_point[i] = *key_at(points[i]); });
    std::iota(order_.begin(), order_.end(), 0U);
    std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(of_point[a], a) < std::pair(of_point[b], b);
    });
    for (std::uint32_t i = 0; i < order_.size(); ++i) {
      if (i > 0 && of_point[order_[i]] == keys_.back()) continue;
      keys_.push_back(of_point[order_[i]]);
      begins_.push_back(i);
    }
    begins_.push_back(static_cast<std::uint32_t>(order_.size()));
  }

  /// Returns the number of occupied cells.
  [[nodiscard]] std::size_t count() const { return keys_.size(); }
  [[nodiscard]] std::uint64_t key(std::size_t cell) const { return keys_[cell]; }
  [[nodiscard]] std::span<const std::uint32_t> members(std::size_t cell) const {
    return std::span(order_).subspan(begins_[cell], begins_[cell + 1] - begins_[cell]);
  }
  /// Returns the points of the n-th of the 27 cells around the cell with a key. Number 13 is the cell itself; the
  /// numbers from 14 on are half of its neighbours, so that each pair of cells is visited once.
  [[nodiscard]] std::span<const std::uint32_t> around(std::uint64_t key, int n) const {
    const auto step = [](int by, unsigned shift) {
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(by)) << shift;
    };
    key += step(n / 9 - 1, 42U) + step(n / 3 % 3 - 1, 21U) + step(n % 3 - 1, 0U);
    const auto found = std::ranges::lower_bound(keys_, key);
    if (found == keys_.end() || *found != key) return {};
    return members(static_cast<std::size_t>(found - keys_.begin()));
  }
  /// Returns the key of the cell that contains a position, 21 bits per direction; nothing if it is out of the range of
  /// the keys, where no occupied cell is adjacent.
  [[nodiscard]] std::optional<std::uint64_t> key_at(const Vector3& place) const {
    // One cell of margin, so that neighbours have keys as well.
    const Vector3 cell = ((place - lower_) / size_).array().floor() + 1.0;
    if ((cell.array() < 0.0).any() || (cell.array() > most + 2.0).any()) return std::nullopt;
    return (static_cast<std::uint64_t>(cell.x()) << 42U) | (static_cast<std::uint64_t>(cell.y()) << 21U) |
           static_cast<std::uint64_t>(cell.z());
  }

 private:
  static constexpr double most = 2.0e6;  // cells along an axis
  std::vector<std::uint64_t> keys_;      // of the occupied cells, ascending
  std::vector<std::uint32_t> begins_;    // of each cell in `order_`, one more at the end
  std::vector<std::uint32_t> order_;
  double size_;
  Vector3 lower_ = Vector3::Constant(std::numeric_limits<double>::infinity()), upper_ = -lower_;
};

std::vector<std::uint32_t> components(std::span<const Vector3> points, const CellList& cells,
                                      double distance) {
  DisjointSets sets(points.size());
  const double squared = distance * distance;
  parallel::for_each_chunk(cells.count(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      const auto mine = cells.members(c);
      const auto link = [&](std::uint32_t a, std::uint32_t b) {
        if ((points[a] - points[b]).squaredNorm() < squared) sets.unite(a, b);
      };
      for (std::size_t i = 0; i < mine.size(); ++i) {
        for (std::size_t j = i + 1; j < mine.size(); ++j) link(mine[i], mine[j]);
      }
      for (int n = 14; n < 27; ++n) {
        const auto theirs = cells.around(cells.key(c), n);
        for (const std::uint32_t a : mine) {
          for (const std::uint32_t b : theirs) link(a, b);
        }
      }
    }
  });
  std::vector<std::uint32_t> label(points.size());
  parallel::for_each(points.size(),
                     [&](std::size_t i) { label[i] = sets.find(static_cast<std::uint32_t>(i)); });
  return label;
}

/// Returns the point of a list nearest to a position and closer than `distance`; among equidistant points the one with
/// the smallest coordinates, so that the order of the points does not matter. Returns nothing if there is none.
std::optional<std::uint32_t> nearest(const Vector3& place, std::span<const Vector3> points,
                                     const CellList& cells, double distance) {
  const std::optional<std::uint64_t> key = cells.key_at(place);
  if (!key) return std::nullopt;
  std::optional<std::uint32_t> best;
  auto least = std::tuple(distance * distance, 0.0, 0.0, 0.0);
  for (int n = 0; n < 27; ++n) {
    for (const std::uint32_t i : cells.around(*key, n)) {
      const Vector3& p = points[i];
      const double squared = (p - place).squaredNorm();
      if (!(squared < distance * distance)) continue;
      const auto measure = std::tuple(squared, p.x(), p.y(), p.z());
      if (best && !(measure < least)) continue;
      least = measure;
      best = i;
    }
  }
  return best;
}

}  // namespace

std::vector<std::uint32_t> connected_components(std::span<const Vector3> points, double distance) {
  if (points.empty()) return {};
  return components(points, CellList(points, distance), distance);
}

std::vector<std::uint32_t> pieces_of(std::span<const Vector3> points, const std::vector<bool>& failed,
                                     double distance) {
  std::vector<std::uint32_t> piece(points.size(), loose), intact, broken;
  std::vector<Vector3> whole;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (failed[i]) {
      broken.push_back(i);
      continue;
    }
    intact.push_back(i);
    whole.push_back(points[i]);
  }
  if (intact.empty()) return piece;
  const CellList cells(whole, distance);
  const std::vector<std::uint32_t> label = components(whole, cells, distance);
  for (std::size_t k = 0; k < intact.size(); ++k) piece[intact[k]] = intact[label[k]];
  parallel::for_each(broken.size(), [&](std::size_t k) {
    const std::optional<std::uint32_t> found = nearest(points[broken[k]], whole, cells, distance);
    if (found) piece[broken[k]] = intact[label[*found]];
  });
  return piece;
}

}  // namespace whipple::analysis
