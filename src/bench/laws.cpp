// SPDX-License-Identifier: BSD-3-Clause
#include "src/bench/laws.hpp"

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <random>
#include <utility>

#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/temporary_folder.hpp"
#include "src/io/run_directory.hpp"
#include "src/material/material_file.hpp"
#include "src/material/update.hpp"

namespace whipple::bench {
namespace {

constexpr std::size_t point_count = 32768;
constexpr int steps_per_round = 4;

struct Law {
  const char* name;
  const char* kind;
  /// Holds tables that are added to those of copper. The constants serve for timing only: those of the library if it
  /// has the law, otherwise of the magnitude of copper's.
  const char* tables;
};

constexpr const char* johnson_cook = "johnson_cook";

constexpr Law laws[] = {
    {johnson_cook, "strength", "failure = []\n"},
    {"none", "strength", "failure = []\n[strength]\nmodel = 'none'\n"},
    {"von_mises", "strength",
     "failure = []\n[strength]\nmodel = 'von_mises'\nsource = 'time only'\nshear_modulus = '47.7 GPa'\n"
     "yield_stress = '90 MPa'\nhardening_modulus = '400 MPa'\n"},
    {"power_law", "strength",
     "failure = []\n[strength]\nmodel = 'power_law'\nsource = 'time only'\nshear_modulus = '47.7 GPa'\n"
     "yield_stress = '90 MPa'\nhardening_coefficient = '292 MPa'\nhardening_exponent = 0.31\n"},
    {"voce", "strength",
     "failure = []\n[strength]\nmodel = 'voce'\nsource = 'time only'\nshear_modulus = '47.7 GPa'\n"
     "yield_stress = '90 MPa'\nfirst_saturation = '250 MPa'\nfirst_rate = 5.0\n"},
    {"steinberg_guinan", "strength",
     "failure = []\n[strength]\nmodel = 'steinberg_guinan'\nsource = 'time only'\nreference_density = '8.93 "
     "g/cm^3'\n"
     "shear_modulus = '47.7 GPa'\npressure_coefficient = '0.0283 1/GPa'\ntemperature_coefficient = '0.000377 "
     "1/K'\n"
     "yield_stress = '0.12 GPa'\nmaximum_flow_stress = '0.64 GPa'\nhardening_coefficient = 36\n"
     "hardening_exponent = 0.45\n"},
    {"zerilli_armstrong", "strength",
     "failure = []\n[strength]\nmodel = 'zerilli_armstrong'\nsource = 'time only'\nshear_modulus = '47.7 "
     "GPa'\n"
     "athermal_stress = '65 MPa'\nthermal_hardening = '890 MPa'\nthermal_coefficient = '0.0028 1/K'\n"
     "rate_coefficient = '0.000115 1/K'\nhardening_coefficient = '0 MPa'\n"},
    {"preston_tonks_wallace", "strength", "base = 'copper_ofhc_ptw_mie_gruneisen'\nfailure = []\n"},
    {"mechanical_threshold", "strength", "base = 'copper_ofhc_annealed_mts_mie_gruneisen'\nfailure = []\n"},
    {"tensile_pressure", "failure",
     "[[failure]]\nmodel = 'tensile_pressure'\nsource = 'time only'\nspall_strength = '1.4 GPa'\n"},
    {"tuler_butcher", "failure",
     "[[failure]]\nmodel = 'tuler_butcher'\nsource = 'time only'\nthreshold = '1 GPa'\nexponent = 2.0\ntime "
     "= '1 us'\n"},
    {"viscous_void_growth", "failure",
     "[[failure]]\nmodel = 'viscous_void_growth'\nsource = 'time only'\nresistance = '0.185 GPa'\nviscosity "
     "= '1 Pa s'\n"
     "nuclei = 3e-4\n"},
    {"plastic_strain", "failure",
     "[[failure]]\nmodel = 'plastic_strain'\nsource = 'time only'\nfailure_strain = 1e6\n"},
    {"johnson_cook_damage", "failure",
     "[[failure]]\nmodel = 'johnson_cook_damage'\nsource = 'time only'\nd1 = 1e6\nd2 = 4.89\nd3 = -3.03\nd4 "
     "= 0.014\n"
     "d5 = 1.12\nreference_temperature = '294 K'\nmelting_temperature = '1356 K'\n"},
    {"principal_stress", "failure",
     "[[failure]]\nmodel = 'principal_stress'\nsource = 'time only'\ntensile_strength = '100 GPa'\n"},
    {"principal_strain", "failure",
     "[[failure]]\nmodel = 'principal_strain'\nsource = 'time only'\nfailure_strain = 1e6\n"},
    {"tearing", "failure",
     "[[failure]]\nmodel = 'tearing'\nsource = 'time only'\nenergy_per_area = '1 MJ/m^2'\nfailure_strain = "
     "0.1\n"},
    {"gurson", "failure",
     "[[failure]]\nmodel = 'gurson'\nsource = 'time only'\ninitial_porosity = 0.001\nfailure_porosity = "
     "0.25\n"},
};

/// Returns the processor time of this thread (s), independent of the load of the machine.
double processor_time() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Holds points in alternating flow and measures the time of their update.
class Flow {
 public:
  Flow(const Law& law, Material material) : law_(law), material_(std::move(material)) {
    resize(points_, point_count);
    std::ranges::fill(points_.mass, 1e-6);
    initialise(material_, points_, 0, point_count);
  }
  /// Returns the time per point and step in ns.
  double time(const std::vector<Matrix3>& forward, const std::vector<Matrix3>& back) {
    const UpdateSettings settings{.time_step = 1e-7, .cell_size = 1e-3};
    const double begin = processor_time();
    for (int step = 0; step < steps_per_round; ++step) {
      update_material(material_, points_, 0, point_count, step % 2 == 0 ? forward : back, settings);
    }
    const double seconds = processor_time() - begin;
    return 1e9 * seconds / (steps_per_round * static_cast<double>(point_count));
  }
  [[nodiscard]] const Law& law() const { return law_; }

