// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "md_fitting/fit/joint/measured_curves.hpp"

/// Measured curves of a metal with known constants.
namespace whipple::fit::testing {

/// A measured curve of the metal with given constants, with normal errors relative to the ordinate.
inline MeasuredCurve measured(const eos::GrayConstants& constants, eos::experiments::ExperimentKind kind,
                              const char* name, const std::vector<double>& abscissa, double error,
                              unsigned seed) {
  MeasuredCurve curve;
  eos::experiments::Experiment& e = curve.experiment;
  e.name = name;
  e.kind = kind;
  e.volume_temperature = e.temperature = 293.0;
  e.abscissa = abscissa;
  const std::size_t n = abscissa.size();
  e.initial_density.assign(n, std::nan(""));
  e.porosity.assign(n, std::nan(""));
  e.temperatures.assign(n, 293.0);
  e.ordinate.assign(n, 1.0);
  e.ordinate = CurveModel(constants).values(e);
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  for (double& value : e.ordinate) {
    curve.error.push_back(error * value);
    value *= 1.0 + error * normal(generator);
  }
  curve.stated = true;
  return curve;
}

inline std::vector<double> steps(double from, double to, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(from + (to - from) * i / (count - 1));
  return values;
}

}  // namespace whipple::fit::testing
