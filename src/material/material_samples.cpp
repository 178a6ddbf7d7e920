// SPDX-License-Identifier: BSD-3-Clause
#include "src/material/material_samples.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "src/core/base/error.hpp"
#include "src/core/base/log.hpp"
#include "src/core/base/normal_samples.hpp"
#include "src/core/base/pattern.hpp"
#include "src/core/input/document.hpp"
#include "src/material/material_file.hpp"
#include "src/material/material_schema.hpp"

namespace whipple {
namespace {

struct Covariance {
  std::vector<std::string> names, units;
  Eigen::MatrixXd matrix;
};

template <class Target>
BoundParameter key(const std::string& name, const std::string& unit, const std::string& meaning,
                   Target* target) {
  ParameterInfo info;
  info.name = name;
  info.unit = unit;
  info.meaning = meaning;
  return {info, target};
}

/// Returns the values of the constants in SI units, as listed by the model.
Eigen::VectorXd values_of(const Material& material, const Covariance& covariance) {
  input::Document document = input::Document::from_text(material.eos->constants(), material.name);
  input::Table constants = document.root();
  Eigen::VectorXd values(static_cast<Eigen::Index>(covariance.names.size()));
  for (std::size_t i = 0; i < covariance.names.size(); ++i) {
    const std::vector<BoundParameter> one = {key(covariance.names[i], covariance.units[i],
                                                 "a fitted constant", &values[static_cast<Eigen::Index>(i)])};
    if (!constants.has(covariance.names[i]) || !constants.read(one)) {
      throw InputError(fmt::format(
          "{}: error: [covariance] names '{}' in '{}', which is no such constant of {}",
          material.file.string(), covariance.names[i], covariance.units[i], material.eos->model()));
    }
  }
  return values;
}

/// Reads names, units and a matrix of a table.
void read_matrix(input::Table& table, const char* title, const char* matrix, Covariance& covariance) {
  const std::vector<BoundParameter> heads = {key("names", "", "the fitted constants", &covariance.names),
                                             key("units", "", "their SI units", &covariance.units)};
  table.read(heads);
  const std::size_t n = covariance.names.size();
  if (covariance.units.size() != n) {
    table.error(fmt::format("[{}] has {} units for {} names", title, covariance.units.size(), n));
  }
  covariance.matrix = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
  auto rows = table.required_table(matrix);
  if (!rows) return;
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<double> row;
    const std::vector<BoundParameter> one = {key(covariance.names[i], "", "a row of the covariance", &row)};
    if (!rows->read(one)) continue;
    if (row.size() != n) {
      rows->error_at(covariance.names[i],
                     fmt::format("{} entries in a covariance of {} constants", row.size(), n));
      continue;
    }
    for (std::size_t k = 0; k < n; ++k) {
      covariance.matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = row[k];
    }
  }
}

/// Returns the joint covariance of independent tables; variances of constants in both are added.
Covariance joined(Covariance all, const Covariance& other) {
  std::vector<Eigen::Index> places;
  for (std::size_t i = 0; i < other.names.size(); ++i) {
    const auto found = std::ranges::find(all.names, other.names[i]);
    places.push_back(found - all.names.begin());
    if (found != all.names.end()) continue;
    all.names.push_back(other.names[i]);
    all.units.push_back(other.units[i]);
  }
  const auto count = static_cast<Eigen::Index>(all.names.size());
  const Eigen::Index former = all.matrix.rows();
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count, count);
  matrix.topLeftCorner(former, former) = all.matrix;
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t k = 0; k < places.size(); ++k) {
      matrix(places[i], places[k]) +=
          other.matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
    }
  }
  all.matrix = matrix;
  return all;
}

/// Holds the errors of the constants as stated in a material file.
struct Errors {
  Covariance fit;
  std::optional<Covariance> spread;
  Covariance defaults;               ///< with known errors
  std::vector<std::string> unknown;  ///< defaults without known errors
};

