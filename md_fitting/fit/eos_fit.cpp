// SPDX-License-Identifier: BSD-3-Clause
// whipple-fit: creates a material file from a database of molecular-dynamics points.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "md_fitting/fit/fit_report.hpp"
#include "md_fitting/fit/fit_samples.hpp"
#include "md_fitting/fit/gray_fit.hpp"
#include "md_fitting/fit/material_writer.hpp"
#include "md_fitting/fit/potential_spread.hpp"
#include "md_fitting/fit/proposal.hpp"
#include "md_fitting/fit/solid_models.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/error_tier.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/log.hpp"
#include "src/core/base/option_quantity.hpp"
#include "src/core/base/words.hpp"
#include "src/core/process/paths.hpp"
#include "src/core/process/scripts.hpp"

namespace whipple::fit {
namespace {

struct Options {
  std::vector<std::filesystem::path> stores;
  std::vector<std::string> outputs;
  std::string model = "gray";
  std::vector<std::string> measured, checked;
  std::string density;
  std::optional<std::string> electrons;
  std::string defaults;
  bool correct = false;
  int bootstrap = 0;
  int samples = 0;
  std::uint64_t seed = 1;
  std::string melting{word_of(FitSettings{}.melting)};
  std::string reference_temperature = "293 K";
  std::vector<std::string> up_range = {"0.3 km/s", "2.5 km/s"};
  std::string nuclei{word_of(FitSettings{}.nuclei)};
  std::string windows;  ///< empty: averaged, or single with --up-range
  bool own_range = false;
  std::string discrepancy{word_of(FitSettings{}.structure)};
  bool stated_errors = false;
  std::string tier{word_of(ErrorTier::fit)};
  std::string template_file;
  std::string plot;
  std::string propose;
  std::string proposal = "proposal.toml";
  int proposed = 1;
  bool statistical_only = false;
  bool force = false;
  bool quiet = false;
};

FitModel model_of(std::string_view name) {
  return std::ranges::find(fit_models, name, &std::pair<std::string_view, FitModel>::first)->second;
}

FitSettings settings(const Options& options) {
  FitSettings settings;
  settings.reference_temperature =
      option_quantity("--reference-temperature", options.reference_temperature, "K", range::positive());
  settings.least_particle_velocity =
      option_quantity("--up-range", options.up_range.at(0), "m/s", range::any());
  settings.most_particle_velocity =
      option_quantity("--up-range", options.up_range.at(1), "m/s", range::any());
  if (!(settings.least_particle_velocity >= 0.0 &&
        settings.most_particle_velocity > settings.least_particle_velocity)) {
    throw InputError(fmt::format("--up-range {} {}: expected two rising velocities, the first >= 0",
                                 options.up_range[0], options.up_range[1]));
  }
  settings.melting = value_of<eos::MeltingTransition>(options.melting).value();
  settings.electrons = options.electrons;
  if (!options.defaults.empty()) settings.defaults = options.defaults;
  settings.bootstrap = options.bootstrap;
  settings.nuclei = value_of<Nuclei>(options.nuclei).value();
  settings.structure = value_of<ErrorStructure>(options.discrepancy).value();
  settings.inflation = !options.stated_errors && !options.statistical_only;
  settings.windows =
      options.own_range || options.statistical_only ? WindowChoice::single : WindowChoice::averaged;
  if (!options.windows.empty()) settings.windows = value_of<WindowChoice>(options.windows).value();
  if (options.statistical_only) settings.model_errors = ModelErrors::none();
  for (const std::string& name : options.measured)
    settings.measured.push_back(process::find_experiment(name));
  for (const std::string& name : options.checked) settings.checked.push_back(process::find_experiment(name));
  if (settings.measured.empty() && !settings.checked.empty())
    throw InputError(
        "--check: predicted by a fit --with other measurements; whipple compare --samples checks "
        "a fit of simulations");
  if (!settings.measured.empty() && model_of(options.model) != FitModel::gray)
    throw InputError("--with: measurements take part in the fit of --model gray only");
  if (!settings.measured.empty() && options.bootstrap > 0)
    throw InputError("--with: --bootstrap draws replicates of simulations alone: leave one of both out");
  settings.correction = options.correct;
  settings.seed = options.seed;
  if (options.correct) {
    if (model_of(options.model) != FitModel::gray ||
        options.melting != word_of(eos::MeltingTransition::equilibrium))
      throw InputError("--correct: corrects the phases of --model gray with --melting equilibrium only");
    settings.correction_samples = options.samples;
  }
  if (!options.density.empty()) {
    settings.density = option_quantity("--density", options.density, "kg/m^3", range::positive());
    if (!(*settings.density > 0.0))
      throw InputError(fmt::format("--density {}: must be > 0", options.density));
  }
  return settings;
}

/// Returns NAME of NAME.md.h5.
std::string stem(const std::filesystem::path& store) {
  std::string name = store.filename().string();
  for (const std::string_view ending : {".md.h5", ".h5"}) {
    if (name.ends_with(ending)) return name.substr(0, name.size() - ending.size());
  }
  return name;
}

/// Checks that a file is a database. @throws InputError for a file that is not one, such as a potential
void require_store(const std::filesystem::path& file) {
  constexpr std::string_view signature = "\x89HDF";
  if (!std::filesystem::is_regular_file(file)) return;  // reported by the reader
  std::ifstream stream(file, std::ios::binary);
  std::string begin(signature.size(), '\0');
  stream.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  if (stream && begin != signature) {
    throw InputError(
        fmt::format("{} is no store of points (NAME.md.h5): simulate first, whipple md PLAN.toml, where the "
                    "plan names the potential",
                    file.string()));
  }
}

/// Returns one material file per database: as many -o as databases, or one -o that is a folder (it exists, or ends
/// with '/').
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

/// Writes an ensemble next to the material NAME.toml: NAME_samples/NAME_1.toml, ...
void write_samples(const Fit& fit, const StoreOrigin& origin,
                   const std::optional<std::filesystem::path>& template_file,
                   const std::filesystem::path& material, const std::optional<PotentialSpread>& spread,
                   const Options& options) {
  const FitSamples samples = fit.correction ? correction_samples(fit)
                                            : sample_fit(fit, options.samples, options.seed,
                                                         value_of<ErrorTier>(options.tier).value(), spread);
  const std::string name = material.stem().string();
  const std::filesystem::path folder = material.parent_path() / (name + "_samples");
  const std::size_t digits = std::to_string(options.samples).size();
  for (std::size_t i = 0; i < samples.fits.size(); ++i) {
    write_file(folder / fmt::format("{}_{:0{}}.toml", name, i + 1, digits),
               material_text(samples.fits[i], origin, template_file), options.force);
  }
  fmt::print("written: {} samples in {}{}\n", samples.fits.size(), folder.string(),
             samples.refused > 0
                 ? fmt::format("; {} draws make no material and were replaced", samples.refused)
                 : "");
}

Fit fit_model(FitModel model, std::span<const md::PointRecord> points, const FitSettings& settings,
              const std::string& store) {
  switch (model) {
    case FitModel::gray:
      return fit_gray(points, settings, store);
    case FitModel::mie_gruneisen:
      return fit_mie_gruneisen(points, settings, store);
    case FitModel::debye_gruneisen:
      return fit_debye_gruneisen(points, settings, store);
  }
  throw InternalError("unknown model of a fit");
}

/// Returns the words of --model.
std::vector<std::string> model_names() {
  std::vector<std::string> names;
  for (const auto& [name, model] : fit_models) names.emplace_back(name);
  return names;
}

/// Returns the scatter over the potentials, by element, for elements with two or more fits. If several databases
/// are of one potential, the first is used.
std::map<std::string, PotentialSpread> spreads_of(const std::vector<NamedFit>& fits,
                                                  const std::vector<StoreOrigin>& origins) {
  std::map<std::string, std::vector<const Fit*>> by_element;
  std::set<std::pair<std::string, std::string>> taken;  // element and potential
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const Fit& fit = fits[i].fit;
    const auto content = origins[i].common.find("potential_sha256");
    const std::string& potential = content == origins[i].common.end() ? fit.potential : content->second;
    if (taken.emplace(fit.element, potential).second) by_element[fit.element].push_back(&fit);
  }
  std::map<std::string, PotentialSpread> spreads;
  for (const auto& [element, members] : by_element) {
    if (const auto spread = potential_spread(members)) spreads.emplace(element, *spread);
  }
  return spreads;
}

/// Writes the next round of `whipple md --adaptive`: a plan of its points, or no file if the campaign is complete.
void propose_round(const Options& options) {
  if (options.stores.size() > 1) throw InputError("--propose works on one store");
  const md::Plan plan = md::read_plan(options.propose);
  if (!plan.adaptive) {
    throw InputError(fmt::format(
        "{}: error: the section [adaptive] is missing: it selects the result that the points shall improve",
        options.propose));
  }
  const std::filesystem::path& store = options.stores.front();
  std::vector<md::PointRecord> points;
  if (std::filesystem::exists(store)) points = md::read_store(store);
  const Proposal proposal = propose(plan, points, options.proposed, store.string());
  for (const std::string& line : proposal.lines) fmt::print("{}\n", line);
  if (proposal.next) {
    write_file(options.proposal, md::plan_text(*proposal.next), true);
  } else {
    fmt::print("adaptive plan at its end: {}\n", proposal.end);
  }
}

void run(const Options& options) {
  if (!options.propose.empty()) {
    propose_round(options);
    return;
  }
  const std::vector<std::filesystem::path> files = material_files(options);
  const FitSettings chosen = settings(options);
  if (!options.plot.empty()) {
    if (options.stores.size() > 1) throw InputError("--plot draws one store: give one");
    require_new_figure(options.plot, options.force);
  }
  std::vector<NamedFit> fits;
  std::vector<StoreOrigin> origins;
  std::vector<std::string> materials;
  std::vector<std::function<void()>> ensembles;
  if (options.samples > 0 && files.empty()) throw InputError("--samples: name the material with -o");
  for (std::size_t i = 0; i < options.stores.size(); ++i) {
    const std::filesystem::path& store = options.stores[i];
    require_store(store);
    const std::vector<md::PointRecord> points = md::read_store(store);
    fits.push_back({stem(store), fit_model(model_of(options.model), points, chosen, store.string())});
    origins.push_back(store_origin(store, points));
  }
  const std::map<std::string, PotentialSpread> spreads = spreads_of(fits, origins);
  for (std::size_t i = 0; i < files.size(); ++i) {
    const Fit& fit = fits[i].fit;
    std::optional<std::filesystem::path> model;
    if (options.template_file.empty()) {
      const auto table = elements::element_defaults(fit.element, fit.settings.defaults);
      model = default_template(table);
      if (!model) {
        log::warning(
            "{}: without strength and failure, a fluid: the table of {} names no template to take them from; "
            "--template FILE names one",
            files[i].string(), table.element);
      }
    } else {
      model = options.template_file;
    }
    if (model && !has_strength(*model)) {
      log::warning("{}: without strength, a fluid, as {}; --template FILE names another", files[i].string(),
                   model->string());
    }
    const auto found = spreads.find(fit.element);
    const std::optional<PotentialSpread> spread =
        found == spreads.end() ? std::nullopt : std::optional(found->second);
    materials.push_back(material_text(fit, origins[i], model, spread));
    if (options.samples > 0) {
      ensembles.emplace_back([&fit, &origin = origins[i], model, spread, file = files[i], &options] {
        write_samples(fit, origin, model, file, spread, options);
      });
    }
  }
  for (std::size_t i = 0; i < files.size(); ++i) write_file(files[i], materials[i], options.force);
  if (!options.plot.empty()) process::draw_json("scripts/plot_fit.py", plot_data(fits.front()), options.plot);

  if (!options.quiet) {
    for (const NamedFit& fit : fits)
      fmt::print("{}: constants and their sources\n{}\n", fit.name, sources_table(fit.fit));
  }
  fmt::print("{}", constants_table(fits));
  for (const auto& [element, spread] : spreads) fmt::print("{}", spread_text(spread));
  if (!options.quiet) {
    for (const NamedFit& fit : fits) fmt::print("\n--- {} ---\n{}", fit.name, fit_details(fit.fit));
  }
  fmt::print("\n");
  if (files.empty()) fmt::print("no material written: name one with -o MATERIAL.toml\n");
  for (const std::filesystem::path& file : files) fmt::print("written: {}\n", file.string());
  for (const auto& write : ensembles) write();
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
      ->check(CLI::IsMember(model_names()))
      ->capture_default_str();
  app.add_option("-o,--output", options.outputs, "Material file to write, or a folder (ending with '/')")
      ->allow_extra_args(false);
  app.add_option(
         "--with", options.measured,
         "Tables of measurements of the metal (docs/manual/equations_of_state.md), or names of those that "
         "come with the program: fitted together with the simulations")
      ->allow_extra_args(true);
  app.add_flag("--correct", options.correct,
               "Add smooth corrections to the free energies of GRAY, so that the material follows isotherm, "
               "isochores, shocks, melting and films of the simulation: model gray_corrected");
  app.add_option("--check", options.checked,
                 "With --with: tables that take no part in the fit and are predicted by it")
      ->allow_extra_args(true);
  app.add_option("--density", options.density,
                 "Measured density: replaces the fitted reference volume, e.g. \"8.9445 g/cm^3\"");
  app.add_option(
      "--electrons", options.electrons,
      "Their heat coefficient g_el, which simulations do not contain: a choice of the element's table "
      "(measured, none, for copper liu2013), or a quantity such as \"0.69 mJ/(mol K^2)\" (default: the "
      "first of the table)");
  app.add_option("--defaults", options.defaults,
                 "Constants of elements that the program does not know, or better ones, FILE.toml "
                 "(whipple describe element)");
  app.add_option("--bootstrap", options.bootstrap,
                 "Errors from so many replicates of the store, drawn from the blocks of its points")
      ->check(CLI::Range(2, 100000));
  app.add_option(
         "--samples", options.samples,
         "Write so many materials more, with constants drawn from the covariance, into NAME_samples/ beside "
         "the material NAME.toml")
      ->check(CLI::Range(1, 100000));
  app.add_option("--seed", options.seed, "Of the samples")->capture_default_str();
  app.add_option("--tier", options.tier,
                 "Errors that samples are drawn from: noise alone, of the fit and its defaults, over the "
                 "potentials of the given stores, or all")
      ->check(CLI::IsMember(word_list<ErrorTier>()))
      ->capture_default_str();
  app.add_option("--melting", options.melting, "Melting transition of the material, and of the fit of T_m0")
      ->check(CLI::IsMember(word_list<eos::MeltingTransition>()))
      ->capture_default_str();
  app.add_option("--reference-temperature", options.reference_temperature,
                 "Temperature of the reference volume and ahead of the simulated shocks")
      ->capture_default_str();
  CLI::Option* up_range =
      app.add_option("--up-range", options.up_range,
                     "Window of particle velocities of the Hugoniot states; given, it is the only one")
          ->expected(2)
          ->capture_default_str();
  app.add_option("--windows", options.windows,
                 "Mean over several windows of particle velocities, whose scatter adds to the errors, or one "
                 "(default: averaged, with --up-range single)")
      ->check(CLI::IsMember(word_list<WindowChoice>()));
  app.add_option("--model-errors", options.discrepancy,
                 "Model errors along a curve of states, or state by state")
      ->check(CLI::IsMember(word_list<ErrorStructure>()))
      ->capture_default_str();
  app.add_option(
         "--nuclei", options.nuclei,
         "Isotherm of --model debye_gruneisen: with what the points of [quantum] add, or as simulated")
      ->check(CLI::IsMember(word_list<Nuclei>()))
      ->capture_default_str();
  app.add_flag("--stated-errors", options.stated_errors,
               "Leave the model errors as stated, whatever chi^2 is");
  app.add_option("--template", options.template_file,
                 "Material whose strength and failure are copied (default: the element's in the library)");
  app.add_option("--plot", options.plot, "Figure of data, fit and residuals, FILE.png");
  CLI::Option* propose = app.add_option(
      "--propose", options.propose,
      "Instead of a fit: the points of the plan PLAN.toml, which has a section [adaptive], that "
      "the store lacks most; whipple md --adaptive computes them");
  app.add_option("--proposal", options.proposal, "Plan of the proposed points; no file if there are none")
      ->needs(propose)
      ->capture_default_str();
  app.add_option("--points", options.proposed, "Proposed at once")
      ->needs(propose)
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
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
  options.own_range = up_range->count() > 0;
  run(options);
  return static_cast<int>(ExitCode::success);
}

}  // namespace
}  // namespace whipple::fit

int main(int argc, char** argv) {
  return whipple::run_guarded("whipple fit", &whipple::fit::main_program, argc, argv);
}
