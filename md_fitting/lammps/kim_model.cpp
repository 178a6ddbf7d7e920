// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/lammps/kim_model.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <vector>

#include "md_fitting/lammps/lammps.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/pattern.hpp"
#include "src/core/base/text.hpp"

namespace whipple::md {
namespace {

/// Prevents the KIM library, a dependency of liblammps, from writing kim.log into the current folder. The function
/// is looked up by name, because the KIM headers are not required by the build.
void silence_kim() {
  struct Verbosity {
    int id;
  };
  using Push = void (*)(Verbosity);
  static const bool done = [] {
    void* const push = dlsym(RTLD_DEFAULT, "KIM_Log_PushDefaultVerbosity");
    void* const silent = dlsym(RTLD_DEFAULT, "KIM_LOG_VERBOSITY_silent");
    if (push != nullptr && silent != nullptr) {
      reinterpret_cast<Push>(push)(*static_cast<const Verbosity*>(silent));
    }
    return true;
  }();
  static_cast<void>(done);
}

/// Returns the folders searched by the KIM library for models: the environment variables in its manual and the
/// installation folders of packages.
std::vector<std::filesystem::path> model_folders() {
  std::vector<std::filesystem::path> folders;
  for (const char* variable : {"KIM_API_PORTABLE_MODELS_DIR", "KIM_API_SIMULATOR_MODELS_DIR"}) {
    const char* const value = std::getenv(variable);
    std::istringstream parts(value == nullptr ? "" : value);
    for (std::string part; std::getline(parts, part, ':');) folders.emplace_back(part);
  }
  for (const char* kind : {"portable-models", "simulator-models"}) {
    folders.push_back(std::filesystem::path(WHIPPLE_KIM_MODELS) / kind);
    folders.push_back(std::filesystem::path("/usr/local/lib/kim-api") / kind);
  }
  return folders;
}

/// Returns whether the species in an identifier, "..._2001_Cu__MO_..." or "..._AlCu__MO_...", include the element.
bool names_element(const std::string& identifier, const std::string& element) {
  const std::string name = identifier.substr(0, identifier.find("__"));
  const std::string species = name.substr(name.rfind('_') + 1);
  for (std::size_t at = species.find(element); at != std::string::npos; at = species.find(element, at + 1)) {
    const std::size_t next = at + element.size();
    if (next == species.size() || std::islower(static_cast<unsigned char>(species[next])) == 0) return true;
  }
  return false;
}

std::vector<std::string> installed_models(const std::string& element) {
  std::vector<std::string> names;
  for (const std::filesystem::path& folder : model_folders()) {
    std::error_code fault;
    for (const auto& entry : std::filesystem::directory_iterator(folder, fault)) {
      const std::string name = entry.path().filename().string();
      if (is_kim_identifier(name) && names_element(name, element)) names.push_back(name);
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// Suggests alternative models: the installed ones with the most similar names, or how to install some.
std::string advice(const std::string& identifier, const std::string& element) {
  std::vector<std::string> models = installed_models(element);
  if (models.empty())
    return fmt::format("no model for {} is installed (scripts/install_deps.sh --kim)", element);
  constexpr std::size_t most = 12;
  const std::size_t more = models.size() > most ? models.size() - most : 0;
  const std::string nearest = did_you_mean(identifier, models);
  models.resize(models.size() - more);
  return fmt::format("for {} there are{}: {}{}", element, nearest, fmt::join(models, ", "),
                     more > 0 ? fmt::format(" and {} more in {}", more, WHIPPLE_KIM_MODELS) : "");
}

}  // namespace

bool is_kim_identifier(const std::string& name) {
  static const Pattern pattern("[A-Za-z_][A-Za-z0-9_]*__(MO|SM)_[0-9]{12}_[0-9]{3}");
  return pattern.matches(name);
}

Interactions kim_interactions(const std::string& identifier, const std::string& element) {
  silence_kim();
  const std::string begin = fmt::format("kim init {} metal", identifier);
  const std::string apply = fmt::format("kim interactions {}", element);
  try {
    Lammps probe;
    if (!probe.has_style("pair", "kim")) {
      throw InputError(fmt::format("LAMMPS was built without its package KIM, which {} needs", identifier));
    }
    probe.command(begin);
  } catch (const LammpsError& error) {
    throw InputError(fmt::format("the KIM model {} cannot be used: {}; {}", identifier, error.what(),
                                 advice(identifier, element)));
  }
  return {.name = "the KIM model " + identifier, .before_box = {{begin, begin}}, .in_box = {{apply, apply}}};
}

}  // namespace whipple::md
