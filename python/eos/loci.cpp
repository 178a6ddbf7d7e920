// SPDX-License-Identifier: BSD-3-Clause
#include "eos/loci.hpp"

#include <algorithm>
#include <numeric>

#include "eos/closure.hpp"
#include "eos/curves/queries.hpp"
#include "eos/experiments/comparison.hpp"
#include "eos/inversions.hpp"
#include "python/eos/bindings.hpp"
#include "python/eos/states.hpp"

namespace whipple::python {
namespace {

constexpr double unknown = eos::State::unknown;

/// Returns a function that marks a point as having no state.
template <class Kind>
auto refusal(Kind& result) {
  return [&result](std::size_t i) {
    result.states[i].melted_fraction = result.states[i].vaporised_fraction = unknown;
  };
}

/// Checks that states are of this material. @throws InputError if they are of another material
void require_same(const Material& material, const States& states) {
  if (states.restored) {
    throw InputError(
        "the start is a state from a pickle, which belongs to no material: compute it again, "
        "material.states(density=s.density, energy=s.energy)");
  }
  if (states.eos != material.eos) {
    throw InputError(
        fmt::format("the start is a state of another equation of state than that of '{}'", material.name));
  }
}

void store(Shocks& shocks, std::size_t i, const eos::ShockState& shock) {
  shocks.states[i] = shock.state;
  shocks.further[0][i] = shock.shock_velocity;
  shocks.further[1][i] = shock.particle_velocity;
}

Shocks hugoniot(const Material& material, const OptionalNumbers& particle_velocity,
                const OptionalNumbers& pressure, const OptionalNumbers& density,
                std::optional<double> initial_density, std::optional<double> reflected_pressure,
                bool skip_invalid) {
  using eos::curves::ShockQuery;
  if (particle_velocity.has_value() + pressure.has_value() + density.has_value() != 1) {
    throw InputError("a shock is named by one of pressure, particle velocity and density");
  }
  const auto member = particle_velocity ? &ShockQuery::particle_velocity
                      : pressure        ? &ShockQuery::pressure
                                        : &ShockQuery::density;
  const Points points = broadcast({particle_velocity, pressure, density});
  const eos::Hugoniot from = eos::curves::hugoniot_of(*material.eos, {initial_density, reflected_pressure});
  Shocks shocks = make<Shocks>(material.eos, points, 2);
  const auto refuse = refusal(shocks);
  for_each_point(
      points,
      [&](std::size_t i, const std::vector<double>& inputs) {
        ShockQuery query;
        query.*member = inputs[0];
        store(shocks, i, *eos::curves::shock_of(from, query));
      },
      skip_invalid ? &refuse : nullptr);
  return shocks;
}

Isentropes isentrope(const Material& material, const OptionalNumbers& density,
                     const OptionalNumbers& pressure, const States* start) {
  if (density.has_value() == pressure.has_value())
    throw InputError("an isentrope runs over densities or pressures");
  if (start != nullptr) require_same(material, *start);
  const eos::State from = start != nullptr ? start->single() : material.reference;
  const Points points = broadcast({density, pressure});
  Isentropes result = make<Isentropes>(material.eos, points, 1);
  const auto keep = [&](std::size_t i, const eos::IsentropeState& s) {
    result.states[i] = s.state;
    result.further[0][i] = s.riemann_velocity;
  };
  if (pressure) {
    for_each_point(
        points,
        [&](std::size_t i, const std::vector<double>& inputs) {
          keep(i, eos::isentrope_at_pressure(*material.eos, from, inputs[0]));
        },
        static_cast<const std::function<void(std::size_t)>*>(nullptr));
    return result;
  }
  // The library integrates from the start to each density in the given order, on one side at a time.
  const std::span<const double> densities = points.column(0);
  if (!std::ranges::all_of(densities, [](double rho) { return rho > 0 && std::isfinite(rho); })) {
    throw StateError("the densities of an isentrope are finite and above zero");
  }
  std::vector<std::size_t> order(points.size);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return densities[i]; });
  const auto middle =
      std::ranges::partition_point(order, [&](std::size_t i) { return densities[i] < from.density; });
  std::reverse(order.begin(), middle);
  py::gil_scoped_release unlocked;
  for (const auto& [first, last] : {std::pair(order.begin(), middle), std::pair(middle, order.end())}) {
    std::vector<double> side;
    for (auto i = first; i != last; ++i) side.push_back(densities[*i]);
    const std::vector<eos::IsentropeState> states = eos::isentrope(*material.eos, from, side);
    for (std::size_t k = 0; k < states.size(); ++k) keep(first[static_cast<std::ptrdiff_t>(k)], states[k]);
  }
  return result;
}

