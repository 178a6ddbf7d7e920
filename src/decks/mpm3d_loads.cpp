// SPDX-License-Identifier: BSD-3-Clause
#include "src/decks/mpm3d_loads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>

#include "src/core/base/tensor.hpp"

namespace whipple::decks::mpm3d {
namespace {

class LoadWriter {
 public:
  LoadWriter(const Deck& deck, std::span<const CaseBody> bodies, const UnitSystem& units, TomlText& toml,
             Import& import, std::vector<InputFault>& faults)
      : deck_(deck), bodies_(bodies), units_(units), toml_(toml), import_(import), faults_(faults) {}

  void write() {
    std::map<std::size_t, std::pair<const Statement*, Vector3>> gravity, force;  // the last of each body
    const Statement* on_particles = nullptr;
    for (const Statement* load : deck_.all(Keyword::load)) {
      if (load->kind == "node") fault(load->line, "MPM3D-F90 has no loads of nodes");
      if (load->kind == "part" && on_particles == nullptr) on_particles = load;
      if (load->kind != "grav" && load->kind != "body") continue;
      const std::vector<double>& n = load->numbers;
      const auto body = static_cast<std::size_t>(std::max(whole(n[0]), 0));
      if (body < 1 || body > bodies_.size()) {
        fault(load->line, fmt::format("there is no body {}", whole(n[0])));
        continue;
      }
      (load->kind == "grav" ? gravity : force)[body - 1] = {load, Vector3(n[1], n[2], n[3])};
    }
    if (on_particles != nullptr) remark(Outcome::missing, *on_particles, "forces on single particles");
    const double rise = rise_of_forces(force.empty());
    for (const auto& [index, entry] : force) {
      const double particles = bodies_[index].particles;
      if (begin_load(bodies_[index], *entry.first, "force", entry.second * particles, dimension::force))
        let_grow(rise);
      remark(Outcome::converted, *entry.first,
             fmt::format("force on each of {} particles: their sum, distributed by mass", number(particles)));
    }
    damping();
    if (gravity.empty()) return;
    const auto& [first, common] = gravity.begin()->second;
    const bool one_for_all =
        gravity.size() == bodies_.size() &&
        std::ranges::all_of(gravity, [&](const auto& each) { return each.second.second == common; });
    if (one_for_all) {
      toml_.table("[gravity]", line_of(*first));
      toml_.entry("acceleration", vector(common, dimension::acceleration));
      return remark(Outcome::exact, *first, "gravity");
    }
    for (const auto& [index, entry] : gravity) {
      static_cast<void>(
          begin_load(bodies_[index], *entry.first, "acceleration", entry.second, dimension::acceleration));
    }
    remark(Outcome::exact, *first, "gravity of single bodies: loads of these");
  }

 private:
  void fault(unsigned line, std::string text) {
    faults_.push_back({.file = deck_.file.string(), .line = line, .column = 1, .text = std::move(text)});
  }
  void remark(Outcome outcome, const Statement& statement, std::string text) {
    import_.remark(outcome, statement.line, statement.name(), std::move(text));
  }
  static std::string line_of(const Statement& statement) { return fmt::format("line {}", statement.line); }
  [[nodiscard]] std::string vector(const Vector3& v, const Dimension& dimension) const {
    return fmt::format("[{}, {}, {}]", units_.quantity(v[0], dimension), units_.quantity(v[1], dimension),
                       units_.quantity(v[2], dimension));
  }
  /// Returns the effective statement of a keyword; earlier ones are dropped with a remark.
  const Statement* one(Keyword keyword) {
    const std::vector<const Statement*> all = deck_.all(keyword);
    for (std::size_t i = 0; i + 1 < all.size(); ++i) {
      remark(Outcome::dropped, *all[i],
             fmt::format("given again in line {}, which counts", all.back()->line));
    }
    return all.empty() ? nullptr : all.back();
  }

  /// Returns the time over which the forces on bodies, but not gravity, grow from 0; 0 if they act from the start.
  double rise_of_forces(bool no_forces) {
    const Statement* statement = one(Keyword::quasi_static);
    if (statement == nullptr) return 0.0;
    const double rise = statement->numbers[0];
    if (!(rise > 0.0)) {
      fault(statement->line, "'qulo' must be > 0: the time over which forces grow");
    } else if (no_forces) {
      remark(Outcome::dropped, *statement, "no 'load body' that could grow; gravity does not in that code");
    } else {
      remark(Outcome::exact, *statement,
             "forces of 'load body' grow from 0 over this time, gravity does not");
    }
    return rise;
  }

  /// Writes the damping of all material: a force -D m v on each particle.
  void damping() {
    const Statement* statement = one(Keyword::damping);
    if (statement == nullptr) return;
    const double rate = statement->numbers[0];
    if (rate < 0.0) return fault(statement->line, "'damp' must be >= 0: it would drive the motion");
    if (rate == 0.0) return remark(Outcome::dropped, *statement, "no damping");
    toml_.table("[[load]]", line_of(*statement));
    toml_.entry("damping", units_.quantity(rate, dimension::rate));
    remark(Outcome::converted, *statement,
           "force -D m v on all material: a load with 'damping', which takes the exact decay over each step");
  }

  /// Begins the table of a load of a body that the case has, unless it is zero. @returns whether it did
  bool begin_load(const CaseBody& body, const Statement& statement, const char* key, const Vector3& value,
                  const Dimension& dimension) {
    if (body.shape.empty() || value.isZero(0.0)) return false;
    toml_.table("[[load]]", line_of(statement));
    toml_.text_entry("body", body.name);
    toml_.entry(key, vector(value, dimension));
    return true;
  }
  void let_grow(double rise) {
    if (!(rise > 0.0)) return;
    toml_.entry("times", fmt::format("[{}, {}]", units_.quantity(0.0, dimension::time),
                                     units_.quantity(rise, dimension::time)));
    toml_.entry("factors", "[0, 1]");
  }

  const Deck& deck_;
  std::span<const CaseBody> bodies_;
  const UnitSystem& units_;
  TomlText& toml_;
  Import& import_;
  std::vector<InputFault>& faults_;
};

}  // namespace

void write_loads(const Deck& deck, std::span<const CaseBody> bodies, const UnitSystem& units, TomlText& toml,
                 Import& import, std::vector<InputFault>& faults) {
  LoadWriter(deck, bodies, units, toml, import, faults).write();
}

}  // namespace whipple::decks::mpm3d
