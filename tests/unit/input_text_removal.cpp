// SPDX-License-Identifier: BSD-3-Clause
// Keys, tables and entries of lists taken out of the text of a file and added to it; of every case, every key.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/input/text_edit.hpp"
#include "src/core/input/text_tree.hpp"
#include "tests/folders.hpp"

namespace whipple::input {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

constexpr const char* removal_text =
    "title = \"Scheibe µ\"  # of the case\n"
    "\n"
    "[domain]\n"
    "cell_size = \"1 mm\"   # coarse\n"
    "boundary.x_lower = \"symmetry\"\n"
    "lower = [\"0 mm\", # left\n"
    "         \"-1 mm\", \"-1 mm\"]  # corner\n"
    "\n"
    "# The disk, from the left.\n"
    "[[body]]\n"
    "name = \"disk [1], {2} # µ\"\n"
    "shape = { sphere = { center = [0, 0, 0], radius = \"2 mm\" } } # round\n"
    "[body.initial]\n"
    "temperature = \"300 K\"\n"
    "[[body.node_condition]]\n"
    "directions = [\"x\"]\n"
    "[[body.node_condition]]\n"
    "directions = [\"y\"]\n"
    "\n"
    "# The plate.\n"
    "[[body]]\n"
    "name = \"plate\"\n"
    "shape.union = [{ box = { upper = [\"1, 2\", 3] } }, # a box\n"
    "               { sphere = {} }]\n"
    "\n"
    "[time]\n"
    "end = \"5 us\"\n";

std::string without_key(const std::string& before, const std::string& key) {
  try {
    return remove_from_text(before, "case.toml", key).text;
  } catch (const InputError& error) {
    return error.what();
  }
}

std::string with_table(const std::string& before, const std::string& key, bool is_list = true) {
  try {
    return add_table_to_text(before, "case.toml", key, is_list).text;
  } catch (const InputError& error) {
    return error.what();
  }
}

std::string piece_replaced(std::string before, const std::string& piece, const std::string& other) {
  const std::size_t at = before.find(piece);
  EXPECT_NE(at, std::string::npos) << piece;
  return before.replace(at, piece.size(), other);
}

TEST(TextRemoval, TakesOutKeysWithTheirLines) {
  EXPECT_EQ(without_key(removal_text, "title"),
            piece_replaced(removal_text, "title = \"Scheibe µ\"  # of the case\n", ""));
  EXPECT_EQ(without_key(removal_text, "domain.cell_size"),
            piece_replaced(removal_text, "cell_size = \"1 mm\"   # coarse\n", ""));
  EXPECT_EQ(without_key(removal_text, "domain.boundary.x_lower"),
            piece_replaced(removal_text, "boundary.x_lower = \"symmetry\"\n", ""));
  EXPECT_EQ(without_key(removal_text, "domain.boundary"),
            piece_replaced(removal_text, "boundary.x_lower = \"symmetry\"\n", ""));
  EXPECT_EQ(without_key(removal_text, "domain.lower"),
            piece_replaced(removal_text,
                           "lower = [\"0 mm\", # left\n         \"-1 mm\", \"-1 mm\"]  # corner\n", ""));
  EXPECT_EQ(without_key("a = 1\r\nb = 2\r\n", "b"), "a = 1\r\n");
  EXPECT_EQ(without_key("a = 1", "a"), "");
}

TEST(TextRemoval, TakesOutKeysInBraces) {
  EXPECT_EQ(without_key(removal_text, "body.0.shape.sphere.center"),
            piece_replaced(removal_text, "center = [0, 0, 0], ", ""));
  EXPECT_EQ(without_key(removal_text, "body.0.shape.sphere.radius"),
            piece_replaced(removal_text, ", radius = \"2 mm\"", ""));
  EXPECT_EQ(without_key(removal_text, "body.1.shape.union.0.box.upper"),
            piece_replaced(removal_text, "{ upper = [\"1, 2\", 3] }", "{}"));
  EXPECT_EQ(without_key("s = { \"a,{b\" = 1, c.d = 2 }\n", "s.a,{b"), "s = { c.d = 2 }\n");
  EXPECT_EQ(without_key("s = { \"a,{b\" = 1, c.d = 2 }\n", "s.c.d"), "s = { \"a,{b\" = 1 }\n");
}

TEST(TextRemoval, TakesOutEntriesOfLists) {
  EXPECT_EQ(without_key(removal_text, "domain.lower.0"),
            piece_replaced(removal_text, "[\"0 mm\", # left\n         \"-1 mm\", ",
                           "[# left\n         \"-1 mm\", "));
  EXPECT_EQ(without_key(removal_text, "domain.lower.2"), piece_replaced(removal_text, ", \"-1 mm\"]", "]"));
  EXPECT_EQ(without_key(removal_text, "body.1.shape.union.1"),
            piece_replaced(removal_text, "               { sphere = {} }]", "               ]"));
  EXPECT_EQ(without_key(removal_text, "body.0.node_condition.0"),
            piece_replaced(removal_text, "[[body.node_condition]]\ndirections = [\"x\"]\n", ""));
  EXPECT_EQ(without_key(removal_text, "body.1"),
            piece_replaced(
                removal_text,
                "[[body]]\nname = \"plate\"\nshape.union = [{ box = { upper = [\"1, 2\", 3] } }, # a box\n"
                "               { sphere = {} }]\n\n",
                ""));
}

TEST(TextRemoval, TakesOutTablesOfSeveralLines) {
  EXPECT_EQ(without_key(removal_text, "time"),
            piece_replaced(removal_text, "\n[time]\nend = \"5 us\"\n", ""));
  EXPECT_EQ(without_key(removal_text, "time.end"),
            piece_replaced(removal_text, "\n[time]\nend = \"5 us\"\n", ""));
  EXPECT_EQ(without_key("[time]\n# why\nend = 1\n", "time.end"), "[time]\n# why\n");
  EXPECT_EQ(without_key(removal_text, "body.0.initial"),
            piece_replaced(removal_text, "[body.initial]\ntemperature = \"300 K\"\n", ""));
  EXPECT_EQ(without_key("[a.b]\nc = 1\n[a.d]\ne = 1\n[f]\n", "a"), "[f]\n");
  EXPECT_THAT(without_key(removal_text, "domain.upper"), HasSubstr("there is no 'domain.upper'"));
  EXPECT_THAT(without_key(removal_text, "body.2"), HasSubstr("there is no 'body.2'"));
}

TEST(TextRemoval, AddsTablesAndEntries) {
  EXPECT_EQ(with_table(removal_text, "body"),
            piece_replaced(removal_text, "{ sphere = {} }]\n", "{ sphere = {} }]\n\n[[body]]\n"));
  EXPECT_EQ(with_table(removal_text, "body.0.node_condition"),
            piece_replaced(removal_text, "directions = [\"y\"]\n",
                           "directions = [\"y\"]\n\n[[body.node_condition]]\n"));
  EXPECT_EQ(with_table(removal_text, "body.1.initial", false),
            piece_replaced(removal_text, "{ sphere = {} }]\n", "{ sphere = {} }]\n\n[body.initial]\n"));
  EXPECT_EQ(with_table(removal_text, "body.1.shape.union"),
            piece_replaced(removal_text, "{ sphere = {} }]", "{ sphere = {} }, {}]"));
  EXPECT_EQ(with_table("l = [ # none\n]\n", "l"), "l = [ # none\n{}]\n");
  EXPECT_EQ(with_table("l = [{ a = 1 }, # one\n]\n", "l"), "l = [{ a = 1 }, # one\n{}]\n");
  EXPECT_EQ(with_table("s = { }\n", "s.l"), "s = { l = [{}] }\n");
  EXPECT_EQ(with_table("", "body"), "[[body]]\n");
  EXPECT_EQ(with_table("a = 1", "heat", false), "a = 1\n\n[heat]\n");
  EXPECT_THAT(with_table(removal_text, "time", false), HasSubstr("there is a 'time' already"));
  EXPECT_THAT(with_table(removal_text, "title"), HasSubstr("there is a 'title' already"));
}

/// The content of a tree without its places.
json content(const json& tree) {
  if (tree.contains("keys")) {
    json table = json::object();
    for (const auto& [key, next] : tree["keys"].items()) table[key] = content(next);
    return table;
  }
  if (tree.contains("list")) {
    json list = json::array();
    for (const json& next : tree["list"]) list.push_back(content(next));
    return list;
  }
  return tree["value"];
}
json content_of(const std::string& text) { return content(tree_of_text(text, "case.toml")); }

struct Key {
  std::string path, kind, text;  ///< "body.0.name"; "body.*.name"; as in the file, empty: a table of lines
};

void collect(const json& tree, const Key& at, std::vector<Key>& keys) {
  const auto below = [&](const std::string& part, const std::string& kind, const json& next) {
    const std::string dot = at.path.empty() ? "" : ".";
    const Key key = {at.path + dot + part, at.kind + dot + kind, next.value("text", "")};
    keys.push_back(key);
    collect(next, key, keys);
  };
  if (tree.contains("keys")) {
    for (const auto& [key, next] : tree["keys"].items()) below(key, key, next);
  } else if (tree.contains("list")) {
    for (std::size_t i = 0; i < tree["list"].size(); ++i) below(std::to_string(i), "*", tree["list"][i]);
  }
}
std::vector<Key> keys_of(const std::string& text) {
  std::vector<Key> keys;
  collect(tree_of_text(text, "case.toml"), {}, keys);
  return keys;
}

std::map<std::string, std::string> shipped_cases() {
  std::map<std::string, std::string> texts;
  for (const auto& folder : fs::directory_iterator(fs::path(whipple::tests::source_folder()) / "cases")) {
    const fs::path file = folder.path() / "case.toml";
    if (fs::exists(file)) texts[folder.path().filename().string()] = whipple::read_text(file);
  }
  return texts;
}

/// The lines of a text that are comments alone.
std::multiset<std::string> comments_of(const std::string& text) {
  std::multiset<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with('#')) lines.insert(line);
  }
  return lines;
}

