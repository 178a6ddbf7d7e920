// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "md_fitting/elements/element_defaults.hpp"

/// Says which constants of an element a fit needs: to the fit of the points that there are, and before the simulations
/// to whoever plans them.
namespace whipple::elements {

/// Equations of state that can be fitted, and their names in the catalogue.
enum class FitModel { gray, mie_gruneisen, debye_gruneisen };
constexpr std::array<std::pair<std::string_view, FitModel>, 3> fit_models = {
    {{"gray", FitModel::gray},
     {"mie_gruneisen", FitModel::mie_gruneisen},
     {"debye_gruneisen", FitModel::debye_gruneisen}}};
constexpr std::string_view name_of(FitModel model) {
  return fit_models[static_cast<std::size_t>(model)].first;
}

/// Temperatures of saturation from which on the vapour is fitted.
constexpr std::size_t least_saturations = 2;

/// What stands for constants of the element.
struct Determined {
  bool melting = false;     ///< coexistence points
  bool vapour = false;      ///< saturated densities at `least_saturations` temperatures
  bool vibrations = false;  ///< elastic constants or quantum nuclei: a Debye temperature
  bool electrons = false;   ///< the user names their heat coefficient
};

/// Parameters without which there is no fit of a model.
std::vector<std::string> missing_constants(FitModel model, const ElementDefaults& table,
                                           const Determined& determined);

}  // namespace whipple::elements
