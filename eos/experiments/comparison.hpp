// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <vector>

#include "eos/equation_of_state.hpp"
#include "eos/experiments/experiment.hpp"

namespace whipple::eos::experiments {

/// An equation of state on the points of an experiment.
struct Comparison {
  std::vector<double> model;  ///< ordinate of the material; NaN outside its range
  /// In percent of the measured Us, T or c, or in Pa; model less experiment.
  std::vector<double> deviation;
  int points = 0;                 ///< inside the range of the material
  std::vector<int> out_of_range;  ///< lines of the points outside of it
  std::vector<int> porous;        ///< lines of the points whose initial density was below the material's
  std::vector<int> denser;        ///< and above it: they count as of the material's density
  double rms = 0.0, mean = 0.0, maximum = 0.0;  ///< `maximum`: the deviation of largest size, with its sign
};

/// Tells whether a material of this name is of the kind that was measured.
bool belongs_to(const Experiment& experiment, std::string_view material);

/// Initial densities that differ by less belong to the same solid: impurities, and errors of the measurement.
constexpr double same_density = 0.01;

/// Returns the density (kg/m^3) from which each point is shocked: that of the row, by `initial_density` or
/// `porosity`, where it is below that of the solid by more than `same_density`, else that of the solid. Points of
/// other kinds than Hugoniots have that of the solid.
std::vector<double> initial_densities(double solid, const Experiment& experiment);

/// Where a curve of the kind of an experiment is wanted; SI.
struct CurvePoints {
  std::vector<double> abscissa;
  std::vector<double> initial_density;  ///< `initial_densities`
  std::vector<double> temperature;      ///< of isotherms
};

/// Compares an equation of state with every point of an experiment. Of a melting line counts the middle of
/// solidus and liquidus. The reference volume of ratios of an isotherm is the model's own at zero pressure and
/// `volume_temperature`; a Hugoniot from less than the initial density is the porous one.
/// @param initial  state ahead of the shock: zero pressure at the reference temperature
Comparison compare(const EquationOfState& eos, const State& initial, const Experiment& experiment);

/// Computes the curve of the experiment's kind (SI); NaN where the model has none.
std::vector<double> curve(const EquationOfState& eos, const State& initial, const Experiment& experiment,
                          const CurvePoints& points);

}  // namespace whipple::eos::experiments
