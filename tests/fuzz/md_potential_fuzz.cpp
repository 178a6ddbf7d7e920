// SPDX-License-Identifier: BSD-3-Clause
// Damaged potential files, plans and stores: either they load, or an InputError says why not. Nothing crashes, nothing
// hangs, nothing is taken for a number that is none (tests/fuzz/trials.hpp).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "md_fitting/data_set/data_set.hpp"
#include "md_fitting/lammps/eam_files.hpp"
#include "md_fitting/lammps/potential.hpp"
#include "md_fitting/plan/plan.hpp"
#include "src/core/base/error.hpp"
#include "tests/folders.hpp"
#include "tests/fuzz/trials.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace whipple::md {
namespace {

std::string contents(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// A small, valid setfl file: Morse-like functions on coarse tables.
std::string small_setfl() {
  EamTables tables;
  tables.element = "Cu";
  tables.mass = 63.55;
  tables.header_lattice_constant = 3.6;
  tables.structure = CrystalStructure::fcc;
  tables.density_step = 1.0;
  tables.radius_step = 0.1;
  tables.cutoff = 5.0;
  for (int i = 0; i < 40; ++i) tables.embedding.push_back(-std::sqrt(i * tables.density_step));
  for (int i = 0; i < 51; ++i) {
    const double r = i * tables.radius_step;
    tables.density.push_back(std::exp(-2.0 * (r - 2.5)) * (1 - r / 5.0));
    tables.radius_times_pair.push_back(r * 0.5 * std::exp(-5.0 * (r - 2.5)) * (1 - r / 5.0));
  }
  return to_setfl(tables, "a small file");
}

std::string misspelt(std::string text, fuzz::Random& random) {
  const auto any = [&](std::size_t below) { return fuzz::any(random, below); };
  static const std::string bytes = "0123456789.-+eE \n\t\0x/nanif";
  for (std::size_t n = 1 + any(4); n > 0; --n) {
    const std::size_t header =
        std::min<std::size_t>(text.size(), 160);  // half of the damage goes where it matters most
    const std::size_t at = any(2) == 0 ? any(header) : any(text.size());
    switch (any(4)) {
      case 0:
        text[at] = bytes[any(bytes.size())];
        break;
      case 1:
        text.insert(at, 1, bytes[any(bytes.size())]);
        break;
      case 2:
        text.erase(at, 1 + any(20));
        break;
      default:
        text.resize(std::max<std::size_t>(at, 10));
        break;
    }
    if (text.size() < 12) break;
  }
  return text;
}

TEST(PotentialFuzz, LoadsOrExplains) {
  const TemporaryFolder folder;
  const std::string whole = small_setfl(), name = "fuzz.eam.alloy";
  const auto load = [&](const std::string& text) {
    std::ofstream(folder.path() / name, std::ios::binary) << text;
    const Potential potential = Potential::load(name, "Cu", folder.path());
    EXPECT_TRUE(std::isfinite(potential.static_volume()));
    EXPECT_GT(potential.static_volume(), 0.0);
    EXPECT_GE(potential.least_volume_ratio(), potential.table_end());
  };
  load(whole);
  const fuzz::Outcomes outcomes =
      fuzz::try_inputs("potential", 400, [&](fuzz::Random& random) { load(misspelt(whole, random)); });
  EXPECT_TRUE(outcomes.are_mixed(0.05, 0.25));
}

TEST(PlanFuzz, IsReadOrRefused) {
  std::vector<std::string> plans;
  for (const auto& entry :
       std::filesystem::directory_iterator(whipple::tests::source_folder() + "/cases/md")) {
    if (entry.path().extension() == ".toml") plans.push_back(contents(entry.path()));
  }
  std::ranges::sort(plans);  // folders are listed in any order
  ASSERT_GE(plans.size(), 10U);
  const fuzz::Outcomes outcomes = fuzz::try_inputs("plan", 200, [&](fuzz::Random& random) {
    const std::string text = fuzz::garbled(plans[fuzz::any(random, plans.size())], random);
    input::Document document = input::Document::from_text(text, "plan.toml");
    const Plan plan = read_plan(document);
    EXPECT_NO_THROW({
      input::Document again = input::Document::from_text(plan_text(plan), "again.toml");
      static_cast<void>(read_plan(again));
    }) << plan_text(plan);
  });
  EXPECT_TRUE(outcomes.are_mixed(0.05, 0.25));
}

TEST(StoreFuzz, DamagedStoresAreReadOrRefused) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "points.md.h5";
  PointRecord point;
  point.key = std::string(64, 'a');
  point.protocol = "lattice";
  point.status = PointStatus::done;
  point.results = {{"lattice_constant", {3.615e-10, 0.0}}};
  append_point(path, point);
  const std::string whole = contents(path);
  fuzz::try_inputs("store of points", 100, [&](fuzz::Random& random) {
    std::ofstream(path, std::ios::binary) << fuzz::damaged(whole, random);
    static_cast<void>(read_store(path));
  });
}

TEST(StoreFuzz, TruncatedStoresAreRefused) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "points.md.h5";
  PointRecord point;
  point.key = std::string(64, 'a');
  point.protocol = "lattice";
  point.status = PointStatus::done;
  point.results = {{"lattice_constant", {3.615e-10, 0.0}}};
  append_point(path, point);
  const auto size = std::filesystem::file_size(path);
  for (std::uintmax_t cut = 0; cut < size; cut += 1 + size / 60) {
    const auto copy = folder.path() / "cut.md.h5";
    std::filesystem::copy_file(path, copy, std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(copy, cut);
    EXPECT_THROW(read_store(copy), InputError) << "cut to " << cut << " of " << size << " bytes";
    EXPECT_THROW(require_writable(copy), InputError);
  }
}

}  // namespace
}  // namespace whipple::md
