// SPDX-License-Identifier: BSD-3-Clause
#include "src/solids/surface.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
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

std::size_t drop_repeated(std::vector<Triangle>& triangles, std::vector<Corners>& corners) {
  std::vector<std::pair<Corners, std::uint32_t>> sorted(corners.size());
  for (std::uint32_t t = 0; t < corners.size(); ++t) {
    sorted[t] = {corners[t], t};
    std::ranges::sort(sorted[t].first);
  }
  std::ranges::sort(sorted);
  std::vector<bool> repeats(corners.size(), false);
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i].first == sorted[i - 1].first) repeats[sorted[i].second] = true;
  }
  return filter(triangles, corners, [&](std::size_t t) { return !repeats[t]; });
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

/// Turns triangles so that those connected by an edge of two triangles have one orientation, that of the larger area.
/// Returns how many were turned.
std::size_t turn(std::vector<Triangle>& triangles, const std::vector<Edge>& edges) {
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
  std::vector<std::uint32_t> part;
  std::size_t count = 0;
  for (std::uint32_t first = 0; first < triangles.size(); ++first) {
    if (state[first] != unseen) continue;
    part.assign(1, first);
    state[first] = kept;
    double balance = 0.0;  // area kept minus area turned
    for (std::size_t i = 0; i < part.size(); ++i) {
      const std::uint32_t t = part[i];
      balance += (state[t] == kept ? 1.0 : -1.0) * area_of(triangles[t]);
      for (const Link& to : links[t]) {
        if (to.neighbour == none || state[to.neighbour] != unseen) continue;
        state[to.neighbour] = (state[t] == kept) != to.against ? kept : turned;
        part.push_back(to.neighbour);
      }
    }
    for (const std::uint32_t t : part) {
      if ((state[t] == turned) != (balance >= 0.0)) continue;
      std::swap(triangles[t][1], triangles[t][2]);
      ++count;
    }
  }
  return count;
}

}  // namespace

Audit repair(std::vector<Triangle>& triangles) {
  Audit audit;
  audit.triangles = triangles.size();
  std::vector<Corners> corners = numbered(triangles);
  audit.degenerate = filter(triangles, corners, [&](std::size_t t) { return area_of(triangles[t]) > 0.0; });
  audit.repeated = drop_repeated(triangles, corners);
  if (triangles.empty()) {
    throw InputError(audit.triangles == 0
                         ? std::string("holds no triangle: it encloses nothing")
                         : fmt::format("none of its {} triangles has an area", audit.triangles));
  }
  const std::vector<Edge> edges = edges_of(corners);
  for_each_pair(edges, [&](std::size_t begin, std::size_t end) {
    audit.open_edges += end - begin == 1 ? 1 : 0;
    audit.crowded_edges += end - begin > 2 ? 1 : 0;
  });
  audit.flipped = turn(triangles, edges);
  audit.lower = audit.upper = triangles[0][0];
  for (const Triangle& t : triangles) {
    for (const Vector3& x : t) {
      audit.lower = audit.lower.cwiseMin(x);
      audit.upper = audit.upper.cwiseMax(x);
    }
  }
  const Vector3 middle = 0.5 * (audit.lower + audit.upper);
  for (const Triangle& t : triangles) {
    audit.area += area_of(t);
    audit.volume += (t[0] - middle).dot((t[1] - middle).cross(t[2] - middle)) / 6.0;
  }
  if (!(audit.upper - audit.lower).allFinite() || !((audit.upper - audit.lower).minCoeff() > 0.0)) {
    throw InputError("its triangles lie in a plane: they bound no solid");
  }
  return audit;
}

}  // namespace whipple::solids