Errors read_errors(const std::filesystem::path& file, ErrorTier tier) {
  input::Document document = input::Document::from_file(file);
  input::Table root = document.root();
  auto table = root.optional_table("covariance");
  if (!table) {
    throw InputError(fmt::format(
        "{} has no table [covariance]: only a fitted material can be sampled (whipple fit)", file.string()));
  }
  Errors errors;
  const char* const wanted = tier == ErrorTier::noise ? "statistical" : "matrix";
  read_matrix(*table, "covariance", wanted, errors.fit);
  if (auto spread = root.optional_table("potential_spread")) {
    errors.spread.emplace();
    read_matrix(*spread, "potential_spread", "matrix", *errors.spread);
    for (const char* other : {"potentials", "standard_deviation"}) spread->accept(other);
  }
  if (auto defaults = root.optional_table("default_errors")) {
    std::vector<double> deviations;
    const std::vector<BoundParameter> keys = {
        key("names", "", "defaults with a known error", &errors.defaults.names),
        key("units", "", "their SI units", &errors.defaults.units),
        key("errors", "", "one standard deviation", &deviations),
        key("unknown", "", "defaults without a known error", &errors.unknown)};
    defaults->read(keys);
    defaults->accept("sources");
    if (deviations.size() != errors.defaults.names.size() ||
        errors.defaults.units.size() != deviations.size()) {
      defaults->error(fmt::format("[default_errors] has {} errors and {} units for {} names",
                                  deviations.size(), errors.defaults.units.size(),
                                  errors.defaults.names.size()));
    } else {
      const Eigen::Map<const Eigen::VectorXd> sigma(deviations.data(),
                                                    static_cast<Eigen::Index>(deviations.size()));
      errors.defaults.matrix = sigma.cwiseAbs2().asDiagonal();
    }
  }
  // All other keys belong to the material reader or are for information only.
  for (const std::string& other : material_keys()) root.accept(other);
  for (const char* other :
       {"matrix", "statistical", "correlation", "statistical_error", "bootstrap_replicates",
        "bootstrap_error", "chi_squared", "degrees_of_freedom", "fisher_eigenvalues"}) {
    table->accept(other);
  }
  document.finish();
  return errors;
}

/// Issues one warning for each kind of warning of the draws; warnings of a kind differ in numbers only.
void warn_of_draws(const std::filesystem::path& file, const std::vector<std::string>& warnings, int draws) {
  static const Pattern number("[0-9]+([.][0-9]+)?([eE][-+]?[0-9]+)?");
  std::map<std::string, std::vector<std::string>> kinds;
  for (const std::string& warning : warnings) kinds[number.replace(warning, "#")].push_back(warning);
  for (const auto& [kind, messages] : kinds)
    log::warning("{}: {} of {} draws: {}", file.filename().string(), messages.size(), draws,
                 messages.front());
}

}  // namespace

bool has_covariance(const Material& material) {
  if (material.file.empty()) return false;
  return input::Document::from_file(material.file).root().has("covariance");
}

MaterialSamples sample_material(const std::filesystem::path& path, int count, std::uint64_t seed,
                                ErrorTier tier, const std::filesystem::path& beside,
                                const std::function<bool()>& is_asked_to_end) {
  const std::filesystem::path file = find_material(path, beside);
  const Errors errors = read_errors(file, tier);
  if (over_potentials(tier) && !errors.spread) {
    throw InputError(fmt::format(
        "{} has no table [potential_spread]: fit the stores of several potentials of the element together "
        "(whipple fit A.md.h5 B.md.h5 -o FOLDER/)",
        file.string()));
  }
  MaterialSamples samples;
  Covariance covariance;
  if (tier != ErrorTier::potentials) covariance = errors.fit;
  if (tier == ErrorTier::fit || tier == ErrorTier::all) {
    covariance = joined(covariance, errors.defaults);
    samples.defaults = errors.defaults.names;
    samples.unknown = errors.unknown;
  }
  if (over_potentials(tier)) covariance = joined(covariance, *errors.spread);
  samples.names = covariance.names;
  std::vector<std::string> warnings;
  const auto central = [&] {
    const log::WarningsAside aside;  // warnings of the material itself were issued when it was first read
    return values_of(read_material(file), covariance);
  };
  NormalSamples distribution(central(), covariance.matrix, seed);
  while (static_cast<int>(samples.materials.size()) < count && !is_asked_to_end()) {
    const Eigen::VectorXd values = distribution.draw();
    std::vector<std::pair<std::string, std::string>> changes;
    for (std::size_t k = 0; k < covariance.names.size(); ++k) {
      const double value = values[static_cast<Eigen::Index>(k)];
      changes.emplace_back("eos." + covariance.names[k],
                           covariance.units[k].empty()
                               ? fmt::format("{:.17g}", value)
                               : fmt::format("{:.17g} {}", value, covariance.units[k]));
    }
    const auto refuse = [&](const char* reason) {
      if (++samples.refused > 4 * static_cast<int>(samples.materials.size()) + 20) {
        throw InputError(fmt::format("{}: {} of {} draws from the covariance make no material; the last: {}",
                                     file.string(), samples.refused,
                                     samples.refused + static_cast<int>(samples.materials.size()), reason));
      }
    };
    try {
      const log::WarningsAside aside;
      samples.materials.push_back(read_changed_material(file, changes));
      samples.changes.push_back(changes);
      warnings.insert(warnings.end(), aside.messages().begin(), aside.messages().end());
    } catch (const InputError& error) {
      refuse(error.what());
    } catch (const StateError& error) {  // the constants lack a state from which the model is built
      refuse(error.what());
    }
  }
  warn_of_draws(file, warnings, count);
  return samples;
}

}  // namespace whipple
