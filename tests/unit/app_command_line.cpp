// SPDX-License-Identifier: BSD-3-Clause
// The executable as its users meet it: exit codes, messages on standard error, help with examples,
// suggestions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/folders.hpp"

namespace whipple {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

struct Result {
  int code = -1;
  std::string out;
  std::string err;
};

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

class CommandLine : public ::testing::Test {
 protected:
  CommandLine()
      : folder_(std::filesystem::temp_directory_path() / ("whipple_cli_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~CommandLine() override { std::filesystem::remove_all(folder_); }

  /// Runs `whipple ARGUMENTS` (as a shell reads them) in the folder of the test.
  [[nodiscard]] Result whipple(const std::string& arguments) const {
    const std::string program = whipple::tests::program("whipple");
    const std::string command = "cd '" + folder_.string() + "' && '" + program + "' " + arguments +
                                " > .stdout 2> .stderr < /dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(folder_ / ".stdout"),
            text_of(folder_ / ".stderr")};
  }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }

  std::filesystem::path folder_;
};

TEST_F(CommandLine, EverySubcommandHasHelpWithAnExample) {
  for (const char* command : {"run", "check",    "edit",      "status",  "steer",  "export", "import",
                              "md",  "fit",      "compare",   "analyse", "report", "view",   "monitor",
                              "eos", "describe", "materials", "cite",    "units",  "bench",  "version"}) {
    const Result result = whipple(std::string(command) + " --help");
    EXPECT_EQ(result.code, 0) << command;
    EXPECT_THAT(result.out, HasSubstr("Example")) << command;
    EXPECT_THAT(result.out, HasSubstr("--quiet")) << command;
    EXPECT_EQ(result.err, "") << command;
  }
}

TEST_F(CommandLine, HelpOfTheProgramListsTheSubcommandsAndTheExitCodes) {
  const Result result = whipple("--help");
  EXPECT_EQ(result.code, 0);
  EXPECT_THAT(result.out, HasSubstr("describe"));
  EXPECT_THAT(result.out, HasSubstr("Exit codes"));
}

TEST_F(CommandLine, WithoutArgumentsItShowsTheHelpAsAnError) {
  const Result result = whipple("");
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, HasSubstr("Usage"));
}

TEST_F(CommandLine, AMistypedSubcommandIsAnsweredByTheNearest) {
  const Result result = whipple("descirbe eos");
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err,
              HasSubstr("whipple: error: unknown subcommand 'descirbe', did you mean \"describe\"?"));
}

TEST_F(CommandLine, AMistypedOptionIsAnsweredByTheNearest) {
  const Result result = whipple("md plan.toml --rank 2");
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, HasSubstr("unknown option '--rank', did you mean \"--ranks\"?"));
  EXPECT_THAT(result.err, HasSubstr("see whipple md --help"));
}

TEST_F(CommandLine, WrongArgumentsHaveExitCodeTwo) {
  EXPECT_EQ(whipple("md").code, 2) << "a required argument is missing";
  EXPECT_EQ(whipple("md plan.toml --ranks many").code, 2) << "no number";
  EXPECT_EQ(whipple("md plan.toml --ranks 0").code, 2) << "out of range";
  EXPECT_EQ(whipple("version surplus").code, 2);
  EXPECT_EQ(whipple("units --to m").code, 2) << "nothing to convert";
  EXPECT_EQ(whipple("units '3 cakes'").code, 2) << "no unit";
}

