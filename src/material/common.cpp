// SPDX-License-Identifier: BSD-3-Clause
#include "src/material/common.hpp"

#include <algorithm>
#include <cmath>

#include "src/core/base/vector_math.hpp"
#include "src/material/viscosity_formulas.hpp"
#include "src/material/volume_formulas.hpp"

namespace whipple::material {
namespace {

using formulas::greatest_density_ratio;
using formulas::greatest_volume_ratio;
using formulas::least_density_ratio;
using formulas::least_volume_ratio;

/// Limits points to the maximum density of their equation of state, and counts them.
WHIPPLE_KERNEL void hold_below_greatest_density(const Step& step, Chunk& chunk) {
  const Constitutive& model = *step.material.constitutive;
  const double lowest = model.least_maximum_density(step.material);
  const double per_lowest = 1.0 / (greatest_density_ratio * lowest);
  std::size_t beyond = 0;
  for (std::size_t k = 0; k < chunk.size; ++k) beyond += chunk.volume[k] < chunk.mass[k] * per_lowest ? 1 : 0;
  if (beyond == 0) return;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const double greatest = model.maximum_density(step.material, chunk, k);
    const double least = chunk.mass[k] / (greatest_density_ratio * greatest);
    if (!(chunk.volume[k] < least)) continue;
    chunk.volume_change[k] += least - chunk.volume[k];
    chunk.volume[k] = least;
    ++chunk.report.squeezed;
    chunk.report.squeezed_mass += chunk.mass[k];
    chunk.report.first_squeezed = std::min(chunk.report.first_squeezed, chunk.index[k]);
  }
}

}  // namespace

WHIPPLE_KERNEL void advance_volume(const Step& step, Chunk& chunk) {
  Lanes limited;
  volume_change(padded(chunk.size), step.settings.time_step, chunk.motion);
  const double per_least_density = 1.0 / (least_density_ratio * step.material.reference.density);
  std::size_t beyond = 0, undefined = 0, thinnest = 0;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const double ratio = chunk.motion.ratio[k];
    const double room = std::max(chunk.old_density[k] * per_least_density, 1.0);
    limited[k] = formulas::limited_ratio(ratio, room);
    beyond += ratio < least_volume_ratio || ratio > greatest_volume_ratio ? 1 : 0;
    thinnest += std::min(ratio, greatest_volume_ratio) > room ? 1 : 0;
    chunk.volume_change[k] = chunk.old_volume[k] * (limited[k] - 1.0);
    chunk.volume[k] = chunk.old_volume[k] * limited[k];
  }
  chunk.report.points += chunk.size;
  for (std::size_t k = 0; k < chunk.size; ++k) chunk.report.mass += chunk.mass[k];
  chunk.report.limited_volume_changes += beyond;
  chunk.report.limited_densities += thinnest;
  if (chunk.any_void) {
    Lanes share;
    step.material.constitutive->void_share(chunk, share);
    for (std::size_t k = 0; k < chunk.size; ++k) {
      const bool open = chunk.void_volume[k] > 0.0;
      const double before = chunk.old_volume[k] + chunk.void_volume[k], total = before * limited[k];
      const double matter = formulas::volume_beside_void(chunk.old_volume[k], share[k], before, total);
      chunk.volume[k] = open ? matter : chunk.volume[k];
      chunk.void_volume[k] = open ? total - matter : chunk.void_volume[k];
    }
  }
  hold_below_greatest_density(step, chunk);
  if (chunk.any_failed) {
    // The material of a point is strained like the total volume; in failed material the pressure does work on
    // the change of the volume of the material only.
    for (std::size_t k = 0; k < chunk.size; ++k) {
      const double own = chunk.volume[k] - chunk.old_volume[k];
      chunk.volume_change[k] = chunk.intact[k] == 0.0 ? own : chunk.volume_change[k];
    }
  }
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const double sum = chunk.specific_internal_energy[k] + chunk.volume[k];
    undefined += !(chunk.volume[k] > 0.0) || !std::isfinite(sum) ? 1 : 0;
  }
  if (undefined == 0) return;
  chunk.report.undefined += undefined;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const double sum = chunk.specific_internal_energy[k] + chunk.volume[k];
    if (chunk.volume[k] > 0.0 && std::isfinite(sum)) continue;
    chunk.report.first_undefined = std::min(chunk.report.first_undefined, chunk.index[k]);
  }
}

namespace {

/// Computes the part of the artificial viscosity whose work is heat.
WHIPPLE_KERNEL void find_heating_viscosity(const Step& step, Chunk& chunk) {
  const UpdateSettings& settings = step.settings;
  const double per_initial = 1.0 / settings.initial_density;
  const double per_range = 1.0 / settings.affine_compression;
  const auto find = [&](const auto& length) {
    for (std::size_t k = 0; k < chunk.size; ++k) {
      chunk.heating_viscosity[k] = formulas::heating_viscosity(
          settings, length(k), chunk.motion.divergence[k], step.affine_divergence[k], chunk.density[k],
          chunk.sound_speed[k], chunk.intact[k] != 0.0, chunk.artificial_viscosity[k], per_initial,
          per_range);
    }
  };
  if (settings.lengths.empty()) {
    find([&](std::size_t) { return settings.cell_size; });
  } else {
    find([&](std::size_t k) { return settings.lengths[chunk.index[k]]; });
  }
}

}  // namespace

