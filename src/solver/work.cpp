// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/work.hpp"

#include <algorithm>

namespace whipple::solver {
namespace {

/// Returns the work (transfers of a particle) of the constitutive update, measured by `whipple bench`
/// (docs/manual/performance.md): 233 ns for the transfers,
/// 41 to 65 ns for the update with a model whose state is explicit or tabulated.
double work_of_material(const Material& material) { return 0.25 * material.eos->relative_cost(); }

}  // namespace

void work_of_particles(const cases::Case& setup, std::span<const cases::BodySummary> bodies,
                       std::vector<double>& work) {
  work.clear();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    work.resize(std::max(work.size(), bodies[b].first + bodies[b].count), 1.0);
    std::fill_n(work.begin() + static_cast<std::ptrdiff_t>(bodies[b].first), bodies[b].count,
                1.0 + work_of_material(*setup.materials[b]));
  }
}

}  // namespace whipple::solver
