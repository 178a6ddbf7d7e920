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

/// The processes that write one file together. A program that never started MPI is one rank.
class Ranks {
 public:
  explicit Ranks(MPI_Comm communicator);

  [[nodiscard]] int rank() const { return rank_; }
  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] bool is_root() const { return rank_ == 0; }
  [[nodiscard]] bool is_parallel() const { return count_ > 1; }
  /// Returns the communicator that files are opened with; none if there is one process.
  [[nodiscard]] std::optional<MPI_Comm> communicator() const {
    return is_parallel() ? std::optional(communicator_) : std::nullopt;
  }

  /// One value of every rank, in their order. Collective.
  [[nodiscard]] std::vector<std::uint64_t> gather(std::uint64_t value) const;
  /// The rows of an array of which this rank holds so many, after those of the ranks before. Collective.
  [[nodiscard]] hdf5::Slab slab(std::uint64_t count) const;
  /// The text of one rank, the root, on every rank. Collective.
  [[nodiscard]] std::string broadcast(std::string text, int source = 0) const;
  /// Runs `work` on the root; if it throws there, every rank throws an error of the same kind and text. Collective.
  void on_root(const std::function<void()>& work) const;
  /// Runs `work`, which does not communicate, on every rank; if it throws on some, every rank throws an error of the kind
  /// and text of the first of them: none goes on and waits for the others. Collective.
  void on_all(const std::function<void()>& work) const;

 private:
  MPI_Comm communicator_;
  int rank_ = 0;
  int count_ = 1;
};

/// A file that the ranks write together: made, named at the end or given up by the root. Collective.
class SharedPartialFile {
 public:
  SharedPartialFile(const std::filesystem::path& target, const Ranks& ranks);

  /// Where all ranks write.
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Gives the file its name; of the root (`PartialFile::publish`).
  void publish(bool durable = false) { of_root_->publish(durable); }

 private:
  std::optional<PartialFile> of_root_;
  std::filesystem::path path_;
};

}  // namespace whipple::io