Releases release(const Material& material, const States& start, const Numbers& pressure, bool skip_invalid) {
  require_same(material, start);
  std::vector<double> places(start.states.size());
  std::iota(places.begin(), places.end(), 0.0);
  const Points points = broadcast({Numbers(start.shape, places.data()), pressure});
  Releases result = make<Releases>(material.eos, points, 2);
  const auto refuse = refusal(result);
  for_each_point(
      points,
      [&](std::size_t i, const std::vector<double>& inputs) {
        const eos::State& from = start.states[static_cast<std::size_t>(inputs[0])];
        const eos::Release release = eos::release(*material.eos, from, inputs[1]);
        result.states[i] = release.end.state;
        result.further[0][i] = release.end.riemann_velocity;
        result.further[1][i] = release.in_equilibrium ? 1.0 : 0.0;
      },
      skip_invalid ? &refuse : nullptr);
  return result;
}

/// Holds two states at each point, such as solidus and liquidus.
using Pair = std::pair<States, States>;

/// Returns a function that marks point i as refused in both.
auto refusal(Pair& result) {
  return [&](std::size_t i) {
    refusal(result.first)(i);
    refusal(result.second)(i);
  };
}

Pair melting(const Material& material, const Numbers& pressure, bool skip_invalid) {
  const Points points = broadcast({pressure});
  Pair result{make<States>(material.eos, points, 0), make<States>(material.eos, points, 0)};
  const auto refuse = refusal(result);
  for_each_point(
      points,
      [&](std::size_t i, const std::vector<double>& inputs) {
        const auto point = eos::melting_point(*material.eos, inputs[0]);
        if (!point)
          throw StateError(fmt::format("{}: nothing melts at {:.6g} Pa", material.eos->model(), inputs[0]));
        result.first.states[i] = point->solidus;
        result.second.states[i] = point->liquidus;
      },
      skip_invalid ? &refuse : nullptr);
  return result;
}

Pair vaporisation(const Material& material, const OptionalNumbers& temperature,
                  const OptionalNumbers& pressure, bool skip_invalid) {
  const eos::VapourDome* dome = material.eos->vapour_dome();
  if (dome == nullptr)
    throw InputError(fmt::format("model {} has no liquid and vapour in equilibrium", material.eos->model()));
  if (temperature.has_value() == pressure.has_value()) {
    throw InputError("equilibrium of liquid and vapour is named by temperature or pressure");
  }
  const Points points = broadcast({temperature, pressure});
  Pair result{make<States>(material.eos, points, 0), make<States>(material.eos, points, 0)};
  const auto refuse = refusal(result);
  for_each_point(
      points,
      [&](std::size_t i, const std::vector<double>& inputs) {
        const auto s = temperature ? dome->at_temperature(inputs[0]) : dome->at_pressure(inputs[0]);
        if (!s)
          throw StateError(fmt::format("no liquid and vapour in equilibrium at {:.6g} {}", inputs[0],
                                       temperature ? "K" : "Pa"));
        result.first.states[i] = material.eos->state(1 / s->liquid_volume, s->liquid_energy);
        result.second.states[i] = material.eos->state(1 / s->vapour_volume, s->vapour_energy);
      },
      skip_invalid ? &refuse : nullptr);
  return result;
}

