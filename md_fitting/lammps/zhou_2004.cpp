// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/lammps/zhou_2004.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "src/core/base/error.hpp"

namespace whipple::md {
namespace {

/// Holds the constants of one metal; lengths in A, energies in eV.
struct Metal {
  const char* element;
  CrystalStructure structure;
  double mass;                    ///< g/mol
  double re, fe, density, scale;  ///< r_e, f_e, rho_e, rho_s
  double alpha, beta, A, B, kappa, lambda;
  std::array<double, 4> low;     ///< cubic below `low_end`
  std::array<double, 4> middle;  ///< cubic about rho_e; its third coefficient below rho_e
  double third_above;            ///< and above it
  double eta, Fe;
  double low_end;  ///< of rho_e
};

constexpr double middle_end = 1.15;  // of rho_e

// Table III of the publication, as contained in the authors' program (tools/eam_database of LAMMPS).
constexpr std::array metals = {
    Metal{"Cu",
          CrystalStructure::fcc,
          63.546,
          2.556162,
          1.554485,
          21.175871,
          21.175395,
          8.127620,
          4.334731,
          0.396620,
          0.548085,
          0.308782,
          0.756515,
          {-2.170269, -0.263788, 1.088878, -0.817603},
          {-2.19, 0.00, 0.561830, -2.100595},
          -2.100595,
          0.310490,
          -2.186568,
          0.85},
    Metal{"Ag",
          CrystalStructure::fcc,
          107.8682,
          2.891814,
          1.106232,
          14.604100,
          14.604144,
          9.132010,
          4.870405,
          0.277758,
          0.419611,
          0.339710,
          0.750758,
          {-1.729364, -0.255882, 0.912050, -0.561432},
          {-1.75, 0.00, 0.744561, -1.150650},
          -1.150650,
          0.783924,
          -1.748423,
          0.85},
    Metal{"Au",
          CrystalStructure::fcc,
          196.96654,
          2.885034,
          1.529021,
          19.991632,
          19.991509,
          9.516052,
          5.075228,
          0.229762,
          0.356666,
          0.356570,
          0.748798,
          {-2.937772, -0.500288, 1.601954, -0.835530},
          {-2.98, 0.00, 1.706587, -1.134778},
          -1.134778,
          1.021095,
          -2.978815,
          0.85},
    Metal{"Ni",
          CrystalStructure::fcc,
          58.6934,
          2.488746,
          2.007018,
          27.562015,
          27.562031,
          8.383453,
          4.471175,
          0.429046,
          0.633531,
          0.443599,
          0.820658,
          {-2.693513, -0.076445, 0.241442, -2.375626},
          {-2.70, 0.00, 0.265390, -0.152856},
          -0.152856,
          0.445470,
          -2.7,
          0.85},
    Metal{"Pd",
          CrystalStructure::fcc,
          106.42,
          2.750897,
          1.595417,
          21.335246,
          21.940073,
          8.697397,
          4.638612,
          0.406763,
          0.598880,
          0.397263,
          0.754799,
          {-2.321006, -0.473983, 1.615343, -0.231681},
          {-2.36, 0.00, 1.481742, -1.675615},
          -1.675615,
          1.130000,
          -2.352753,
          0.85},
    Metal{"Pt",
          CrystalStructure::fcc,
          195.08,
          2.771916,
          2.336509,
          33.367564,
          35.205357,
          7.105782,
          3.789750,
          0.556398,
          0.696037,
          0.385255,
          0.770510,
          {-1.455568, -2.149952, 0.528491, 1.222875},
          {-4.17, 0.00, 3.010561, -2.420128},
          -2.420128,
          1.450000,
          -4.145597,
          0.25},
    Metal{"Al",
          CrystalStructure::fcc,
          26.981539,
          2.863924,
          1.403115,
          20.418205,
          23.195740,
          6.613165,
          3.527021,
          0.314873,
          0.365551,
          0.379846,
          0.759692,
          {-2.807602, -0.301435, 1.258562, -1.247604},
          {-2.83, 0.00, 0.622245, -2.488244},
          -2.488244,
          0.785902,
          -2.824528,
          0.85},
    Metal{"Pb",
          CrystalStructure::fcc,
          207.2,
          3.499723,
          0.647872,
          8.450154,
          8.450063,
          9.121799,
          5.212457,
          0.161219,
          0.236884,
          0.250805,
          0.764955,
          {-1.422370, -0.210107, 0.682886, -0.529378},
          {-1.44, 0.00, 0.702726, -0.538766},
          -0.538766,
          0.935380,
          -1.439436,
          0.85},
    Metal{"Fe",
          CrystalStructure::bcc,
          55.847,
          2.481987,
          1.885957,
          20.041463,
          20.041463,
          9.818270,
          5.236411,
          0.392811,
          0.646243,
          0.170306,
          0.340613,
          {-2.534992, -0.059605, 0.193065, -2.282322},
          {-2.54, 0.00, 0.200269, -0.148770},
          -0.148770,
          0.391750,
          -2.539945,
          0.85},
    Metal{"Mo",
          CrystalStructure::bcc,
          95.94,
          2.728100,
          2.723710,
          29.354065,
          29.354065,
          8.393531,
          4.476550,
          0.708787,
          1.120373,
          0.137640,
          0.275280,
          {-3.692913, -0.178812, 0.380450, -3.133650},
          {-3.71, 0.00, 0.875874, 0.776222},
          0.776222,
          0.790879,
          -3.712093,
          0.85},
    Metal{"Ta",
          CrystalStructure::bcc,
          180.9479,
          2.860082,
          3.086341,
          33.787168,
          33.787168,
          8.489528,
          4.527748,
          0.611679,
          1.032101,
          0.176977,
          0.353954,
          {-5.103845, -0.405524, 1.112997, -3.585325},
          {-5.14, 0.00, 1.640098, 0.221375},
          0.221375,
          0.848843,
          -5.141526,
          0.85},
    Metal{"W",
          CrystalStructure::bcc,
          183.84,
          2.740840,
          3.487340,
          37.234847,
          37.234847,
          8.900114,
          4.746728,
          0.882435,
          1.394592,
          0.139209,
          0.278417,
          {-4.946281, -0.148818, 0.365057, -4.432406},
          {-4.96, 0.00, 0.661935, 0.348147},
          0.348147,
          0.582714,
          -4.961306,
          0.85},
};

const Metal& metal(const std::string& element) {
  const auto found =
      std::find_if(metals.begin(), metals.end(), [&](const Metal& one) { return element == one.element; });
  if (found != metals.end()) return *found;
  throw InputError(fmt::format("potential {} has no element {}; it has {}", zhou_2004_name, element,
                               fmt::join(zhou_2004_elements(), ", ")));
}

double screened(double factor, double decay, double shift, double x) {
  return factor * std::exp(-decay * (x - 1.0)) / (1.0 + std::pow(x - shift, 20));
}

double cubic(const std::array<double, 4>& c, double third, double y) {
  return c[0] + y * (c[1] + y * (c[2] + y * third));
}

double embedding(const Metal& m, double rho) {
  if (rho < m.low_end * m.density) return cubic(m.low, m.low[3], rho / (m.low_end * m.density) - 1.0);
  if (rho < middle_end * m.density) {
    return cubic(m.middle, rho < m.density ? m.middle[3] : m.third_above, rho / m.density - 1.0);
  }
  const double ratio = rho / m.scale;
  return m.Fe * (1.0 - m.eta * std::log(ratio)) * std::pow(ratio, m.eta);
}

}  // namespace

std::vector<std::string> zhou_2004_elements() {
  std::vector<std::string> elements;
  for (const Metal& m : metals) elements.emplace_back(m.element);
  return elements;
}

EamTables zhou_2004(const std::string& element) {
  constexpr std::size_t densities = 12001;
  constexpr std::size_t radii = 4001;
  constexpr double density_end = 12.0;    // of rho_e
  constexpr double least_distance = 0.5;  // A; the functions are constant below it
  const Metal& m = metal(element);
  EamTables tables;
  tables.element = m.element;
  tables.mass = m.mass;
  tables.header_structure = word_of(m.structure);
  tables.structure = m.structure;
  const bool fcc = m.structure == CrystalStructure::fcc;
  tables.header_lattice_constant = m.re * (fcc ? std::sqrt(2.0) : 2.0 / std::sqrt(3.0));
  tables.cutoff = std::sqrt(5.0) * m.re;
  tables.fitted_density = middle_end * m.density;  // the last branch extrapolates a fit about rho_e
  tables.density_step = density_end * m.density / static_cast<double>(densities - 1);
  for (std::size_t i = 0; i < densities; ++i) {
    tables.embedding.push_back(embedding(m, tables.density_step * static_cast<double>(i)));
  }
  tables.radius_step = tables.cutoff / static_cast<double>(radii - 1);
  for (std::size_t i = 0; i < radii; ++i) {
    const double r = std::max(least_distance, tables.radius_step * static_cast<double>(i));
    const double x = r / m.re;
    tables.density.push_back(screened(m.fe, m.beta, m.lambda, x));
    tables.radius_times_pair.push_back(
        r * (screened(m.A, m.alpha, m.kappa, x) - screened(m.B, m.beta, m.lambda, x)));
  }
  return tables;
}

}  // namespace whipple::md
