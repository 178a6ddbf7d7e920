// SPDX-License-Identifier: BSD-3-Clause
#include "src/fem/gmsh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>
#include <string_view>
#include <type_traits>
#include <unordered_map>

#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"

namespace whipple::fem {
namespace {

/// Reads line by line and tracks the line number.
class GmshReader {
 public:
  GmshReader(MeshData& file, const std::filesystem::path& path, double length_unit)
      : file_(file), path_(path), unit_(length_unit), stream_(read_text(path)) {
    if (!stream_) throw InputError(fmt::format("{}: cannot be read", path.string()));
  }

  void read() {
    format();
    while (next_or_end()) {
      if (text_ == "$PhysicalNames") {
        physical_names();
      } else if (text_ == "$Entities" && version_ == 4.1) {
        entities();
      } else if (text_ == "$Nodes") {
        version_ == 4.1 ? nodes_4() : nodes_2();
      } else if (text_ == "$Elements") {
        version_ == 4.1 ? elements_4() : elements_2();
      } else if (text_ == "$PartitionedEntities") {
        fail("the mesh is partitioned; save it in one part (Mesh.PartitionOldStyleMsh2, Unpartition)");
      } else if (text_.starts_with("$")) {
        skip(std::string(text_));
      } else if (!text_.empty()) {
        fail(fmt::format("expected the beginning of a section ($...), not \"{}\"", text_));
      }
    }
    if (!saw_elements_) fail("the file ends without $Elements");
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}:{}: error: {}", path_.string(), line_, what));
  }
  bool next_or_end() {
    if (!std::getline(stream_, buffer_)) return false;
    ++line_;
    while (!buffer_.empty() && (buffer_.back() == '\r' || buffer_.back() == ' ')) buffer_.pop_back();
    text_ = rest_ = buffer_;
    return true;
  }
  void next(const char* section) {
    if (!next_or_end()) fail(fmt::format("the file ends inside ${}", section));
  }
  /// Returns the next word of the line.
  std::string_view word(const char* what) {
    const std::size_t begin = rest_.find_first_not_of(" \t");
    if (begin == std::string_view::npos) fail(fmt::format("the line ends where {} is expected", what));
    rest_.remove_prefix(begin);
    const std::size_t length = std::min(rest_.find_first_of(" \t"), rest_.size());
    const std::string_view result = rest_.substr(0, length);
    rest_.remove_prefix(length);
    return result;
  }
  template <class Number>
  Number number(const char* what) {
    const std::string_view text = word(what);
    Number value{};
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (code != std::errc{} || end != text.data() + text.size()) {
      fail(fmt::format("\"{}\" is not {}", text, what));
    }
    if constexpr (std::is_floating_point_v<Number>) {
      if (!std::isfinite(value)) fail(fmt::format("\"{}\" is not {}", text, what));
    }
    return value;
  }
  /// Reads the number of items that follow. Memory is allocated item by item, as a file may declare more than it
  /// contains.
  std::size_t count(const char* what) { return number<std::size_t>(what); }
  /// Reads the given number of integers from the line.
  std::vector<int> numbers(std::size_t size, const char* what) {
    std::vector<int> result;
    for (; size > 0; --size) result.push_back(number<int>(what));
    return result;
  }
  int dimension() {
    const int result = number<int>("a dimension");
    if (result < 0 || result > 3) fail(fmt::format("\"{}\" is not a dimension: 0 to 3", result));
    return result;
  }
  void end_of(const char* section) {
    next(section);
    if (text_ != fmt::format("$End{}", section))
      fail(fmt::format("expected $End{}, not \"{}\"", section, text_));
  }
  void skip(const std::string& section) {
    const std::string end = "$End" + section.substr(1);
    do next(section.c_str() + 1);
    while (text_ != end);
  }

  void format() {
    const bool any = next_or_end();
    if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);  // byte order mark
    if (!any || text_ != "$MeshFormat") {
      throw InputError(fmt::format(
          "{}: is no mesh of Gmsh (first line $MeshFormat), Abaqus (keywords *NODE, *ELEMENT) or VTK",
          path_.string()));
    }
    next("MeshFormat");
    version_ = number<double>("the version of the format");
    if (version_ != 2.2 && version_ != 4.1) {
      fail(fmt::format("format {}; supported are 2.2 and 4.1 (gmsh -format msh41)", version_));
    }
    if (number<int>("0 (ASCII) or 1 (binary)") != 0)
      fail("binary file; supported is ASCII (gmsh -bin 0, Mesh.Binary = 0)");
    end_of("MeshFormat");
  }

  MeshData::Group& group(int dimension, int tag) {
    const auto same = [&](const MeshData::Group& g) { return g.dimension == dimension && g.tag == tag; };
    const auto found = std::ranges::find_if(file_.groups, same);
    if (found != file_.groups.end()) return *found;
    return file_.groups.emplace_back(MeshData::Group{dimension, tag, fmt::format("physical {}", tag), {}});
  }