json::json_pointer pointer_of(const std::string& path) {
  std::string pointer = "/" + path;
  std::ranges::replace(pointer, '.', '/');
  return json::json_pointer(pointer);
}

TEST(TextRemoval, EveryKeyOfEveryCaseIsRemovedAndSetAgain) {
  std::size_t count = 0;
  for (const auto& [name, text] : shipped_cases()) {
    SCOPED_TRACE(name);
    const json before = content_of(text);
    for (const Key& key : keys_of(text)) {
      SCOPED_TRACE(key.path);
      const std::string removed = remove_from_text(text, name, key.path).text;
      json expected = before, found = content_of(removed);
      const json::json_pointer at = pointer_of(key.path);
      if (!expected.at(at.parent_pointer()).is_array()) {
        expected.at(at.parent_pointer()).erase(at.back());
        if (found.contains(at.parent_pointer())) {  // else its header went with it
          ASSERT_EQ(found, expected);
        } else {
          ASSERT_TRUE(expected.at(at.parent_pointer()).empty());
        }
      } else if (found.contains(at.parent_pointer())) {
        ASSERT_EQ(found.at(at.parent_pointer()).size() + 1, before.at(at.parent_pointer()).size());
      }
      if (key.text.empty() || key.kind.ends_with('*')) continue;
      ASSERT_EQ(comments_of(removed), comments_of(text));
      const std::string again = set_in_text(removed, name, key.path, key.text).text;
      ASSERT_EQ(content_of(again), before);
      ASSERT_EQ(comments_of(again), comments_of(text));
      ++count;
    }
  }
  EXPECT_GT(count, 1000U);
  RecordProperty("keys", std::to_string(count));
}