/// The option and what it accepts, in the words of the manual.
TEST_F(CommandLine, WrongWordsAndQuantitiesNameTheirOption) {
  for (const auto& [arguments, said] : std::vector<std::pair<std::string, std::string>>{
           {"export run -o out --format xml", "--format: xml not in {vtu,csv}"},
           {"run case.toml --device card", "--device: card not in {cpu,reference,emulated,gpu}"},
           {"run case.toml --device 1", "--device: 1 not in {cpu,reference,emulated,gpu}"},
           {"sweep study.toml --slurm ''", "--slurm: is empty"},
           {"sweep study.toml --slurm a --point 0", "--slurm excludes --point"},
           {"sweep study.toml --point -1", "--point: Value -1 not in range 0 to 2147483647"},
           {"materials --json --markdown", "--markdown excludes --json"},
           {"shield shots.toml --most-across nan", "--most-across: is not a number"},
           {"run case.toml --wall-time 5", "--wall-time: is 5 without a unit"},
           {"run case.toml --wall-time '-5 s'", "--wall-time: is -5 s, but must be > 0 s"},
           {"analyse run --witness '5 s'", "--witness: unit 's' has the wrong dimension"},
           {"analyse run --pixel '0 mm'", "--pixel: is 0 mm, but must be > 0 m"},
           {"analyse run --spot '-1 mm'", "--spot: is -1 mm, but must be >= 0 m"},
           {"analyse run --attenuation ball=1", "--attenuation ball: is 1 without a unit"},
           {"fit x.md.h5 --reference-temperature '-3 K'",
            "--reference-temperature: is -3 K, but must be > 0 K"},
           {"fit x.md.h5 --density '-3 g/cc'", "--density: is -3 g/cc, but must be > 0 kg/m^3"},
           {"monitor . --cases nowhere", "nowhere: error: there is no such folder"},
           {"monitor .stdout", ".stdout: error: is not a folder"},
           {"status .stdout", ".stdout: error: is not a folder"}}) {
    const Result result = whipple(arguments);
    EXPECT_EQ(result.code, 2) << arguments;
    EXPECT_THAT(result.err, HasSubstr(said)) << arguments;
    EXPECT_EQ(result.out, "") << arguments;
  }
}

TEST_F(CommandLine, CiteRefusesWhatIsNoMaterialBeforeItPrints) {
  write("case.toml", "title = \"no material\"\n[domain]\ncell_size = \"1 mm\"\n");
  for (const char* name : {"case.toml", "nothing"}) {
    const Result result = whipple(std::string("cite copper ") + name);
    EXPECT_EQ(result.code, 2) << name;
    EXPECT_EQ(result.out, "") << name;
    EXPECT_THAT(result.err, HasSubstr(name));
  }
}

TEST_F(CommandLine, AListOfStatesNamesItsFaultyLine) {
  const auto refused = [&](const std::string& text) {
    write("states.csv", text);
    const Result result = whipple("eos state copper --states states.csv");
    EXPECT_EQ(result.code, 2) << text;
    return result.err;
  };
  EXPECT_THAT(refused("density [g/cm^3],temperature [K]\n9,300\n9,\n"),
              HasSubstr("states.csv:3: 1 quantities, but a state is named by two"));
  EXPECT_THAT(refused("density [g/cm^3],density [g/cm^3]\n9,9\n"),
              HasSubstr("states.csv:1: a second column \"density\""));
  write("states.csv",
        "\xEF\xBB\xBF"
        "density [g/cm^3],temperature [K]\r\n9,300\r\n");  // of a spreadsheet
  EXPECT_EQ(whipple("eos state copper --states states.csv").code, 0);
}

TEST_F(CommandLine, BenchWritesItsFiguresAndComparesThem) {
  const Result first = whipple("bench taylor_bar_musl --quick --json first.json");
  ASSERT_EQ(first.code, 0) << first.err;
  for (const char* what : {"triad", "particles to grid", "material", "whole step", "of bandwidth"}) {
    EXPECT_THAT(first.out, HasSubstr(what));
  }
  const nlohmann::json record = nlohmann::json::parse(text_of(folder_ / "first.json"));
  const nlohmann::json& measured = record.at("measurements").at(0);
  EXPECT_GT(measured.at("bandwidth_bytes_per_s"), 1e8);
  EXPECT_GT(measured.at("arithmetic_flops_per_s"), 1e8);
  EXPECT_GT(measured.at("reference_kernel_ns_per_particle_step"), 1.0);
  double of_stages = 0.0;
  for (const nlohmann::json& stage : measured.at("stages")) {
    of_stages += stage.at("ns_per_particle_step").get<double>();
  }
  const double whole = measured.at("ns_per_particle_step");
  EXPECT_LE(of_stages, whole);
  EXPECT_GE(of_stages, 0.8 * whole) << "time is spent outside of the stages";
  EXPECT_GT(measured.at("peak_memory_bytes"),
            measured.at("bytes_per_particle").get<double>() * measured.at("particles").get<double>());

  const Result second = whipple("bench taylor_bar_musl --quick --ranks 1,2 --compare first.json");
  ASSERT_EQ(second.code, 0) << second.err;
  EXPECT_THAT(second.out, HasSubstr("now / before"));
  EXPECT_THAT(second.out, HasSubstr("efficiency"));
  EXPECT_THAT(second.out, HasSubstr("kernel's speed-up"));
}

