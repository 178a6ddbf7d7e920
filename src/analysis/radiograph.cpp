// SPDX-License-Identifier: BSD-3-Clause
#include "src/analysis/radiograph.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/core/base/error.hpp"
#include "src/core/parallel/threads.hpp"

namespace whipple::analysis {
namespace {

constexpr double widest = 40.0;  // maximum number of pixels per direction over which one particle is spread

/// Spreads `amount` evenly over a square of edge `width` around (x, y), all in pixels from the lower corner.
void deposit(std::vector<double>& image, std::size_t rows, std::size_t columns, double x, double y,
             double width, double amount) {
  const double per_area = amount / (width * width);
  const auto first = [&](double centre) { return std::max(std::floor(centre - 0.5 * width), 0.0); };
  // Overlap of the square with pixel k along one direction.
  const auto overlap = [&](double centre, double k) {
    return std::min(centre + 0.5 * width, k + 1.0) - std::max(centre - 0.5 * width, k);
  };
  for (double row = first(y); row < std::min(y + 0.5 * width, static_cast<double>(rows)); row += 1.0) {
    for (double column = first(x); column < std::min(x + 0.5 * width, static_cast<double>(columns));
         column += 1.0) {
      image[static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column)] +=
          per_area * overlap(x, column) * overlap(y, row);
    }
  }
}

}  // namespace

void PictureLimits::include(const Snapshot& snapshot, const Frame& frame) {
  constexpr double edge = 2.5e-4;
  std::vector<std::pair<double, double>> axial, up;
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    const Vector3 offset = snapshot.position[i] - frame.centre;
    axial.emplace_back(frame.axial(offset), snapshot.mass[i]);
    up.emplace_back(offset[frame.transverse[0]], snapshot.mass[i]);
  }
  if (axial.empty()) return;
  lower_axial = std::min(lower_axial, weighted_quantile(axial, edge));
  upper_axial = std::max(upper_axial, weighted_quantile(axial, 1.0 - edge));
  lower_up = std::min(lower_up, weighted_quantile(up, edge));
  upper_up = std::max(upper_up, weighted_quantile(up, 1.0 - edge));
  if (frame.mirrored(frame.transverse[0]) || frame.dimension == grid::Dimension::axisymmetric) {
    upper_up = std::max(upper_up, -lower_up);
    lower_up = -upper_up;
  }
}

void blur(std::vector<double>& image, std::size_t rows, std::size_t columns, double sigma) {
  if (!(sigma > 0.0)) return;
  const auto reach = static_cast<std::ptrdiff_t>(std::ceil(4.0 * sigma));
  std::vector<double> weight(static_cast<std::size_t>(2 * reach + 1));
  double total = 0.0;
  for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
    const double w = std::exp(-0.5 * static_cast<double>(k * k) / (sigma * sigma));
    weight[static_cast<std::size_t>(k + reach)] = w;
    total += w;
  }
  for (double& w : weight) w /= total;
  // Filters one line of `length` pixels with the given stride; zero beyond the picture.
  const auto along = [&](std::size_t lines, std::size_t line_stride, std::size_t length, std::size_t stride) {
    parallel::for_each(lines, [&](std::size_t line) {
      double* first = image.data() + line * line_stride;
      std::vector<double> copy(length);
      for (std::size_t i = 0; i < length; ++i) copy[i] = first[i * stride];
      const auto n = static_cast<std::ptrdiff_t>(length);
      for (std::ptrdiff_t i = 0; i < n; ++i) {
        double sum = 0.0;
        for (std::ptrdiff_t k = std::max(-reach, -i); k <= std::min(reach, n - 1 - i); ++k) {
          sum += weight[static_cast<std::size_t>(k + reach)] * copy[static_cast<std::size_t>(i + k)];
        }
        first[static_cast<std::size_t>(i) * stride] = sum;
      }
    });
  };
  along(rows, columns, columns, 1);
  along(columns, 1, rows, columns);
}

Radiograph take_radiograph(const Snapshot& snapshot, const Frame& frame, const PictureLimits& limits,
                           const RadiographOptions& options) {
  Radiograph picture;
  picture.time = snapshot.time;
  picture.pixel = options.pixel;
  // Margin for the blur, so that it moves no mass out of the picture.
  const double margin = 2.0 * options.spot + 4.0 * options.pixel;
  picture.lower_axial = limits.lower_axial - margin;
  picture.lower_up = limits.lower_up - margin;
  const double picture_width = limits.upper_axial + margin - picture.lower_axial;
  const double picture_height = limits.upper_up + margin - picture.lower_up;
  picture.columns = static_cast<std::size_t>(std::ceil(picture_width / options.pixel));
  picture.rows = static_cast<std::size_t>(std::ceil(picture_height / options.pixel));
  if (picture.columns * picture.rows > 100'000'000) {
    throw InputError("the pixels of the radiograph are too small: more than 1e8 of them");
  }
  picture.areal_density.assign(options.attenuation.size(),
                               std::vector<double>(picture.rows * picture.columns, 0.0));
  const double sight_copies = frame.mirrored(frame.transverse[1]) ? 2.0 : 1.0;
  const bool reflect = frame.mirrored(frame.transverse[0]);
  const double per_area = sight_copies / (options.pixel * options.pixel);
  const std::vector<double> volumes = snapshot.volumes();
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    if (snapshot.body[i] >= picture.areal_density.size()) continue;
    std::vector<double>& image = picture.areal_density[snapshot.body[i]];
    const Vector3 offset = snapshot.position[i] - frame.centre;
    const double x = (frame.axial(offset) - picture.lower_axial) / options.pixel;
    const double up = offset[frame.transverse[0]], amount = per_area * snapshot.mass[i];
    // A particle of vapour or spray fills its volume, voids included.
    const double edge = std::clamp(frame.edge(volumes[i], snapshot.position[i]) / options.pixel, 1.0, widest);
    const auto add = [&](double height, double part) {
      deposit(image, picture.rows, picture.columns, x, (height - picture.lower_up) / options.pixel, edge,
              part * amount);
    };
    if (frame.dimension == grid::Dimension::axisymmetric) {
      // A ring is represented by points about one pixel apart at equal angles; each represents those before and behind
      // the axis.
      const int points =
          static_cast<int>(std::ceil(std::numbers::pi * std::abs(up) / (edge * options.pixel))) + 1;
      for (int k = 0; k < points; ++k)
        add(up * std::cos(std::numbers::pi * (k + 0.5) / points), 1.0 / points);
    } else {
      add(up, 1.0);
      if (reflect) add(-up, 1.0);
    }
  }
  constexpr double width_of_sigma = 2.3548200450309493;  // full width at half maximum, 2 sqrt(2 ln 2)
  picture.transmission.assign(picture.rows * picture.columns, 0.0);
  for (std::size_t b = 0; b < picture.areal_density.size(); ++b) {
    blur(picture.areal_density[b], picture.rows, picture.columns,
         options.spot / (width_of_sigma * options.pixel));
    for (std::size_t k = 0; k < picture.transmission.size(); ++k) {
      picture.transmission[k] += options.attenuation[b] * picture.areal_density[b][k];
    }
  }
  for (double& t : picture.transmission) t = std::exp(-t);
  return picture;
}

}  // namespace whipple::analysis
