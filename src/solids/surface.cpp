// SPDX-License-Identifier: BSD-3-Clause
#include "src/solids/surface.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <numeric>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "src/core/base/error.hpp"
#include "src/core/base/random_bits.hpp"

namespace whipple::solids {
namespace {

using Corners = std::array<std::uint32_t, 3>;

struct PlaceHash {
  std::size_t operator()(const std::array<double, 3>& x) const {
    std::uint64_t bits = 0;
    for (const double value : x) bits = scattered(bits ^ std::bit_cast<std::uint64_t>(value));
    return bits;
  }
};

/// Numbers the corners by their coordinates.
std::vector<Corners> numbered(const std::vector<Triangle>& triangles) {
  std::unordered_map<std::array<double, 3>, std::uint32_t, PlaceHash> number;
  number.reserve(triangles.size());
  std::vector<Corners> corners(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3 x = triangles[t][i] + Vector3::Zero();  // -0 becomes 0
      corners[t][i] =
          number.try_emplace({x[0], x[1], x[2]}, static_cast<std::uint32_t>(number.size())).first->second;
    }
  }
  return corners;
}

double area_of(const Triangle& t) { return 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm(); }

/// Keeps the triangles for which keep(index) is true. Returns how many were dropped.
template <class Keep>
std::size_t filter(std::vector<Triangle>& triangles, std::vector<Corners>& corners, Keep&& keep) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (!keep(t)) continue;
    triangles[kept] = triangles[t];
    corners[kept++] = corners[t];
  }
  const std::size_t dropped = triangles.size() - kept;
  triangles.resize(kept);
  corners.resize(kept);
  return dropped;
}

/// Holds one edge of a triangle.
struct Edge {
  std::uint32_t from, to;  ///< corners, from < to
  std::uint32_t triangle;
  bool forward;  ///< whether the triangle goes from `from` to `to`
  auto operator<=>(const Edge&) const = default;
};

std::vector<Edge> edges_of(const std::vector<Corners>& corners) {
  std::vector<Edge> edges;
  edges.reserve(3 * corners.size());
  for (std::uint32_t t = 0; t < corners.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = corners[t][i], b = corners[t][(i + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), t, a < b});
    }
  }
  std::ranges::sort(edges);
  return edges;
}

/// Calls f(begin, end) for the edges of each pair of corners.
template <class Function>
void for_each_pair(const std::vector<Edge>& edges, Function&& f) {
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && edges[end].from == edges[begin].from && edges[end].to == edges[begin].to)
      ++end;
    f(begin, end);
  }
}

/// Finds which corner stands for all corners that triangles connect with it.
class Connected {
 public:
  explicit Connected(const std::vector<Corners>& corners) {
    std::uint32_t count = 0;
    for (const Corners& c : corners) count = std::max(count, 1 + std::ranges::max(c));
    parent_.resize(count);
    std::iota(parent_.begin(), parent_.end(), 0U);
    for (const Corners& c : corners) {
      for (const std::size_t i : {1U, 2U}) parent_[of(c[i])] = of(c[0]);
    }
  }
  std::uint32_t of(std::uint32_t corner) {
    while (parent_[corner] != corner) corner = parent_[corner] = parent_[parent_[corner]];
    return corner;
  }
  [[nodiscard]] std::size_t size() const { return parent_.size(); }

 private:
  std::vector<std::uint32_t> parent_;
};

/// Returns for every triangle whether it belongs to a closed shell all of whose triangles are there in both senses.
/// @param cancels  whether there is one of the opposite sense
/// @param copy  whether a triangle is the second one of such a pair
std::vector<bool> of_doubled_shells(const std::vector<Corners>& corners, const std::vector<bool>& cancels,
                                    const std::vector<bool>& copy) {
  Connected shells(corners);
  std::vector<bool> is_doubled(shells.size(), true);
  std::vector<Corners> once;
  for (std::size_t t = 0; t < corners.size(); ++t) {
    if (!cancels[t]) is_doubled[shells.of(corners[t][0])] = false;
    if (cancels[t] && !copy[t]) once.push_back(corners[t]);
  }
  const std::vector<Edge> edges = edges_of(once);
  for_each_pair(edges, [&](std::size_t begin, std::size_t end) {
    if (end - begin == 1) is_doubled[shells.of(edges[begin].from)] = false;
  });
  std::vector<bool> result(corners.size());
  for (std::size_t t = 0; t < corners.size(); ++t) result[t] = is_doubled[shells.of(corners[t][0])];
  return result;
}

