// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/base/parameter_table.hpp"
#include "src/material/common.hpp"
#include "src/material/constitutive.hpp"
#include "src/material/hyperelastic/response.hpp"

namespace whipple::material {

/// Hyperelastic solid: free energy of the equation of state plus that of an isochoric deformation,
/// psi = psi_eos(rho, T) + W(b')/rho0, b' = J^(-2/3) F F^T, of which a fraction may relax; W may also depend on the
/// density (docs/theory/material.md, section 12).
/// @tparam Law  constants with name, summary, theory, parameters(), `relaxation`, require_consistent(), shear(), the
///              modulus of small strains, and respond(b', J) with J = rho0/rho
template <class Law>
class HyperelasticModel final : public Constitutive {
 public:
  using Constants = Law;
  static std::vector<HistoryField> fields() {
    std::vector<HistoryField> all = {{"deformation_gradient", "1",
                                      "deformation since the start, xx xy xz yx yy yz zx zy zz", Rank::tensor,
                                      Convection::deformed, 1.0}};
    for (std::size_t i = 1; i <= hyperelastic::Relaxation::most; ++i) {
      all.push_back({fmt::format("relaxing_stress_{}", i), "Pa",
                     fmt::format("part {} of the deviator that relaxes", i), Rank::symmetric_tensor,
                     Convection::corotated});
    }
    return all;
  }

  /// @throws InputError if the constants are inconsistent
  explicit HyperelasticModel(const Law& constants) : constants_(constants) {
    constants_.require_consistent();
    constants_.relaxation.require_consistent();
    const std::vector<HistoryField> declared = fields();
    deformation_ = declare(declared[0]);
    for (std::size_t i = 0; i < constants_.relaxation.fractions.size(); ++i) {
      relaxing_.push_back(declare(declared[1 + i]));
    }
  }
  [[nodiscard]] const Law& law() const { return constants_; }
  [[nodiscard]] std::string_view model() const override { return Law::name; }
  [[nodiscard]] std::string constants(const Material&) const override {
    Law copy = constants_;
    return fmt::format("\n[constitutive]\nmodel = \"{}\"\n{}", Law::name,
                       to_toml(whipple::bind(Law::parameters(), copy)));
  }
  [[nodiscard]] std::shared_ptr<const Constitutive> adapted(const Material& material) const override {
    if (material.eos->has_phases() || material.eos->initial_distension() > 1.0) {
      throw InputError(fmt::format(
          "constitutive model \"{}\" takes an equation of state without phases and pores", Law::name));
    }
    return std::make_shared<const HyperelasticModel>(constants_);
  }
  [[nodiscard]] double sound_speed(const Material&, const eos::State& state) const override {
    const hyperelastic::Response at_rest = constants_.respond({1.0, 1.0, 1.0, 0.0, 0.0, 0.0}, 1.0);
    return wave_speed(state.sound_speed * state.sound_speed, at_rest, 1.0 / state.density);
  }
  void divide_energy(const Material& material, const MaterialPoints& points, std::size_t begin,
                     std::span<double> elastic, std::span<double> stored) const override {
    const double undeformed = 1.0 / material.reference.density;
    const auto& deformation =
        std::get<std::vector<Matrix3>>(points.history.find(history()[0].field.name)->values);
    for (std::size_t k = 0; k < elastic.size(); ++k) {
      const std::size_t p = begin + k;
      const Matrix3& f = deformation[p];
      const double determinant = f.determinant();
      const Matrix3 b = f * f.transpose() / std::cbrt(determinant * determinant);
      const double ratio = points.volume[p] / (points.mass[p] * undeformed);
      const double whole =
          constants_.respond({b(0, 0), b(1, 1), b(2, 2), b(0, 1), b(1, 2), b(2, 0)}, ratio).energy;
      elastic[k] = undeformed * (relaxing_.empty() ? whole : constants_.relaxation.lasting() * whole);
      stored[k] = 0.0;
    }
    for (std::size_t i = 0; i < relaxing_.size(); ++i) {
      const std::vector<SymmetricTensor>& part = points.history.symmetric(history()[1 + i].field.name);
      const double per_energy = per_stored_energy(i);
      for (std::size_t k = 0; k < stored.size(); ++k) {
        const std::size_t p = begin + k;
        stored[k] += per_energy * part[p].squared_norm() * points.volume[p] / points.mass[p];
      }
    }
  }
  void update(const Step& in, Chunk& out) const override {
    const double least = 0.01 * in.material.reference.sound_speed * in.material.reference.sound_speed;
    const double undeformed = 1.0 / in.material.reference.density;
    std::array<hyperelastic::Response, chunk_size> responses;
    respond(undeformed, out, responses);
    Lanes pressure;
    SymmetricLanes& s = out.motion.deviator;
    for (std::size_t k = 0; k < out.size; ++k) {
      const double per_volume = undeformed * out.density[k];  // 1/J
      for (std::size_t j = 0; j < 6; ++j) s[j][k] = per_volume * responses[k].stress[j];
      out.elastic_energy[k] = per_volume * responses[k].energy;
      pressure[k] = per_volume * responses[k].pressure;
    }
    if (!relaxing_.empty()) relax(in, out);
    solve_energy(in, pressure, out);
    for (std::size_t k = 0; k < out.size; ++k) {
      const double bulk = std::max(out.bulk_sound_speed[k] * out.bulk_sound_speed[k], least);
      out.sound_speed[k] = wave_speed(bulk, responses[k], undeformed);
    }
  }

