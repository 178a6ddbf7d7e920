// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "src/core/base/words.hpp"

/// Reads and writes the database NAME.md.h5 of finished molecular-dynamics points, the only link between
/// whipple-md, which writes it, and whipple-fit, which reads it. SI units; energies and volumes are per unit mass
/// (docs/theory/molecular_dynamics.md).
namespace whipple::md {

/// Holds a mean and its standard error (1 sigma, statistical only).
struct Estimate {
  double value = 0.0;
  double error = 0.0;
};

/// Lists the protocols that readers of the database distinguish; the words are those of the database.
enum class PointKind : std::uint8_t {
  lattice,
  zero_pressure_volume,
  isotherm,
  isochore,
  hugoniot,
  coexistence,
  cold_curve,
};
constexpr std::array<Word<PointKind>, 7> words(PointKind) {
  return {{{PointKind::lattice, "lattice"},
           {PointKind::zero_pressure_volume, "zero_pressure_volume"},
           {PointKind::isotherm, "isotherm"},
           {PointKind::isochore, "isochore"},
           {PointKind::hugoniot, "hugoniot"},
           {PointKind::coexistence, "coexistence"},
           {PointKind::cold_curve, "cold_curve"}}};
}

/// Lists the states of a point; only a point that was attempted can be stored.
enum class PointStatus : std::uint8_t { not_tried, done, failed };
constexpr std::array<Word<PointStatus>, 2> words(PointStatus) {
  return {{{PointStatus::done, "done"}, {PointStatus::failed, "failed"}}};
}

/// Holds one computed point. The conditions and results of each protocol are listed in
/// docs/theory/molecular_dynamics.md.
struct PointRecord {
  std::string key;       ///< SHA-256 (hexadecimal) of everything on which the point depends; identifies it
  std::string protocol;  ///< "lattice", "isotherm", "hugoniot", ...
  PointStatus status = PointStatus::not_tried;
  std::string message;                       ///< reason for the failure; remarks on a finished point
  std::map<std::string, double> conditions;  ///< SI
  std::map<std::string, Estimate> results;   ///< SI; empty if the point failed
  /// Block averages over equal parts of the averaged time, for resampling (docs/theory/fit.md, section 2), by name
  /// of the result; all results have the same number of blocks. Points of older databases have none.
  std::map<std::string, std::vector<double>> blocks;
  std::map<std::string, std::string> provenance;  ///< potential, its hash, element, molar_mass (kg/mol),
                                                  ///< sizes, steps, seed, LAMMPS version, ...
  double wall_seconds = 0.0;

  [[nodiscard]] bool done() const { return status == PointStatus::done; }
  /// Returns the kind of the point; none for a protocol that no reader distinguishes.
  [[nodiscard]] std::optional<PointKind> kind() const { return value_of<PointKind>(protocol); }
  /// Returns the number of independent runs averaged into this point (provenance "segments"; 1 if absent).
  [[nodiscard]] int segments() const;
  /// Returns a condition that the protocol requires.
  /// @throws InputError naming the point and the condition.
  [[nodiscard]] double condition(std::string_view name) const;
  /// Returns a result that the protocol requires.
  /// @throws InputError naming the point and the result.
  [[nodiscard]] Estimate result(std::string_view name) const;
  /// Returns a required provenance entry.
  /// @throws InputError naming the point and the entry.
  [[nodiscard]] std::string origin(std::string_view name) const;
  /// Returns a provenance entry as a number, e.g. origin_number("molar_mass") in kg/mol.
  /// @throws InputError naming the point and the entry.
  [[nodiscard]] double origin_number(std::string_view name) const;
  /// Returns a label such as "isotherm at specific_volume = 0.0001 m^3/kg, temperature = 293 K".
  [[nodiscard]] std::string label() const;
};

/// Returns the SI unit of a condition or result by its name; empty for dimensionless quantities and unknown names.
std::string_view unit_of(std::string_view quantity);

/// Returns all points of a database in the order in which they were added.
/// @throws InputError if the file is missing, is not a database, or was written in a newer format.
std::vector<PointRecord> read_store(const std::filesystem::path& path);

/// Returns the finished points of one protocol (status "done"). Of points with equal conditions, only those
/// computed by the newest revision of the protocol present in the database are returned.
std::vector<PointRecord> select(std::span<const PointRecord> points, std::string_view protocol);

/// Adds a point, or replaces a failed point with the same key or a finished one with fewer segments. The file is
/// replaced atomically (copy, change, sync, rename), so that a reader or a crash sees either the old or the new
/// database, never a partial one; a lock file in the same folder serialises writers. A missing database is created,
/// together with its folder.
/// @returns false, leaving the database unchanged, if it holds a finished point with the same key and as many segments.
/// @throws InputError if the database cannot be written or the file is not a database.
bool append_point(const std::filesystem::path& path, const PointRecord& point);

/// Checks that `append_point` can write to the path; called before any expensive work. @throws InputError if it cannot.
void require_writable(const std::filesystem::path& path);

}  // namespace whipple::md
