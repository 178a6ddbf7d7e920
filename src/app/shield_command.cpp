// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/shield_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "src/analysis/outcome.hpp"
#include "src/app/command_line.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/log.hpp"
#include "src/core/base/option_quantity.hpp"
#include "src/core/base/text.hpp"
#include "src/core/base/text_table.hpp"
#include "src/shields/alloys.hpp"
#include "src/shields/case_text.hpp"
#include "src/shields/equations.hpp"
#include "src/shields/shots.hpp"

namespace whipple::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct ShieldArguments {
  std::string input, output, cell_size, body = "wall";
  std::vector<std::string> shots, speeds;
  shields::Model model = shields::Model::section;
  shields::FoamModel foam = shields::CaseOptions{}.foam;
  std::uint64_t seed = shields::CaseOptions{}.seed;
  double most_across = shields::CaseOptions{}.most_across;
  bool outcome = false, dry_run = false, json = false;
};

/// Holds a shot and what would be computed of it.
struct Planned {
  shields::Shot shot;
  shields::Layout layout;
  std::string text;     ///< of the case
  std::string refused;  ///< why no case is made; empty: one is
};

std::vector<shields::Shot> read_input(const ShieldArguments& arguments) {
  const fs::path file = arguments.input;
  std::vector<shields::Shot> all;
  if (file.extension() == ".toml") {
    all.push_back({.impact = shields::read_impact(file), .source = {}, .result = {}});
  } else {
    all = shields::read_shots(file);
  }
  if (arguments.shots.empty()) return all;
  std::vector<shields::Shot> chosen;
  std::vector<std::string> names;
  for (const shields::Shot& shot : all)
    names.push_back(shot.source.empty() ? shot.impact.name : shot.source + "/" + shot.impact.name);
  for (const std::string& name : arguments.shots) {
    const auto found = std::ranges::find(names, name);
    if (found == names.end())
      throw InputError(
          fmt::format("{} has no shot \"{}\"{}", file.string(), name, did_you_mean(name, names)));
    if (std::ranges::count(names, name) > 1)
      throw InputError(fmt::format("{} has several shots \"{}\"", file.string(), name));
    chosen.push_back(all[static_cast<std::size_t>(found - names.begin())]);
  }
  return chosen;
}

shields::CaseOptions case_options(const ShieldArguments& arguments) {
  shields::CaseOptions options{.model = arguments.model,
                               .foam = arguments.foam,
                               .seed = arguments.seed,
                               .cell_size = {},
                               .most_across = arguments.most_across};
  if (!arguments.cell_size.empty())
    options.cell_size = option_quantity("--cell-size", arguments.cell_size, "m", range::positive());
  return options;
}

Planned plan(shields::Shot shot, const shields::CaseOptions& options) {
  Planned planned{.shot = std::move(shot), .layout = {}, .text = {}, .refused = {}};
  try {
    planned.layout = shields::layout_of(planned.shot.impact, options);
    planned.text = shields::case_text(planned.shot.impact, planned.layout);
  } catch (const InputError& error) {
    planned.refused = error.what();
  }
  return planned;
}

Json equations_as_json(const shields::Impact& impact) {
  Json all = Json::object();
  for (const auto& word : words(shields::Equation{})) {
    const std::string reason = shields::reason_against(word.value, impact);
    Json& entry = all[std::string(word.text)];
    entry["critical_diameter"] =
        reason.empty() ? Json(shields::critical_diameter(word.value, impact)) : Json(nullptr);
    if (!reason.empty()) entry["reason"] = reason;
  }
  return all;
}

Json case_as_json(const Planned& planned) {
  if (!planned.refused.empty()) return {{"refused", planned.refused}};
  const shields::Layout& layout = planned.layout;
  Json sheets = Json::array();
  for (const shields::Plate& plate : layout.plates)
    sheets.push_back({{"name", plate.name}, {"cells", plate.cells}, {"resolved", plate.resolved}});
  return {{"model", word_of(layout.model)},
          {"foam", layout.foam ? Json(word_of(layout.foam_model)) : Json(nullptr)},
          {"cell_size", layout.cell_size},
          {"chosen_by", layout.chosen_by},
          {"cells_across_sphere", layout.cells_across},
          {"sheets", sheets},
          {"resolved", shields::not_resolved(layout).empty()},
          {"particles", std::round(layout.particles)},
          {"end", layout.end},
          {"materials", shields::remarks_on_materials(planned.shot.impact, layout)}};
}

