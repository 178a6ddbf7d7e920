// SPDX-License-Identifier: BSD-3-Clause
// Cook's membrane of material that keeps its volume, by finite elements (docs/theory/fem.md, section 4; by particles:
// cases/cook_membrane).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <string>

#include "src/fem/mesh.hpp"
#include "tests/folders.hpp"
#include "tests/verification/solver_problems.hpp"

namespace whipple::verification {
namespace {

/// Writes one layer of hexahedra over the panel as a mesh file; returns its path.
std::string write_panel(const TemporaryFolder& folder, int elements) {
  std::string points, cells;
  const int edge = elements + 1, count = elements * elements;
  for (int k = 0; k < 2; ++k) {
    for (int j = 0; j < edge; ++j) {
      for (int i = 0; i < edge; ++i) {
        const double x = static_cast<double>(i) / elements, y = static_cast<double>(j) / elements;
        fmt::format_to(std::back_inserter(points), "{} {} {}\n", 48.0 * x, 44.0 * (x + y) - 28.0 * x * y,
                       48.0 * k / elements);
      }
    }
  }
  for (int j = 0; j < elements; ++j) {
    for (int i = 0; i < elements; ++i) {
      const auto node = [&](int x, int y, int z) { return (z * edge + j + y) * edge + i + x; };
      fmt::format_to(std::back_inserter(cells), "8 {} {} {} {} {} {} {} {}\n", node(0, 0, 0), node(1, 0, 0),
                     node(1, 1, 0), node(0, 1, 0), node(0, 0, 1), node(1, 0, 1), node(1, 1, 1),
                     node(0, 1, 1));
    }
  }
  std::string types;
  for (int e = 0; e < count; ++e) types += "12\n";
  const std::filesystem::path file = folder.path() / "panel.vtk";
  io::write_text_atomically(
      file, fmt::format("# vtk DataFile Version 3.0\npanel\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                        "POINTS {} double\n{}CELLS {} {}\n{}CELL_TYPES {}\n{}",
                        2 * edge * edge, points, count, 9 * count, cells, count, types));
  return file.string();
}

/// Returns the deflection (m) of the upper corner of the membrane at rest.
/// @param elements  along each edge
/// @param options  of the discretization
double deflection(int elements, const std::string& options) {
  const TemporaryFolder folder;
  const double size = 48.0 / elements;
  const cases::Case setup =
      cases::read_case_text(fmt::format(R"(
[domain]
lower = ["-8 m", "-8 m", "{0} m"]
upper = ["64 m", "72 m", "{1} m"]
cell_size = "{2} m"
[time]
end = "80 s"
[artificial_viscosity]
linear = 0
quadratic = 0
[[body]]
name = "membrane"
material = "{3}/cases/cook_membrane/rubber.toml"
discretization = {{ method = "finite_elements", mesh = "{4}", mesh_unit = "1 m", {5} }}
[[body.node_condition]]
lower = ["-0.01 m", "-1 m", "-1 m"]
upper = ["0.01 m", "61 m", "50 m"]
directions = ["x", "y", "z"]
[[body.node_condition]]
lower = ["-1 m", "-1 m", "-1 m"]
upper = ["49 m", "61 m", "50 m"]
directions = ["z"]
[[load]]
body = "membrane"
force = ["0 N", "{2} N", "0 N"]
times = ["0 s", "20 s"]
factors = [0, 1]
box = {{ lower = ["{6} m", "40 m", "-1 m"], upper = ["50 m", "65 m", "50 m"] }}
[[load]]
damping = "0.2 1/s"
)",
                                        -4.0 * size, 8.0 * size, size, whipple::tests::source_folder(),
                                        write_panel(folder, elements), options, 48.0 - 0.5 * size),
                            "membrane.toml");
  solver::Simulation simulation(setup, parallel::world());
  const auto corner = [&]() -> const Vector3& {
    const fem::Nodes& nodes = simulation.meshes()[0].nodes;
    const auto n = std::ranges::max_element(nodes.position, {}, [](const Vector3& x) { return x[0] + x[1]; });
    return *n;
  };
  const double start = corner()[1];
  run_to(simulation, setup.time.end);
  EXPECT_LT(std::abs(simulation.state().ledger.energy_error(simulation.totals())), 1e-12);
  return corner()[1] - start;
}

/// Describes a kind of element with what the membrane shows of it: deflection over the exact one with 2, 4 and 8
/// elements along each edge.
struct Shown {
  const char* options;
  std::array<double, 3> ratio;
};

class Membrane : public testing::TestWithParam<Shown> {};

// 0.2764 +- 0.0003 m: cases/cook_membrane. 4e-4 is what 0.05 is to metals: a part of the bending stiffness, 0.07 E/(rho c^2).
TEST_P(Membrane, OfElementsDoesNotLockByVolume) {
  constexpr double exact = 0.2764;
  for (std::size_t i = 0; i < 3; ++i) {
    const int elements = 2 << i;
    EXPECT_NEAR(deflection(elements, GetParam().options) / exact, GetParam().ratio[i], 0.003) << elements;
  }
}

INSTANTIATE_TEST_SUITE_P(Elements, Membrane,
                         testing::Values(Shown{"element = \"b_bar\"", {0.614, 0.845, 0.944}},
                                         Shown{"hourglass_coefficient = 4e-4", {0.726, 0.894, 0.962}},
                                         Shown{"hourglass = \"viscous\"", {0.995, 1.003, 0.997}},
                                         Shown{"hourglass = \"stiffness\"", {0.278, 0.322, 0.423}}));

}  // namespace
}  // namespace whipple::verification
