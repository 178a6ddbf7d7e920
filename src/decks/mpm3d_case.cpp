// SPDX-License-Identifier: BSD-3-Clause
#include "src/decks/mpm3d_case.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/base/tensor.hpp"
#include "src/core/base/text.hpp"
#include "src/decks/mpm3d_bodies.hpp"
#include "src/decks/mpm3d_grid.hpp"
#include "src/decks/mpm3d_loads.hpp"
#include "src/decks/mpm3d_material.hpp"
#include "src/decks/toml_text.hpp"

namespace whipple::decks::mpm3d {
namespace {

/// Defines defaults that differ between the two codes.
constexpr double usual_courant = 0.5, least_courant = 0.05;
constexpr double default_quadratic = 1.5, default_linear = 0.06;

class CaseBuilder {
 public:
  CaseBuilder(const Deck& deck, const ImportOptions& options) : deck_(deck), options_(options) {
    import_.deck = deck.file.filename().string();
    import_.grammar = grammar;
  }

  Import build() {
    units();
    required();
    if (!faults_.empty()) throw InputError(std::move(faults_));
    const std::map<int, CaseMaterial> materials = materials_of(deck_, units_, import_);
    std::map<int, double> density;
    for (const auto& [index, material] : materials) density[index] = material.density;
    written_materials_ = import_.files.size();
    bodies_ = bodies_of(deck_, density, units_, {.old_mass = options_.old_mass}, import_);
    counts();
    head();
    domain();
    time();
    transfer();
    viscosity();
    contact();
    write_loads(deck_, bodies_, units_, toml_, import_, faults_);
    for (const CaseBody& body : bodies_) add(body, materials.at(body.material));
    detonation(std::ranges::any_of(bodies_, [&](const CaseBody& body) {
      return !body.shape.empty() && materials.at(body.material).explosive;
    }));
    output();
    rest();
    if (!faults_.empty()) throw InputError(std::move(faults_));
    import_.case_text = toml_.text();
    import_.sort_remarks();
    return std::move(import_);
  }

 private:
  void fault(unsigned line, std::string text) {
    faults_.push_back({.file = deck_.file.string(), .line = line, .column = 1, .text = std::move(text)});
  }
  void remark(Outcome outcome, const Statement& statement, std::string text) {
    import_.remark(outcome, statement.line, statement.name(), std::move(text));
  }
  /// Returns the effective statement of a keyword that may occur once; earlier ones are dropped with a remark.
  const Statement* one(Keyword keyword) {
    const std::vector<const Statement*> all = deck_.all(keyword);
    for (std::size_t i = 0; i + 1 < all.size(); ++i) {
      remark(Outcome::dropped, *all[i],
             fmt::format("given again in line {}, which counts", all.back()->line));
    }
    return all.empty() ? nullptr : all.back();
  }
  [[nodiscard]] std::string length(double value) const { return units_.quantity(value, dimension::length); }
  [[nodiscard]] std::string vector(const Vector3& v, const Dimension& dimension) const {
    return fmt::format("[{}, {}, {}]", units_.quantity(v[0], dimension), units_.quantity(v[1], dimension),
                       units_.quantity(v[2], dimension));
  }
  [[nodiscard]] std::string line_of(const Statement& statement) const {
    return fmt::format("line {}", statement.line);
  }

  void units() {
    if (options_.units) {
      units_ = *options_.units;
      if (deck_.units) {
        import_.remark(Outcome::dropped, deck_.units_line, "! Unit",
                       "the comment's units; those of --units count");
      }
    } else if (deck_.units) {
      units_ = *deck_.units;
      import_.remark(Outcome::exact, deck_.units_line, "! Unit",
                     fmt::format("{}, {}, {}, as the comment says", units_.length, units_.mass, units_.time));
    } else {
      fault(1,
            "the deck does not say its units in a comment (\"! Unit: mm g N ms MPa\"): give them as in "
            "--units 'mm g ms'");
    }
    import_.units = fmt::format("{} {} {}", units_.length, units_.mass, units_.time);
  }

