// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "src/device/ends.hpp"
#include "src/device/problem.hpp"

/// The step on a device: an accelerator, or its emulation on the threads of the host.
namespace whipple::device {

/// Stages of a step, whose times are measured.
enum class Stage : std::uint8_t { bins, conduction, scatter, grid, contact, gather, material, ends };
constexpr std::array<const char*, 8> stage_names = {"bins",    "conduction", "scatter",  "grid",
                                                    "contact", "gather",     "material", "ends"};

/// Result of a step.
struct Outcome {
  EndOfStep sums;                         ///< totals at its end, contributions, bounds of the next step
  double conducted_heat = 0.0;            ///< J
  std::array<double, 3> plane_impulse{};  ///< by mirror planes on nodes, N s
  std::array<double, 4> contact{};        ///< heat, heat of friction (J), impulses (N s)
  std::vector<Outflow::Result> outflow;   ///< of each body; empty: nothing leaves
  std::uint32_t slots = 0, cells = 0;     ///< blocks with nodes, cells with particles
};

/// Keeps the particles of a run on a device and steps them.
class Engine {
 public:
  virtual ~Engine() = default;
  /// Performs a step.
  /// @param dt   s
  /// @param end  time at its end, s
  virtual Outcome step(double dt, double end) = 0;
  /// Returns the totals and bounds of the present state.
  virtual EndOfStep measure() = 0;
  /// Copies the state to the host, in the order of `origin`, which becomes 0, 1, 2 ...
  virtual void download(PointsOnHost& points) = 0;
  /// Returns the closing rate (1/s) that at most the fraction `share` of the mass (kg) exceeds (rates.hpp).
  virtual double rate_of_most(double total_mass, double share, double least, double largest) = 0;
  [[nodiscard]] virtual std::size_t size() const = 0;
  [[nodiscard]] virtual std::size_t bytes() const = 0;
  [[nodiscard]] virtual std::string device() const = 0;
  /// Measures the time of the stages from now on, which waits for the device after each of them.
  virtual void measure_stages(bool measure) = 0;
  /// Returns the time of each stage, s, since they have been measured.
  [[nodiscard]] virtual const std::array<double, stage_names.size()>& stage_times() const = 0;
};

/// Starts on the emulated device.
std::unique_ptr<Engine> emulated_engine(const Problem& problem, const PointsOnHost& points);
/// Returns whether the program was built with the compiler of a graphics processor.
bool has_gpu_engine();
/// Starts on the graphics processor.
/// @throws StateError without one, or without memory
std::unique_ptr<Engine> gpu_engine(const Problem& problem, const PointsOnHost& points);

}  // namespace whipple::device
