// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/element_defaults.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <vector>

#include "src/core/base/error.hpp"

namespace whipple::fit {
namespace {

constexpr std::string_view gray_universal =
    "universal constant of GRAY (Royce, UCRL-51121, 1971; value of the public implementation OpenRadioss "
    "LAW16)";
constexpr std::string_view sommerfeld =
    "calorimetry at low temperature: Kittel, Introduction to Solid State Physics, 8th ed. (2005), chapter 6, "
    "table 2";
constexpr std::string_view not_when_hot =
    "the coefficient of low temperature does not hold at thousands of kelvin (docs/manual/materials.md, "
    "section 2)";
constexpr std::string_view boiling = "CRC Handbook of Chemistry and Physics, 95th ed. (2014)";
constexpr std::string_view debye =
    "Kittel, Introduction to Solid State Physics, 8th ed. (2005), chapter 5, table 1";
constexpr std::string_view steinberg_metals = "Steinberg, UCRL-MA-106439 (1996); not from molecular dynamics";
constexpr std::string_view join_choice =
    "as in the metal's material of the library: where the heat capacity of the thin vapour stays positive "
    "(docs/theory/gray.md, section 8)";
constexpr std::string_view linear_hugoniot = "the simulated shocks are fitted by Us = C + S up";

constexpr NamedDefault electrons(const char* name, double value, std::string_view source,
                                 Evidence evidence = Evidence::measured) {
  return {"electronic_heat_coefficient", name, value, source, evidence};
}
constexpr NamedDefault no_electrons = electrons("none", 0.0, "no electronic energy at all", Evidence::chosen);
constexpr NamedDefault steinberg(double temperature) {
  return {"melting_temperature", "Steinberg 1996", temperature, steinberg_metals};
}
constexpr NamedDefault kittel(double temperature) {
  return {"debye_temperature", "Kittel 2005", temperature, debye, Evidence::measured};
}

// What all metals share.
constexpr NamedDefault quadratic = {"hugoniot_quadratic", "linear", 0.0, linear_hugoniot};
constexpr NamedDefault cubic = {"hugoniot_cubic", "linear", 0.0, linear_hugoniot};
constexpr NamedDefault free_electrons = {"electronic_gruneisen", "free electron gas", 2.0 / 3.0,
                                         "P V = (2/3) E of a free electron gas; default of GRAY"};
constexpr NamedDefault entropy = {"melting_entropy", "GRAY", 9.637, gray_universal};
constexpr NamedDefault liquid_heat = {"liquid_heat_coefficient", "GRAY", 1.3, gray_universal};
constexpr NamedDefault hot_liquid = {"hot_liquid_ratio", "GRAY", 9.38, gray_universal};
constexpr NamedDefault covolume = {"covolume_ratio", "GRAY", 0.5, gray_universal};
constexpr NamedDefault shape = {"join_shape", "GRAY", 1.0, gray_universal};

/// All constants: those that metals share, where the thin vapour joins, and what sets its attraction.
constexpr std::array<NamedDefault, 10> constants_of_metal(const NamedDefault& join,
                                                          const NamedDefault& vapour) {
  return {quadratic, cubic, free_electrons, entropy, liquid_heat, hot_liquid, covolume, shape, join, vapour};
}

/// A metal whose vapour boils at the measured temperature.
constexpr std::array<NamedDefault, 10> boiling_metal(double join, double temperature) {
  return constants_of_metal({"join_volume_ratio", "library", join, join_choice},
                            {"boiling_temperature", "measured", temperature, boiling, Evidence::measured});
}

constexpr std::array copper_electronic = {
    electrons("measured", 6.9e-4, "calorimetry below 30 K: D. L. Martin, Phys. Rev. B 8 (1973) 5357"),
    electrons("liu2013", 4.9e-4,
              "experiment row of Liu, Wang & Zhang, Int. J. Mech. Mater. Des. 9 (2013) 127"),
    no_electrons,
};
constexpr std::array aluminium_electronic = {electrons("measured", 1.35e-3, sommerfeld), no_electrons};
constexpr std::array lead_electronic = {electrons("measured", 2.98e-3, sommerfeld), no_electrons};
constexpr std::array tungsten_electronic = {electrons("measured", 1.3e-3, sommerfeld), no_electrons};
constexpr std::array nickel_electronic = {electrons("none", 0.0, not_when_hot, Evidence::chosen),
                                          electrons("measured", 7.02e-3, sommerfeld)};
constexpr std::array tantalum_electronic = {electrons("none", 0.0, not_when_hot, Evidence::chosen),
                                            electrons("measured", 5.9e-3, sommerfeld)};

constexpr auto copper_constants = constants_of_metal(
    {"join_volume_ratio", "critical", 1.3,
     "chosen with the attraction below: critical temperature near 8500 K (docs/theory/gray.md)"},
    {"vapour_attraction", "critical", 620.0,
     "Young-Alder fluid, R T_c V_b = 0.0943 a_y (Young & Alder, Phys. Rev. A 3 (1971) 364), T_c = 8000 K"});
constexpr auto aluminium_constants = constants_of_metal(
    {"join_volume_ratio", "critical", 1.3,
     "chosen with the attraction below: critical temperature near 6600 K (docs/theory/gray.md)"},
    {"vapour_attraction", "critical", 3600.0,
     "as in the aluminium of the library: critical temperature near 6600 K (docs/theory/gray.md)",
     Evidence::chosen, 3600.0 * 800.0 / 6700.0,
     "critical temperature 6700 +- 800 K, Int. J. Thermophys. 30 (2009) 1853; a_y goes as T_c"});
constexpr auto lead_constants = boiling_metal(1.2, 2022.0);
constexpr auto nickel_constants = boiling_metal(1.15, 3186.0);
constexpr auto tantalum_constants = boiling_metal(1.25, 5728.0);
constexpr auto tungsten_constants = boiling_metal(1.3, 5828.0);

using eos::VapourCondition;
constexpr std::array elements = {
    ElementDefaults{
        "Cu", "copper", 1357.77, copper_electronic,
        NamedDefault{"melting_temperature", "Steinberg 1996", 1790.0,
                     "OFHC copper of Steinberg, UCRL-MA-106439 (1996); not from molecular dynamics",
                     Evidence::chosen, 38.0,
                     "measured melting line at 10 GPa, the pressure of T_m0: T_m = 1355(5) + 44.5(31) P - "
                     "0.61(21) P^2, "
                     "Brand et al., High Press. Res. 26 (2006) 185 (eos/data/cu_melting.csv)"},
        copper_constants, VapourCondition::attraction, kittel(343.0)},
    ElementDefaults{
        "Al", "aluminium", 933.47, aluminium_electronic,
        NamedDefault{"melting_temperature", "Steinberg 1996", 1220.0, steinberg_metals, Evidence::chosen,
                     115.0,
                     "half the error bars of the measured melting line, Boehler & Ross, Earth Planet. Sci. "
                     "Lett. 153 (1997) 223 (eos/data/al_melting_boehler_ross1997.csv)"},
        aluminium_constants, VapourCondition::attraction, kittel(428.0)},
    ElementDefaults{"Pb", "lead", 600.61, lead_electronic, steinberg(760.0), lead_constants,
                    VapourCondition::boiling, kittel(105.0)},
    ElementDefaults{"Ni", "nickel", 1728.0, nickel_electronic, steinberg(2330.0), nickel_constants,
                    VapourCondition::boiling, kittel(450.0)},
    ElementDefaults{"Ta", "tantalum", 3290.0, tantalum_electronic, steinberg(4340.0), tantalum_constants,
                    VapourCondition::boiling, kittel(240.0)},
    ElementDefaults{"W", "tungsten", 3687.0, tungsten_electronic, steinberg(4520.0), tungsten_constants,
                    VapourCondition::boiling, kittel(400.0)},
};

constexpr std::string_view liu2013 = "Liu, Wang & Zhang, Int. J. Mech. Mater. Des. 9 (2013) 127";
constexpr std::string_view steinberg1996 = "Steinberg, UCRL-MA-106439 (1996)";

constexpr std::array rows = {
    PublishedRow{"experiment (Liu et al. 2013)", "Cu", liu2013, 0.1118e-3, 3940.0, 1.489, 1.97, 1.5, 4.9e-4,
                 1790.0},
    PublishedRow{"MD (Liu et al. 2013)", "Cu", liu2013, 0.1119e-3, 3980.0, 1.301, 1.86, 1.7, 8.3e-4, 2006.0},
    PublishedRow{"experiment (Steinberg 1996)", "Al", steinberg1996, 1e-3 / 2.707, 5386.0, 1.339, 1.97, 1.5,
                 1.35e-3, 1220.0},
    // Steinberg's shock curve of lead is a cubic: the straight line is another one.
    PublishedRow{
        "experiment (Anderson et al. 1990; Steinberg 1996)", "Pb",
        "lead, C and S: Anderson, Trucano & Mullin, Int. J. Impact Eng. 9 (1990) 89, as typed in the public "
        "input of MPM3D-F90",
        1e-3 / 11.34, 2092.0, 1.45, 2.74, 2.2, 2.98e-3, 760.0},
    PublishedRow{"experiment (Steinberg 1996)", "Ni", steinberg1996, 1e-3 / 8.9, 4650.0, 1.445, 1.93, 1.4,
                 0.0, 2330.0},
    PublishedRow{"experiment (Steinberg 1996)", "Ta", steinberg1996, 1e-3 / 16.69, 3410.0, 1.2, 1.67, 1.3,
                 0.0, 4340.0},
    PublishedRow{"experiment (Steinberg 1996)", "W", steinberg1996, 1e-3 / 19.3, 4030.0, 1.237, 1.67, 1.3,
                 1.3e-3, 4520.0},
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
