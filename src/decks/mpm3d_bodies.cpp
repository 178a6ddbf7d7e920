// SPDX-License-Identifier: BSD-3-Clause
#include "src/decks/mpm3d_bodies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_set>

#include "src/core/base/error.hpp"
#include "src/decks/lattice.hpp"
#include "src/decks/points.hpp"

namespace whipple::decks::mpm3d {
namespace {

constexpr std::size_t most_boxes = 400;  // of a body of points
constexpr double most_counted =
    2000;  // spacings along a radius: larger round bodies are not counted particle by particle

/// Holds the numbers of the particles of the deck that belong to a body: a range, or those of its points.
struct Numbers {
  double first = 0.0, last = 0.0;
  std::unordered_set<int> points;

  [[nodiscard]] bool holds(double number) const {
    return points.empty() ? number >= first && number <= last : points.contains(whole(number));
  }
};

/// Returns half the number of centres -0.5, -1.5, ... 0.5, 1.5, ... within a half-chord.
double centres_within(double half_chord) { return half_chord <= 0.5 ? 0.0 : std::ceil(half_chord - 0.5); }

double discs_particles(double radius) {
  double count = 0.0;
  for (double x = 0.5; x < radius; ++x) count += 4.0 * centres_within(std::sqrt(radius * radius - x * x));
  return count;
}

double spheres_particles(double radius) {
  if (radius > most_counted / 4) return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
  double count = 0.0;
  for (double x = 0.5; x < radius; ++x) {
    for (double y = 0.5; x * x + y * y < radius * radius; ++y) {
      count += 8.0 * centres_within(std::sqrt(radius * radius - x * x - y * y));
    }
  }
  return count;
}

class BodyBuilder {
 public:
  BodyBuilder(const Deck& deck, const std::map<int, double>& density, const UnitSystem& units,
              const BodyOptions& options, Import& import)
      : deck_(deck), density_(density), units_(units), options_(options), import_(import) {}

  std::vector<CaseBody> build() {
    for (const Statement* statement : deck_.all(Keyword::body)) {
      try {
        add(*statement);
      } catch (const InputError& error) {
        faults_.insert(faults_.end(), error.faults().begin(), error.faults().end());
      }
    }
    velocities();
    if (!faults_.empty()) throw InputError(std::move(faults_));
    return std::move(bodies_);
  }

 private:
  [[nodiscard]] InputFault fault(const Statement& statement, std::string text) const {
    return {.file = deck_.file.string(), .line = statement.line, .column = 1, .text = std::move(text)};
  }
  [[noreturn]] void fail(const Statement& statement, std::string text) const {
    throw InputError(std::vector<InputFault>{fault(statement, std::move(text))});
  }
  [[nodiscard]] std::string length(double value) const { return units_.quantity(value, dimension::length); }
  [[nodiscard]] std::string point(const Vector3& x) const {
    return fmt::format("[{}, {}, {}]", length(x[0]), length(x[1]), length(x[2]));
  }
  [[nodiscard]] std::string box(const Vector3& lower, const Vector3& upper) const {
    return fmt::format("{{ box = {{ lower = {}, upper = {} }} }}", point(lower), point(upper));
  }

  double material_density(const Statement& statement, int material) const {
    const auto found = density_.find(material);
    if (found == density_.end())
      fail(statement, fmt::format("material {} is not among those of 'mate'", material));
    return found->second;
  }
  /// Returns a number of spacings or cells along a direction.
  double positive(const Statement& statement, std::size_t at, const char* what) const {
    const double value = statement.numbers[at];
    if (!(value > 0.0) || value > 1e6)
      fail(statement, fmt::format("{} is {}, must be > 0 and <= 1e6", what, number(value)));
    return value;
  }

  void add(const Statement& statement) {
    CaseBody body;
    body.statement = &statement;
    body.name = fmt::format("body_{}", bodies_.size() + 1);
    body.component = whole(statement.numbers[0]);
    Numbers numbers;
    if (statement.kind == "poin") {
      points(statement, body, numbers);
    } else {
      shape(statement, body);
      numbers.first = ranged_ + 1.0;
      numbers.last = ranged_ += body.particles;
    }
    import_.bodies.push_back(
        {body.name, body.description, body.particles, units_.in_si(body.mass, {.mass = 1})});
    bodies_.push_back(std::move(body));
    numbers_.push_back(std::move(numbers));
  }

