// SPDX-License-Identifier: BSD-3-Clause
// The page that edits a case, without a network: its questions, its file, damaged questions.
#include "src/editor/editor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "src/core/base/files.hpp"
#include "src/core/base/json.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace whipple::editor {
namespace {

namespace fs = std::filesystem;
using monitor::Response;
using nlohmann::json;
using ::testing::HasSubstr;

const std::string token(32, 'a');

constexpr const char* edited_text =
    "# A disk on a plate.\n"
    "title = \"disk\"  # short\n"
    "\n"
    "[domain]  # half of it\n"
    "cell_size = \"1 mm\"  # coarse\n"
    "\n"
    "# The disk.\n"
    "[[body]]\n"
    "name = \"disk\"  # from above\n"
    "shape = { sphere = { radius = \"2 mm\" } }  # round\n";

/// An editor of a file in a folder of its own; `cases` below it is the library.
class EditorTest : public ::testing::Test {
 protected:
  fs::path file() const { return folder_.path() / "case.toml"; }
  Editor editor(const fs::path& program = "/bin/true") const {
    return Editor(CaseFile(file()), {.host = "127.0.0.1:1", .token = token},
                  {.schema = "{\"b\": 1, \"a\": 2}",
                   .suggestions = json::object(),
                   .cases = folder_.path() / "cases",
                   .program = program,
                   .page = folder_.path(),
                   .viewer = folder_.path(),
                   .monitor = folder_.path()});
  }
  static Response ask(Editor& editor, const std::string& target, const json& body) {
    return editor.handle({.changes = true,
                          .target = target,
                          .host = "127.0.0.1:1",
                          .origin = {},
                          .site = {},
                          .token = token,
                          .content_type = "application/json",
                          .body = body.dump()});
  }
  static json answer(Editor& editor, const std::string& target, const json& body) {
    const Response response = ask(editor, target, body);
    EXPECT_LT(response.status, 300) << response.body;
    return parse_json(response.body);
  }
  static json content(Editor& editor) {
    return parse_json(editor
                          .handle({.changes = false,
                                   .target = "/case",
                                   .host = "127.0.0.1:1",
                                   .origin = {},
                                   .site = {},
                                   .token = token,
                                   .content_type = {},
                                   .body = {}})
                          .body);
  }

  TemporaryFolder folder_;
};

std::string comments(const std::string& text) {
  std::string all;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t mark = line.find('#');
    if (mark != std::string::npos) all += line.substr(mark) + "\n";
  }
  return all;
}

TEST_F(EditorTest, KeepsCommentsOverManyEdits) {
  Editor page = editor();
  std::string text = edited_text;
  for (int n = 0; n < 20; ++n) {
    const std::string cell = std::to_string(n + 2) + " mm";
    const json done = answer(page, "/edit",
                             {{"text", text},
                              {"acts",
                               {{{"act", "set"}, {"key", "domain.cell_size"}, {"value", "\"" + cell + "\""}},
                                {{"act", "entry"}, {"key", "body"}},
                                {{"act", "set"}, {"key", "body.1.name"}, {"value", "\"plate\""}},
                                {{"act", "set"}, {"key", "time.end"}, {"value", "\"1 us\""}},
                                {{"act", "remove"}, {"key", n % 2 == 0 ? "body.1.name" : "time.end"}},
                                {{"act", "remove"}, {"key", "body.1"}}}}});
    text = done["text"];
    EXPECT_EQ(comments(text), comments(edited_text));
    EXPECT_EQ(done["tree"]["keys"]["domain"]["keys"]["cell_size"]["value"], cell);
    EXPECT_EQ(done["tree"]["keys"]["body"]["list"].size(), 1U);
  }
}

