// SPDX-License-Identifier: BSD-3-Clause
#include "src/decks/dyna_material.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "src/decks/dyna_failure.hpp"
#include "src/decks/dyna_fields.hpp"
#include "src/decks/nearest_heat.hpp"
#include "src/decks/toml_text.hpp"

namespace whipple::decks::dyna {
namespace {

enum class Law {
  elastic,
  plastic_kinematic,
  explosive,
  null,
  hydro,
  johnson_cook,
  piecewise,
  simplified_johnson_cook,
  other
};
enum class State { polynomial, jwl, gruneisen, other };

constexpr std::array<std::pair<std::string_view, Law>, 8> laws = {
    {{"MAT_ELASTIC", Law::elastic},
     {"MAT_PLASTIC_KINEMATIC", Law::plastic_kinematic},
     {"MAT_HIGH_EXPLOSIVE_BURN", Law::explosive},
     {"MAT_NULL", Law::null},
     {"MAT_ELASTIC_PLASTIC_HYDRO", Law::hydro},
     {"MAT_JOHNSON_COOK", Law::johnson_cook},
     {"MAT_PIECEWISE_LINEAR_PLASTICITY", Law::piecewise},
     {"MAT_SIMPLIFIED_JOHNSON_COOK", Law::simplified_johnson_cook}}};
constexpr std::array<std::pair<std::string_view, State>, 3> states = {
    {{"EOS_LINEAR_POLYNOMIAL", State::polynomial},
     {"EOS_JWL", State::jwl},
     {"EOS_GRUNEISEN", State::gruneisen}}};

template <class Names, class Kind>
Kind kind_of(const Names& names, const std::string& keyword, Kind other) {
  const std::string_view name = by_name(keyword);
  const auto found = std::ranges::find_if(names, [&](const auto& each) { return each.first == name; });
  return found == names.end() ? other : found->second;
}

class MaterialWriter {
 public:
  MaterialWriter(const Deck& deck, const Block& material, const Block* state, const std::string& name,
                 const UnitSystem& units, Triaxiality triaxiality, Import& import)
      : deck_(deck),
        material_(material),
        state_(state),
        name_(name),
        units_(units),
        triaxiality_(triaxiality),
        import_(import),
        law_(kind_of(laws, material.keyword, Law::other)) {}

  CaseMaterial write() {
    density_ = card(material_, 0).required(1, "the density");
    if (!(density_ > 0.0)) fail(material_, "the density must be > 0");
    CaseMaterial result{.file = fmt::format("materials/{}.toml", name_),
                        .density = density_,
                        .explosive = law_ == Law::explosive};
    elastic_constants();
    toml_.comment(fmt::format("Written by 'whipple import' from {}; constants in the units of the deck.",
                              deck_.file.filename().string()));
    toml_.text_entry("name", material_.title.empty() ? name_ : material_.title);
    toml_.text_entry("source", source(material_));
    toml_.table("[eos]");
    equation_of_state(result);
    toml_.table("[strength]");
    strength();
    if (law_ == Law::johnson_cook) johnson_cook_failure();
    for (const Block* block : {&material_, state_}) {
      const KeywordRule* const rule = block == nullptr ? nullptr : rule_of(block->keyword);
      if (rule != nullptr) check_fields(deck_, *block, *rule, import_, name_);
    }
    result.fails = fails_;
    result.fluid = law_ == Law::null;
    import_.files.push_back({result.file, toml_.text()});
    return result;
  }

 private:
  [[nodiscard]] std::string source(const Block& block) const {
    return fmt::format("{}, line {}, *{}", std::filesystem::path(block.file).filename().string(), block.line,
                       block.keyword);
  }
  /// Returns the card of a keyword; beyond the last one all fields are blank.
  [[nodiscard]] Fields card(const Block& block, std::size_t number) const {
    static const Card blank;
    return {deck_, block, number < block.cards.size() ? block.cards[number] : blank};
  }
  void remark(Outcome outcome, const Block& block, std::string text) {
    import_.remark(outcome, place_of(block), "*" + block.keyword, fmt::format("{}: {}", name_, text));
  }
  void quantity(const char* key, double value, const Dimension& dimension, std::string_view note = {}) {
    toml_.entry(key, units_.quantity(value, dimension), note);
  }
  void begin(const char* model, const Block& block) {
    toml_.entry("model", fmt::format("\"{}\"", model));
    toml_.text_entry("source", source(block));
  }

