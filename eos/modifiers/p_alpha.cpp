// SPDX-License-Identifier: BSD-3-Clause
// Equation numbers: docs/theory/equations_of_state.md, "Modifiers".
#include "eos/modifiers/p_alpha.hpp"

#include <fmt/core.h>

#include <cmath>

namespace whipple::eos {
namespace {

constexpr double open_at_the_end = 1e-6;  ///< of alpha0 - 1, end of the exponential curve
constexpr int greatest_iterations = 100;

/// Returns the state of porous material from that of its matrix.
State with_pores(State s, double distension) {
  s.density /= distension;
  s.pressure /= distension;
  s.isothermal_bulk_modulus /= distension;
  s.distension = distension;
  derive(s);
  return s;
}

/// Models pores of constant fraction, for the expansion of crushed material (A1).
class FixedDistension final : public Modified {
 public:
  FixedDistension(std::shared_ptr<const EquationOfState> base, double distension)
      : Modified(std::move(base)), distension_(distension) {}

  [[nodiscard]] double reference_density() const override { return base().reference_density() / distension_; }
  [[nodiscard]] double maximum_density() const override { return base().maximum_density() / distension_; }
  [[nodiscard]] double minimum_energy(double density) const override {
    return base().minimum_energy(density * distension_);
  }
  [[nodiscard]] const VapourDome* vapour_dome() const override {
    return distension_ == 1.0 ? base().vapour_dome() : nullptr;
  }
  [[nodiscard]] double initial_distension() const override { return distension_; }
  RangeReport evaluate(const Batch& batch) const override {
    return in_chunks(batch, [this](Batch part) {
      ModifierScratch density;
      const std::size_t size = part.density.size();
      for (std::size_t i = 0; i < size; ++i) density[i] = part.density[i] * distension_;
      part.density = {density.data(), size};
      part.distension = {};
      const RangeReport report = base().evaluate(part);
      for (double& pressure : part.pressure) pressure /= distension_;
      return report;
    });
  }
  [[nodiscard]] State state(double density, double specific_internal_energy) const override {
    return with_pores(base().state(density * distension_, specific_internal_energy), distension_);
  }
  [[nodiscard]] State state_at_temperature(double density, double temperature) const override {
    return with_pores(base().state_at_temperature(density * distension_, temperature), distension_);
  }
  [[nodiscard]] std::string constants() const override { return base().constants(); }

