// SPDX-License-Identifier: BSD-3-Clause
// The update of one point for kernels against that of the host, field by field over consecutive steps; what it reports, and
// what it refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <random>

#include "eos/model_equation_of_state.hpp"
#include "eos/models/polynomial.hpp"
#include "eos/modifiers/floor.hpp"
#include "eos/table/table_of_model.hpp"
#include "src/device/material/describe.hpp"
#include "src/device/material/update_point.hpp"
#include "src/material/failure/fragment_size.hpp"
#include "src/material/failure/plastic_strain.hpp"
#include "src/material/failure/principal_stress.hpp"
#include "src/material/failure/tensile_pressure.hpp"
#include "src/material/failure/viscous_void_growth.hpp"
#include "src/material/material_file.hpp"
#include "src/material/strength/elastic.hpp"
#include "tests/unit/material_support.hpp"

namespace whipple {
namespace {

using namespace material_test;
using testing::HasSubstr;

/// Returns the tensors of a point as a kernel holds them.
material::formulas::Matrix<double> by_rows(const Matrix3& m) {
  return {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)};
}

double value_of(const MaterialPoints& points, const char* name, std::size_t i) {
  return points.history.find(name) == nullptr ? 0.0 : points.history.scalar(name)[i];
}

device::MaterialState state_of(const MaterialPoints& points, std::size_t i) {
  const SymmetricTensor& s = points.deviatoric_stress[i];
  return {
      .mass = points.mass[i],
      .volume = points.volume[i],
      .void_volume = points.void_volume[i],
      .energy = points.specific_internal_energy[i],
      .pressure = points.pressure[i],
      .artificial_viscosity = points.artificial_viscosity[i],
      .heating_viscosity = points.heating_viscosity.empty() ? 0.0 : points.heating_viscosity[i],
      .temperature = points.temperature[i],
      .sound_speed = points.sound_speed[i],
      .plastic_strain = points.plastic_strain[i],
      .melted = points.melted_fraction[i],
      .vaporised = points.vaporised_fraction[i],
      .failed = static_cast<double>(points.failed[i]),
      .maximum_pressure = points.maximum_pressure[i],
      .maximum_temperature = points.maximum_temperature[i],
      .melting_time = points.melting_time[i],
      .threshold_factor = points.failure_threshold_factor.empty() ? 1.0 : points.failure_threshold_factor[i],
      .damage = value_of(points, "damage", i),
      .fragment_size = value_of(points, "fragment_size", i),
      .cold_work = value_of(points, "stored_cold_work", i),
      .deviator = {s.xx, s.yy, s.zz, s.xy, s.yz, s.zx}};
}

/// Collects the greatest differences by field, relative to the scale of the field.
struct Differences {
  std::map<std::string, double> greatest;

  void add(const std::string& field, double host, double point, double scale) {
    const bool same = host == point || (std::isnan(host) && std::isnan(point));
    const double difference = same ? 0.0 : std::abs(host - point) / scale;
    double& most = greatest[field];
    most = difference <= most ? most : difference;  // keeps NaN
  }
  void add(const Material& material, const device::MaterialState& host, const device::MaterialState& point) {
    const double modulus = material.reference_bulk_modulus;
    const auto pressure = [&](double p) { return std::abs(p) + 0.01 * modulus; };
    add("volume", host.volume, point.volume, host.volume);
    add("void_volume", host.void_volume, point.void_volume, host.volume + host.void_volume);
    add("pressure", host.pressure, point.pressure, pressure(host.pressure));
    add("artificial_viscosity", host.artificial_viscosity, point.artificial_viscosity,
        pressure(host.artificial_viscosity));
    add("heating_viscosity", host.heating_viscosity, point.heating_viscosity,
        pressure(host.heating_viscosity));
    add("temperature", host.temperature, point.temperature, 300.0 + host.temperature);
    add("sound_speed", host.sound_speed, point.sound_speed, host.sound_speed);
    add("plastic_strain", host.plastic_strain, point.plastic_strain, 0.01 + host.plastic_strain);
    add("melted", host.melted, point.melted, 1.0);
    add("vaporised", host.vaporised, point.vaporised, 1.0);
    add("failed", host.failed, point.failed, 1.0);
    add("maximum_pressure", host.maximum_pressure, point.maximum_pressure, pressure(host.maximum_pressure));
    add("maximum_temperature", host.maximum_temperature, point.maximum_temperature,
        300.0 + host.maximum_temperature);
    add("melting_time", host.melting_time, point.melting_time, 1.0);
    add("damage", host.damage, point.damage, 1.0);
    add("fragment_size", host.fragment_size, point.fragment_size, std::max(host.fragment_size, 1e-9));
    add("cold_work", host.cold_work, point.cold_work, 1e3 + host.cold_work);
    const auto& s = host.deviator;
    const auto& t = point.deviator;
    for (const double difference :
         {s.xx - t.xx, s.yy - t.yy, s.zz - t.zz, s.xy - t.xy, s.yz - t.yz, s.zx - t.zx}) {
      add("deviator", difference, 0.0, 1e8 + std::sqrt(material::formulas::squared_norm(s)));
    }
  }
};

/// Counts the events of points.
struct Events {
  std::array<std::size_t, 10> count{};
  double plastic_work = 0.0, dissipation = 0.0, plastic_heat = 0.0, compression_rate = 0.0;

