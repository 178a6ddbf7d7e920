// SPDX-License-Identifier: BSD-3-Clause
#include "src/io/ranks.hpp"

#include <exception>
#include <new>
#include <numeric>

#include "src/core/base/error.hpp"
#include "src/core/base/resource_error.hpp"

namespace whipple::io {

Ranks::Ranks(MPI_Comm communicator) : communicator_(communicator) {
  int initialised = 0;
  int finalised = 0;
  MPI_Initialized(&initialised);
  MPI_Finalized(&finalised);
  if (initialised == 0 || finalised != 0) return;
  MPI_Comm_rank(communicator, &rank_);
  MPI_Comm_size(communicator, &count_);
}

std::vector<std::uint64_t> Ranks::gather(std::uint64_t value) const {
  std::vector<std::uint64_t> values(static_cast<std::size_t>(count_), value);
  if (is_parallel()) {
    MPI_Allgather(&value, 1, MPI_UINT64_T, values.data(), 1, MPI_UINT64_T, communicator_);
  }
  return values;
}

hdf5::Slab Ranks::slab(std::uint64_t count) const {
  const std::vector<std::uint64_t> counts = gather(count);
  return {std::accumulate(counts.begin(), counts.begin() + rank_, std::uint64_t{0}), count,
          std::accumulate(counts.begin(), counts.end(), std::uint64_t{0})};
}

std::string Ranks::broadcast(std::string text) const {
  if (!is_parallel()) return text;
  std::uint64_t length = text.size();
  MPI_Bcast(&length, 1, MPI_UINT64_T, 0, communicator_);
  text.resize(length);
  MPI_Bcast(text.data(), static_cast<int>(length), MPI_CHAR, 0, communicator_);
  return text;
}

void Ranks::on_root(const std::function<void()>& work) const {
  // The kind of error must survive the way to the other ranks: a first character tells an InputError and
  // exhausted memory from a defect.
  std::string outcome;
  if (is_root()) {
    try {
      work();
    } catch (const std::bad_alloc&) {
      outcome = "m";
    } catch (const std::exception& error) {
      const ExitCode code = exit_code(error);
      outcome = std::string(code == ExitCode::input   ? "i"
                            : code == ExitCode::state ? "s"
                                                      : "d") +
                error.what();
    }
  }
  outcome = broadcast(outcome);
  if (outcome.empty()) return;
  if (outcome[0] == 'i') throw InputError(outcome.substr(1));
  if (outcome[0] == 'm') throw std::bad_alloc();
  if (outcome[0] == 's') throw ResourceError(outcome.substr(1));
  throw InternalError(outcome.substr(1));
}

SharedPartialFile::SharedPartialFile(const std::filesystem::path& target, const Ranks& ranks) {
  ranks.on_root([&] { of_root_.emplace(target); });
  path_ = ranks.broadcast(ranks.is_root() ? of_root_->path().string() : std::string());
}

}  // namespace whipple::io
