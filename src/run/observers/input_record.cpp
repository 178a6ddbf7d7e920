// SPDX-License-Identifier: BSD-3-Clause
#include "src/run/observers/input_record.hpp"

#include <string>

#include "src/core/base/files.hpp"
#include "src/run/material_copies.hpp"

namespace whipple::run {

void InputRecord::after_step(const Moment& moment) {
  const Act act = moment.requests.steering.act;
  if (act == Act::none || entry_of(act).changes == nullptr) return;
  ranks_.on_root([&] {
    cases::Case setup = moment.simulation.setup();
    moment.schedule.write_to(setup);
    const std::string former = read_text(directory_.input_file());
    const std::size_t provenance = former.rfind("\n[provenance]");
    directory_.write_input(cases::to_toml(setup, material_copies(setup)) +
                           (provenance == std::string::npos ? "" : former.substr(provenance)));
  });
}

}  // namespace whipple::run