Json as_json(const Planned& planned) {
  const shields::Impact& impact = planned.shot.impact;
  Json bumpers = Json::array();
  for (const shields::Bumper& bumper : impact.shield.bumpers)
    bumpers.push_back(
        {{"alloy", bumper.sheet.alloy}, {"thickness", bumper.sheet.thickness}, {"spacing", bumper.spacing}});
  return {{"name", impact.name},
          {"source", planned.shot.source},
          {"result", planned.shot.result ? Json(word_of(*planned.shot.result)) : Json(nullptr)},
          {"sphere",
           {{"alloy", impact.projectile.alloy},
            {"diameter", impact.projectile.diameter},
            {"velocity", impact.projectile.velocity},
            {"angle", impact.projectile.angle}}},
          {"bumpers", bumpers},
          {"wall", {{"alloy", impact.shield.wall.alloy}, {"thickness", impact.shield.wall.thickness}}},
          {"equations", equations_as_json(impact)},
          {"case", case_as_json(planned)}};
}

/// Prints each shot with the equations that apply, and the cells of its case.
void print_plan(const std::vector<Planned>& all) {
  for (const Planned& planned : all) {
    const shields::Impact& impact = planned.shot.impact;
    fmt::print("{}{:.4g} mm {} sphere, {:.4g} km/s, {:.3g} degrees{}\n",
               impact.name + (impact.name.empty() ? "" : ": "), 1e3 * impact.projectile.diameter,
               impact.projectile.alloy, 1e-3 * impact.projectile.velocity,
               impact.projectile.angle * 180.0 / std::numbers::pi,
               planned.shot.result ? fmt::format(", measured {}", word_of(*planned.shot.result)) : "");
    std::vector<std::vector<std::string>> rows;
    for (const auto& word : words(shields::Equation{})) {
      if (!shields::reason_against(word.value, impact).empty()) continue;
      const double d = shields::critical_diameter(word.value, impact);
      rows.push_back({"  " + std::string(word.text), fmt::format("{:.4g} mm", 1e3 * d),
                      impact.projectile.diameter > d ? "P" : "NP",
                      std::string(shields::source_of(word.value))});
    }
    fmt::print("{}", text_table(rows, "lrll"));
    if (shields::reason_against_design(impact).empty()) {
      const shields::Design design = shields::whipple_design(impact);
      fmt::print("  a design for this sphere: bumper of {:.3g} mm, wall of {:.3g} mm\n", 1e3 * design.bumper,
                 1e3 * design.wall);
    }
    if (!planned.refused.empty()) {
      fmt::print("  no case: {}\n", planned.refused);
      continue;
    }
    const shields::Layout& layout = planned.layout;
    std::vector<std::string> cells;
    for (const shields::Plate& plate : layout.plates)
      cells.push_back(fmt::format("{} {:.3g}", plate.name, plate.cells));
    fmt::print("  case: {}, cells of {:.4g} mm ({}): sphere {:.3g}, {}; about {:.0f} particles\n",
               word_of(layout.model), 1e3 * layout.cell_size, layout.chosen_by, layout.cells_across,
               fmt::join(cells, ", "), layout.particles);
    const std::string thin = shields::not_resolved(layout);
    if (!thin.empty()) fmt::print("  not resolved: {}\n", thin);
    for (const std::string& remark : shields::remarks_on_materials(impact, layout))
      fmt::print("  {}\n", remark);
  }
}

std::string refusal_of(const fs::path& folder) {
  return fmt::format("{} exists: give another folder with -o", folder.string());
}