  void physical_names() {
    next("PhysicalNames");
    for (std::size_t left = count("the number of physical names"); left > 0; --left) {
      next("PhysicalNames");
      const int of = dimension(), tag = number<int>("the tag of a physical group");
      const std::size_t begin = rest_.find('"'), end = rest_.rfind('"');
      if (begin == std::string_view::npos || end <= begin + 1)
        fail("expected the name of the group in quotes");
      group(of, tag).name = rest_.substr(begin + 1, end - begin - 1);
    }
    end_of("PhysicalNames");
  }

  void entities() {
    next("Entities");
    std::array<std::size_t, 4> counts;
    for (std::size_t& n : counts) n = count("a number of entities");
    for (int of = 0; of < 4; ++of) {
      for (std::size_t left = counts[static_cast<std::size_t>(of)]; left > 0; --left) {
        next("Entities");
        const int tag = number<int>("the tag of an entity");
        for (int i = 0; i < (of == 0 ? 3 : 6); ++i) number<double>("a coordinate");
        physical_of_entity_[{of, tag}] =
            numbers(count("the number of physical groups of an entity"), "the tag of a physical group");
      }
    }
    end_of("Entities");
  }

  void add_node(std::uint64_t tag) {
    Vector3 x;
    for (int i = 0; i < 3; ++i) x[i] = unit_ * number<double>("a coordinate");
    if (!index_of_node_.emplace(tag, static_cast<std::uint32_t>(file_.nodes.size())).second) {
      fail(fmt::format("node {} is defined twice", tag));
    }
    file_.nodes.push_back(x);
  }
  void nodes_2() {
    next("Nodes");
    for (std::size_t left = count("the number of nodes"); left > 0; --left) {
      next("Nodes");
      const auto tag = number<std::uint64_t>("the number of a node");
      add_node(tag);
    }
    end_of("Nodes");
  }
  void nodes_4() {
    next("Nodes");
    for (std::size_t blocks = count("the number of blocks"); blocks > 0; --blocks) {
      next("Nodes");
      dimension();
      number<int>("the tag of an entity");
      number<int>("0 or 1 (parametric)");
      std::vector<std::uint64_t> tags;
      for (std::size_t left = count("the number of nodes"); left > 0; --left) {
        next("Nodes");
        tags.push_back(number<std::uint64_t>("the tag of a node"));
      }
      for (const std::uint64_t tag : tags) {
        next("Nodes");
        add_node(tag);
      }
    }
    end_of("Nodes");
  }

  void add_element(std::uint64_t tag, const ElementKind& kind, std::span<const int> physical) {
    MeshData::Element element{tag, line_, kind.number, {}};
    for (std::size_t i = 0; i < kind.nodes; ++i) {
      const auto node = number<std::uint64_t>("the number of a node");
      const auto found = index_of_node_.find(node);
      if (found == index_of_node_.end()) fail(fmt::format("element {}: node {} is not defined", tag, node));
      element.nodes.push_back(found->second);
    }
    for (const int p : physical) {
      // Negative in format 4.1 if the entity is reversed.
      if (p == std::numeric_limits<int>::min())
        fail(fmt::format("\"{}\" is not the tag of a physical group", p));
      if (p != 0)
        group(kind.dimension, std::abs(p))
            .elements.push_back(static_cast<std::uint32_t>(file_.elements.size()));
    }
    file_.elements.push_back(std::move(element));
  }
  const ElementKind& kind() {
    const int number_of_kind = number<int>("the kind of an element");
    const ElementKind* found = element_kind(number_of_kind);
    if (found == nullptr) fail(fmt::format("elements of kind {} are not supported", number_of_kind));
    return *found;
  }
  void elements_2() {
    saw_elements_ = true;
    next("Elements");
    for (std::size_t left = count("the number of elements"); left > 0; --left) {
      next("Elements");
      const auto tag = number<std::uint64_t>("the number of an element");
      const ElementKind& k = kind();
      const std::vector<int> tags = numbers(count("the number of tags"), "a tag");
      add_element(tag, k, std::span(tags).first(std::min<std::size_t>(tags.size(), 1)));
    }
    end_of("Elements");
  }
  void elements_4() {
    saw_elements_ = true;
    next("Elements");
    for (std::size_t blocks = count("the number of blocks"); blocks > 0; --blocks) {
      next("Elements");
      const int of = dimension(), entity = number<int>("the tag of an entity");
      const ElementKind& k = kind();
      const std::vector<int>& physical = physical_of_entity_[{of, entity}];
      for (std::size_t left = count("the number of elements"); left > 0; --left) {
        next("Elements");
        add_element(number<std::uint64_t>("the tag of an element"), k, physical);
      }
    }
    end_of("Elements");
  }

  MeshData& file_;
  std::filesystem::path path_;
  double unit_, version_ = 0.0;
  std::istringstream stream_;
  std::string buffer_;
  std::string_view text_, rest_;
  std::size_t line_ = 0;
  bool saw_elements_ = false;
  std::unordered_map<std::uint64_t, std::uint32_t> index_of_node_;
  std::map<std::pair<int, int>, std::vector<int>> physical_of_entity_;
};

}  // namespace

MeshData read_gmsh(const std::filesystem::path& path, double length_unit) {
  MeshData data;
  data.path = path;
  GmshReader(data, path, length_unit).read();
  return data;
}

}  // namespace whipple::fem
