// SPDX-License-Identifier: BSD-3-Clause
// Writes a table: smoothed particles beside material points with the same particles and the same
// update of the material, on one thread.
//   build/release/tests/bin/sph_beside_mpm TABLE.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <iostream>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "src/core/parallel/mpi.hpp"
#include "src/io/run_directory.hpp"
#include "src/solver/simulation.hpp"
#include "tests/benchmark/sph.hpp"
#include "tests/page_program.hpp"

namespace whipple::sph {
namespace {

double processor_time() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Counts the pieces of more than one particle: particles nearer than two initial distances belong together.
std::size_t pieces(const std::vector<Vector3>& x, double link) {
  std::vector<std::size_t> parent(x.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  std::vector<std::size_t> order = parent;
  std::ranges::sort(order, {}, [&](std::size_t i) { return x[i].x(); });
  for (std::size_t a = 0; a < order.size(); ++a) {
    for (std::size_t b = a + 1; b < order.size() && x[order[b]].x() - x[order[a]].x() < link; ++b) {
      if ((x[order[a]] - x[order[b]]).squaredNorm() < link * link) parent[root(order[a])] = root(order[b]);
    }
  }
  std::vector<std::size_t> size(x.size(), 0);
  for (std::size_t i = 0; i < x.size(); ++i) ++size[root(i)];
  return static_cast<std::size_t>(std::ranges::count_if(size, [](std::size_t n) { return n > 1; }));
}

/// A quantity of the final particles, m.
struct Measure {
  std::string name;
  std::function<double(const Particles&, double spacing)> of;
};

struct Problem {
  std::string title, file;
  std::vector<std::string> cells;
  std::vector<std::pair<std::string, std::string>> overrides;
  std::vector<Measure> measures;
};

double largest(const Particles& q, auto&& of) {
  double result = 0.0;
  for (std::size_t i = 0; i < q.size(); ++i) result = std::max(result, of(i));
  return result;
}

const std::vector<Measure> bar = {
    {"length (mm)",
     [](const Particles& q, double d) {
       return largest(q, [&](std::size_t i) { return q.position[i].z(); }) + 0.5 * d;
     }},
    {"radius of the foot (mm)", [](const Particles& q, double d) {
       return largest(q,
                      [&](std::size_t i) {
                        return q.position[i].z() < 1.5 * d ? q.position[i].head<2>().norm() : 0.0;
                      }) +
              0.5 * d;
     }}};

/// Place that a share of the mass of a body is beyond along x, m.
double front(const Particles& q, double share) {
  std::vector<std::size_t> order(q.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, std::greater<>(), [&](std::size_t i) { return q.position[i].x(); });
  const double all = std::accumulate(q.mass.begin(), q.mass.end(), 0.0);
  double sum = 0.0;
  for (const std::size_t i : order) {
    sum += q.mass[i];
    if (sum > share * all) return q.position[i].x();
  }
  return 0.0;
}

const std::vector<Measure> impact = {
    {"0.5 % of the mass is beyond (mm)", [](const Particles& q, double) { return front(q, 0.005); }},
    {"radius of the hole (mm)", [](const Particles& q, double) {
       // what is missing of a circle of 30 mm between the planes of the faces of the plate, a square of 80 mm
       constexpr double within = 30e-3, half_edge = 80e-3, thickness = 6.36e-3;
       double all = 0.0, left = 0.0;
       for (std::size_t i = 0; i < q.size(); ++i) {
         if (q.body[i] != 1) continue;
         const Vector3& x = q.position[i];
         all += q.mass[i];
         if (x.x() > 0.0 && x.x() < thickness && x.tail<2>().norm() < within) left += q.mass[i];
       }
       const double area = left / all * half_edge * half_edge;
       return std::sqrt(within * within - 4.0 / std::numbers::pi * area);
     }}};

const std::vector<Problem> problems = {
    {"Taylor bar", "cases/taylor_bar/case.toml", {"2.17 mm", "1.52 mm", "1.09 mm"}, {}, bar},
    {"Lead sphere on lead plate",
     "cases/lead_sphere_on_plate/case.toml",
     {"6 mm", "4.24 mm", "3 mm"},
     {{"splitting.length", "0"}},
     impact}};

struct Row {
  std::size_t steps = 0;
  double seconds = 0.0, energy_error = 0.0;
};

std::string line(const std::string& method, const std::string& cell, const Problem& problem,
                 const Particles& q, std::size_t particles, double spacing, const Row& row) {
  std::string text =
      fmt::format("| {} | {} | {} | {} | {:.0f} | {:.1f} |", cell, method, particles, row.steps,
                  1e9 * row.seconds / static_cast<double>(row.steps * particles), row.seconds);
  for (const Measure& measure : problem.measures)
    text += fmt::format(" {:.2f} |", 1e3 * measure.of(q, spacing));
  return text +
         fmt::format(" {:.0e} | {} |\n", std::abs(row.energy_error), pieces(q.position, 2.0 * spacing));
}

std::string smoothed(const cases::Case& setup, const std::string& cell, const Problem& problem,
                     const Options& options, const std::string& name) {
  Simulation simulation(setup, options);
  const double start = simulation.kinetic_energy() + simulation.internal_energy(), begin = processor_time();
  Row row;
  try {
    for (; simulation.time() < setup.time.end; ++row.steps) simulation.advance(setup.time.end);
  } catch (const StateError& error) {
    return fmt::format("| {} | {} | {} | {} | ended: {} |\n", cell, name, simulation.particles().size(),
                       row.steps, error.what());
  }
  row.seconds = processor_time() - begin;
  row.energy_error = (simulation.kinetic_energy() + simulation.internal_energy() - start) / start;
  const Particles& q = simulation.particles();
  return line(name, cell, problem, q, q.size(), simulation.spacing(), row);
}

std::string material_points(const cases::Case& setup, const std::string& cell, const Problem& problem) {
  solver::Simulation simulation(setup, parallel::world());
  const std::size_t particles = simulation.particle_count();
  const double begin = processor_time();
  Row row;
  for (; simulation.state().time < setup.time.end; ++row.steps) simulation.advance(setup.time.end);
  row.seconds = processor_time() - begin;
  row.energy_error = simulation.state().ledger.energy_error(simulation.totals());
  return line("MPM", cell, problem, simulation.particles(), particles, 0.5 * setup.domain.cell_size, row);
}

std::string table(const Problem& problem) {
  std::string text = fmt::format(
      "\n## {}\n\n| cell | method | particles | steps | ns per particle and step | s |", problem.title);
  for (const Measure& measure : problem.measures) text += fmt::format(" {} |", measure.name);
  text += " error of energy | pieces |\n|";
  for (std::size_t i = 0; i < 8 + problem.measures.size(); ++i) text += " --- |";
  text += "\n";
  for (const std::string& cell : problem.cells) {
    auto overrides = problem.overrides;
    overrides.emplace_back("domain.cell_size", cell);
    const cases::Case setup =
        cases::read_case(std::string(WHIPPLE_SOURCE_DIR) + "/" + problem.file, overrides);
    text += material_points(setup, cell, problem);
    std::cerr << text.substr(text.rfind('\n', text.size() - 2) + 1);
    text += smoothed(setup, cell, problem, {}, "SPH");
    std::cerr << text.substr(text.rfind('\n', text.size() - 2) + 1);
    if (cell != problem.cells[1]) continue;
    text += smoothed(setup, cell, problem, {.artificial_stress = 0.0}, "SPH without artificial stress");
    std::cerr << text.substr(text.rfind('\n', text.size() - 2) + 1);
  }
  return text;
}

void write_table(const std::string& file) {
  std::string text =
      "# SPH beside MPM\n\nWritten by `build/release/tests/bin/sph_beside_mpm`; one thread, processor "
      "time.\n";
  for (const Problem& problem : problems) text += table(problem);
  io::write_text_atomically(file, text);
}

const char* const usage = "usage: sph_beside_mpm FILE.md";

int write(int argc, char** argv) {
  write_table(tests::page_of(argc, argv, 1, usage));
  return 0;
}

}  // namespace
}  // namespace whipple::sph

int main(int argc, char** argv) {
  using namespace whipple::sph;
  return whipple::tests::run_page_program("sph_beside_mpm", usage, write, argc, argv);
}
