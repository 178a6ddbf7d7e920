// SPDX-License-Identifier: BSD-3-Clause
#include "src/decks/dyna_lighting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "src/decks/toml_text.hpp"

namespace whipple::decks::dyna {
namespace {

bool lights(const Detonator& detonator, const Explosive& explosive) {
  return detonator.part == 0 || detonator.part == explosive.part;
}

class LightingWriter {
 public:
  LightingWriter(const Model& model, std::span<const Explosive> explosives, const UnitSystem& units,
                 Import& import)
      : model_(model), explosives_(explosives), units_(units), import_(import) {}

  std::string write() {
    for (const Detonator& detonator : model_.detonators) {
      if (is_read(detonator)) used_.push_back(&detonator);
    }
    for (const Detonator* detonator : used_) point(*detonator);
    for (const Explosive& explosive : explosives_) compare(explosive);
    burn();
    return text_.text();
  }

 private:
  void remark(Outcome outcome, const Detonator& detonator, std::string text) {
    import_.remark(outcome, place_of(*detonator.block, detonator.line), "*" + detonator.block->keyword,
                   std::move(text));
  }
  bool is_read(const Detonator& detonator) {
    if (explosives_.empty()) {
      remark(Outcome::dropped, detonator, "no part is an explosive");
      return false;
    }
    if (std::ranges::any_of(explosives_, [&](const Explosive& e) { return lights(detonator, e); }))
      return true;
    remark(Outcome::missing, detonator,
           detonator.part < 0
               ? fmt::format("PID = {}: an acoustic boundary or a set of parts", detonator.part)
               : fmt::format("PID = {} is no explosive of the case", detonator.part));
    return false;
  }

  void point(const Detonator& detonator) {
    std::string of = "all explosives";
    double slowest = std::numeric_limits<double>::infinity(), fastest = 0.0;
    for (const Explosive& explosive : explosives_) {
      if (!lights(detonator, explosive)) continue;
      if (detonator.part != 0) of = explosive.name;
      slowest = std::min(slowest, explosive.velocity);
      fastest = std::max(fastest, explosive.velocity);
    }
    text_.table("[[detonation]]", fmt::format("line {}", detonator.line));
    const Vector3& x = detonator.position;
    if (detonator.delay < 0.0) text_.entry("shape", "\"sphere\"", "what has been lit at t = 0 (LT < 0)");
    text_.entry("position", fmt::format("[{}, {}, {}]", units_.quantity(x[0], dimension::length),
                                        units_.quantity(x[1], dimension::length),
                                        units_.quantity(x[2], dimension::length)));
    const char* const how = model_.shadows ? "around what is no explosive" : "in straight lines";
    if (detonator.part != 0 && explosives_.size() > 1 && !model_.shadows) text_.text_entry("body", of);
    if (detonator.delay < 0.0) {
      text_.entry("radius", units_.quantity(-detonator.delay * fastest, dimension::length));
      const bool alike = fastest - slowest <= 1e-9 * fastest;
      remark(alike ? Outcome::converted : Outcome::missing, detonator,
             fmt::format(
                 "LT = {}: point of detonation of {}, {}; what it has reached before t = 0 is lit at t = 0{}",
                 number(detonator.delay), of, how,
                 alike ? "" : ", as far as the fastest of explosives that differ in speed"));
      return;
    }
    if (detonator.delay > 0.0) text_.entry("delay", units_.quantity(detonator.delay, dimension::time));
    remark(Outcome::exact, detonator, fmt::format("point of detonation of {}, {}", of, how));
  }

  /// Returns the arrival time of a straight detonation path from a detonation point.
  static double arrival(const Detonator& detonator, const Vector3& x, double velocity) {
    return detonator.delay + (x - detonator.position).norm() / velocity;
  }
  /// Checks whether a detonation point of another part would arrive first: with shadows, every point of the case lights
  /// every explosive.
  void compare(const Explosive& explosive) {
    std::vector<const Detonator*> own, foreign;
    for (const Detonator* detonator : used_)
      (lights(*detonator, explosive) ? own : foreign).push_back(detonator);
    if (foreign.empty() || (!model_.shadows && !own.empty())) return;
    if (own.empty()) {
      remark(model_.shadows ? Outcome::missing : Outcome::converted, *foreign.front(),
             explosive.name + (model_.shadows
                                   ? " has no point of its own: those of other parts light it in the case"
                                   : " has no point of its own: it stays unburnt"));
      return;
    }
    std::size_t early = 0;
    double most = 0.0;
    for (const Vector3& x : explosive.nodes) {
      const auto first = [&](const std::vector<const Detonator*>& of) {
        double time = std::numeric_limits<double>::infinity();
        for (const Detonator* each : of) time = std::min(time, arrival(*each, x, explosive.velocity));
        return time;
      };
      const double before = first(own) - first(foreign);
      if (before > 0.0) ++early;
      most = std::max(most, before);
    }
    if (early == 0) return;
    remark(
        Outcome::missing, *foreign.front(),
        fmt::format("points of other parts light {} of {} nodes of {} in the case, by up to {} {} too early",
                    early, explosive.nodes.size(), explosive.name, number(most), units_.time));
  }

  void burn() {
    if (explosives_.empty() || used_.empty()) return;
    text_.table("[burn]");
    if (!model_.shadows)
      text_.entry("lighting", "\"straight\"", "as in that code without *CONTROL_EXPLOSIVE_SHADOW");
    const double mode = explosives_.front().burn;
    for (const Explosive& explosive : explosives_) {
      if (explosive.burn != mode) {
        remark(Outcome::missing, *used_.front(),
               fmt::format("BETA of {} differs from that of {}: one rule of burning holds for all explosives",
                           explosive.name, explosives_.front().name));
      }
    }
    if (mode == 1.0) text_.entry("mode", "\"volume\"", "BETA = 1");
    if (mode == 2.0) text_.entry("mode", "\"time\"", "BETA = 2");
  }

  const Model& model_;
  std::span<const Explosive> explosives_;
  const UnitSystem& units_;
  Import& import_;
  std::vector<const Detonator*> used_;
  TomlText text_;
};

}  // namespace

bool is_lit(const Model& model, std::span<const Explosive> explosives) {
  return std::ranges::any_of(model.detonators, [&](const Detonator& detonator) {
    return std::ranges::any_of(explosives, [&](const Explosive& e) { return lights(detonator, e); });
  });
}

std::string lighting(const Model& model, std::span<const Explosive> explosives, const UnitSystem& units,
                     Import& import) {
  return LightingWriter(model, explosives, units, import).write();
}

}  // namespace whipple::decks::dyna
