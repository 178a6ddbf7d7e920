// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "md_fitting/elements/element_defaults.hpp"

/// Determines which constants of an element a fit needs: for fits to existing points, and for planning before the
/// simulations are run.
namespace whipple::elements {

/// Lists the equations of state that can be fitted, with their names in the catalogue.
enum class FitModel { gray, mie_gruneisen, debye_gruneisen };
constexpr std::array<std::pair<std::string_view, FitModel>, 3> fit_models = {
    {{"gray", FitModel::gray},
     {"mie_gruneisen", FitModel::mie_gruneisen},
     {"debye_gruneisen", FitModel::debye_gruneisen}}};
constexpr std::string_view name_of(FitModel model) {
  return fit_models[static_cast<std::size_t>(model)].first;
}

/// Minimum number of saturation temperatures for which the vapour is fitted.
constexpr std::size_t least_saturations = 2;

/// Describes which data determine constants that the element would otherwise have to supply.
struct Determined {
  bool melting = false;     ///< coexistence points
  bool vapour = false;      ///< saturated densities at `least_saturations` temperatures
  bool vibrations = false;  ///< elastic constants or quantum nuclei, which give a Debye temperature
  bool electrons = false;   ///< the user supplies the electronic heat coefficient
};

/// Returns the parameters without which a model cannot be fitted.
std::vector<std::string> missing_constants(FitModel model, const ElementDefaults& table,
                                           const Determined& determined);

}  // namespace whipple::elements
