// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/lammps/pair_style.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <sstream>
#include <string_view>

#include "md_fitting/lammps/lammps.hpp"
#include "md_fitting/lammps/potential.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/hash.hpp"
#include "src/core/base/text.hpp"

namespace whipple::md {
namespace {

/// Styles whose tables the program reads and checks itself.
constexpr std::array<std::string_view, 3> read_styles = {"eam", "eam/alloy", "eam/fs"};

/// Styles whose coefficients are numbers and tables. Others are rejected: some execute code in files (python,
/// mliap), load shared objects (kim: such models are specified by `potential`), or do not represent atoms.
// clang-format off
constexpr auto data_styles = std::to_array<std::string_view>(
    {"adp", "agni", "airebo", "airebo/morse", "atm", "beck", "bop", "born", "buck", "comb", "comb3",
     "dispersion/d3", "edip", "edip/multi", "eim", "extep", "gauss", "gw", "gw/zbl", "harmonic/cut",
     "hybrid", "hybrid/overlay", "hybrid/scaled", "lcbop", "lj/cubic", "lj/cut", "lj/expand", "lj/mdf",
     "lj/smooth", "lj/smooth/linear", "lj96/cut", "lebedeva/z", "local/density", "meam", "meam/c",
     "meam/spline", "meam/sw/spline", "mie/cut", "momb", "morse", "morse/smooth/linear", "nb3b/harmonic",
     "nm/cut", "pace", "polymorphic", "rebo", "snap", "soft", "sw", "sw/mod", "table", "tersoff",
     "tersoff/mod", "tersoff/mod/c", "tersoff/table", "tersoff/zbl", "threebody/table", "ufm", "vashishta",
     "vashishta/table", "yukawa", "zbl", "zero"});
// clang-format on

/// Returns a style without the ending that chooses an accelerated version of it.
std::string_view without_accelerator(std::string_view style) {
  for (const std::string_view ending : {"/omp", "/opt", "/intel", "/gpu", "/kk"}) {
    if (style.ends_with(ending)) return style.substr(0, style.size() - ending.size());
  }
  return style;
}

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream stream(line);
  return {std::istream_iterator<std::string>(stream), {}};
}

/// Checks a text for characters that LAMMPS would interpret as variables, comments or the end of a command.
void require_plain(const std::string& text) {
  const bool plain = std::ranges::all_of(text, [](unsigned char c) {
    return c >= 0x20 && c < 0x7f &&
           std::string_view("{}$&#\"';").find(static_cast<char>(c)) == std::string_view::npos;
  });
  if (!plain) {
    throw InputError(fmt::format(
        "'{}' of a pair style holds characters other than letters, digits and - + . _ / * :", text));
  }
}

/// Returns whether a word has an extension that does not begin with a digit, unlike any number.
bool looks_like_file(const std::string& word) {
  const std::size_t dot = word.rfind('.');
  return dot != std::string::npos && dot + 1 < word.size() &&
         std::isdigit(static_cast<unsigned char>(word[dot + 1])) == 0;
}

/// Returns the path of a file as LAMMPS reads it between quotation marks.
std::string readable_path(const std::filesystem::path& path) {
  const std::string text = path.string();
  const bool readable =
      std::ranges::all_of(text, [](unsigned char c) { return c >= 0x20 && c < 0x7f && c != '"'; });
  if (readable) return text;
  throw InputError(fmt::format(
      "{}: LAMMPS reads no paths with quotation marks or letters beyond ASCII: move the file", text));
}

/// Rejects styles that are more than data, including parts of a hybrid style.
/// @param words  of the command pair_style
void require_data(const std::vector<std::string>& words, const Lammps& lammps) {
  for (const std::string& word : words) {
    const std::string_view style = without_accelerator(word);
    const bool known = std::ranges::find(data_styles, style) != data_styles.end() ||
                       std::ranges::find(read_styles, style) != read_styles.end();
    if (known || !lammps.has_style("pair", word)) continue;
    throw InputError(
        fmt::format("the pair style '{}' is refused: it may run code or load more than tables; accepted "
                    "here: {}, and in hybrid "
                    "styles {}",
                    word, fmt::join(data_styles, ", "), fmt::join(read_styles, ", ")));
  }
}

void require_style(const std::vector<std::string>& words) {
  const std::string& style = words.front();
  if (std::ranges::find(read_styles, style) != read_styles.end()) {
    throw InputError(
        fmt::format("pair_style \"{}\": the program reads tables of this style itself, with more checks; "
                    "give the file as "
                    "`potential` and no pair_style",
                    style));
  }
  const Lammps lammps;
  if (lammps.has_style("pair", style)) return require_data(words, lammps);
  std::vector<std::string> there;
  for (const std::string_view of_data : data_styles) {
    if (lammps.has_style("pair", std::string(of_data))) there.emplace_back(of_data);
  }
  throw InputError(fmt::format("LAMMPS was built without the pair style '{}'{}; it has: {}", style,
                               did_you_mean(style, there), fmt::join(there, ", ")));
}

}  // namespace

PairInteractions pair_interactions(const PairStyle& pair, const std::string& name,
                                   const std::filesystem::path& folder) {
  require_plain(pair.style);
  const std::vector<std::string> style = words_of(pair.style);
  if (style.empty()) throw InputError("pair_style has no word");
  require_style(style);
  PairInteractions result;
  result.interactions.name = fmt::format("the pair style {} ({})", style.front(), name);
  result.interactions.before_box = {{"units metal", "units metal"}};
  const std::string command = "pair_style " + pair.style;
  result.interactions.in_box.push_back({command, command});
  std::string content = command + "\n";
  for (const std::string& line : pair.coefficients) {
    require_plain(line);
    std::string full = "pair_coeff", shown = full;  // without folders
    for (const std::string& word : words_of(line)) {
      std::filesystem::path path;
      for (const std::filesystem::path& place : {folder / word, potential_folder() / word}) {
        if (path.empty() && std::filesystem::is_regular_file(place)) path = place;
      }
      if (path.empty() && looks_like_file(word)) {
        throw InputError(
            fmt::format("pair_coeff \"{}\": there is no file '{}' in the folder of the plan or in {}", line,
                        word, potential_folder().string()));
      }
      if (!path.empty()) {
        content += sha256_of_file(path) + "\n";
      }
      full += path.empty() ? " " + word : fmt::format(" \"{}\"", readable_path(path));
      shown += " " + (path.empty() ? word : path.filename().string());
    }
    result.interactions.in_box.push_back({full, shown});
    content += shown + "\n";
  }
  result.hash = sha256(content);
  return result;
}

}  // namespace whipple::md
