// SPDX-License-Identifier: BSD-3-Clause
// Whatever stands in a case or a material: it is read or refused with an InputError, and what is read runs or ends
// with a StateError. Nothing else: no crash, no hang, no other exception (tests/fuzz/trials.hpp).
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "src/case/build/placement.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/log.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/io/run_directory.hpp"
#include "src/material/material_file.hpp"
#include "src/solver/simulation.hpp"
#include "tests/folders.hpp"
#include "tests/fuzz/trials.hpp"
#include "tests/unit/folder_test.hpp"

namespace whipple {
namespace {

namespace fs = std::filesystem;

/// Words of the case files, and what numbers, units and names are mistaken for.
const std::vector<std::string> words = {"0",
                                        "-1",
                                        "1e-300",
                                        "1e300",
                                        "nan",
                                        "inf",
                                        "7",
                                        "\"0 m\"",
                                        "\"1e-9 mm\"",
                                        "\"-3 km/s\"",
                                        "\"1 parsec\"",
                                        "\"5 K\"",
                                        "\"1e30 m/s\"",
                                        "true",
                                        "[]",
                                        "[1, 2, 3]",
                                        "{}",
                                        "\"symmetry\"",
                                        "\"outflow\"",
                                        "\"no_slip\"",
                                        "\"separating\"",
                                        "\"linear\"",
                                        "\"gimp\"",
                                        "\"musl\"",
                                        "\"usf\"",
                                        "\"usl\"",
                                        "\"apic\"",
                                        "\"fmpm\"",
                                        "\"copper.toml\"",
                                        "\"lead_mie_gruneisen.toml\"",
                                        "\"no_such.toml\"",
                                        "\"../..\"",
                                        "\"\"",
                                        "\"table\"",
                                        "\"cubic_bspline\"",
                                        "\"flip\"",
                                        "\"convected_gimp\""};

class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : random_(seed) {}

  /// One to three changes, most of them to a value, a key or a line: files that are almost right.
  std::string operator()(const std::string& text) {
    std::vector<std::string> lines = split(text);
    for (std::size_t i = 0, n = 1 + below(2); i < n; ++i) change(lines);
    std::string result;
    for (const std::string& line : lines) result += line + "\n";
    return result;
  }

 private:
  std::size_t below(std::size_t end) {
    return std::uniform_int_distribution<std::size_t>(0, end - 1)(random_);
  }
  static std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> lines(1);
    for (const char c : text) {
      if (c == '\n') {
        lines.emplace_back();
      } else {
        lines.back() += c;
      }
    }
    return lines;
  }
  void change(std::vector<std::string>& lines) {
    const std::size_t at = below(lines.size());
    std::string& line = lines[at];
    const std::size_t equals = line.find('=');
    switch (below(10)) {
      case 0:
        lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(at));
        if (lines.empty()) lines.emplace_back();
        return;
      case 1:
        lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(below(lines.size())), line);
        return;
      case 2:
        if (!line.empty()) line.erase(below(line.size()), 1 + below(3));
        return;
      case 3:
        if (!line.empty()) line[below(line.size())] = static_cast<char>(below(256));
        return;
      case 4:
      case 6:
      case 7:  // digits
        for (char& c : line) {
          if (c >= '0' && c <= '9' && below(3) == 0) c = static_cast<char>('0' + below(10));
        }
        return;
      case 5:
        std::swap(line, lines[below(lines.size())]);
        return;
      default:
        if (equals != std::string::npos) line = line.substr(0, equals + 1) + " " + words[below(words.size())];
    }
  }

  std::mt19937_64 random_;
};

std::vector<fs::path> case_files() {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry :
       fs::directory_iterator(whipple::tests::source_folder() + "/cases")) {
    if (fs::exists(entry.path() / "case.toml")) files.push_back(entry.path() / "case.toml");
  }
  std::ranges::sort(files);  // directories are listed in any order
  return files;
}

TEST(CaseFuzz, IsReadOrRefusedAndRunsOrEndsWithAStateError) {
  log::set_level(log::Level::quiet);
  parallel::world();
  const std::vector<fs::path> files = case_files();
  ASSERT_GE(files.size(), 10U);
  constexpr double small = 500.0 * 20000;  // bytes: runs that end soon
  int run = 0;
  const fuzz::Outcomes outcomes = fuzz::try_inputs("case", 120, [&](fuzz::Random& random) {
    const fs::path& file = files[fuzz::any(random, files.size())];  // materials are looked up beside it
    const cases::Case setup = cases::read_case_text(Mutator(random())(read_text(file)), file.string());
    if (cases::expected_memory(setup) >= small) return;
    solver::Simulation simulation(setup, parallel::world());
    for (int step = 0; step < 2 && simulation.state().time < setup.time.end; ++step) {
      simulation.advance(setup.time.end);
    }
    ++run;
  });
  std::printf("%d of the cases ran\n", run);
  EXPECT_TRUE(outcomes.are_mixed(0.1, 0.1));
}

class MaterialFuzz : public FolderTest {};

// What a material file holds is refused, is judged unusable, or has states near its reference.
TEST_F(MaterialFuzz, IsReadOrRefusedAndHasStates) {
  log::set_level(log::Level::quiet);
  std::vector<fs::path> files;
  for (const LibraryMaterial& material : library_materials()) files.push_back(material.file);
  ASSERT_GE(files.size(), 50U);
  const fs::path file = folder_ / "material.toml";
  fuzz::try_inputs("material", 100, [&](fuzz::Random& random) {
    const fs::path& from = files[fuzz::any(random, files.size())];
    std::ofstream(file, std::ios::binary) << Mutator(random())(read_text(from));
    const Material material = read_material(file, from.parent_path());
    require_usable(material);
    const eos::EquationOfState& eos = *material.eos;
    for (const double compression : {0.9, 1.0, 1.2}) {
      static_cast<void>(eos.state(compression * eos.reference_density(), eos.reference_energy() + 1e5));
    }
  });
}

}  // namespace
}  // namespace whipple
