// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/element_defaults.hpp"

#include <fmt/format.h>

#include <array>
#include <vector>

#include "src/base/error.hpp"

namespace whipple::fit {
namespace {

constexpr std::string_view gray_universal =
    "universal constant of GRAY (Royce, UCRL-51121, 1971; value of the public implementation OpenRadioss "
    "LAW16)";

constexpr std::array copper_electronic = {
    NamedDefault{"electronic_heat_coefficient", "measured", 6.9e-4,
                 "calorimetry below 30 K: D. L. Martin, Phys. Rev. B 8 (1973) 5357"},
    NamedDefault{"electronic_heat_coefficient", "liu2013", 4.9e-4,
                 "experiment row of Liu, Wang & Zhang, Int. J. Mech. Mater. Des. 9 (2013) 127"},
    NamedDefault{"electronic_heat_coefficient", "none", 0.0, "no electronic energy at all"},
};

constexpr std::string_view linear_hugoniot = "the simulated shocks are fitted by Us = C + S up";

constexpr std::array copper_constants = {
    NamedDefault{"hugoniot_quadratic", "linear", 0.0, linear_hugoniot},
    NamedDefault{"hugoniot_cubic", "linear", 0.0, linear_hugoniot},
    NamedDefault{"electronic_gruneisen", "free electron gas", 2.0 / 3.0,
                 "P V = (2/3) E of a free electron gas; default of GRAY"},
    NamedDefault{"melting_entropy", "GRAY", 9.637, gray_universal},
    NamedDefault{"liquid_heat_coefficient", "GRAY", 1.3, gray_universal},
    NamedDefault{"hot_liquid_ratio", "GRAY", 9.38, gray_universal},
    NamedDefault{"covolume_ratio", "GRAY", 0.5, gray_universal},
    NamedDefault{"join_shape", "GRAY", 1.0, gray_universal},
    NamedDefault{"join_volume_ratio", "critical", 1.3,
                 "chosen with the attraction below: critical temperature near 8500 K (docs/theory/gray.md)"},
    NamedDefault{
        "vapour_attraction", "critical", 620.0,
        "Young-Alder fluid, R T_c V_b = 0.0943 a_y (Young & Alder, Phys. Rev. A 3 (1971) 364), T_c = 8000 K"},
};

constexpr std::array elements = {
    ElementDefaults{
        "Cu", "copper", 1357.77, copper_electronic,
        NamedDefault{"melting_temperature", "Steinberg 1996", 1790.0,
                     "OFHC copper of Steinberg, UCRL-MA-106439 (1996); not from molecular dynamics"},
        copper_constants},
};

constexpr std::array rows = {
    PublishedRow{"experiment (2013)", "Cu", 0.1118e-3, 3940.0, 1.489, 1.97, 1.5, 4.9e-4, 1790.0},
    PublishedRow{"MD (2013)", "Cu", 0.1119e-3, 3980.0, 1.301, 1.86, 1.7, 8.3e-4, 2006.0},
};

}  // namespace

const ElementDefaults& element_defaults(std::string_view element) {
  std::vector<std::string> known;
  for (const ElementDefaults& entry : elements) {
    if (entry.element == element) return entry;
    known.emplace_back(entry.element);
  }
  throw InputError(fmt::format("no table of default constants for the element '{}': known are {}", element,
                               fmt::join(known, ", ")));
}

std::span<const PublishedRow> published_rows() { return rows; }

}  // namespace whipple::fit
