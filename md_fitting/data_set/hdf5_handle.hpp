// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <hdf5.h>

#include <string>
#include <utility>

#include "src/base/error.hpp"

namespace whipple::md {

/// Owns one HDF5 identifier and the function that closes it.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  /// @throws InputError with `what` if the identifier is not valid.
  Handle(hid_t id, Close function, const std::string& what) : id_(id), close_(function) {
    if (id_ < 0) throw InputError("HDF5: " + what);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }
  /// Closes now, so that a failure to write the last bytes is seen.
  void close_now(const std::string& what) {
    if (close_(std::exchange(id_, -1)) < 0) throw InputError("HDF5: " + what);
  }

 private:
  hid_t id_;
  Close close_;
};

/// Silences the library's own printing: every failure is reported by an exception instead.
class QuietHdf5 {
 public:
  QuietHdf5() {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  QuietHdf5(const QuietHdf5&) = delete;
  QuietHdf5& operator=(const QuietHdf5&) = delete;
  ~QuietHdf5() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

}  // namespace whipple::md
