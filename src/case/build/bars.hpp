// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "src/case/case.hpp"
#include "src/fem/bars.hpp"

namespace whipple::cases {

/// Returns the shape of the bars of a body: it contains no point, but has bounds and a volume.
std::shared_ptr<const Shape> shape_of_bars(const Body& body);

/// Returns why bars cannot be placed: they are inside a body of elements.
std::optional<std::string> fault_of_bars(const Case& setup, const Body& bars);

/// Returns the index of the body that contains most of the length of these bars; nothing if no body contains any.
std::optional<std::size_t> body_around_bars(const Case& setup, const Body& bars);

/// Returns the constants of bars of a material: elastic or von Mises with linear hardening.
/// @throws InputError for other strength models, and for failure criteria, which bars do not support
fem::BarMaterial bar_material(const Material& material, const Body& body);

/// Creates the bars of all bodies of bars with their initial velocities. Ids of nodes and bars continue those of the
/// elements.
/// @throws InputError if bars are too short to be divided or the material is not supported for bars
std::vector<fem::Bars> make_bars(const Case& setup, std::uint64_t first_node_id,
                                 std::uint64_t first_element_id);

}  // namespace whipple::cases
