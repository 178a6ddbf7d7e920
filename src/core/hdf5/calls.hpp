// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "src/core/hdf5/hdf5.hpp"

/// Calls of the C interface with their checks: for this folder alone.
namespace whipple::hdf5 {

/// Stops HDF5 from printing: its twenty lines on standard error hold one that a user can use, which `fail` keeps.
void silence();

/// Throws InputError "WHERE: cannot ACTION: the innermost message of HDF5".
[[noreturn]] void fail(const std::string& where, const std::string& action);

/// Takes an identifier into ownership. @throws InputError if HDF5 returned none
Handle checked(hid_t id, Handle::Close close, const std::string& where, const std::string& action);

/// @throws InputError if a call of HDF5 has failed
void check(herr_t status, const std::string& where, const std::string& action);

/// Makes the properties of a new object, without time stamps: equal content shall give equal files.
Handle creation_properties(hid_t kind, const std::string& where);

/// Selects the rows of a slab in a file space; returns the space of the memory.
Handle select(hid_t space, const Slab& slab, std::uint64_t columns, bool one_dimensional,
              const std::string& where);

/// Returns the size (bytes) of the file that an object is in.
std::uint64_t file_size(const Object& object);

}  // namespace whipple::hdf5
