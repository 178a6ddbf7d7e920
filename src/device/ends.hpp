// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

#include "src/device/lattice.hpp"
#include "src/device/material/material_point.hpp"
#include "src/device/points.hpp"
#include "src/device/reduction.hpp"

/// The end of a step: faces of the domain, sums of the run and bounds of the next step.
namespace whipple::device {

/// Behaviour of a face of the domain towards particles beyond it.
enum class FaceKind : std::uint8_t {
  outflow,      ///< they leave
  mirror,       ///< they are replaced by their image
  mirror_point  ///< the same, with the opposite velocity
};

/// Sums of a step over all particles, in SI units. Those of the points are totals, the others contributions of the step.
struct StepSums {
  enum Sum : std::size_t {
    total_mass,
    momentum,
    momentum_scale = momentum + 3,
    angular_momentum,
    kinetic = angular_momentum + 3,
    affine_kinetic,
    internal,
    unresolved_,
    work_,
    viscous_work_,
    heat_,
    kept_,
    returned_,
    plastic_work_,
    dissipation_,
    plastic_heat_,
    external_work_,
    wall_impulse,
    leaving = wall_impulse + 3,  ///< number of particles
    first_event,                 ///< number of particles with each event
    sums = first_event + 12
  };
  enum Maximum : std::size_t {
    speed,       ///< sound speed plus largest component of the velocity
    change,      ///< squared change of the velocity
    rate,        ///< of compression
    relative,    ///< squared speed in the frame of reference
    first_ends,  ///< of the events that end a run: all_of_origin less the origin of the first particle
    maxima = first_ends + 4
  };
};
constexpr double all_of_origin = 4294967296.0;
using EndOfStep = Reduction<StepSums::sums, StepSums::maxima>;

/// Marks a particle that leaves, in place of its events.
constexpr double leaves = -1.0;

/// Treats particles beyond the faces and sums all of them.
struct EndStep {
  using Result = EndOfStep;
  Points points;
  Triple<double> lower, upper;  ///< m
  std::array<FaceKind, 6> faces;
  double inertia;        ///< of the affine fields, per mass, m^2
  Triple<double> frame;  ///< velocity of the frame of reference, m/s

  WHIPPLE_POINT void operator()(std::size_t p, Result& result) const {
    const bool stays = pass_faces(p, result);
    if (!stays) {
      points.at(events, p) = leaves;
      result.sum[StepSums::leaving] += 1.0;
    }
    add_step(p, result);
    if (!stays) return;
    add_totals(points, p, inertia, result);
    const Triple<double> v = points.vector(velocity, p), relative = v - frame;
    result.raise(StepSums::relative, dot(relative, relative));
    const double fastest = std::fmax(std::fabs(v.x), std::fmax(std::fabs(v.y), std::fabs(v.z)));
    result.raise(StepSums::speed, points.at(sound_speed, p) + fastest);
  }

  /// Adds the totals of a particle to any sums that begin with these.
  template <class Sums>
  static WHIPPLE_POINT void add_totals(const Points& points, std::size_t p, double inertia, Sums& result) {
    using S = StepSums;
    const double m = points.at(mass, p);
    const Triple<double> x = points.vector(position, p), v = points.vector(velocity, p);
    const std::array<Triple<double>, 3> c = points.columns(affine, p);
    const double speed2 = dot(v, v);
    const Triple<double> rotation = {c[1].z - c[2].y, c[2].x - c[0].z, c[0].y - c[1].x};
    const Triple<double> angular = cross(x, v) + inertia * rotation;
    result.sum[S::total_mass] += m;
    result.sum[S::momentum] += m * v.x;
    result.sum[S::momentum + 1] += m * v.y;
    result.sum[S::momentum + 2] += m * v.z;
    result.sum[S::momentum_scale] += m * std::sqrt(speed2);
    result.sum[S::angular_momentum] += m * angular.x;
    result.sum[S::angular_momentum + 1] += m * angular.y;
    result.sum[S::angular_momentum + 2] += m * angular.z;
    result.sum[S::kinetic] += 0.5 * m * speed2;
    result.sum[S::affine_kinetic] +=
        0.5 * m * inertia * (dot(c[0], c[0]) + dot(c[1], c[1]) + dot(c[2], c[2]));
    result.sum[S::internal] += m * points.at(energy, p);
    result.sum[S::unresolved_] += m * points.at(unresolved, p);
  }

