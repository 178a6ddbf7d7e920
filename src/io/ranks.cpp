// SPDX-License-Identifier: BSD-3-Clause
#include "src/io/ranks.hpp"

#include <algorithm>
#include <exception>
#include <new>
#include <numeric>

#include "src/core/base/error.hpp"
#include "src/core/base/resource_error.hpp"

namespace whipple::io {
namespace {

/// Runs `work`.
/// @returns an empty text, or the exception as text with its kind as first character, which is preserved on other ranks
std::string outcome_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const std::bad_alloc&) {
    return "m";
  } catch (const StateError& error) {
    return std::string("s") + error.what();
  } catch (const ResourceError& error) {
    return std::string("r") + error.what();
  } catch (const std::exception& error) {
    return (exit_code(error) == ExitCode::input ? "i" : "d") + std::string(error.what());
  }
  return {};
}

/// Throws the exception that an outcome describes.
void rethrow(const std::string& outcome) {
  if (outcome.empty()) return;
  const std::string text = outcome.substr(1);
  switch (outcome[0]) {
    case 'i':
      throw InputError(text);
    case 'm':
      throw std::bad_alloc();
    case 's':
      throw StateError(text);
    case 'r':
      throw ResourceError(text);
    default:
      throw InternalError(text);
  }
}

}  // namespace

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

std::string Ranks::broadcast(std::string text, int source) const {
  if (!is_parallel()) return text;
  std::uint64_t length = text.size();
  MPI_Bcast(&length, 1, MPI_UINT64_T, source, communicator_);
  text.resize(length);
  MPI_Bcast(text.data(), static_cast<int>(length), MPI_CHAR, source, communicator_);
  return text;
}

void Ranks::on_root(const std::function<void()>& work) const {
  rethrow(broadcast(is_root() ? outcome_of(work) : std::string()));
}

void Ranks::on_all(const std::function<void()>& work) const {
  const std::string outcome = outcome_of(work);
  const std::vector<std::uint64_t> failed = gather(outcome.empty() ? 0 : 1);
  const auto first = std::ranges::find(failed, 1U);
  if (first != failed.end()) rethrow(broadcast(outcome, static_cast<int>(first - failed.begin())));
}

SharedPartialFile::SharedPartialFile(const std::filesystem::path& target, const Ranks& ranks) {
  ranks.on_root([&] { of_root_.emplace(target); });
  path_ = ranks.broadcast(ranks.is_root() ? of_root_->path().string() : std::string());
}

}  // namespace whipple::io