  void shape(const Statement& statement, CaseBody& body) {
    const std::vector<double>& n = statement.numbers;
    body.material = whole(n[1]);
    const double density = material_density(statement, body.material);
    const double h = body.spacing = positive(statement, 3, "the spacing of the particles");
    const Vector3 origin(n[4], n[5], n[6]);
    if (statement.kind == "bloc" || statement.kind == "blod") {
      Vector3 counts;
      for (int i = 0; i < 3; ++i)
        counts[i] = std::trunc(positive(statement, 7 + static_cast<std::size_t>(i), "a number of particles"));
      body.lower = origin;
      body.upper = origin + h * counts;
      body.particles = counts.prod();
      body.shape = box(body.lower, body.upper);
      body.description = fmt::format("block of {} x {} x {} particles", counts[0], counts[1], counts[2]);
      if (statement.kind == "blod") cut_hole(statement, body, counts);
    } else {
      const double spacings = positive(statement, 7, "the radius in spacings");
      const bool sphere = statement.kind == "sphe";
      const double radius = spacings * h, half_height = sphere ? radius : 0.5 * h;
      body.lower = origin - Vector3(radius, radius, half_height);
      body.upper = origin + Vector3(radius, radius, half_height);
      body.particles = sphere ? spheres_particles(spacings) : discs_particles(spacings);
      body.description = fmt::format("{} of radius {} {}", sphere ? "sphere" : "one layer of a disc",
                                     number(radius), units_.length);
      body.shape =
          sphere ? fmt::format("{{ sphere = {{ center = {}, radius = {} }} }}", point(origin), length(radius))
                 : fmt::format("{{ cylinder = {{ center = {}, axis = \"z\", radius = {}, height = {} }} }}",
                               point(origin), length(radius), length(h));
    }
    density_or_mass(statement, body, density);
    import_.remark(Outcome::converted, statement.line, statement.name(),
                   fmt::format("{}: {}, as a shape that is filled again", body.name, body.description));
  }

  void cut_hole(const Statement& statement, CaseBody& body, const Vector3& counts) {
    const std::vector<double>& n = statement.numbers;
    const double h = body.spacing,
                 radius = h * std::trunc(positive(statement, 13, "the radius of the hole in spacings"));
    const Vector3 centre(n[10], n[11], 0.5 * (body.lower[2] + body.upper[2]));
    if (counts[0] * counts[1] <= most_counted * most_counted) {
      double layer = 0.0;
      for (double i = 0.5; i < counts[0]; ++i) {
        for (double j = 0.5; j < counts[1]; ++j) {
          layer += std::hypot(n[4] + i * h - n[10], n[5] + j * h - n[11]) >= radius ? 1.0 : 0.0;
        }
      }
      body.particles = layer * counts[2];
    }
    // Longer than the block: with coplanar faces the result would be ambiguous.
    const double height = body.upper[2] - body.lower[2] + 2.0 * h;
    body.shape = fmt::format(
        "{{ difference = {{ from = {}, minus = [{{ cylinder = {{ center = {}, axis = \"z\", radius = {}, "
        "height = {} }} }}] }} }}",
        body.shape, point(centre), length(radius), length(height));
    body.description += fmt::format(" with a hole of radius {} {}", number(radius), units_.length);
  }

  /// Reads the number after the material: the density of the particles, until 2013-12 their mass.
  void density_or_mass(const Statement& statement, CaseBody& body, double material) {
    const double given = statement.numbers[2], volume = body.spacing * body.spacing * body.spacing;
    const auto near = [](double left, double right, double tolerance) {
      return std::abs(left - right) <= tolerance * std::abs(right);
    };
    const bool like_mass = near(given, material * volume, 0.02);
    if (options_.old_mass && like_mass) {
      body.mass = body.particles * given;
      import_.remark(Outcome::converted, statement.line, statement.name(),
                     fmt::format("{} is taken for the mass of a particle (--old-mass)", number(given)));
      return;
    }
    body.mass = body.particles * given * volume;
    if (near(given, material, 1e-6)) return;
    import_.remark(
        Outcome::missing, statement.line, statement.name(),
        fmt::format(
            "{}: density {} of the particles is not that of material {}, {}{}", body.name, number(given),
            body.material, number(material),
            like_mass
                ? "; it looks like the mass of a particle of the old format: --old-mass takes it for that"
                : ""));
  }