 private:
  Law law_;
  Material material_;
  MaterialPoints points_;
};

/// Reads copper with the tables of a law.
Material material_with(const Law& law) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / fmt::format("{}.toml", law.name);
  const std::string tables = law.tables;
  const std::string base = tables.starts_with("base") ? "" : "base = 'copper_ofhc_mie_gruneisen'\n";
  io::write_text_atomically(
      file.string(), fmt::format("name = 'copper, {}'\nsource = 'time only'\n{}{}", law.name, base, tables));
  return read_material(file);
}

double part(std::vector<double> values, double share) {
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

}  // namespace

std::vector<LawMeasurement> measure_laws(int rounds) {
  std::mt19937_64 generator(5);
  std::uniform_real_distribution<double> uniform(-1e4, 1e4);
  std::vector<Matrix3> forward(point_count);
  for (Matrix3& gradient : forward) {
    for (int k = 0; k < 9; ++k) gradient(k / 3, k % 3) = uniform(generator);
    gradient.diagonal().array() -= gradient.trace() / 3.0;
  }
  std::vector<Matrix3> back = forward;
  for (Matrix3& gradient : back) gradient = -gradient;

  std::vector<Flow> flows;
  for (const Law& law : laws) {
    flows.emplace_back(law, material_with(law)).time(forward, back);  // once, for warm-up
  }
  std::vector<std::vector<double>> times(flows.size()), multiples(flows.size());
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < flows.size(); ++i) times[i].push_back(flows[i].time(forward, back));
    for (std::size_t i = 0; i < flows.size(); ++i) multiples[i].push_back(times[i].back() / times[0].back());
  }
  std::vector<LawMeasurement> all;
  for (std::size_t i = 0; i < flows.size(); ++i) {
    all.push_back({flows[i].law().name, flows[i].law().kind, part(times[i], 0.5), part(multiples[i], 0.5),
                   part(multiples[i], 0.25), part(multiples[i], 0.75)});
  }
  return all;
}

}  // namespace whipple::bench