  /// Checks that the statements required by a case are present.
  void required() {
    const auto present = [&](Keyword keyword) { return deck_.last(keyword) != nullptr; };
    const unsigned line = deck_.statements.empty() ? 1 : deck_.statements.back().line;
    if (!present(Keyword::grid) &&
        !(present(Keyword::span_x) && present(Keyword::span_y) && present(Keyword::span_z))) {
      fault(line, "the deck has no 'grid' (nor spx, spy and spz)");
    }
    for (const Keyword keyword : {Keyword::cell, Keyword::end_time, Keyword::material, Keyword::body}) {
      const Statement* statement = deck_.last(keyword);
      if (statement == nullptr) {
        fault(line, fmt::format("the deck has no '{}'", word_of(keyword)));
      } else if ((keyword == Keyword::cell || keyword == Keyword::end_time) &&
                 !(statement->numbers[0] > 0.0)) {
        fault(statement->line, fmt::format("'{}' must be > 0", word_of(keyword)));
      }
    }
  }

  void counts() {
    double particles = 0.0;
    for (const CaseBody& body : bodies_) particles += body.particles;
    if (const Statement* statement = one(Keyword::particles)) {
      if (particles > statement->numbers[0]) {
        fault(statement->line, fmt::format("nbmp is {}, the bodies have {} particles",
                                           number(statement->numbers[0]), number(particles)));
      }
      remark(Outcome::converted, *statement,
             fmt::format("{} particles in the bodies; shapes are filled again", number(particles)));
    }
    if (const Statement* statement = one(Keyword::bodies)) {
      if (statement->numbers[0] < static_cast<double>(bodies_.size())) {
        fault(statement->line,
              fmt::format("nbbo is {}, there are {} bodies", number(statement->numbers[0]), bodies_.size()));
      }
      remark(Outcome::exact, *statement, fmt::format("{} bodies", bodies_.size()));
    }
    if (const Statement* statement = one(Keyword::components))
      remark(Outcome::exact, *statement, "components: contact_group of the bodies");
    if (const Statement* statement = one(Keyword::materials)) {
      remark(Outcome::exact, *statement, fmt::format("{} materials", written_materials_));
    }
  }

  void head() {
    toml_.comment(fmt::format("Written by 'whipple import' from {}, a deck of {}; see import.txt.",
                              import_.deck, grammar));
    const Statement* title = one(Keyword::title);
    toml_.text_entry("title", title != nullptr && !title->kind.empty() ? title->kind : import_.deck);
    if (title != nullptr) remark(Outcome::exact, *title, "title");
  }

  void domain() {
    cell_ = deck_.last(Keyword::cell)->numbers[0];
    remark(Outcome::exact, *one(Keyword::cell), "domain.cell_size");
    grid_ = grid_of(deck_, import_);
    const Statement* fixed = one(Keyword::fixed);
    static constexpr std::array names = {"outflow", "no_slip", "symmetry"};
    std::array<int, 6> faces = {};
    if (fixed != nullptr) {
      for (std::size_t i = 0; i < 6; ++i) {
        faces[i] = whole(fixed->numbers[i]);
        if (faces[i] < 0 || faces[i] > 2) {
          fault(fixed->line,
                fmt::format("'fixe' takes 0 (free), 1 (fixed) or 2 (symmetry), not {}", faces[i]));
          faces[i] = 0;
        }
      }
      remark(Outcome::exact, *fixed, "domain.boundary");
    }
    whole_cells(faces);
    toml_.table("[domain]");
    toml_.entry("lower", vector(grid_.lower, dimension::length));
    toml_.entry("upper", vector(grid_.upper, dimension::length));
    toml_.entry("cell_size", length(cell_), line_of(*deck_.last(Keyword::cell)));
    std::string boundary;
    static constexpr std::array keys = {"x_lower", "x_upper", "y_lower", "y_upper", "z_lower", "z_upper"};
    for (std::size_t i = 0; i < 6; ++i) {
      if (faces[i] != 0)
        boundary += fmt::format("{}{} = \"{}\"", boundary.empty() ? "" : ", ", keys[i],
                                names[static_cast<std::size_t>(faces[i])]);
    }
    if (!boundary.empty()) toml_.entry("boundary", fmt::format("{{ {} }}", boundary), line_of(*fixed));
  }

