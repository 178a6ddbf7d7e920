// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/base/error.hpp"
#include "src/device/engine.hpp"

/// The engine of a program without the compiler of a graphics processor.
namespace whipple::device {

bool has_gpu_engine() { return false; }

std::optional<Card> find_card() { return {}; }

Rates card_rates() { throw StateError("this machine has no graphics processor"); }

std::unique_ptr<Engine> gpu_engine(const Problem&, const PointsOnHost&) {
  throw StateError("this program was built without the compiler of a graphics processor (nvcc 12 or later)");
}

}  // namespace whipple::device
