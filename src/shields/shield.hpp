// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "src/core/base/parameter_table.hpp"
#include "src/core/input/section.hpp"

/// Shields of spacecraft: what ballistic limit equations and generated cases are told about them (SI units).
namespace whipple::shields {

struct Impact;

/// Marks a value that is that of the alloy.
constexpr double of_alloy = std::numeric_limits<double>::infinity();

/// Describes a sheet.
struct Sheet {
  static constexpr bool required = true;
  std::string alloy;
  double thickness = 0.0;      ///< m
  double density = of_alloy;   ///< kg/m^3
  double yield = of_alloy;     ///< Pa
  double hardness = of_alloy;  ///< Brinell

  static ParameterTable<Sheet> parameters();
  void check(const Impact& impact, const input::Faults& faults) const;
};

/// Describes a sheet in front of the wall.
struct Bumper {
  Sheet sheet;
  double spacing = 0.0;  ///< m, from its rear face to the next sheet

  static ParameterTable<Bumper> parameters();
  void check(const Impact& impact, const input::Faults& faults) const;
};

/// Describes fabric between bumper and wall of a stuffed Whipple shield.
struct Stuffing {
  double areal_density = 0.0;  ///< kg/m^2; 0: none

  static ParameterTable<Stuffing> parameters();
};

/// Describes an open-cell foam that fills the spacing between two sheets.
struct Foam {
  double density = 0.0;           ///< kg/m^3 with its pores; 0: none
  double cell = 0.0;              ///< m, cube root of the volume of a cell; 0: not known
  std::string alloy = "6101-T6";  ///< of its struts

  static ParameterTable<Foam> parameters();
  void check(const Impact& impact, const input::Faults& faults) const;
};

/// Describes a shield: bumpers in the order in which they are struck, and the wall that must hold.
struct Shield {
  static constexpr bool required = true;
  std::vector<Bumper> bumpers;
  Sheet wall;
  Stuffing stuffing;
  Foam foam;

  static ParameterTable<Shield> parameters() { return {}; }
  static std::span<const input::Section<Shield, Impact>> sections();
};

/// Describes the sphere that strikes the shield.
struct Projectile {
  static constexpr bool required = true;
  std::string alloy;
  double diameter = 0.0;      ///< m
  double velocity = 0.0;      ///< m/s
  double angle = 0.0;         ///< rad, between the flight and the normal of the shield
  double density = of_alloy;  ///< kg/m^3

  static ParameterTable<Projectile> parameters();
  void check(const Impact& impact, const input::Faults& faults) const;
};

/// Describes an impact on a shield.
struct Impact {
  std::string name;
  Projectile projectile;
  Shield shield;

  static ParameterTable<Impact> parameters();
  static std::span<const input::Section<Impact, Impact>> sections();
};

/// Fills in the values of alloys that are not given.
/// @throws InputError with the accepted alloys if one is unknown
void complete(Impact& impact);

/// Reads an impact from a shield file (`whipple describe shield`).
/// @throws InputError with all faults, each with file and line
Impact read_impact(const std::filesystem::path& file);

/// Describes the keys of a shield file for `whipple describe`.
std::string describe_impact();

/// Returns the JSON schema of shield files.
std::string impact_schema();

}  // namespace whipple::shields
