// SPDX-License-Identifier: BSD-3-Clause
#include "eos/files/models.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <string>

#include "eos/files/table_file.hpp"
#include "src/base/error.hpp"

namespace whipple::eos {
namespace {

namespace fs = std::filesystem;

/// The file as it can be opened. Copies of a material take the files beside it along: none may lie above.
fs::path resolved(const fs::path& folder, const fs::path& file) {
  if (file.is_absolute()) return file;
  if (std::ranges::find(file, "..") != file.end()) {
    throw InputError(
        fmt::format("file = \"{}\": expected an absolute path, or one below the folder of the material file",
                    file.string()));
  }
  return folder / file;
}

struct TableConstants {
  std::string file;
  static ParameterTable<TableConstants> parameters() {
    return {text("file", &TableConstants::file,
                 "NAME.eos.h5 as 'whipple eos table' writes it; relative to the material file")};
  }
};

ModelEntry table_entry(const fs::path& folder, std::vector<fs::path>* used) {
  return {std::string(Table::name), "table of another model, written by 'whipple eos table'",
          [] { return describe_table(TableConstants::parameters()); },
          [folder, used](const ParameterReader& read) -> std::function<std::unique_ptr<EquationOfState>()> {
            TableConstants constants;
            read(whipple::bind(TableConstants::parameters(), constants));
            const fs::path file = constants.file;
            if (used != nullptr && file.is_relative()) used->push_back(file);
            return
                [folder, file] { return std::make_unique<Table>(read_table(resolved(folder, file)).data); };
          }};
}

}  // namespace

std::vector<ModelEntry> all_models(const fs::path& folder, std::vector<fs::path>* used) {
  std::vector<ModelEntry> entries(catalogue().begin(), catalogue().end());
  entries.push_back(table_entry(folder, used));
  return entries;
}

}  // namespace whipple::eos
