// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/import_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "src/case/case.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/log.hpp"
#include "src/core/base/option_quantity.hpp"
#include "src/core/base/text.hpp"
#include "src/decks/import.hpp"

namespace whipple::app {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::string deck, folder, format, units, cell_size, triaxiality;
  bool allow_missing = false, case_only = false, same_method = false, old_mass = false;
};

/// Returns the choice that the text of an option names.
template <class Choice>
Choice word(const char* option, const std::string& text) {
  if (const std::optional<Choice> choice = value_of<Choice>(text)) return *choice;
  const std::vector<std::string> known = word_list<Choice>();
  throw InputError(fmt::format("{} is \"{}\"{}; known: {}", option, text, did_you_mean(text, known),
                               fmt::join(known, ", ")));
}

decks::ImportOptions import_options(const Arguments& arguments) {
  decks::ImportOptions options{.same_method = arguments.same_method, .old_mass = arguments.old_mass};
  if (!arguments.format.empty()) options.format = word<decks::Format>("--format", arguments.format);
  if (!arguments.triaxiality.empty())
    options.triaxiality = word<decks::Triaxiality>("--triaxiality", arguments.triaxiality);
  if (!arguments.units.empty()) {
    options.units = decks::parse_unit_system(arguments.units);
    if (!options.units) {
      throw InputError(
          fmt::format("--units is \"{}\", expected units of length, mass and time, as in --units 'mm g ms'",
                      arguments.units));
    }
  }
  if (!arguments.cell_size.empty()) {
    options.cell_size = option_quantity("--cell-size", arguments.cell_size, "m", range::positive());
  }
  return options;
}

void require_complete(const fs::path& deck, const decks::Import& import) {
  std::vector<InputFault> faults;
  for (const decks::Remark& remark : import.remarks) {
    if (remark.outcome == decks::Outcome::missing) {
      faults.push_back({.file = remark.place.file.empty() ? deck.string() : remark.place.file,
                        .line = remark.place.line,
                        .column = 1,
                        .text = fmt::format("missing: {}: {}", remark.keyword, remark.text)});
    }
  }
  if (faults.empty()) return;
  faults.back().text += "\n--allow-missing writes the case without that";
  throw InputError(std::move(faults));
}

/// Reads the case as `whipple run` will; errors name the final location of the files instead of the temporary one.
void require_readable(const decks::CaseFolder& written, const fs::path& folder) {
  try {
    static_cast<void>(cases::read_case(written.case_file(), {}));
  } catch (const InputError& error) {
    std::vector<InputFault> faults = error.faults();
    const std::string partial = written.case_file().parent_path().string();
    for (InputFault& fault : faults) {
      for (std::string* text : {&fault.file, &fault.text}) {
        for (std::size_t at = text->find(partial); at != std::string::npos;
             at = text->find(partial, at + 1)) {
          text->replace(at, partial.size(), folder.string());
        }
      }
    }
    faults.back().text += "\nthe deck makes no valid case: nothing was written";
    throw InputError(std::move(faults));
  }
}

void import_case(const Arguments& arguments) {
  const decks::Import import = decks::import_deck(arguments.deck, import_options(arguments));
  fmt::print("{}", import.report());
  for (const decks::Remark& remark : import.remarks) {
    if (remark.doubtful)
      log::warning("{}:{}: {}: {}", remark.place.file.empty() ? arguments.deck : remark.place.file,
                   remark.place.line, remark.keyword, remark.text);
  }
  if (!arguments.allow_missing) require_complete(arguments.deck, import);
  if (arguments.case_only) {
    decks::write_case_only(import, arguments.folder);
  } else {
    decks::CaseFolder folder(import, arguments.folder);
    require_readable(folder, arguments.folder);
    folder.publish();
  }
  log::info("wrote {}", (fs::path(arguments.folder) / "case.toml").string());
}

}  // namespace

void add_import_command(CLI::App& app) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("import", "Turn the input deck of another code into a case with its materials");
  command->add_option("deck", arguments->deck, "The deck (MPM3D-F90: NAME.mpm, LS-DYNA: NAME.k)")->required();
  command->add_option("-o,--output", arguments->folder, "Folder of the case, which must not exist")
      ->required();
  command->add_option("--format", arguments->format,
                      "mpm3d_f90 or ls_dyna (default: by the content of the deck)");
  command->add_option("--units", arguments->units,
                      "Units of length, mass and time of the deck, as in 'mm g ms'");
  command->add_option("--cell-size", arguments->cell_size,
                      "Edge of the cells of the grid, for decks without one (LS-DYNA)");
  command->add_option(
      "--triaxiality", arguments->triaxiality,
      "What the stress triaxiality of *MAT_JOHNSON_COOK counts positive: tension (D3 < 0 as by "
      "Johnson and Cook), pressure (D3 > 0), or inferred: what makes tension break earlier");
  command->add_flag("--allow-missing", arguments->allow_missing,
                    "Write the case though physics of the deck is missing in it");
  command->add_flag("--case-only", arguments->case_only,
                    "Write case.toml alone, into a folder with the materials of an earlier import");
  command->add_flag("--same-method", arguments->same_method,
                    "Keep scheme, shape functions and time step factor of the deck");
  command->add_flag("--old-mass", arguments->old_mass,
                    "MPM3D-F90 before 2013-12: take the density of particles for their mass");
  command->footer(
      "Every statement of the deck is listed as exact, converted, dropped or missing; the list is kept in "
      "import.txt.\n"
      "Example:\n  whipple import deck.mpm -o cases/deck --units 'mm g ms'");
  command->callback([arguments] { import_case(*arguments); });
}

}  // namespace whipple::app
