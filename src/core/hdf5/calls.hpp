// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "src/core/hdf5/hdf5.hpp"

/// Checked calls of the C interface, for use in this folder only.
namespace whipple::hdf5 {

/// Disables the error output of HDF5, of which only one of twenty lines is useful to users; `fail` keeps it.
void silence();

/// Throws InputError "WHERE: cannot ACTION: innermost HDF5 message".
[[noreturn]] void fail(const std::string& where, const std::string& action);

/// Takes ownership of an identifier. @throws InputError if HDF5 returned an invalid one
Handle checked(hid_t id, Handle::Close close, const std::string& where, const std::string& action);

/// Checks the status of an HDF5 call. @throws InputError if it failed
void check(herr_t status, const std::string& where, const std::string& action);

/// Creates the property list of a new object, without time stamps, so that equal content gives equal files.
Handle creation_properties(hid_t kind, const std::string& where);

/// Selects the rows of a slab in a file dataspace; returns the memory dataspace.
Handle select(hid_t space, const Slab& slab, std::uint64_t columns, bool one_dimensional,
              const std::string& where);

/// Returns the size (bytes) of the file that contains an object.
std::uint64_t file_size(const Object& object);

}  // namespace whipple::hdf5
