// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "eos/curves/queries.hpp"
#include "eos/curves/table.hpp"

namespace whipple::eos::curves {

enum class LineStyle { solid, dashed, dotted, dashdot, thin, marks };

/// Holds a line, or separate points.
struct FigureCurve {
  std::string label;         ///< "Hugoniot", or the name of the measurements
  std::string material;      ///< name of the material; empty for measurements
  std::vector<double> x, y;  ///< in the units of the axes
  int colour = 0;            ///< index in the palette; the same for all curves of one material
  LineStyle style = LineStyle::solid;
};

/// Holds a range about a curve, in the units of the axes.
struct FigureBand {
  std::string label;
  std::vector<double> x, lower, upper;
  int colour = 0;
};

struct Figure {
  std::string title;
  Column x, y;  ///< quantities on the axes
  bool logarithmic_x = false, logarithmic_y = false;
  std::vector<FigureCurve> curves;
  std::vector<FigureCurve> points;  ///< measurements
  std::vector<FigureBand> bands;
};

/// Lists the diagrams of several loci.
enum class DiagramKind {
  shock_velocity,        ///< us-up: principal Hugoniots with their melting range
  pressure_volume,       ///< p-v: Hugoniot, isotherm, cold curve
  pressure_temperature,  ///< p-t: solidus, liquidus, Hugoniot, isentrope, releases
  pressure_density,      ///< p-rho: Hugoniot, releases, liquid and vapour; logarithmic
};

/// Computes the curves of a diagram.
/// @param greatest  pressure (Pa) at which the curves end
/// @param releases  shock pressures (Pa) to release from; empty: a quarter, a half and all of `greatest`
/// @throws InputError if the greatest pressure is not positive
Figure diagram(DiagramKind kind, const Subjects& subjects, double greatest,
               std::vector<double> releases = {});

}  // namespace whipple::eos::curves
