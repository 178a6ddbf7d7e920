// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/elements/element_defaults.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "src/core/base/error.hpp"
#include "src/core/base/parameter_table.hpp"
#include "src/core/input/document.hpp"
#include "src/core/process/paths.hpp"

namespace whipple::elements {
namespace {

constexpr const char* boiling = "boiling_temperature";
constexpr const char* attraction = "vapour_attraction";

/// Describes a constant that the fit may need, as printed by `describe`.
struct Kind {
  const char* name;
  const char* unit;
  Range range;
  const char* meaning;
  const char* instead = nullptr;  ///< alternative that a fit uses without a row; nullptr: none
};
const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {
      {"melting_point", "K", range::positive(), "measured melting point at atmospheric pressure"},
      {"electronic_heat_coefficient", "J/(mol K^2)", range::non_negative(),
       "g_el of GRAY and debye_gruneisen", "--electrons \"VALUE mJ/(mol K^2)\""},
      {"melting_temperature", "K", range::positive(),
       "T_m0 on the isochore V0, if no coexistence was simulated", "points of [[coexistence]]"},
      {"debye_temperature", "K", range::positive(),
       "of debye_gruneisen, if no elastic constants were simulated", "points of [elastic] or [quantum]"},
      {"join_volume_ratio", "", range::open_between(1.0, 2.0), "V_J/V0 of GRAY's vapour"},
      {boiling, "K", range::positive(), "of GRAY's vapour at 101325 Pa",
       "vapour_attraction, or [liquid_vapour] of two temperatures"},
      {attraction, "J m^3/kg^2", range::positive(),
       "a_y of GRAY's vapour, instead of its boiling temperature"},
      {"hugoniot_quadratic", "", range::any(), "S2 of the shock curve"},
      {"hugoniot_cubic", "", range::any(), "S3 of the shock curve"},
      {"electronic_gruneisen", "", range::any(), "gamma_e of GRAY"},
      {"melting_entropy", "J/(mol K)", range::positive(),
       "Delta S of GRAY, if no heat of fusion was simulated"},
      {"liquid_heat_coefficient", "J/(mol K)", range::non_negative(), "alpha of GRAY"},
      {"hot_liquid_ratio", "", {.lower = 2.0, .lower_open = true}, "T_G/T_m of GRAY"},
      {"covolume_ratio", "", range::open_between(0.0, 1.0), "V_b/V0 of GRAY"},
      {"join_shape", "", range::positive(), "theta of GRAY"},
  };
  return all;
}

struct SourceText {
  std::string name, text;
  static const ParameterTable<SourceText>& parameters() {
    static const ParameterTable<SourceText> table = {
        whipple::text("name", &SourceText::name, "short name that rows use"),
        whipple::text("text", &SourceText::text, "the source")};
    return table;
  }
};

/// Holds the words of a row; its value and error have the unit of its parameter.
struct RowWords {
  std::string parameter, name = "given", source, evidence{word_of(Evidence::chosen)}, error_source;
  static const ParameterTable<RowWords>& parameters() {
    static const ParameterTable<RowWords> table = [] {
      std::vector<std::string> names;
      for (const Kind& kind : kinds()) names.emplace_back(kind.name);
      return ParameterTable<RowWords>{
          choice("parameter", &RowWords::parameter, names, "which constant"),
          whipple::text("name", &RowWords::name,
                        "of this choice; of several rows of a parameter the first is the default")
              .optional(),
          choice("class", &RowWords::evidence, word_list<Evidence>(), "what the value rests on").optional(),
          whipple::text("source", &RowWords::source, "of the value: a text, or the name of a [[source]]"),
          whipple::text("error_source", &RowWords::error_source, "of the error").optional()};
    }();
    return table;
  }
};

struct ElementWords {
  std::string symbol, metal, template_name;
  static const ParameterTable<ElementWords>& parameters() {
    static const ParameterTable<ElementWords> table = {
        whipple::text("symbol", &ElementWords::symbol, "chemical symbol, as in the potential"),
        whipple::text("metal", &ElementWords::metal, "name of the material")
            .optional("that of the program, or the symbol"),
        whipple::text("template", &ElementWords::template_name,
                      "material of the library with strength and failure; \"none\": without")
            .optional("that of the program, else none")};
    return table;
  }
};

BoundParameter number(const char* key, const Kind& kind, bool required, double& target) {
  ParameterInfo info;
  info.name = key;
  info.unit = kind.unit;
  info.range = kind.range;
  info.meaning = kind.meaning;
  info.required = required;
  return {info, &target};
}

NamedDefault read_row(input::Table& table, const std::map<std::string, std::string>& sources) {
  NamedDefault row;
  RowWords words;
  if (!table.read(RowWords::parameters(), words)) {
    for (const char* key : {"value", "error"}) table.accept(key);
    return row;
  }
  const Kind& kind = *std::ranges::find(kinds(), words.parameter, &Kind::name);
  row.parameter = words.parameter;
  row.name = words.name;
  row.evidence = value_of<Evidence>(words.evidence).value();
  const auto resolved = [&](const std::string& text) {
    const auto found = sources.find(text);
    return found == sources.end() ? text : found->second;
  };
  row.source = resolved(words.source);
  row.error_source = resolved(words.error_source);
  Kind error = kind;
  error.range = range::positive();
  error.meaning = "one standard deviation";
  const std::vector<BoundParameter> numbers = {number("value", kind, true, row.value),
                                               number("error", error, false, row.error)};
  table.read(numbers);
  return row;
}

std::vector<NamedDefault> read_rows(std::vector<input::Table> tables,
                                    const std::map<std::string, std::string>& sources) {
  std::vector<NamedDefault> rows;
  for (input::Table& table : tables) rows.push_back(read_row(table, sources));
  return rows;
}

/// Specifies the entry of a file for strength and failure.
enum class Template { as_before, named, none };
constexpr std::array<Word<Template>, 1> words(Template) { return {{{Template::none, "none"}}}; }

struct Element {
  ElementDefaults table;
  Template strength_and_failure;
};

struct Contents {
  std::vector<NamedDefault> common;
  std::vector<Element> elements;
};

Contents read_contents(const std::filesystem::path& file) {
  input::Document document = input::Document::from_file(file);
  input::Table root = document.root();
  std::map<std::string, std::string> sources;
  for (input::Table& table : root.list("source")) {
    SourceText source;
    if (table.read(SourceText::parameters(), source)) sources[source.name] = source.text;
  }
  Contents contents;
  contents.common = read_rows(root.list("common"), sources);
  for (input::Table& table : root.list("element")) {
    ElementWords words;
    table.read(ElementWords::parameters(), words);
    const bool given = table.has("template");
    if (given && words.template_name.empty())
      table.error_at("template", "names no material; \"none\": without strength and failure");
    Element element{{words.symbol, words.metal, {}, read_rows(table.list("constant"), sources)},
                    Template::as_before};
    if (given) {
      element.strength_and_failure = value_of<Template>(words.template_name).value_or(Template::named);
      element.table.template_name = words.template_name;
    }
    contents.elements.push_back(std::move(element));
  }
  document.finish();
  return contents;
}

/// Replaces rows by those of the same parameters.
void replace(std::vector<NamedDefault>& rows, const std::vector<NamedDefault>& others) {
  std::erase_if(rows, [&](const NamedDefault& row) {
    // A boiling temperature and an attraction are alternative specifications of the vapour.
    const auto of_vapour = [](const NamedDefault& entry) {
      return entry.parameter == boiling || entry.parameter == attraction;
    };
    return std::ranges::any_of(others, [&](const NamedDefault& other) {
      return other.parameter == row.parameter || (of_vapour(row) && of_vapour(other));
    });
  });
  rows.insert(rows.end(), others.begin(), others.end());
}

void apply(ElementDefaults& table, const Contents& contents) {
  replace(table.constants, contents.common);
  for (const auto& [entry, strength_and_failure] : contents.elements) {
    if (entry.element != table.element) continue;
    if (!entry.metal.empty()) table.metal = entry.metal;
    if (strength_and_failure == Template::named) table.template_name = entry.template_name;
    if (strength_and_failure == Template::none) table.template_name.reset();
    replace(table.constants, entry.constants);
  }
}

const Contents& of_the_program() {
  static const Contents contents = read_contents(process::find_data("eos/data/elements.toml"));
  return contents;
}

}  // namespace

