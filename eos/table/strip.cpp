// SPDX-License-Identifier: BSD-3-Clause
#include "eos/table/strip.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "eos/table/four_points.hpp"
#include "eos/table/hermite_fit.hpp"
#include "src/core/base/error.hpp"

namespace whipple::eos::table {
namespace {

constexpr std::size_t greatest_curve_intervals = 32;
constexpr std::uint32_t greatest_nx = 8, greatest_ny = 32;
constexpr std::uint32_t greatest_fraction_nx = 64, greatest_fraction_ny = 128;
/// Fraction of a region separated by a cut, where the resolution is insufficient.
constexpr double cut_share = 0.1;
/// Maximum number of regions of a strip after cuts, which a point can locate by one comparison.
constexpr std::size_t greatest_cut_regions = 6;
/// Minimum length in ln rho of a halved strip: remaining errors are reported by the verification.
constexpr double least_length = 0.01;
/// Distance inside their region at which phase fractions are sampled.
constexpr double inset = 1e-6;

class StripFit {
 public:
  StripFit(const Sampler& sampler, const StripTask& task, const TableData& constants, double error)
      : sampler_(sampler), task_(task), constants_(constants), error_(error) {
    bottom_ = std::log(constants.thermal_energy);
    may_split_ = !task.last_attempt && task.end - task.begin > least_length;
  }

  FittedStrip run() {
    FittedStrip& f = result_;
    isochore_phases_ = sampler_.isochore(0.5 * (task_.first_sample + task_.last_sample)).phases;
    f.phases = isochore_phases_;
    for (const Cut& cut : task_.cuts)
      f.phases.insert(f.phases.begin() + static_cast<std::ptrdiff_t>(cut.region), f.phases[cut.region]);
    if (f.phases.size() > TableData::greatest_regions) {
      std::string names;
      for (const std::string_view phase : f.phases) names += fmt::format(" {};", phase);
      throw InputError(
          fmt::format("table: more than {} phases on one isochore:{}", TableData::greatest_regions, names));
    }
    f.strip.begin = task_.begin;
    f.strip.end = task_.end;
    f.strip.inverse_length = 1 / (task_.end - task_.begin);
    f.strip.region_count = static_cast<std::uint32_t>(f.phases.size());
    const double first_top = sampler_.isochore(task_.first_sample).top;
    const double last_top = sampler_.isochore(task_.last_sample).top;
    f.strip.top = first_top;
    f.strip.top_slope = (last_top - first_top) / (task_.end - task_.begin);
    if (!fit_curves()) return {};
    for (std::size_t k = 0; k < f.phases.size(); ++k) {
      if (!fit_region(k)) return without_convergence();
      fit_fractions(k);
    }
    f.converged = true;
    return std::move(f);
  }

 private:
  [[nodiscard]] double x_at(double t) const {
    return std::clamp(task_.begin + t * (task_.end - task_.begin), task_.first_sample, task_.last_sample);
  }

  [[nodiscard]] FittedStrip without_convergence() const {
    FittedStrip none;
    none.cut = result_.cut;
    none.miss = result_.miss;
    return none;
  }

  // ---- curves

  /// Returns the edges of the phases, and the cuts.
  [[nodiscard]] std::vector<double> inner_edges(const Isochore& isochore) const {
    std::vector<double> all = {bottom_};
    all.insert(all.end(), isochore.edges.begin(), isochore.edges.end());
    all.push_back(isochore.top);
    for (const Cut& cut : task_.cuts) {
      const double low = all[cut.region], high = all[cut.region + 1];
      all.insert(all.begin() + static_cast<std::ptrdiff_t>(cut.region) + 1, low + cut.share * (high - low));
    }
    return {all.begin() + 1, all.end() - 1};
  }

  static constexpr std::size_t row_length = std::tuple_size_v<CurveNumbers>;

  /// Returns edges at infinity.
  static TableData::Interval no_curves() {
    TableData::Interval interval{};
    interval[0] = broadcast(1e300);
    return interval;
  }

