// SPDX-License-Identifier: BSD-3-Clause
#include "src/io/run_directory.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <regex>
#include <sstream>
#include <system_error>
#include <vector>

#include "src/base/error.hpp"
#include "src/base/text.hpp"

namespace whipple::io {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& action, int error) {
  throw InputError(fmt::format("{}: cannot {}: {}", path.string(), action, std::strerror(error)));
}

/// What a run writes into its folder; everything else there belongs to the user.
const std::regex& own_outputs() {
  static const std::regex names(R"((run\.toml|history\.csv|gauges\.csv|log\.txt|profile\.json)(\.partial)?)"
                                R"(|.+\.(particles|elements)\.hdf\.series(\.partial)?)"
                                R"(|.+\.(particles|elements)\.[0-9]{6,}\.hdf(\.partial)?)");
  return names;
}
const std::regex& own_checkpoints() {
  static const std::regex names(R"(checkpoint\.[0-9]{8,}\.h5(\.partial)?)");
  return names;
}

void remove_matching(const fs::path& folder, const std::regex& names) {
  std::vector<fs::path> outputs;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && std::regex_match(entry.path().filename().string(), names)) {
      outputs.push_back(entry.path());
    }
  }
  for (const fs::path& output : outputs) {
    std::error_code error;
    fs::remove(output, error);
    if (error) fail(output, "remove the output of an earlier run", error.value());
  }
}

/// Permission bits do not tell the whole story (read-only file systems, quotas): write something.
void require_writable(const fs::path& folder) {
  const fs::path probe = folder / fmt::format(".writable.{}.partial", ::getpid());
  const int file = ::open(probe.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (file < 0) fail(folder, "write into the folder", errno);
  ::close(file);
  ::unlink(probe.c_str());
}

}  // namespace

void write_text_atomically(const fs::path& path, std::string_view text) {
  const fs::path partial = path.string() + ".partial";
  const int file = ::open(partial.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0) fail(partial, "write the file", errno);
  while (!text.empty()) {
    const ssize_t written = ::write(file, text.data(), text.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      const int error = errno;
      ::close(file);
      ::unlink(partial.c_str());
      fail(path, "write the file", error);
    }
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  if (::close(file) != 0) fail(path, "write the file", errno);
  if (::rename(partial.c_str(), path.c_str()) != 0) {
    const int error = errno;
    ::unlink(partial.c_str());
    fail(path, "replace the file", error);
  }
}

std::string read_text(const fs::path& path) {
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) fail(path, "read the file", errno == 0 ? ENOENT : errno);
  std::ostringstream text;
  text << stream.rdbuf();
  if (stream.bad() || fs::is_directory(path)) fail(path, "read the file", errno == 0 ? EIO : errno);
  return std::move(text).str();
}

RunDirectory RunDirectory::create(const fs::path& path, const std::string& name, bool force) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::exists(status) && !fs::is_directory(status)) {
    throw InputError(fmt::format("{}: is not a folder; the results of a run need one", path.string()));
  }
  if (fs::exists(status)) {
    const bool empty = fs::is_empty(path, error);
    if (error) fail(path, "read the folder", error.value());
    if (!empty && !force) {
      throw InputError(fmt::format(
          "{}: the folder is not empty; choose another with -o, replace the results in it with --force, or "
          "go on with the run in it with --restart",
          path.string()));
    }
  } else {
    fs::create_directories(path, error);
    if (error) fail(path, "make the folder", error.value());
  }
  require_writable(path);
  RunDirectory directory(path, name);
  remove_matching(path, own_outputs());
  if (fs::is_directory(directory.checkpoint_folder())) {
    remove_matching(directory.checkpoint_folder(), own_checkpoints());
  } else {
    fs::create_directory(directory.checkpoint_folder(), error);
    if (error) fail(directory.checkpoint_folder(), "make the folder", error.value());
  }
  if (fs::is_directory(directory.failed_folder())) {
    remove_matching(directory.failed_folder(), own_checkpoints());
    fs::remove(directory.failed_folder(), error);  // stays if it holds something else
  }
  return directory;
}

RunDirectory RunDirectory::open(const fs::path& path, const std::string& name) {
  if (!fs::is_directory(path)) throw InputError(fmt::format("{}: there is no such folder", path.string()));
  if (!fs::is_regular_file(path / "run.toml")) {
    throw InputError(fmt::format("{}: is not the folder of a run: it holds no run.toml", path.string()));
  }
  require_writable(path);
  return {path, name};
}

void RunDirectory::require_free_space(std::uint64_t bytes) const {
  std::error_code error;
  const fs::space_info space = fs::space(path_, error);
  if (error) fail(path_, "ask for free space", error.value());
  if (space.available < bytes) {
    throw InputError(fmt::format("{}: needs about {}, but the disk has {} left", path_.string(),
                                 format_bytes(static_cast<double>(bytes)),
                                 format_bytes(static_cast<double>(space.available))));
  }
}

}  // namespace whipple::io
