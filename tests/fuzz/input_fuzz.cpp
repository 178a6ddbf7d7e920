// SPDX-License-Identifier: BSD-3-Clause
// Whatever a file holds, reading it succeeds or throws InputError: no crash, no other exception, no value out
// of its range. Run under the preset dev, the sanitizers watch as well.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/base/units.hpp"
#include "src/core/input/document.hpp"

namespace whipple::input {
namespace {

struct Everything {
  double size = 1.0;
  std::int64_t count = 1;
  bool active = false;
  std::string name = "n";
  std::string law = "a";
  Vector3 velocity = Vector3::Zero();
  std::vector<double> times;
  std::vector<std::string> fields;
};

const ParameterTable<Everything>& table() {
  static const ParameterTable<Everything> all = {
      real("size", &Everything::size, "m", range::positive(), "s"),
      integer("count", &Everything::count, range::between(1, 100), "c"),
      boolean("active", &Everything::active, "a").optional(),
      text("name", &Everything::name, "n").optional(),
      choice("law", &Everything::law, {"a", "b"}, "l").optional(),
      vector("velocity", &Everything::velocity, "m/s", range::any(), "v").optional(),
      real_list("times", &Everything::times, "s", range::non_negative(), "t").optional(),
      text_list("fields", &Everything::fields, {"x", "y"}, "f").optional()};
  return all;
}

const std::string seed_text =
    "title = \"Copper disk\"\n"
    "[domain]\n"
    "size = \"0.5 mm\"\n"
    "count = 12\n"
    "active = true\n"
    "name = 'plate'   # a comment\n"
    "law = \"b\"\n"
    "velocity = [\"0 m/s\", \"5.55 km/s\", -1e-3]\n"
    "times = [\"1 us\", 2.5e-6]\n"
    "fields = [\"x\", \"y\"]\n"
    "shape = { cylinder = { center = [0, 0, 1], size = \"1 m\", count = 1 } }\n"
    "[[body]]\n"
    "size = \"1e-3 m\"\n"
    "count = 3\n"
    "[[body]]\n"
    "size = 2\n"
    "count = 4\n"
    "[provenance]\n"
    "date = 2024-05-01T12:00:00Z\n"
    "note = \"\"\"several\nlines\"\"\"\n";

const std::vector<std::string> dictionary = {
    "[",          "]",       "[[",        "]]", "{",       "}",      "=",          "\"",
    "\"\"\"",     "'",       "#",         "\n", ",",       ".",      "domain",     "body",
    "size",       "inf",     "nan",       "-",  "1e999",   "1e-999", "0x7f",       "99999999999999999999",
    "true",       "m/s",     "kg^99",     "%",  "\\u0000", "\xff",   "\xc3\x28",   "\\",
    "2024-13-45", "\"3 m\"", "\"m m m\"", "^",  "degC",    "[[[[[[", "a.b.c = 1\n"};

class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : random_(seed) {}

  std::string operator()(std::string text) {
    const int changes = 1 + static_cast<int>(below(6));
    for (int i = 0; i < changes; ++i) change(text);
    return text;
  }
  std::size_t below(std::size_t end) {
    return std::uniform_int_distribution<std::size_t>(0, end - 1)(random_);
  }

 private:
  void change(std::string& text) {
    const std::size_t at = below(text.size() + 1);
    const std::size_t length = std::min(text.size() - at, below(12) + 1);
    switch (below(6)) {
      case 0:
        text.insert(at, dictionary[below(dictionary.size())]);
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, 1, static_cast<char>(below(256)));
        break;
      case 3:
        if (at < text.size()) text[at] = static_cast<char>(below(256));
        break;
      case 4:
        text.insert(below(text.size() + 1), text.substr(at, length));
        break;
      default:
        text.replace(at, length, dictionary[below(dictionary.size())]);
    }
  }

  std::mt19937_64 random_;
};

