// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "src/core/base/tensor.hpp"
#include "src/decks/report.hpp"
#include "src/decks/unit_system.hpp"

namespace whipple::decks {

/// Adds a file of particles to the case, in the units of the deck. @param name  of the body
/// @returns the shape that reads it, "{ points = { file = ... } }"; empty if a mass is not above 0
std::string shape_of_points(Import& import, const std::string& name, const UnitSystem& units,
                            std::span<const Vector3> places, std::span<const double> masses);

}  // namespace whipple::decks
