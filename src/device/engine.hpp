// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "src/device/contact/touches.hpp"
#include "src/device/ends.hpp"
#include "src/device/figures.hpp"
#include "src/device/problem.hpp"

/// The step on a device: an accelerator, or its emulation on the threads of the host.
namespace whipple::device {

/// Stages of a step, whose times are measured.
enum class Stage : std::uint8_t { bins, conduction, scatter, grid, contact, gather, material, ends };
constexpr std::size_t stage_count = 8;
/// Names of the stages, those of the host's.
constexpr std::array<const char*, stage_count> stage_names = {
    "bin particles", "conduction",        "particles to grid", "grid",
    "contact",       "grid to particles", "material",          "ledger"};

/// What a device can do at most.
struct Rates {
  double bandwidth;   ///< bytes per second, read and written, of a copy
  double arithmetic;  ///< floating-point operations per second, in double precision
};

/// What a step is told.
struct StepInput {
  double dt;                    ///< s
  double end;                   ///< time at its end, s
  Triple<double> acceleration;  ///< of all particles by loads, m/s^2
  double least_closing_speed;   ///< of first contacts that limit the time step, m/s
  bool looks_at_fill;           ///< for material under pressure in cells that it does not fill
  bool sorts;                   ///< the particles in memory, by body and cell
};

/// Result of a step.
struct Outcome {
  EndOfStep sums;                         ///< totals at its end, contributions, bounds of the next step
  double conducted_heat = 0.0;            ///< J
  std::array<double, 3> plane_impulse{};  ///< by mirror planes on nodes, N s
  double hoop_impulse = 0.0;              ///< of hoop stresses on nodes, along the radius, N s
  /// Heat of contact and of friction (J), their impulses (N s), number of places that more than two fields reach.
  std::array<double, 5> contact{};
  Triple<double> crowded_at{};                      ///< one of these places, m
  std::vector<DecidingApproaches> approaches;       ///< of each pair of fields; empty: none meet
  std::vector<DecidingApproaches> face_approaches;  ///< of each face; empty: nothing meets its image
  double wall_heat = 0.0;                           ///< of contact with images, J
  std::vector<Outflow::Result> outflow;             ///< of each body; empty: nothing leaves
  std::vector<MarkedMass::Result> squeezed;  ///< of each body; empty: no particle is at its greatest density
  double held_pressures = 0.0;               ///< number of fluid particles that have parted
  double beside_voids = 0.0;  ///< mass under pressure in cells that it does not fill, before the step, kg
  std::uint32_t slots = 0, cells = 0;  ///< blocks with nodes, cells with particles
};

/// Keeps the particles of a run on a device and steps them.
class Engine {
 public:
  virtual ~Engine() = default;
  /// Performs a step.
  virtual Outcome step(const StepInput& input) = 0;
  /// Sets the velocity (m/s) of the frame in which the largest speed is measured.
  virtual void set_frame(const Triple<double>& velocity) = 0;
  /// Returns the totals and bounds of the present state.
  virtual EndOfStep measure() = 0;
  /// Returns what the history shows of each body.
  virtual std::vector<BodyFigures> figures() = 0;
  /// Returns whether any particle is so long that it must be divided before the next step.
  virtual bool must_divide() = 0;
  /// Replaces the particles.
  virtual void upload(const PointsOnHost& points) = 0;
  /// Copies the state to the host, in its order: `origin` is the place of each particle in the former one.
  virtual void download(PointsOnHost& points) = 0;
  /// Returns the closing rate (1/s) that at most the fraction `share` of the mass (kg) exceeds (rates.hpp).
  virtual double rate_of_most(double total_mass, double share, double least, double largest) = 0;
  [[nodiscard]] virtual std::size_t size() const = 0;
  [[nodiscard]] virtual std::size_t bytes() const = 0;
  /// Returns the number of blocks with nodes in the last step.
  [[nodiscard]] virtual std::size_t slots() const = 0;
  [[nodiscard]] virtual std::string device() const = 0;
  /// Measures what the device can do at most.
  virtual Rates rates() = 0;
  /// Measures the time of the stages from now on, which waits for the device after each of them.
  virtual void measure_stages(bool measure) = 0;
  /// Returns the time of each stage, s, since they have been measured.
  [[nodiscard]] virtual const std::array<double, stage_count>& stage_times() const = 0;
};

/// Starts on the emulated device.
std::unique_ptr<Engine> emulated_engine(const Problem& problem, const PointsOnHost& points);
/// Returns whether the program was built with the compiler of a graphics processor.
bool has_gpu_engine();
/// Graphics processor of this machine.
struct Card {
  std::string name;
  double memory, free_memory;  ///< bytes
};
/// Returns the graphics processor; none if there is none, or if the program was built without its compiler.
std::optional<Card> find_card();
/// Measures what it can do at most.
/// @throws StateError without one
Rates card_rates();
/// Starts on the graphics processor.
/// @throws StateError without one, or without memory
std::unique_ptr<Engine> gpu_engine(const Problem& problem, const PointsOnHost& points);

/// The same with the grid of two dimensions, to which those above turn. Its kernels are compiled apart: GCC's limits of
/// inlining, and with them the last bits of results, count by what is compiled together.
namespace in_section {
std::unique_ptr<Engine> emulated_engine(const Problem& problem, const PointsOnHost& points);
std::unique_ptr<Engine> gpu_engine(const Problem& problem, const PointsOnHost& points);
}  // namespace in_section

}  // namespace whipple::device
