// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "src/analysis/wall.hpp"
#include "src/core/base/words.hpp"

/// What became of a struck wall (docs/manual/shields.md, "Outcome"; docs/decisions/0023_outcome_of_a_wall.md).
namespace whipple::analysis {

/// Names what became of a wall.
enum class Outcome : std::uint8_t { undecided, perforated, detached_spall, attached_spall, bulge, whole };
constexpr std::array<Word<Outcome>, 6> words(Outcome) {
  return {{{Outcome::undecided, "undecided"},
           {Outcome::perforated, "perforated"},
           {Outcome::detached_spall, "detached spall"},
           {Outcome::attached_spall, "attached spall"},
           {Outcome::bulge, "bulge"},
           {Outcome::whole, "whole"}}};
}

/// Holds the constants of the rule.
namespace rule {
constexpr double spall_share =
    0.01;  ///< of the wall's plug of the projectile's diameter: least mass that has come off
constexpr double spall_speed = 10.0;     ///< m/s, by which it leaves the wall
constexpr double spall_particles = 4.0;  ///< least number of particles that have come off
constexpr double spall_width =
    2.0;  ///< cells, edge of the square that they fill at least in the section of a model in two dimensions
constexpr double gap = 2.0;         ///< cells, least width of a gap
constexpr double under_way = 0.01;  ///< of the projectile's momentum, that may still be on its way
constexpr double growth =
    0.05;  ///< of the wall's mean plastic strain in the window, below which it has stopped
constexpr double failing = 0.01;  ///< of the plug: growth of its failed mass in the window, likewise
constexpr double window = 5e-3;   ///< s/m, of that time over the diameter of the projectile
constexpr double bulged = 0.1;    ///< of the thickness, least displacement of the rear face
}  // namespace rule

/// Holds what became of a wall, when that was decided (s), and why.
struct Verdict {
  Outcome outcome = Outcome::undecided;
  double time = nan;
  std::string reason;

  /// Returns whether the experiments count the wall as failed: perforated or with detached spall.
  [[nodiscard]] bool is_defeat() const {
    return outcome == Outcome::perforated || outcome == Outcome::detached_spall;
  }
};

/// Follows a wall until its outcome is decided.
class Judge {
 public:
  /// @param wall  must outlive the judge
  Judge(const Run& run, const Snapshot& first, const Frame& flight, const Wall& wall);

  /// Judges a snapshot; in order of time. What is decided stays.
  void add(const Snapshot& snapshot, const Wall::Remains& left);
  [[nodiscard]] const Verdict& verdict() const { return verdict_; }
  [[nodiscard]] bool decided() const { return verdict_.outcome != Outcome::undecided; }

  /// Returns the measures `defeated.BODY` and `outcome_time.BODY`.
  [[nodiscard]] Quantities measures() const;

 private:
  /// Holds what has come off behind the wall.
  struct ComeOff {
    double mass = 0.0;      ///< kg, of the full problem
    double speed = 0.0;     ///< m/s, mean, away from the wall in front of it
    double distance = 0.0;  ///< m, mean, behind the rear of the wall
    double particles = 0.0;
  };
  /// Holds how the wall deforms: it has stopped when neither grows any more.
  struct State {
    double time = 0.0;
    double strain = 0.0;  ///< mean plastic strain of all of its material
    double failed = 0.0;  ///< kg of it that have failed, of the full problem
  };
  /// Holds how far a part of the wall has moved along the axis since the start, and how fast it moves, on average.
  struct Motion {
    double displacement = 0.0;  ///< m
    double speed = 0.0;         ///< m/s
  };
  /// Holds how far the wall has bent, and where it has opened inside.
  struct Shape {
    double bulge = 0.0;      ///< m, largest displacement of its rear relative to its rim
    double open_area = 0.0;  ///< m^2, of the face, where a gap lies inside it
  };

  [[nodiscard]] double momentum_under_way(const Snapshot& snapshot) const;
  [[nodiscard]] State state_of(const Snapshot& snapshot) const;
  [[nodiscard]] bool has_stopped(const State& now);
  [[nodiscard]] Motion rim_of(const Snapshot& snapshot, const std::vector<std::uint8_t>& held) const;
  [[nodiscard]] ComeOff come_off(const Snapshot& snapshot, const std::vector<std::uint8_t>& held,
                                 const Vector3& shift) const;
  [[nodiscard]] bool is_spall(const ComeOff& off) const;
  [[nodiscard]] Shape shape(const Snapshot& snapshot, const Wall::Remains& left) const;
  void decide(Outcome outcome, double time, std::string reason) {
    verdict_ = {outcome, time, std::move(reason)};
  }

  const Wall& wall_;
  std::string body_;
  double cell_ = 0.0;
  double least_particles_ = 0.0;  // that detached spall consists of
  double debris_speed_ = 0.0;     // m/s
  double momentum_ = 0.0;         // kg m/s, of the projectile along the wall's axis
  double plug_ = 0.0;             // kg, of the wall under the projectile
  double window_ = 0.0;           // s
  std::vector<State> states_;     // since the debris has come
  Verdict verdict_;
};

/// Judges a body of a run by all its snapshots.
/// @throws InputError if the run has no snapshots or no body of that name
Verdict judge(const Run& run, const std::string& body);

}  // namespace whipple::analysis
