// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/analysis/frame.hpp"

/// Synthetic flash radiographs: mass per area along the line of sight, absorption, blur by the focal spot
/// (docs/theory/analysis.md, section 4).
namespace whipple::analysis {

struct RadiographOptions {
  double pixel = 0.0;               ///< edge of the pixels, m
  double spot = 0.0;                ///< full width at half maximum of the blur in the plane of the object, m
  std::vector<double> attenuation;  ///< mass attenuation coefficient of each body, m^2/kg
};

/// A picture in the plane of the axis (horizontal) and the first transverse direction (up), completed at the
/// mirror planes. Rows from below.
struct Radiograph {
  double time = 0.0;
  double lower_axial = 0.0, lower_up = 0.0, pixel = 0.0;
  std::size_t columns = 0, rows = 0;
  std::vector<std::vector<double>> areal_density;  ///< of each body, row by row, kg/m^2
  std::vector<double> transmission;                ///< exp(-sum of attenuation times areal density)
};

/// Limits of a picture: lower and upper axial coordinate, reach upward and downward from the axis, m.
struct PictureLimits {
  double lower_axial = 0.0, upper_axial = 0.0, lower_up = 0.0, upper_up = 0.0;
  /// So that it holds all but 0.05 % of the mass, and the limits of another.
  void include(const Snapshot& snapshot, const Frame& frame);
};

Radiograph take_radiograph(const Snapshot& snapshot, const Frame& frame, const PictureLimits& limits,
                           const RadiographOptions& options);

/// Separable Gaussian of standard deviation `sigma` (in pixels); the sum is kept but for what leaves the
/// picture.
void blur(std::vector<double>& image, std::size_t rows, std::size_t columns, double sigma);

}  // namespace whipple::analysis
