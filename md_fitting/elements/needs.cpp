// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/elements/needs.hpp"

namespace whipple::elements {

std::vector<std::string> missing_constants(FitModel model, const ElementDefaults& table,
                                           const Determined& determined) {
  std::vector<std::string> missing;
  const auto need = [&](const char* parameter) {
    if (table.find(parameter) == nullptr) missing.emplace_back(parameter);
  };
  if (model == FitModel::mie_gruneisen) return missing;
  if (!determined.electrons) need("electronic_heat_coefficient");
  if (!determined.melting) need("melting_temperature");
  if (model == FitModel::debye_gruneisen) {
    if (!determined.vibrations) need("debye_temperature");
    return missing;
  }
  need("join_volume_ratio");  // also the start value if it is fitted
  if (!determined.vapour && table.find("vapour_attraction") == nullptr) need("boiling_temperature");
  return missing;
}

}  // namespace whipple::elements
