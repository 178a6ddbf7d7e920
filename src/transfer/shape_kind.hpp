// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "src/core/base/words.hpp"

/// Names of the shape functions.
namespace whipple::transfer {

/// Kinds of shape functions, then the same in two dimensions (`in_plane`).
enum class ShapeFunction : std::uint8_t {
  linear,
  gimp,
  convected_gimp,
  quadratic_bspline,
  cubic_bspline,
  planar_linear,
  planar_gimp,
  planar_convected_gimp,
  planar_quadratic_bspline,
  planar_cubic_bspline
};

/// The words of those that a case can name.
constexpr std::array<Word<ShapeFunction>, 5> words(ShapeFunction) {
  return {{{ShapeFunction::quadratic_bspline, "quadratic_bspline"},
           {ShapeFunction::cubic_bspline, "cubic_bspline"},
           {ShapeFunction::convected_gimp, "convected_gimp"},
           {ShapeFunction::gimp, "gimp"},
           {ShapeFunction::linear, "linear"}}};
}

/// Shape functions of the transfers of momentum: their kind, and how smooth the slopes of quadratic ones are.
struct ShapeFunctions {
  // NOLINTNEXTLINE(google-explicit-constructor): a kind alone has the derivatives of N as slopes
  constexpr ShapeFunctions(ShapeFunction of_kind, double smoothing = 0.0)
      : kind(of_kind), slope_smoothing(smoothing) {}
  ShapeFunction kind;
  double slope_smoothing;  ///< a1 of quadratic B-splines (docs/theory/mpm.md, 2.9); 0: the derivatives of N
};

/// The kind that reaches nodes of the plane z = lower only.
constexpr ShapeFunction in_plane(ShapeFunction kind) {
  constexpr auto first = static_cast<std::uint8_t>(ShapeFunction::planar_linear);
  const auto number = static_cast<std::uint8_t>(kind);
  return number < first ? static_cast<ShapeFunction>(number + first) : kind;
}

}  // namespace whipple::transfer
