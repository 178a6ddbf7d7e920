// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/stop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/case/case.hpp"
#include "src/core/base/units.hpp"

namespace whipple::cases {

ParameterTable<Stop> Stop::parameters() {
  return {
      choice("when", &Stop::when,
             "a body is open along the flight, in a snapshot | the outcome of a struck wall is decided, in a "
             "snapshot (`defeated` of whipple analyse) | the centre of mass of a body becomes slower "
             "than `speed` | the kinetic energy of a body falls below `energy` | a column of history.csv "
             "changes less than `change` in the time `over` | the run has taken `wall_time`"),
      text("body", &Stop::body, "body that is perforated, decided, slow or without energy").optional(),
      real("speed", &Stop::speed, "m/s", range::positive(), "with speed_below; it was above before")
          .optional("none"),
      real("energy", &Stop::energy, "J", range::positive(),
           "with energy_below, of the model as computed; it was above before")
          .optional("none"),
      text("column", &Stop::column, "with settled: name of the column, without its unit").optional(),
      real("change", &Stop::change, "", range::open_between(0.0, 1.0),
           "with settled: largest less smallest value over the largest magnitude so far")
          .optional("none"),
      real("over", &Stop::over, "s", range::positive(), "with settled: simulated time").optional("none"),
      real("wall_time", &Stop::wall_time, "s", range::positive(),
           "with wall_time: time of computing, over restarts")
          .optional("none"),
      real("after", &Stop::after, "s", range::non_negative(),
           "simulated time before which it is not asked for")
          .optional()};
}

void Stop::check(const Case& setup, const Faults& faults) const {
  const std::string_view word = word_of(when);
  const auto expect = [&](const char* key, bool given, bool needed) {
    if (given == needed) return;
    faults.add(key, given ? fmt::format("'{}' does not belong to when = \"{}\"", key, word)
                          : fmt::format("when = \"{}\" needs '{}'", word, key));
  };
  const bool in_snapshots = when == StopWhen::perforated || when == StopWhen::decided;
  const bool of_body = in_snapshots || when == StopWhen::speed_below || when == StopWhen::energy_below;
  expect("body", !body.empty(), of_body);
  expect("speed", speed != not_given, when == StopWhen::speed_below);
  expect("energy", energy != not_given, when == StopWhen::energy_below);
  expect("column", !column.empty(), when == StopWhen::settled);
  expect("change", change != not_given, when == StopWhen::settled);
  expect("over", over != not_given, when == StopWhen::settled);
  expect("wall_time", wall_time != not_given, when == StopWhen::wall_time);
  if (of_body && !body.empty() && std::ranges::count(setup.bodies, body, &Body::name) == 0) {
    std::string names;
    for (const Body& known : setup.bodies) names += (names.empty() ? "" : ", ") + known.name;
    faults.add("body", fmt::format("there is no body \"{}\" (accepted: {})", body, names));
  }
  if (in_snapshots && setup.output.snapshot_every == 0.0)
    faults.add("when", fmt::format("when = \"{}\" is decided in snapshots: set output.snapshot_every", word));
}

std::string Stop::in_words() const {
  switch (when) {
    case StopWhen::perforated:
      return fmt::format("body \"{}\" is perforated", body);
    case StopWhen::decided:
      return fmt::format("the outcome of body \"{}\" is decided", body);
    case StopWhen::speed_below:
      return fmt::format("body \"{}\" is slower than {}", body, units::format_quantity(speed, "m/s"));
    case StopWhen::energy_below:
      return fmt::format("the kinetic energy of body \"{}\" is below {}", body,
                         units::format_quantity(energy, "J"));
    case StopWhen::settled:
      return fmt::format("{} has settled: it changed less than {:.3g} % in {}", column, 100.0 * change,
                         units::format_quantity(over, "s"));
    case StopWhen::wall_time:
      break;
  }
  return fmt::format("the run has taken {}", units::format_quantity(wall_time, "s"));
}

}  // namespace whipple::cases