const NamedDefault* ElementDefaults::find(std::string_view parameter) const {
  const auto found = std::ranges::find(constants, parameter, &NamedDefault::parameter);
  return found == constants.end() ? nullptr : &*found;
}

const NamedDefault& ElementDefaults::at(std::string_view parameter) const {
  if (const NamedDefault* found = find(parameter)) return *found;
  throw InputError(missing_text(element, {std::string(parameter)}));
}

std::string missing_text(std::string_view element, const std::vector<std::string>& parameters) {
  return fmt::format("no default of {} for the element '{}': {}; the program knows {}",
                     fmt::join(parameters, ", "), element, remedies(parameters),
                     fmt::join(known_elements(), ", "));
}

std::string remedies(const std::vector<std::string>& parameters) {
  std::vector<std::string> each;
  for (const std::string& parameter : parameters) {
    const auto kind = std::ranges::find(kinds(), parameter, &Kind::name);
    const bool other = kind != kinds().end() && kind->instead != nullptr;
    each.push_back(fmt::format("{}: {}a row in --defaults FILE", parameter,
                               other ? fmt::format("{}, or ", kind->instead) : ""));
  }
  return fmt::format("{} (whipple describe element); --model mie_gruneisen needs none",
                     fmt::join(each, "; "));
}

std::vector<const NamedDefault*> ElementDefaults::choices(std::string_view parameter) const {
  std::vector<const NamedDefault*> found;
  for (const NamedDefault& entry : constants) {
    if (entry.parameter == parameter) found.push_back(&entry);
  }
  return found;
}

ElementDefaults element_defaults(std::string_view element,
                                 const std::optional<std::filesystem::path>& file_of_user) {
  ElementDefaults table;
  table.element = table.metal = std::string(element);
  apply(table, of_the_program());
  if (file_of_user) apply(table, read_contents(*file_of_user));
  return table;
}

std::vector<std::string> known_elements() {
  std::vector<std::string> symbols;
  for (const Element& entry : of_the_program().elements) symbols.push_back(entry.table.element);
  return symbols;
}

std::string describe_elements() {
  std::string text =
      "Constants that simulations of nuclei do not determine. `whipple fit --defaults FILE` reads them from "
      "a file of "
      "this form; its rows replace those of the program (eos/data/elements.toml), which knows " +
      fmt::format("{}.\n\n[[element]]\n{}", fmt::join(known_elements(), ", "),
                  describe_table(ElementWords::parameters())) +
      "\n[[element.constant]], [[common]] for all elements: value (with its unit), error (one standard "
      "deviation, "
      "optional) and\n" +
      describe_table(RowWords::parameters()) + "\nparameter:\n";
  for (const Kind& kind : kinds()) {
    text += fmt::format("  {:<28} {:<13} {:<14} {}\n", kind.name, kind.unit[0] == '\0' ? "-" : kind.unit,
                        kind.range.text(), kind.meaning);
  }
  text += "\n[[source]]: a text that several rows name\n" + describe_table(SourceText::parameters());
  return text;
}

}  // namespace whipple::elements
