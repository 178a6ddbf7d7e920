// SPDX-License-Identifier: BSD-3-Clause
#include "src/decks/import.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <system_error>
#include <utility>

#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/decks/deck_text.hpp"
#include "src/decks/dyna_case.hpp"
#include "src/decks/dyna_deck.hpp"
#include "src/decks/mpm3d_case.hpp"
#include "src/decks/mpm3d_deck.hpp"

namespace whipple::decks {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& deck, std::string why) {
  throw InputError(
      std::vector<InputFault>{{.file = deck.string(), .line = 1, .column = 1, .text = std::move(why)}});
}

/// Identifies the code by the contents of its deck: several codes use the same file extensions.
Format format_of(const fs::path& deck, std::string_view text) {
  if (mpm3d::recognise(text)) return Format::mpm3d_f90;
  if (dyna::recognise(text)) return Format::ls_dyna;
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  const std::string_view start = text.substr(std::min(begin, text.size()));
  if (start.empty()) refuse(deck, "the deck is empty");
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    refuse(deck, "a text in UTF-16: save it as UTF-8");
  if (start.starts_with("#RADIOSS")) refuse(deck, "a deck of OpenRadioss: not read");
  if (start.front() == '<') refuse(deck, "an XML file: decks of the C++ version of MPM3D are not read");
  if (start.front() == '*' || start.front() == '$') {
    refuse(deck, "a keyword deck, but not of LS-DYNA: those of Abaqus are not read");
  }
  if (text.find("#ISINP") != std::string_view::npos || text.find("#ISMAT") != std::string_view::npos)
    refuse(deck, "an input of iSALE, which is not read");
  const auto has = [&](std::string_view command) { return text.find(command) != std::string_view::npos; };
  if (start.front() == '#' || has("region(") || has("solid(")) {
    refuse(
        deck,
        "an input of Karamelo or another language of commands, not of MPM3D-F90, which uses the ending .mpm, "
        "too: variables and formulas are not read");
  }
  refuse(deck, "a deck of no code that is known here; read are decks of MPM3D-F90 and LS-DYNA");
}

}  // namespace

void require_no_deck(const fs::path& file) {
  if (file.extension() == ".toml" || !fs::is_regular_file(file)) return;
  std::string start(std::size_t{1} << 16, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(stream.gcount()));
  const bool keywords = dyna::recognise(start);
  if (!keywords && !mpm3d::recognise(start)) return;
  throw InputError(fmt::format("{}: a deck of {}, no case: 'whipple import {} -o FOLDER' makes a case of it",
                               file.string(), keywords ? "LS-DYNA" : "MPM3D-F90", file.string()));
}

Import import_deck(const fs::path& deck, const ImportOptions& options) {
  const std::string text = deck_text(deck);
  switch (options.format ? *options.format : format_of(deck, text)) {
    case Format::mpm3d_f90:
      return mpm3d::to_case(mpm3d::parse(deck, text), options);
    case Format::ls_dyna:
      return dyna::to_case(dyna::parse(deck, text), options);
  }
  throw InternalError("a format of decks without a reader");
}

CaseFolder::CaseFolder(const Import& import, fs::path folder) : folder_(std::move(folder)) {
  if (!folder_.has_filename()) folder_ = folder_.parent_path();  // "cases/new/"
  if (fs::exists(folder_))
    throw InputError(fmt::format("{}: exists; nothing is overwritten", folder_.string()));
  partial_ = folder_;
  partial_ += fmt::format(".{}.partial", getpid());
  try {
    std::error_code fault;
    fs::create_directories(partial_, fault);
    if (fault) throw InputError(fmt::format("{}: cannot be written: {}", folder_.string(), fault.message()));
    write_text_atomically(case_file(), import.case_text);
    for (const CaseFile& file : import.files) {
      make_folder((partial_ / file.path).parent_path());
      write_text_atomically(partial_ / file.path, file.text);
    }
    write_text_atomically(partial_ / "import.txt", import.report());
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(partial_, ignored);
    throw;
  }
}

CaseFolder::~CaseFolder() {
  std::error_code ignored;
  if (!partial_.empty()) fs::remove_all(partial_, ignored);
}

void CaseFolder::publish() {
  std::error_code fault;
  fs::rename(partial_, folder_, fault);
  if (fault) throw InputError(fmt::format("{}: cannot be written: {}", folder_.string(), fault.message()));
  partial_.clear();
}

void write_case_only(const Import& import, const fs::path& folder) {
  for (const CaseFile& file : import.files) {
    if (fs::exists(folder / file.path)) continue;
    throw InputError(
        fmt::format("{}: has no {}; without --case-only the import writes it", folder.string(), file.path));
  }
  require_new_file(folder / "case.toml", false);
  write_text_atomically(folder / "case.toml", import.case_text);
}

}  // namespace whipple::decks
