// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

namespace whipple::md {

/// Returns the chemical symbol of an atomic number; "unknown" if there is none.
std::string element_symbol(int atomic_number);
/// Returns the atomic number of a chemical symbol; nothing if there is no such element.
std::optional<int> atomic_number(const std::string& symbol);
/// Returns the standard atomic weight (g/mol) of an element up to uranium, abridged to five digits (Prohaska et
/// al., Pure Appl. Chem. 94 (2022) 573); nothing for elements without stable isotopes except Th, Pa and U.
std::optional<double> standard_atomic_weight(const std::string& symbol);

}  // namespace whipple::md
