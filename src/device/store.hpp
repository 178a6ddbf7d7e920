// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "src/device/bins.hpp"
#include "src/device/ends.hpp"
#include "src/device/problem.hpp"

namespace whipple::device {

/// Keeps the particles in the memory of a space.
template <class Space>
class Store {
 public:
  template <class T>
  using Array = typename Space::template Array<T>;

  /// Replaces the particles.
  void upload(const PointsOnHost& points) {
    const std::size_t n = points.size();
    numbers_.reserve(all_components * n);
    for (std::size_t c = 0; c < state_components; ++c) numbers_.upload(points.numbers[c].data(), n, c * n);
    std::vector<std::uint32_t> origin(n);
    for (std::size_t p = 0; p < n; ++p) origin[p] = static_cast<std::uint32_t>(p);
    for (Array<std::uint32_t>* of : {&body_, &origin_, &first_, &before_, &order_}) of->reserve(n);
    body_.upload(points.body.data(), n);
    origin_.upload(origin.data(), n);
    spare_.reserve(n);
    points_ = {
        .numbers = numbers_.data(), .stride = n, .body = body_.data(), .origin = origin_.data(), .size = n};
  }

  [[nodiscard]] const Points& points() const { return points_; }
  [[nodiscard]] std::size_t bytes() const {
    return numbers_.bytes() + spare_.bytes() + body_.bytes() + origin_.bytes() + first_.bytes() +
           before_.bytes() + order_.bytes();
  }

  /// Clears the results of a step.
  void clear_results(Space& space) {
    for (std::uint32_t c = work; c < all_components; ++c) {
      space.for_each(points_.size, Fill<double>{points_.numbers + c * points_.stride, 0.0});
    }
  }

  /// Sorts the particles in memory by body, those of a body in the given order.
  void sort(Space& space, const std::uint32_t* order, std::size_t bodies) {
    const std::size_t n = points_.size;
    space.for_each(n, Gather<std::uint32_t>{points_.body, order, first_.data()});
    space.for_each(n, Copy<std::uint32_t>{order, order_.data()});
    space.sort(first_, order_, n, static_cast<unsigned>(std::bit_width(bodies)));
    rearrange(space, order_.data(), n);
  }

  /// Sorts the particles in memory: those of the order become the first `size`.
  void rearrange(Space& space, const std::uint32_t* order, std::size_t size) {
    for (std::size_t c = 0; c < state_components; ++c) {
      double* const column = points_.numbers + c * points_.stride;
      space.for_each(size, Gather<double>{column, order, spare_.data()});
      space.for_each(size, Copy<double>{spare_.data(), column});
    }
    for (std::uint32_t* of : {points_.body, points_.origin}) {
      space.for_each(size, Gather<std::uint32_t>{of, order, first_.data()});
      space.for_each(size, Copy<std::uint32_t>{first_.data(), of});
    }
  }

  /// Removes the particles that leave; the others keep their order.
  void remove_leaving(Space& space) {
    const std::size_t n = points_.size;
    space.for_each(n, FlagStaying{points_, first_.data()});
    const std::uint32_t left = space.scan(first_.data(), before_.data(), n);
    space.for_each(n, ListFlagged{first_.data(), before_.data(), order_.data()});
    rearrange(space, order_.data(), left);
    points_.size = left;
  }

  /// Copies the particles to the host in their order; their origin becomes 0, 1, 2 ...
  void download(Space& space, PointsOnHost& points) {
    const std::size_t n = points_.size;
    points.body.resize(n);
    points.origin.resize(n);
    body_.download(points.body.data(), n);
    origin_.download(points.origin.data(), n);
    for (std::size_t c = 0; c < state_components; ++c) {
      points.numbers[c].resize(n);
      numbers_.download(points.numbers[c].data(), n, c * points_.stride);
    }
    space.for_each(n, Iota{points_.origin});
  }

 private:
  Points points_;
  Array<double> numbers_, spare_;
  Array<std::uint32_t> body_, origin_, first_, before_, order_;
};

}  // namespace whipple::device
