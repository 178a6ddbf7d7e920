// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "src/core/base/vector_math.hpp"
#include "src/material/eos_strength/parts.hpp"

namespace whipple::material::parts {
namespace {

template <bool phases>
void evaluate_distended(const EosStrength& model, const Step& in, Chunk& out) {
  Lanes& distension = out.history[model.distension];
  std::copy_n(distension.data(), out.size, out.old_distension.data());
  const Lanes before = out.pressure;
  evaluate_equation_of_state<phases>(in, out, out.view(distension));
  double heat = 0.0;  // of pores that were crushed: the work of the pressure on their volume
  for (std::size_t k = 0; k < out.size; ++k) {
    if (distension[k] == out.old_distension[k]) continue;
    const double crushed = std::log(out.old_distension[k] / distension[k]);
    heat += 0.5 * (before[k] + out.pressure[k]) * crushed * out.volume[k];
  }
  out.report.plastic_heat += heat;
}

}  // namespace

void free_failed(const EosStrength&, const Step&, Chunk& out) {
  if (!out.any_failed || !out.any_void) return;
  for (std::size_t k = 0; k < out.size; ++k) {
    const bool loose = out.intact[k] == 0.0;
    out.artificial_viscosity[k] = loose && out.void_volume[k] > 0.0 ? 0.0 : out.artificial_viscosity[k];
  }
}

void free_brittle(const EosStrength&, const Step&, Chunk& out) {
  if (!out.any_void) return;
  for (std::size_t k = 0; k < out.size; ++k) {
    out.artificial_viscosity[k] = out.void_volume[k] > 0.0 ? 0.0 : out.artificial_viscosity[k];
  }
}

WHIPPLE_KERNEL void energy_from_grid(const EosStrength&, const Step& in, Chunk& out) {
  energy_ahead(in, out, [&](std::size_t k, const SymmetricTensor& s, double gained) {
    const double modulus = out.motion.modulus[k];
    const double elastic = s.squared_norm() / (4.0 * (modulus > 0.0 ? modulus : 1.0));
    return modulus > 0.0 ? gained - elastic : gained;
  });
}

void energy_by_work(const EosStrength&, const Step& in, Chunk& out) { work_without_new_pressure(in, out); }

void take_cold_work(const EosStrength& model, const Step&, Chunk& out) {
  const Lanes& stored = out.history[model.stored_cold_work];
  for (std::size_t k = 0; k < out.size; ++k) out.energy[k] -= stored[k];
}

void evaluate_simple(const EosStrength&, const Step& in, Chunk& out) {
  evaluate_equation_of_state<false>(in, out);
}

void evaluate_phases(const EosStrength&, const Step& in, Chunk& out) {
  evaluate_equation_of_state<true>(in, out);
}

void evaluate_porous(const EosStrength& model, const Step& in, Chunk& out) {
  evaluate_distended<false>(model, in, out);
}

void evaluate_porous_phases(const EosStrength& model, const Step& in, Chunk& out) {
  evaluate_distended<true>(model, in, out);
}

void TrialEvaluation::repeat(const EosStrength& model, const Step& in, Chunk& out) const {
  out.report = report_;
  out.pressure = pressure_;
  in.energy == Energy::from_grid ? energy_from_grid(model, in, out) : energy_by_work(model, in, out);
  evaluate_equation_of_state<false>(in, out, out.view(out.history[model.distension]));
}

void accept_energy(const EosStrength&, const Step&, Chunk& out) {
  std::copy_n(out.energy.data(), out.size, out.specific_internal_energy.data());
}

void return_cold_work(const EosStrength& model, const Step&, Chunk& out) {
  const Lanes& stored = out.history[model.stored_cold_work];
  for (std::size_t k = 0; k < out.size; ++k) out.specific_internal_energy[k] += stored[k];
}

void correct_work_beside_voids(const EosStrength&, const Step&, Chunk& out) {
  for (std::size_t k = 0; out.any_void && k < out.size; ++k) {
    const double excess = out.pressure[k] - out.acting_pressure[k];
    out.specific_internal_energy[k] += 0.5 * out.volume_change[k] * excess / out.mass[k];
  }
}

}  // namespace whipple::material::parts