 private:
  /// Returns the bound of the speed of all waves (eq. 32), m/s.
  /// @param bulk        square of the bulk sound speed, m^2/s^2
  /// @param undeformed  specific volume of the undeformed solid, m^3/kg
  static double wave_speed(double bulk, const hyperelastic::Response& response, double undeformed) {
    const double along = bulk + undeformed * response.longitudinal, across = undeformed * response.transverse;
    const double half = 0.5 * (along - across), coupling = undeformed * response.coupling;
    return std::sqrt(0.5 * (along + across) + std::sqrt(half * half + coupling * coupling));
  }

  /// Returns the energy per volume over the square of the i-th part of the deviator that relaxes, 1/Pa.
  [[nodiscard]] double per_stored_energy(std::size_t i) const {
    return 1.0 / (4.0 * constants_.relaxation.fractions[i] * constants_.shear());
  }

  /// Computes b' of each point and the response of the law.
  void respond(double undeformed, Chunk& out,
               std::array<hyperelastic::Response, chunk_size>& responses) const {
    const std::span<const Lanes, 9> f = out.field<9>(deformation_);
    for (std::size_t k = 0; k < out.size; ++k) {
      const auto product = [&](std::size_t i,
                               std::size_t j) {  // of the rows i and j of F: component ij of F F^T
        return f[3 * i][k] * f[3 * j][k] + f[3 * i + 1][k] * f[3 * j + 1][k] +
               f[3 * i + 2][k] * f[3 * j + 2][k];
      };
      const double determinant = f[0][k] * (f[4][k] * f[8][k] - f[5][k] * f[7][k]) -
                                 f[1][k] * (f[3][k] * f[8][k] - f[5][k] * f[6][k]) +
                                 f[2][k] * (f[3][k] * f[7][k] - f[4][k] * f[6][k]);
      const double isochoric = 1.0 / std::cbrt(determinant * determinant);
      responses[k] = constants_.respond(
          {isochoric * product(0, 0), isochoric * product(1, 1), isochoric * product(2, 2),
           isochoric * product(0, 1), isochoric * product(1, 2), isochoric * product(2, 0)},
          1.0 / (undeformed * out.density[k]));
    }
  }

  /// Advances the parts that relax (eq. 34) and replaces deviator and elastic energy of the sudden response by those of
  /// the relaxing solid.
  void relax(const Step& in, Chunk& out) const {
    const double dt = in.settings.time_step, lasting = constants_.relaxation.lasting();
    SymmetricLanes& s = out.motion.deviator;
    SymmetricLanes& before = out.old_deviator;
    out.fetch(in.points.deviatoric_stress, before);
    for (Lanes& lane : before) std::fill(lane.begin() + out.size, lane.begin() + padded(out.size), 0.0);
    turn(padded(out.size), dt, in.settings.rotation, out.motion.gradient, before);
    for (const std::size_t lane : relaxing_) {
      const std::span<const Lanes, 6> part = out.field<6>(lane);
      for (std::size_t j = 0; j < 6; ++j) {
        for (std::size_t k = 0; k < out.size; ++k) before[j][k] -= part[j][k];
      }
    }
    for (std::size_t k = 0; k < out.size; ++k) out.elastic_energy[k] *= lasting;
    SymmetricLanes sum;
    for (std::size_t j = 0; j < 6; ++j) {
      for (std::size_t k = 0; k < out.size; ++k) sum[j][k] = lasting * s[j][k];
    }
    for (std::size_t i = 0; i < relaxing_.size(); ++i) {
      const double fraction = constants_.relaxation.fractions[i], ratio = dt / constants_.relaxation.times[i];
      const double kept = std::exp(-ratio), gained = fraction * -std::expm1(-ratio) / ratio;
      const double per_energy = per_stored_energy(i);
      const std::span<Lanes, 6> part = out.field<6>(relaxing_[i]);
      book_relaxation(ratio, fraction, before, per_energy, part, out);
      for (std::size_t j = 0; j < 6; ++j) {
        for (std::size_t k = 0; k < out.size; ++k) {
          part[j][k] = kept * part[j][k] + gained * (s[j][k] - before[j][k] / lasting);
          sum[j][k] += part[j][k];
          out.elastic_energy[k] += (j < 3 ? 1.0 : 2.0) * per_energy * part[j][k] * part[j][k];
        }
      }
    }
    s = sum;
  }

  /// Books the heat of a part h before it is advanced, the integral of h:h/(2 g G tau) over the step in which the sudden
  /// stress changes at a constant rate.
  /// @param ratio       dt/tau
  /// @param fraction    g
  /// @param before      sudden stress before the step times the fraction that lasts, Pa
  /// @param per_energy  1/(4 g G), 1/Pa
  void book_relaxation(double ratio, double fraction, const SymmetricLanes& before, double per_energy,
                       std::span<const Lanes, 6> part, Chunk& out) const {
    const double lasting = constants_.relaxation.lasting();
    const double once = -std::expm1(-ratio), twice = -0.5 * std::expm1(-2.0 * ratio);
    double heat = 0.0;
    for (std::size_t j = 0; j < 6; ++j) {
      for (std::size_t k = 0; k < out.size; ++k) {
        const double steady = fraction / ratio * (out.motion.deviator[j][k] - before[j][k] / lasting);
        const double decaying = part[j][k] - steady;
        const double square =
            twice * decaying * decaying + 2.0 * once * steady * decaying + ratio * steady * steady;
        heat += (j < 3 ? 2.0 : 4.0) * per_energy * square * out.volume[k];
      }
    }
    out.report.dissipation += heat;
    out.report.viscous_heat += heat;
  }

  Law constants_;
  std::size_t deformation_;            ///< first lane of the field
  std::vector<std::size_t> relaxing_;  ///< of each part that relaxes
};

}  // namespace whipple::material
