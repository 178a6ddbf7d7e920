// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <vector>

#include "eos/equation_of_state.hpp"
#include "eos/experiments/experiment.hpp"

namespace whipple::eos::experiments {

/// Holds an equation of state evaluated at the points of an experiment.
struct Comparison {
  std::vector<double> model;  ///< ordinate of the material; NaN outside its range
  /// In percent of the measured ordinate, or in Pa (`is_pressure`); model minus experiment.
  std::vector<double> deviation;
  int points = 0;                 ///< within the range of the material
  std::vector<int> out_of_range;  ///< lines of the points outside it
  std::vector<int> porous;        ///< lines of the points with an initial density below that of the material
  std::vector<int> denser;        ///< lines of those above it, evaluated at the density of the material
  double rms = 0.0, mean = 0.0, maximum = 0.0;  ///< `maximum`: largest by magnitude, with its sign
};

/// Returns whether the ordinate of a kind is a pressure over a volume; the others are compared in percent.
bool is_pressure(ExperimentKind kind);

/// Returns whether a material name denotes the measured material.
bool belongs_to(const Experiment& experiment, std::string_view material);

/// Relative difference of initial densities below which they denote the same solid: impurities, measurement errors.
constexpr double same_density = 0.01;

/// Returns the density (kg/m^3) from which each point is shocked: that of the row, from `initial_density` or
/// `porosity`, if it is below that of the solid by more than `same_density`, otherwise that of the solid. Points of
/// other kinds than Hugoniots have the density of the solid.
std::vector<double> initial_densities(double solid, const Experiment& experiment);

/// Holds the points at which a curve of the kind of an experiment is evaluated; SI.
struct CurvePoints {
  std::vector<double> abscissa;
  std::vector<double> initial_density;  ///< `initial_densities`
  std::vector<double> temperature;      ///< of isotherms
};

/// Compares an equation of state with every point of an experiment. For a melting line the mean of solidus and
/// liquidus is used. The reference volume of the ratios of an isotherm is that of the model at zero pressure and
/// `volume_temperature`; a Hugoniot with a smaller initial density is the porous one.
/// @param initial  state ahead of the shock: zero pressure at the reference temperature
Comparison compare(const EquationOfState& eos, const State& initial, const Experiment& experiment);

/// Computes the curve of the experiment's kind (SI); NaN where the model has none.
std::vector<double> curve(const EquationOfState& eos, const State& initial, const Experiment& experiment,
                          const CurvePoints& points);

}  // namespace whipple::eos::experiments