/// Writes a file of a folder that did not exist before.
void write_new(const fs::path& folder, const char* name, const std::string& text) {
  if (fs::exists(folder)) throw InputError(refusal_of(folder));
  make_folder(folder);
  write_text_atomically(folder / name, text);
}

/// Returns a name as one part of a path.
std::string folder_name(const shields::Shot& shot) {
  std::string name = shot.source.empty() ? shot.impact.name : shot.source + "_" + shot.impact.name;
  const auto keep = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' ||
           c == '_' || c == '.';
  };
  std::ranges::replace_if(name, [&](char c) { return !keep(c); }, '_');
  return name;
}

void write_cases(const std::vector<Planned>& all, const fs::path& output, bool dry_run) {
  std::vector<InputFault> faults;
  std::vector<std::string> names;
  std::vector<fs::path> folders;
  for (const Planned& planned : all) {
    if (!planned.refused.empty()) faults.push_back({.text = planned.refused});
    names.push_back(folder_name(planned.shot));
    if (all.size() > 1 && (names.back().empty() || std::ranges::count(names, names.back()) > 1))
      faults.push_back(
          {.text = fmt::format("several shots \"{}\": a folder needs a name of its own", names.back())});
    folders.push_back(all.size() == 1 ? output : output / names.back());
    if (fs::exists(folders.back())) faults.push_back({.text = refusal_of(folders.back())});
  }
  if (!faults.empty()) throw InputError(std::move(faults));
  for (std::size_t k = 0; k < all.size(); ++k) {
    const fs::path& folder = folders[k];
    if (!dry_run) write_new(folder, "case.toml", all[k].text);
    log::info("{} {}", dry_run ? "would write" : "wrote", (folder / "case.toml").string());
  }
}

/// Writes the study of a limit: spheres from half of the smallest to twice the largest critical diameter by NNO, in
/// cells of the rule for their geometric mean.
void write_limit(const ShieldArguments& arguments, const shields::Shot& shot) {
  const fs::path folder = arguments.output;
  if (fs::exists(folder)) throw InputError(refusal_of(folder));
  if (shot.impact.projectile.angle > 0.0)
    throw InputError("--limit: the study varies the speed of normal impacts; the angle of this one is not 0");
  std::vector<double> speeds;
  std::array<double, 2> between = {1e300, 0.0};
  for (const std::string& text : arguments.speeds) {
    shields::Impact at = shot.impact;
    at.projectile.velocity = option_quantity("--limit", text, "m/s", range::positive());
    speeds.push_back(at.projectile.velocity);
    const double d = shields::critical_diameter(shields::Equation::nno_1993, at);
    between = {std::min(between[0], 0.5 * d), std::max(between[1], 2.0 * d)};
  }
  shields::CaseOptions options = case_options(arguments);
  shields::Impact impact = shot.impact;
  impact.projectile.velocity = std::ranges::min(speeds);
  impact.projectile.diameter = std::sqrt(between[0] * between[1]);
  if (!options.cell_size) options.cell_size = shields::layout_of(impact, options).cell_size;
  impact.projectile.diameter = between[1];
  const shields::Layout layout = shields::layout_of(impact, options);
  const std::string text = shields::case_text(impact, layout);
  const std::string study = shields::study_text(impact, layout, speeds, between);
  fmt::print("spheres of {:.4g} to {:.4g} mm, cells of {:.4g} and {:.4g} mm\n", 1e3 * between[0],
             1e3 * between[1], 1e3 * layout.cell_size, 1e3 * layout.cell_size / 1.4);
  if (!arguments.dry_run) {
    write_new(folder, "case.toml", text);
    write_text_atomically(folder / "study.toml", study);
  }
  log::info("{} {}: whipple sweep computes it", arguments.dry_run ? "would write" : "wrote",
            (folder / "study.toml").string());
}

