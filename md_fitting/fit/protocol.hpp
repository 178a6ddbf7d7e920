// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "md_fitting/data_set/data_set.hpp"

namespace whipple::fit {

/// Protocols whose points the fit plans and weighs.
enum class Protocol { zero_pressure_volume, hugoniot, isochore, coexistence };

/// Returns the protocol of a point of the store; none for those that the fit does not plan.
std::optional<Protocol> protocol_of(const md::PointRecord& point);

}  // namespace whipple::fit
