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

/// The store NAME.md.h5 of finished molecular-dynamics points: the only link between whipple-md, which writes
/// it, and whipple-fit, which reads it. SI units, energies and volumes per mass
/// (docs/theory/molecular_dynamics.md).
namespace whipple::md {

/// A mean and its standard error (1 sigma, statistical only).
struct Estimate {
  double value = 0.0;
  double error = 0.0;
};

/// Protocols whose points a reader of the store tells apart; the words are those of the store.
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

/// State of a point; only one that was tried can be stored.
enum class PointStatus : std::uint8_t { not_tried, done, failed };
constexpr std::array<Word<PointStatus>, 2> words(PointStatus) {
  return {{{PointStatus::done, "done"}, {PointStatus::failed, "failed"}}};
}

/// One computed point. Which conditions and results belong to which protocol:
/// docs/theory/molecular_dynamics.md.
struct PointRecord {
  std::string key;  ///< SHA-256 (hexadecimal) of everything the point depends on; its identity in the store
  std::string protocol;  ///< "lattice", "isotherm", "hugoniot", ...
  PointStatus status = PointStatus::not_tried;
  std::string message;                       ///< why it failed; remarks of a point that is done
  std::map<std::string, double> conditions;  ///< SI
  std::map<std::string, Estimate> results;   ///< SI; empty if the point failed
  /// Means over equal parts of the averaged time, for resampling (docs/theory/fit.md, section 2): of results
  /// by name, equally many of each. Points of older stores have none.
  std::map<std::string, std::vector<double>> blocks;
  std::map<std::string, std::string> provenance;  ///< potential, its hash, element, molar_mass (kg/mol),
                                                  ///< sizes, steps, seed, LAMMPS version, ...
  double wall_seconds = 0.0;

  [[nodiscard]] bool done() const { return status == PointStatus::done; }
  /// Returns what the point is of; none for a protocol that no reader tells apart.
  [[nodiscard]] std::optional<PointKind> kind() const { return value_of<PointKind>(protocol); }
  /// Independent runs that were averaged into this point (provenance "segments"; 1 without it).
  [[nodiscard]] int segments() const;
  /// A condition that the protocol must have.
  /// @throws InputError naming the point and the condition.
  [[nodiscard]] double condition(std::string_view name) const;
  /// A result that the protocol must have.
  /// @throws InputError naming the point and the result.
  [[nodiscard]] Estimate result(std::string_view name) const;
  /// A provenance entry that must be there.
  /// @throws InputError naming the point and the entry.
  [[nodiscard]] std::string origin(std::string_view name) const;
  /// Returns a provenance entry as a number, e.g. origin_number("molar_mass") in kg/mol.
  /// @throws InputError naming the point and the entry.
  [[nodiscard]] double origin_number(std::string_view name) const;
  /// "isotherm at specific_volume = 0.0001 m^3/kg, temperature = 293 K"
  [[nodiscard]] std::string label() const;
};

/// SI unit of a condition or result by its name; empty for numbers without dimension and unknown names.
std::string_view unit_of(std::string_view quantity);

/// All points of a store in the order in which they were added.
/// @throws InputError if the file is missing, is no store, or was written by a newer format.
std::vector<PointRecord> read_store(const std::filesystem::path& path);

/// The finished points of one protocol (status "done"): of those with the same conditions only what the
/// newest revision of the protocol computed, as far as the store holds it.
std::vector<PointRecord> select(std::span<const PointRecord> points, std::string_view protocol);

/// Adds one point, or replaces the failed point of the same key, or a finished one of fewer segments. The
/// file is replaced as a whole (copy, change, sync, rename), so a reader or a crash sees the old or the new
/// store, never half of one; a lock file beside it serialises writers. A missing store is made, with its
/// folder.
/// @returns false, and leaves the store as it is, if a finished point of the same key and as many segments is
/// there.
/// @throws InputError if the store cannot be written or is no store.
bool append_point(const std::filesystem::path& path, const PointRecord& point);

/// Throws InputError unless `append_point` can work on the path: called before any expensive work.
void require_writable(const std::filesystem::path& path);

}  // namespace whipple::md
