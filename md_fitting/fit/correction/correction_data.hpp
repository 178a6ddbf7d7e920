// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "eos/models/free_energy_spline.hpp"
#include "eos/models/gray_free_energy.hpp"
#include "md_fitting/data_set/data_set.hpp"
#include "md_fitting/fit/correction/left_out_curves.hpp"
#include "md_fitting/fit/joint/variance_components.hpp"

/// Collects what simulated states say about the free energies of solid and fluid (docs/theory/fit.md, section 10).
namespace whipple::fit {

/// Names a surface of the free energy.
enum class PhaseSurface { solid, fluid };

/// Holds a linear functional of the correction of one surface at one state, SI.
struct SurfaceTerm {
  PhaseSurface surface = PhaseSurface::solid;
  double volume = 0.0, temperature = 0.0;  ///< m^3/kg, K
  eos::FreeEnergyTerms weights;
};

/// Names what a datum compares.
enum class CorrectionRowKind { pressure, energy, gibbs, fusion, film, kept, measured };

/// Holds a datum that is linear in the corrections: residual = sum of the terms + energy_zero E_0 + error, with E_0 the
/// zero of the energies of the simulation.
struct CorrectionDatum {
  std::string kind;  ///< "isotherm and isochores, pressure", ...
  CorrectionRowKind row = CorrectionRowKind::measured;
  double residual = 0.0;     ///< datum less GRAY
  double scale = 1.0;        ///< by which residuals are reported, in the unit of the datum
  double energy_zero = 0.0;  ///< 1 for an energy, 0 for all others
  std::vector<SurfaceTerm> terms;
  CurveGroup group = CurveGroup::none;
  std::string curve{};  ///< isotherm, isochore, film, table ... that it belongs to; left out as a whole
};

/// Holds all data with the covariance of their errors.
struct CorrectionData {
  std::vector<CorrectionDatum> data;
  Eigen::MatrixXd covariance;
  std::vector<VarianceComponent> deviations;  ///< of estimated size, beside it
};

/// Returns the data of both.
CorrectionData joined(CorrectionData first, const CorrectionData& second);

/// Holds what films may be off beside their noise, relative.
struct FilmErrors {
  double liquid_density, vapour_density, vapour_pressure;
};
/// As data of the potential: two replicas, whose own errors are known to 70 % only.
constexpr FilmErrors of_films = {0.01, 0.2, 0.2};
/// As data of the metal: potentials in addition.
constexpr FilmErrors of_films_for_metal = {0.03, 0.5, 0.5};

/// Specifies whether films of melt and vapour are data.
enum class Films { used, left_out };

/// Collects the states of a store: solid and molten states and shocks, volumes at zero pressure, melts, coexistence,
/// films. Every residual is taken at the simulated volume and temperature, so that it is exactly linear.
/// @param classical      GRAY without electrons, as the simulations are
/// @param melts_measured  temperatures, K, at which melting was measured: the line of GRAY is not kept there
CorrectionData correction_data(std::span<const md::PointRecord> points, const eos::GrayFreeEnergy& classical,
                               Films films, const FilmErrors& film_errors = of_films,
                               std::span<const double> melts_measured = {});

}  // namespace whipple::fit
