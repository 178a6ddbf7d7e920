// SPDX-License-Identifier: BSD-3-Clause
// Case files: every mistake is named with its place, all together and before any work; the complete case that
// a run writes reads back to the same case.
#include "tests/unit/case_support.hpp"

namespace whipple::cases {
namespace {

TEST(Case, IsReadInSi) {
  const Case setup = read_case_text(domain + sphere, "case.toml");
  EXPECT_DOUBLE_EQ(setup.domain.cell_size, 1e-3);
  EXPECT_DOUBLE_EQ(setup.time.end, 4e-6);
  EXPECT_EQ(setup.geometry.cells, (std::array<std::int32_t, 3>{12, 12, 30}));
  EXPECT_EQ(setup.geometry.boundary[0], grid::Boundary::symmetry);
  EXPECT_EQ(setup.geometry.boundary[1], grid::Boundary::outflow);
  EXPECT_DOUBLE_EQ(setup.bodies.at(0).velocity[2], 5550.0);
}

TEST(Case, NamesEveryMistakeAtOnceWithItsPlace) {
  std::string text = domain + sphere;
  text = replaced(text, "cell_size = \"1 mm\"", "cell_size = \"1 GPa\"");
  text = replaced(text, "end = \"4 us\"", "ennd = \"4 us\"");
  text = replaced(text, "copper.toml", "coper.toml");
  expect_error(text, {"case.toml:5:13: error: 'cell_size'", "wrong dimension", "missing key 'end'",
                      "unknown key 'time.ennd'", "did you mean \"end\"?", "coper", "copper"});
}

TEST(Case, AnEmptyMaterialIsRefused) {
  expect_error(domain + replaced(sphere, "\"copper.toml\"", "\"\""), {"case.toml:", "'material' is empty"});
}

TEST(Case, RefusesCombinationsThatHaveNoMeaning) {
  for (const std::string shape : {"linear", "gimp", "convected_gimp"}) {
    expect_error(domain + "[transfer]\nshape_function = \"" + shape + "\"\n" + sphere,
                 {"particle_update = \"relaxed_affine\" needs functions whose second moment",
                  "\"quadratic_bspline\" or \"cubic_bspline\"", "\"" + shape + "\" works with \"flip\""});
  }
  expect_error(domain + "[transfer]\nparticle_update = \"fmpm\"\n" + sphere,
               {"\"fmpm\" has no exact energy balance", "scheme = \"usl\", \"musl\" or \"usf\""});
  for (const std::string scheme : {"musl", "usl", "usf"}) {
    const std::string with_scheme = replaced(domain, "end =", "scheme = \"" + scheme + "\"\nend =");
    expect_error(with_scheme + "[transfer]\nparticle_update = \"apic\"\n" + sphere,
                 {"scheme \"" + scheme + "\" carries no affine field", "\"flip\", \"pic\", \"blend\""});
    EXPECT_EQ(read_case_text(with_scheme + sphere, "case.toml").transfer.particle_update,
              ParticleUpdate::flip);
  }
  expect_error(
      replaced(replaced(domain, "end =", "scheme = \"usf\"\nend ="), "\"symmetry\" }", "\"separating\" }") +
          sphere,
      {"a separating wall", "scheme \"usf\"", "\"musl\""});
  expect_error(domain + "[transfer]\nshape_function = \"gimp\"\nparticle_update = \"flip\"\n" +
                   replaced(sphere, "radius = \"3 mm\"", "radius = \"0.7 mm\"") +
                   "discretization = { per_cell = 1 }\n",
               {"its particles are 1.4 cells wide", "'per_cell'", "\"convected_gimp\""});
  expect_error(domain + sphere + "discretization = { per_cell = 5 }\n", {"'per_cell' is 5, expected a cube"});
  expect_error(
      replaced(replaced(domain, "x_lower", "x_upper = \"symmetry\", x_lower"), "12 mm", "11.5 mm") + sphere,
      {"whole number of cells along x"});
  expect_error(replaced(domain, "\"symmetry\" }", "\"mirror\" }") + sphere,
               {"Accepted: outflow, symmetry, no_slip, separating"});
  expect_error(domain, {"no bodies"});
  expect_error(domain + replaced(sphere, "\"sphere\"", "\"../sphere\""),
               {"'name' is \"../sphere\"", "letters, digits"});
}

TEST(Case, NothingIsFasterThanLight) {
  EXPECT_EQ(error_of(domain + replaced(sphere, "5.55 km/s", "2e5 km/s")), "");
  expect_error(domain + replaced(sphere, "5.55 km/s", "3e5 km/s"),
               {"'velocity' is beyond the speed of light"});
  expect_error(domain + sphere + "angular_velocity = [\"0 rad/s\", \"0 rad/s\", \"1e12 rad/s\"]\n",
               {"'angular_velocity' moves the rim beyond the speed of light"});
}

// All particles would be divided in every step, a million times with 20 generations.
TEST(Case, SplittingShorterThanTheParticlesIsRefused) {
  expect_error(domain + sphere + "[splitting]\nlength = 1e-300\nmaximum_generations = 20\n",
               {"'length' is 1e-300, and the particles of body \"sphere\" are 0.5 cells long"});
  EXPECT_EQ(error_of(domain + sphere + "[splitting]\nlength = 0.5\n"), "");
}

TEST(Case, WrittenWithAllDefaultsReadsBackTheSame) {
  const Case setup = read_case_text(domain + sphere, "case.toml");
  const std::string written = to_toml(setup, {"copper.toml"});
  const Case again = read_case_text(written, "run.toml");
  EXPECT_EQ(to_toml(again, {"copper.toml"}), written);
  EXPECT_EQ(again.geometry.cells, setup.geometry.cells);
}

TEST(ArtificialViscosity, OfABodyTakesWhatItDoesNotSayFromTheCase) {
  const std::string of_case = "[artificial_viscosity]\nlinear = 0.5\n";
  const Case setup =
      read_case_text(domain + of_case + sphere + "artificial_viscosity = { expansion = 0.3 }\n", "case.toml");
  const Case again = read_case_text(to_toml(setup, {"copper.toml"}), "run.toml");
  for (const Case& c : {setup, again}) {
    EXPECT_EQ(c.viscosity_of(0).linear, 0.5);
    EXPECT_EQ(c.viscosity_of(0).quadratic, 1.0);
    EXPECT_EQ(c.viscosity_of(0).expansion, 0.3);
    EXPECT_EQ(c.viscosity.expansion, 0.0);
  }
  const Case plain = read_case_text(domain + of_case + sphere, "case.toml");
  EXPECT_EQ(plain.viscosity_of(0).linear, 0.5);
  // Not written out for bodies that bring none: --set artificial_viscosity.linear then reaches them.
  EXPECT_FALSE(read_case_text(to_toml(plain, {"copper.toml"}), "run.toml").bodies[0].viscosity);
  expect_error(domain + sphere + "artificial_viscosity = { expansion = -1 }\n", {"'expansion'", ">= 0"});
}

const std::string gauges = R"(
[[gauge]]
name = "fixed"
position = ["1 mm", "1 mm", "5 mm"]
[[gauge]]
name = "inside"
kind = "moving"
position = ["1 mm", "1 mm", "-4 mm"]
[[tracers]]
name = "line"
from = ["0 mm", "0 mm", "-5 mm"]
to = ["2 mm", "0 mm", "-5 mm"]
count = 5
)";

TEST(GaugesOfACase, AreReadWrittenAndNumbered) {
  const Case setup = read_case_text(domain + sphere + gauges, "case.toml");
  const std::vector<Gauge> all = setup.all_gauges();
  ASSERT_EQ(all.size(), 7U);
  EXPECT_FALSE(all[0].moving());
  EXPECT_TRUE(all[1].moving());
  EXPECT_EQ(all[2].name, "line_1");
  EXPECT_EQ(all[6].name, "line_5");
  EXPECT_NEAR(all[4].position[0], 1e-3, 1e-15);
  const Case again = read_case_text(to_toml(setup, {"copper.toml"}), "run.toml");
  ASSERT_EQ(again.all_gauges().size(), 7U);
  EXPECT_EQ(again.all_gauges()[5].position, all[5].position);
}

TEST(GaugesOfACase, MistakesAreNamed) {
  const auto line_of = [](const std::string& text, const std::string& key) {
    return "case.toml:" +
           std::to_string(1 + std::count(text.begin(),
                                         text.begin() + static_cast<std::ptrdiff_t>(text.find(key)), '\n')) +
           ":";
  };
  const std::string outside = domain + sphere + replaced(gauges, "\"5 mm\"", "\"50 mm\"");
  expect_error(outside, {line_of(outside, "position").c_str()});
  const std::string twice = domain + sphere + replaced(gauges, "\"inside\"", "\"fixed\"");
  expect_error(twice, {line_of(twice, "name = \"fixed\"\nkind").c_str()});
  const std::string nameless = domain + replaced(sphere, "\"sphere\"", "\"\"");
  expect_error(nameless, {line_of(nameless, "name = \"\"").c_str(), "'name' is empty"});
  expect_error(domain + sphere + replaced(gauges, "\"5 mm\"", "\"50 mm\""),
               {"gauge \"fixed\"", "outside of the domain"});
  expect_error(domain + sphere + replaced(gauges, "\"-4 mm\"", "\"4 mm\""),
               {"gauge \"inside\"", "no body is there"});
  expect_error(
      domain + sphere + replaced(gauges, "\"2 mm\", \"0 mm\", \"-5 mm\"", "\"9 mm\", \"0 mm\", \"-5 mm\""),
      {"gauge \"line_5\"", "no body is there"});
  expect_error(domain + sphere + replaced(gauges, "\"inside\"", "\"fixed\""),
               {"two gauges are called \"fixed\""});
  expect_error(domain + sphere + replaced(gauges, "\"inside\"", "\"a,b\""), {"names columns"});
  expect_error(domain + sphere + replaced(gauges, "\"moving\"", "\"flying\""), {"'kind' is \"flying\""});
  expect_error(domain + sphere + replaced(gauges, "count = 5", "count = 1"), {"'count' is 1"});
  expect_error(domain + sphere + replaced(gauges, "position = [\"1 mm\", \"1 mm\", \"5 mm\"]", ""),
               {"missing key 'position'"});
}

TEST(Heat, ConductionNeedsSmoothFunctionsAndAMaterialThatConducts) {
  const std::string on = "[heat]\nconduction = true\n";
  const std::string ofhc = replaced(sphere, "copper.toml", "copper_ofhc");
  EXPECT_TRUE(read_case_text(domain + on + ofhc, "case.toml").heat.conduction);
  EXPECT_GT(read_case_text(domain + ofhc, "case.toml").materials[0]->conductivity, 300.0);
  expect_error(domain + on + sphere, {"case.toml:", "no material has a conductivity"});
  expect_error(domain + on + "[transfer]\nshape_function = \"linear\"\nparticle_update = \"flip\"\n" + ofhc,
               {"'conduction' needs smooth shape functions"});
  expect_error(domain + "[heat]\nconduction = 3\n" + ofhc, {"'conduction'"});
}

TEST(Contact, AutoBondsWhatTouchesAndMovesAlike) {
  const auto body = [](const char* name, const char* shape, const char* velocity, const char* more = "") {
    return std::string("[[body]]\nname = \"") + name +
           "\"\nmaterial = \"copper.toml\"\nvelocity = " + velocity + "\nshape = { " + shape + " }\n" + more;
  };
  const char* front = "box = { lower = [0, 0, 0], upper = [0.004, 0.004, 0.001] }";
  const char* rear = "box = { lower = [0, 0, 0.001], upper = [0.004, 0.004, 0.002] }";
  const char* far = "box = { lower = [0, 0, 0.006], upper = [0.004, 0.004, 0.008] }";
  const char* ball = "sphere = { center = [0.002, 0.002, 0.0035], radius = 0.0015 }";
  const char *rest = "[0, 0, 0]", *fast = "[0, 0, -2000]";
  const auto fields = [&](const std::string& bodies, const std::string& contact = "") {
    return read_case_text(domain + contact + bodies, "case.toml").contact_fields;
  };
  using Numbers = std::vector<std::uint8_t>;
  // Layers of a plate are bonded, and said to be; what touches them but moves, or is apart, is not.
  const ContactFields all = fields(body("front", front, rest) + body("ball", ball, fast) +
                                   body("rear", rear, rest) + body("far", far, rest));
  EXPECT_EQ(all.of_body, (Numbers{0, 1, 0, 2}));
  ASSERT_EQ(all.remarks.size(), 1U);
  EXPECT_NE(all.remarks[0].find("\"front\" and \"rear\" touch"), std::string::npos);
  EXPECT_TRUE(all.warnings.empty());
  EXPECT_EQ(fields(body("rear", rear, rest) + body("ball", ball, rest)).of_body, (Numbers{0, 0}));
  EXPECT_EQ(fields(body("front", front, rest)).of_body, (Numbers{0}));
  // Groups of their own keep layers apart, one group joins what is apart.
  EXPECT_EQ(fields(body("front", front, rest, "contact_group = \"a\"\n") +
                   body("rear", rear, rest, "contact_group = \"b\"\n"))
                .of_body,
            (Numbers{0, 1}));
  EXPECT_EQ(fields(body("front", front, rest, "contact_group = \"a\"\n") +
                   body("far", far, fast, "contact_group = \"a\"\n"))
                .of_body,
            (Numbers{0, 0}));
  // One field for bodies that meet across a gap is warned of.
  const ContactFields none =
      fields(body("rear", rear, rest) + body("far", far, fast), "[contact]\nmethod = \"none\"\n");
  EXPECT_EQ(none.of_body, (Numbers{0, 0}));
  ASSERT_EQ(none.warnings.size(), 1U);
  EXPECT_NE(none.warnings[0].find("across a gap of 4 mm"), std::string::npos);
  // Curved bodies have partial volumes, unless the case says otherwise.
  const auto partial = [&](const std::string& bodies, std::size_t b) {
    return read_case_text(domain + bodies, "case.toml").bodies[b].discretization.partial_volumes;
  };
  EXPECT_TRUE(partial(body("rear", rear, rest) + body("ball", ball, fast), 1));
  EXPECT_FALSE(partial(body("rear", rear, rest) + body("ball", ball, fast), 0));
  EXPECT_TRUE(partial(body("ball", ball, fast), 0));
  EXPECT_FALSE(partial(
      body("rear", rear, rest) + body("ball", ball, fast, "discretization = { partial_volumes = false }\n"),
      1));
}

TEST(Contact, OptionsAndWhatTheyExclude) {
  const std::string on = "[contact]\nmethod = \"multi_field\"\nfriction = 0.2\n";
  const std::string second =
      "[[body]]\nname = \"other\"\nmaterial = \"copper.toml\"\nshape = { sphere = { center = "
      "[\"8 mm\", \"8 mm\", \"3 mm\"], radius = \"1 mm\" } }\n";
  const Case both = read_case_text(domain + on + sphere + second, "case.toml");
  EXPECT_EQ(both.contact.normal, contact::Normal::separating);
  EXPECT_TRUE(both.contact.gap_test);
  EXPECT_EQ(both.contact_fields.of_body, (std::vector<std::uint8_t>{0, 1}));
  const std::string grouped = replaced(sphere, "[[body]]\n", "[[body]]\ncontact_group = \"a\"\n") +
                              replaced(second, "[[body]]\n", "[[body]]\ncontact_group = \"a\"\n");
  expect_error(domain + on + grouped, {"'method'", "all bodies are one contact group"});
  expect_error(domain + on + sphere, {"'method'", "all bodies are one contact group"});
  expect_error(domain + replaced(on, "multi_field", "penalty") + sphere + second,
               {"Accepted: auto, none, multi_field"});
  expect_error(domain + replaced(on, "0.2", "-0.2") + sphere + second, {"'friction'"});
  expect_error(domain + on + "normal = \"up\"\n" + sphere + second,
               {"Accepted: collinear, separating, logistic_regression"});
  expect_error(replaced(domain, "end =", "scheme = \"usl\"\nend =") + on +
                   "[transfer]\nparticle_update = \"fmpm\"\n" + sphere + second,
               {"'method'", "has no contact"});
  expect_error(domain + "[gravity]\nacceleration = [0, 0, -9.81]\n[transfer]\nfree_flight = true\n" + sphere,
               {"'acceleration'", "free_flight"});
}

}  // namespace
}  // namespace whipple::cases