Shocks single_shock(const Material& material, const eos::ShockState& shock) {
  Shocks shocks = make<Shocks>(material.eos, Points{}, 2);
  store(shocks, 0, shock);
  return shocks;
}

/// Returns thresholds by name; None if the range of the model is too small, or the phase exists already at rest.
py::dict thresholds(const Material& material, double pressure) {
  std::optional<eos::ShockMelting> melting;
  eos::ReleaseThresholds release;
  {
    py::gil_scoped_release unlocked;
    melting = eos::shock_melting(*material.eos);
    release = eos::release_thresholds(*material.eos, pressure);
  }
  py::dict result;
  const auto add = [&](const char* name, const std::optional<eos::ShockState>& shock) {
    result[name] = shock ? py::cast(single_shock(material, *shock)) : py::object(py::none());
  };
  add("shock_melting_onset", melting ? std::optional(melting->onset) : std::nullopt);
  add("shock_melting_completion", melting ? std::optional(melting->completion) : std::nullopt);
  add("incipient_melting", release.incipient_melting);
  add("complete_melting", release.complete_melting);
  add("incipient_vaporisation", release.incipient_vaporisation);
  add("complete_vaporisation", release.complete_vaporisation);
  return result;
}

Impact impact(const Material& projectile, const Material& target, const Numbers& velocity,
              bool skip_invalid) {
  const Points points = broadcast({velocity});
  const std::vector<double> none(points.size, unknown);
  Impact result{
      points.shape, none, none, make<States>(projectile.eos, points, 0), make<States>(target.eos, points, 0),
      none};
  const eos::Hugoniot left(*projectile.eos), right(*target.eos);
  const auto refuse = [&](std::size_t i) {
    refusal(result.left)(i);
    refusal(result.right)(i);
  };
  for_each_point(
      points,
      [&](std::size_t i, const std::vector<double>& inputs) {
        const eos::ImpedanceMatch match = eos::match_impact(left, right, inputs[0]);
        result.pressure[i] = match.pressure;
        result.velocity[i] = match.velocity;
        result.left.states[i] = match.left;
        result.right.states[i] = match.right;
        result.right_shock_velocity[i] = match.right_shock_velocity;
      },
      skip_invalid ? &refuse : nullptr);
  return result;
}

/// Holds mixtures over an array of points.
struct Mixtures {
  States state;
  std::vector<States> components;
  std::vector<std::vector<double>> volume_fractions;  ///< of each component
};

Mixtures mixture(const std::vector<std::pair<Material, double>>& parts, const OptionalNumbers& density,
                 const OptionalNumbers& energy, const OptionalNumbers& pressure,
                 const OptionalNumbers& temperature, bool skip_invalid) {
  const bool at_energy = density && energy && !pressure && !temperature;
  if (!at_energy && !(pressure && temperature && !density && !energy)) {
    throw InputError("a mixture is named by density and energy, or by pressure and temperature");
  }
  if (parts.empty()) throw InputError("a mixture has at least one component");
  const Points points = at_energy ? broadcast({density, energy}) : broadcast({pressure, temperature});
  std::vector<eos::Component> components;
  Mixtures result;
  for (const auto& [material, fraction] : parts) {
    components.push_back({material.eos.get(), fraction});
    result.components.push_back(make<States>(material.eos, points, 0));
    result.volume_fractions.emplace_back(points.size, unknown);
  }
  result.state = make<States>(parts.front().first.eos, points, 0);
  const auto refuse = [&](std::size_t i) {
    refusal(result.state)(i);
    for (States& component : result.components) refusal(component)(i);
  };
  for_each_point(
      points,
      [&](std::size_t i, const std::vector<double>& inputs) {
        const auto equilibrium =
            at_energy ? &eos::mixture_at_energy : &eos::mixture_at_pressure_and_temperature;
        const eos::Mixture mixture = equilibrium(components, inputs[0], inputs[1]);
        result.state.states[i] = mixture.state;
        for (std::size_t k = 0; k < components.size(); ++k) {
          result.components[k].states[i] = mixture.components[k];
          result.volume_fractions[k][i] = mixture.volume_fractions[k];
        }
      },
      skip_invalid ? &refuse : nullptr);
  return result;
}

