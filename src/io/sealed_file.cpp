// SPDX-License-Identifier: BSD-3-Clause
#include "src/io/sealed_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "src/core/base/error.hpp"

namespace whipple::io {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& action) {
  throw InputError(fmt::format("{}: cannot {}: {}", path.string(), action, std::strerror(errno)));
}

/// Computes a 64-bit digest of a stream of bytes, eight at a time, after FNV-1a (Fowler, Noll, Vo): exclusive or, then
/// multiplication by the FNV prime, here followed by a shift that propagates high bits to low ones. Every step is a
/// bijection of the state; hence a change of any single word always changes the digest.
class Digest {
 public:
  void add(const char* bytes, std::size_t size) {
    for (; size >= sizeof(std::uint64_t); size -= sizeof(std::uint64_t), bytes += sizeof(std::uint64_t)) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes, sizeof word);
      mix(word);
    }
    if (size > 0) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes, size);
      mix(word);
    }
  }
  [[nodiscard]] std::uint64_t value() const { return state_; }

 private:
  void mix(std::uint64_t word) {
    state_ = (state_ ^ word) * 0x100000001b3ULL;
    state_ ^= state_ >> 32;
  }
  std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

/// Computes the digest of all bytes after the seal.
std::uint64_t digest_of(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(seal_size));
  Digest digest;
  std::vector<char> buffer(std::size_t{1} << 20);  // a multiple of the word: only the last piece may be odd
  while (stream) {
    stream.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    digest.add(buffer.data(), static_cast<std::size_t>(stream.gcount()));
  }
  if (!stream.eof()) fail(path, "read the file");
  return digest.value();
}

std::array<char, seal_size> seal_text(int format, std::uint64_t size, std::uint64_t digest) {
  std::array<char, seal_size> text{};
  fmt::format_to_n(text.data(), text.size(), "whipple checkpoint\nformat {}\nbytes {}\ndigest {:016x}\n",
                   format, size, digest);
  return text;
}

}  // namespace

void seal(const fs::path& path) {
  const std::array<char, seal_size> text = seal_text(checkpoint_format, fs::file_size(path), digest_of(path));
  std::fstream stream(path, std::ios::binary | std::ios::in | std::ios::out);
  stream.write(text.data(), text.size());
  stream.close();
  if (!stream) fail(path, "seal the file");
}

void require_seal(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) fail(path, "read the file");
  std::array<char, seal_size> found{};
  stream.read(found.data(), found.size());
  int format = 0;
  unsigned long long size = 0;
  unsigned long long digest = 0;
  const std::string head(found.data(), found.size());
  if (std::sscanf(head.c_str(), "whipple checkpoint\nformat %d\nbytes %llu\ndigest %llx\n", &format, &size,
                  &digest) != 3) {
    throw InputError(fmt::format("{}: is not a checkpoint, or its first bytes are damaged", path.string()));
  }
  if (format != checkpoint_format) {
    throw InputError(fmt::format("{}: checkpoint of format {}; this program reads format {}", path.string(),
                                 format, checkpoint_format));
  }
  const std::uint64_t present = fs::file_size(path);
  if (present != size) {
    throw InputError(fmt::format("{}: {}: has {} bytes of {}", path.string(),
                                 present < size ? "truncated" : "damaged", present, size));
  }
  if (found != seal_text(format, size, digest) || digest_of(path) != digest) {
    throw InputError(fmt::format("{}: damaged: the content does not match its digest", path.string()));
  }
}

void force_to_disk(const fs::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) fail(path, "open the file");
  const int synced = ::fsync(file);
  ::close(file);
  if (synced != 0) fail(path, "force the file to disk");
}

}  // namespace whipple::io