TEST_F(CommandLine, BenchRefusesWhatItDoesNotKnowBeforeItMeasures) {
  const Result unknown = whipple("bench taylor");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("there is no problem \"taylor\"; there are taylor_bar, "));
  write("other.json", "{}");
  const Result other = whipple("bench taylor_bar --compare other.json");
  EXPECT_EQ(other.code, 2);
  EXPECT_THAT(other.err, HasSubstr("not written by whipple bench --json"));
  EXPECT_EQ(whipple("bench taylor_bar --json other.json").code, 2) << "the file exists";
  EXPECT_EQ(text_of(folder_ / "other.json"), "{}");
}

TEST_F(CommandLine, ARestartKeepsGridAndBodies) {
  for (const char* change : {"domain.cell_size=1e-3", "body.0.name=ball"}) {
    const Result result = whipple(std::string("run --restart run/disk --set ") + change);
    EXPECT_EQ(result.code, 2) << change;
    EXPECT_THAT(result.err, HasSubstr("those of the checkpoint")) << change;
  }
}

TEST_F(CommandLine, AWrongQuantityOfALocusNamesItsOption) {
  EXPECT_THAT(whipple("eos hugoniot copper --to '3 kg'").err,
              HasSubstr("--to: '3 kg': expected a quantity in Pa"));
  EXPECT_THAT(whipple("eos isotherm copper --temperature '3 m'").err, HasSubstr("--temperature: unit 'm'"));
  EXPECT_EQ(whipple("eos hugoniot copper --to '-3 GPa'").code, 2);
}

TEST_F(CommandLine, MissingFilesAreNamedOnStandardError) {
  for (const char* arguments : {"run nowhere.toml", "check nowhere.toml", "md nowhere.toml",
                                "analyse nowhere.toml", "report nowhere.toml"}) {
    const Result result = whipple(arguments);
    EXPECT_EQ(result.code, 2) << arguments;
    EXPECT_EQ(result.out, "") << arguments;
    EXPECT_THAT(result.err, HasSubstr("nowhere.toml")) << arguments;
  }
}

