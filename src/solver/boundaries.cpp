// SPDX-License-Identifier: BSD-3-Clause
#include "src/base/gaps.hpp"
#include "src/base/vector_math.hpp"
#include "src/parallel/threads.hpp"
#include "src/solver/simulation.hpp"

namespace whipple::solver {

void Simulation::reflect_and_remove() {
  profile_.time("boundaries", [&] {
    remove_elements_outside();
    remove_bars_outside();
    const grid::Geometry& g = setup_.geometry;
    const Lanes lower = {g.lower[0], g.lower[1], g.lower[2], 0.0};
    const Lanes upper = {g.upper(0), g.upper(1), g.upper(2), 0.0};
    const std::vector<std::uint32_t> outside = parallel::where(particles_.size(), [&](std::size_t p) {
      const Lanes position = load_vector(particles_.position[p].data());
      return bits((position >= lower) & (position <= upper)) != all_lanes;
    });
    std::vector<std::uint32_t> leaving;
    for (const std::uint32_t p : outside) {
      bool leaves = false;
      for (int a = 0; a < 3; ++a) {
        double& x = particles_.position[p][a];
        if (x >= g.lower[a] && x <= g.upper(a)) continue;
        const bool low = x < g.lower[a];
        const grid::Boundary boundary = g.boundary[static_cast<std::size_t>(2 * a + (low ? 0 : 1))];
        if (boundary == grid::Boundary::outflow) {
          leaves = true;
          continue;
        }
        // Interpolation gives no normal velocity at a mirror plane, so only the finite time step brings a
        // particle across: it is put back as its own image.
        x = 2.0 * (low ? g.lower[a] : g.upper(a)) - x;
        Matrix3 mirror = Matrix3::Identity();
        mirror(a, a) = -1.0;
        // At a no-slip wall all components of the image's velocity are reversed, its place along one axis
        // only.
        const Matrix3 image = boundary == grid::Boundary::no_slip ? Matrix3(-Matrix3::Identity()) : mirror;
        const Vector3 velocity = image * particles_.velocity[p];
        step_.wall_impulse += particles_.mass[p] * (velocity - particles_.velocity[p]);
        particles_.velocity[p] = velocity;
        if (!particles_.affine_velocity.empty()) {
          particles_.affine_velocity[p] = image * particles_.affine_velocity[p] * mirror;
        }
        for (auto* tensors : {&particles_.deviatoric_stress, &particles_.back_stress, &particles_.strain,
                              &particles_.extent}) {
          if (tensors->empty()) continue;  // optional, not in use
          (*tensors)[p] = SymmetricTensor::from(mirror * (*tensors)[p].matrix() * mirror);
        }
      }
      if (leaves) leaving.push_back(p);
    }
    if (leaving.empty()) return;
    for (const std::uint32_t p : leaving) {
      step_.outflow += totals_of(particles_, p, particle_affine_inertia());
    }
    const std::vector<Move> moves = moves_into_gaps(particles_.body, leaving);
    const std::size_t size = particles_.size() - leaving.size();
    remove(particles_, moves, size);
    grid_.particles_removed(moves, size);
    find_bodies();
  });
}

}  // namespace whipple::solver
