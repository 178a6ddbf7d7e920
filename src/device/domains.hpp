// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "src/device/points.hpp"
#include "src/device/reduction.hpp"
#include "src/material/fluid_formulas.hpp"

/// Domains of the particles of fluids (docs/theory/mpm.md, 2.4, 2.5, 2.8).
namespace whipple::device {

/// What is done with the domains of the particles of a body.
struct DomainsOfBody {
  bool deform = false;  ///< with the material; if so they may be divided
  bool hold = false;    ///< the pressure of fluid that has parted from its neighbours is held back
  Fluidity fluidity = Fluidity::never;
  double initial_density = 0.0;  ///< kg/m^3
};
/// Limits of the domains of a run.
struct DomainLimits {
  double longest = 0.0;      ///< square of the half-edge beyond which a particle is divided, m^2
  double parted = 0.0;       ///< lambda of (2.8), m^2
  double generations = 0.0;  ///< that a particle may have at most
  bool divides_all = false;  ///< not only fluids
  bool planar = false;       ///< two dimensions: only the section of a domain with the plane counts
};

using Moments = material::formulas::Symmetric<double>;

/// Deforms the domains, E <- (I + dt L) E (I + dt L)^T (2.4).
struct DeformDomains {
  Points points;
  const DomainsOfBody* bodies;
  double dt;

