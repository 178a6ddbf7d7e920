// SPDX-License-Identifier: BSD-3-Clause
// Attributes of groups and datasets.
#include <fmt/format.h>

#include "src/core/base/error.hpp"
#include "src/core/hdf5/calls.hpp"

namespace whipple::hdf5 {
namespace {

void write_attribute(const Object& object, const std::string& name, hid_t type, hid_t memory_type,
                     hid_t space, const void* value) {
  const std::string action = "write attribute " + name;
  const Handle attribute =
      checked(H5Acreate2(object.id(), name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
              object.name(), action);
  check(H5Awrite(attribute.get(), memory_type, value), object.name(), action);
}

Handle open_attribute(const Object& object, const std::string& name) {
  return checked(H5Aopen(object.id(), name.c_str(), H5P_DEFAULT), H5Aclose, object.name(),
                 "read attribute " + name);
}

void read_number(const Object& object, const std::string& name, H5T_class_t expected, hid_t memory_type,
                 void* value) {
  const Handle attribute = open_attribute(object, name);
  const std::string action = "read attribute " + name;
  const Handle type = checked(H5Aget_type(attribute.get()), H5Tclose, object.name(), action);
  const Handle space = checked(H5Aget_space(attribute.get()), H5Sclose, object.name(), action);
  if (H5Tget_class(type.get()) != expected || H5Sget_simple_extent_npoints(space.get()) != 1) {
    throw InputError(
        fmt::format("{}: attribute {} is not a single number of the expected kind", object.name(), name));
  }
  check(H5Aread(attribute.get(), memory_type, value), object.name(), action);
}

}  // namespace

void Object::set_attribute(const std::string& name, std::int64_t value) const {
  const Handle space = checked(H5Screate(H5S_SCALAR), H5Sclose, name_, "describe a number");
  write_attribute(*this, name, H5T_STD_I64LE, H5T_NATIVE_INT64, space.get(), &value);
}

void Object::set_attribute(const std::string& name, double value) const {
  const Handle space = checked(H5Screate(H5S_SCALAR), H5Sclose, name_, "describe a number");
  write_attribute(*this, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, space.get(), &value);
}

void Object::set_attribute(const std::string& name, std::span<const std::int64_t> values) const {
  const hsize_t size = values.size();
  const Handle space = checked(H5Screate_simple(1, &size, nullptr), H5Sclose, name_, "describe numbers");
  write_attribute(*this, name, H5T_STD_I64LE, H5T_NATIVE_INT64, space.get(), values.data());
}

void Object::set_attribute(const std::string& name, std::string_view text) const {
  const Handle type = checked(H5Tcopy(H5T_C_S1), H5Tclose, name_, "describe a text");
  check(H5Tset_size(type.get(), H5T_VARIABLE), name_, "describe a text");
  check(H5Tset_cset(type.get(), H5T_CSET_UTF8), name_, "describe a text");
  const Handle space = checked(H5Screate(H5S_SCALAR), H5Sclose, name_, "describe a text");
  const std::string terminated(text);
  const char* pointer = terminated.c_str();
  write_attribute(*this, name, type.get(), type.get(), space.get(), &pointer);
}

void Object::set_fixed_attribute(const std::string& name, std::string_view text,
                                 Characters characters) const {
  const std::string bytes = text.empty() ? std::string(1, '\0') : std::string(text);
  const Handle type = checked(H5Tcopy(H5T_C_S1), H5Tclose, name_, "describe a text");
  check(H5Tset_size(type.get(), bytes.size()), name_, "describe a text");
  check(H5Tset_cset(type.get(), characters == Characters::utf8 ? H5T_CSET_UTF8 : H5T_CSET_ASCII), name_,
        "describe a text");
  check(H5Tset_strpad(type.get(), H5T_STR_NULLPAD), name_, "describe a text");
  const Handle space = checked(H5Screate(H5S_SCALAR), H5Sclose, name_, "describe a text");
  write_attribute(*this, name, type.get(), type.get(), space.get(), bytes.data());
}

bool Object::has_attribute(const std::string& name) const {
  const htri_t found = H5Aexists(id(), name.c_str());
  if (found < 0) fail(name_, "look for attribute " + name);
  return found > 0;
}

std::vector<std::string> Object::attribute_names() const {
  std::vector<std::string> names;
  hsize_t index = 0;
  const auto add = [](hid_t, const char* name, const H5A_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  check(H5Aiterate2(id(), H5_INDEX_NAME, H5_ITER_NATIVE, &index, add, &names), name_, "list the attributes");
  std::ranges::sort(names);
  return names;
}

std::int64_t Object::integer_attribute(const std::string& name) const {
  std::int64_t value = 0;
  read_number(*this, name, H5T_INTEGER, H5T_NATIVE_INT64, &value);
  return value;
}

double Object::real_attribute(const std::string& name) const {
  double value = 0.0;
  read_number(*this, name, H5T_FLOAT, H5T_NATIVE_DOUBLE, &value);
  return value;
}

std::string Object::text_attribute(const std::string& name) const {
  const Handle attribute = open_attribute(*this, name);
  const std::string action = "read attribute " + name;
  const Handle type = checked(H5Aget_type(attribute.get()), H5Tclose, name_, action);
  if (H5Tget_class(type.get()) != H5T_STRING) {
    throw InputError(fmt::format("{}: attribute {} is not a text", name_, name));
  }
  if (H5Tis_variable_str(type.get()) != 0) {
    throw InputError(
        fmt::format("{}: attribute {} is a text of variable length, as earlier versions wrote it; expected "
                    "one of fixed length",
                    name_, name));
  }
  const std::size_t size = H5Tget_size(type.get());
  const Handle space = checked(H5Aget_space(attribute.get()), H5Sclose, name_, action);
  if (size > file_size(*this) || H5Sget_simple_extent_npoints(space.get()) != 1) {
    throw InputError(
        fmt::format("{}: attribute {} is not a single text that the file could hold", name_, name));
  }
  std::string text(size, '\0');
  check(H5Aread(attribute.get(), type.get(), text.data()), name_, action);
  return text.substr(0, text.find('\0'));
}

}  // namespace whipple::hdf5