  /// Reads shear and bulk modulus from the cards; 0: not given.
  void elastic_constants() {
    const Fields first = card(material_, 0);
    double young = 0.0, poisson = 0.0;
    switch (law_) {
      case Law::johnson_cook:
        shear_ = first.real(2);
        young = first.real(3);
        poisson = first.real(4);
        break;
      case Law::hydro:
        shear_ = first.required(2, "the shear modulus");
        break;
      case Law::elastic:
      case Law::plastic_kinematic:
      case Law::piecewise:
      case Law::simplified_johnson_cook:
        young = first.required(2, "Young's modulus");
        poisson = first.real(3);
        break;
      default:
        return;
    }
    if (young > 0.0 && poisson < 0.5) bulk_ = young / (3.0 * (1.0 - 2.0 * poisson));
    if (shear_ <= 0.0 && poisson > -1.0) shear_ = young / (2.0 * (1.0 + poisson));
    if (!(shear_ > 0.0)) fail(material_, "gives neither a shear modulus nor Young's modulus");
  }

  void heat_capacity(const char* model) {
    const double given = law_ == Law::johnson_cook ? card(material_, 2).real(0) : 0.0;
    if (given > 0.0) {
      quantity("heat_capacity", given, dimension::heat_capacity);
      return;
    }
    const LibraryHeat heat = nearest_heat(units_.in_si(density_, dimension::density), model);
    toml_.entry("heat_capacity", fmt::format("\"{} J/(kg K)\"", number(heat.value)),
                "not in the deck: that of " + heat.material);
    remark(Outcome::converted, material_,
           fmt::format("no heat capacity in the deck: that of {}, {} J/(kg K); temperatures depend on it",
                       heat.material, number(heat.value)));
  }
  void density() { quantity("reference_density", density_, dimension::density); }
  void room_temperature() {
    const double given = law_ == Law::johnson_cook ? card(material_, 1).real(6) : 0.0;
    if (given > 0.0) quantity("reference_temperature", given, {.temperature = 1});
  }
  void initial_volume(double given) {
    if (given != 0.0 && given != 1.0)
      remark(Outcome::missing, *state_, fmt::format("initial relative volume {}", number(given)));
  }

  void equation_of_state(CaseMaterial& result) {
    if (state_ == nullptr) {
      elastic_volume();
      return;
    }
    const Fields c = card(*state_, 0), d = card(*state_, 1);
    switch (kind_of(states, state_->keyword, State::other)) {
      case State::gruneisen:
        begin("mie_gruneisen", *state_);
        density();
        quantity("hugoniot_intercept", c.required(1, "C"), dimension::velocity);
        quantity("hugoniot_slope", c.required(2, "S1"), dimension::none);
        if (c.real(3) != 0.0) quantity("hugoniot_quadratic", c.real(3), dimension::none);
        if (c.real(4) != 0.0) quantity("hugoniot_cubic", c.real(4), dimension::none);
        quantity("gruneisen", c.required(5, "gamma0"), dimension::none);
        toml_.entry("gruneisen_law", "\"linear\"");
        quantity("gruneisen_slope", c.real(6), dimension::none);
        heat_capacity("mie_gruneisen");
        room_temperature();
        result.initial_pressure = c.real(5) * c.real(7);
        result.initial_density = density_;
        remark(Outcome::exact, *state_, "mie_gruneisen");
        break;
      case State::polynomial:
        if (is_gas(c)) return ideal_gas(c, d, result);
        begin("polynomial", *state_);
        density();
        for (std::size_t i = 0; i < 7; ++i) {
          quantity(fmt::format("C{}", i).c_str(), c.real(i + 1),
                   i < 4 ? dimension::pressure : dimension::none);
        }
        if (d.real(0) != 0.0)
          quantity("reference_energy", d.real(0) / density_, dimension::specific_energy,
                   "E0 over the density");
        heat_capacity("mie_gruneisen");
        room_temperature();
        initial_volume(d.real(1));
        remark(Outcome::exact, *state_, "polynomial");
        break;
      case State::jwl:
        begin("jwl", *state_);
        density();
        quantity("pressure_1", c.required(1, "A"), dimension::pressure);
        quantity("pressure_2", c.required(2, "B"), dimension::pressure);
        quantity("exponent_1", c.required(3, "R1"), dimension::none);
        quantity("exponent_2", c.required(4, "R2"), dimension::none);
        quantity("gruneisen", c.required(5, "omega"), dimension::none);
        quantity("detonation_energy", c.required(6, "E0"), dimension::pressure);
        heat_capacity("jwl");
        if (law_ == Law::explosive) {
          quantity("detonation_velocity", card(material_, 0).required(2, "D"), dimension::velocity);
          quantity("chapman_jouguet_pressure", card(material_, 0).required(3, "PCJ"), dimension::pressure);
          result.detonation_velocity = card(material_, 0).real(2);
          result.burn = card(material_, 0).real(4);
        }
        remark(Outcome::exact, *state_, "jwl");
        break;
      case State::other:
        remark(Outcome::missing, *state_, "this equation of state");
        elastic_volume();
    }
  }