using eos::experiments::Experiment;

/// Holds an experiment with the curve of a model at its points.
struct ComparedExperiment : Experiment {
  eos::experiments::Comparison comparison;
};

std::vector<ComparedExperiment> compare(const Material& material, const std::filesystem::path& file,
                                        std::optional<double> temperature) {
  std::vector<ComparedExperiment> compared;
  for (Experiment& experiment : eos::experiments::read_experiments(file, temperature)) {
    if (!eos::experiments::belongs_to(experiment, material.name) && experiment.only_its_material) continue;
    auto comparison = eos::experiments::compare(*material.eos, material.reference, experiment);
    compared.push_back({std::move(experiment), std::move(comparison)});
  }
  return compared;
}

Numbers list_of(const std::vector<double>& values) {
  return Numbers(static_cast<py::ssize_t>(values.size()), values.data());
}

void add_results(py::module_& module) {
  py::class_<Impact>(module, "Impact", "Planar impacts: pressure and velocity common to both materials.")
      .def_property_readonly(
          "pressure", [](const Impact& m) { return array_of(m.shape, m.pressure); },
          "Pressure at the interface, Pa.")
      .def_property_readonly(
          "velocity", [](const Impact& m) { return array_of(m.shape, m.velocity); },
          "Velocity of the interface, m/s.")
      .def_readonly("projectile", &Impact::left, "Shocked states of the projectile.")
      .def_readonly("target", &Impact::right, "Shocked states of the target.")
      .def_property_readonly(
          "target_shock_velocity", [](const Impact& m) { return array_of(m.shape, m.right_shock_velocity); },
          "Velocity of the shock in the target, m/s.");
  py::class_<Mixtures>(module, "Mixtures",
                       "Mixtures of materials in equilibrium of pressure and temperature.")
      .def_readonly("state", &Mixtures::state, "States of the whole.")
      .def_readonly("components", &Mixtures::components, "States of the components, in their order.")
      .def_property_readonly(
          "volume_fractions",
          [](const Mixtures& m) {
            py::list list;
            for (const auto& fractions : m.volume_fractions) {
              list.append(array_of(m.state.shape, fractions));
            }
            return list;
          },
          "Volume fraction of each component, in their order.");
  using eos::experiments::ExperimentKind;
  py::enum_<ExperimentKind>(module, "ExperimentKind", "The two measured quantities of an experiment.")
      .value("shock_velocity", ExperimentKind::shock_velocity, "Us (m/s) over up (m/s).")
      .value("shock_pressure", ExperimentKind::shock_pressure, "Shock pressure (Pa) over V/V0.")
      .value("isotherm", ExperimentKind::isotherm,
             "Pressure (Pa) over V/V0 or density at the temperature of each point.")
      .value("melting", ExperimentKind::melting, "Melting temperature (K) over pressure (Pa).")
      .value("isentrope", ExperimentKind::isentrope, "Pressure (Pa) over V/V0 along the principal isentrope.")
      .value("sound_speed", ExperimentKind::sound_speed,
             "Bulk sound speed (m/s) over pressure (Pa) behind shocks.")
      .value("shock_temperature", ExperimentKind::shock_temperature,
             "Temperature (K) over pressure (Pa) behind shocks.")
      .value("heat_capacity", ExperimentKind::heat_capacity,
             "c_p (J/(kg K)) over temperature (K) at zero pressure.")
      .value("expansion", ExperimentKind::expansion,
             "Coefficient of linear thermal expansion (1/K) over temperature (K) at zero pressure.");
  py::class_<Experiment>(module, "Measurements", "Measured points of a text table, in SI units.")
      .def_readonly("name", &Experiment::name, "Name of the data set.")
      .def_readonly("source", &Experiment::source, "Source of the data set.")
      .def_readonly("kind", &Experiment::kind, "Which quantities were measured.")
      .def_readonly("temperature", &Experiment::temperature,
                    "Temperature of an isotherm, K; NaN where its points have several.")
      .def_property_readonly(
          "temperatures", [](const Experiment& e) { return list_of(e.temperatures); },
          "Temperature of each point of an isotherm, K.")
      .def_property_readonly(
          "is_density",
          [](const Experiment& e) { return e.volume == eos::experiments::VolumeScale::density; },
          "Whether pressures are given over density instead of V/V0.")
      .def_property_readonly(
          "errors", [](const Experiment& e) { return list_of(e.ordinate_error); },
          "One standard deviation of each measured value; NaN: not stated.")
      .def_property_readonly(
          "abscissa", [](const Experiment& e) { return list_of(e.abscissa); },
          "Measured up (m/s), V/V0, density (kg/m^3) or pressure (Pa).")
      .def_property_readonly(
          "measured", [](const Experiment& e) { return list_of(e.ordinate); },
          "Measured Us (m/s), pressure (Pa) or temperature (K).")
      .def_property_readonly(
          "initial_density", [](const Experiment& e) { return list_of(e.initial_density); },
          "Density of the sample, kg/m^3; NaN where it is not stated.");
  py::class_<ComparedExperiment, Experiment>(module, "Comparison",
                                             "Measured points and the curve of a material.")
      .def_property_readonly(
          "model", [](const ComparedExperiment& c) { return list_of(c.comparison.model); },
          "The measured quantity of the material; NaN outside its range.")
      .def_property_readonly(
          "deviation", [](const ComparedExperiment& c) { return list_of(c.comparison.deviation); },
          "Model less measurement, in percent of the measured Us or temperature, or in Pa.")
      .def_property_readonly(
          "rms", [](const ComparedExperiment& c) { return c.comparison.rms; },
          "Root mean square of the deviations, in their unit.")
      .def_property_readonly(
          "points", [](const ComparedExperiment& c) { return c.comparison.points; },
          "Number of points inside the range of the material.");
  module.def("measurements", &eos::experiments::read_experiments, py::arg("file"), py::kw_only(),
             py::arg("temperature") = py::none(),
             "Read the Hugoniots, isotherms and melting lines of a text table.\n\n"
             "Columns with units in their headings, as for `whipple compare`. temperature: of an isotherm "
             "(K), where\n"
             "the file does not state it. Raises InputError with file and line.");
}

}  // namespace

