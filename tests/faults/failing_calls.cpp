// SPDX-License-Identifier: BSD-3-Clause
// A library to be loaded before all others (LD_PRELOAD): one call to the system fails, as on a disk that is full, broken
// or gone. Environment variables:
//   FAULT_CALL    kind: open (to write) open_to_read write read sync close rename truncate remove folder lock
//   FAULT_PATH    part of the path of the files that count
//   FAULT_NUMBER  which of these calls of a process fails, from 1; 0: none
//   FAULT_ERRNO   with which number of an error; 0: half of a transfer is made
//   FAULT_LASTS   set: all later ones, too
//   FAULT_RANK    the rank of MPI that it meets; unset: any process
//   FAULT_COUNTS  file to which each process adds the number of its calls of the kind
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/sendfile.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

struct Plan {
  const char* call = std::getenv("FAULT_CALL");
  const char* path = std::getenv("FAULT_PATH");
  const char* counts = std::getenv("FAULT_COUNTS");
  long number = number_of("FAULT_NUMBER");
  int error = static_cast<int>(number_of("FAULT_ERRNO"));
  bool lasts = std::getenv("FAULT_LASTS") != nullptr;

  Plan() {
    const char *rank = std::getenv("FAULT_RANK"), *own = std::getenv("OMPI_COMM_WORLD_RANK");
    if (rank != nullptr && (own == nullptr || std::strcmp(rank, own) != 0)) number = 0;
  }
  static long number_of(const char* name) {
    const char* text = std::getenv(name);
    return text == nullptr ? 0 : std::atol(text);
  }
};

const Plan& plan() {
  static const Plan plan;
  return plan;
}

std::atomic<long> calls = 0;

template <class Function>
Function next(Function /*own*/, const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

enum class Fate { passes, fails, is_cut };

/// Counts a call of a kind for a path; sets errno if it fails.
Fate fate(const char* kind, const char* path) {
  if (plan().call == nullptr || std::strcmp(plan().call, kind) != 0 || path == nullptr) return Fate::passes;
  if (plan().path != nullptr && std::strstr(path, plan().path) == nullptr) return Fate::passes;
  const long call = ++calls;
  const bool hit = plan().number > 0 && (plan().lasts ? call >= plan().number : call == plan().number);
  if (!hit) return Fate::passes;
  if (plan().error == 0) return Fate::is_cut;
  errno = plan().error;
  return Fate::fails;
}

/// The same for a file that is open; what is none (pipes, terminals) passes.
Fate fate(const char* kind, int file) {
  if (plan().call == nullptr || std::strcmp(plan().call, kind) != 0) return Fate::passes;
  char link[64], path[4096];
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", file);
  const int before = errno;
  const ssize_t size = readlink(link, path, sizeof path - 1);
  errno = before;
  if (size <= 0 || path[0] != '/' || std::strncmp(path, "/dev/", 5) == 0 ||
      std::strncmp(path, "/proc/", 6) == 0)
    return Fate::passes;
  path[size] = '\0';
  return fate(kind, path);
}

/// Of a transfer: the number of bytes that are to be moved, or -1 if it fails.
ssize_t size_of(Fate fate, std::size_t size) {
  if (fate == Fate::fails) return -1;
  return static_cast<ssize_t>(fate == Fate::is_cut && size > 1 ? size / 2 : size);
}

const char* kind_of_open(int flags) { return (flags & O_ACCMODE) == O_RDONLY ? "open_to_read" : "open"; }

struct AtExit {
  ~AtExit() {
    if (plan().counts == nullptr || calls == 0) return;
    const auto open_file = next(static_cast<int (*)(const char*, int, ...)>(nullptr), "open");
    const auto write_file = next(static_cast<ssize_t (*)(int, const void*, size_t)>(nullptr), "write");
    const int file = open_file(plan().counts, O_WRONLY | O_CREAT | O_APPEND, 0644);
    char text[32];
    const int size = std::snprintf(text, sizeof text, "%ld\n", calls.load());
    static_cast<void>(!write_file(file, text, static_cast<size_t>(size)));
  }
} at_exit;

}  // namespace

#define NEXT(name) static const auto real = next(&name, #name)
#define TRANSFER(kind, name, file, size, ...)           \
  NEXT(name);                                           \
  const ssize_t part = size_of(fate(kind, file), size); \
  return part < 0 ? -1 : real(__VA_ARGS__)
#define WHOLE(kind, name, where, ...) \
  NEXT(name);                         \
  return fate(kind, where) == Fate::passes ? real(__VA_ARGS__) : -1
#define OPEN(name, kind, path, flags, ...)                              \
  NEXT(name);                                                           \
  mode_t mode = 0;                                                      \
  if (((flags) & O_CREAT) != 0 || ((flags) & O_TMPFILE) == O_TMPFILE) { \
    va_list more;                                                       \
    va_start(more, flags);                                              \
    mode = va_arg(more, mode_t);                                        \
    va_end(more);                                                       \
  }                                                                     \
  return fate(kind, path) == Fate::passes ? real(__VA_ARGS__, mode) : -1
