// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/phase_masses.hpp"

#include <algorithm>
#include <array>

#include "src/core/base/vector_math.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/io/output_fields.hpp"

namespace whipple::solver {

PhaseMasses& PhaseMasses::operator+=(const PhaseMasses& other) {
  for (std::size_t i = 0; i < mass.size(); ++i) mass[i] += other.mass[i];
  failed += other.failed;
  return *this;
}

PhaseMasses phase_masses(const MaterialPoints& points, std::size_t first, std::size_t count) {
  return parallel::sum_of_chunks<PhaseMasses>(count, [&](std::size_t begin, std::size_t end) {
    std::array<Lanes, 4> mass{};
    Lanes failed{};
    for (std::size_t p = first + begin; p < first + end; p += 4) {
      const std::size_t four = std::min<std::size_t>(4, first + end - p);
      const Lanes m = load(&points.mass[p], four, 0.0), melted = load(&points.melted_fraction[p], four, 0.0);
      const std::array<LanesMask, 4> in = io::phases(melted, load(&points.vaporised_fraction[p], four, 0.0));
      for (std::size_t i = 0; i < 4; ++i) mass[i] += select(in[i], m, Lanes{});
      for (std::size_t k = 0; k < four; ++k) failed[k] += points.failed[p + k] != 0 ? m[k] : 0.0;
    }
    PhaseMasses sum;
    for (std::size_t i = 0; i < 4; ++i) sum.mass[i] = sum4(mass[i]);
    sum.failed = sum4(failed);
    return sum;
  });
}

void sum_over_ranks(MPI_Comm communicator, std::vector<PhaseMasses>& by_body) {
  std::vector<double> numbers;
  for (const PhaseMasses& body : by_body) {
    numbers.insert(numbers.end(), body.mass.begin(), body.mass.end());
    numbers.push_back(body.failed);
  }
  parallel::sum(communicator, numbers);
  auto next = numbers.begin();
  for (PhaseMasses& body : by_body) {
    for (double& mass : body.mass) mass = *next++;
    body.failed = *next++;
  }
}

}  // namespace whipple::solver