TEST_F(CommandLine, AllErrorsOfACaseComeAtOnceAndNothingIsWritten) {
  write("case.toml", "[domain]\ncell_size = \"0.5 s\"\nlowr = [0, 0, 0]\n");
  const Result result = whipple("run case.toml -o out");
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, HasSubstr("case.toml:2:13: error: 'cell_size' unit 's' has the wrong dimension"));
  EXPECT_THAT(result.err,
              HasSubstr("case.toml:3:1: error: unknown key 'domain.lowr', did you mean \"lower\"?"));
  EXPECT_THAT(result.err, HasSubstr("missing"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(CommandLine, CheckSaysWhatElementsOfABodyDoNotTouch) {
  const std::string text =
      "[domain]\nlower = [0, 0, 0]\nupper = [\"8 mm\", \"8 mm\", \"8 mm\"]\ncell_size = \"1 mm\"\n"
      "[time]\nend = \"1 us\"\n[[body]]\nname = \"block\"\nmaterial = \"copper.toml\"\n"
      "shape = { box = { lower = [\"2 mm\", \"2 mm\", \"2 mm\"], upper = [\"6 mm\", \"6 mm\", \"6 mm\"] } "
      "}\n";
  const std::string elements = "discretization = { method = \"finite_elements\" }\n";
  const std::string folds = "do not touch each other where the body folds";
  write("particles.toml", text);
  write("elements.toml", text + elements);
  write("pieces.toml", text + elements + "element_range = { beyond = \"remove\", pieces = \"fields\" }\n");
  const Result particles = whipple("check particles.toml");
  EXPECT_EQ(particles.code, 0);
  EXPECT_THAT(particles.out, Not(HasSubstr(folds)));
  EXPECT_THAT(whipple("check elements.toml").out, HasSubstr(folds));
  EXPECT_THAT(whipple("check pieces.toml").out, HasSubstr("pieces that this parts touch each other"));
}

TEST_F(CommandLine, UnitsConvertsAndRefuses) {
  EXPECT_EQ(whipple("units '1.4 Mbar' --to GPa").out, "140 GPa\n");
  const Result wrong = whipple("units '1.4 Mbar' --to m");
  EXPECT_EQ(wrong.code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("wrong dimension"));
}

TEST_F(CommandLine, DescribeKnowsModelsAndSuggestsThem) {
  EXPECT_THAT(whipple("describe eos").out, HasSubstr("mie_gruneisen"));
  EXPECT_THAT(whipple("describe eos gray").out, HasSubstr("hugoniot_intercept"));
  EXPECT_THAT(whipple("describe md").out, HasSubstr("potential"));
  EXPECT_THAT(whipple("describe case").out, HasSubstr("cell_size"));
  const Result wrong = whipple("describe eos grey");
  EXPECT_EQ(wrong.code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("did you mean \"gray\"?"));
}

// The page of the manual is the program's own output: it cannot lag behind the tables.
TEST_F(CommandLine, TheInputReferenceIsUpToDate) {
  const Result result = whipple("describe --markdown");
  EXPECT_EQ(result.code, 0);
  EXPECT_TRUE(result.out == text_of(whipple::tests::source_folder() + "/docs/manual/input_reference.md"))
      << "run: build/release/bin/whipple describe --markdown > docs/manual/input_reference.md";
}

TEST_F(CommandLine, MaterialsListsTheLibrary) {
  const Result result = whipple("materials");
  EXPECT_EQ(result.code, 0);
  EXPECT_THAT(result.out, HasSubstr("metals\n  aluminium "));
  EXPECT_THAT(result.out, HasSubstr("\n  copper_ofhc "));
  EXPECT_THAT(result.err, HasSubstr("eos/materials"));
  EXPECT_EQ(whipple("materials --quiet").err, "") << "--quiet leaves the result only";
}

TEST_F(CommandLine, TheTablesOfTheLibraryAreUpToDate) {
  const Result result = whipple("materials --markdown --quiet");
  EXPECT_EQ(result.code, 0);
  EXPECT_TRUE(text_of(whipple::tests::source_folder() + "/docs/manual/materials.md").ends_with(result.out))
      << "run: build/release/bin/whipple materials --markdown, and put its tables at the end of "
         "docs/manual/materials.md";
}

TEST_F(CommandLine, VersionNamesRevisionAndLibraries) {
  const Result result = whipple("version");
  EXPECT_EQ(result.code, 0);
  for (const char* part : {"whipple ", "revision", "GNU", "HDF5", "Open MPI", "p4est"}) {
    EXPECT_THAT(result.out, HasSubstr(part));
  }
  EXPECT_THAT(whipple("--version").out, HasSubstr("whipple "));
}

TEST_F(CommandLine, TheSisterProgramsAreFoundAndTheirExitCodesPassThrough) {
  write("plan.toml", "element = \"Cu\"\npotental = \"x\"\n");
  const Result md = whipple("md plan.toml --ranks 1");
  EXPECT_EQ(md.code, 2);
  EXPECT_THAT(md.err, HasSubstr("plan.toml:2:1: error: unknown key 'potental', did you mean \"potential\"?"));
  const Result fit = whipple("fit nowhere.md.h5 -o new.toml");
  EXPECT_EQ(fit.code, 2);
  EXPECT_THAT(fit.err, HasSubstr("nowhere.md.h5"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "new.toml"));
}

TEST_F(CommandLine, NothingIsOverwrittenWithoutForce) {
  write("points.csv", "precious\n");
  const Result result = whipple("compare copper --with cu_hugoniot_marsh1980 --csv points.csv");
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, HasSubstr("--force"));
  EXPECT_EQ(text_of(folder_ / "points.csv"), "precious\n");
}

TEST_F(CommandLine, AnImportedDeckIsCheckedAndRuns) {
  const std::string decks = whipple::tests::source_folder() + "/tests/data/decks/";
  const Result imported = whipple("import " + decks + "sphere_on_plate.mpm -o sphere");
  ASSERT_EQ(imported.code, 0) << imported.err;
  for (const char* list : {"exact (", "converted (", "dropped (", "missing (0)"})
    EXPECT_THAT(imported.out, HasSubstr(list));
  EXPECT_EQ(text_of(folder_ / "sphere" / "import.txt"), imported.out);
  const Result checked = whipple("check sphere/case.toml --threads 1");
  EXPECT_EQ(checked.code, 0) << checked.err;
  const Result run = whipple("run sphere/case.toml -o run --threads 1 --set time.end='0.3 us'");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "run" / "history.csv"));
  EXPECT_EQ(whipple("import " + decks + "sphere_on_plate.mpm -o sphere").code, 2) << "nothing is overwritten";
}