  void add(const device::MaterialResult& result) {
    for (std::size_t bit = 0; bit < count.size(); ++bit) count[bit] += result.events >> bit & 1U;
    plastic_work += result.plastic_work;
    dissipation += result.dissipation;
    plastic_heat += result.plastic_heat;
    compression_rate = std::max(compression_rate, result.compression_rate);
  }
  [[nodiscard]] std::size_t of(std::uint32_t bit) const { return count[std::countr_zero(bit)]; }
};

/// @param tolerance  of the work, relative
void expect_equal(const MaterialReport& host, const Events& points, double tolerance) {
  namespace event = device::event;
  const std::size_t out_of_range =
      points.of(event::eos_not_a_number) + points.of(event::eos_density) + points.of(event::eos_energy);
  EXPECT_EQ(host.equation_of_state.out_of_range, out_of_range);
  EXPECT_EQ(host.equation_of_state.below_cold_curve, points.of(event::below_cold_curve));
  EXPECT_EQ(host.undefined, points.of(event::undefined));
  EXPECT_EQ(host.limited_volume_changes, points.of(event::limited_volume_change));
  EXPECT_EQ(host.limited_densities, points.of(event::limited_density));
  EXPECT_EQ(host.squeezed, points.of(event::squeezed));
  EXPECT_EQ(host.limited_void_steps, points.of(event::limited_void_step));
  EXPECT_EQ(std::accumulate(host.failed.begin(), host.failed.end(), std::size_t{0}),
            points.of(event::newly_failed));
  const auto near = [](double a, double b, double scale) {
    return std::abs(a - b) <= scale || (std::isnan(a) && std::isnan(b));
  };
  const double scale = tolerance * host.dissipation;
  EXPECT_PRED3(near, host.plastic_work, points.plastic_work, scale);
  EXPECT_PRED3(near, host.dissipation, points.dissipation, scale);
  EXPECT_PRED3(near, host.plastic_heat, points.plastic_heat, scale);
  EXPECT_PRED3(near, host.compression_rate, points.compression_rate, 1e-14 * host.compression_rate);
}

constexpr std::size_t point_count = 61;  // the host has a chunk that is not full

/// Holds what the points of a walk have met.
struct Walk {
  Differences differences;
  std::size_t failed = 0, healed = 0, opened = 0, melted = 0, yielded = 0;
};

/// Holds what a walk is made of.
struct Way {
  UpdateSettings settings = {};
  double heat = 0.0;         ///< of a step, J/kg, at most
  double tolerance = 1e-12;  ///< of the state
  double of_stress = 1e-12;  ///< of deviator, plastic strain and work
};

/// Takes points along random paths, a quarter each around a mean that rests, compresses, expands, or does one after the
/// other; their energy follows the work of the stress, and a third of them are heated. Requires the same of host and point.
Walk walk(const Material& material, const Way& way) {
  constexpr int steps = 30;
  std::mt19937_64 generator(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  MaterialPoints points;
  points.failure_threshold_factor.resize(1);
  points.heating_viscosity.resize(1);
  resize(points, point_count);
  for (double& mass : points.mass) mass = material.reference.density * 1e-9 * (0.5 + uniform(generator));
  initialise(material, points, 0, point_count);
  // Warmer than the reference state: c^2 of a GruneisenSolid jumps at rho0, where failed points without energy rest, so
  // that the last digit of the density would decide.
  for (double& energy : points.specific_internal_energy) energy += 5e3;
  for (double& factor : points.failure_threshold_factor) factor = 0.7 + 0.6 * uniform(generator);
  UpdateSettings settings = way.settings;
  settings.time_step = 2e-9;
  settings.cell_size = 2e-4;
  settings.initial_density = material.reference.density;
  std::vector<double> tables(7);  // those of another material
  const device::MaterialConstants constants = device::describe(material, settings, tables);
  std::vector<device::MaterialState> states(point_count);
  std::vector<Matrix3> gradients(point_count);
  std::vector<double> affine(point_count);
  for (std::size_t i = 0; i < point_count; ++i) states[i] = state_of(points, i);
  Walk result;
  for (int n = 0; n < steps; ++n) {
    const double dt = settings.time_step;
    for (std::size_t i = 0; i < point_count; ++i) {
      const double trend = i % 4 == 3 ? (n < steps / 2 ? 1.0 : -1.5) : std::array{0.0, -1.0, 1.0}[i % 4];
      gradients[i] = (random_matrix(generator, 0.008) + 0.004 * trend * Matrix3::Identity()) / dt;
      affine[i] = gradients[i].trace() * (0.3 + 0.5 * uniform(generator));
      const Matrix3 stress = points.deviatoric_stress[i].matrix() -
                             (points.pressure[i] + points.artificial_viscosity[i]) * Matrix3::Identity();
      points.specific_internal_energy[i] +=
          dt * points.volume[i] / points.mass[i] * stress.cwiseProduct(gradients[i]).sum() +
          (i % 3 == 0 ? way.heat * uniform(generator) : 0.0);
      states[i].energy = points.specific_internal_energy[i];
    }
    settings.time += dt;
    settings.affine_divergence = affine;
    const std::vector<std::uint8_t> before = points.failed;
    const MaterialReport report = update_material(material, points, 0, point_count, gradients, settings);
    Events events;
    for (std::size_t i = 0; i < point_count; ++i) {
      events.add(device::update_point(constants, tables.data(), {dt, settings.time}, by_rows(gradients[i]),
                                      affine[i], states[i]));
      result.differences.add(material, state_of(points, i), states[i]);
      result.failed += before[i] == 0 && points.failed[i] != 0 ? 1 : 0;
      result.healed += before[i] != 0 && points.failed[i] == 0 ? 1 : 0;
    }
    expect_equal(report, events, way.of_stress);
  }
  for (std::size_t i = 0; i < point_count; ++i) {
    result.opened += points.void_volume[i] > 0.0 ? 1 : 0;
    result.melted += points.melted_fraction[i] > 0.0 ? 1 : 0;
    result.yielded += points.plastic_strain[i] > 0.0 ? 1 : 0;
  }
  for (const auto& [field, greatest] : result.differences.greatest) {
    testing::Test::RecordProperty(field, fmt::format("{:.1e}", greatest));
    const bool of_stress = field == "deviator" || field == "plastic_strain" || field == "cold_work";
    EXPECT_LE(greatest, of_stress ? way.of_stress : way.tolerance) << field;
  }
  return result;
}

constexpr UpdateSettings with_stores = {.expansion_viscosity = 0.1,
                                        .heating = HeatingViscosity::of_affine_field,
                                        .affine_gain = 1.5,
                                        .affine_compression = 0.05};
constexpr UpdateSettings polar = {.heating = HeatingViscosity::whole,
                                  .rotation = material::StressRotation::polar};

template <class Law>
std::shared_ptr<const failure::Criterion> criterion(const Law& law) {
  return std::make_shared<failure::CriterionModel<Law>>(law);
}

/// Returns a material of the library with other failure criteria.
Material failing(const char* name, std::vector<std::shared_ptr<const failure::Criterion>> failure) {
  const Material material = read_material(name);
  return make_material(name, material.eos, material.strength, std::move(failure));
}

failure::TensilePressure spall(double strength, failure::SpallResponse response) {
  failure::TensilePressure law;
  law.spall_strength = strength;
  law.response = response;
  return law;
}

TEST(DevicePoint, VonMisesOnMieGruneisen) {
  EXPECT_EQ(walk(read_material("copper_taylor"), {}).yielded, point_count);
  walk(read_material("copper_taylor"), {.settings = polar, .heat = 1e5});
}

TEST(DevicePoint, JohnsonCookReturnsAsTheSolverOfBatches) {
  const Material copper = read_material("copper_johnson_cook");
  EXPECT_EQ(
      walk(copper, {.settings = with_stores, .heat = 3e4, .tolerance = 1e-11, .of_stress = 1e-10}).yielded,
      point_count);
}

TEST(DevicePoint, ColdWorkIsStored) {
  Material copper = read_material("copper_johnson_cook");
  set_taylor_quinney(copper, 0.7);
  walk(copper, {.settings = with_stores, .heat = 3e4, .tolerance = 1e-11, .of_stress = 1e-10});
}

TEST(DevicePoint, SteinbergGuinanWithVoidsThatGrow) {
  const Walk lead =
      walk(read_material("lead_steinberg_mie_gruneisen"), {.tolerance = 1e-10, .of_stress = 1e-10});
  EXPECT_GT(lead.failed, 5);
  EXPECT_GT(lead.opened, 5);
  walk(read_material("tungsten_mie_gruneisen"), {.settings = polar, .tolerance = 1e-10, .of_stress = 1e-10});
}

TEST(DevicePoint, JohnsonCookWithVoidsThatGrowAndFracture) {
  const Walk met = walk(read_material("aluminium_2024_fracture_mie_gruneisen"),
                        {.settings = with_stores, .heat = 2e4, .tolerance = 1e-10, .of_stress = 1e-10});
  EXPECT_GT(met.failed, 5);
}

TEST(DevicePoint, LeadFailsByTensionAndStrain) {
  const Walk met = walk(read_material("lead_mie_gruneisen"), {.heat = 1e4, .tolerance = 1e-11});
  EXPECT_GT(met.failed, 5);
  EXPECT_GT(met.opened, 5);
}

TEST(DevicePoint, SpallOpensAndHeals) {
  failure::PlasticStrain ductile;
  ductile.failure_strain = 0.35;
  const Material copper = failing(
      "copper_taylor", {criterion(spall(1e9, failure::SpallResponse::opening)), criterion(ductile),
                        std::make_shared<failure::FragmentSize>(failure::FragmentSize::Constants{50.0})});
  const Walk met = walk(copper, {.settings = with_stores, .tolerance = 1e-11, .of_stress = 1e-11});
  EXPECT_GT(met.failed, 5);
  EXPECT_GT(met.healed, 5);
}

TEST(DevicePoint, CutOffHoldsThePressure) {
  const Material copper = failing("copper_taylor", {criterion(spall(1e9, failure::SpallResponse::cut_off))});
  const Walk met = walk(copper, {.tolerance = 1e-11, .of_stress = 1e-11});
  EXPECT_EQ(met.failed, 0);
  EXPECT_GT(met.opened, 5);
}

TEST(DevicePoint, PolynomialWithoutYieldOrStrength) {
  eos::PolynomialConstants constants;
  constants.reference_density = 2700.0;
  constants.C1 = 76e9;
  constants.C2 = 60e9;
  constants.C4 = 2.0;
  constants.heat_capacity = 900.0;
  const auto model = std::make_shared<eos::ModelEquationOfState<eos::Polynomial>>(eos::Polynomial(constants));
  walk(make_material("fluid", model, nullptr, {criterion(spall(1e8, failure::SpallResponse::failure))}),
       {.heat = 1e6, .tolerance = 1e-11});
  strength::Elastic elastic;
  elastic.shear_modulus = 26e9;
  const Walk met =
      walk(make_material("elastic", model, std::make_shared<strength::ElasticModel>(elastic)), {});
  EXPECT_EQ(met.yielded, 0);
}

/// Copper of three phases by a table, for which states outside are those of the model.
const Material& copper_table() {
  static const Material material = device::tabulated(read_material("copper"), 1e-2);
  return material;
}

TEST(DevicePoint, TableOfThreePhases) {
  const Walk met =
      walk(copper_table(), {.settings = with_stores, .heat = 6e5, .tolerance = 1e-10, .of_stress = 1e-10});
  EXPECT_GT(met.melted, 10);
}

/// Evaluates random states of a table at once and one by one.
TEST(DevicePoint, TableAgreesWithItsBatchesInAllRegions) {
  const auto& model = dynamic_cast<const eos::TableOfModel&>(*copper_table().eos);
  const eos::Table& table = model.table();
  std::vector<double> numbers(3);
  const eos::table::Point constants = table.point(numbers);
  std::mt19937_64 generator(11);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  constexpr std::size_t count = 4000;
  std::vector<double> density(count), energy(count), p(count), T(count), c(count), melted(count),
      vaporised(count);
  for (std::size_t i = 0; i < count; ++i) {
    density[i] = table.minimum_density() *
                 std::pow(table.maximum_density() / table.minimum_density(), uniform(generator));
    const double least = table.minimum_energy(density[i]), range = table.maximum_energy(density[i]) - least;
    energy[i] = least + range * std::pow(10.0, -6.0 * uniform(generator));
  }
  const eos::RangeReport report = table.evaluate({density, energy, p, T, c, melted, vaporised});
  EXPECT_EQ(report.out_of_range, 0);
  double of_pressure = 0.0, of_temperature = 0.0, of_sound = 0.0, of_fraction = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const eos::PointState point = evaluate_point(constants, numbers.data(), density[i], energy[i]);
    of_pressure =
        std::max(of_pressure, std::abs(point.pressure - p[i]) / (std::abs(p[i]) + density[i] * c[i] * c[i]));
    of_temperature = std::max(of_temperature, std::abs(point.temperature - T[i]) / T[i]);
    of_sound = std::max(of_sound, std::abs(point.sound_speed - c[i]) / c[i]);
    of_fraction =
        std::max({of_fraction, std::abs(point.melted - melted[i]), std::abs(point.vaporised - vaporised[i])});
  }
  RecordProperty("pressure", fmt::format("{:.1e}", of_pressure));
  RecordProperty("temperature", fmt::format("{:.1e}", of_temperature));
  RecordProperty("sound_speed", fmt::format("{:.1e}", of_sound));
  RecordProperty("fraction", fmt::format("{:.1e}", of_fraction));
  EXPECT_LE(of_pressure, 1e-12);
  EXPECT_LE(of_temperature, 1e-10);  // of cold states: e - e_0 is a small difference
  EXPECT_LE(of_sound, 1e-11);
  EXPECT_LE(of_fraction, 1e-11);
}

/// Updates points at the limits of a material on host and device, and requires the same events and, where the state is
/// defined, the same state.
void compare_at_limits(const Material& material) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN(),
                   infinite = std::numeric_limits<double>::infinity();
  const double density = material.reference.density, greatest = material.eos->maximum_density();
  // Specific energies, and volumes and rates over those of the reference state
  struct Limit {
    double energy, volume, rate;
  };
  const std::array<Limit, 16> limits = {{{0, 1, 0},
                                         {unknown, 1, 0},
                                         {infinite, 1, 0},
                                         {-infinite, 1, 0},
                                         {0, 1, unknown},
                                         {1e5, 1, 0.7},
                                         {1e5, 1, -0.4},
                                         {1e5, 1, infinite},
                                         {1e6, density / greatest * 1.01, -0.05},
                                         {1e6, density / greatest, 0},
                                         {-1e9, 1, 0},
                                         {1e12, 1, 0},
                                         {1e6, 30, 0.01},
                                         {4e6, 0.99e9, 0.2},
                                         {1e6, -1, 0},
                                         {1e6, 0, 0}}};
  MaterialPoints points;
  points.failure_threshold_factor.resize(1);
  resize(points, 2 * limits.size());
  for (double& mass : points.mass) mass = density * 1e-9;
  initialise(material, points, 0, 2 * limits.size());
  std::vector<Matrix3> gradients;
  const double dt = 1e-9;
  for (std::size_t i = 0; i < 2 * limits.size(); ++i) {
    const Limit& limit = limits[i / 2];
    points.specific_internal_energy[i] = limit.energy;
    points.volume[i] *= limit.volume;
    gradients.emplace_back(limit.rate / 3 / dt * Matrix3::Identity());
    if (i % 2 == 1) points.failed[i] = failure::tensile;
    if (i % 2 == 1) points.void_volume[i] = 0.1 * std::abs(points.volume[i]);
  }
  const UpdateSettings settings = {.time_step = dt, .cell_size = 1e-3, .time = dt};
  std::vector<double> tables;
  const device::MaterialConstants constants = device::describe(material, settings, tables);
  for (std::size_t i = 0; i < gradients.size(); ++i) {
    SCOPED_TRACE(i);
    device::MaterialState state = state_of(points, i);
    const MaterialReport report =
        update_material(material, points, i, i + 1, std::span(&gradients[i], 1), settings);
    Events events;
    events.add(device::update_point(constants, tables.data(), {dt, dt}, by_rows(gradients[i]), 0.0, state));
    expect_equal(report, events, 1e-10);
    Differences differences;
    differences.add(material, state_of(points, i), state);
    const bool defined = report.equation_of_state.out_of_range == 0 && report.undefined == 0;
    for (const auto& [field, greatest_difference] : differences.greatest) {
      if (defined) {
        EXPECT_LE(greatest_difference, 1e-11) << field;
      }
    }
    EXPECT_EQ(std::isnan(points.pressure[i]), std::isnan(state.pressure));
  }
}

