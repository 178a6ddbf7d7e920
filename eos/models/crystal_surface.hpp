// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "eos/models/isochore_source.hpp"

namespace whipple::eos {

/// Represents the free energy of a crystal between simulated isochores (docs/theory/equations_of_state.md,
/// "Simulated crystals"):
///   F = phi(V) + c T [psi(V) - ln(T/T0)] - g T^2/2,    V psi' = -gamma(V),    c = 3 R/M.
/// phi is a cubic through energy and pressure of the static crystal at both ends of an interval of volumes, gamma
/// is linear between its values at the ends. Intervals are computed on first use; each depends on its volumes
/// alone, so that the surface does not depend on the order of evaluation.
class CrystalSurface {
 public:
  struct Settings {
    double least_ratio = 0.0, greatest_ratio = 0.0;  ///< range of V over that of the static crystal
    double spacing = 0.0;                            ///< width of the intervals before subdivision
    double greatest_temperature = 0.0;               ///< K: upper end of the error estimate
    double tolerance = 0.0;                          ///< Pa: upper limit of the estimated pressure error
    int divisions = 0;                               ///< largest number of halvings of an interval
  };
  /// Holds the functions of volume at one volume (per mass, SI).
  struct Point {
    double cold_energy = 0.0;                       ///< phi
    double first = 0.0, second = 0.0;               ///< phi', phi''
    double gruneisen = 0.0, gruneisen_slope = 0.0;  ///< gamma, d gamma/dV
  };
  /// Holds one interval between two simulated isochores.
  struct Leaf {
    double begin = 0.0, end = 0.0;                                   ///< m^3/kg
    double energy = 0.0, slope = 0.0, quadratic = 0.0, cubic = 0.0;  ///< phi in powers of (V - begin)
    double gruneisen = 0.0, gruneisen_slope = 0.0;
    [[nodiscard]] Point at(double volume) const {
      const double h = volume - begin;
      return {energy + h * (slope + h * (quadratic + h * cubic)),
              slope + h * (2.0 * quadratic + 3.0 * h * cubic), 2.0 * quadratic + 6.0 * h * cubic,
              gruneisen + h * gruneisen_slope, gruneisen_slope};
    }
  };
  struct Cell {
    std::vector<Leaf> leaves;  ///< by increasing volume
    double error = 0.0;        ///< Pa, the largest estimate over the leaves
    std::string fault;         ///< reason why there is no surface here; empty: there is
    [[nodiscard]] const Leaf& leaf(double volume) const {
      std::size_t i = 0;
      while (i + 1 < leaves.size() && volume > leaves[i].end) ++i;
      return leaves[i];
    }
  };

  /// Requests the isochore at the volume of the static crystal, which determines g.
  /// @throws StateError if there is none
  CrystalSurface(std::unique_ptr<IsochoreSource> source, const Settings& settings);
  ~CrystalSurface();

  /// Returns the cell of a volume, computed on the first call; null outside the range. Thread-safe.
  [[nodiscard]] const Cell* cell(double volume) const;

  [[nodiscard]] double least_volume() const { return settings_.least_ratio * static_volume_; }
  [[nodiscard]] double greatest_volume() const { return settings_.greatest_ratio * static_volume_; }
  [[nodiscard]] double heat_capacity() const { return heat_capacity_; }        ///< c, J/(kg K)
  [[nodiscard]] double anharmonic_coefficient() const { return anharmonic_; }  ///< g, J/(kg K^2)

 private:
  struct Node {
    double volume = 0.0, cold_energy = 0.0, cold_pressure = 0.0, gruneisen = 0.0;
    double misfit = 0.0;  ///< Pa: deviation of the law from the simulated states
  };
  void fetch(const std::vector<double>& ratios) const;
  [[nodiscard]] Node node_of(const SimulatedIsochore& isochore) const;
  [[nodiscard]] Leaf leaf_between(const Node& a, const Node& b) const;
  void divide(double low, double high, int level, Cell& cell) const;
  [[nodiscard]] std::unique_ptr<Cell> work_out(std::size_t index) const;

  std::unique_ptr<IsochoreSource> source_;
  Settings settings_;
  double static_volume_, heat_capacity_, anharmonic_ = 0.0;
  // Lazily filled; published entries of `cells_` never change.
  mutable std::mutex mutex_;
  mutable std::map<double, Node> nodes_;
  mutable std::vector<std::atomic<const Cell*>> cells_;
  mutable std::vector<std::unique_ptr<Cell>> owned_;
};

}  // namespace whipple::eos