TEST_F(CommandLine, WhatADeckMakesMissingIsRefused) {
  const std::string deck = whipple::tests::source_folder() + "/tests/data/decks/missing.mpm";
  const Result refused = whipple("import " + deck + " -o case");
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.out, HasSubstr("missing ("));
  EXPECT_THAT(refused.err, HasSubstr("missing.mpm:16:1: error: missing: drda: dynamic relaxation"));
  EXPECT_THAT(refused.err, HasSubstr("--allow-missing"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "case"));
  EXPECT_EQ(whipple("import " + deck + " -o case --allow-missing").code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "case" / "case.toml"));
  EXPECT_THAT(whipple("import " + deck + " -o other --units 'mm g'").err, HasSubstr("--units 'mm g ms'"));
  EXPECT_THAT(whipple("import " + deck + " -o other --format mpm3d").err, HasSubstr("known: mpm3d_f90"));
}

// What newcomers try and what is no such thing: the message says what to do instead.
TEST_F(CommandLine, NaturalMistakesAreNamedWithTheirRemedy) {
  write("case.toml", text_of(whipple::tests::source_folder() + "/tests/data/small_impact.toml"));
  const Result preview = whipple("check case.toml --preview pv.png");
  EXPECT_EQ(preview.code, 2);
  EXPECT_THAT(preview.err, HasSubstr("its name ends with .html"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "pv.png"));
  const Result folder = whipple("run .");
  EXPECT_EQ(folder.code, 2);
  EXPECT_THAT(folder.err, HasSubstr("is a folder: give the case file, ./case.toml"));
  const Result elsewhere = whipple("check cases/dam_break/case.toml");
  EXPECT_EQ(elsewhere.code, 2);
  EXPECT_THAT(elsewhere.err, HasSubstr("the one that comes with the program: /"));
  EXPECT_THAT(elsewhere.err, HasSubstr("/cases/dam_break/case.toml"));
  write("Cu.eam", "copper\n29 63.5 3.6 fcc\n");
  EXPECT_THAT(whipple("fit Cu.eam").err, HasSubstr("simulate first, whipple md PLAN.toml"));
  EXPECT_THAT(whipple("eos audit 'Al 6061-T6'").err, HasSubstr("did you mean \"aluminium_6061_t6\""));
  EXPECT_THAT(whipple("eos audit aluminium_foam").err, HasSubstr("did you mean \"aluminium"));
  EXPECT_EQ(whipple("help run").out, whipple("run --help").out);
  EXPECT_EQ(whipple("help").out, whipple("--help").out);
  // Names before sources.
  const std::string found = whipple("materials search copper").out;
  EXPECT_LT(found.find("copper_ofhc"), found.find("in sources, models or comments only:"));
  EXPECT_GT(found.find("\ntungsten"), found.find("in sources, models or comments only:"));
}

