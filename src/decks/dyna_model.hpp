// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/base/tensor.hpp"
#include "src/decks/dyna_deck.hpp"
#include "src/decks/report.hpp"

namespace whipple::decks::dyna {

using Id = std::int64_t;

struct Solid {
  unsigned line = 0;
  std::array<Id, 8> nodes = {};
};
struct SphPoint {
  Id node = 0;
  double mass = 0.0;
};
struct Part {
  const Block* block = nullptr;
  std::string name;
  Id section = 0, material = 0, state = 0;
  std::vector<Solid> solids;
  std::vector<SphPoint> points;
};
/// What a velocity is given to.
struct Start {
  const Block* block = nullptr;
  Vector3 velocity = Vector3::Zero();
  std::set<Id> nodes;  ///< empty with no parts: all
  std::set<Id> parts;
};

/// A point where detonation begins.
struct Detonator {
  const Block* block = nullptr;
  Vector3 position = Vector3::Zero();
  double delay = 0.0;
};

/// What the keywords of a deck say, in its units.
struct Model {
  std::string title;
  std::map<Id, Vector3> nodes;
  std::map<Id, Part> parts;
  std::map<Id, const Block*> materials, states;  ///< *MAT and *EOS by their numbers
  std::vector<Start> starts;
  std::vector<Detonator> detonators;
  std::optional<double> friction;  ///< nothing: the deck has no contact
  double end = 0.0, snapshots = 0.0;
};

/// Faults of a deck, which are reported together.
class FaultList {
 public:
  void add(InputFault fault) { faults_.push_back(std::move(fault)); }
  /// Throws all faults, if there are any.
  void raise() {
    if (!faults_.empty()) throw InputError(std::move(faults_));
  }
  /// Runs a part of the work and keeps its faults.
  template <class Work>
  void guarded(Work&& work) {
    constexpr std::size_t most = 20;
    try {
      work();
    } catch (const InputError& error) {
      faults_.insert(faults_.end(), error.faults().begin(), error.faults().end());
      if (faults_.size() >= most) raise();
    }
  }

 private:
  std::vector<InputFault> faults_;
};

/// Reads the keywords of a deck, with a remark on each.
Model read_model(const Deck& deck, Import& import, FaultList& faults);

}  // namespace whipple::decks::dyna