void add_loci(py::module_& module, py::class_<Material>& material) {
  add_results(module);
  material
      .def("hugoniot", &hugoniot, py::kw_only(), py::arg("particle_velocity") = py::none(),
           py::arg("pressure") = py::none(), py::arg("density") = py::none(),
           py::arg("initial_density") = py::none(), py::arg("reflected_pressure") = py::none(),
           py::arg("skip_invalid") = false,
           "Compute states behind shocks by the jump conditions of mass, momentum and energy.\n\n"
           "One of particle_velocity (m/s), pressure (Pa) and density (kg/m^3) names the shock.\n"
           "initial_density: of porous material ahead, kg/m^3. reflected_pressure: the shock passes through "
           "material\n"
           "shocked to this pressure (Pa) before. skip_invalid: shocks that the model does not reach become "
           "NaN; else\n"
           "they raise StateError.")
      .def("isentrope", &isentrope, py::kw_only(), py::arg("density") = py::none(),
           py::arg("pressure") = py::none(), py::arg("start") = nullptr,
           "Compute states on the isentrope through one state, at densities (kg/m^3) or pressures (Pa).\n\n"
           "start: a single state; default: the reference state. On the surface of the model itself: a "
           "liquid may\n"
           "carry tension. Raises StateError if the isentrope does not reach a density or pressure.")
      .def(
          "isotherm",
          [](const Material& m, const Numbers& pressure, std::optional<double> temperature,
             bool skip_invalid) {
            const double T = temperature.value_or(m.eos->reference_temperature());
            return states_of(m.eos, broadcast({pressure}), skip_invalid,
                             [&](const std::vector<double>& inputs) {
                               return eos::state_at_pressure_and_temperature(*m.eos, inputs[0], T);
                             });
          },
          py::arg("pressure"), py::arg("temperature") = py::none(), py::kw_only(),
          py::arg("skip_invalid") = false,
          "Compute states on an isotherm at pressures (Pa).\n\n"
          "temperature: K; default: the reference temperature of the model.")
      .def(
          "cold_curve",
          [](const Material& m, const Numbers& density, bool skip_invalid) {
            return states_of(
                m.eos, broadcast({density}), skip_invalid,
                [&](const std::vector<double>& inputs) { return eos::cold_state(*m.eos, inputs[0]); });
          },
          py::arg("density"), py::kw_only(), py::arg("skip_invalid") = false,
          "Compute the coldest states that the model describes, at densities (kg/m^3).")
      .def(
          "release", &release, py::arg("start"), py::arg("pressure") = 0.0, py::kw_only(),
          py::arg("skip_invalid") = false,
          "Release states to a pressure (Pa) along their isentropes.\n\n"
          "Where the model knows liquid and vapour in equilibrium at the pressure, the end is their mixture.")
      .def("melting", &melting, py::arg("pressure") = 0.0, py::kw_only(), py::arg("skip_invalid") = false,
           "Compute solidus and liquidus at pressures (Pa), as a pair of states.")
      .def("vaporisation", &vaporisation, py::kw_only(), py::arg("temperature") = py::none(),
           py::arg("pressure") = py::none(), py::arg("skip_invalid") = false,
           "Compute liquid and vapour in equilibrium at temperatures (K) or pressures (Pa), as a pair of "
           "states.\n\n"
           "Raises InputError if the model has no such equilibrium.")
      .def_property_readonly(
          "critical_point",
          [](const Material& m) -> std::optional<std::tuple<double, double, double>> {
            if (m.eos->vapour_dome() == nullptr) return std::nullopt;
            const eos::CriticalPoint& c = m.eos->vapour_dome()->critical_point();
            return std::tuple(c.temperature, c.pressure, 1 / c.specific_volume);
          },
          "Temperature (K), pressure (Pa) and density (kg/m^3) of the critical point, or None.")
      .def("thresholds", &thresholds, py::arg("pressure") = 0.0,
           "Compute the weakest shocks that melt, and that melt or vaporise after release to a pressure "
           "(Pa).\n\n"
           "A dictionary with shock_melting_onset, shock_melting_completion (behind the shock), "
           "incipient_melting,\n"
           "complete_melting, incipient_vaporisation, complete_vaporisation (after release); None where the "
           "model\n"
           "does not go so far.")
      .def("compare", &compare, py::arg("file"), py::kw_only(), py::arg("temperature") = py::none(),
           "Compare with the measurements of a text table: Hugoniots, isotherms, melting lines.\n\n"
           "Columns with units in their headings, as for `whipple compare`. temperature: of an isotherm (K), "
           "where\n"
           "the file does not state it. Raises InputError with file and line.");
  module.def("impact", &impact, py::arg("projectile"), py::arg("target"), py::arg("velocity"), py::kw_only(),
             py::arg("skip_invalid") = false,
             "Compute planar impacts of a projectile with velocities (m/s) on a target at rest.\n\n"
             "Both from their reference states.");
  module.def(
      "mixture", &mixture, py::arg("components"), py::kw_only(), py::arg("density") = py::none(),
      py::arg("energy") = py::none(), py::arg("pressure") = py::none(), py::arg("temperature") = py::none(),
      py::arg("skip_invalid") = false,
      "Compute mixtures in equilibrium of pressure and temperature.\n\n"
      "components: pairs of a material and its mass fraction, which add up to 1. The mixture is named by\n"
      "density (kg/m^3) and specific internal energy (J/kg), or by pressure (Pa) and temperature (K).");
}

}  // namespace whipple::python
