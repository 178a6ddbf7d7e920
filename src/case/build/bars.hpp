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

/// Returns what the bars of a body fill: holds no point, has bounds and a volume.
std::shared_ptr<const Shape> shape_of_bars(const Body& body);

/// Why these bars cannot be where they are: in a body of elements.
std::optional<std::string> fault_of_bars(const Case& setup, const Body& bars);

/// Number of the body that holds most of the length of these bars; nothing if none holds any.
std::optional<std::size_t> body_around_bars(const Case& setup, const Body& bars);

/// Constants of bars of a material: elastic or von Mises with linear hardening.
/// @throws InputError for other models of strength, and for failure criteria, which bars do not know
fem::BarMaterial bar_material(const Material& material, const Body& body);

/// Bars of all bodies that are made of them, with their initial velocities. Ids of nodes and bars go on from
/// those of the elements.
/// @throws InputError if bars are too short to be divided or the material is not one of bars
std::vector<fem::Bars> make_bars(const Case& setup, std::uint64_t first_node_id,
                                 std::uint64_t first_element_id);

}  // namespace whipple::cases
