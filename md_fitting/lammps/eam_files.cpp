// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/lammps/eam_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <sstream>
#include <string_view>
#include <utility>

#include "md_fitting/lammps/elements.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"

namespace whipple::md {
namespace {

// Hartree and Bohr as rounded by the authors of the funcfl format; LAMMPS converts effective charges with these.
constexpr double funcfl_hartree = 27.2;
constexpr double funcfl_bohr = 0.529;

// No embedded-atom potential has a longer range; a damaged file must not cause an endless lattice sum.
constexpr double longest_cutoff = 25.0;            // A
constexpr double longest_lattice_constant = 15.0;  // A
constexpr double shortest_lattice_constant = 1.5;  // A; a file may give 0 for unknown

/// Returns whether a line is free of braces and non-printable characters: LAMMPS uses words of headers as message
/// formats, in which braces have a meaning, and non-printable characters belong to no number or name.
bool is_plain(std::string_view line) {
  return std::ranges::all_of(line, [](unsigned char c) {
    return c == '\t' || c == '\r' || (c >= 0x20 && c < 0x7f && c != '{' && c != '}');
  });
}

/// Reads lines and words of a potential file, with errors that name file and line.
class Reader {
 public:
  explicit Reader(const std::filesystem::path& path) : path_(path), stream_(read_text(path)) {}
  /// Returns the next line, a comment with arbitrary content.
  std::string line() {
    next_line();
    return std::string(std::exchange(rest_, {}));
  }
  /// Returns the next word of the current line; empty at its end.
  std::string_view word() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(blanks), rest_.size()));
    const std::string_view result = rest_.substr(0, rest_.find_first_of(blanks));
    rest_.remove_prefix(result.size());
    return result;
  }
  /// Returns the words of the next line.
  std::vector<std::string> words() {
    next_line();
    require_plain();
    std::vector<std::string> all;
    for (std::string_view one = word(); !one.empty(); one = word()) all.emplace_back(one);
    return all;
  }
  /// Reads numbers over as many lines as needed; numbers left on the last line remain for the next call.
  std::vector<double> numbers(std::size_t count, const char* what) {
    std::vector<double> values;  // a file may declare more than it contains
    for (; count > 0; --count) {
      std::string_view text = word();
      while (text.empty()) {
        if (!std::getline(stream_, buffer_)) fail(fmt::format("holds too few numbers for {}", what));
        begin_line();
        require_plain();
        text = word();
      }
      if (!read(text, values.emplace_back())) fail(fmt::format("has '{}' for a number of {}", text, what));
    }
    return values;
  }
  /// Reads a finite or whole number without trailing characters.
  template <class Number>
  static bool read(std::string_view text, Number& value) {
    if (text.starts_with('+')) text.remove_prefix(1);
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    return code == std::errc() && end == text.data() + text.size() &&
           std::isfinite(static_cast<double>(value));
  }
  /// Skips the rest of the line.
  void end_line() { rest_ = {}; }
  [[noreturn]] void fail(const std::string& why) const {
    throw InputError(fmt::format("{}:{}: error: the potential file {}", path_.string(), line_, why));
  }

 private:
  static constexpr std::string_view blanks = " \t\r";
  void next_line() {
    if (!std::getline(stream_, buffer_)) fail("ends too early");
    begin_line();
  }
  void require_plain() const {
    if (!is_plain(buffer_)) fail("holds braces or characters that are not printable");
  }
  void begin_line() {
    ++line_;
    rest_ = buffer_;
  }

  std::filesystem::path path_;
  std::istringstream stream_;
  std::string buffer_;
  std::string_view rest_;
  int line_ = 0;
};

/// Holds the sizes of the tables: "nrho drho nr dr cutoff", the same line in all four formats.
struct Grid {
  std::size_t densities = 0;
  double density_step = 0.0;
  std::size_t radii = 0;
  double radius_step = 0.0;
  double cutoff = 0.0;
};