 private:
  /// Reflects a particle at mirror planes and walls.
  /// @returns whether it stays
  WHIPPLE_POINT bool pass_faces(std::size_t p, Result& result) const {
    bool stays = true;
#ifdef __CUDA_ARCH__
#pragma unroll  // no index at run time, which would put the kernel's arguments into memory
#endif
    for (int a = 0; a < 3; ++a) {
      double& x = points.at(position + static_cast<std::uint32_t>(a), p);
      const double low = a == 0 ? lower.x : a == 1 ? lower.y : lower.z;
      const double high = a == 0 ? upper.x : a == 1 ? upper.y : upper.z;
      if (x >= low && x <= high) continue;
      const bool below = x < low;
      const auto face = 2 * static_cast<std::size_t>(a);
      const FaceKind kind = below ? faces[face] : faces[face + 1];
      if (kind == FaceKind::outflow || !(x < low || x > high)) {
        stays = false;
        continue;
      }
      x = 2.0 * (below ? low : high) - x;
      reflect(p, a, kind == FaceKind::mirror_point, result);
    }
    return stays;
  }
  WHIPPLE_POINT void reflect(std::size_t p, int axis, bool all, Result& result) const {
    const double m = points.at(mass, p);
    for (int r = 0; r < 3; ++r) {
      const bool turns = all || r == axis;
      if (turns) {
        double& v = points.at(velocity + static_cast<std::uint32_t>(r), p);
        result.sum[StepSums::wall_impulse + static_cast<std::size_t>(r)] -= 2.0 * m * v;
        v = -v;
      }
      for (int c = 0; c < 3; ++c) {
        if (turns == (c == axis)) continue;
        double& entry = points.at(affine + static_cast<std::uint32_t>(3 * c + r), p);
        entry = -entry;
      }
    }
    // The components xy, yz, zx with one index along the axis.
    for (const std::uint32_t tensor : {std::uint32_t{deviator}, std::uint32_t{extent}}) {
      for (int k = 0; k < 3; ++k) {
        const bool turns = k == axis || (k + 1) % 3 == axis;
        double& entry = points.at(tensor + 3 + static_cast<std::uint32_t>(k), p);
        if (turns) entry = -entry;
      }
    }
  }
  WHIPPLE_POINT void add_step(std::size_t p, Result& result) const {
    using S = StepSums;
    result.sum[S::work_] += points.at(work, p);
    result.sum[S::viscous_work_] += points.at(viscous_work, p);
    result.sum[S::heat_] += points.at(heat, p);
    result.sum[S::kept_] += points.at(kept, p);
    result.sum[S::returned_] += points.at(returned, p);
    result.sum[S::plastic_work_] += points.at(plastic_work, p);
    result.sum[S::dissipation_] += points.at(dissipation, p);
    result.sum[S::plastic_heat_] += points.at(plastic_heat, p);
    result.sum[S::external_work_] += points.at(external_work, p);
    result.raise(S::change, points.at(squared_change, p));
    result.raise(S::rate, points.at(compression, p));
    const double of_step = points.at(events, p);
    if (!(of_step > 0.0)) return;
    const auto bits = static_cast<std::uint32_t>(of_step);
    std::size_t ends = 0;
#ifdef __CUDA_ARCH__
#pragma unroll  // so that `ends` is known to the compiler
#endif
    for (std::size_t k = 0; k < S::sums - S::first_event; ++k) {
      const bool set = (bits >> k & 1U) != 0;
      if (set) result.sum[S::first_event + k] += 1.0;
      if ((event::stopping >> k & 1U) == 0) continue;
      if (set && ends < S::maxima - S::first_ends) {
        result.raise(S::first_ends + ends, all_of_origin - static_cast<double>(points.origin[p]));
      }
      ++ends;
    }
  }
};

/// Sums the particles of a body that leave.
struct Outflow {
  using Result = Reduction<StepSums::unresolved_ + 1, 0>;
  Points points;
  std::uint32_t body;
  double inertia;
  WHIPPLE_POINT void operator()(std::size_t p, Result& result) const {
    if (points.body[p] == body && points.at(events, p) == leaves)
      EndStep::add_totals(points, p, inertia, result);
  }
};
/// Flags the particles that stay.
struct FlagStaying {
  Points points;
  std::uint32_t* stays;
  WHIPPLE_POINT void operator()(std::size_t p) const { stays[p] = points.at(events, p) == leaves ? 0 : 1; }
};
/// Lists flagged items in their order.
struct ListFlagged {
  const std::uint32_t *flag, *before;
  std::uint32_t* list;
  WHIPPLE_POINT void operator()(std::size_t i) const {
    if (flag[i] != 0) list[before[i]] = static_cast<std::uint32_t>(i);
  }
};

/// Sums the masses (kg) of each body and of its particles that a bit of the events marks.
struct MarkedMass {
  using Result = Reduction<4, 0>;  ///< marked: number and mass; all: number and mass
  Points points;
  std::uint32_t body, mask;
  WHIPPLE_POINT void operator()(std::size_t p, Result& result) const {
    if (points.body[p] != body) return;
    const double m = points.at(mass, p), of_step = points.at(events, p);
    result.sum[2] += 1.0;
    result.sum[3] += m;
    if (!(of_step > 0.0) || (static_cast<std::uint32_t>(of_step) & mask) == 0) return;
    result.sum[0] += 1.0;
    result.sum[1] += m;
  }
};

}  // namespace whipple::device