#define STREAM(name, path, mode)                                 \
  NEXT(name);                                                    \
  const char* kind = (mode)[0] == 'r' ? "open_to_read" : "open"; \
  return fate(kind, path) == Fate::passes ? real(path, mode) : nullptr

extern "C" {

ssize_t write(int file, const void* data, size_t size) {
  TRANSFER("write", write, file, size, file, data, static_cast<size_t>(part));
}
ssize_t pwrite(int file, const void* data, size_t size, off_t at) {
  TRANSFER("write", pwrite, file, size, file, data, static_cast<size_t>(part), at);
}
ssize_t pwrite64(int file, const void* data, size_t size, off64_t at) {
  TRANSFER("write", pwrite64, file, size, file, data, static_cast<size_t>(part), at);
}
ssize_t writev(int file, const iovec* list, int count) {
  TRANSFER("write", writev, file, static_cast<size_t>(count), file, list, static_cast<int>(part));
}
ssize_t pwritev(int file, const iovec* list, int count, off_t at) {
  TRANSFER("write", pwritev, file, static_cast<size_t>(count), file, list, static_cast<int>(part), at);
}
ssize_t pwritev64(int file, const iovec* list, int count, off64_t at) {
  TRANSFER("write", pwritev64, file, static_cast<size_t>(count), file, list, static_cast<int>(part), at);
}
ssize_t sendfile(int to, int from, off_t* at, size_t size) {
  TRANSFER("write", sendfile, to, size, to, from, at, static_cast<size_t>(part));
}
ssize_t copy_file_range(int from, off64_t* at, int to, off64_t* to_at, size_t size, unsigned flags) {
  TRANSFER("write", copy_file_range, to, size, from, at, to, to_at, static_cast<size_t>(part), flags);
}
ssize_t read(int file, void* data, size_t size) {
  TRANSFER("read", read, file, size, file, data, static_cast<size_t>(part));
}
ssize_t pread(int file, void* data, size_t size, off_t at) {
  TRANSFER("read", pread, file, size, file, data, static_cast<size_t>(part), at);
}
ssize_t pread64(int file, void* data, size_t size, off64_t at) {
  TRANSFER("read", pread64, file, size, file, data, static_cast<size_t>(part), at);
}
ssize_t readv(int file, const iovec* list, int count) {
  TRANSFER("read", readv, file, static_cast<size_t>(count), file, list, static_cast<int>(part));
}
ssize_t preadv(int file, const iovec* list, int count, off_t at) {
  TRANSFER("read", preadv, file, static_cast<size_t>(count), file, list, static_cast<int>(part), at);
}
ssize_t preadv64(int file, const iovec* list, int count, off64_t at) {
  TRANSFER("read", preadv64, file, static_cast<size_t>(count), file, list, static_cast<int>(part), at);
}

int fsync(int file) { WHOLE("sync", fsync, file, file); }
int fdatasync(int file) { WHOLE("sync", fdatasync, file, file); }
int ftruncate(int file, off_t size) { WHOLE("truncate", ftruncate, file, file, size); }
int ftruncate64(int file, off64_t size) { WHOLE("truncate", ftruncate64, file, file, size); }
int truncate(const char* path, off_t size) { WHOLE("truncate", truncate, path, path, size); }
int fallocate(int file, int mode, off_t at, off_t size) {
  WHOLE("truncate", fallocate, file, file, mode, at, size);
}
int rename(const char* from, const char* to) { WHOLE("rename", rename, to, from, to); }
int unlink(const char* path) { WHOLE("remove", unlink, path, path); }
int mkdir(const char* path, mode_t mode) { WHOLE("folder", mkdir, path, path, mode); }
int flock(int file, int operation) { WHOLE("lock", flock, file, file, operation); }
/// The file is closed all the same, as by the kernel.
int close(int file) {
  NEXT(close);
  const bool fails = file > 2 && fate("close", file) != Fate::passes;
  const int error = errno, result = real(file);
  if (!fails) return result;
  errno = error;
  return -1;
}

int open(const char* path, int flags, ...) { OPEN(open, kind_of_open(flags), path, flags, path, flags); }
int open64(const char* path, int flags, ...) { OPEN(open64, kind_of_open(flags), path, flags, path, flags); }
int openat(int folder, const char* path, int flags, ...) {
  OPEN(openat, kind_of_open(flags), path, flags, folder, path, flags);
}
int openat64(int folder, const char* path, int flags, ...) {
  OPEN(openat64, kind_of_open(flags), path, flags, folder, path, flags);
}
FILE* fopen(const char* path, const char* mode) { STREAM(fopen, path, mode); }
FILE* fopen64(const char* path, const char* mode) { STREAM(fopen64, path, mode); }

}  // extern "C"