  void points(const Statement& statement, CaseBody& body, Numbers& numbers) {
    const std::vector<double>& n = statement.numbers;
    std::vector<Vector3> places;
    std::vector<double> masses;
    double least = 0.0, greatest = 0.0;
    bool mixed = false;
    for (std::size_t i = 1; i < n.size(); i += 6) {
      numbers.points.insert(whole(n[i]));
      if (places.empty()) {
        body.material = whole(n[i + 1]);
        least = greatest = n[i + 2];
        body.lower = body.upper = Vector3(n[i + 3], n[i + 4], n[i + 5]);
      }
      mixed = mixed || whole(n[i + 1]) != body.material;
      least = std::min(least, n[i + 2]);
      greatest = std::max(greatest, n[i + 2]);
      body.mass += n[i + 2];
      masses.push_back(n[i + 2]);
      places.emplace_back(n[i + 3], n[i + 4], n[i + 5]);
      body.lower = body.lower.cwiseMin(places.back());
      body.upper = body.upper.cwiseMax(places.back());
    }
    const double density = material_density(statement, body.material);
    body.particles = static_cast<double>(places.size());
    body.spacing = std::cbrt(greatest / density);
    body.description = fmt::format("{} points", places.size());
    const bool alike = !mixed && least > 0.0 && greatest - least <= 1e-3 * greatest;
    const auto boxes = alike ? boxes_of_points(places, body.spacing, most_boxes) : std::nullopt;
    if (!boxes && !mixed) body.shape = shape_of_points(import_, body.name, units_, places, masses);
    body.is_given = !body.shape.empty();
    if (boxes || body.is_given) {
      body.lower -= Vector3::Constant(0.5 * body.spacing);
      body.upper += Vector3::Constant(0.5 * body.spacing);
    }
    if (!boxes) {
      import_.remark(body.is_given ? Outcome::converted : Outcome::missing, statement.line, statement.name(),
                     fmt::format("{}: {} points that fill no cubic lattice of equal particles{}", body.name,
                                 places.size(),
                                 body.is_given ? ": its particles, in a file"
                                 : mixed       ? ", of several materials"
                                               : ", some without mass"));
      return;
    }
    std::string list;
    for (const LatticeBox& each : *boxes) list += (list.empty() ? "" : ",\n  ") + box(each.lower, each.upper);
    body.shape = boxes->size() == 1 ? list : fmt::format("{{ union = [{}] }}", list);
    body.description +=
        fmt::format(" of a cubic lattice, {} box{}", boxes->size(), boxes->size() == 1 ? "" : "es");
    import_.remark(Outcome::converted, statement.line, statement.name(),
                   fmt::format("{}: {}", body.name, body.description));
  }

  void velocities() {
    struct Common {
      Vector3 velocity = Vector3::Zero();
      double particles = 0.0;
      bool one = true;
      unsigned line = 0;
    };
    std::vector<Common> given(bodies_.size());
    for (const Statement* statement : deck_.all(Keyword::velocity)) {
      const std::vector<double>& n = statement->numbers;
      if (statement->kind == "body") {
        if (n[0] < 1.0 || n[0] >= static_cast<double>(bodies_.size()) + 1.0) {
          faults_.push_back(fault(*statement, fmt::format("there is no body {} ({} 'part' above it)",
                                                          number(n[0]), bodies_.size())));
          continue;
        }
        CaseBody& body = bodies_[static_cast<std::size_t>(n[0]) - 1];
        body.velocity = Vector3(n[1], n[2], n[3]);
        import_.remark(Outcome::exact, statement->line, statement->name(),
                       fmt::format("velocity of {}", body.name));
      } else if (statement->kind == "node") {
        const auto found =
            std::ranges::find_if(numbers_, [&](const Numbers& numbers) { return numbers.holds(n[0]); });
        if (found == numbers_.end()) {
          faults_.push_back(fault(*statement, fmt::format("there is no particle {}", number(n[0]))));
          continue;
        }
        Common& common = given[static_cast<std::size_t>(found - numbers_.begin())];
        const Vector3 velocity(n[1], n[2], n[3]);
        common.one = common.one && (common.particles == 0.0 || common.velocity == velocity);
        common.velocity = velocity;
        if (common.particles++ == 0.0) common.line = statement->line;
      } else {
        import_.remark(Outcome::missing, statement->line, statement->name(),
                       "built-in velocity field of a test of that code");
      }
    }
    for (std::size_t i = 0; i < given.size(); ++i) {
      const Common& common = given[i];
      if (common.particles == 0.0) continue;
      const bool whole = common.one && common.particles >= bodies_[i].particles;
      if (whole) bodies_[i].velocity = common.velocity;
      import_.remark(
          whole ? Outcome::converted : Outcome::missing, common.line, "velo node",
          whole ? fmt::format("all particles of {} have one velocity: that of the body", bodies_[i].name)
                : fmt::format("velocities of {} particles of {} one by one", common.particles,
                              bodies_[i].name));
    }
  }

  const Deck& deck_;
  const std::map<int, double>& density_;
  const UnitSystem& units_;
  const BodyOptions& options_;
  Import& import_;
  std::vector<CaseBody> bodies_;
  std::vector<Numbers> numbers_;  ///< of each body
  std::vector<InputFault> faults_;
  double ranged_ = 0.0;  ///< particles of blocks, spheres and discs so far
};

}  // namespace

std::vector<CaseBody> bodies_of(const Deck& deck, const std::map<int, double>& density,
                                const UnitSystem& units, const BodyOptions& options, Import& import) {
  return BodyBuilder(deck, density, units, options, import).build();
}

}  // namespace whipple::decks::mpm3d
