// SPDX-License-Identifier: BSD-3-Clause
#include "src/decks/dyna_fields.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "src/decks/unit_system.hpp"

namespace whipple::decks::dyna {
namespace {

constexpr double forever = 1e16;

FieldRule read(std::string_view name) { return {.name = name}; }
FieldRule method(std::string_view name) { return {.name = name, .use = FieldUse::method}; }
FieldRule fixed(std::string_view name, std::string_view meaning, std::vector<double> neutral = {0.0}) {
  return {.name = name, .use = FieldUse::neutral, .meaning = meaning, .neutral = std::move(neutral)};
}
FieldRule unlimited(std::string_view name, std::string_view meaning) {
  FieldRule rule = fixed(name, meaning);
  rule.until_forever = true;
  return rule;
}
CardRule card(std::vector<FieldRule> fields) { return {.fields = std::move(fields)}; }
CardRule methods() { return card(std::vector<FieldRule>(8, method(""))); }
CardRule heading() { return {.fields = {}, .is_text = true}; }
KeywordRule once(std::vector<CardRule> cards) { return {.cards = std::move(cards)}; }
KeywordRule again(std::vector<CardRule> cards) { return {.cards = std::move(cards), .repeats = true}; }

CardRule curve_points(std::string_view name, std::string_view meaning) {
  std::vector<FieldRule> fields(8, fixed(name, meaning));
  return card(std::move(fields));
}

std::map<std::string_view, KeywordRule> general_rules() {
  return {
      {"CONTROL_TERMINATION",
       once({card({read("ENDTIM"), fixed("ENDCYC", "the number of steps after which the run ends"),
                   method("DTMIN"), method("ENDENG"), method("ENDMAS"),
                   fixed("NOSOL", "a run without a solution")})})},
      {"CONTROL_SOLUTION",
       once({card({fixed("SOLN", "heat conduction"), method("NLQ"), method("ISNAN"), method("LCINT"),
                   method("LCACC"), method("NCDCF"), method("NOCOPY")})})},
      {"CONTROL_TIMESTEP", once({card({method("DTINIT"), method("TSSFAC"), method("ISDO"), method("TSLIMT"),
                                       method("DT2MS"), method("LCTM"), method("ERODE"), method("MS1ST")}),
                                 methods()})},
      {"CONTROL_CONTACT",
       once({methods(), methods(),
             card({fixed("SFRIC", "friction of contacts that state none"),
                   fixed("DFRIC", "friction of contacts that state none"), method("EDC"), method("VFC"),
                   method("TH"), method("TH_SF"), method("PEN_SF"), method("PTSCL")}),
             methods(), methods(), methods(), methods()})},
      {"CONTROL_SPH",
       once({card({method("NCBS"), fixed("BOXID", "a box beyond which points are taken away"),
                   unlimited("DT", "a time at which points are taken away"),
                   fixed("IDIM", "two dimensions", {0.0, 3.0}), method("NMNEIGH"), method("FORM"),
                   fixed("START", "a time at which points come in"), method("MAXV")}),
             methods(), methods()})},
      {"CONTROL_ALE",
       once({methods(), methods(),
             card({method("PRIT"), fixed("PREF", "a pressure upon the outer faces"), method("NSIDEBC"),
                   method("NCPL"), method("NBKT"), method("IMASCL"), method("CHECKR")}),
             methods()})},
      {"SECTION_SOLID",
       again({card({read("SECID"), read("ELFORM"), fixed("AET", "a part that keeps its state (ambient)"),
                    fixed("field 4", "not known"), fixed("field 5", "not known"),
                    fixed("field 6", "not known"), method("COHOFF"), method("GASKETT")})})},
      {"SECTION_SPH",
       again({card({read("SECID"), method("CSLH"), method("HMIN"), method("HMAX"), method("SPHINI"),
                    unlimited("DEATH", "a time at which points are taken away"),
                    fixed("START", "a time at which points come in"), method("SPHKERN")})})},
      {"PART", again({heading(), card({read("PID"), read("SECID"), read("MID"), read("EOSID"), method("HGID"),
                                       fixed("GRAV", "gravity of *LOAD_DENSITY_DEPTH"), method("ADPOPT"),
                                       fixed("TMID", "a thermal material")})})},
      {"INITIAL_VELOCITY",
       once(
           {card({read("NSID"), fixed("NSIDEX", "nodes that are exempt"), fixed("BOXID", "nodes of a box"),
                  fixed("IRIGID", "velocities of rigid bodies"), fixed("ICID", "a local coordinate system")}),
            card({read("VX"), read("VY"), read("VZ"), fixed("VXR", "angular velocity"),
                  fixed("VYR", "angular velocity"), fixed("VZR", "angular velocity")})})},
      {"INITIAL_VELOCITY_NODE",
       again({card({read("NID"), read("VX"), read("VY"), read("VZ"), fixed("VXR", "angular velocity"),
                    fixed("VYR", "angular velocity"), fixed("VZR", "angular velocity"),
                    fixed("ICID", "a local coordinate system")})})},
      {"INITIAL_VELOCITY_GENERATION",
       once({card({read("ID"), read("STYP"), fixed("OMEGA", "angular velocity"), read("VX"), read("VY"),
                   read("VZ"), fixed("IVATN", "velocities of slaves of rigid bodies"),
                   fixed("ICID", "a local coordinate system")}),
             card({method("XC"), method("YC"), method("ZC"), method("NX"), method("NY"), method("NZ"),
                   fixed("PHASE", "velocities after dynamic relaxation"),
                   fixed("IRIGID", "velocities of rigid bodies")})})},
      {"INITIAL_DETONATION",
       again({card({read("PID"), read("X"), read("Y"), read("Z"), read("LT"), method("field 6"),
                    fixed("MMGSET", "a group of materials of ALE")})})},
      {"CONTACT",
       once({card({read("SSID"), read("MSID"), read("SSTYP"), read("MSTYP"),
                   fixed("SBOXID", "contact within a box"), fixed("MBOXID", "contact within a box"),
                   method("SPR"), method("MPR")}),
             card({read("FS"), read("FD"), read("DC"), fixed("VC", "a limit of the friction stress"),
                   method("VDC"), method("PENCHK"), fixed("BT", "a time at which contact begins"),
                   unlimited("DT", "a time at which contact ends")}),
             card({method("SFS"), method("SFM"), method("SST"), method("MST"), method("SFST"), method("SFMT"),
                   fixed("FSF", "a factor of the friction", {0.0, 1.0}),
                   fixed("VSF", "a factor of the friction stress", {0.0, 1.0})}),
             methods(), methods(), methods(), methods(), methods(), methods()})}};
}

std::map<std::string_view, KeywordRule> material_rules() {
  return {
      {"MAT_ELASTIC", once({card({read("MID"), read("RO"), read("E"), read("PR"), method("DA"), method("DB"),
                                  fixed("K", "the bulk modulus of a fluid")})})},
      {"MAT_PLASTIC_KINEMATIC",
       once({card({read("MID"), read("RO"), read("E"), read("PR"), read("SIGY"), read("ETAN"), read("BETA")}),
             card({fixed("SRC", "rate dependence of Cowper and Symonds"),
                   fixed("SRP", "rate dependence of Cowper and Symonds"), read("FS"), method("VP")})})},
      {"MAT_HIGH_EXPLOSIVE_BURN", once({card({read("MID"), read("RO"), read("D"), read("PCJ"), read("BETA"),
                                              fixed("K", "stiffness of the unreacted explosive"),
                                              fixed("G", "strength of the unreacted explosive"),
                                              fixed("SIGY", "strength of the unreacted explosive")})})},
      {"MAT_NULL",
       once({card({read("MID"), read("RO"), read("PC"), read("MU"),
                   fixed("TEROD", "elements taken away in expansion"),
                   fixed("CEROD", "elements taken away in compression"), method("YM"), method("PR")})})},
      {"MAT_ELASTIC_PLASTIC_HYDRO",
       once({card({read("MID"), read("RO"), read("G"), read("SIGY"), read("EH"), read("PC"), read("FS"),
                   fixed("CHARL", "elements taken away at a border")}),
             curve_points("EPS", "a table of yield stress over plastic strain"),
             curve_points("EPS", "a table of yield stress over plastic strain"),
             curve_points("ES", "a table of yield stress over plastic strain"),
             curve_points("ES", "a table of yield stress over plastic strain")})},
      {"MAT_JOHNSON_COOK",
       once({card({read("MID"), read("RO"), read("G"), read("E"), read("PR"), method("DTF"), read("VP"),
                   fixed("RATEOP", "another law of the strain rate than ln")}),
             card({read("A"), read("B"), read("N"), read("C"), read("M"), read("TM"), read("TR"),
                   read("EPSO")}),
             card({read("CP"), read("PC"), read("SPALL"), method("IT"), read("D1"), read("D2"), read("D3"),
                   read("D4")}),
             card({read("D5"), fixed("C2/P", "a constant of another law of the strain rate"), read("EROD"),
                   read("EFMIN"), method("NUMINT"), fixed("K", "not known"), fixed("EPS1", "not known")})})},
      {"MAT_PIECEWISE_LINEAR_PLASTICITY",
       once({card({read("MID"), read("RO"), read("E"), read("PR"), read("SIGY"), read("ETAN"), read("FAIL"),
                   fixed("TDEL", "elements taken away below a time step")}),
             card({fixed("C", "rate dependence of Cowper and Symonds"),
                   fixed("P", "rate dependence of Cowper and Symonds"),
                   fixed("LCSS", "a curve of yield stress over plastic strain"),
                   fixed("LCSR", "a curve of yield stress over strain rate"), method("VP"), method("LCF")}),
             curve_points("EPS", "a table of yield stress over plastic strain"),
             curve_points("ES", "a table of yield stress over plastic strain")})},
      {"MAT_SIMPLIFIED_JOHNSON_COOK",
       once({card({read("MID"), read("RO"), read("E"), read("PR"), read("VP")}),
             card({read("A"), read("B"), read("N"), read("C"), read("PSFAIL"),
                   unlimited("SIGMAX", "greatest stress"), unlimited("SIGSAT", "greatest stress"),
                   read("EPSO")})})},
      {"EOS_GRUNEISEN", once({card({read("EOSID"), read("C"), read("S1"), read("S2"), read("S3"),
                                    read("GAMAO"), read("A"), read("E0")}),
                              card({fixed("V0", "an initial relative volume", {0.0, 1.0}), method("field 2"),
                                    fixed("LCID", "a curve of energy that is fed in")})})},
      {"EOS_LINEAR_POLYNOMIAL", once({card({read("EOSID"), read("C0"), read("C1"), read("C2"), read("C3"),
                                            read("C4"), read("C5"), read("C6")}),
                                      card({read("E0"), read("V0")})})},
      {"EOS_JWL", once({card({read("EOSID"), read("A"), read("B"), read("R1"), read("R2"), read("OMEG"),
                              read("E0"), fixed("VO", "an initial relative volume", {0.0, 1.0})})})}};
}

constexpr std::array<std::pair<std::string_view, std::string_view>, 11> numbered = {
    {{"MAT_001", "MAT_ELASTIC"},
     {"MAT_003", "MAT_PLASTIC_KINEMATIC"},
     {"MAT_008", "MAT_HIGH_EXPLOSIVE_BURN"},
     {"MAT_009", "MAT_NULL"},
     {"MAT_010", "MAT_ELASTIC_PLASTIC_HYDRO"},
     {"MAT_015", "MAT_JOHNSON_COOK"},
     {"MAT_024", "MAT_PIECEWISE_LINEAR_PLASTICITY"},
     {"MAT_098", "MAT_SIMPLIFIED_JOHNSON_COOK"},
     {"EOS_001", "EOS_LINEAR_POLYNOMIAL"},
     {"EOS_002", "EOS_JWL"},
     {"EOS_004", "EOS_GRUNEISEN"}}};

/// Returns the value of a field as shown in the report.
std::string shown(const Fields& fields, std::size_t i) {
  try {
    return number(fields.real(i));
  } catch (const InputError&) {  // a text: not blank
    return std::string(fields.text(i));
  }
}

bool is_neutral(const Fields& fields, std::size_t i, const FieldRule& rule) {
  if (fields.text(i).empty()) return true;
  try {
    const double value = fields.real(i);
    return std::ranges::find(rule.neutral, value) != rule.neutral.end() ||
           (rule.until_forever && value >= forever);
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

const KeywordRule* rule_of(std::string_view keyword) {
  static const std::map<std::string_view, KeywordRule> rules = [] {
    std::map<std::string_view, KeywordRule> all = general_rules();
    all.merge(material_rules());
    return all;
  }();
  const auto found = rules.find(by_name(keyword));
  return found == rules.end() ? nullptr : &found->second;
}

std::string_view by_name(std::string_view keyword) {
  const auto found =
      std::ranges::find(numbered, keyword, &std::pair<std::string_view, std::string_view>::first);
  return found == numbered.end() ? keyword : found->second;
}

void check_fields(const Deck& deck, const Block& block, const KeywordRule& rule, Import& import,
                  std::string_view subject, std::size_t first) {
  struct Found {
    unsigned line;
    std::size_t count;
  };
  std::map<std::string, Found> missing;
  std::set<std::string> of_methods;
  const FieldRule unknown = fixed("", "");
  for (std::size_t c = first; c < block.cards.size(); ++c) {
    std::size_t place = c - first;
    if (rule.repeats) place %= rule.cards.size();
    const CardRule* const of_card = place < rule.cards.size() ? &rule.cards[place] : nullptr;
    if (of_card != nullptr && of_card->is_text) continue;
    const Fields fields(deck, block, block.cards[c]);
    const unsigned line = block.cards[c].line;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const FieldRule& field =
          of_card != nullptr && i < of_card->fields.size() ? of_card->fields[i] : unknown;
      if (field.use == FieldUse::read || is_neutral(fields, i, field)) continue;
      if (field.use == FieldUse::method) {
        if (!field.name.empty() && fields.text(i) != "0") of_methods.insert(std::string(field.name));
      } else {
        const std::string name =
            &field == &unknown ? fmt::format("field {} of card {}", i + 1, c + 1) : std::string(field.name);
        const std::string_view what = &field == &unknown ? "not known here" : field.meaning;
        auto& found =
            missing.try_emplace(fmt::format("{} = {}: {}", name, shown(fields, i), what), Found{line, 0})
                .first->second;
        ++found.count;
      }
    }
  }
  const std::string before = subject.empty() ? "" : fmt::format("{}: ", subject);
  for (const auto& [text, found] : missing) {
    import.remark(Outcome::missing, place_of(block, found.line), "*" + block.keyword,
                  before + text + (found.count == 1 ? "" : fmt::format(", {} times", found.count)));
  }
  if (!of_methods.empty()) {
    import.remark(Outcome::dropped, place_of(block), "*" + block.keyword,
                  fmt::format("{}{}: of the methods of that code", before, fmt::join(of_methods, ", ")));
  }
}

}  // namespace whipple::decks::dyna
