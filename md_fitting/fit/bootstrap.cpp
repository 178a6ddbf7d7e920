// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/bootstrap.hpp"

#include <fmt/format.h>

#include <cmath>

#include "md_fitting/data_set/data_set.hpp"
#include "src/core/base/error.hpp"

namespace whipple::fit {
namespace {

using Eigen::VectorXd;
using md::PointRecord;

/// Returns the results of a protocol that the fit reads.
const std::vector<std::string>& measured(const std::string& protocol) {
  static const std::map<std::string, std::vector<std::string>, std::less<>> quantities = {
      {"zero_pressure_volume", {"specific_volume"}},
      {"hugoniot", {"pressure"}},
      {"isotherm", {"pressure", "specific_internal_energy"}},
      {"isochore", {"pressure", "specific_internal_energy"}},
      {"coexistence", {"melting_temperature", "solid_specific_volume", "latent_heat"}},
      {"liquid_vapour", {"liquid_density", "vapour_density"}},
  };
  static const std::vector<std::string> none;
  const auto found = quantities.find(protocol);
  return found == quantities.end() ? none : found->second;
}

bool has_blocks(const PointRecord& point) {
  const std::vector<std::string>& names = measured(point.protocol);
  return !names.empty() && point.blocks.contains(names.front());
}

/// Returns the mean over drawn blocks, with its deviation from the overall mean scaled by sqrt(n/(n - 1)): the
/// variance of such means is too small by (n - 1)/n.
double drawn_mean(const std::vector<double>& blocks, const std::vector<std::size_t>& draw, double value) {
  double sum = 0.0;
  double all = 0.0;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    sum += blocks[draw[i]];
    all += blocks[i];
  }
  const auto n = static_cast<double>(blocks.size());
  return value + std::sqrt(n / (n - 1.0)) * (sum - all) / n;
}

void draw_blocks(PointRecord& point, std::mt19937_64& generator) {
  std::size_t count = 0;
  std::vector<std::size_t> draw;
  for (const std::string& name : measured(point.protocol)) {
    const auto blocks = point.blocks.find(name);
    if (blocks == point.blocks.end() || blocks->second.size() < 2) continue;
    if (blocks->second.size() != count) {
      count = blocks->second.size();
      draw.resize(count);
      for (std::size_t& place : draw)
        place = std::uniform_int_distribution<std::size_t>(0, count - 1)(generator);
    }
    md::Estimate& estimate = point.results.at(name);
    estimate.value = drawn_mean(blocks->second, draw, estimate.value);
  }
}

void draw_normal(PointRecord& point, std::mt19937_64& generator) {
  std::normal_distribution<double> normal;
  double first = 0.0;
  for (const std::string& name : measured(point.protocol)) {
    const auto found = point.results.find(name);
    if (found == point.results.end()) continue;
    double deviate = normal(generator);
    if (name == "specific_internal_energy" && point.results.contains("error_correlation")) {
      const double c = point.results.at("error_correlation").value;
      deviate = c * first + std::sqrt(std::fmax(0.0, 1.0 - c * c)) * deviate;
    }
    first = deviate;
    found->second.value += deviate * found->second.error;
  }
}

}  // namespace

std::vector<PointRecord> resampled(std::span<const PointRecord> points, std::mt19937_64& generator) {
  std::vector<PointRecord> drawn(points.begin(), points.end());
  for (PointRecord& point : drawn) {
    if (!point.done()) continue;
    const double before = point.kind() == md::PointKind::hugoniot ? point.result("pressure").value : 0.0;
    if (has_blocks(point)) {
      draw_blocks(point, generator);
    } else {
      draw_normal(point, generator);
    }
    if (point.kind() == md::PointKind::hugoniot) {
      // By the jump conditions, Us and up are proportional to the square root of the pressure.
      const double factor = std::sqrt(std::fmax(0.0, point.result("pressure").value / before));
      point.results.at("shock_velocity").value *= factor;
      point.results.at("particle_velocity").value *= factor;
    }
  }
  return drawn;
}

BootstrapResult bootstrap(std::span<const PointRecord> points, int replicates, std::uint64_t seed,
                          const std::function<VectorXd(std::span<const PointRecord>)>& fit) {
  if (replicates < 2) throw InputError("a bootstrap needs two replicates or more");
  BootstrapResult result;
  for (const PointRecord& point : points) {
    if (!point.done() || measured(point.protocol).empty()) continue;
    ++(has_blocks(point) ? result.points_with_blocks : result.points_without);
  }
  std::mt19937_64 generator(seed);
  std::vector<VectorXd> constants;
  for (int i = 0; i < replicates; ++i) {
    const std::vector<PointRecord> drawn = resampled(points, generator);
    try {
      constants.push_back(fit(drawn));
    } catch (const StateError&) {
      ++result.failed;
    } catch (const InputError&) {
      ++result.failed;
    }
  }
  result.replicates = static_cast<int>(constants.size());
  if (2 * result.replicates <= replicates || result.replicates < 2) {
    throw StateError(
        fmt::format("bootstrap: {} of {} replicates could not be fitted", result.failed, replicates));
  }
  result.mean = VectorXd::Zero(constants.front().size());
  for (const VectorXd& one : constants) result.mean += one / result.replicates;
  result.covariance = Eigen::MatrixXd::Zero(result.mean.size(), result.mean.size());
  for (const VectorXd& one : constants) {
    const VectorXd deviation = one - result.mean;
    result.covariance += deviation * deviation.transpose() / (result.replicates - 1);
  }
  return result;
}

}  // namespace whipple::fit