/// Drops triangles with the corners of another one, and counts them.
void drop_copies(std::vector<Triangle>& triangles, std::vector<Corners>& corners, Audit& audit) {
  struct Item {
    Corners sorted;
    bool is_odd;  // an odd permutation of the sorted corners
    std::uint32_t triangle;
  };
  std::vector<Item> items(corners.size());
  for (std::uint32_t t = 0; t < corners.size(); ++t) {
    const auto& [a, b, c] = corners[t];
    items[t] = {corners[t], (a > b) != ((b > c) != (a > c)), t};
    std::ranges::sort(items[t].sorted);
  }
  std::ranges::sort(items, {}, [](const Item& item) {
    return std::tuple(item.sorted[0], item.sorted[1], item.sorted[2], item.is_odd, item.triangle);
  });
  std::vector<bool> repeats(corners.size(), false), cancels(corners.size(), false),
      copy(corners.size(), false);
  for (std::size_t begin = 0, end = 0; begin < items.size(); begin = end) {
    while (end < items.size() && items[end].sorted == items[begin].sorted) ++end;
    std::size_t odd = begin;
    while (odd < end && !items[odd].is_odd) ++odd;
    const std::size_t pairs = std::min(odd - begin, end - odd);
    for (std::size_t i = 0; i < pairs; ++i) {
      const std::uint32_t a = items[begin + i].triangle, b = items[odd + i].triangle;
      cancels[a] = cancels[b] = copy[std::max(a, b)] = true;
    }
    // One triangle stays of those without an opposite one.
    for (std::size_t i = begin; i < end; ++i) {
      repeats[items[i].triangle] = (i < odd ? i - begin : i - odd) > pairs;
    }
  }
  audit.repeated += filter(triangles, corners, [&, t = std::size_t{0}](std::size_t i) mutable {
    if (repeats[i]) return false;
    cancels[t] = cancels[i];
    copy[t++] = copy[i];
    return true;
  });
  if (std::ranges::find(cancels, true) == cancels.end()) return;
  const std::vector<bool> is_doubled = of_doubled_shells(corners, cancels, copy);
  std::size_t copies = 0;
  const std::size_t dropped = filter(triangles, corners, [&](std::size_t t) {
    copies += is_doubled[t] && copy[t] ? 1 : 0;
    return is_doubled[t] ? !copy[t] : !cancels[t];
  });
  audit.repeated += copies;
  audit.cancelled = (dropped - copies) / 2;
}

/// Turns triangles so that those connected by an edge of two triangles have one orientation, that of the larger area.
/// Returns the number of the part of each triangle, and counts those turned.
std::vector<std::uint32_t> turn(std::vector<Triangle>& triangles, std::vector<Corners>& corners,
                                const std::vector<Edge>& edges, Audit& audit) {
  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  struct Link {
    std::uint32_t neighbour = none;
    bool against = false;  // both go along the edge in the same sense
  };
  std::vector<std::array<Link, 3>> links(triangles.size());
  std::vector<std::uint8_t> used(triangles.size(), 0);
  const auto link = [&](std::uint32_t t, std::uint32_t neighbour, bool against) {
    links[t][used[t]++] = {neighbour, against};
  };
  for_each_pair(edges, [&](std::size_t begin, std::size_t end) {
    if (end - begin != 2) return;
    const Edge &a = edges[begin], &b = edges[begin + 1];
    link(a.triangle, b.triangle, a.forward == b.forward);
    link(b.triangle, a.triangle, a.forward == b.forward);
  });
  enum : std::uint8_t { unseen, kept, turned };
  std::vector<std::uint8_t> state(triangles.size(), unseen);
  std::vector<std::uint32_t> part, numbers(triangles.size());
  audit.are_parts_closed = audit.open_edges == 0;
  for (std::uint32_t first = 0; first < triangles.size(); ++first) {
    if (state[first] != unseen) continue;
    part.assign(1, first);
    state[first] = kept;
    double balance = 0.0;  // area kept minus area turned
    for (std::size_t i = 0; i < part.size(); ++i) {
      const std::uint32_t t = part[i];
      balance += (state[t] == kept ? 1.0 : -1.0) * area_of(triangles[t]);
      for (const Link& to : links[t]) {
        if (to.neighbour == none) continue;
        const std::uint8_t wanted = (state[t] == kept) != to.against ? kept : turned;
        if (state[to.neighbour] == unseen) {
          state[to.neighbour] = wanted;
          part.push_back(to.neighbour);
        } else if (state[to.neighbour] != wanted) {
          audit.are_parts_closed = false;  // as a band that is turned by half a turn
        }
      }
    }
    for (const std::uint32_t t : part) {
      numbers[t] = static_cast<std::uint32_t>(audit.parts.size());
      if ((state[t] == turned) != (balance >= 0.0)) continue;
      std::swap(triangles[t][1], triangles[t][2]);
      std::swap(corners[t][1], corners[t][2]);
      ++audit.flipped;
    }
    audit.parts.emplace_back();
  }
  return numbers;
}