  /// Returns whether a polynomial reduces to p = (gamma - 1) rho e.
  static bool is_gas(const Fields& c) {
    return c.real(1) == 0.0 && c.real(2) == 0.0 && c.real(3) == 0.0 && c.real(4) == 0.0 && c.real(5) > 0.0 &&
           c.real(6) == c.real(5) && c.real(7) == 0.0;
  }
  void ideal_gas(const Fields& c, const Fields& d, CaseMaterial& result) {
    begin("ideal_gas", *state_);
    density();
    quantity("heat_capacity_ratio", 1.0 + c.real(5), dimension::none, "1 + C4");
    heat_capacity("ideal_gas");
    const double volume = d.real(1) > 0.0 ? d.real(1) : 1.0;
    result.initial_pressure = c.real(5) * d.real(0) / volume;
    result.initial_density = density_ / volume;
    remark(Outcome::converted, *state_, "ideal_gas: C4 = C5 = gamma - 1, the others are 0");
    if (!(result.initial_pressure > 0.0))
      remark(Outcome::missing, *state_,
             "a gas without energy (E0 = 0): it starts at its reference temperature");
  }

  /// Writes pressure by the bulk modulus, for materials without a separate equation of state.
  void elastic_volume() {
    if (!(bulk_ > 0.0))
      fail(material_,
           fmt::format("{} needs an equation of state (*EOS_GRUNEISEN, _LINEAR_POLYNOMIAL or _JWL)", name_));
    begin("polynomial", material_);
    density();
    quantity("C1", bulk_, dimension::pressure, "bulk modulus");
    quantity("C4", 0.0, dimension::none);
    heat_capacity("mie_gruneisen");
    room_temperature();
    if (state_ == nullptr)
      remark(Outcome::converted, material_,
             "pressure by the bulk modulus, p = K (rho/rho0 - 1), equal at small strains");
  }

