// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/base/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <random>
#include <system_error>

#include "src/core/base/error.hpp"
#include "src/core/base/text.hpp"

namespace whipple {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const char* action, int error) {
  throw InputError(fmt::format("{}: cannot {}: {}", path.string(), action, std::strerror(error)));
}

/// Writes all bytes. @returns the system error number, 0 on success
int write_all(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(file, text.data(), text.size());
    if (written < 0 && errno != EINTR) return errno;
    if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

enum class Durable { no, yes };

void write_text(const fs::path& opened, int flags, std::string_view text, const fs::path& named,
                Durable durable = Durable::no) {
  constexpr mode_t readable = 0666;
  const int file = ::open(opened.c_str(), O_WRONLY | O_CLOEXEC | flags, readable);
  if (file < 0) fail(named, "write the file", errno);
  int error = write_all(file, text);
  if (error == 0 && durable == Durable::yes && ::fsync(file) != 0) error = errno;
  if (::close(file) != 0 && error == 0) error = errno;
  if (error != 0) fail(named, "write the file", error);
}

/// Returns whether a path is that of an open descriptor of this process: /dev/stdout, /dev/fd/3.
bool names_a_descriptor(const fs::path& path) {
  std::error_code unknown;
  const fs::path descriptors = fs::canonical("/proc/self/fd", unknown);
  if (unknown) return false;
  const auto is_one = [&](const fs::path& name) {
    std::error_code ignored;
    return fs::canonical(name.parent_path(), ignored) == descriptors;
  };
  return is_one(path) || is_one(fs::read_symlink(path, unknown));
}

}  // namespace

bool lies_in(const fs::path& path, const fs::path& folder) {
  std::error_code unknown;
  const fs::path inside = fs::canonical(folder, unknown);
  if (unknown) return false;
  const fs::path place = fs::weakly_canonical(path, unknown);
  if (unknown) return false;
  return std::mismatch(inside.begin(), inside.end(), place.begin(), place.end()).first == inside.end();
}

const fs::path& regular_file(const fs::path& path, std::uintmax_t most) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  const auto refuse = [&](const std::string& why) {
    throw InputError(fmt::format("{}: error: {}", path.string(), why));
  };
  if (!fs::exists(status)) return path;
  if (!fs::is_regular_file(status)) refuse("is a folder, a device or a pipe, expected a regular file");
  const std::uintmax_t size = fs::file_size(path, error);
  if (!error && size > most) {
    refuse(fmt::format("has {}, but such files have at most {}", format_bytes(static_cast<double>(size)),
                       format_bytes(static_cast<double>(most))));
  }
  return path;
}

std::string read_text(const fs::path& path, std::uintmax_t most) {
  const auto refuse = [&](const std::string& why) {
    throw InputError(fmt::format("{}: error: {}", path.string(), why));
  };
  const int file = ::open(regular_file(path, most).c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) {
    refuse(errno == ENOENT ? "there is no such file"
                           : fmt::format("cannot open the file: {}", std::strerror(errno)));
  }
  std::string text;
  int error = 0;
  for (std::string piece(std::size_t{1} << 16, '\0');;) {
    const ssize_t count = ::read(file, piece.data(), piece.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) error = errno;
    if (count <= 0) break;
    text.append(piece, 0, static_cast<std::size_t>(count));
  }
  ::close(file);
  if (error != 0) refuse(fmt::format("cannot read the file: {}", std::strerror(error)));
  return text;
}

void require_new_file(const fs::path& path, bool force) {
  if (!path.empty() && fs::exists(path) && !force) {
    throw InputError(fmt::format("'{}' exists; --force overwrites it", path.string()));
  }
}

void require_new_figure(const fs::path& path, bool force) {
  const std::string ending = path.extension().string();
  if (!path.empty() && ending != ".png" && ending != ".pdf" && ending != ".svg") {
    throw InputError(fmt::format("'{}': a figure ends in .png, .pdf or .svg", path.string()));
  }
  require_new_file(path, force);
}

void require_folder(const fs::path& path) {
  require_no_file(path);
  std::error_code ignored;
  if (!fs::exists(path, ignored))
    throw InputError(fmt::format("{}: error: there is no such folder", path.string()));
}

void require_no_file(const fs::path& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (fs::exists(status) && !fs::is_directory(status))
    throw InputError(fmt::format("{}: error: is not a folder", path.string()));
}

void make_folder(const fs::path& path) {
  require_no_file(path);
  std::error_code error;
  fs::create_directories(path, error);
  if (error) fail(path, "make the folder", error.value());
}

PartialFile::PartialFile(fs::path target) : target_(std::move(target)) {
  std::random_device random;
  int file = -1;
  do {
    path_ = fmt::format("{}.{:08x}.partial", target_.string(), random());
    file = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  } while (file < 0 && errno == EEXIST);
  if (file < 0) fail(target_, "write the file", errno);
  ::close(file);
}

PartialFile::~PartialFile() {
  if (!published_) ::unlink(path_.c_str());
}

void PartialFile::publish(bool durable) {
  if (durable) {
    const int file = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) fail(target_, "open the file", errno);
    const int synced = ::fsync(file);
    const int error = errno;
    ::close(file);
    if (synced != 0) fail(target_, "force the file to disk", error);
  }
  if (::rename(path_.c_str(), target_.c_str()) != 0) fail(target_, "name the file", errno);
  published_ = true;
  if (!durable) return;
  const fs::path folder = target_.has_parent_path() ? target_.parent_path() : fs::path(".");
  const int opened = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (opened < 0) return;  // the file has been renamed even on file systems without folder handles
  ::fsync(opened);
  ::close(opened);
}

void replace_durably(const fs::path& path, const fs::path& copy, std::string_view bytes) {
  ::unlink(copy.c_str());  // left by a killed writer, or a link created by others
  try {
    write_text(copy, O_CREAT | O_EXCL | O_NOFOLLOW, bytes, path, Durable::yes);
    if (::rename(copy.c_str(), path.c_str()) != 0) fail(path, "name the file", errno);
  } catch (const InputError&) {
    ::unlink(copy.c_str());
    throw;
  }
}

void append_text(const fs::path& path, std::string_view text) {
  write_text(path, O_CREAT | O_APPEND, text, path);
}

void write_text_atomically(const fs::path& path, std::string_view text) {
  std::error_code ignored;
  // A device has no former content; a descriptor may be of a file, behind whose content the text belongs.
  if (fs::is_other(fs::status(path, ignored)) || names_a_descriptor(path))
    return write_text(path, O_APPEND, text, path);
  PartialFile partial(path);
  write_text(partial.path(), O_NOFOLLOW, text, path);
  partial.publish();
}

}  // namespace whipple