void print_outcome(const ShieldArguments& arguments) {
  const analysis::Verdict verdict = analysis::judge(analysis::read_run(arguments.input), arguments.body);
  const std::string_view word = word_of(verdict.outcome);
  const bool decided = std::isfinite(verdict.time);
  if (arguments.json) {
    const Json result = {{"body", arguments.body},
                         {"outcome", word},
                         {"defeated", decided ? Json(verdict.is_defeat()) : Json(nullptr)},
                         {"time", decided ? Json(verdict.time) : Json(nullptr)},
                         {"reason", verdict.reason}};
    fmt::print("{}\n", result.dump(1));
    return;
  }
  fmt::print("{}: {}{}: {}\n", arguments.body, word,
             decided ? fmt::format(" at {:.4g} us", 1e6 * verdict.time) : "", verdict.reason);
}

void run_shield(const ShieldArguments& arguments) {
  if (arguments.outcome) {
    print_outcome(arguments);
    return;
  }
  const std::vector<shields::Shot> shots = read_input(arguments);
  if (!arguments.speeds.empty()) {
    if (shots.size() != 1) throw InputError("--limit is of one shield: choose a row with --shot");
    if (arguments.output.empty()) throw InputError("--limit needs the folder of the study: -o FOLDER");
    write_limit(arguments, shots.front());
    return;
  }
  const shields::CaseOptions options = case_options(arguments);
  std::vector<Planned> all;
  for (const shields::Shot& shot : shots) all.push_back(plan(shot, options));
  if (arguments.json) {
    Json list = Json::array();
    for (const Planned& planned : all) list.push_back(as_json(planned));
    fmt::print("{}\n", list.dump(1));
  } else {
    print_plan(all);
  }
  if (!arguments.output.empty()) write_cases(all, arguments.output, arguments.dry_run);
}

}  // namespace

void add_shield_command(CLI::App& app) {
  auto arguments = std::make_shared<ShieldArguments>();
  CLI::App* command = app.add_subcommand(
      "shield", "Shields: critical diameters by equations, cases of shots, outcome of a run");
  command
      ->add_option("input", arguments->input,
                   "A shield (SHIELD.toml), a table of shots (SHOTS.csv), or a run")
      ->required();
  command->add_option("-o,--output", arguments->output, "Folder of the case, or of one case for each shot");
  command
      ->add_option(
          "--shot", arguments->shots,
          "This row of the table alone: SHOT, or SOURCE/SHOT where the table names sources (repeatable)")
      ->allow_extra_args(false);
  add_word_option(
      *command, "--model", arguments->model,
      "section: through the axis, normal impact (default) | space: a quarter, or half if oblique");
  add_word_option(*command, "--foam", arguments->foam,
                  "layer: a porous material (default) | struts: of random cells, in space");
  command->add_option("--seed", arguments->seed, "Selects one of many random foams (default: 1)")
      ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1'000'000'000}));
  command
      ->add_option("--cell-size", arguments->cell_size, "Edge of the cells (default: by sphere and sheets)")
      ->type_name("LENGTH");
  command->add_option("--most-across", arguments->most_across, "Most cells across the sphere by that rule")
      ->check(CLI::Range(4.0, 1000.0))
      ->capture_default_str();
  command
      ->add_option("--limit", arguments->speeds,
                   "Write the study of the critical diameter at this speed instead (repeatable)")
      ->type_name("SPEED")
      ->allow_extra_args(false);
  command->add_flag("--outcome", arguments->outcome, "What became of the wall of a run, when and why");
  command->add_option("--body", arguments->body, "The wall, with --outcome")->capture_default_str();
  command->add_flag("--dry-run", arguments->dry_run, "Check and print, write nothing");
  command->add_flag("--json", arguments->json, "The same for programs (SI)");
  command->footer(
      "Examples:\n  whipple shield shots.csv --shot Ryan_2011/HD9920040             equations and cells\n"
      "  whipple shield shots.csv --shot Ryan_2011/HD9920040 -o run/shot its case as well\n"
      "  whipple shield shield.toml --limit '3 km/s' --limit '6 km/s' -o run/limit\n"
      "  whipple shield run/shot/run --outcome\n"
      "whipple describe shield lists the keys of SHIELD.toml.");
  command->callback([arguments] { run_shield(*arguments); });
}

}  // namespace whipple::app
