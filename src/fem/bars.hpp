// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "src/fem/mesh.hpp"
#include "src/fem/step.hpp"

/// Two-node trusses that carry axial forces only: reinforcement, fibres, wires (docs/theory/fem.md, 6). Their nodes are
/// finite element nodes: they move independently, or with the velocity field of a grid.
namespace whipple::fem {

/// Holds points and the two ends of every bar. A bar whose ends are one node is a hoop about the x axis (eq. 6.5).
struct Lines {
  std::vector<Vector3> nodes;  ///< m
  std::vector<std::array<std::uint32_t, 2>> elements;
  std::vector<double> number;  ///< of equal bars that each element stands for: a row of them

  void add(const std::array<std::uint32_t, 2>& ends, double of_row = 1.0) {
    elements.push_back(ends);
    number.push_back(of_row);
  }
};

/// Describes an elastic-plastic bar based on the logarithmic strain (eq. 6.2).
struct BarMaterial {
  double density = 0.0;                                           ///< kg/m^3
  double young = 0.0;                                             ///< Pa
  double yield_stress = std::numeric_limits<double>::infinity();  ///< Pa
  double hardening_modulus = 0.0;  ///< Pa, slope of the yield stress over the plastic strain
  double failure_strain = std::numeric_limits<double>::infinity();  ///< plastic strain at which a bar breaks
};

struct BarElements {
  std::vector<std::uint64_t> id;
  std::vector<std::array<std::uint32_t, 2>> ends;
  std::vector<double> mass;              ///< kg
  std::vector<double> reference_length;  ///< m, stress-free
  std::vector<double> stress;            ///< Pa, Kirchhoff (per initial volume), positive in tension
  std::vector<double> plastic_strain;    ///< equivalent
  std::vector<double> internal_energy;   ///< J, elastic and heat
  std::vector<std::uint8_t> broken;      ///< 1: carries no force any more

  [[nodiscard]] std::size_t size() const { return id.size(); }

  static constexpr auto fields() {
    using B = BarElements;
    return std::make_tuple(
        Field{"id", "1", &B::id}, Field{"ends", "1", &B::ends}, Field{"mass", "kg", &B::mass},
        Field{"reference_length", "m", &B::reference_length}, Field{"stress", "Pa", &B::stress},
        Field{"plastic_strain", "1", &B::plastic_strain}, Field{"internal_energy", "J", &B::internal_energy},
        Field{"broken", "1", &B::broken});
  }
};

/// Holds the bars of one material.
struct Bars {
  BarMaterial material;
  std::uint32_t body = 0;  ///< index of the body in the case
  Nodes nodes;
  BarElements elements;

  // Derived by `connect`: the ends that meet at node a, each as 2 bar + end, ascending.
  std::vector<std::uint32_t> first_end, node_ends;
  std::vector<Vector3> axial_force;  ///< scratch of `internal_forces`: N, on the second end
};

/// Creates bars from lines.
/// @param area  m^2, of the cross-section
/// @throws InputError if density, stiffness or area is not positive, if a bar has zero length, a hoop no radius, or if a
/// node does not exist or belongs to no bar
Bars make_bars(const Lines& lines, double area, const BarMaterial& material, const std::string& name,
               std::uint32_t body = 0, std::uint64_t first_node_id = 0, std::uint64_t first_element_id = 0);

/// Rebuilds the data derived from the ends.
void connect(Bars& bars);

/// Sums the masses of the bars at the nodes, half at each end.
void lump_masses(Bars& bars);

/// Returns the minimum l/c of the unbroken bars (s), c^2 = E/rho (eq. 6.4).
double critical_time_step(const Bars& bars);

/// Computes the nodal forces into `nodes.force` (eq. 6.1).
/// @returns the radial force of hoops, N: what does not add up to zero
double internal_forces(Bars& bars);

/// Holds work into the internal energy of bars, and what of it is heat of plastic flow and of bars that break, J.
struct BarWork {
  double work = 0.0, plastic_heat = 0.0;
  BarWork& operator+=(const BarWork& other) {
    work += other.work;
    plastic_heat += other.plastic_heat;
    return *this;
  }
};

/// Computes the work of the step, then strain and stress at its end, which are exactly those of the moved nodes (eq.
/// 6.2, 6.3).
BarWork deform(Bars& bars, const Motion& motion, double dt);

double internal_energy(const Bars& bars);
/// Returns the elastic part of the internal energy of all bars, J.
double elastic_energy(const Bars& bars);

/// Distributes heat given at the nodes (J) over their bars by mass.
void add_heat(Bars& bars, std::span<const double> node_heat);

/// Removes bars (`removed` != 0) and their contributions to the nodal masses; nodes without bars are removed.
void remove_bars(Bars& bars, std::span<const std::uint8_t> removed);

}  // namespace whipple::fem
