// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace whipple::contact {

/// Record of which velocity fields have touched one another or a face of the domain, and forecast of the next
/// first contact, at which the time step ends (docs/theory/mpm.md, section 6). Later contacts of the same
/// pair are ignored.
class FirstTouches {
 public:
  explicit FirstTouches(unsigned fields);

  /// As words of bits: of each field those that it has touched, then the faces that any has touched.
  using Words = std::vector<std::uint64_t>;
  [[nodiscard]] const Words& words() const { return touched_; }
  void set(const Words& words);

  /// @param dt           s, of the step
  /// @param least_speed  m/s, by which surfaces must close for the time step to heed their touch
  void begin_step(double dt, double least_speed);
  /// Takes note of two fields at a node; by several threads at a time. Nothing touches that does not close.
  /// @param open     m, between their surfaces; <= 0: they touch
  /// @param closing  m/s, after the step without contact
  void see(unsigned field, unsigned other, double open, double closing) {
    if (closing > 0.0 && (touched_[field] >> other & 1U) == 0) look(field, other, open, closing);
  }
  /// Records gap and closing speed of any field and a face of the domain.
  void see_face(std::size_t face, double open, double closing) {
    see(fields_, static_cast<unsigned>(face), open, closing);
  }

  /// Contacts found in the step.
  struct Outcome {
    bool hard = false;    ///< what closes with at least that speed has touched
    double next = 1e300;  ///< s from the beginning of the step, until the next does; 1e300: none in sight
  };
  /// Collective.
  [[nodiscard]] Outcome end_step(MPI_Comm communicator);

 private:
  void look(unsigned field, unsigned other, double open, double closing);

  unsigned fields_;
  std::size_t others_;  // of each field, at most
  Words touched_;       // before this step
  // In this step, of each pair, field by field; the last: of the faces.
  std::vector<std::atomic<double>> next_;  // s
  std::vector<std::atomic<bool>> hard_;
  double dt_ = 0.0, least_speed_ = 0.0;
};

}  // namespace whipple::contact
