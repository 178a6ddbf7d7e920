// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/describe_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "eos/files/models.hpp"
#include "md_fitting/elements/element_defaults.hpp"
#include "md_fitting/plan/plan.hpp"
#include "src/app/completion_command.hpp"
#include "src/case/case.hpp"
#include "src/case/shapes/shape.hpp"
#include "src/core/base/catalogue.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/text.hpp"
#include "src/material/constitutive_catalogue.hpp"
#include "src/material/failure/catalogue.hpp"
#include "src/material/material_schema.hpp"
#include "src/material/reaction/catalogue.hpp"
#include "src/material/strength/catalogue.hpp"
#include "src/shields/shield.hpp"
#include "src/sweep/study.hpp"

namespace whipple::app {
namespace {

/// Describes a part of the inputs: its text, for the whole part (empty name) or for one entry.
struct Topic {
  std::string name;
  std::string title;
  std::function<std::string(const std::string&)> text;
  std::function<std::vector<std::string>()> entries;  ///< names that `text` accepts; none: one text only
  std::string (*schema)() = nullptr;  ///< JSON schema of the files; null: the topic is part of a file
};

template <class Entry>
Topic topic_of(std::string name, std::string title, const Catalogue<Entry>& catalogue) {
  return {std::move(name), std::move(title),
          [catalogue](const std::string& entry) { return catalogue.describe(entry); },
          [catalogue] { return catalogue.names(); }, nullptr};
}

std::string single(const std::string& topic, const std::string& name, const std::string& text) {
  if (!name.empty())
    throw InputError(fmt::format("'{}' has no part \"{}\": whipple describe {}", topic, name, topic));
  return text;
}

const std::vector<Topic>& topics() {
  static const std::vector<Topic> all = {
      {"case", "Case files (`whipple run CASE.toml`)",
       [](const std::string& name) { return single("case", name, cases::describe_case()); },
       [] { return std::vector<std::string>(); }, &cases::case_schema},
      topic_of("shape", "Shapes of bodies", cases::shape_catalogue()),
      {"material", "Material files (`material` of a body)",
       [](const std::string& name) { return single("material", name, describe_material()); },
       [] { return std::vector<std::string>(); }, &material_schema},
      topic_of("eos", "Equations of state (`[eos]` of a material file)", eos::all_models()),
      topic_of("modifier",
               "Modifiers of equations of state (`[[eos.modifier]]` of a material file, in order)",
               eos::modifier_catalogue()),
      topic_of("strength", "Strength models (`[strength]` of a material file)", strength::catalogue()),
      topic_of("failure", "Failure criteria (`[[failure]]` of a material file)", failure::catalogue()),
      topic_of("constitutive",
               "Constitutive models (`[constitutive]` of a material file, in place of strength and failure)",
               material::catalogue()),
      topic_of("reaction", "Rate laws of explosives (`[reaction]` of a material file)",
               reaction::catalogue()),
      {"md", "Plans of molecular dynamics (`whipple md PLAN.toml`)",
       [](const std::string& name) { return single("md", name, md::describe_plan()); },
       [] { return std::vector<std::string>(); }, &md::plan_schema},
      {"study", "Studies (`whipple sweep STUDY.toml`)",
       [](const std::string& name) { return single("study", name, sweep::describe_study()); },
       [] { return std::vector<std::string>(); }, &sweep::study_schema},
      {"shield", "Shields (`whipple shield SHIELD.toml`)",
       [](const std::string& name) { return single("shield", name, shields::describe_impact()); },
       [] { return std::vector<std::string>(); }, &shields::impact_schema},
      {"element", "Constants of elements (`whipple fit --defaults FILE.toml`)",
       [](const std::string& name) { return single("element", name, elements::describe_elements()); },
       [] { return std::vector<std::string>(); }, nullptr},
  };
  return all;
}

std::vector<std::string> topic_names() {
  std::vector<std::string> names;
  for (const Topic& topic : topics()) names.push_back(topic.name);
  return names;
}

const Topic& find_topic(const std::string& name) {
  for (const Topic& topic : topics()) {
    if (topic.name == name) return topic;
  }
  const std::vector<std::string> names = topic_names();
  throw InputError(fmt::format("nothing is called \"{}\"{} (known: {})", name, did_you_mean(name, names),
                               fmt::join(names, ", ")));
}

std::string block(const std::string& text) {
  return fmt::format("```text\n{}{}```\n\n", text, text.ends_with('\n') ? "" : "\n");
}

/// Returns the text of docs/manual/input_reference.md.
std::string manual() {
  std::string page =
      "# Input reference\n\n"
      "Written by `whipple describe --markdown` from the parameter tables that the program reads its inputs "
      "with.\n"
      "Quantities are texts with a unit (`\"6.58 km/s\"`); a number without one is an error, but for "
      "0. The column `unit` is the unit in SI.\n"
      "Unknown keys are errors.\n\n";
  for (const Topic& topic : topics()) {
    page += fmt::format("## {}\n\n{}", topic.title, block(topic.text("")));
    for (const std::string& name : topic.entries())
      page += fmt::format("### {}\n\n{}", name, block(topic.text(name)));
  }
  page.pop_back();  // one line break ends the page
  return page;
}

struct DescribeOptions {
  std::string topic;
  std::string name;
  bool markdown = false;
  bool json_schema = false;
};

/// Returns the schema of the files of a topic; by default that of case files.
std::string schema_of(const DescribeOptions& options) {
  const std::string wanted = options.topic.empty() ? "case" : options.topic;
  const Topic& topic = find_topic(wanted);
  if (topic.schema == nullptr || !options.name.empty()) {
    std::vector<std::string> files;
    for (const Topic& other : topics()) {
      if (other.schema != nullptr) files.push_back(other.name);
    }
    throw InputError(
        fmt::format("--json-schema describes a kind of file, one of: {}", fmt::join(files, ", ")));
  }
  return topic.schema();
}

void describe_inputs(const DescribeOptions& options) {
  if (options.json_schema) {
    if (options.markdown) throw InputError("--json-schema and --markdown are two outputs: choose one");
    fmt::print("{}", schema_of(options));
  } else if (options.markdown) {
    if (!options.topic.empty()) throw InputError("--markdown writes everything: leave the topic out");
    fmt::print("{}", manual());
  } else if (options.topic.empty()) {
    for (const Topic& topic : topics()) fmt::print("{:<10}  {}\n", topic.name, topic.title);
    fmt::print("\nsee whipple describe TOPIC [NAME]\n");
  } else {
    fmt::print("{}", find_topic(options.topic).text(options.name));
  }
}

}  // namespace

void add_describe_command(CLI::App& app) {
  auto options = std::make_shared<DescribeOptions>();
  CLI::App* command =
      app.add_subcommand("describe", "Every key of the inputs: unit, range, default, meaning");
  offer(command->add_option("topic", options->topic, "What to describe; without it the topics are listed"),
        [](const std::vector<std::string>& /*before*/) { return topic_names(); });
  offer(command->add_option("name", options->name, "A model, criterion or shape"),
        [](const std::vector<std::string>& before) { return find_topic(before.front()).entries(); });
  command->add_flag("--markdown", options->markdown,
                    "Everything, as the page docs/manual/input_reference.md");
  command->add_flag("--json-schema", options->json_schema,
                    "JSON schema of case files, of material files (topic material), of plans (topic md) or "
                    "of studies, for editors");
  command->footer(
      "Example:\n  whipple describe eos gray\n  whipple describe case --json-schema > case.schema.json");
  command->callback([options] { describe_inputs(*options); });
}

}  // namespace whipple::app
