// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <vector>

#include "eos/equation_of_state.hpp"
#include "eos/table/builder.hpp"

namespace whipple::eos::table {

/// Holds the phases crossed by an isochore, coldest first, and the edges between them.
struct Isochore {
  std::vector<std::string_view> phases;
  std::vector<double> edges;  ///< z, one less than phases
  double base_energy = 0;     ///< e_0
  double top = 0;             ///< z of the highest temperature
  double least_sound_speed = 0;
};

/// Evaluates states of the model in the coordinates of the table.
class Sampler {
 public:
  Sampler(const EquationOfState& eos, double thermal_energy, const TableRequest& request, int scan);
  [[nodiscard]] double reference_sound_speed() const { return reference_sound_speed_; }
  [[nodiscard]] double base_energy(double x) const;
  [[nodiscard]] Isochore isochore(double x) const;
  [[nodiscard]] State state(double x, double e) const;

 private:
  struct Probe {
    double z;
    std::string_view phase;
    double heat_capacity, sound_speed;
  };
  [[nodiscard]] Probe probe(double x, double base, double z) const;
  /// Adds the edges between two probes of different phases.
  void find_edges(double x, double base, const Probe& low, const Probe& high, Isochore& result) const;
  /// Adds the jump of the heat capacity between two probes of one phase, if there is one.
  void find_jump(double x, double base, Probe low, Probe high, Isochore& result) const;

  const EquationOfState& eos_;
  double reference_sound_speed_, thermal_energy_, least_temperature_, greatest_temperature_;
  int scan_;
};

}  // namespace whipple::eos::table