 private:
  double distension_;
};

}  // namespace

ParameterTable<PAlphaConstants> PAlpha::parameters() {
  using C = PAlphaConstants;
  return {
      real("distension", &C::distension, "", {.lower = 1.0, .lower_open = true},
           "alpha0, density of the matrix over that of the porous body at rest"),
      real("elastic_pressure", &C::elastic_pressure, "Pa", range::non_negative(),
           "p_e, up to which the pores resist"),
      choice("compaction", &C::compaction, "crush curve alpha(p) above p_e").optional(),
      real("solid_pressure", &C::solid_pressure, "Pa", range::non_negative(),
           "p_s of the quadratic curve and of the power, at which the pores are closed")
          .optional("none; required by these curves"),
      real("compaction_exponent", &C::compaction_exponent, "", range::non_negative(), "n of the power")
          .optional("none; required by the power"),
      real("compaction_rate", &C::compaction_rate, "1/Pa", range::non_negative(),
           "of the exponential curve exp[-rate (p - p_e)]")
          .optional("none; required by the exponential curve"),
  };
}

PAlpha::PAlpha(std::shared_ptr<const EquationOfState> base, const Constants& constants)
    : Modified(std::move(base)), constants_(constants) {
  const Constants& k = constants_;
  if (this->base().initial_distension() != 1.0) {
    throw InputError("p_alpha: the equation of state has pores already");
  }
  if (!(k.distension > 1)) throw InputError("p_alpha: distension must be above 1");
  const bool exponential = k.compaction == CompactionCurve::exponential;
  const bool power = k.compaction == CompactionCurve::power;
  exponent_ = exponential ? 0.0 : power ? k.compaction_exponent : 2.0;
  const auto refuse = [&](bool given, const char* constant) {
    if (!given) return;
    throw InputError(
        fmt::format("p_alpha: {} does not belong to compaction = \"{}\"", constant, word_of(k.compaction)));
  };
  refuse(!exponential && k.compaction_rate != 0, "compaction_rate");
  refuse(exponential && k.solid_pressure != 0, "solid_pressure");
  refuse(!power && k.compaction_exponent != 0, "compaction_exponent");
  if (power && !(k.compaction_exponent > 0)) {
    throw InputError("p_alpha: compaction = \"power\" requires compaction_exponent");
  }
  if (!exponential && !(k.solid_pressure > k.elastic_pressure)) {
    throw InputError(
        fmt::format("p_alpha: solid_pressure ({:.6g} Pa) must be above elastic_pressure ({:.6g} Pa)",
                    k.solid_pressure, k.elastic_pressure));
  }
  if (exponential && !(k.compaction_rate > 0)) {
    throw InputError("p_alpha: compaction = \"exponential\" requires compaction_rate");
  }
  closing_pressure_ =
      !exponential ? k.solid_pressure : k.elastic_pressure - std::log(open_at_the_end) / k.compaction_rate;
}

double PAlpha::distension_at(double pressure) const {  // (A2), (A3)
  const Constants& k = constants_;
  if (pressure <= k.elastic_pressure) return k.distension;
  if (pressure >= closing_pressure_) return 1.0;
  if (exponent_ > 0) {
    const double open = (closing_pressure_ - pressure) / (closing_pressure_ - k.elastic_pressure);
    return 1 + (k.distension - 1) * (exponent_ == 2.0 ? open * open : std::pow(open, exponent_));
  }
  const double open = std::exp(-k.compaction_rate * (pressure - k.elastic_pressure));
  return 1 + (k.distension - 1) * (open - open_at_the_end) / (1 - open_at_the_end);
}

double PAlpha::crush_pressure(double distension) const {
  const Constants& k = constants_;
  const double open = (distension - 1) / (k.distension - 1);
  if (open >= 1) return k.elastic_pressure;
  if (open <= 0) return closing_pressure_;
  if (exponent_ > 0) {
    const double root = exponent_ == 2.0 ? std::sqrt(open) : std::pow(open, 1 / exponent_);
    return closing_pressure_ - (closing_pressure_ - k.elastic_pressure) * root;
  }
  return k.elastic_pressure - std::log(open * (1 - open_at_the_end) + open_at_the_end) / k.compaction_rate;
}

/// Returns the distension after loading: unchanged if the pressure stays below the crush curve, otherwise the
/// solution of p = p_s(alpha(p) rho)/alpha(p) by bracketed regula falsi (Illinois) in p (A4).
/// @param matrix_pressure  as a function of the density of the matrix; NaN beyond the model
template <class MatrixPressure>
double PAlpha::crushed(double density, double distension, const MatrixPressure& matrix_pressure) const {
  if (distension <= 1) return 1.0;
  const double trial = matrix_pressure(distension * density) / distension;
  double low = crush_pressure(distension);
  if (trial <= low) return distension;
  const double closed = matrix_pressure(density);
  if (!(closed < closing_pressure_)) return 1.0;
  // Beyond the compression limit of the matrix the pressure is treated as infinite.
  double high = closing_pressure_, at_high = high - closed;
  double at_low = std::isnan(trial) ? -at_high : low - trial;
  int side = 0;
  const double precision = 1e-13 * closing_pressure_;
  for (int i = 0; i < greatest_iterations && high - low > precision; ++i) {
    const double p = i % 8 == 7 ? 0.5 * (low + high) : (low * at_high - high * at_low) / (at_high - at_low);
    const double alpha = distension_at(p), pressure = matrix_pressure(alpha * density) / alpha;
    const double difference = std::isnan(pressure) ? -at_high : p - pressure;
    if (std::abs(difference) <= precision) return alpha;
    if (difference < 0) {
      low = p;
      at_low = difference;
      if (side == -1) at_high *= 0.5;
      side = -1;
    } else {
      high = p;
      at_high = difference;
      if (side == 1) at_low *= 0.5;
      side = 1;
    }
  }
  return distension_at(0.5 * (low + high));
}

RangeReport PAlpha::evaluate(const Batch& batch) const {
  return in_chunks(batch, [this](Batch part) {
    const std::size_t size = part.density.size();
    ModifierScratch density, distension;
    for (std::size_t i = 0; i < size; ++i) {
      distension[i] = part.distension.empty() ? constants_.distension : part.distension[i];
      density[i] = part.density[i] * distension[i];
    }
    // Evaluate all points at constant distension, then re-evaluate one by one those that are crushed in this step.
    Batch matrix = part;
    matrix.density = {density.data(), size};
    matrix.distension = {};
    RangeReport report = base().evaluate(matrix);
    report.out_of_range = 0;
    report.first = RangeReport::none;
    for (std::size_t i = 0; i < size; ++i) {
      RangeReport of_point;
      if (distension[i] > 1 && !(part.pressure[i] / distension[i] <= crush_pressure(distension[i]))) {
        Batch point = part_of(part, i, 1);
        point.distension = {};
        const auto matrix_pressure = [&](double matrix_density) {
          point.density = {&matrix_density, 1};
          of_point = base().evaluate(point);
          return point.pressure[0];
        };
        distension[i] = crushed(part.density[i], distension[i], matrix_pressure);
        static_cast<void>(matrix_pressure(distension[i] * part.density[i]));
      }
      part.pressure[i] /= distension[i];
      if (!part.distension.empty()) part.distension[i] = distension[i];
      if (!std::isnan(part.pressure[i])) continue;
      if (report.out_of_range++ == 0) {
        report.first = i;
        if (!of_point.bound.empty()) report.bound = of_point.bound;
      }
    }
    return report;
  });
}

template <class MatrixState>
State PAlpha::virgin(double density, const MatrixState& matrix_state) const {
  const auto matrix_pressure = [&](double matrix_density) {
    try {
      return matrix_state(matrix_density).pressure;
    } catch (const StateError&) {
      return State::unknown;
    }
  };
  const double alpha = crushed(density, constants_.distension, matrix_pressure);
  State s = with_pores(matrix_state(alpha * density), alpha);
  if (alpha > 1 && alpha < constants_.distension) s.phase = "compacting";
  return s;
}

State PAlpha::state(double density, double specific_internal_energy) const {
  return virgin(density, [&](double rho) { return base().state(rho, specific_internal_energy); });
}

State PAlpha::state_at_temperature(double density, double temperature) const {
  return virgin(density, [&](double rho) { return base().state_at_temperature(rho, temperature); });
}

std::unique_ptr<EquationOfState> PAlpha::unloading(const State& from) const {
  return std::make_unique<FixedDistension>(shared_base(), from.distension);
}

}  // namespace whipple::eos
