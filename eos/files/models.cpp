// SPDX-License-Identifier: BSD-3-Clause
#include "eos/files/models.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "eos/files/sesame.hpp"
#include "eos/files/table_file.hpp"
#include "eos/models/simulated_crystal.hpp"
#include "eos/table/sesame.hpp"
#include "src/core/base/error.hpp"

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

ModelEntry sesame_entry(const fs::path& folder, std::vector<fs::path>* used) {
  return {std::string(Sesame::name), "table 301 of a SESAME file",
          [] { return describe_table(SesameConstants::parameters()); },
          [folder, used](const ParameterReader& read) -> std::function<std::unique_ptr<EquationOfState>()> {
            SesameConstants constants;
            read(whipple::bind(SesameConstants::parameters(), constants));
            const fs::path file = constants.file;
            if (used != nullptr && file.is_relative()) used->push_back(file);
            return [folder, file, constants] {
              const fs::path path = resolved(folder, file);
              const std::optional<int> number = constants.material == 0
                                                    ? std::nullopt
                                                    : std::optional(static_cast<int>(constants.material));
              return std::make_unique<Sesame>(read_sesame(path, number), constants.reference_temperature,
                                              path.string());
            };
          }};
}

ModelEntry simulated_entry() {
  return {std::string(SimulatedCrystal::name), "crystal simulated by whipple-md when a state is asked for",
          [] { return describe_table(SimulatedConstants::parameters()); },
          [](const ParameterReader& read) -> std::function<std::unique_ptr<EquationOfState>()> {
            SimulatedConstants constants;
            read(whipple::bind(SimulatedConstants::parameters(), constants));
            return [constants] { return simulated_crystal(constants); };
          }};
}

}  // namespace

std::vector<ModelEntry> all_models(const fs::path& folder, std::vector<fs::path>* used) {
  std::vector<ModelEntry> entries(catalogue().begin(), catalogue().end());
  entries.push_back(table_entry(folder, used));
  entries.push_back(sesame_entry(folder, used));
  entries.push_back(simulated_entry());
  return entries;
}

}  // namespace whipple::eos
