// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/protocols/refinement.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "md_fitting/data_set/points.hpp"
#include "md_fitting/protocols/replicas.hpp"
#include "src/core/base/error.hpp"

namespace whipple::md {
namespace {

constexpr double agreement = 2.0;

double weighted_error(double n, double first, double m, double second) {
  return std::hypot(n * first, m * second) / (n + m);
}

bool of_replicas(const PointRecord& point) { return point.provenance.contains("replicas"); }

/// Returns the ratio of the error plus its standard error to the stated error of n replicas: a point that stopped
/// as soon as its runs agreed by chance would miss its target.
double uncertain(const PointRecord& point, const std::string& quantity) {
  const auto runs = point.blocks.find(quantity);
  if (!of_replicas(point) || runs == point.blocks.end()) return 1.0;
  return 1.0 + 1.0 / std::sqrt(2.0 * (static_cast<double>(runs->second.size()) - 1.0));
}

}  // namespace

bool wants_more(const PointRecord& point, const Precision& precision) {
  if (!point.done() || precision.quantity.empty() || !(precision.target_error > 0.0)) return false;
  if (point.segments() >= precision.segments) return false;
  const Estimate estimate = point.result(precision.quantity);
  const double scale = precision.relative ? std::abs(estimate.value) : 1.0;
  return uncertain(point, precision.quantity) * estimate.error > precision.target_error * scale;
}

PointRecord join(const PointRecord& point, const PointRecord& segment) {
  if (point.key != segment.key) throw InternalError("segments of different points cannot be joined");
  PointRecord joined = point;
  const auto n = static_cast<double>(point.segments());
  const auto m = static_cast<double>(segment.segments());
  for (auto& [name, estimate] : joined.results) {
    const auto found = segment.results.find(name);
    if (found == segment.results.end()) continue;
    const Estimate& other = found->second;
    if (is_flag(name)) {
      estimate.value = std::min(estimate.value, other.value);
      continue;
    }
    const double difference = std::abs(estimate.value - other.value);
    const double sigma = std::hypot(estimate.error, other.error);
    estimate.value = (n * estimate.value + m * other.value) / (n + m);
    estimate.error = weighted_error(n, estimate.error, m, other.error);
    if (sigma > 0.0 && difference > agreement * sigma) estimate.error *= difference / (agreement * sigma);
  }
  for (auto& [name, means] : joined.blocks) {
    const auto more = segment.blocks.find(name);
    if (more != segment.blocks.end()) means.insert(means.end(), more->second.begin(), more->second.end());
    // Each block is an independent run: together they form one larger set.
    if (of_replicas(joined)) joined.results[name] = replica_mean(means);
  }
  // The correlation of the errors, of energy and the quantity measured with it, is that of the joint covariance.
  const std::string correlation(name_of(&StatePoint::error_correlation));
  if (joined.results.contains(correlation)) {
    const bool of_state = joined.results.contains(std::string(name_of(&StatePoint::pressure)));
    const std::string partner(of_state ? name_of(&StatePoint::pressure)
                                       : name_of(&ZeroPressurePoint::specific_volume));
    const std::string energy(name_of(&StatePoint::specific_internal_energy));
    const auto covariance = [&](const PointRecord& part) {
      return part.result(correlation).value * part.result(partner).error * part.result(energy).error;
    };
    const auto error = [&](const std::string& name) {
      return weighted_error(n, point.result(name).error, m, segment.result(name).error);
    };
    const double sum = (n * n * covariance(point) + m * m * covariance(segment)) / ((n + m) * (n + m));
    if (const double product = error(partner) * error(energy); product > 0.0) {
      joined.results[correlation].value = std::clamp(sum / product, -1.0, 1.0);
    }
  }
  if (!segment.message.empty() && joined.message.find(segment.message) == std::string::npos) {
    joined.message += (joined.message.empty() ? "" : "; ") + segment.message;
  }
  joined.wall_seconds += segment.wall_seconds;
  joined.provenance["segments"] = std::to_string(point.segments() + segment.segments());
  const auto commands = segment.provenance.find("lammps_commands");
  if (commands != segment.provenance.end()) joined.provenance["lammps_commands"] += commands->second;
  return joined;
}

}  // namespace whipple::md