WHIPPLE_KERNEL void advance_viscosity(const Step& step, Chunk& chunk) {
  const UpdateSettings& settings = step.settings;
  const auto advance = [&](const auto& length) {
    for (std::size_t k = 0; k < chunk.size; ++k) {
      const double closing = -chunk.motion.divergence[k] * length(k);  // l |D|, m/s
      chunk.density[k] = chunk.mass[k] / chunk.volume[k];
      const double viscosity =
          formulas::artificial_viscosity(settings, chunk.density[k], closing, chunk.sound_speed[k]);
      chunk.artificial_viscosity[k] = closing > 0.0 ? viscosity : 0.0;
    }
    if (settings.expansion_viscosity == 0.0) return;
    for (std::size_t k = 0; k < chunk.size; ++k) {
      const double opening = std::max(chunk.motion.divergence[k], 0.0) * length(k);
      chunk.artificial_viscosity[k] -= formulas::expansion_viscosity(settings, chunk.density[k], opening,
                                                                     chunk.sound_speed[k], chunk.pressure[k]);
    }
  };
  if (settings.lengths.empty()) {
    advance([&](std::size_t) { return settings.cell_size; });
  } else {
    advance([&](std::size_t k) { return settings.lengths[chunk.index[k]]; });
  }
  switch (settings.heating) {
    case HeatingViscosity::not_distinguished:
      break;
    case HeatingViscosity::whole:
      chunk.heating_viscosity = chunk.artificial_viscosity;
      break;
    case HeatingViscosity::of_affine_field:
      find_heating_viscosity(step, chunk);
      break;
  }
}

WHIPPLE_KERNEL void work_without_new_pressure(const Step&, Chunk& chunk) {
  for (std::size_t k = 0; k < chunk.size; ++k) {
    double strain_work = 0.0;  // mean stress : strain increment
    for (std::size_t j = 0; j < 6; ++j) {
      const double mean = 0.5 * (chunk.motion.deviator[j][k] + chunk.old_deviator[j][k]);
      strain_work += (j < 3 ? 1.0 : 2.0) * mean * chunk.motion.strain[j][k];
    }
    const double per_mass = 1.0 / chunk.mass[k];
    const double work = strain_work * 0.5 * (chunk.volume[k] + chunk.old_volume[k]) -
                        chunk.volume_change[k] * (0.5 * chunk.pressure[k] + chunk.artificial_viscosity[k]);
    chunk.half_change[k] = 0.5 * chunk.volume_change[k] * per_mass;
    chunk.energy[k] = chunk.specific_internal_energy[k] + work * per_mass;
  }
}

namespace {

WHIPPLE_KERNEL void energy_ahead_of_elastic(const Step& step, Chunk& chunk) {
  energy_ahead(step, chunk, [&](std::size_t k, const SymmetricTensor&, double gained) {
    return gained - chunk.elastic_energy[k];
  });
}

}  // namespace

void solve_energy(const Step& step, const Lanes& elastic_pressure, Chunk& chunk) {
  const auto add_elastic_pressure = [&] {
    for (std::size_t k = 0; k < chunk.size; ++k) chunk.acting_pressure[k] += elastic_pressure[k];
  };
  if (step.energy == Energy::from_grid) {
    energy_ahead_of_elastic(step, chunk);
    evaluate_equation_of_state<false>(step, chunk);
    add_elastic_pressure();
    return;
  }
  chunk.fetch(step.points.deviatoric_stress, chunk.old_deviator);
  strain_increment(padded(chunk.size), step.settings.time_step, step.settings.rotation, chunk.motion.gradient,
                   chunk.motion.strain);
  work_without_new_pressure(step, chunk);
  for (std::size_t k = 0; k < chunk.size; ++k) {
    chunk.energy[k] -=
        chunk.elastic_energy[k] / chunk.density[k] + chunk.half_change[k] * elastic_pressure[k];
  }
  evaluate_equation_of_state<false>(step, chunk);
  add_elastic_pressure();
  for (std::size_t k = 0; k < chunk.size; ++k) {
    chunk.specific_internal_energy[k] = chunk.energy[k] + chunk.elastic_energy[k] / chunk.density[k];
  }
}

WHIPPLE_KERNEL void find_compression_rate(const Step&, Chunk& chunk) {
  const Lanes& divergence = chunk.motion.divergence;
  double rate = chunk.report.compression_rate;
  // Points at a detonation front do not count: the jump of the front compresses them however short the steps are.
  if (chunk.burns) {
    for (std::size_t k = 0; k < chunk.size; ++k) {
      const bool bounds = chunk.acting_pressure[k] > 0.0 && chunk.burning[k] == 0.0;
      rate = std::max(rate, bounds ? -divergence[k] : 0.0);
    }
    chunk.report.compression_rate = rate;
    return;
  }
  for (std::size_t k = 0; k < chunk.size; ++k) {
    rate = std::max(rate, chunk.acting_pressure[k] > 0.0 ? -divergence[k] : 0.0);
  }
  chunk.report.compression_rate = rate;
}

}  // namespace whipple::material