  /// Extends the grid to whole cells. MPM3D-F90 rounds the grid to whole cells and silently omits particles outside it;
  /// here the domain grows by whole cells to contain the bodies, at open faces.
  void whole_cells(const std::array<int, 6>& faces) {
    for (int i = 0; i < 3; ++i) {
      if (!(grid_.upper[i] > grid_.lower[i])) {
        fault(grid_.line, "the grid must have its lower end first");
        return;
      }
      const double cells = std::floor((grid_.upper[i] - grid_.lower[i]) / cell_ + 0.5);
      if (cells < 1.0 || cells > 1e6) {
        fault(grid_.line, fmt::format("the grid has {} cells along {}", number(cells), "xyz"[i]));
        return;
      }
      grid_.upper[i] = grid_.lower[i] + cells * cell_;
      double below = 0.0, above = 0.0;
      for (const CaseBody& body : bodies_) {
        below = std::max(below, std::ceil((grid_.lower[i] - body.lower[i]) / cell_ - 1e-6));
        above = std::max(above, std::ceil((body.upper[i] - grid_.upper[i]) / cell_ - 1e-6));
      }
      const std::size_t face = 2 * static_cast<std::size_t>(i);
      if (faces[face] != 0) below = 0.0;
      if (faces[face + 1] != 0) above = 0.0;
      if (below + above > 1e6) {
        fault(grid_.line,
              fmt::format("a body lies {} cells beyond the grid along {}", number(below + above), "xyz"[i]));
        return;
      }
      grid_.lower[i] -= below * cell_;
      grid_.upper[i] += above * cell_;
      if (below + above > 0.0) {
        import_.remark(
            Outcome::converted, grid_.line, "grid",
            fmt::format("bodies stick out of the deck's grid along {}: the domain has {} cells more there",
                        "xyz"[i], number(below + above)));
      }
    }
  }

  void time() {
    const Statement& end = *one(Keyword::end_time);
    toml_.table("[time]");
    toml_.entry("end", units_.quantity(end.numbers[0], dimension::time), line_of(end));
    remark(Outcome::exact, end, "time.end");
    if (const Statement* factor = one(Keyword::time_step_factor)) {
      const double value = factor->numbers[0];
      if (!(value > 0.0) || value > 2.5) fault(factor->line, "'dtsc' must be > 0 and at most 2.5");
      if (value < usual_courant && (value >= least_courant || options_.same_method)) {
        toml_.entry("courant", number(value), line_of(*factor));
        remark(Outcome::converted, *factor,
               "time.courant; the sound speed is the present one, not that of the start");
      } else {
        remark(Outcome::converted, *factor,
               fmt::format("time.courant stays {}: MPM3D-F90 takes the elastic sound speed, this program the "
                           "present one",
                           usual_courant));
      }
    }
    scheme();
  }

  void scheme() {
    std::string word = "musl";
    for (const Keyword keyword : {Keyword::musl, Keyword::usf, Keyword::usl}) {
      const Statement* statement = one(keyword);
      if (statement == nullptr) continue;
      if (statement->kind == "on") word = word_of(keyword);
      remark(Outcome::converted, *statement,
             options_.same_method ? "time.scheme" : "this program's own scheme; --same-method keeps it");
    }
    if (options_.same_method) toml_.entry("scheme", fmt::format("\"{}\"", word));
    if (const Statement* statement = one(Keyword::jaumann)) {
      const bool on = statement->kind == "on";
      remark(
          on ? Outcome::converted : Outcome::missing, *statement,
          on ? "stresses turn with the middle of the step" : "stresses that do not turn with the material");
    }
  }

