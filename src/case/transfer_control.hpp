// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "src/case/section.hpp"
#include "src/case/time_control.hpp"
#include "src/transfer/shape_kind.hpp"

namespace whipple::cases {

/// Selects the transfer of velocity from the grid to the particles (docs/theory/mpm.md, section 4).
enum class ParticleUpdate : std::uint8_t {
  relaxed_affine,
  apic,
  flip,
  pic,
  blend,      ///< of FLIP and PIC
  fmpm,       ///< PIC with the full mass matrix
  by_scheme,  ///< not given: `default_update`
};
constexpr std::array<Word<ParticleUpdate>, 6> words(ParticleUpdate) {
  return {{{ParticleUpdate::relaxed_affine, "relaxed_affine"},
           {ParticleUpdate::apic, "apic"},
           {ParticleUpdate::flip, "flip"},
           {ParticleUpdate::pic, "pic"},
           {ParticleUpdate::blend, "blend"},
           {ParticleUpdate::fmpm, "fmpm"}}};
}
/// Returns whether particles carry an affine velocity field.
constexpr bool is_affine(ParticleUpdate update) {
  return update == ParticleUpdate::relaxed_affine || update == ParticleUpdate::apic;
}
/// Returns the default update for a scheme.
constexpr ParticleUpdate default_update(Scheme scheme) {
  return scheme == Scheme::symplectic ? ParticleUpdate::relaxed_affine : ParticleUpdate::flip;
}

/// Selects how the affine field of a particle is convected.
enum class AffineTransport : std::uint8_t {
  deformed,  ///< with the deformation of the step
  turned,    ///< with the rotation of the step only
};
constexpr std::array<Word<AffineTransport>, 2> words(AffineTransport) {
  return {{{AffineTransport::deformed, "deformed"}, {AffineTransport::turned, "turned"}}};
}

struct TransferControl {
  transfer::ShapeFunction shape_function = transfer::ShapeFunction::quadratic_bspline;
  double slope_smoothing = 1.5;  ///< a1 of docs/theory/mpm.md, 2.9
  ParticleUpdate particle_update = ParticleUpdate::by_scheme;
  double kappa = 0.2;
  AffineTransport affine_field = AffineTransport::deformed;
  double flip_fraction = 0.95;
  std::int64_t fmpm_order = 2;
  bool random_shift = false;
  std::int64_t random_seed = 1;
  bool free_flight = false;
  double rest_tolerance = 1e-12;

  static ParameterTable<TransferControl> parameters();
  void check(const Case& setup, const Faults& faults) const;
};

}  // namespace whipple::cases
