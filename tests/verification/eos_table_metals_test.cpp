// SPDX-License-Identifier: BSD-3-Clause
// Tables of the library's metals have the requested error in T and p, whatever the form of melting: outside
// of the closed form of GRAY's melting band, which contradicts itself (docs/theory/gray.md, section 3), and
// in every phase with equilibrium melting. The construction tests its resolution at points, so a few states
// in a million may lie beyond: where the heat capacity of the thin vapour vanishes, and in the sliver between
// an edge of melting and its fitted curve.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "eos/table/builder.hpp"
#include "src/material/material_file.hpp"

namespace whipple::eos {
namespace {

constexpr std::size_t states = 200000;

void expect_requested_error(const EquationOfState& eos, const std::string& name, const std::string& without) {
  const Table table(tabulate(eos, {}));
  std::size_t beyond = 0;
  for (const auto& [phase, error] : verify(table, eos, states)) {
    if (phase != without) beyond += error.beyond;
  }
  EXPECT_LE(beyond, states / 40000) << name;
  EXPECT_LT(table.data().size(), 2500000) << name;
}

class EosTableMetals : public testing::TestWithParam<const char*> {};

TEST_P(EosTableMetals, OutsideOfTheMeltingBand) {
  const Material metal = read_material(GetParam());
  expect_requested_error(*metal.eos, GetParam(), "melting");
}

TEST_P(EosTableMetals, InAllPhasesWithEquilibriumMelting) {
  std::ifstream library(find_material(GetParam()));
  std::string text(std::istreambuf_iterator<char>(library), {});
  const std::string model = "model = \"gray\"\n";
  text.insert(text.find(model) + model.size(), "melting = \"equilibrium\"\n");
  const std::string file = testing::TempDir() + GetParam() + "_equilibrium.toml";
  std::ofstream(file) << text;
  expect_requested_error(*read_material(file).eos, GetParam(), "");
}

INSTANTIATE_TEST_SUITE_P(Library, EosTableMetals, testing::Values("aluminium", "tantalum", "nickel"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace whipple::eos
