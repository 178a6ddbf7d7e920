// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace whipple::contact {

/// Returns whether surfaces at a distance (m) touch within a step (s). A step that a predicted contact has shortened ends
/// with it but for round-off, which must not decide.
inline bool touches_in(double open, double closing_speed, double step) {
  constexpr double round_off = 1e-9;
  return open < (1.0 + round_off) * step * closing_speed;
}

/// Records which velocity fields have touched each other or a face of the domain, and predicts the next first contact,
/// at which the time step ends (docs/theory/mpm.md, section 6). Later contacts of the same pair are ignored.
class FirstTouches {
 public:
  explicit FirstTouches(unsigned fields);

  /// Bit masks: for each field the fields that it has touched, in words of 64, then the domain faces that any field has
  /// touched.
  using Words = std::vector<std::uint64_t>;
  [[nodiscard]] const Words& words() const { return touched_; }
  void set(const Words& words);

  /// Begins a step.
  /// @param dt           time step, s
  /// @param least_speed  minimum closing speed of contacts that limit the time step, m/s
  void begin_step(double dt, double least_speed);
  /// Records gap and closing speed of two fields at a node. Surfaces that do not close cannot touch. Thread-safe.
  /// @param open     distance of the surfaces, m; <= 0: they touch
  /// @param closing  closing speed after the step without contact, m/s
  void see(unsigned field, unsigned other, double open, double closing) {
    if (closing > 0.0 && (word(field, other) >> other % 64 & 1U) == 0) look(field, other, open, closing);
  }
  /// Records gap and closing speed of any field and a face of the domain.
  void see_face(std::size_t face, double open, double closing) {
    see(fields_, static_cast<unsigned>(face), open, closing);
  }

  /// Describes the contacts found in the step.
  struct Outcome {
    bool hard = false;  ///< surfaces with at least that closing speed have touched
    /// Time of the next such contact from the beginning of the step, s; 1e300: none is predicted.
    double next = 1e300;
  };
  /// Combines the records of all ranks. Collective.
  [[nodiscard]] Outcome end_step(MPI_Comm communicator);

 private:
  std::uint64_t& word(std::size_t field, std::size_t other) { return touched_[field * words_ + other / 64]; }
  void look(unsigned field, unsigned other, double open, double closing);

  unsigned fields_;
  std::size_t others_, words_;  // maximum number of partners of a field, and of their words
  Words touched_;               // before this step
  // In this step, for each pair, field by field; last the pairs with domain faces.
  std::vector<std::atomic<double>> next_;  // s
  std::vector<std::atomic<bool>> hard_;
  double dt_ = 0.0, least_speed_ = 0.0;
};

}  // namespace whipple::contact