  void transfer() {
    std::string shape = "linear";
    const Statement* gimp = one(Keyword::gimp);
    const Statement* bspline = one(Keyword::bspline);
    if (gimp != nullptr) shape = "gimp";
    if (bspline != nullptr) shape = "quadratic_bspline";
    for (const Statement* statement : {gimp, bspline}) {
      if (statement == nullptr) continue;
      remark(
          Outcome::converted, *statement,
          options_.same_method ? "transfer.shape_function" : "quadratic B-splines; --same-method keeps it");
    }
    if (!options_.same_method) return;
    toml_.table("[transfer]");
    toml_.entry("shape_function", fmt::format("\"{}\"", shape));
  }

  void viscosity() {
    const Statement* bulk = one(Keyword::bulk_viscosity);
    const double quadratic = bulk != nullptr ? bulk->numbers[0] : default_quadratic,
                 linear = bulk != nullptr ? bulk->numbers[1] : default_linear;
    if (quadratic < 0.0 || linear < 0.0) fault(bulk->line, "'bulk' must be >= 0");
    toml_.table("[artificial_viscosity]",
                bulk != nullptr ? line_of(*bulk) : "the deck has no 'bulk': defaults of MPM3D-F90");
    toml_.entry("quadratic", number(quadratic));
    toml_.entry("linear", number(linear));
    if (bulk != nullptr) remark(Outcome::exact, *bulk, "artificial_viscosity");
  }

  void contact() {
    const Statement* contact = one(Keyword::contact);
    toml_.table("[contact]");
    if (contact == nullptr) {
      toml_.entry("method", "\"none\"", "one velocity field, as in a deck without 'cont'");
      return;
    }
    grouped_ = true;
    toml_.entry("method", "\"multi_field\"", line_of(*contact));
    if (contact->numbers[0] < 0.0) fault(contact->line, "friction must be >= 0");
    toml_.entry("friction", number(contact->numbers[0]));
    remark(Outcome::converted, *contact, "contact of the components; normals by this program's own rule");
  }

  void add(const CaseBody& body, const CaseMaterial& material) {
    if (body.shape.empty()) return;
    toml_.table("[[body]]", fmt::format("{}, {}", line_of(*body.statement), body.description));
    toml_.text_entry("name", body.name);
    toml_.entry("material", fmt::format("\"{}\"", material.file));
    if (body.velocity != Vector3::Zero()) toml_.entry("velocity", vector(body.velocity, dimension::velocity));
    if (material.explosive && deck_.last(Keyword::detonation) == nullptr) {
      toml_.entry("detonation", "\"instantaneous\"", "no point of detonation in the deck");
      remark(Outcome::missing, *body.statement,
             fmt::format("{} is lit by nothing: it starts as detonation products", body.name));
    }
    if (grouped_) toml_.entry("contact_group", fmt::format("\"component_{}\"", body.component));
    const double across = std::round(cell_ / body.spacing);
    if (body.is_given) {
      // Nothing is filled: the file holds the particles.
    } else if (across >= 1.0 && across <= 4.0) {
      if (across != 2.0)
        toml_.entry("discretization", fmt::format("{{ per_cell = {} }}", across * across * across));
    } else {
      remark(Outcome::converted, *body.statement,
             fmt::format("{}: {} spacings in a cell become 2", body.name, across));
    }
    toml_.entry("shape", body.shape);
    if (material.initial_pressure != 0.0) {
      toml_.entry("initial", fmt::format("{{ density = {}, pressure = {} }}",
                                         units_.quantity(material.density, dimension::density),
                                         units_.quantity(material.initial_pressure, dimension::pressure)));
    }
  }

  void detonation(bool explosive) {
    const std::vector<const Statement*> points = deck_.all(Keyword::detonation);
    for (const Statement* point : points) {
      if (!explosive) {
        remark(Outcome::dropped, *point, "no body is an explosive");
        continue;
      }
      const std::vector<double>& n = point->numbers;
      toml_.table("[[detonation]]", line_of(*point));
      toml_.entry("position", vector(Vector3(n[0], n[1], n[2]), dimension::length));
      remark(Outcome::exact, *point, "point of detonation");
    }
    if (!explosive || points.empty()) return;
    toml_.table("[burn]");
    toml_.entry("lighting", "\"straight\"", "as in that code");
  }

