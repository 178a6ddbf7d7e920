// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/bootstrap.hpp"

#include <fmt/format.h>

#include <cmath>

#include "md_fitting/data_set/points.hpp"
#include "src/core/base/error.hpp"

namespace whipple::fit {
namespace {

using Eigen::VectorXd;
using md::CoexistencePoint;
using md::HugoniotPoint;
using md::LiquidVapourPoint;
using md::PointRecord;
using md::StatePoint;
using md::ZeroPressurePoint;

const std::string energy_name(md::name_of(&StatePoint::specific_internal_energy));
const std::string correlation_name(md::name_of(&StatePoint::error_correlation));

template <class... Member>
std::vector<std::string> names_of(Member... member) {
  return {std::string(md::name_of(member))...};
}

/// Returns the results of a protocol that the fit reads.
const std::vector<std::string>& measured(const std::string& protocol) {
  const auto state = [] { return names_of(&StatePoint::pressure, &StatePoint::specific_internal_energy); };
  static const std::map<std::string_view, std::vector<std::string>> quantities = {
      {ZeroPressurePoint::protocol, names_of(&ZeroPressurePoint::specific_volume)},
      {HugoniotPoint::protocol, names_of(&HugoniotPoint::pressure)},
      {word_of(md::PointKind::isotherm), state()},
      {word_of(md::PointKind::isochore), state()},
      {CoexistencePoint::protocol,
       names_of(&CoexistencePoint::melting_temperature, &CoexistencePoint::solid_specific_volume,
                &CoexistencePoint::latent_heat)},
      {LiquidVapourPoint::protocol,
       names_of(&LiquidVapourPoint::liquid_density, &LiquidVapourPoint::vapour_density)},
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
    if (name == energy_name && point.results.contains(correlation_name)) {
      const double c = point.results.at(correlation_name).value;
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
    const bool shock = point.kind() == md::PointKind::hugoniot;
    const double before = shock ? md::required(point, &HugoniotPoint::pressure).value : 0.0;
    if (has_blocks(point)) {
      draw_blocks(point, generator);
    } else {
      draw_normal(point, generator);
    }
    if (shock) {
      // By the jump conditions, Us and up are proportional to the square root of the pressure.
      const double pressure = md::required(point, &HugoniotPoint::pressure).value;
      const double factor = std::sqrt(std::fmax(0.0, pressure / before));
      for (const auto member : {&HugoniotPoint::shock_velocity, &HugoniotPoint::particle_velocity}) {
        point.results.at(std::string(md::name_of(member))).value *= factor;
      }
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
