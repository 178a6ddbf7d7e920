// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "src/device/contact/constants.hpp"
#include "src/device/contact/nodes.hpp"
#include "src/device/reduction.hpp"

namespace whipple::device {

/// Flags the first node of each pair.
struct FlagFirstOfPair {
  const ContactRole* role;
  std::uint32_t* flags;
  WHIPPLE_POINT void operator()(std::size_t i) const { flags[i] = role[i] == ContactRole::first ? 1 : 0; }
};

/// Sums the balances of all pairs.
struct SumBalances {
  using Result = Reduction<5, 0>;
  const ContactBalance* balances;
  WHIPPLE_POINT void operator()(std::size_t i, Result& result) const {
    const ContactBalance& of_pair = balances[i];
    result.sum[0] += of_pair.contact_heat;
    result.sum[1] += of_pair.friction_heat;
    result.sum[2] += of_pair.impulse;
    result.sum[3] += of_pair.friction_impulse;
    result.sum[4] += of_pair.crowded;
  }
};

}  // namespace whipple::device
