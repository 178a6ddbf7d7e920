// SPDX-License-Identifier: BSD-3-Clause
#include "src/io/run_directory.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <sstream>
#include <system_error>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/base/pattern.hpp"
#include "src/core/base/text.hpp"

namespace whipple::io {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& action, int error) {
  throw InputError(fmt::format("{}: cannot {}: {}", path.string(), action, std::strerror(error)));
}

/// Returns the pattern of files that a run writes into its folder, including the temporary names of `PartialFile`; all
/// other files there belong to the user.
Pattern own(const std::string& names) { return Pattern("(" + names + R"()((\.[0-9a-f]{8})?\.partial)?)"); }
const Pattern& own_outputs() {
  static const Pattern names =
      own(R"((run\.toml|(history|gauges|steering)\.csv|log\.txt|(profile|status|columns)\.json))"
          R"(|.+\.(particles|elements)\.(hdf\.series|[0-9]{6,}\.hdf))");
  return names;
}
const Pattern& own_checkpoints() {
  static const Pattern names = own(R"(checkpoint\.[0-9]{8,}\.h5)");
  return names;
}
/// Returns the pattern of pending requests.
const Pattern& own_requests() {
  static const Pattern names = own(R"(.+\.toml(\.taken)?)");
  return names;
}
/// Returns the pattern of material copies; only those left incomplete by a killed run are removed.
const Pattern& own_materials() {
  static const Pattern names = own(R"(.+\.toml)");
  return names;
}

enum class Which { all, partial };

/// Removes matching files. Links are removed, not their targets.
void remove_matching(const fs::path& folder, const Pattern& names, Which which = Which::all) {
  std::vector<fs::path> outputs;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if ((entry.is_regular_file() || entry.is_symlink()) && names.matches(name) &&
        (which == Which::all || name.ends_with(".partial"))) {
      outputs.push_back(entry.path());
    }
  }
  for (const fs::path& output : outputs) {
    std::error_code error;
    fs::remove(output, error);
    if (error) fail(output, "remove the output of an earlier run", error.value());
  }
}

/// Checks that a folder is not a link, so that nothing is removed elsewhere.
void require_own_folder(const fs::path& folder) {
  if (!fs::is_symlink(folder)) return;
  throw InputError(fmt::format("{}: is a symbolic link; --force removes nothing behind one: remove the link",
                               folder.string()));
}

constexpr const char* lock_name = ".lock";

bool holds_anything(const fs::path& folder) {
  return std::ranges::any_of(fs::directory_iterator(folder), [](const fs::directory_entry& entry) {
    return entry.path().filename() != lock_name;
  });
}

/// Checks that files can be written, by writing one: permission bits do not reveal read-only file systems or
/// quotas.
void require_writable(const fs::path& folder) {
  const fs::path probe = folder / fmt::format(".writable.{}.partial", ::getpid());
  const int file = ::open(probe.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (file < 0) fail(folder, "write into the folder", errno);
  ::close(file);
  ::unlink(probe.c_str());
}

}  // namespace

std::shared_ptr<const FileLock> lock_run(const fs::path& path) {
  require_folder(path);
  return std::make_shared<const FileLock>(
      path / lock_name, fmt::format("the run directory {}", path.string()), FileLock::IfHeld::refuse);
}

bool is_running(const fs::path& path) {
  const int lock = ::open((path / lock_name).c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
  if (lock < 0) return false;
  const bool is_held =
      ::flock(lock, LOCK_SH | LOCK_NB) != 0;  // or the file system has no locks: the file decides
  ::close(lock);
  return is_held;
}

RunDirectory RunDirectory::create(const fs::path& path, const std::string& name, bool force) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::exists(status) && !fs::is_directory(status)) {
    throw InputError(fmt::format("{}: is not a folder; the results of a run need one", path.string()));
  }
  fs::create_directories(path, error);
  if (error) fail(path, "make the folder", error.value());
  RunDirectory directory(path, name);
  const auto require_empty = [&] {
    if (force || !holds_anything(path)) return;
    throw InputError(fmt::format(
        "{}: the folder is not empty; choose another with -o, replace the results in it with --force, or "
        "resume the run in it with --restart",
        path.string()));
  };
  require_empty();
  require_own_folder(directory.checkpoint_folder());
  require_own_folder(directory.failed_folder());
  require_own_folder(directory.control_folder());
  require_writable(path);
  directory.lock_ = lock_run(path);
  require_empty();  // fails if another run was faster
  remove_matching(path, own_outputs());
  if (fs::is_directory(directory.checkpoint_folder())) {
    remove_matching(directory.checkpoint_folder(), own_checkpoints());
  } else {
    fs::create_directory(directory.checkpoint_folder(), error);
    if (error) fail(directory.checkpoint_folder(), "make the folder", error.value());
  }
  if (fs::is_directory(directory.control_folder()))
    remove_matching(directory.control_folder(), own_requests());
  if (fs::is_directory(directory.failed_folder())) {
    remove_matching(directory.failed_folder(), own_checkpoints());
    fs::remove(directory.failed_folder(), error);  // kept if it contains other files
  }
  return directory;
}

RunDirectory RunDirectory::open(const fs::path& path, const std::string& name) {
  require_folder(path);
  if (!fs::is_regular_file(path / "run.toml")) {
    throw InputError(fmt::format("{}: is not the folder of a run: it contains no run.toml", path.string()));
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(path)) {
    if (entry.is_symlink() && own_outputs().matches(entry.path().filename().string()))
      throw InputError(
          fmt::format("{}: is a symbolic link; a run writes into its own folder alone: put the file there",
                      entry.path().string()));
  }
  require_writable(path);
  return {path, name};
}

void RunDirectory::remove_partial_files() const {
  remove_matching(path_, own_outputs(), Which::partial);
  for (const auto& [folder, names] :
       {std::pair(checkpoint_folder(), own_checkpoints()), std::pair(failed_folder(), own_checkpoints()),
        std::pair(control_folder(), own_requests()), std::pair(path_ / "materials", own_materials())}) {
    if (fs::is_directory(fs::symlink_status(folder))) remove_matching(folder, names, Which::partial);
  }
}

void RunDirectory::require_free_space(std::uint64_t bytes) const {
  std::error_code error;
  const fs::space_info space = fs::space(path_, error);
  if (error) fail(path_, "determine the free space", error.value());
  if (space.available < bytes) {
    throw InputError(fmt::format(
        "{}: needs about {} for checkpoints, but the disk has {} left: make room, then repeat a new "
        "run with --force",
        path_.string(), format_bytes(static_cast<double>(bytes)),
        format_bytes(static_cast<double>(space.available))));
  }
}

}  // namespace whipple::io
