// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/core/input/section.hpp"

/// Sections of a case file (src/core/input/section.hpp).
namespace whipple::cases {

struct Case;

using input::Faults;

template <class Owner>
using Section = input::Section<Owner, Case>;

/// Creates the entry of a member of a case or of one of its sections.
template <auto Member, class Owner = decltype(input::detail::owner_of(Member))>
Section<Owner> section(const char* name, const char* remark = "",
                       bool (*applies)(const std::type_identity_t<Owner>&) = nullptr) {
  return input::section<Member, Case>(name, remark, applies);
}

}  // namespace whipple::cases