TEST(TextRemoval, KeysOfOtherCasesAreSetAndRemovedAgain) {
  const std::map<std::string, std::string> cases = shipped_cases();
  std::map<std::string, std::string> known;  // a value of each kind of key
  for (const auto& [name, text] : cases) {
    for (const Key& key : keys_of(text)) {
      if (!key.text.empty() && !key.kind.ends_with('*')) known[key.kind] = key.text;
    }
  }
  std::size_t count = 0, turn = 0;
  for (const auto& [name, text] : cases) {
    SCOPED_TRACE(name);
    const json before = content_of(text);
    for (const auto& [wildcards, value] : known) {
      std::string kind = wildcards;
      for (std::size_t star = kind.find('*'); star != std::string::npos; star = kind.find('*'))
        kind[star] = '0';
      SCOPED_TRACE(kind);
      const json::json_pointer at = pointer_of(kind);
      constexpr std::size_t share = 8;  // of the keys, others in the next case
      if (before.contains(at) || ++turn % share != 0) continue;
      std::string with_key;
      try {
        with_key = set_in_text(text, name, kind, value).text;
      } catch (const InputError&) {
        continue;  // of a list that this case does not have
      }
      ASSERT_TRUE(content_of(with_key).contains(at));
      ASSERT_EQ(comments_of(with_key), comments_of(text));
      const std::string removed = remove_from_text(with_key, name, kind).text;
      json found = content_of(removed);
      // Braces that were made for the key stay: which shape a body has is a key without keys.
      for (json::json_pointer empty = at.parent_pointer();
           !empty.empty() && !before.contains(empty) && found.contains(empty);
           empty = empty.parent_pointer()) {
        ASSERT_TRUE(found.at(empty).empty());
        found.at(empty.parent_pointer()).erase(empty.back());
      }
      ASSERT_EQ(found, before);
      ASSERT_EQ(comments_of(removed), comments_of(text));
      ++count;
    }
  }
  EXPECT_GT(count, 500U);
  RecordProperty("keys", std::to_string(count));
}

// Edits one after another: the content follows that of a JSON document on which the same is done.
TEST(TextRemoval, ManyEditsOneAfterAnother) {
  std::mt19937 random(5);
  std::size_t count = 0;
  for (const auto& [name, original] : shipped_cases()) {
    SCOPED_TRACE(name);
    std::string text = original;
    for (int step = 0; step < 20; ++step) {
      const std::vector<Key> keys = keys_of(text);
      if (keys.empty()) break;
      const Key& key = keys[random() % keys.size()];
      SCOPED_TRACE(key.path);
      const json::json_pointer at = pointer_of(key.path);
      json expected = content_of(text);
      if (key.text.empty() || random() % 3 == 0) {
        text = remove_from_text(text, name, key.path).text;
        continue;
      }
      text = set_in_text(text, name, key.path, "\"# new, [value] = { }\"").text;
      expected.at(at) = "# new, [value] = { }";
      ASSERT_EQ(content_of(text), expected);
      ++count;
    }
  }
  EXPECT_GT(count, 100U);
}

}  // namespace
}  // namespace whipple::input