  [[nodiscard]] std::vector<TableData::Interval> curve_intervals(std::size_t cells) const {
    const std::size_t samples = HermiteFit::sample_intervals(cells);
    std::vector<CurveNumbers> values;
    for (std::size_t i = 0; i <= samples; ++i) {
      const Isochore isochore =
          sampler_.isochore(x_at(static_cast<double>(i) / static_cast<double>(samples)));
      // A region that ends at the boundary of a segment is missing there: the strip is halved.
      if (isochore.phases != isochore_phases_) return {};
      CurveNumbers& row = values.emplace_back();
      row[0] = isochore.base_energy;
      std::ranges::copy(inner_edges(isochore), row.begin() + 1);
    }
    const std::size_t blocks = result_.strip.blocks();
    std::vector<TableData::Interval> intervals(blocks * cells, no_curves());
    const HermiteFit fit(cells);
    std::vector<double> coefficients(6 * cells);
    for (std::size_t curve = 0; curve < result_.phases.size(); ++curve) {
      fit(values[0].data() + curve, row_length, coefficients.data(), 1);
      for (std::size_t i = 0; i < cells; ++i) {
        for (std::size_t j = 0; j < 6; ++j)
          intervals[blocks * i + curve / 4][j][curve % 4] = coefficients[6 * i + j];
      }
    }
    return intervals;
  }

  /// Doubles the intervals until slopes of the curves change by little.
  bool fit_curves() {
    TableData coarse, fine;
    coarse.intervals = curve_intervals(1);
    if (coarse.intervals.empty()) return !may_split_ && coarsest_curves();
    for (std::size_t n = 1;; n *= 2) {
      fine.intervals = curve_intervals(2 * n);
      if (fine.intervals.empty()) return !may_split_ && coarsest_curves();
      TableData::Strip a = result_.strip, b = a;
      a.intervals = static_cast<std::uint32_t>(n);
      b.intervals = static_cast<std::uint32_t>(2 * n);
      double worst = 0;
      for (std::size_t i = 0; i < 8 * n; ++i) {
        const double tx = (static_cast<double>(i) + 0.5) / static_cast<double>(8 * n);
        const double x = a.begin + (a.end - a.begin) * tx;
        const Curves ca = curves(coarse, a, tx), cb = curves(fine, b, tx);
        // de_0/dx is -p V of the cold curve: measured on the scale of a pressure of rho c^2/100.
        const State s = sampler_.state(x, cb.value[0] + 2 * constants_.thermal_energy);
        const double scale = pressure_scale(cb.slope[0], 1.0, s.sound_speed * s.sound_speed,
                                            soft_square(sampler_.reference_sound_speed()));
        worst = std::max(worst, std::abs(ca.slope[0] - cb.slope[0]) / (0.02 * error_ * scale));
        worst = std::max(worst, std::abs(ca.curvature[0] - cb.curvature[0]) /
                                    (error_ * (std::abs(cb.curvature[0]) + s.sound_speed * s.sound_speed)));
        for (std::size_t k = 1; k < result_.phases.size(); ++k)
          worst = std::max(worst, std::abs(ca.value[k] - cb.value[k]) / (0.02 * error_));
      }
      if (worst < 1 || (!may_split_ && 2 * n >= greatest_curve_intervals)) {
        result_.strip.intervals = static_cast<std::uint32_t>(n);
        result_.intervals = std::move(coarse.intervals);
        data_.intervals = result_.intervals;
        return true;
      }
      if (2 * n >= greatest_curve_intervals) return false;
      coarse.intervals = std::move(fine.intervals);
    }
  }

  /// Fits, as a last resort, a strip too thin to be halved that contains the end of a region: the curves of its
  /// densest state with the phases of the strip, constant along it.
  bool coarsest_curves() {
    const Isochore isochore = sampler_.isochore(0.5 * (task_.first_sample + task_.last_sample));
    const double low = sampler_.base_energy(task_.first_sample),
                 high = sampler_.base_energy(task_.last_sample);
    std::vector<TableData::Interval> blocks(result_.strip.blocks(), no_curves());
    blocks[0][0][0] = low;
    blocks[0][1][0] = high - low;
    const std::vector<double> inner = inner_edges(isochore);
    for (std::size_t k = 1; k <= inner.size(); ++k) blocks[k / 4][0][k % 4] = inner[k - 1];
    result_.intervals = data_.intervals = blocks;
    result_.strip.intervals = 1;
    return true;
  }

  // ---- entropy

  struct Patch {
    std::uint32_t nx, ny;
    std::vector<double> cells;
  };

  [[nodiscard]] Curves edges_at(double x, Curves& base) const {
    base = curves(data_, result_.strip, (x - task_.begin) / (task_.end - task_.begin));
    return edges(result_.strip, x, bottom_, base);
  }

