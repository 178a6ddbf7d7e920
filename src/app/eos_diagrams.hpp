// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "src/app/eos_figure.hpp"
#include "src/app/eos_queries.hpp"

namespace whipple::app {

/// Kinds of diagrams that `whipple eos plot` draws, each of several loci.
const std::vector<std::string>& diagram_kinds();

/// The figure of one kind: "us-up" (principal Hugoniots with their melting range), "p-v" (Hugoniot, isotherm,
/// cold curve), "p-t" (solidus, liquidus, Hugoniot, isentrope, releases), "p-rho" (Hugoniot, releases, dome).
/// @param options   `to`: the greatest pressure (200 GPa)
/// @param releases  shock pressures to release from; empty: a quarter, a half and all of the greatest one
Figure diagram(const std::string& kind, const EosOptions& options, const std::vector<std::string>& releases,
               const Materials& materials);

}  // namespace whipple::app