  void output() {
    toml_.table("[output]");
    if (const Statement* interval = one(Keyword::output_interval)) {
      if (!(interval->numbers[0] >= 0.0)) fault(interval->line, "'outt' must be >= 0");
      toml_.entry("snapshot_every", units_.quantity(interval->numbers[0], dimension::time),
                  line_of(*interval));
      remark(Outcome::exact, *interval, "output.snapshot_every");
    }
    // Maps fields of the deck to those of a snapshot; empty: no equivalent.
    static const std::map<std::string, std::string> names = {
        {"seqv", "von_mises_stress"}, {"epef", "plastic_strain"}, {"mat", "material"},
        {"pres", "pressure"},         {"volu", "volume"},         {"engi", "internal_energy"},
        {"velx", "velocity"},         {"vely", "velocity"},       {"velz", "velocity"},
        {"cels", "temperature"},      {"fail", "failed"},         {"sspd", "sound_speed"},
        {"damg", "damage"},           {"stsx", "stress"}};
    std::vector<std::string> fields;
    for (const Statement* field : deck_.all(Keyword::output_field)) {
      const auto found = names.find(field->kind);
      if (found == names.end()) {
        remark(Outcome::dropped, *field, "no field of snapshots");
        continue;
      }
      remark(Outcome::exact, *field, found->second);
      const std::string quoted = toml_string(found->second);
      if (std::ranges::find(fields, quoted) == fields.end()) fields.push_back(quoted);
    }
    if (!fields.empty()) toml_.entry("fields", fmt::format("[{}]", fmt::join(fields, ", ")));
    gauges();
  }

  void gauges() {
    std::set<std::array<double, 3>> places;
    for (const Statement* curve : deck_.all(Keyword::point_curve)) {
      const std::vector<double>& n = curve->numbers;
      remark(Outcome::converted, *curve, "a gauge that moves with the particle nearest to the point");
      if (!places.insert({n[0], n[1], n[2]}).second) continue;  // one gauge has all fields
      toml_.table("[[gauge]]", line_of(*curve));
      toml_.text_entry("name", fmt::format("gauge_{}", places.size()));
      toml_.entry("kind", "\"moving\"");
      toml_.entry("position", vector(Vector3(n[0], n[1], n[2]), dimension::length));
    }
  }

  /// Reports statements without corresponding keys of the case.
  void rest() {
    for (const Statement& statement : deck_.statements) {
      switch (statement.keyword) {
        case Keyword::report_interval:
        case Keyword::tecplot:
        case Keyword::paraview:
        case Keyword::window:
        case Keyword::particle_curve:
          remark(Outcome::dropped, statement, "output of that code");
          break;
        case Keyword::smoothed_stress:
        case Keyword::volume_by_deformation:
          remark(Outcome::dropped, statement,
                 "method of that code: smoothed stresses, volumes by the deformation gradient");
          break;
        case Keyword::total_lagrangian:
          remark(Outcome::missing, statement, "total Lagrangian method");
          break;
        case Keyword::staggered_grid:
          remark(Outcome::missing, statement, "staggered grid against volumetric locking");
          break;
        case Keyword::dynamic_relaxation:
          remark(Outcome::missing, statement, "dynamic relaxation: damping that the code adapts");
          break;
        default:
          break;  // the others already have remarks
      }
    }
    for (const auto& [line, text] : deck_.notes) import_.remark(Outcome::converted, line, "-", text);
  }

  const Deck& deck_;
  const ImportOptions& options_;
  Import import_;
  UnitSystem units_ = {"m", "kg", "s"};
  TomlText toml_;
  std::vector<CaseBody> bodies_;
  std::vector<InputFault> faults_;
  GridOfDeck grid_;
  double cell_ = 0.0;
  std::size_t written_materials_ = 0;
  bool grouped_ = false;
};

}  // namespace

Import to_case(const Deck& deck, const ImportOptions& options) { return CaseBuilder(deck, options).build(); }

}  // namespace whipple::decks::mpm3d
