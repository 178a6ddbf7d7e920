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
#include "src/decks/dyna_constraints.hpp"
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
  std::string name;  ///< name of the body: its heading if that is unique, otherwise "part_1"
  Id section = 0, material = 0, state = 0;
  std::vector<Solid> solids;
  std::vector<SphPoint> points;
};
/// Holds the element formulation of a part.
struct Section {
  const Block* block = nullptr;
  Id formulation = 0;
};
/// Assigns an initial velocity to nodes or parts.
struct Start {
  const Block* block = nullptr;
  Vector3 velocity = Vector3::Zero();
  std::set<Id> nodes;  ///< all nodes if both are empty
  std::set<Id> parts;
};

/// Describes a point of detonation.
struct Detonator {
  const Block* block = nullptr;
  unsigned line = 0;
  Id part = 0;  ///< part that it lights; 0: all
  Vector3 position = Vector3::Zero();
  double delay = 0.0;
};

/// Holds the contents of the keywords of a deck, in its units.
struct Model {
  std::string title;
  std::map<Id, Vector3> nodes;
  std::map<Id, Part> parts;
  std::map<Id, Section> sections;
  std::map<Id, const Block*> materials, states;  ///< *MAT and *EOS by their numbers
  std::vector<Start> starts;
  std::map<Id, Directions> held;      ///< constrained nodes, by *NODE and *BOUNDARY_SPC
  std::vector<const Block*> holders;  ///< blocks with nodal constraints
  std::vector<Detonator> detonators;
  bool shadows = false;       ///< detonation paths go around inert material
  std::vector<Id> histories;  ///< nodes of *DATABASE_HISTORY_NODE
  const Block* histories_block = nullptr;
  std::optional<double> friction;  ///< nothing: the deck has no contact
  double end = 0.0, snapshots = 0.0;
};

/// Collects the faults of a deck, which are reported together.
class FaultList {
 public:
  void add(InputFault fault) { faults_.push_back(std::move(fault)); }
  /// Throws all faults, if there are any.
  void raise() {
    if (!faults_.empty()) throw InputError(std::move(faults_));
  }
  /// Runs a part of the work and records its faults.
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