  void strength() {
    const Fields first = card(material_, 0), second = card(material_, 1);
    switch (law_) {
      case Law::elastic:
        begin("elastic", material_);
        quantity("shear_modulus", shear_, dimension::pressure);
        remark(Outcome::exact, material_, "elastic");
        break;
      case Law::plastic_kinematic: {
        const double young = first.real(2), tangent = first.real(5), beta = first.real(6);
        if (!(tangent < young)) fail(material_, "the tangent modulus must be less than Young's modulus");
        const double hardening = young * tangent / (young - tangent);
        begin("von_mises", material_);
        quantity("shear_modulus", shear_, dimension::pressure);
        quantity("yield_stress", first.required(4, "the yield stress"), dimension::pressure);
        quantity("hardening_modulus", beta * hardening, dimension::pressure,
                 "isotropic part of E Et / (E - Et)");
        if (beta < 1.0 && hardening > 0.0)
          quantity("kinematic_modulus", (1.0 - beta) * hardening, dimension::pressure);
        remark(Outcome::exact, material_, "von_mises");
        if (second.real(2) != 0.0) failure_strain(second.real(2));
        break;
      }
      case Law::hydro:
        begin("von_mises", material_);
        quantity("shear_modulus", shear_, dimension::pressure);
        quantity("yield_stress", first.required(3, "the yield stress"), dimension::pressure);
        quantity("hardening_modulus", first.real(4), dimension::pressure);
        remark(Outcome::exact, material_, "von_mises");
        if (first.real(5) < 0.0) tension(-first.real(5), 1.0);
        if (first.real(6) != 0.0) failure_strain(first.real(6));
        break;
      case Law::piecewise:
        piecewise(first);
        break;
      case Law::johnson_cook:
        johnson_cook(second, true);
        if (first.real(6) != 0.0)
          remark(Outcome::converted, material_,
                 fmt::format("VP = {}: the rate is that of the plastic strain in the case, too",
                             number(first.real(6))));
        break;
      case Law::simplified_johnson_cook:
        johnson_cook(second, false);
        if (second.real(4) != 0.0 && second.real(4) < 1e16) failure_strain(second.real(4));
        break;
      case Law::null:
        if (first.real(3) > 0.0) {
          begin("viscous_fluid", material_);
          quantity("viscosity", first.real(3), dimension::viscosity);
        } else {
          begin("none", material_);
        }
        remark(Outcome::exact, material_, first.real(3) > 0.0 ? "viscous_fluid" : "no strength");
        if (first.real(2) < 0.0) tension(-first.real(2), 1.0);
        break;
      default:
        begin("none", material_);
        if (law_ == Law::explosive) {
          remark(Outcome::converted, material_, "programmed burn over two cells from an unreacted explosive");
        } else {
          remark(Outcome::missing, material_, "this material law: no strength in the case");
        }
    }
  }

  /// Writes bilinear hardening; tables, curves and rate dependence are reported where they are set.
  void piecewise(const Fields& first) {
    const double young = first.real(2), tangent = first.real(5), failure = first.real(6);
    if (!(tangent < young)) fail(material_, "the tangent modulus must be less than Young's modulus");
    const bool yields = first.real(4) > 0.0;  // otherwise a curve defines it, which is reported
    begin(yields ? "von_mises" : "elastic", material_);
    quantity("shear_modulus", shear_, dimension::pressure);
    if (!yields) return;
    quantity("yield_stress", first.real(4), dimension::pressure);
    quantity("hardening_modulus", young * tangent / (young - tangent), dimension::pressure,
             "E Et / (E - Et)");
    remark(Outcome::exact, material_, "von_mises");
    if (failure < 0.0) remark(Outcome::missing, material_, "FAIL < 0: failure of a user");
    if (failure > 0.0 && failure < 1e16) failure_strain(failure);
  }

  /// Writes Johnson-Cook strength.
  /// @param temperatures  whether the cards contain thermal softening
  void johnson_cook(const Fields& c, bool temperatures) {
    begin("johnson_cook", material_);
    quantity("shear_modulus", shear_, dimension::pressure);
    quantity("yield_stress", c.required(0, "A"), dimension::pressure);
    quantity("hardening_coefficient", c.real(1), dimension::pressure);
    quantity("hardening_exponent", c.real(2) > 0.0 ? c.real(2) : 1.0, dimension::none);
    quantity("rate_coefficient", c.real(3), dimension::none);
    const double rate = c.real(7);
    if (rate > 0.0) {
      quantity("reference_rate", rate, dimension::rate);
    } else {
      fail(material_, "the reference strain rate EPSO must be > 0");
    }
    if (temperatures) {
      quantity("thermal_exponent", c.required(4, "M"), dimension::none);
      quantity("reference_temperature", c.required(6, "TR"), {.temperature = 1});
      quantity("melting_temperature", c.required(5, "TM"), {.temperature = 1});
    } else {
      quantity("thermal_exponent", 1.0, dimension::none);
      toml_.entry("reference_temperature", "\"1e8 K\"",
                  "no thermal softening in the deck: none below this temperature");
      toml_.entry("melting_temperature", "\"2e8 K\"");
    }
    remark(
        temperatures ? Outcome::exact : Outcome::converted, material_,
        temperatures ? "johnson_cook" : "johnson_cook with temperatures of softening that nothing reaches");
  }

