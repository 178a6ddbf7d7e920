// SPDX-License-Identifier: BSD-3-Clause
#include "src/quasi_static/response.hpp"

#include <algorithm>
#include <utility>

#include "src/quasi_static/loops.hpp"

namespace whipple::quasi_static {

Response::Response(const Particles& before, std::vector<Group> groups, int strains)
    : before_(before),
      groups_(std::move(groups)),
      strains_(strains),
      reports_(groups_.size()),
      gradient_(before.size()),
      moved_(before.size()) {}

/// Updates the trial state of a group from that of the beginning.
MaterialReport Response::update(std::span<const Matrix3> f, const Group& group) {
  const double dt = group.settings.time_step;
  constexpr std::size_t points = 1024;
  std::vector<MaterialReport> of_chunk((group.count + points - 1) / points);
  const auto update_chunk = [&](std::size_t chunk) {
    const std::size_t first = group.first + chunk * points,
                      last = std::min(first + points, group.first + group.count);
    for (std::size_t p = first; p < last; ++p) gradient_[p] = (f[p] - Matrix3::Identity()) / dt;
    of_chunk[chunk] =
        update_material_and_energy(*group.material, trial_, first, last,
                                   std::span(gradient_).subspan(first, last - first), group.settings);
  };
  if (of_chunk.size() < 4) {
    for (std::size_t chunk = 0; chunk < of_chunk.size(); ++chunk) update_chunk(chunk);
  } else {
    parallel::for_each_uneven(of_chunk.size(), update_chunk);
  }
  MaterialReport sum;
  for (const MaterialReport& report : of_chunk) sum.merge(report);
  return sum;
}

/// Updates the trial state of groups. @returns their reports
std::vector<MaterialReport> Response::update(std::span<const Matrix3> f, std::span<const Group> groups) {
  trial_ = static_cast<const MaterialPoints&>(before_);
  std::vector<MaterialReport> reports;
  for (const Group& group : groups) reports.push_back(update(f, group));
  return reports;
}

void Response::collect(const MaterialPoints& points, std::span<const Matrix3> f,
                       std::span<double> forces) const {
  const auto m = static_cast<std::size_t>(strains_);
  for_each(before_.size(), [&](std::size_t p) {
    Matrix3 stress = points.deviatoric_stress[p].matrix();
    stress.diagonal().array() -= points.pressure[p];
    const Matrix3 force = points.volume[p] * stress * f[p].inverse().transpose();
    for (std::size_t k = 0; k < m; ++k) {
      const auto [row, column] = component(strains_, static_cast<int>(k));
      forces[m * p + k] = force(row, column);
    }
  });
}

void Response::at_beginning(std::span<double> forces) const {
  collect(before_, std::vector<Matrix3>(before_.size(), Matrix3::Identity()), forces);
}

bool Response::evaluate(std::span<const Matrix3> f, std::span<double> forces) {
  reports_ = update(f, groups_);
  collect(trial_, f, forces);
  if (!std::ranges::all_of(forces, [](double x) { return std::isfinite(x); })) return false;
  return std::ranges::all_of(reports_, [](const MaterialReport& report) {
    return report.valid() && report.limited_volume_changes == 0 && report.limited_densities == 0;
  });
}

void Response::tangents(std::span<const Matrix3> f, std::span<const double> forces, std::span<double> out) {
  update(f, groups_);
  std::vector<Group> others;
  for (const Group& group : groups_) {
    if (!closed_tangents(group, before_, trial_, f, strains_, out)) others.push_back(group);
  }
  if (!others.empty()) differences(f, forces, others, out);
}

void Response::differences(std::span<const Matrix3> f, std::span<const double> forces,
                           std::span<const Group> groups, std::span<double> out) {
  constexpr double step = 1e-7;  // the root of the precision, within a factor of 10
  const auto m = static_cast<std::size_t>(strains_);
  std::vector<double> beside(forces.size());
  for (std::size_t k = 0; k < m; ++k) {
    std::ranges::copy(f, moved_.begin());
    const auto [row, column] = component(strains_, static_cast<int>(k));
    for (Matrix3& moved : moved_) moved(row, column) += step;
    update(moved_, groups);
    collect(trial_, moved_, beside);
    for (const Group& group : groups) {
      for_each(group.count, [&](std::size_t in_group) {
        const std::size_t p = group.first + in_group;
        for (std::size_t i = 0; i < m; ++i)
          out[(m * p + i) * m + k] = (beside[m * p + i] - forces[m * p + i]) / step;
      });
    }
  }
}

}  // namespace whipple::quasi_static