void expect_admissible(const Everything& read) {
  EXPECT_GT(read.size, 0.0);
  EXPECT_GE(read.count, 1);
  EXPECT_LE(read.count, 100);
  EXPECT_TRUE(read.law == "a" || read.law == "b");
  EXPECT_TRUE(read.velocity.allFinite());
  for (const double time : read.times) EXPECT_GE(time, 0.0);
}

void read_everything(Document& document) {
  Table root = document.root();
  root.accept("title");
  root.accept("provenance");
  Everything domain;
  if (auto found = root.required_table("domain")) {
    found->read(table(), domain);
    expect_admissible(domain);
    if (auto shape = found->optional_table("shape")) {
      for (const std::string& name : shape->table_names()) {
        Everything part;
        if (auto inner = shape->optional_table(name)) inner->read(table(), part);
        expect_admissible(part);
      }
    }
  }
  for (Table& body : root.list("body")) {
    Everything one;
    body.read(table(), one);
    body.choice("law", std::vector<std::string>{"a", "b"}, "a");
    expect_admissible(one);
  }
  document.finish();
}

/// Counts of both outcomes: a fuzzer whose inputs all fail at the first character would prove little.
struct Outcomes {
  int accepted = 0;
  int refused = 0;
};

template <class Body>
void count(Outcomes& outcomes, const std::string& input, Body body) {
  try {
    body();
    ++outcomes.accepted;
  } catch (const InputError& error) {
    EXPECT_STRNE(error.what(), "");
    ++outcomes.refused;
  } catch (const std::exception& error) {
    FAIL() << "not an InputError: " << error.what() << "\ninput:\n" << input;
  }
}

TEST(Fuzz, TheSeedItselfLacksNothingButTheShapesKeys) {
  Document document = Document::from_text(seed_text, "seed.toml");
  try {
    read_everything(document);
    FAIL() << "the key 'center' is unknown";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
  }
}

TEST(Fuzz, MutatedDocuments) {
  Mutator mutate(1);
  Outcomes outcomes;
  std::string seed = seed_text;
  seed.erase(seed.find("center = [0, 0, 1], "), 20);
  for (int i = 0; i < 8000; ++i) {
    const std::string text = mutate(seed);
    count(outcomes, text, [&] {
      Document document = Document::from_text(text, "fuzz.toml");
      read_everything(document);
    });
  }
  EXPECT_GT(outcomes.accepted, 100);
  EXPECT_GT(outcomes.refused, 1000);
}

TEST(Fuzz, MutatedOverrides) {
  Mutator mutate(2);
  Outcomes outcomes;
  const std::vector<std::pair<std::string, std::string>> seeds = {{"domain.size", "0.3 mm"},
                                                                  {"body.1.count", "7"},
                                                                  {"domain.shape.cylinder.size", "2"},
                                                                  {"title", "\"x\""}};
  for (int i = 0; i < 4000; ++i) {
    auto [key, value] = seeds[mutate.below(seeds.size())];
    if (mutate.below(2) == 0) key = mutate(key);
    if (mutate.below(2) == 0) value = mutate(value);
    count(outcomes, key + " = " + value, [&, &set_key = key, &set_value = value] {
      Document document = Document::from_text(seed_text, "fuzz.toml");
      document.set(set_key, set_value);
      read_everything(document);
    });
  }
  EXPECT_GT(outcomes.refused, 1000);
}

TEST(Fuzz, MutatedQuantities) {
  Mutator mutate(3);
  Outcomes outcomes;
  const std::vector<std::string> seeds = {"6.58 km/s", "0.05 Mbar cm3/g", "25 degC",
                                          "1 eV",      "8.93 g/cc",       "1e-3"};
  for (int i = 0; i < 20000; ++i) {
    const std::string text = mutate(seeds[mutate.below(seeds.size())]);
    count(outcomes, text, [&] {
      const double value = units::parse_quantity(text, "m/s");
      EXPECT_TRUE(std::isfinite(value)) << text;
    });
  }
  EXPECT_GT(outcomes.accepted, 100);
  EXPECT_GT(outcomes.refused, 1000);
}

}  // namespace
}  // namespace whipple::input
