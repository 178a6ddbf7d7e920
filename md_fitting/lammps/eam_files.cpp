// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/lammps/eam_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fstream>
#include <sstream>

#include "md_fitting/lammps/elements.hpp"
#include "src/base/error.hpp"

namespace whipple::md {
namespace {

// Hartree and Bohr as the authors of the funcfl format rounded them; LAMMPS converts effective charges with
// these.
constexpr double funcfl_hartree = 27.2;
constexpr double funcfl_bohr = 0.529;

// No embedded-atom potential reaches further; a damaged file must not make a lattice sum endless.
constexpr double longest_cutoff = 25.0;            // A
constexpr double longest_lattice_constant = 15.0;  // A
constexpr double shortest_lattice_constant = 1.5;  // A; a file may give 0 for unknown

/// Words of a potential file with an error that names the file and what was expected.
class Reader {
 public:
  explicit Reader(const std::filesystem::path& path) : path_(path), stream_(path) {
    if (!stream_) throw InputError(fmt::format("cannot read the potential file {}", path.string()));
  }
  std::string line() {
    std::string text;
    if (!std::getline(stream_, text)) fail("ends too early");
    return text;
  }
  /// The next line as a stream of words.
  std::istringstream words() { return std::istringstream(line()); }
  std::vector<double> numbers(std::size_t count, const char* what) {
    std::vector<double> values(count);
    for (double& value : values) {
      if (!(stream_ >> value) || !std::isfinite(value))
        fail(fmt::format("holds too few numbers for {}", what));
    }
    return values;
  }
  /// Goes to the beginning of the next line.
  void end_line() {
    std::string rest;
    std::getline(stream_, rest);
  }
  [[noreturn]] void fail(const std::string& why) const {
    throw InputError(fmt::format("the potential file {} {}", path_.string(), why));
  }

 private:
  std::filesystem::path path_;
  std::ifstream stream_;
};

/// Sizes of the tables: "nrho drho nr dr cutoff", the same line in all four formats.
struct Grid {
  std::size_t densities = 0;
  double density_step = 0.0;
  std::size_t radii = 0;
  double radius_step = 0.0;
  double cutoff = 0.0;
};

Grid read_grid(Reader& reader) {
  Grid grid;
  auto words = reader.words();
  long densities = 0;
  long radii = 0;
  if (!(words >> densities >> grid.density_step >> radii >> grid.radius_step >> grid.cutoff) ||
      densities < 4 || radii < 4 || densities > 10'000'000 || radii > 10'000'000 ||
      !(grid.density_step > 0.0) || !(grid.radius_step > 0.0) || !(grid.cutoff > 0.0) ||
      !(grid.cutoff <= longest_cutoff)) {
    reader.fail("has no valid line of table sizes 'nrho drho nr dr cutoff'");
  }
  grid.densities = static_cast<std::size_t>(densities);
  grid.radii = static_cast<std::size_t>(radii);
  return grid;
}

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

/// "Z mass lattice_constant structure"
int read_element_line(Reader& reader, EamTables& tables) {
  auto words = reader.words();
  int atomic_number = 0;
  std::string structure;
  if (!(words >> atomic_number >> tables.mass >> tables.header_lattice_constant >> structure) ||
      !(tables.mass > 0.0 && tables.mass < 1000.0) ||
      (tables.header_lattice_constant != 0.0 &&
       !(tables.header_lattice_constant > shortest_lattice_constant &&
         tables.header_lattice_constant < longest_lattice_constant))) {
    reader.fail("has no valid line 'atomic number, mass, lattice constant, structure'");
  }
  tables.structure = lower_case(structure);
  return atomic_number;
}

std::vector<std::string> read_element_names(Reader& reader) {
  for (int comment = 0; comment < 3; ++comment) reader.line();
  auto words = reader.words();
  std::size_t count = 0;
  words >> count;
  std::vector<std::string> names;
  for (std::string name; words >> name;) names.push_back(name);
  if (names.empty() || names.size() != count) reader.fail("has no valid line of elements");
  return names;
}

void take_grid(EamTables& tables, const Grid& grid) {
  tables.density_step = grid.density_step;
  tables.radius_step = grid.radius_step;
  tables.cutoff = grid.cutoff;
}

EamTables read_funcfl(const std::filesystem::path& path, const std::string& element) {
  Reader reader(path);
  reader.line();
  EamTables tables;
  tables.element = element_symbol(read_element_line(reader, tables));
  if (tables.element != element) {
    throw InputError(
        fmt::format("the potential file {} is for {}, not for {}", path.string(), tables.element, element));
  }
  const Grid grid = read_grid(reader);
  take_grid(tables, grid);
  tables.embedding = reader.numbers(grid.densities, "the embedding function");
  tables.radius_times_pair = reader.numbers(grid.radii, "the effective charge");
  for (double& z : tables.radius_times_pair) z = funcfl_hartree * funcfl_bohr * z * z;
  tables.density = reader.numbers(grid.radii, "the density function");
  return tables;
}

/// The three kinds of setfl differ in the number of density functions per element and in what follows the
/// pairs.
EamTables read_setfl(const std::filesystem::path& path, const std::string& element, EamFormat format) {
  Reader reader(path);
  const std::vector<std::string> names = read_element_names(reader);
  const auto found = std::find(names.begin(), names.end(), element);
  if (found == names.end()) {
    throw InputError(fmt::format("the potential file {} has no element {}; it has {}", path.string(), element,
                                 fmt::join(names, ", ")));
  }
  const auto wanted = static_cast<std::size_t>(found - names.begin());
  const Grid grid = read_grid(reader);
  EamTables tables;
  for (std::size_t i = 0; i < names.size(); ++i) {
    EamTables other;
    read_element_line(reader, other);
    other.embedding = reader.numbers(grid.densities, "an embedding function");
    const std::size_t functions = format == EamFormat::finnis_sinclair ? names.size() : 1;
    for (std::size_t j = 0; j < functions; ++j) {
      std::vector<double> density = reader.numbers(grid.radii, "a density function");
      if (functions == 1 || j == i) other.density = std::move(density);
    }
    reader.end_line();
    if (i == wanted) tables = std::move(other);
  }
  tables.element = element;
  take_grid(tables, grid);
  const auto read_pairs = [&](const char* what) {
    std::vector<double> own;
    for (std::size_t i = 0; i < names.size(); ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        std::vector<double> pair = reader.numbers(grid.radii, what);
        if (i == wanted && j == wanted) own = std::move(pair);
      }
    }
    return own;
  };
  tables.radius_times_pair = read_pairs("a pair function");
  if (format == EamFormat::angular_dependent) {
    for (const char* what : {"a dipole function", "a quadrupole function"}) {
      const std::vector<double> angular = read_pairs(what);
      if (std::any_of(angular.begin(), angular.end(), [](double value) { return value != 0.0; })) {
        throw InputError(
            fmt::format("in the potential file {} {} of {} is not zero: it is no embedded-atom potential",
                        path.string(), what, element));
      }
    }
  }
  return tables;
}

}  // namespace

