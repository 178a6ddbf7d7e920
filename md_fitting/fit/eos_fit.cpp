// SPDX-License-Identifier: BSD-3-Clause
// whipple-fit: from a store of molecular-dynamics points to a material file.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "md_fitting/fit/fit_report.hpp"
#include "md_fitting/fit/material_writer.hpp"
#include "src/base/error.hpp"
#include "src/base/files.hpp"
#include "src/base/units.hpp"
#include "src/process/scripts.hpp"

namespace whipple::fit {
namespace {

struct Options {
  std::vector<std::filesystem::path> stores;
  std::vector<std::string> outputs;
  std::string model = "gray";
  std::string density;
  std::string electronic = "measured";
  std::string melting = "band";
  std::string reference_temperature = "293 K";
  std::vector<std::string> up_range = {"0.3 km/s", "2.5 km/s"};
  std::string template_file;
  std::string plot;
  bool statistical_only = false;
  bool force = false;
  bool quiet = false;
};

double quantity(const std::string& option, const std::string& text, const char* unit) {
  try {
    return units::parse_quantity(text, unit);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", option, error.what()));
  }
}

FitSettings settings(const Options& options) {
  FitSettings settings;
  settings.reference_temperature = quantity("--reference-temperature", options.reference_temperature, "K");
  settings.least_particle_velocity = quantity("--up-range", options.up_range.at(0), "m/s");
  settings.most_particle_velocity = quantity("--up-range", options.up_range.at(1), "m/s");
  if (!(settings.least_particle_velocity >= 0.0 &&
        settings.most_particle_velocity > settings.least_particle_velocity)) {
    throw InputError(fmt::format("--up-range {} {}: expected two rising velocities, the first >= 0",
                                 options.up_range[0], options.up_range[1]));
  }
  settings.melting = options.melting;
  settings.electronic = options.electronic;
  if (options.statistical_only) settings.model_errors = ModelErrors::none();
  if (!options.density.empty()) {
    settings.density = quantity("--density", options.density, "kg/m^3");
    if (!(*settings.density > 0.0))
      throw InputError(fmt::format("--density {}: must be > 0", options.density));
  }
  return settings;
}

/// NAME of NAME.md.h5
std::string stem(const std::filesystem::path& store) {
  std::string name = store.filename().string();
  for (const std::string_view ending : {".md.h5", ".h5"}) {
    if (name.ends_with(ending)) return name.substr(0, name.size() - ending.size());
  }
  return name;
}

/// One material file per store: as many -o as stores, or one -o that is a folder (it exists, or ends with
/// '/').
std::vector<std::filesystem::path> material_files(const Options& options) {
  std::vector<std::filesystem::path> files;
  if (options.outputs.empty()) return files;
  const std::string& first = options.outputs.front();
  if (options.outputs.size() == 1 && (first.ends_with('/') || std::filesystem::is_directory(first))) {
    for (const std::filesystem::path& store : options.stores) {
      files.push_back(std::filesystem::path(first) / (stem(store) + ".toml"));
    }
  } else if (options.outputs.size() == options.stores.size()) {
    files.assign(options.outputs.begin(), options.outputs.end());
  } else {
    throw InputError(
        fmt::format("{} stores and {} outputs: give -o once for each store, or once as a folder "
                    "(ending with '/')",
                    options.stores.size(), options.outputs.size()));
  }
  for (std::size_t i = 0; i < files.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (files[i] == files[k])
        throw InputError(fmt::format("two stores would be written to '{}'", files[i].string()));
    }
    if (std::filesystem::exists(files[i]) && !options.force) {
      throw InputError(fmt::format("'{}' exists; --force overwrites it", files[i].string()));
    }
  }
  return files;
}

void run(const Options& options) {
  const std::vector<std::filesystem::path> files = material_files(options);
  const FitSettings chosen = settings(options);
  if (!options.plot.empty()) {
    if (options.stores.size() > 1) throw InputError("--plot draws one store: give one");
    require_new_figure(options.plot, options.force);
  }
  std::vector<NamedFit> fits;
  std::vector<std::string> materials;
  for (const std::filesystem::path& store : options.stores) {
    const std::vector<md::PointRecord> points = md::read_store(store);
    fits.push_back({stem(store), fit_gray(points, chosen, store.string())});
    if (files.empty()) continue;
    const GrayFit& fit = fits.back().fit;
    const std::filesystem::path model = options.template_file.empty()
                                            ? default_template(fit.element)
                                            : std::filesystem::path(options.template_file);
    materials.push_back(material_text(fit, store_origin(store, points), model));
  }
  for (std::size_t i = 0; i < files.size(); ++i) write_file(files[i], materials[i], options.force);
  if (!options.plot.empty()) process::draw_json("scripts/plot_fit.py", plot_data(fits.front()), options.plot);

  fmt::print("{}", constants_table(fits));
  if (!options.quiet) {
    for (const NamedFit& fit : fits) fmt::print("\n--- {} ---\n{}", fit.name, fit_details(fit.fit));
  }
  fmt::print("\n");
  if (files.empty()) fmt::print("no material written: name one with -o MATERIAL.toml\n");
  for (const std::filesystem::path& file : files) fmt::print("written: {}\n", file.string());
  if (!options.plot.empty()) fmt::print("written: {}\n", options.plot);
}

int main_program(int argc, char** argv) {
  Options options;
  CLI::App app{
      "Fit the constants of an equation of state to stores of molecular-dynamics points, with their "
      "covariance, and write complete material files."};
  app.name("whipple fit");
  app.footer(
      "Example:\n  whipple fit cu_mishin.md.h5 -o copper_mishin.toml --density \"8.9445 g/cm^3\" --plot "
      "fit.png\n"
      "Several stores are printed side by side; give -o once for each, or once as a folder.");
  app.add_option("stores", options.stores, "Stores NAME.md.h5 of whipple md")->required();
  app.add_option("--model", options.model, "Equation of state")
      ->check(CLI::IsMember({"gray"}))
      ->capture_default_str();
  app.add_option("-o,--output", options.outputs, "Material file to write, or a folder (ending with '/')")
      ->allow_extra_args(false);
  app.add_option("--density", options.density,
                 "Measured density: replaces the fitted reference volume, e.g. \"8.9445 g/cm^3\"");
  app.add_option("--electronic-heat-coefficient", options.electronic,
                 "Electrons, which the simulations do not hold: measured, liu2013, none, or a quantity")
      ->capture_default_str();
  app.add_option("--melting", options.melting, "Melting transition of the material, and of the fit of T_m0")
      ->check(CLI::IsMember({"band", "isochoric"}))
      ->capture_default_str();
  app.add_option("--reference-temperature", options.reference_temperature,
                 "Temperature of the reference volume and ahead of the simulated shocks")
      ->capture_default_str();
  app.add_option("--up-range", options.up_range, "Window of particle velocities of the Hugoniot states")
      ->expected(2)
      ->capture_default_str();
  app.add_option("--template", options.template_file,
                 "Material whose strength and failure are copied (default: the element's in the library)");
  app.add_option("--plot", options.plot, "Figure of data, fit and residuals, FILE.png");
  app.add_flag("--statistical-only", options.statistical_only,
               "Weights and errors from the noise alone, without model errors");
  app.add_flag("--force", options.force, "Overwrite existing files");
  app.add_flag("-q,--quiet", options.quiet, "Print the table of constants only");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& request) {
    return app.exit(request);
  } catch (const CLI::ParseError& error) {
    throw InputError(fmt::format("{}\nsee whipple fit --help", error.what()));
  }
  run(options);
  return static_cast<int>(ExitCode::success);
}

}  // namespace
}  // namespace whipple::fit

int main(int argc, char** argv) {
  return whipple::run_guarded("whipple fit", &whipple::fit::main_program, argc, argv);
}
