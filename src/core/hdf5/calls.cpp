// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/hdf5/calls.hpp"

#include <fmt/format.h>

#include <string_view>

#include "src/core/base/error.hpp"

namespace whipple::hdf5 {
namespace {

herr_t keep_innermost(unsigned, const H5E_error2_t* error, void* text) {
  if (error->desc != nullptr && error->desc[0] != '\0') *static_cast<std::string*>(text) = error->desc;
  return 0;
}

}  // namespace

void silence() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

void fail(const std::string& where, const std::string& action) {
  std::string innermost;
  // Walking downward begins with the called function and ends with the one that failed.
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, keep_innermost, &innermost);
  H5Eclear2(H5E_DEFAULT);
  // "file write failed: time = ..., errno = 28, error message = 'No space left on device', buf = ...": only the system
  // message is useful.
  constexpr std::string_view key = "error message = '";
  if (const std::size_t at = innermost.find(key); at != std::string::npos) {
    const std::size_t begin = at + key.size();
    innermost = innermost.substr(begin, innermost.find('\'', begin) - begin);
  }
  throw InputError(fmt::format("{}: cannot {}{}", where, action, innermost.empty() ? "" : ": " + innermost));
}

Handle checked(hid_t id, Handle::Close close, const std::string& where, const std::string& action) {
  if (id < 0) fail(where, action);
  return {id, close};
}

void check(herr_t status, const std::string& where, const std::string& action) {
  if (status < 0) fail(where, action);
}

Handle creation_properties(hid_t kind, const std::string& where) {
  Handle properties = checked(H5Pcreate(kind), H5Pclose, where, "prepare an object");
  check(H5Pset_obj_track_times(properties.get(), false), where, "prepare an object");
  return properties;
}

Handle select(hid_t space, const Slab& slab, std::uint64_t columns, bool one_dimensional,
              const std::string& where) {
  const hsize_t start[2] = {slab.first, 0};
  const hsize_t count[2] = {slab.count, one_dimensional ? 1 : columns};
  const int dimensions = one_dimensional ? 1 : 2;
  Handle memory = checked(H5Screate_simple(dimensions, count, nullptr), H5Sclose, where, "describe memory");
  if (slab.count == 0) {
    check(H5Sselect_none(space), where, "select nothing");
    check(H5Sselect_none(memory.get()), where, "select nothing");
  } else {
    check(H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, count, nullptr), where,
          fmt::format("select rows {} to {}", slab.first, slab.first + slab.count));
  }
  return memory;
}

std::uint64_t file_size(const Object& object) {
  const Handle file = checked(H5Iget_file_id(object.id()), H5Fclose, object.name(), "find the file");
  hsize_t size = 0;
  check(H5Fget_filesize(file.get(), &size), object.name(), "ask for the size of the file");
  return size;
}

}  // namespace whipple::hdf5