EamFormat eam_format(const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  if (name.ends_with(".eam")) return EamFormat::funcfl;
  if (name.ends_with(".eam.alloy")) return EamFormat::setfl;
  if (name.ends_with(".eam.fs")) return EamFormat::finnis_sinclair;
  if (name.ends_with(".adp")) return EamFormat::angular_dependent;
  throw InputError(
      fmt::format("the potential file {} has an unknown ending; known are .eam, .eam.alloy, .eam.fs "
                  "and .adp",
                  path.string()));
}

std::vector<std::string> elements_in(const std::filesystem::path& path) {
  Reader reader(path);
  if (eam_format(path) != EamFormat::funcfl) return read_element_names(reader);
  reader.line();
  EamTables tables;
  return {element_symbol(read_element_line(reader, tables))};
}

EamTables read_eam(const std::filesystem::path& path, const std::string& element) {
  const EamFormat format = eam_format(path);
  EamTables tables =
      format == EamFormat::funcfl ? read_funcfl(path, element) : read_setfl(path, element, format);
  if (tables.structure != "fcc" && tables.structure != "bcc") {
    throw InputError(
        fmt::format("the potential file {} gives {} the structure '{}'; fcc and bcc are supported",
                    path.string(), element, tables.structure));
  }
  return tables;
}

std::string to_setfl(const EamTables& tables, const std::string& comment) {
  std::string text = fmt::format("{}\nwritten by whipple-md\nUNITS: metal\n1 {}\n", comment, tables.element);
  text += fmt::format("{} {:.17g} {} {:.17g} {:.17g}\n", tables.embedding.size(), tables.density_step,
                      tables.density.size(), tables.radius_step, tables.cutoff);
  // An unknown symbol has the number after the last: LAMMPS does not use it.
  const int number = atomic_number(tables.element).value_or(104);
  text += fmt::format("{} {:.17g} {:.17g} {}\n", number, tables.mass, tables.header_lattice_constant,
                      tables.structure);
  for (const auto* table : {&tables.embedding, &tables.density, &tables.radius_times_pair}) {
    for (const double value : *table) text += fmt::format("{:.17g}\n", value);
  }
  return text;
}

}  // namespace whipple::md
