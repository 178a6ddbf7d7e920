// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "src/core/base/parameter_table.hpp"
#include "src/core/input/document.hpp"
#include "src/core/input/faults.hpp"
#include "src/core/input/schema.hpp"

/// Registry of the sections of an input: a case file, a plan. `Root` is the object of the whole input. The type of a
/// section has
///   static ParameterTable<T> parameters();
/// and may have
///   static constexpr bool required = true;                    the section is required
///   static std::span<const Section<T, Root>> sections();      sub-sections
///   void read_rest(Table&);                                   content not covered by the parameter table
///   std::string rest_to_toml() const;                         the same in written form, lines below the keys
///   static void add_rest(Schema&);                            the same for the schema
///   void check(const Root&, const Faults&) const;             consistency of its keys with each other and the root
///   static const T& inherited(const Root&);                   values of missing keys, if it is optional
/// A section is then one line `section<&Owner::member, Root>("name")` in the list of its owner.
namespace whipple::input {

/// Describes how one section of an owner is read, checked, written, described and added to a schema, independent of its
/// type.
template <class Owner, class Root>
struct Section {
  const char* name;
  const char* remark;             ///< appended to its heading in `describe`
  bool (*applies)(const Owner&);  ///< whether it is checked and written for this owner; null: always
  void (*read)(const Section&, Owner&, const Root&, Table&);
  void (*check)(const Section&, const Owner&, const Root&, const Faults&);
  std::string (*write)(const Section&, const Owner&, const std::string& path);
  std::string (*describe)(const Section&, const std::string& path);
  void (*add)(const Section&, Schema& owner);
};

namespace detail {

template <class Holder>
struct Holding {
  using Content = Holder;
  static constexpr bool is_list = false;
  static std::span<const Content> all(const Holder& holder) { return {&holder, 1}; }
};
template <class T>
struct Holding<std::vector<T>> {
  using Content = T;
  static constexpr bool is_list = true;
  static std::span<const Content> all(const std::vector<T>& holder) { return holder; }
};
template <class T>
struct Holding<std::optional<T>> {
  using Content = T;
  static constexpr bool is_list = false;
  static std::span<const Content> all(const std::optional<T>& holder) {
    return holder ? std::span<const Content>(&*holder, 1) : std::span<const Content>();
  }
};

template <class Owner, class Holder>
Owner owner_of(Holder Owner::*);
template <class Owner, class Holder>
Holder holder_of(Holder Owner::*);

template <bool is_list>
std::string heading(const std::string& path) {
  return fmt::format("\n{}{}{}", is_list ? "[[" : "[", path, is_list ? "]]" : "]");
}

template <class Content>
concept HasSections = requires { Content::sections(); };

}  // namespace detail

/// Reads the keys of a table and its sections into an object.
template <class Content, class Root>
void read_content(Content& content, const Root& root, Table& table) {
  table.read(Content::parameters(), content);
  if constexpr (detail::HasSections<Content>) {
    for (const auto& section : Content::sections()) section.read(section, content, root, table);
  }
  if constexpr (requires { content.read_rest(table); }) content.read_rest(table);
}

/// Adds the faults of the values of an object and of its sections: out of range, or inconsistent with each other or the
/// rest of the input.
template <class Content, class Root>
void check_content(const Content& content, const Root& root, const Faults& faults) {
  Content copy = content;
  for (const BoundParameter& parameter : whipple::bind(Content::parameters(), copy)) {
    if (!parameter.info.required && is_unset(parameter)) continue;
    const std::string fault = whipple::check(parameter);
    if (!fault.empty()) faults.add(parameter.info.name, fmt::format("'{}' {}", parameter.info.name, fault));
  }
  if constexpr (detail::HasSections<Content>) {
    for (const Section<Content, Root>& section : Content::sections())
      section.check(section, content, root, faults);
  }
  if constexpr (requires { content.check(root, faults); }) content.check(root, faults);
}

/// Returns the object and its sections as written in a file, with every default.
/// @param path  of the table in the file, with a trailing dot; empty: the file
template <class Content>
std::string write_content(const Content& content, const std::string& path) {
  Content copy = content;
  std::string text = whipple::to_toml(whipple::bind(Content::parameters(), copy));
  if constexpr (requires { content.rest_to_toml(); }) text += content.rest_to_toml();
  if constexpr (detail::HasSections<Content>) {
    for (const auto& section : Content::sections()) text += section.write(section, content, path);
  }
  return text;
}

/// Returns the keys of a table and of its sections for `whipple describe`.
template <class Content>
std::string describe_content(const std::string& path) {
  std::string text = describe_table(Content::parameters());
  if constexpr (detail::HasSections<Content>) {
    for (const auto& section : Content::sections()) text += section.describe(section, path);
  }
  return text;
}

/// Adds the keys of a table and of its sections to its schema.
template <class Content>
void add_content(Schema& table) {
  add_keys(table, Content::parameters());
  if constexpr (detail::HasSections<Content>) {
    for (const auto& section : Content::sections()) section.add(section, table);
  }
  if constexpr (requires { Content::add_rest(table); }) Content::add_rest(table);
}

/// Creates the entry of a member, which is a section, a list of sections, or an optional section.
template <auto Member, class Root, class Owner = decltype(detail::owner_of(Member))>
Section<Owner, Root> section(const char* name, const char* remark = "",
                             bool (*applies)(const std::type_identity_t<Owner>&) = nullptr) {
  using Holder = decltype(detail::holder_of(Member));
  using Holding = detail::Holding<Holder>;
  using Content = typename Holding::Content;
  return {name,
          remark,
          applies,
          [](const Section<Owner, Root>& self, Owner& owner, const Root& root, Table& table) {
            Holder& holder = owner.*Member;
            if constexpr (Holding::is_list) {
              for (Table& entry : table.list(self.name)) {
                read_content(holder.emplace_back(), root, entry);
              }
            } else if constexpr (requires { Content::required; }) {
              if (auto found = table.required_table(self.name)) read_content(holder, root, *found);
            } else if (auto found = table.optional_table(self.name)) {
              if constexpr (!std::is_same_v<Holder, std::optional<Content>>) {
                read_content(holder, root, *found);
              } else if constexpr (requires { Content::inherited(root); }) {
                read_content(holder.emplace(Content::inherited(root)), root, *found);
              } else {
                read_content(holder.emplace(), root, *found);
              }
            }
          },
          [](const Section<Owner, Root>& self, const Owner& owner, const Root& root, const Faults& faults) {
            if (self.applies != nullptr && !self.applies(owner)) return;
            const Faults of_section = faults.in(self.name);
            std::size_t entry = 0;
            for (const Content& content : Holding::all(owner.*Member)) {
              check_content(content, root, Holding::is_list ? of_section.in(entry++) : of_section);
            }
          },
          [](const Section<Owner, Root>& self, const Owner& owner, const std::string& path) {
            std::string text;
            if (self.applies != nullptr && !self.applies(owner)) return text;
            for (const Content& content : Holding::all(owner.*Member)) {
              text += detail::heading<Holding::is_list>(path + self.name) + "\n";
              text += write_content(content, path + self.name + ".");
            }
            return text;
          },
          [](const Section<Owner, Root>& self, const std::string& path) {
            return detail::heading<Holding::is_list>(path + self.name) + self.remark + "\n" +
                   describe_content<Content>(path + self.name + ".");
          },
          [](const Section<Owner, Root>& self, Schema& owner) {
            constexpr bool required = requires { Content::required; };
            add_section(owner, {self.name, self.remark, Holding::is_list, required}, &add_content<Content>);
          }};
}

}  // namespace whipple::input