  /// Returns the entropy at z in a region. The fitted curves deviate from the edges by their error, and s may jump
  /// there (a model with discontinuous phases): a state of another phase is replaced by one slightly nearer to the
  /// middle.
  [[nodiscard]] double entropy(std::size_t region, double x, double base, double z, double middle) const {
    const double energy = std::exp(z);
    for (double share = 0; share < 0.01; share = std::max(1e-12, 4 * share)) {
      const double near = base + std::exp(z + share * (middle - z));
      const State s = sampler_.state(x, near);
      if (s.phase == result_.phases[region])
        return s.specific_entropy + (base + energy - near) / s.temperature;
    }
    return sampler_.state(x, base + energy).specific_entropy;
  }

  [[nodiscard]] Patch fit_patch(std::size_t region, std::uint32_t nx, std::uint32_t ny) const {
    const std::size_t mx = HermiteFit::sample_intervals(nx), my = HermiteFit::sample_intervals(ny);
    std::vector<double> samples((mx + 1) * (my + 1));
    for (std::size_t i = 0; i <= mx; ++i) {
      const double x = x_at(static_cast<double>(i) / static_cast<double>(mx));
      Curves base;
      const Curves edge = edges_at(x, base);
      const double low = edge.value[region], width = edge.value[region + 1] - low;
      for (std::size_t j = 0; j <= my; ++j) {
        const double z = low + width * static_cast<double>(j) / static_cast<double>(my);
        samples[i * (my + 1) + j] = entropy(region, x, base.value[0], z, low + 0.5 * width);
      }
    }
    // Fit along x for every energy, then along y for every coefficient.
    const HermiteFit along_x(nx), along_y(ny);
    std::vector<double> rows(6 * nx * (my + 1));
    for (std::size_t j = 0; j <= my; ++j) along_x(samples.data() + j, my + 1, rows.data() + j, my + 1);
    Patch patch{nx, ny, std::vector<double>(std::size_t{nx} * ny * TableData::cell_size)};
    std::vector<double> column(6 * ny);
    for (std::size_t i = 0; i < nx; ++i) {
      for (std::size_t power = 0; power < 6; ++power) {
        along_y(rows.data() + (6 * i + power) * (my + 1), 1, column.data(), 1);
        for (std::size_t j = 0; j < ny; ++j) {
          std::copy_n(column.begin() + static_cast<std::ptrdiff_t>(6 * j), 6,
                      patch.cells.begin() +
                          static_cast<std::ptrdiff_t>((i * ny + j) * TableData::cell_size + 6 * power));
        }
      }
    }
    return patch;
  }

  [[nodiscard]] Thermal<double> evaluate(const Patch& patch, std::size_t region, double tx, double y,
                                         const Curves& base, const Curves& edge, double rho) const {
    const double px = tx * patch.nx, py = y * patch.ny;
    const auto i = static_cast<std::size_t>(std::clamp(px, 0.0, patch.nx - 1.0));
    const auto j = static_cast<std::size_t>(std::clamp(py, 0.0, patch.ny - 1.0));
    Polynomial<double> s = polynomial(patch.cells.data() + (i * patch.ny + j) * TableData::cell_size,
                                      px - static_cast<double>(i), py - static_cast<double>(j));
    const double by_x = patch.nx / (task_.end - task_.begin), by_y = patch.ny;
    s = {s.x * by_x, s.y * by_y, s.xx * by_x * by_x, s.xy * by_x * by_y, s.yy * by_y * by_y};
    const double width = std::max(edge.value[region + 1] - edge.value[region], least_width);
    const double z = edge.value[region] + y * width;
    return thermal<double>(
        rho,
        slopes<double>(s, {y, 1 / width, std::exp(-z), base.slope[0], base.curvature[0], edge.slope[region],
                           edge.curvature[region], edge.slope[region + 1] - edge.slope[region],
                           edge.curvature[region + 1] - edge.curvature[region]}));
  }

