// SPDX-License-Identifier: BSD-3-Clause
#include "src/decks/nearest_heat.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/input/document.hpp"
#include "src/material/material_file.hpp"

namespace whipple::decks {
namespace {

struct Constants {
  std::string model;
  double density = 0.0, heat_capacity = 0.0;
};

/// Reads the relevant keys of [eos], all optional: files of other models lack some.
Constants constants_of(const std::filesystem::path& file) {
  const ParameterTable<Constants> keys = {
      text("model", &Constants::model, "").optional(),
      real("reference_density", &Constants::density, "kg/m^3", range::positive(), "").optional(),
      real("heat_capacity", &Constants::heat_capacity, "J/(kg K)", range::positive(), "").optional()};
  Constants constants;
  input::Document document = input::Document::from_file(file);
  if (auto table = document.root().optional_table("eos")) table->read(keys, constants);
  return constants;
}

struct Entry {
  Constants constants;
  std::string material;
};

std::vector<Entry> read_library() {
  std::vector<Entry> library;
  for (const std::filesystem::path& folder : library_folders()) {
    for (const auto& file : std::filesystem::directory_iterator(folder)) {
      if (file.path().extension() != ".toml") continue;
      try {
        library.push_back({constants_of(file.path()), file.path().stem().string()});
      } catch (const InputError&) {
        continue;  // reported by `whipple materials`
      }
    }
  }
  std::ranges::sort(library, {}, &Entry::material);  // of equally near ones the first by name
  return library;
}

}  // namespace

LibraryHeat nearest_heat(double density, std::string_view model) {
  static const std::vector<Entry> library = read_library();
  LibraryHeat nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const Entry& entry : library) {
    const Constants& constants = entry.constants;
    if (constants.model != model || constants.density <= 0.0 || constants.heat_capacity <= 0.0) continue;
    const double distance = std::abs(std::log(constants.density / density));
    if (distance < least) {
      least = distance;
      nearest = {constants.heat_capacity, entry.material};
    }
  }
  if (nearest.material.empty())
    throw InputError(
        fmt::format("the material library has no material with the equation of state {}", model));
  return nearest;
}

}  // namespace whipple::decks