TEST_F(CommandLine, TablesAndStatesOfRunsAreWrittenForPrograms) {
  const Result state = whipple("eos state copper --density '9 g/cm^3' --temperature '300 K' --json");
  ASSERT_EQ(state.code, 0) << state.err;
  const auto table = nlohmann::json::parse(state.out);
  EXPECT_NEAR(table["materials"][0]["rows"][0]["rho_kg_m3"].get<double>(), 9000.0, 1e-6);
  EXPECT_EQ(table["materials"][0]["rows"][0]["phase"], "solid");
  // A run that was killed says that it goes on; names of folders are bytes.
  const char* const name = "runs/killed \xff";
  std::filesystem::create_directories(folder_ / name);
  write(name + std::string("/status.json"),
        R"({"state": "running", "step": 7, "time": 1e-6, "time_step": 1e-9,
"end": 2e-6, "wall_time": 3.0, "time_left": null, "revision": "r", "message": "m", "written": "w"})");
  const Result status = whipple("status runs --json");
  ASSERT_EQ(status.code, 0) << status.err;
  const auto entry = nlohmann::json::parse(status.out).at(0);
  EXPECT_EQ(entry["step"], 7);
  EXPECT_EQ(entry["state"], "lost");
  EXPECT_EQ(entry["goes_on"], false);
  EXPECT_EQ(entry["run"], "runs/killed \xEF\xBF\xBD");
  EXPECT_THAT(whipple("status runs").out, HasSubstr("lost"));
  write(name + std::string("/status.json"), R"({"state": "running", )");
  const Result damaged = whipple("status runs --json");
  EXPECT_EQ(damaged.code, 2);
  EXPECT_THAT(damaged.err, HasSubstr("is no status of a run"));
  EXPECT_THAT(damaged.out, HasSubstr("\"unknown\""));
}

// `whipple edit` writes what passes the checks, and nothing else into the file.
TEST_F(CommandLine, EditChangesAValueAndKeepsTheRest) {
  const std::string before = text_of(whipple::tests::source_folder() + "/tests/data/small_impact.toml");
  const std::filesystem::path file = write("case.toml", before);
  EXPECT_EQ(whipple("edit case.toml domain.cell_size='-1 mm'").code, 2);
  EXPECT_EQ(whipple("edit --dry-run case.toml domain.cell_size='1 mm'").code, 0);
  EXPECT_EQ(text_of(file), before);
  const Result edited = whipple("edit case.toml domain.cell_size='1 mm' body.0.velocity.2='3 km/s'");
  EXPECT_EQ(edited.code, 0) << edited.err;
  EXPECT_THAT(edited.out, HasSubstr("case.toml:5: domain.cell_size: \"0.8 mm\" -> \"1 mm\"\n"));
  std::string expected = before;
  expected.replace(expected.find("\"0.8 mm\""), 8, "\"1 mm\"");
  expected.replace(expected.find("\"2 km/s\""), 8, "\"3 km/s\"");
  EXPECT_EQ(text_of(file), expected);
  // A link to the case stays a link, and the file keeps its permissions.
  using std::filesystem::perms;
  std::filesystem::permissions(file, perms::owner_read | perms::owner_write);
  const std::filesystem::path link = file.parent_path() / "link.toml";
  std::filesystem::create_symlink(file, link);
  EXPECT_EQ(whipple("edit link.toml domain.cell_size='0.8 mm'").code, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_THAT(text_of(file), HasSubstr("cell_size = \"0.8 mm\""));
  EXPECT_EQ(std::filesystem::status(file).permissions(), perms::owner_read | perms::owner_write);
}

}  // namespace
}  // namespace whipple
