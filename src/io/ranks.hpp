// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "src/core/base/files.hpp"
#include "src/core/hdf5/hdf5.hpp"

namespace whipple::io {

/// Represents the processes that write one file together. A program that never started MPI is one rank.
class Ranks {
 public:
  explicit Ranks(MPI_Comm communicator);

  [[nodiscard]] int rank() const { return rank_; }
  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] bool is_root() const { return rank_ == 0; }
  [[nodiscard]] bool is_parallel() const { return count_ > 1; }
  /// Returns the communicator with which files are opened; none if there is only one process.
  [[nodiscard]] std::optional<MPI_Comm> communicator() const {
    return is_parallel() ? std::optional(communicator_) : std::nullopt;
  }

  /// Returns one value of every rank, in rank order. Collective.
  [[nodiscard]] std::vector<std::uint64_t> gather(std::uint64_t value) const;
  /// Returns the rows of a shared array that belong to this rank: `count` rows after those of the lower ranks.
  /// Collective.
  [[nodiscard]] hdf5::Slab slab(std::uint64_t count) const;
  /// Returns the text of one rank, by default the root, on every rank. Collective.
  [[nodiscard]] std::string broadcast(std::string text, int source = 0) const;
  /// Runs `work` on the root; if it throws there, every rank throws an error of the same kind and text. Collective.
  void on_root(const std::function<void()>& work) const;
  /// Runs `work`, which does not communicate, on every rank. If it throws on some ranks, every rank throws an error of
  /// the kind and text of the first of them, so that no rank waits for the others. Collective.
  void on_all(const std::function<void()>& work) const;

 private:
  MPI_Comm communicator_;
  int rank_ = 0;
  int count_ = 1;
};

/// Manages a file that the ranks write together: the root creates it, and publishes or discards it at the end.
/// Collective.
class SharedPartialFile {
 public:
  SharedPartialFile(const std::filesystem::path& target, const Ranks& ranks);

  /// Returns the temporary path to which all ranks write.
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Renames the file to its final name, on the root (`PartialFile::publish`).
  void publish(bool durable = false) { of_root_->publish(durable); }

 private:
  std::optional<PartialFile> of_root_;
  std::filesystem::path path_;
};

}  // namespace whipple::io