TEST(DevicePoint, ReportsWhatTheHostReportsAtTheLimits) {
  compare_at_limits(read_material("copper_taylor"));
  compare_at_limits(read_material("lead_mie_gruneisen"));
  compare_at_limits(with_eos(
      copper_table(), std::make_shared<eos::Table>(
                          dynamic_cast<const eos::TableOfModel&>(*copper_table().eos).table().data())));
}

/// Expects one refusal that names the material, the key and what is accepted.
void expect_refused(const Material& material, const std::string& key, const std::string& accepted) {
  const std::vector<std::string> refused = device::refusals(material);
  ASSERT_EQ(refused.size(), 1) << material.name;
  EXPECT_THAT(refused[0], testing::AllOf(HasSubstr(material.name), HasSubstr(key), HasSubstr(accepted)));
  std::vector<double> tables;
  EXPECT_THROW(static_cast<void>(device::describe(material, {}, tables)), InputError);
}

TEST(DeviceRefusals, NameMaterialKeyAndWhatIsAccepted) {
  expect_refused(read_material("copper"), "[eos] model = \"gray\"", "equation_of_state = \"table\"");
  expect_refused(read_material("water_tait"), "[eos] model = \"tait\"", "mie_gruneisen");
  expect_refused(read_material("kevlar_fabric_layer_mie_gruneisen"),
                 "[eos] model = \"mie_gruneisen\" with pores", "without pores");
  const Material copper = read_material("copper_taylor");
  const auto floor = std::make_shared<eos::Floor>(copper.eos, eos::FloorConstants{});
  expect_refused(make_material("liquid", floor), "[eos] model = \"mie_gruneisen\" with a modifier",
                 "without modifiers");
  strength::VonMises kinematic = taylor_copper();
  kinematic.kinematic_modulus = 1e9;
  expect_refused(make_material("steel", copper.eos, std::make_shared<strength::VonMisesModel>(kinematic)),
                 "kinematic_modulus = 1000000000 Pa", "isotropic");
  expect_refused(read_material("copper_ofhc_ptw_mie_gruneisen"),
                 "[strength] model = \"preston_tonks_wallace\"", "johnson_cook");
  expect_refused(failing("copper_taylor", {criterion(failure::PrincipalStress{})}),
                 "[[failure]] model = \"principal_stress\"", "fragment_size");
  expect_refused(
      failing("copper_taylor", {criterion(failure::PlasticStrain{}), criterion(failure::PlasticStrain{})}),
      "[[failure]] model = \"plastic_strain\"", "one each");
  expect_refused(burning(read_material("tnt")), "[constitutive] model = \"", "nothing that burns");
  EXPECT_TRUE(device::refusals(copper_table()).empty());
  EXPECT_TRUE(device::refusals(copper).empty());
}

}  // namespace
}  // namespace whipple
