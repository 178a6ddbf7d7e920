// SPDX-License-Identifier: BSD-3-Clause
#include "eos/files/models.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "eos/files/sesame.hpp"
#include "eos/files/table_file.hpp"
#include "eos/models/simulated_crystal.hpp"
#include "eos/table/sesame.hpp"
#include "src/core/base/error.hpp"

namespace whipple::eos {
namespace {

namespace fs = std::filesystem;

/// Returns the path at which a file can be opened. Copies of a material include its companion files, which must
/// therefore not be in a parent folder.
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

/// Returns the companions of the material file: its files with relative names.
template <class Constants>
std::vector<fs::path> companions_of(const Constants& constants) {
  const fs::path file = constants.file;
  return file.is_relative() ? std::vector{file} : std::vector<fs::path>();
}

ModelEntry table_entry(const fs::path& folder) {
  return catalogue_entry<ModelEntry>(
      Table::name, "table of another model, written by 'whipple eos table'", "", &TableConstants::parameters,
      [folder](const TableConstants& constants) {
        return std::make_unique<Table>(read_table(resolved(folder, constants.file)).data);
      },
      companions_of<TableConstants>);
}

struct SesameConstants {
  std::string file;
  std::int64_t material = 0;
  double reference_temperature = 298.15;
  static ParameterTable<SesameConstants> parameters() {
    using C = SesameConstants;
    return {text("file", &C::file,
                 "SESAME file in ASCII layout (tables 201 and 301); relative to the material file"),
            integer("material", &C::material, range::between(1, 999999), "SESAME number of the material")
                .optional("the only one of the file"),
            real("reference_temperature", &C::reference_temperature, "K", range::non_negative(),
                 "of the reference state, at the density of table 201")
                .optional()};
  }
};

ModelEntry sesame_entry(const fs::path& folder) {
  return catalogue_entry<ModelEntry>(
      Sesame::name, "table 301 of a SESAME file", "", &SesameConstants::parameters,
      [folder](const SesameConstants& constants) {
        const fs::path path = resolved(folder, constants.file);
        const std::optional<int> number =
            constants.material == 0 ? std::nullopt : std::optional(static_cast<int>(constants.material));
        return std::make_unique<Sesame>(read_sesame(path, number), constants.reference_temperature,
                                        path.string());
      },
      companions_of<SesameConstants>);
}

ModelEntry simulated_entry() {
  return catalogue_entry<ModelEntry>(SimulatedCrystal::name,
                                     "crystal simulated by whipple-md when a state is asked for", "",
                                     &SimulatedConstants::parameters, simulated_crystal);
}

}  // namespace

Catalogue<ModelEntry> all_models(const fs::path& folder) {
  std::vector<ModelEntry> entries(catalogue().begin(), catalogue().end());
  entries.push_back(table_entry(folder));
  entries.push_back(sesame_entry(folder));
  entries.push_back(simulated_entry());
  return {"equation of state", std::move(entries)};
}

}  // namespace whipple::eos