  /// Holds the maximum difference of two patches over the tolerance, and its position in y. Where p passes through
  /// zero between two probes, the tolerance is that of p = 0.
  struct Difference {
    double worst = 0, y = 0;
  };
  [[nodiscard]] Difference difference(const Patch& a, const Patch& b, std::size_t region) const {
    // Probe near the edges of the cells as well: the one-sided differences of the outermost cells are the least
    // accurate.
    constexpr std::array<double, 4> probes = {0.03, 0.35, 0.65, 0.97};
    const std::size_t nx = std::min(a.nx, b.nx), ny = std::min(a.ny, b.ny);
    const auto place = [&](std::size_t i, std::size_t cells) {
      return (static_cast<double>(i / probes.size()) + probes[i % probes.size()]) /
             static_cast<double>(cells);
    };
    const double least = constants_.least_sound_speed, soft = soft_square(sampler_.reference_sound_speed());
    Difference result;
    for (std::size_t i = 0; i < probes.size() * nx; ++i) {
      const double tx = place(i, nx);
      const double x = x_at(tx), rho = std::exp(x);
      Curves base;
      const Curves edge = edges_at(x, base);
      double below = INFINITY;  // pressure at the previous probe
      for (std::size_t j = 0; j < probes.size() * ny; ++j) {
        const double y = place(j, ny);
        const auto sa = evaluate(a, region, tx, y, base, edge, rho),
                   sb = evaluate(b, region, tx, y, base, edge, rho);
        const double ca = std::max(sa.squared_sound_speed, least * least);
        const double cb = std::max(sb.squared_sound_speed, least * least);
        const double p = sb.pressure;
        if (j == 0) below = p;
        const double least_pressure = p * below > 0 ? std::min(std::abs(p), std::abs(below)) : 0.0;
        const double miss =
            std::max({std::abs(sa.temperature / sb.temperature - 1) / error_,
                      std::abs(sa.pressure - p) / (error_ * pressure_scale(least_pressure, rho, cb, soft)),
                      std::abs(ca - cb) / (20 * error_ * (cb + soft))});
        below = p;
        if (!(miss <= result.worst)) result = {miss, y};
      }
    }
    return result;
  }

  bool fit_region(std::size_t region) {
    constexpr double safety = 0.2;
    std::uint32_t nx = 1, ny = 1;
    Patch present = fit_patch(region, nx, ny);
    double last_x = INFINITY, last_y = INFINITY;  // differences before the last doubling in that direction
    // In a thin region the round-off of the entropies, divided by its height, limits the gain from refinement.
    const auto good = [&](double now, double last) {
      return now < safety || (now < 0.5 && now > 0.5 * last);
    };
    for (;;) {
      const bool wider = nx < greatest_nx, higher = ny < greatest_ny;
      const Patch fine_x = fit_patch(region, 2 * nx, ny), fine_y = fit_patch(region, nx, 2 * ny);
      const Difference along_y = difference(present, fine_y, region);
      const double by_x = difference(present, fine_x, region).worst, by_y = along_y.worst;
      const bool good_x = good(by_x, last_x), good_y = good(by_y, last_y);
      if (good_x && good_y) break;
      if (by_y >= 1 && !higher && may_split_ && result_.phases.size() < greatest_cut_regions) {
        result_.cut = Cut{region, along_y.y > 0.5 ? 1 - cut_share : cut_share};
        return false;
      }
      if (by_x >= 1 && !wider && may_split_) return false;
      // Shorter strips reduce the error along y only if edges are curved; if the halves of a strip are no better,
      // they are kept and the verification counts the states beyond the request.
      if (by_y >= 1 && !higher && may_split_ && by_y < 0.5 * task_.miss_of_whole) {
        result_.miss = by_y;
        return false;
      }
      const bool double_x = !good_x && wider && by_x >= 0.1 * by_y;
      const bool double_y = !good_y && higher && by_y >= 0.1 * by_x;
      if (!double_x && !double_y) break;
      if (double_x) nx *= 2, last_x = by_x;
      if (double_y) ny *= 2, last_y = by_y;
      present = double_x && double_y ? fit_patch(region, nx, ny) : double_x ? fine_x : fine_y;
    }
    TableData::Region& r = result_.strip.regions[region];
    r.first_cell = static_cast<std::uint32_t>(result_.cells.size() / TableData::cell_size);
    r.nx = nx;
    r.ny = ny;
    result_.cells.insert(result_.cells.end(), present.cells.begin(), present.cells.end());
    return true;
  }

  // ---- phase fractions

  [[nodiscard]] std::array<double, 2> fractions_at(std::size_t region, double tx, double y) const {
    const double x = x_at(tx);
    Curves base;
    const Curves edge = edges_at(x, base);
    const double z =
        edge.value[region] + std::clamp(y, inset, 1 - inset) * (edge.value[region + 1] - edge.value[region]);
    const State s = sampler_.state(x, base.value[0] + std::exp(z));
    return {s.melted_fraction, s.vaporised_fraction};
  }

