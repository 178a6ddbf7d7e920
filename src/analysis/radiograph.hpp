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

/// Holds a picture in the plane of the axis (horizontal) and the first transverse direction (up), completed at the
/// mirror planes. Rows are ordered from the bottom.
struct Radiograph {
  double time = 0.0;
  double lower_axial = 0.0, lower_up = 0.0, pixel = 0.0;
  std::size_t columns = 0, rows = 0;
  std::vector<std::vector<double>> areal_density;  ///< of each body, row by row, kg/m^2
  std::vector<double> transmission;                ///< exp(-sum of attenuation times areal density)
};

/// Holds the limits of a picture: lower and upper axial coordinate, extent upward and downward from the axis, m.
struct PictureLimits {
  double lower_axial = 0.0, upper_axial = 0.0, lower_up = 0.0, upper_up = 0.0;
  /// Extends the limits to include all but 0.05 % of the mass of a snapshot.
  void include(const Snapshot& snapshot, const Frame& frame);
};

Radiograph take_radiograph(const Snapshot& snapshot, const Frame& frame, const PictureLimits& limits,
                           const RadiographOptions& options);

/// Convolves an image with a separable Gaussian of standard deviation `sigma` (in pixels); the sum is conserved except
/// for what leaves the picture.
void blur(std::vector<double>& image, std::size_t rows, std::size_t columns, double sigma);

}  // namespace whipple::analysis