  WHIPPLE_POINT void operator()(std::size_t p) const {
    if (!bodies[points.body[p]].deform) return;
    const auto f = [&](std::uint32_t row, std::uint32_t column) {
      return (row == column ? 1.0 : 0.0) + dt * points.at(gradient + 3 * row + column, p);
    };
    const Triple<double> x = {f(0, 0), f(1, 0), f(2, 0)}, y = {f(0, 1), f(1, 1), f(2, 1)},
                         z = {f(0, 2), f(1, 2), f(2, 2)};  // columns of I + dt L
    const Moments e = points.symmetric(extent, p);
    const Triple<double> of_x = e.xx * x + e.xy * y + e.zx * z,  // columns of (I + dt L) E
        of_y = e.xy * x + e.yy * y + e.yz * z, of_z = e.zx * x + e.yz * y + e.zz * z;
    const Triple<double> first = x.x * of_x + y.x * of_y + z.x * of_z,
                         second = x.y * of_x + y.y * of_y + z.y * of_z,
                         third = x.z * of_x + y.z * of_y + z.z * of_z;
    points.set(extent, p, {first.x, second.y, third.z});
    points.set(extent + 3, p, {first.y, second.z, first.z});
  }
};

/// Returns an upper bound of the largest eigenvalue (Gershgorin).
WHIPPLE_POINT inline double largest_at_most(const Moments& e) {
  const double xy = std::fabs(e.xy), yz = std::fabs(e.yz), zx = std::fabs(e.zx);
  return std::fmax(std::fmax(e.xx + xy + zx, e.yy + xy + yz), e.zz + zx + yz);
}

/// Eigenvalues of a symmetric matrix with their unit vectors.
struct Principal {
  double value[3];
  Triple<double> direction[3];
};

/// Computes the principal directions by Jacobi's rotations (G. H. Golub, C. F. Van Loan, Matrix Computations, 4th ed.
/// (2013), section 8.5), which converge quadratically: the sweeps are more than any matrix needs.
WHIPPLE_POINT inline Principal principal_of(const Moments& e) {
  Principal all = {{e.xx, e.yy, e.zz}, {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
  double xy = e.xy, yz = e.yz, zx = e.zx;
  // Rotates directions p and q so that their entry `pq` vanishes; `pr` and `qr` are those with the third one.
  const auto rotate = [](double& p, double& q, double& pq, double& pr, double& qr, Triple<double>& u,
                         Triple<double>& v) {
    if (pq == 0.0) return;
    const double theta = 0.5 * (q - p) / pq;
    const double t = (theta >= 0.0 ? 1.0 : -1.0) / (std::fabs(theta) + std::sqrt(theta * theta + 1.0));
    const double c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
    p -= t * pq;
    q += t * pq;
    pq = 0.0;
    const double of_p = pr;
    pr = c * of_p - s * qr;
    qr = s * of_p + c * qr;
    const Triple<double> former = u;
    u = c * former - s * v;
    v = s * former + c * v;
  };
  for (int sweep = 0; sweep < 8; ++sweep) {
    rotate(all.value[0], all.value[1], xy, zx, yz, all.direction[0], all.direction[1]);
    rotate(all.value[1], all.value[2], yz, xy, zx, all.direction[1], all.direction[2]);
    rotate(all.value[0], all.value[2], zx, xy, yz, all.direction[0], all.direction[2]);
  }
  return all;
}
/// Computes those of a domain, in two dimensions those of its section with the plane.
WHIPPLE_POINT inline Principal principal_of_domain(Moments e, bool planar) {
  if (planar) e.zz = e.yz = e.zx = 0.0;
  return principal_of(e);
}

/// Returns whether a particle is a fluid that fills its volume (is_filling_fluid).
WHIPPLE_POINT inline bool fills(const Points& points, Fluidity fluidity, std::size_t p) {
  return is_filling_fluid(fluidity, points.at(pressure, p), points.at(void_volume, p), points.at(melted, p),
                          points.at(vaporised, p));
}

/// Holds back the pressure of fluid that has parted, along the directions in which it has (2.8).
struct HoldBackPressure {
  using Result = Reduction<1, 0>;  ///< number of such particles
  Points points;
  const DomainsOfBody* bodies;
  DomainLimits limits;

  WHIPPLE_POINT void operator()(std::size_t p, Result& result) const {
    const DomainsOfBody& body = bodies[points.body[p]];
    if (!body.hold) return;
    const Moments e = points.symmetric(extent, p);
    const bool thin = points.at(mass, p) < 0.5 * body.initial_density * points.at(volume, p);
    if (largest_at_most(e) <= limits.parted || !thin || !fills(points, body.fluidity, p)) return;
    const Principal principal = principal_of_domain(e, limits.planar);
    Moments parting{};  // I - S
    bool any = false;
    for (int a = 0; a < 3; ++a) {
      if (!(principal.value[a] > limits.parted)) continue;
      const Triple<double>& n = principal.direction[a];
      parting.xx += n.x * n.x, parting.yy += n.y * n.y, parting.zz += n.z * n.z;
      parting.xy += n.x * n.y, parting.yz += n.y * n.z, parting.zx += n.z * n.x;
      any = true;
    }
    if (!any) return;
    const double back = points.at(pressure, p);
    points.at(deviator, p) += back * parting.xx;
    points.at(deviator + 1, p) += back * parting.yy;
    points.at(deviator + 2, p) += back * parting.zz;
    points.at(deviator + 3, p) += back * parting.xy;
    points.at(deviator + 4, p) += back * parting.yz;
    points.at(deviator + 5, p) += back * parting.zx;
    result.sum[0] += 1.0;
  }
};

/// Finds whether any particle is so long that it must be divided (2.5).
struct AnyTooLong {
  using Result = Reduction<0, 1>;
  Points points;
  const DomainsOfBody* bodies;
  DomainLimits limits;
  Triple<double> lower, upper;  ///< of the domain, m

  WHIPPLE_POINT void operator()(std::size_t p, Result& result) const {
    const DomainsOfBody& body = bodies[points.body[p]];
    const Moments e = points.symmetric(extent, p);
    if (!body.deform || !(largest_at_most(e) > limits.longest)) return;
    if (points.at(generation, p) >= limits.generations) return;
    const bool intact = points.at(failed, p) == 0.0;
    const bool continuous = fills(points, body.fluidity, p) && (intact || points.at(vaporised, p) > 0.5);
    if (!continuous && !(limits.divides_all && intact)) return;
    const Principal principal = principal_of_domain(e, limits.planar);
    double square = principal.value[0];  // no index at run time, which would put them into memory
    Triple<double> n = principal.direction[0];
    for (int a = 1; a < 3; ++a) {
      if (!(principal.value[a] > square)) continue;
      square = principal.value[a];
      n = principal.direction[a];
    }
    if (square <= limits.longest) return;
    const double half = 0.5 * std::sqrt(square);
    const Triple<double> reach = {half * std::fabs(n.x), half * std::fabs(n.y), half * std::fabs(n.z)};
    const Triple<double> x = points.vector(position, p), low = x - reach, high = x + reach;
    const bool inside = low.x > lower.x && low.y > lower.y && high.x < upper.x && high.y < upper.y;
    const bool inside_z = limits.planar || (low.z > lower.z && high.z < upper.z);
    if (inside && inside_z) result.raise(0, 1.0);
  }
};

}  // namespace whipple::device
