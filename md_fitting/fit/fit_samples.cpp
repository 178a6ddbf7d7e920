// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/fit_samples.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <span>

#include "eos/catalogue.hpp"
#include "md_fitting/fit/constant_list.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/normal_samples.hpp"

namespace whipple::fit {
namespace {

/// Builds the model of a fit. @throws InputError if its constants contradict each other
void require_material(const Fit& fit) {
  const eos::ModelEntry& model = eos::catalogue().at(name_of(fit.model));
  const auto declared = model.declare([&](std::span<const BoundParameter> parameters) {
    for (const BoundParameter& parameter : parameters) {
      const std::string& name = parameter.info.name;
      if (double* const* number = std::get_if<double*>(&parameter.target)) {
        const auto found = std::find_if(fit.constants.begin(), fit.constants.end(),
                                        [&](const Constant& constant) { return constant.name == name; });
        if (found != fit.constants.end()) **number = found->value;
      } else if (const ChoiceTarget* choice = std::get_if<ChoiceTarget>(&parameter.target)) {
        const auto found = std::find_if(fit.words.begin(), fit.words.end(),
                                        [&](const auto& one) { return one.first == name; });
        if (found != fit.words.end()) choice->set(choice->value, found->second);
      }
    }
  });
  static_cast<void>(declared.build());
}

/// Holds the constants that are drawn and their covariance: those of the fit, then the defaults with a known error.
struct Drawn {
  std::vector<std::string> names;
  Eigen::MatrixXd covariance;
};

Drawn drawn_from(const Fit& fit, ErrorTier tier, const std::optional<PotentialSpread>& spread) {
  Drawn drawn{fit.fitted_names, {}};
  std::vector<double> variances;
  const bool with_defaults = tier == ErrorTier::fit || tier == ErrorTier::all;
  for (const Constant& constant : fit.constants) {
    if (!with_defaults || constant.origin != Origin::by_default || !(constant.error > 0.0)) continue;
    drawn.names.push_back(constant.name);
    variances.push_back(constant.error * constant.error);
  }
  const auto fitted = static_cast<Eigen::Index>(fit.fitted_names.size());
  const auto count = static_cast<Eigen::Index>(drawn.names.size());
  drawn.covariance = Eigen::MatrixXd::Zero(count, count);
  if (tier == ErrorTier::noise) drawn.covariance.topLeftCorner(fitted, fitted) = fit.statistical_covariance;
  if (with_defaults) {
    drawn.covariance.topLeftCorner(fitted, fitted) = fit.covariance;
    for (Eigen::Index k = fitted; k < count; ++k) {
      drawn.covariance(k, k) = variances[static_cast<std::size_t>(k - fitted)];
    }
  }
  if (!over_potentials(tier)) return drawn;
  const auto row_of = [&](const std::string& name) {
    return std::find(fit.fitted_names.begin(), fit.fitted_names.end(), name) - fit.fitted_names.begin();
  };
  for (std::size_t i = 0; i < spread->names.size(); ++i) {
    for (std::size_t k = 0; k < spread->names.size(); ++k) {
      const Eigen::Index row = row_of(spread->names[i]);
      const Eigen::Index column = row_of(spread->names[k]);
      if (row >= fitted || column >= fitted) continue;
      drawn.covariance(row, column) +=
          spread->covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
    }
  }
  return drawn;
}

}  // namespace

FitSamples correction_samples(const Fit& fit) {
  FitSamples samples;
  for (const eos::CorrectedGrayConstants& drawn : fit.correction.value().samples) {
    Fit sample = fit;
    sample.correction->common = drawn.common;
    sample.correction->fluid = drawn.fluid;
    sample.fitted_names.clear();
    samples.fits.push_back(std::move(sample));
  }
  return samples;
}

FitSamples sample_fit(const Fit& fit, int count, std::uint64_t seed, ErrorTier tier,
                      const std::optional<PotentialSpread>& spread) {
  if (over_potentials(tier) && !spread) {
    throw InputError("samples over potentials need stores of two potentials or more of the element");
  }
  const Drawn drawn_constants = drawn_from(fit, tier, spread);
  const std::vector<std::string>& names = drawn_constants.names;
  Eigen::VectorXd values(static_cast<Eigen::Index>(names.size()));
  for (std::size_t k = 0; k < names.size(); ++k) values[static_cast<Eigen::Index>(k)] = fit.value(names[k]);
  NormalSamples distribution(values, drawn_constants.covariance, seed);
  FitSamples samples;
  while (static_cast<int>(samples.fits.size()) < count) {
    const Eigen::VectorXd drawn = distribution.draw();
    Fit sample = fit;
    const std::string source = fmt::format("sample {} of {} from the covariance of the fit, seed {}",
                                           samples.fits.size() + 1, count, seed);
    for (Constant& constant : sample.constants) {
      const auto place = std::find(names.begin(), names.end(), constant.name);
      if (place == names.end()) continue;
      constant.value = as_written(drawn[place - names.begin()], constant.unit);
      constant.origin = Origin::given;
      constant.source = source;
    }
    sample.fitted_names.clear();
    const auto refuse = [&](const char* reason) {
      if (++samples.refused > 4 * static_cast<int>(samples.fits.size()) + 20) {
        throw InputError(fmt::format("{} of {} draws from the covariance make no material; the last: {}",
                                     samples.refused, samples.refused + static_cast<int>(samples.fits.size()),
                                     reason));
      }
    };
    try {
      require_material(sample);
      samples.fits.push_back(std::move(sample));
    } catch (const InputError& error) {
      refuse(error.what());
    } catch (const StateError& error) {  // the model does not exist for these constants
      refuse(error.what());
    }
  }
  return samples;
}

}  // namespace whipple::fit