/// Checks at edges of more than two triangles that every part is closed by itself.
void check_crowded(const std::vector<Corners>& corners, const std::vector<Edge>& edges,
                   const std::vector<std::uint32_t>& part_of, Audit& audit) {
  std::vector<std::pair<std::uint32_t, int>> senses;  // part; +1 or -1
  for_each_pair(edges, [&](std::size_t begin, std::size_t end) {
    if (end - begin <= 2 || !audit.are_parts_closed) return;
    senses.clear();
    for (std::size_t i = begin; i < end; ++i) {
      const Corners& c = corners[edges[i].triangle];
      const auto at = static_cast<std::size_t>(std::ranges::find(c, edges[i].from) - c.begin());
      senses.emplace_back(part_of[edges[i].triangle], c[(at + 1) % 3] == edges[i].to ? 1 : -1);
    }
    std::ranges::sort(senses);
    for (std::size_t i = 0, j = 0; i < senses.size(); i = j) {
      int sum = 0;
      for (; j < senses.size() && senses[j].first == senses[i].first; ++j) sum += senses[j].second;
      if (sum != 0) audit.are_parts_closed = false;
    }
  });
}

/// Sums up areas and volumes, and takes samples of the parts.
void measure(const std::vector<Triangle>& triangles, const std::vector<std::uint32_t>& part_of,
             Audit& audit) {
  constexpr std::size_t most_samples = 20000;
  const std::size_t stride = std::max<std::size_t>(1, triangles.size() / most_samples);
  const Vector3 middle = 0.5 * (audit.lower + audit.upper);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Triangle& t = triangles[i];
    const double volume = (t[0] - middle).dot((t[1] - middle).cross(t[2] - middle)) / 6.0;
    Part& part = audit.parts[part_of[i]];
    audit.area += area_of(t);
    audit.volume += volume;
    part.volume += volume;
    if (i % stride == 0 || part.samples.empty()) part.samples.push_back(t);
  }
}

}  // namespace

Audit repair(std::vector<Triangle>& triangles) {
  Audit audit;
  audit.triangles = triangles.size();
  std::vector<Corners> corners = numbered(triangles);
  audit.degenerate = filter(triangles, corners, [&](std::size_t t) { return area_of(triangles[t]) > 0.0; });
  drop_copies(triangles, corners, audit);
  if (triangles.empty()) {
    throw InputError(audit.triangles == 0 ? std::string("holds no triangle: it encloses nothing")
                     : audit.cancelled > 0
                         ? fmt::format("its triangles cancel: {} pairs of opposite senses", audit.cancelled)
                         : fmt::format("none of its {} triangles has an area", audit.triangles));
  }
  const std::vector<Edge> edges = edges_of(corners);
  for_each_pair(edges, [&](std::size_t begin, std::size_t end) {
    audit.open_edges += end - begin == 1 ? 1 : 0;
    audit.crowded_edges += end - begin > 2 ? 1 : 0;
  });
  const std::vector<std::uint32_t> part_of = turn(triangles, corners, edges, audit);
  check_crowded(corners, edges, part_of, audit);
  audit.lower = audit.upper = triangles[0][0];
  for (const Triangle& t : triangles) {
    for (const Vector3& x : t) {
      audit.lower = audit.lower.cwiseMin(x);
      audit.upper = audit.upper.cwiseMax(x);
    }
  }
  measure(triangles, part_of, audit);
  if (!(audit.upper - audit.lower).allFinite() || !((audit.upper - audit.lower).minCoeff() > 0.0)) {
    throw InputError("its triangles lie in a plane: they bound no solid");
  }
  return audit;
}

}  // namespace whipple::solids