  struct FractionPatch {
    std::uint32_t nx, ny;
    std::vector<std::array<double, 2>> corners;
    double mean = 0, worst = 0;
  };

  [[nodiscard]] FractionPatch fit_fraction_patch(std::size_t region, std::uint32_t nx,
                                                 std::uint32_t ny) const {
    FractionPatch patch{nx, ny, {}};
    for (std::uint32_t i = 0; i <= nx; ++i) {
      for (std::uint32_t j = 0; j <= ny; ++j)
        patch.corners.push_back(
            fractions_at(region, static_cast<double>(i) / nx, static_cast<double>(j) / ny));
    }
    for (std::uint32_t i = 0; i < nx; ++i) {
      for (std::uint32_t j = 0; j < ny; ++j) {
        // Probe off centre, where saddles would not be detected.
        const auto exact = fractions_at(region, (i + 0.4) / nx, (j + 0.45) / ny);
        const std::size_t corner = i * (ny + 1) + j;
        for (std::size_t k = 0; k < 2; ++k) {
          const double low = patch.corners[corner][k] * 0.55 + patch.corners[corner + 1][k] * 0.45;
          const double high =
              patch.corners[corner + ny + 1][k] * 0.55 + patch.corners[corner + ny + 2][k] * 0.45;
          const double miss = std::abs(0.6 * low + 0.4 * high - exact[k]);
          patch.mean += miss / (2.0 * nx * ny);
          patch.worst = std::max(patch.worst, miss);
        }
      }
    }
    return patch;
  }

  void fit_fractions(std::size_t region) {
    FractionPatch present = fit_fraction_patch(region, 2, 2);
    if (present.worst == 0.0) present = fit_fraction_patch(region, 4, 8);
    if (present.worst == 0.0) {
      present = fit_fraction_patch(region, 1, 1);
    } else {
      while (present.mean > 3 * error_) {
        FractionPatch wide, high;
        wide.mean = high.mean = INFINITY;
        if (present.nx < greatest_fraction_nx) wide = fit_fraction_patch(region, 2 * present.nx, present.ny);
        if (present.ny < greatest_fraction_ny) high = fit_fraction_patch(region, present.nx, 2 * present.ny);
        if (std::isinf(wide.mean) && std::isinf(high.mean)) break;
        present = wide.mean < high.mean ? std::move(wide) : std::move(high);
      }
    }
    TableData::Region& r = result_.strip.regions[region];
    r.first_fraction = static_cast<std::uint32_t>(result_.fractions.size());
    r.fraction_nx = present.nx;
    r.fraction_ny = present.ny;
    for (const auto& corner : present.corners) {
      result_.fractions.push_back({static_cast<std::uint16_t>(std::lround(65535 * corner[0])),
                                   static_cast<std::uint16_t>(std::lround(65535 * corner[1]))});
    }
  }

  const Sampler& sampler_;
  const StripTask& task_;
  const TableData& constants_;
  double error_;
  double bottom_ = 0;
  bool may_split_ = false;
  std::vector<std::string_view> isochore_phases_;  ///< before cuts
  TableData data_;  ///< holds the intervals of the strip for the functions of the kernel
  FittedStrip result_;
};

}  // namespace

FittedStrip fit_strip(const Sampler& sampler, const StripTask& task, const TableData& constants,
                      double error) {
  return StripFit(sampler, task, constants, error).run();
}

void append(TableData& data, const FittedStrip& fitted) {
  TableData::Strip strip = fitted.strip;
  strip.first_interval = static_cast<std::uint32_t>(data.intervals.size());
  for (std::size_t k = 0; k < strip.region_count; ++k) {
    TableData::Region& r = strip.regions[k];
    r.first_cell += static_cast<std::uint32_t>(data.cells.size() / TableData::cell_size);
    r.first_fraction += static_cast<std::uint32_t>(data.fractions.size());
    const auto name = std::ranges::find(data.phases, fitted.phases[k]);
    r.phase = static_cast<std::uint32_t>(name - data.phases.begin());
    if (name == data.phases.end()) data.phases.emplace_back(fitted.phases[k]);
  }
  data.strips.push_back(strip);
  data.intervals.insert(data.intervals.end(), fitted.intervals.begin(), fitted.intervals.end());
  data.cells.insert(data.cells.end(), fitted.cells.begin(), fitted.cells.end());
  data.fractions.insert(data.fractions.end(), fitted.fractions.begin(), fitted.fractions.end());
}

}  // namespace whipple::eos::table