TEST_F(EditorTest, AppliesAllChangesOrNone) {
  Editor page = editor();
  const Response refused = ask(
      page, "/edit",
      {{"text", edited_text},
       {"acts",
        {{{"act", "set"}, {"key", "title"}, {"value", "\"x\""}}, {{"act", "remove"}, {"key", "body.7"}}}}});
  EXPECT_EQ(refused.status, 400);
  EXPECT_THAT(refused.body, HasSubstr("there is no 'body.7'"));
  EXPECT_EQ(ask(page, "/edit", {{"text", ""}, {"acts", {{{"act", "rename"}}}}}).status, 400);
  EXPECT_EQ(ask(page, "/edit", {{"text", ""}, {"acts", 3}}).status, 400);
  EXPECT_EQ(ask(page, "/edit", {{"text", std::string(600'000, '#')}, {"acts", json::array()}}).status, 400);
}

TEST_F(EditorTest, TellsWhereATextCannotBeRead) {
  Editor page = editor();
  const json fault = answer(page, "/parse", {{"text", "a = 1\nb = = 2\n"}})["fault"];
  EXPECT_EQ(fault["line"], 2);
  EXPECT_EQ(fault["column"], 5);
  EXPECT_THAT(fault["text"].get<std::string>(), ::testing::Not(HasSubstr("case.toml")));
  const json tree = answer(page, "/parse", {{"text", edited_text}})["tree"];
  EXPECT_EQ(tree["keys"]["body"]["list"][0]["keys"]["shape"]["line"], 10);
}

TEST_F(EditorTest, WritesANewFileAndNeverOverAnotherOne) {
  Editor page = editor();
  EXPECT_EQ(content(page)["exists"], false);
  const std::string first = answer(page, "/save", {{"text", "a = 1\n"}, {"digest", ""}})["digest"];
  EXPECT_EQ(read_text(file()), "a = 1\n");
  EXPECT_EQ(ask(page, "/save", {{"text", "b = 1\n"}, {"digest", ""}}).status, 409);
  write_text_atomically(file(), "c = 1\n");  // by another program
  const Response refused = ask(page, "/save", {{"text", "b = 1\n"}, {"digest", first}});
  EXPECT_EQ(refused.status, 409);
  EXPECT_THAT(refused.body, HasSubstr("changed by another program"));
  EXPECT_EQ(read_text(file()), "c = 1\n");
  const json now = content(page);
  EXPECT_EQ(now["text"], "c = 1\n");
  EXPECT_EQ(ask(page, "/save", {{"text", "b = 1\n"}, {"digest", now["digest"]}}).status, 200);
  fs::remove(file());
  EXPECT_EQ(ask(page, "/save", {{"text", "b = 1\n"}, {"digest", now["digest"]}}).status, 409);
}

TEST_F(EditorTest, KeepsPermissionsAndLinks) {
  const fs::path target = folder_.path() / "other.toml";
  write_text_atomically(target, "a = 1\n");
  fs::permissions(target, fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("other.toml", file());
  Editor page = editor();
  EXPECT_EQ(ask(page, "/save", {{"text", "a = 2\n"}, {"digest", content(page)["digest"]}}).status, 200);
  EXPECT_TRUE(fs::is_symlink(file()));
  EXPECT_EQ(read_text(target), "a = 2\n");
  EXPECT_EQ(fs::status(target).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  fs::remove(target);
  EXPECT_EQ(ask(page, "/save", {{"text", "a = 3\n"}, {"digest", ""}}).status, 400);
}

TEST_F(EditorTest, StartsFromACaseOfTheLibraryWithItsFiles) {
  const fs::path of_case = folder_.path() / "cases" / "disk";
  fs::create_directories(of_case);
  write_text_atomically(of_case / "disk.stl", "solid\n");
  write_text_atomically(
      of_case / "case.toml",
      "title = \"disk.stl\"  # kept\nmaterial = \"copper.toml\"\nlist = [1, \"disk.stl\"]\n");
  Editor page = editor();
  const std::string text = answer(page, "/start", {{"case", "disk"}})["text"];
  EXPECT_THAT(text, HasSubstr("material = \"copper.toml\""));
  EXPECT_THAT(text, HasSubstr("list = [1, \"" + (of_case / "disk.stl").string() + "\"]"));
  EXPECT_THAT(text, HasSubstr("# kept"));
  for (const char* name : {"..", "../cases/disk", "", "none"}) {
    EXPECT_EQ(ask(page, "/start", {{"case", name}}).status, 400) << name;
  }
}

TEST_F(EditorTest, ALaterCheckEndsAnEarlierOne) {
  const fs::path program = folder_.path() / "program";
  write_text_atomically(
      program, "#!/bin/sh\necho $$ >> " + (folder_.path() / "started").string() + "\nexec sleep 60\n");
  fs::permissions(program, fs::perms::owner_all);
  Editor page = editor(program);
  const json first = answer(page, "/check", {{"text", "a = 1\n"}});
  while (!fs::exists(folder_.path() / "started")) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_EQ(answer(page, "/result", first)["done"], false);
  const json second = answer(page, "/check", {{"text", "a = 2\n"}});
  EXPECT_EQ(ask(page, "/result", first).status, 400);
  EXPECT_EQ(answer(page, "/result", second)["done"], false);
  EXPECT_EQ(ask(page, "/cloud", second).status, 400);
  const std::string pid = read_text(folder_.path() / "started");
  EXPECT_FALSE(fs::exists("/proc/" + pid.substr(0, pid.find('\n')))) << "it has been ended";
}

TEST_F(EditorTest, TellsWhatAProgramSaysThatEnds) {
  const fs::path program = folder_.path() / "program";
  write_text_atomically(program, "#!/bin/sh\necho out of memory >&2\nexit 3\n");
  fs::permissions(program, fs::perms::owner_all);
  Editor page = editor(program);
  const json job = answer(page, "/check", {{"text", "a = 1\n"}});
  json result = answer(page, "/result", job);
  while (result["done"] == false) result = answer(page, "/result", job);
  EXPECT_EQ(result["message"], "out of memory\n");
  EXPECT_EQ(result["cloud"], false);
}

/// Whatever a request contains, it is answered, nobody without the key is told anything, and no file is written.
TEST_F(EditorTest, AnswersTenThousandDamagedQuestions) {
  write_text_atomically(file(), edited_text);
  Editor page = editor();
  const std::vector<std::string> targets = {"/",     "/case", "/library", "/schema", "/start",  "/parse",
                                            "/edit", "/save", "/result",  "/cloud",  "/../x.js"};
  const std::vector<std::string> bodies = {
      "",
      "{}",
      "null",
      "[[[[",
      R"({"text": "[a]\nb = 1 # c\n", "acts": [{"act": "set", "key": "a.b", "value": "2"}]})",
      R"({"text": "s = { a = 1, b = [{}, {}] }\n", "acts": [{"act": "remove", "key": "s.b.1"}]})",
      R"({"text": "[[b]]\nn = 1\n[b.c]\n", "acts": [{"act": "entry", "key": "b"}, {"act": "table", "key": "b.1.c"}]})",
      R"({"text": "a = 1\n", "digest": "0"})",
      R"({"case": "disk"})",
      R"({"job": 0})",
      R"({"job": -1})"};
  std::uint64_t state = 1;
  const auto random = [&state](std::size_t below) {
    state = state * 6364136223846793005U + 1442695040888963407U;
    return static_cast<std::size_t>(state >> 33U) % below;
  };
  const auto damaged = [&](std::string text) {
    for (std::size_t i = random(4); i > 0 && !text.empty(); --i)
      text[random(text.size())] = static_cast<char>(random(256));
    return text;
  };
  for (int n = 0; n < 10000; ++n) {
    const bool has_key = random(2) == 0;
    const Response response = page.handle({.changes = random(4) != 0,
                                           .target = damaged(targets[random(targets.size())]),
                                           .host = "127.0.0.1:1",
                                           .origin = {},
                                           .site = {},
                                           .token = has_key ? token : damaged(std::string(31, 'a')),
                                           .content_type = "application/json",
                                           .body = damaged(bodies[random(bodies.size())])});
    EXPECT_TRUE(response.status == 200 || (response.status >= 400 && response.status < 500))
        << response.status;
    if (!has_key) {
      EXPECT_THAT(response.body, ::testing::Not(HasSubstr("disk")));
    }
  }
  EXPECT_EQ(read_text(file()), edited_text);
}

}  // namespace
}  // namespace whipple::editor
