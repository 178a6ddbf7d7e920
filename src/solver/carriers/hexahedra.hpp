// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "src/fem/distribution.hpp"
#include "src/fem/facets.hpp"
#include "src/fem/step.hpp"
#include "src/solver/carriers/carrier.hpp"
#include "src/solver/carriers/particle_carrier.hpp"
#include "src/solver/loads.hpp"
#include "src/solver/stages/material.hpp"

namespace whipple::solver {

/// Carries the bodies of hexahedra, except converted elements (docs/theory/fem.md), and their conversion to particles
/// (docs/theory/afemp.md).
class Hexahedra : public Carrier {
 public:
  Hexahedra(State& state, const Loads& loads, std::vector<fem::Mesh> meshes);

  /// Returns this rank's part, with copies of the nodes that it shares with other ranks (src/fem/distribution.hpp).
  [[nodiscard]] const std::vector<fem::Mesh>& meshes() const { return meshes_; }
  /// Returns the faces of each mesh that belong to only one element of all ranks. Collective.
  [[nodiscard]] const std::vector<std::vector<fem::Facet>>& free_facets();

  /// Returns the part of its body (`ContactFields::of_part`) that each node of a mesh belongs to; empty: the body itself.
  [[nodiscard]] const std::vector<std::uint8_t>& parts(std::size_t mesh) const { return parts_[mesh]; }

  /// Converts distorted elements to particles, and treats those outside their valid range as the case specifies.
  /// Collective.
  /// @param grid_step  time step that the grid allows, s
  /// @throws StateError on all ranks if an element on any rank has left its range and the case specifies to stop
  void convert(ParticleCarrier& particles, double grid_step);
  /// Marks the nodes near particles or other bodies: they move with the grid. Collective.
  void mark_transition();
  /// Warns of bodies within reach of each other at the start: they are in contact from the first step. Collective.
  void warn_of_contact() const;

  [[nodiscard]] bool empty() const override { return meshes_.empty(); }
  void compute_forces() override;
  void collect() override;
  void join_shared_nodes() override;
  [[nodiscard]] double critical_time_step() const override;
  std::string advance() override;
  void remove_outside() override;
  void add_totals(Totals& sum) override;
  void add_phases(std::span<PhaseMasses> of_body) const override;
  void add_figures(Figures& figures) const override;
  [[nodiscard]] double largest_speed(const Vector3& frame) override;
  void add_releasable(Releasable& sum) const override;
  [[nodiscard]] std::size_t element_count() const override;
  [[nodiscard]] std::uint64_t largest_particle_id() const override;
  [[nodiscard]] std::size_t bytes() const override;
  [[nodiscard]] double mass_in(const cases::LoadedRegion& region) const override;
  void for_each_point(const std::function<void(const Point& point)>& visit) const override;
  void for_each_part(const SelectElement& select,
                     const std::function<void(const Part& part)>& visit) const override;
  [[nodiscard]] std::string count_text(std::size_t body) const override;
  void keep_share() override;
  void gather() override;
  void share_out() override;
  [[nodiscard]] bool weighs() const override { return !meshes_.empty(); }
  void add_work(std::vector<Vector3>& centres, std::vector<double>& work) const override;
  void save(Contents& contents) const override;
  void show(View& view) const override { view.meshes = meshes_; }

 private:
  [[nodiscard]] double path_factor(const fem::Mesh& mesh) const;
  [[nodiscard]] fem::ConstraintBalance advance_free_nodes(std::size_t mesh);
  void damp_nodes(std::size_t mesh);
  void book_damping(std::size_t mesh);
  [[nodiscard]] std::vector<Vector3> unconstrained_velocities(std::size_t mesh) const;
  void book_faces(std::size_t mesh, std::span<const Vector3> unconstrained);
  [[nodiscard]] std::string advance_mesh(std::size_t mesh, SqueezedPoints& squeezed);
  [[nodiscard]] std::string deform(std::size_t mesh, bool heated, SqueezedPoints& squeezed);
  [[nodiscard]] std::string describe(const fem::Mesh& mesh, std::size_t point,
                                     const std::string& reason) const;
  void elements_removed();
  void find_parts();
  double remove(fem::Mesh& mesh, std::span<const std::uint8_t> removed);
  void warn_of_all(const fem::Mesh& mesh, std::span<const std::uint8_t> distorted) const;
  [[nodiscard]] std::size_t convert(fem::Mesh& mesh, std::span<const std::uint8_t> chosen,
                                    std::string& error);

  const Loads& loads_;
  std::vector<fem::Mesh> meshes_;
  std::vector<std::vector<fem::Facet>> free_facets_;  // of each mesh
  bool surfaces_changed_ = true;                      // since they were determined
  // Of each mesh: parts of its nodes (empty: all are of the body itself), and their number over all ranks
  std::vector<std::vector<std::uint8_t>> parts_;
  std::vector<std::size_t> part_counts_;
  bool pieces_changed_ = true;  // since parts were found
  fem::SharedNodes shared_nodes_;
  // Of each shared node over all its copies: force (N), mass (kg), sound speed (m/s)
  std::vector<std::array<double, 5>> shared_;
  // In the current step:
  std::size_t count_ = 0;               // of the nodes in State::transition
  struct Motion {                       // of each mesh
    std::vector<Vector3> acceleration;  // of the nodes by loads, m/s^2
    double hoop_force = 0.0;            // N, sum of the radial forces of rings
    std::vector<Vector3> damping;       // impulses of local damping on the nodes, N s; empty: none
    fem::VelocityGradients gradient;
  };
  std::vector<Motion> of_mesh_;
  std::vector<fem::Motion> motions_;
  std::vector<std::vector<double>> node_heat_;
  std::vector<fem::ConstraintBalance> tools_;  // of each mesh, by its interface nodes
};

}  // namespace whipple::solver
