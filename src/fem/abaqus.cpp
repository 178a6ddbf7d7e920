// SPDX-License-Identifier: BSD-3-Clause
#include "src/fem/abaqus.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <numbers>
#include <optional>
#include <sstream>
#include <string_view>
#include <unordered_map>

#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/words.hpp"

namespace whipple::fem {
namespace {

std::string upper(std::string_view text) {
  std::string result(text);
  for (char& letter : result) letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
  return result;
}
std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\"");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r\"") - begin + 1);
}
/// Returns the comma-separated cells of a line, trimmed.
std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (;;) {
    const std::size_t comma = line.find(',');
    cells.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

/// Maps element types, by prefix with the longest first, to element kinds.
struct Type {
  std::string_view beginning;
  int kind;
};
constexpr std::array types = {Type{"C3D8", hexahedron_kind},
                              Type{"DC3D8", hexahedron_kind},
                              Type{"T3D2", line_kind},
                              Type{"B31", line_kind},
                              Type{"C3D20", 17},
                              Type{"C3D10", 11},
                              Type{"C3D15", 18},
                              Type{"C3D4", 4},
                              Type{"C3D6", 6},
                              Type{"S3", 2},
                              Type{"S4", 3},
                              Type{"R3D4", 3},
                              Type{"R3D3", 2},
                              Type{"SFM3D4", 3},
                              Type{"MASS", 15}};

/// Selects the coordinate system of nodes.
enum class System { cartesian, cylindrical };
constexpr std::array<Word<System>, 2> words(System /*of*/) {
  return {{{System::cartesian, "R"}, {System::cylindrical, "C"}}};
}

/// Classifies a keyword by its relevance to a mesh.
enum class Meaning {
  nodes,
  elements,
  set,
  assembly,  ///< parts and instances
  other_file,
  geometry,  ///< creates or moves nodes or elements in an unsupported way
  none       ///< materials, sections, loads, contact, steps, output
};
/// Describes a keyword, written without blanks, and its supported parameters; keywords that are not listed are
/// rejected.
struct Keyword {
  Meaning meaning = Meaning::none;
  std::vector<std::string_view> parameters = {};
};
const std::map<std::string_view, Keyword>& keywords() {
  static const std::map<std::string_view, Keyword> all = [] {
    std::map<std::string_view, Keyword> table = {
        {"*NODE", {Meaning::nodes, {"NSET", "SYSTEM"}}},
        {"*ELEMENT", {Meaning::elements, {"TYPE", "ELSET"}}},
        {"*ELSET", {Meaning::set, {"ELSET", "GENERATE", "INTERNAL", "UNSORTED"}}},
        {"*INSTANCE", {Meaning::assembly}},
        {"*INCLUDE", {Meaning::other_file}}};
    for (const std::string_view word :
         {"*NGEN", "*NFILL", "*NCOPY", "*NMAP", "*ELGEN", "*ELCOPY", "*SYSTEM", "*IMPERFECTION", "*IMPORT",
          "*IMPORTELSET", "*IMPORTNSET", "*MAPSOLUTION", "*SYMMETRICMODELGENERATION", "*SUBMODEL",
          "*SUBSTRUCTUREGENERATE", "*PARAMETER", "*ELEMENTPROGRESSIVEACTIVATION", "*MODELCHANGE"}) {
      table[word] = {Meaning::geometry};
    }
    for (const std::string_view word :
         {// the model as a whole
          "*HEADING", "*PREPRINT", "*RESTART", "*PART", "*ENDPART", "*ASSEMBLY", "*ENDASSEMBLY", "*NSET",
          "*SURFACE", "*AMPLITUDE", "*ORIENTATION", "*DISTRIBUTION", "*DISTRIBUTIONTABLE", "*TRANSFORM",
          "*PHYSICALCONSTANTS", "*FILTER", "*TIMEPOINTS", "*PARAMETERDEPENDENCE", "*NORMAL",
          "*NODALTHICKNESS",
          // sections and element properties
          "*SOLIDSECTION", "*SHELLSECTION", "*SHELLGENERALSECTION", "*MEMBRANESECTION", "*BEAMSECTION",
          "*BEAMGENERALSECTION", "*COHESIVESECTION", "*SURFACESECTION", "*CONNECTORSECTION",
          "*CONNECTORBEHAVIOR", "*CONNECTORELASTICITY", "*SECTIONCONTROLS", "*HOURGLASSSTIFFNESS", "*MASS",
          "*ROTARYINERTIA", "*SPRING", "*DASHPOT", "*NONSTRUCTURALMASS", "*RIGIDBODY",
          // materials
          "*MATERIAL", "*DENSITY", "*ELASTIC", "*PLASTIC", "*HYPERELASTIC", "*HYPERFOAM", "*VISCOELASTIC",
          "*EXPANSION", "*CONDUCTIVITY", "*SPECIFICHEAT", "*LATENTHEAT", "*DAMPING", "*EOS", "*EOSCOMPACTION",
          "*EOSSHEAR", "*TENSILEFAILURE", "*SHEARFAILURE", "*RATEDEPENDENT", "*INELASTICHEATFRACTION",
          "*DAMAGEINITIATION", "*DAMAGEEVOLUTION", "*DAMAGESTABILIZATION", "*CYCLICHARDENING", "*CREEP",
          "*DRUCKERPRAGER", "*DRUCKERPRAGERHARDENING", "*CAPPLASTICITY", "*CAPHARDENING", "*CRUSHABLEFOAM",
          "*CRUSHABLEFOAMHARDENING", "*CONCRETEDAMAGEDPLASTICITY", "*CONCRETECOMPRESSIONHARDENING",
          "*CONCRETETENSIONSTIFFENING", "*CONCRETECOMPRESSIONDAMAGE", "*CONCRETETENSIONDAMAGE",
          "*BRITTLECRACKING", "*BRITTLESHEAR", "*BRITTLEFAILURE", "*POROUSMETALPLASTICITY", "*POTENTIAL",
          "*ANNEALTEMPERATURE", "*USERMATERIAL", "*DEPVAR", "*VISCOSITY", "*REACTIONRATE", "*DETONATIONPOINT",
          "*GASSPECIFICHEAT", "*MODULUS",
          // constraints, contact, loads and load history
          "*EQUATION", "*MPC", "*TIE", "*COUPLING", "*KINEMATIC", "*DISTRIBUTING", "*EMBEDDEDELEMENT",
          "*CONTACT", "*CONTACTPAIR", "*CONTACTINCLUSIONS", "*CONTACTEXCLUSIONS",
          "*CONTACTPROPERTYASSIGNMENT", "*CONTACTINITIALIZATIONASSIGNMENT", "*CONTACTFORMULATION",
          "*CONTACTCONTROLS", "*CONTACTCONTROLSASSIGNMENT", "*SURFACEPROPERTYASSIGNMENT",
          "*SURFACEINTERACTION", "*SURFACEBEHAVIOR", "*FRICTION", "*GAPCONDUCTANCE", "*GAPHEATGENERATION",
          "*COHESIVEBEHAVIOR", "*CLEARANCE", "*BOUNDARY", "*INITIALCONDITIONS", "*STEP", "*ENDSTEP",
          "*STATIC", "*DYNAMIC", "*FREQUENCY", "*BUCKLE", "*HEATTRANSFER", "*COUPLEDTEMPERATURE-DISPLACEMENT",
          "*VISCO", "*CLOAD", "*DLOAD", "*DSLOAD", "*CFLUX", "*DFLUX", "*FILM", "*RADIATE", "*TEMPERATURE",
          "*FIELD", "*GRAVITY", "*BULKVISCOSITY", "*FIXEDMASSSCALING", "*VARIABLEMASSSCALING", "*CONTROLS",
          "*ADAPTIVEMESH", "*ADAPTIVEMESHCONTROLS",
          // output
          "*OUTPUT", "*NODEOUTPUT", "*ELEMENTOUTPUT", "*CONTACTOUTPUT", "*ENERGYOUTPUT",
          "*INCREMENTATIONOUTPUT", "*INTEGRATEDOUTPUT", "*NODEPRINT", "*ELPRINT", "*CONTACTPRINT",
          "*ENERGYPRINT", "*NODEFILE", "*ELFILE", "*CONTACTFILE", "*ENERGYFILE", "*FILEOUTPUT", "*FILEFORMAT",
          "*MONITOR", "*DIAGNOSTICS", "*PRINT"}) {
      table[word] = {};
    }
    return table;
  }();
  return all;
}

class AbaqusReader {
 public:
  AbaqusReader(MeshData& data, double length_unit)
      : data_(data), unit_(length_unit), stream_(read_text(data.path)) {}

  void read() {
    bool more = next();
    while (more) {
      if (!line_text_.starts_with('*')) fail("expected a keyword (*...)");
      std::string head(line_text_);
      while (head.ends_with(',') && next()) head += line_text_;  // continued on the next line
      const std::vector<std::string_view> words = cells_of(head);
      std::string name = upper(words.front());
      std::erase(name, ' ');
      const auto keyword = keywords().find(name);
      if (keyword == keywords().end()) {
        fail(
            fmt::format("the keyword {} is not known here: delete it if it neither makes nor moves nodes and "
                        "elements",
                        upper(words.front())));
      }
      parameters(words, keyword->second);
      more_ = next();
      block(keyword->second.meaning);
      more = more_;
    }
    if (data_.elements.empty()) throw InputError(fmt::format("{}: has no *ELEMENT", data_.path.string()));
    groups();
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}:{}: error: {}", data_.path.string(), line_, what));
  }
  /// Stores the parameters of a keyword; for keywords with a list of supported parameters, others are rejected.
  void parameters(const std::vector<std::string_view>& words, const Keyword& keyword) {
    parameters_.clear();
    for (std::size_t i = 1; i < words.size(); ++i) {
      if (words[i].empty()) continue;
      const std::size_t equals = words[i].find('=');
      const std::string name = upper(trimmed(words[i].substr(0, equals)));
      if (!keyword.parameters.empty() &&
          std::ranges::find(keyword.parameters, name) == keyword.parameters.end()) {
        fail(fmt::format("the parameter {} of {} is not read: write what it says into the lines of data",
                         name, upper(words.front())));
      }
      parameters_[name] =
          equals == std::string_view::npos ? "" : std::string(trimmed(words[i].substr(equals + 1)));
    }
  }
  /// Reads the data lines of a keyword.
  void block(Meaning meaning) {
    switch (meaning) {
      case Meaning::nodes:
        return nodes();
      case Meaning::elements:
        return elements();
      case Meaning::set:
        return set();
      case Meaning::assembly:
        fail(
            "parts and assemblies are not read: write the input without them (Abaqus/CAE: \"Do not use parts "
            "and "
            "assemblies in input files\")");
      case Meaning::other_file:
        fail("*INCLUDE is not read: put the file into this one");
      case Meaning::geometry:
        fail(
            "generated or moved nodes and elements, local systems and parameters are not read: write them "
            "out");
      case Meaning::none:
        for_each_line([](const std::vector<std::string_view>&) {});
    }
  }

  /// Advances to the next line that is not blank and not a comment.
  bool next() {
    while (std::getline(stream_, buffer_)) {
      ++line_;
      line_text_ = trimmed(buffer_);
      if (line_ == 1 && line_text_.starts_with("\xEF\xBB\xBF")) line_text_.remove_prefix(3);
      if (!line_text_.empty() && !line_text_.starts_with("**")) return true;
    }
    return false;
  }
  /// Calls f(cells) for the data lines of a keyword.
  template <class Function>
  void for_each_line(Function&& f) {
    while (more_ && !line_text_.starts_with('*')) {
      f(cells_of(line_text_));
      more_ = next();
    }
  }
  std::uint64_t number(std::string_view cell, const char* what) const {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size()) {
      const bool columns = cell.find(' ') != std::string_view::npos;
      fail(fmt::format("\"{}\" is not {}{}", cell, what, columns ? ": numbers stand between commas" : ""));
    }
    return value;
  }
  double coordinate(std::string_view cell) const {
    std::string text(cell);
    std::ranges::replace(text, 'D', 'E');  // Fortran exponents
    std::ranges::replace(text, 'd', 'e');
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !std::isfinite(value))
      fail(fmt::format("\"{}\" is not a coordinate", cell));
    return value;
  }

  /// Returns the position of a node, from coordinates in the system of the keyword.
  Vector3 place(const Vector3& x, System system) const {
    if (system == System::cartesian) return unit_ * x;
    const double angle = x[1] * std::numbers::pi / 180.0;
    return unit_ * Vector3(x[0] * std::cos(angle), x[0] * std::sin(angle), x[2]);
  }

  void nodes() {
    const std::string& name = parameters_["SYSTEM"];
    const std::optional<System> system = name.empty() ? System::cartesian : value_of<System>(upper(name));
    if (!system) {
      fail(fmt::format(
          "nodes in the system \"{}\" are not read: write them in Cartesian (SYSTEM=R) or cylindrical "
          "coordinates (SYSTEM=C)",
          name));
    }
    for_each_line([&](const std::vector<std::string_view>& cells) {
      const std::uint64_t tag = number(cells.front(), "the number of a node");
      if (cells.size() < 2) fail(fmt::format("node {} has no coordinates", tag));
      Vector3 x = Vector3::Zero();
      for (std::size_t i = 1; i < std::min<std::size_t>(cells.size(), 4); ++i) {
        if (!cells[i].empty()) x[static_cast<Eigen::Index>(i - 1)] = coordinate(cells[i]);
      }
      if (!node_.emplace(tag, static_cast<std::uint32_t>(data_.nodes.size())).second) {
        fail(fmt::format("node {} is defined twice", tag));
      }
      data_.nodes.push_back(place(x, *system));
    });
  }

  void elements() {
    const std::string type = upper(parameters_["TYPE"]);
    const auto found =
        std::ranges::find_if(types, [&](const Type& t) { return type.starts_with(t.beginning); });
    if (found == types.end()) fail(fmt::format("elements of the type \"{}\" are not known here", type));
    const ElementKind& kind = *element_kind(found->kind);
    const std::string& set = parameters_["ELSET"];
    std::vector<std::uint32_t>* const members = set.empty() ? nullptr : &set_of(set);
    std::vector<std::uint64_t> numbers;
    std::size_t begin = 0;
    for_each_line([&](const std::vector<std::string_view>& cells) {
      if (numbers.empty()) begin = line_;
      for (const std::string_view cell : cells) {
        if (!cell.empty()) numbers.push_back(number(cell, "a number of an element or node"));
      }
      if (numbers.size() <= kind.nodes) return;  // continued on the next line
      add(kind, numbers, begin, members);
      numbers.clear();
    });
    if (!numbers.empty()) require_complete(kind, numbers);
  }

  void require_complete(const ElementKind& kind, const std::vector<std::uint64_t>& numbers) const {
    const std::size_t nodes = numbers.size() - 1;
    if (nodes == kind.nodes) return;
    fail(fmt::format("element {} has {} nodes instead of {}", numbers.front(), nodes, kind.nodes));
  }

  void add(const ElementKind& kind, const std::vector<std::uint64_t>& numbers, std::size_t line,
           std::vector<std::uint32_t>* members) {
    require_complete(kind, numbers);
    const auto index = static_cast<std::uint32_t>(data_.elements.size());
    if (!element_.emplace(numbers.front(), index).second) {
      fail(fmt::format("element {} is defined twice", numbers.front()));
    }
    MeshData::Element element{numbers.front(), line, kind.number, {}};
    for (std::size_t i = 1; i < numbers.size(); ++i) {
      const auto found = node_.find(numbers[i]);
      if (found == node_.end())
        fail(fmt::format("element {}: node {} is not defined", numbers.front(), numbers[i]));
      element.nodes.push_back(found->second);
    }
    data_.elements.push_back(std::move(element));
    if (members != nullptr) members->push_back(index);
  }

  /// Returns the elements of a set; names of sets are case-insensitive.
  std::vector<std::uint32_t>& set_of(const std::string& name) {
    const auto [entry, is_new] = set_.try_emplace(upper(name), sets_.size());
    if (is_new) sets_.emplace_back(name, std::vector<std::uint32_t>());
    return sets_[entry->second].second;
  }

  void set() {
    const std::string name = parameters_["ELSET"];
    if (name.empty()) fail("*ELSET has no name (ELSET=...)");
    const bool generated = parameters_.contains("GENERATE");
    set_of(name);
    std::vector<std::uint32_t> members;
    for_each_line([&](const std::vector<std::string_view>& cells) {
      if (generated) return generate(cells, members);
      for (const std::string_view cell : cells) {
        if (cell.empty()) continue;
        if (std::isdigit(static_cast<unsigned char>(cell.front())) != 0) {
          members.push_back(element(number(cell, "the number of an element")));
        } else {
          const auto other = set_.find(upper(cell));
          if (other == set_.end())
            fail(fmt::format("element set \"{}\" is not defined before this line", cell));
          const auto& others = sets_[other->second].second;
          members.insert(members.end(), others.begin(), others.end());
        }
      }
    });
    std::vector<std::uint32_t>& all = set_of(name);
    all.insert(all.end(), members.begin(), members.end());
  }

  /// Adds the elements of a range given by first, last and increment.
  void generate(const std::vector<std::string_view>& cells, std::vector<std::uint32_t>& members) {
    if (cells.size() < 2) fail("expected the first and the last number of a set, and their increment");
    constexpr const char* what = "the number of an element";
    const std::uint64_t first = number(cells[0], what), last = number(cells[1], what);
    const std::uint64_t step = cells.size() < 3 || cells[2].empty() ? 1 : number(cells[2], "an increment");
    if (step == 0 || last < first || (last - first) / step >= data_.elements.size()) {
      fail(fmt::format("the range {} to {} by {} is not one of elements", first, last, step));
    }
    const std::uint64_t count =
        (last - first) / step + 1;  // not a bound of `tag`, which may be the last number there is
    for (std::uint64_t i = 0; i < count; ++i) members.push_back(element(first + i * step));
  }
  std::uint32_t element(std::uint64_t tag) const {
    const auto found = element_.find(tag);
    if (found == element_.end()) fail(fmt::format("element {} is not defined before this line", tag));
    return found->second;
  }

  /// Creates the groups: a set with elements of several dimensions becomes a group of the largest dimension; without
  /// sets, all elements form the group "all".
  void groups() {
    if (sets_.empty()) {  // as for VTK files without arrays
      std::vector<std::uint32_t>& all = set_of("all");
      for (std::uint32_t e = 0; e < data_.elements.size(); ++e) all.push_back(e);
    }
    int tag = 0;
    for (auto& [name, members] : sets_) {
      std::ranges::sort(members);
      members.erase(std::ranges::unique(members).begin(), members.end());
      int dimension = 0;
      for (const std::uint32_t e : members) {
        dimension = std::max(dimension, element_kind(data_.elements[e].kind)->dimension);
      }
      data_.groups.push_back({dimension, ++tag, name, std::move(members)});
    }
  }

  MeshData& data_;
  double unit_;
  std::istringstream stream_;
  std::string buffer_;
  std::string_view line_text_;
  std::size_t line_ = 0;
  bool more_ = false;  // line_text_ contains a line
  std::map<std::string, std::string> parameters_;
  std::unordered_map<std::uint64_t, std::uint32_t> node_, element_;
  std::map<std::string, std::size_t> set_;
  std::vector<std::pair<std::string, std::vector<std::uint32_t>>> sets_;
};

}  // namespace

bool is_abaqus(const std::filesystem::path& path) {
  std::ifstream file = regular_file(path);
  for (std::string line; std::getline(file, line) && line.size() < 10000;) {
    std::string_view text = trimmed(line);
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    if (!text.empty()) return text.starts_with('*');
  }
  return false;
}

MeshData read_abaqus(const std::filesystem::path& path, double length_unit) {
  MeshData data;
  data.path = path;
  data.called = "element set";
  AbaqusReader(data, length_unit).read();
  return data;
}

}  // namespace whipple::fem
