// SPDX-License-Identifier: BSD-3-Clause
#include "src/material/material_samples.hpp"

#include <fmt/format.h>

#include "src/core/base/error.hpp"
#include "src/core/base/normal_samples.hpp"
#include "src/core/input/document.hpp"
#include "src/material/material_file.hpp"

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

/// Values of the constants in SI, as the model itself lists them.
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

Covariance read_covariance(const std::filesystem::path& file) {
  input::Document document = input::Document::from_file(file);
  input::Table root = document.root();
  auto table = root.optional_table("covariance");
  if (!table) {
    throw InputError(fmt::format(
        "{} has no table [covariance]: only a fitted material can be sampled (whipple fit)", file.string()));
  }
  Covariance covariance;
  const std::vector<BoundParameter> heads = {key("names", "", "the fitted constants", &covariance.names),
                                             key("units", "", "their SI units", &covariance.units)};
  table->read(heads);
  const std::size_t n = covariance.names.size();
  if (covariance.units.size() != n) {
    table->error(fmt::format("[covariance] has {} units for {} names", covariance.units.size(), n));
  }
  covariance.matrix.resize(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
  if (auto rows = table->required_table("matrix")) {
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
  // All else is for the reader of the material, or for people.
  for (const char* other : {"name", "source", "note", "group", "eos", "strength", "failure", "measured",
                            "provenance", "defaults"}) {
    root.accept(other);
  }
  for (const char* other : {"correlation", "statistical_error", "bootstrap_replicates", "bootstrap_error",
                            "chi_squared", "degrees_of_freedom"}) {
    table->accept(other);
  }
  document.finish();
  return covariance;
}

}  // namespace

MaterialSamples sample_material(const std::filesystem::path& path, int count, std::uint64_t seed,
                                const std::filesystem::path& beside) {
  const std::filesystem::path file = find_material(path, beside);
  const Covariance covariance = read_covariance(file);
  MaterialSamples samples;
  samples.names = covariance.names;
  NormalSamples distribution(values_of(read_material(file), covariance), covariance.matrix, seed);
  std::string reason;
  while (static_cast<int>(samples.materials.size()) < count) {
    const Eigen::VectorXd values = distribution.draw();
    std::vector<std::pair<std::string, std::string>> changes;
    for (std::size_t k = 0; k < covariance.names.size(); ++k) {
      const double value = values[static_cast<Eigen::Index>(k)];
      changes.emplace_back("eos." + covariance.names[k],
                           covariance.units[k].empty()
                               ? fmt::format("{:.17g}", value)
                               : fmt::format("{:.17g} {}", value, covariance.units[k]));
    }
    try {
      samples.materials.push_back(read_changed_material(file, changes));
    } catch (const InputError& error) {
      reason = error.what();
      if (++samples.refused > 4 * static_cast<int>(samples.materials.size()) + 20) {
        throw InputError(fmt::format("{}: {} of {} draws from the covariance make no material; the last: {}",
                                     file.string(), samples.refused,
                                     samples.refused + static_cast<int>(samples.materials.size()), reason));
      }
    }
  }
  return samples;
}

}  // namespace whipple