  void johnson_cook_failure() {
    const Fields second = card(material_, 1), third = card(material_, 2), fourth = card(material_, 3);
    std::array<double, 5> d = {third.real(4), third.real(5), third.real(6), third.real(7), fourth.real(0)};
    if (std::ranges::any_of(d, [](double each) { return each != 0.0; })) {
      const double least = fourth.real(3);
      d[2] = d3_of_tension(d, triaxiality_, name_, material_, import_);
      remark_on_failure_strain(d, least, name_, material_, import_);
      toml_.table("[[failure]]");
      begin("johnson_cook_damage", material_);
      for (std::size_t i = 0; i < 5; ++i) quantity(fmt::format("d{}", i + 1).c_str(), d[i], dimension::none);
      quantity("reference_rate", second.real(7), dimension::rate);
      quantity("reference_temperature", second.real(6), {.temperature = 1});
      quantity("melting_temperature", second.real(5), {.temperature = 1});
      if (least > 0.0) quantity("least_failure_strain", least, dimension::none);
      fails_ = true;
      if (fourth.real(2) != 0.0) {
        remark(Outcome::exact, material_,
               "johnson_cook_damage: what has failed stays, without strength (EROD)");
      } else {
        remark(
            Outcome::converted, material_,
            "johnson_cook_damage: what has failed stays, without tension and deviator, where that code takes "
            "the element away");
      }
    }
    if (third.real(1) < 0.0) tension(-third.real(1), third.real(2));
  }

  /// Writes the tensile strength.
  /// @param spall  SPALL of the card: 1 limits the tensile pressure, 2 tests the maximum principal stress, 3 the
  /// pressure
  void tension(double strength, double spall) {
    toml_.table("[[failure]]");
    if (spall == 1.0) {
      begin("tensile_pressure", material_);
      quantity("spall_strength", strength, dimension::pressure);
      toml_.entry("response", "\"cut_off\"");
      remark(Outcome::exact, material_, "pressure cut-off PC");
    } else if (spall == 3.0) {
      begin("tensile_pressure", material_);
      quantity("spall_strength", strength, dimension::pressure);
      fails_ = true;
      remark(Outcome::converted, material_, "spall by pressure: tension and deviator are lost permanently");
    } else {
      begin("principal_stress", material_);
      fails_ = true;
      quantity("tensile_strength", strength, dimension::pressure);
      remark(Outcome::converted, material_,
             "spall by the greatest principal stress: tension and deviator are lost permanently");
    }
  }
  void failure_strain(double strain) {
    fails_ = true;
    toml_.table("[[failure]]");
    begin("plastic_strain", material_);
    quantity("failure_strain", strain, dimension::none);
    remark(Outcome::converted, material_,
           "failure at a plastic strain: the material stays, without tension and deviator");
  }

  const Deck& deck_;
  const Block& material_;
  const Block* state_;
  const std::string& name_;
  const UnitSystem& units_;
  Triaxiality triaxiality_;
  Import& import_;
  TomlText toml_;
  Law law_;
  bool fails_ = false;
  double density_ = 0.0, shear_ = 0.0, bulk_ = 0.0;
};

}  // namespace

bool has_law(const Block& material) { return kind_of(laws, material.keyword, Law::other) != Law::other; }

CaseMaterial material_of(const Deck& deck, const Block& material, const Block* state, const std::string& name,
                         const UnitSystem& units, Triaxiality triaxiality, Import& import) {
  return MaterialWriter(deck, material, state, name, units, triaxiality, import).write();
}

}  // namespace whipple::decks::dyna