Grid read_grid(Reader& reader) {
  Grid grid;
  const std::vector<std::string> words = reader.words();
  long densities = 0;
  long radii = 0;
  if (words.size() < 5 || !Reader::read(words[0], densities) || !Reader::read(words[1], grid.density_step) ||
      !Reader::read(words[2], radii) || !Reader::read(words[3], grid.radius_step) ||
      !Reader::read(words[4], grid.cutoff) || densities < 4 || radii < 4 || densities > 10'000'000 ||
      radii > 10'000'000 || !(grid.density_step > 0.0) || !(grid.radius_step > 0.0) || !(grid.cutoff > 0.0) ||
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

/// Reads the line "Z mass lattice_constant structure".
int read_element_line(Reader& reader, EamTables& tables) {
  const std::vector<std::string> words = reader.words();
  int atomic_number = 0;
  if (words.size() < 4 || !Reader::read(words[0], atomic_number) || !Reader::read(words[1], tables.mass) ||
      !Reader::read(words[2], tables.header_lattice_constant) ||
      !(tables.mass > 0.0 && tables.mass < 1000.0) ||
      (tables.header_lattice_constant != 0.0 &&
       !(tables.header_lattice_constant > shortest_lattice_constant &&
         tables.header_lattice_constant < longest_lattice_constant))) {
    reader.fail("has no valid line 'atomic number, mass, lattice constant, structure'");
  }
  tables.header_structure = lower_case(words[3]);
  tables.structure = value_of<CrystalStructure>(tables.header_structure).value_or(CrystalStructure::bcc);
  return atomic_number;
}

std::vector<std::string> read_element_names(Reader& reader) {
  for (int comment = 0; comment < 3; ++comment) reader.line();
  std::vector<std::string> names = reader.words();
  std::size_t count = 0;
  if (names.size() < 2 || !Reader::read(names.front(), count) || names.size() != count + 1) {
    reader.fail("has no valid line of elements 'number, symbols'");
  }
  names.erase(names.begin());
  return names;
}

/// Checks atomic number and mass of a header. Headers are written by hand, many with 0 or 1 as the atomic number of
/// all elements; the mass scales every density and energy of the simulation.
void check_header(const Reader& reader, const EamTables& tables, int number, const std::string& element) {
  constexpr double tolerance = 0.02;
  const auto expected = atomic_number(element);
  if (expected && number > 1 && number != *expected) {
    reader.fail(fmt::format("gives {} the atomic number {}, which is that of {}; expected {}", element,
                            number, element_symbol(number), *expected));
  }
  const auto weight = standard_atomic_weight(element);
  if (weight && std::abs(tables.mass / *weight - 1.0) > tolerance) {
    reader.fail(fmt::format("gives {} the mass {} g/mol; the standard atomic weight is {}", element,
                            tables.mass, *weight));
  }
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
  const int number = read_element_line(reader, tables);
  tables.element = element_symbol(number);
  if (tables.element != element) {
    throw InputError(
        fmt::format("the potential file {} is for {}, not for {}", path.string(), tables.element, element));
  }
  check_header(reader, tables, number, element);
  const Grid grid = read_grid(reader);
  take_grid(tables, grid);
  tables.embedding = reader.numbers(grid.densities, "the embedding function");
  tables.radius_times_pair = reader.numbers(grid.radii, "the effective charge");
  for (double& z : tables.radius_times_pair) z = funcfl_hartree * funcfl_bohr * z * z;
  tables.density = reader.numbers(grid.radii, "the density function");
  return tables;
}

/// Reads setfl, whose three variants differ in the number of density functions per element and in the tables after
/// the pair functions.
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
    const int number = read_element_line(reader, other);
    if (i == wanted) check_header(reader, other, number, element);
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
  return format == EamFormat::funcfl ? read_funcfl(path, element) : read_setfl(path, element, format);
}

std::string to_setfl(const EamTables& tables, const std::string& comment) {
  std::string text = fmt::format("{}\nwritten by whipple-md\nUNITS: metal\n1 {}\n", comment, tables.element);
  text += fmt::format("{} {:.17g} {} {:.17g} {:.17g}\n", tables.embedding.size(), tables.density_step,
                      tables.density.size(), tables.radius_step, tables.cutoff);
  // An unknown symbol gets a number beyond the last element; LAMMPS does not use it.
  const int number = atomic_number(tables.element).value_or(104);
  text += fmt::format("{} {:.17g} {:.17g} {}\n", number, tables.mass, tables.header_lattice_constant,
                      word_of(tables.structure));
  for (const auto* table : {&tables.embedding, &tables.density, &tables.radius_times_pair}) {
    for (const double value : *table) text += fmt::format("{:.17g}\n", value);
  }
  return text;
}

}  // namespace whipple::md
