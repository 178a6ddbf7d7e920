// SPDX-License-Identifier: BSD-3-Clause
// Bodies become particles and elements with the right mass and state; those that cannot are refused.
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <numeric>

#include "src/case/build/contact_fields.hpp"
#include "src/case/build/placement.hpp"
#include "src/case/build/seeding.hpp"
#include "src/io/run_directory.hpp"
#include "tests/unit/case_support.hpp"

namespace whipple::cases {
namespace {

TEST(Bodies, RefusesBodiesOutsideOfTheDomainAndOverlaps) {
  expect_error(domain + replaced(sphere, "\"-4 mm\"", "\"-8 mm\""),
               {"body \"sphere\" reaches z = -0.011 m", "-0.01 m"});
  expect_error(
      domain + sphere + replaced(replaced(sphere, "\"sphere\"", "\"twin\""), "\"-4 mm\"", "\"-1 mm\""),
      {"body \"twin\" overlaps body \"sphere\""});
  // A body located between the particles of another is found as well.
  const std::string grain = R"(
[[body]]
name = "grain"
material = "copper.toml"
shape = { sphere = { center = ["0.5 mm", "0.5 mm", "-4 mm"], radius = "0.6 mm" } }
)";
  expect_error(domain + sphere + grain, {"body \"grain\" overlaps body \"sphere\""});
  expect_error(domain + sphere + sphere, {"two bodies are called \"sphere\""});
}

TEST(Bodies, RefusesMoreParticlesThanAMachineHolds) {
  const std::string small =
      replaced(domain + sphere, "cell_size = \"1 mm\"", "cell_size = \"0.002 mm\"");  // would take hours
  expect_error(small, {"body \"sphere\" takes a lattice of", "'cell_size'", "'per_cell'"});
}

// A body touches a plane where its shape comes within 0.05 cells of it, wherever the lattice of its particles is
// located and whatever box encloses it.
TEST(Bodies, TouchPlanesWhereTheirShapesDo) {
  const auto faces = [](const std::string& shape) {
    const std::string text =
        "\n[[body]]\nname = \"one\"\nmaterial = \"copper.toml\"\nshape = " + shape + "\n";
    return static_cast<int>(faces_touched(read_case_text(domain + text, "case.toml")).at(0));
  };
  const auto ball = [&](const std::string& x) {
    return faces("{ sphere = { center = [\"" + x + " mm\", \"5 mm\", \"0 mm\"], radius = \"3 mm\" } }");
  };
  constexpr int x_lower = 1, y_lower = 4;
  EXPECT_EQ(ball("0"), x_lower);     // cut in its middle
  EXPECT_EQ(ball("1.37"), x_lower);  // and where the lattice has no particle in the part cut by the plane
  EXPECT_EQ(ball("3.04"), x_lower);
  EXPECT_EQ(ball("3.06"), 0);
  EXPECT_EQ(ball("3.3"), 0);
  EXPECT_EQ(ball("9"), 0);  // touches a face through which material leaves
  EXPECT_EQ(
      faces(
          "{ box = { lower = [\"0 mm\", \"0.04 mm\", \"0 mm\"], upper = [\"2 mm\", \"3 mm\", \"1 mm\"] } }"),
      x_lower | y_lower);
  // The box around a rotated shape is larger than the shape.
  EXPECT_EQ(faces("{ moved = { shape = { sphere = { center = [\"2.7 mm\", \"5 mm\", \"0 mm\"], radius = \"2 "
                  "mm\" } }, angle "
                  "= \"45 degree\", center = [\"2.7 mm\", \"5 mm\", \"0 mm\"] } }"),
            0);
}

// A plate thinner than a cell runs with a warning; one of a cell, as the column of a planar problem, without.
TEST(Bodies, WarnsOfBodiesThinnerThanACell) {
  const auto plate = [](const char* thickness) {
    return domain +
           "[[body]]\nname = \"plate\"\nmaterial = \"copper.toml\"\nshape = { box = { lower = [\"-2 mm\", "
           "\"-2 mm\", \"-5 mm\"], upper = [\"2 mm\", \"2 mm\", \"" +
           std::string(thickness) + "\"] } }\n";
  };
  const std::vector<std::string> thin = placement_warnings(read_case_text(plate("-4.4 mm"), "case.toml"));
  ASSERT_EQ(thin.size(), 1U);
  EXPECT_EQ(thin[0].find("body \"plate\" is thinner than a cell: 0.6 mm along z, cells of 1 mm"), 0U)
      << thin[0];
  EXPECT_TRUE(placement_warnings(read_case_text(plate("-4 mm"), "case.toml")).empty());
}

// A quarter of a coarse sphere of whole particles is heavier than a quarter of the sphere, one of partial volumes is
// not; for a sphere cut by a mirror plane off its middle the remaining mass is unknown.
TEST(Bodies, WarnsOfBodiesWithoutTheirMass) {
  const auto warnings = [](const char* center, const std::string& more) {
    return placement_warnings(
        read_case_text(domain + "[[body]]\nname = \"sphere\"\nmaterial = \"copper.toml\"\n" + more +
                           "shape = { sphere = { radius = \"3.535 mm\", center = " + center + " } }\n",
                       "case.toml"));
  };
  const std::string whole = "discretization = { partial_volumes = false }\n";
  const std::vector<std::string> heavy = warnings("[\"0 mm\", \"0 mm\", \"-4 mm\"]", whole);
  ASSERT_EQ(heavy.size(), 1U);
  EXPECT_EQ(heavy[0].find("body \"sphere\": its particles have 2.5 % more volume and mass than its shape"),
            0U)
      << heavy[0];
  EXPECT_NE(heavy[0].find("discretization.partial_volumes = true"), std::string::npos);
  EXPECT_TRUE(warnings("[\"0 mm\", \"0 mm\", \"-4 mm\"]", "").empty());
  EXPECT_TRUE(warnings("[\"1 mm\", \"0 mm\", \"-4 mm\"]", "").empty());
}

// Their meshes would fill the memory before they can be refused.
TEST(Bodies, RefusesMoreElementsThanAMachineHolds) {
  const std::string elements = sphere + "discretization = { method = \"finite_elements\" }\n";
  expect_error(replaced(domain + elements, "cell_size = \"1 mm\"", "cell_size = \"0.02 mm\""),
               {"body \"sphere\" takes a lattice of", "elements"});
}

TEST(Bodies, AFaultyShapeIsNotPlaced) {
  const std::string text = replaced(domain + sphere, "radius = \"3 mm\"", "radius = \"-3 mm\"");
  const std::string error = error_of(text);
  EXPECT_NE(error.find("'radius' is -0.003 m"), std::string::npos) << error;
  EXPECT_EQ(error.find("reaches"), std::string::npos) << error;
}

TEST(Bodies, RefusesElementsThatCannotBe) {
  const std::string elements = sphere + "discretization = { method = \"finite_elements\" }\n";
  EXPECT_EQ(error_of(domain + elements), "");
  expect_error(replaced(domain, "end =", "scheme = \"musl\"\nend =") + elements,
               {"finite elements work with time.scheme = \"symplectic\" only"});
  expect_error(domain + "[transfer]\nparticle_update = \"flip\"\nshape_function = \"linear\"\n" + elements,
               {"finite elements work with B-splines only"});
  expect_error(domain + "[heat]\nconduction = true\n" + elements, {"finite elements do not conduct heat"});
  expect_error(domain + sphere + "discretization = { method = \"adaptive\", element_size = \"2.1 mm\" }\n",
               {"'element_size' is 0.0021 m", "at most 2 cells"});
  expect_error(domain + sphere +
                   "[[body.node_condition]]\nlower = [0, 0, 0]\nupper = [0, 0, 0]\n"
                   "directions = [\"x\"]\n",
               {"a body of particles has no nodes"});
  const std::string shape = "{ sphere = { center = [\"0 mm\", \"0 mm\", \"-4 mm\"], radius = \"3 mm\" } }";
  expect_error(
      domain + replaced(elements, shape,
                        "{ cone = { base = [0, 0, 0], base_radius = \"2 mm\", height = \"1 mm\" } }"),
      {"structured meshes of box, cylinder, tube, sphere and ogive"});
  // A plane that does not halve a round body intersects its elements.
  expect_error(
      domain + replaced(elements, "[\"0 mm\", \"0 mm\", \"-4 mm\"]", "[\"0.3 mm\", \"0 mm\", \"-4 mm\"]"),
      {"the mirror plane x = 0 m cuts through element"});
  const std::string of_file = replaced(elements, "shape = " + shape, "");
  expect_error(domain + replaced(of_file, "\"finite_elements\"", "\"adaptive\", mesh = \"none.msh\""),
               {"none.msh"});
  expect_error(domain + replaced(elements, "\"finite_elements\"", "\"adaptive\", mesh = \"none.msh\""),
               {"'shape' or a 'discretization.mesh', not both"});
}

// Halves and quarters of round bodies at mirror planes have the corresponding fraction of the whole mesh, nodes exactly
// on the planes, and remain on them.
TEST(Elements, AreCutAtMirrorPlanes) {
  for (const std::string shape :
       {"sphere = { center = [0, 0, 0], radius = \"3 mm\" }",
        "cylinder = { center = [0, 0, 0], axis = \"x\", radius = \"3 mm\", height = \"5 mm\" }",
        "cylinder = { center = [0, 0, 0], axis = \"z\", radius = \"3 mm\", height = \"5 mm\" }",
        "tube = { base = [0, 0, 0], axis = \"z\", inner_radius = \"1 mm\", outer_radius = \"3 mm\", height = "
        "\"4 mm\" }",
        "box = { lower = [\"-3 mm\", \"-3 mm\", \"-1 mm\"], upper = [\"3 mm\", \"3 mm\", \"2 mm\"] }"}) {
    const std::string body =
        "[[body]]\nname = \"part\"\nmaterial = \"copper.toml\"\nvelocity = [\"100 m/s\", 0, "
        "0]\ndiscretization = { method = \"finite_elements\" }\nshape = { " +
        shape + " }\n";
    const Case part = read_case_text(domain + body, "case.toml");
    const Case whole =
        read_case_text(replaced(replaced(domain, "[\"0 mm\", \"0 mm\", ", "[\"-12 mm\", \"-12 mm\", "),
                                "boundary = { x_lower = \"symmetry\", y_lower = \"symmetry\" }", "") +
                           body,
                       "case.toml");
    const Seeding quarter = seed(part), all = seed(whole);
    EXPECT_NEAR(quarter.bodies[0].mass, 0.25 * all.bodies[0].mass, 0.02 * quarter.bodies[0].mass) << shape;
    EXPECT_LT(all.bodies[0].mass, (1 + 1e-12) * all.bodies[0].shape_mass) << shape;
    EXPECT_GT(all.bodies[0].mass, 0.85 * all.bodies[0].shape_mass) << shape;
    const fem::Mesh& mesh = quarter.meshes[0];
    std::size_t on_plane = 0;
    for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
      const Vector3& x = mesh.nodes.position[a];
      EXPECT_GE(x.head<2>().minCoeff(), 0.0);
      if (x[0] != 0.0) {
        EXPECT_EQ(mesh.nodes.constrained[a] & fem::constraint::x, 0);
        continue;
      }
      ++on_plane;
      EXPECT_NE(mesh.nodes.constrained[a] & fem::constraint::x, 0);
      EXPECT_EQ(mesh.nodes.velocity[a][0], 0.0);
    }
    EXPECT_GT(on_plane, 0U) << shape;
    EXPECT_LT(quarter.wall_impulse[0], 0.0);
    // The momentum transferred to the plane is accounted for, its energy is heat.
    EXPECT_NEAR(fem::totals(mesh).momentum[0] - quarter.wall_impulse[0], 100.0 * quarter.bodies[0].mass,
                1e-12 * quarter.bodies[0].mass * 100.0);
  }
}

// A file of Gmsh provides the mesh, and the shape by which overlaps are found.
TEST(Elements, ComeFromAMeshFile) {
  const auto path =
      std::filesystem::temp_directory_path() / ("whipple_" + std::to_string(::getpid()) + ".msh");
  io::write_text_atomically(path, R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
1
3 7 "brick"
$EndPhysicalNames
$Nodes
12
1 0 0 0
2 2 0 0
3 2 2 0
4 0 2 0
5 0 0 1
6 2 0 1
7 2 2 1
8 0 2 1
9 0 0 2.5
10 2 0 2.5
11 2 2 2.5
12 0 2 2.5
$EndNodes
$Elements
2
1 5 2 7 1 1 2 3 4 5 6 7 8
2 5 2 7 1 5 6 7 8 9 10 11 12
$EndElements
)");
  const std::string body =
      "[[body]]\nname = \"brick\"\nmaterial = \"copper.toml\"\ndiscretization = { method = "
      "\"adaptive\", element_size = \"2 mm\", mesh_unit = \"1 mm\", mesh = \"" +
      path.string() + "\" }\n";
  const Case setup = read_case_text(domain + body, "case.toml");
  const Seeding seeding = seed(setup);
  ASSERT_EQ(seeding.meshes.size(), 1U);
  EXPECT_EQ(seeding.meshes[0].elements.size(), 2U);
  EXPECT_NEAR(seeding.bodies[0].mass, seeding.bodies[0].shape_mass, 1e-12 * seeding.bodies[0].mass);
  EXPECT_NEAR(seeding.bodies[0].shape_mass / setup.materials[0]->reference.density, 10e-9, 1e-20);
  const Shape& shape = *setup.bodies[0].shape;
  EXPECT_TRUE(shape.contains(Vector3(1.9e-3, 0.1e-3, 2.4e-3)));
  EXPECT_FALSE(shape.contains(Vector3(1.9e-3, 0.1e-3, 2.6e-3)));
  // Particles fill the mesh, also where they are on a face between two elements.
  const Seeding filled = seed(read_case_text(domain + replaced(body, "adaptive", "particles"), "case.toml"));
  EXPECT_TRUE(filled.meshes.empty());
  EXPECT_NEAR(filled.bodies[0].mass, filled.bodies[0].shape_mass, 1e-9 * filled.bodies[0].mass);
  // The file that a run writes can be read back.
  EXPECT_EQ(read_case_text(to_toml(setup, {"copper.toml"}), "run.toml").bodies[0].discretization.mesh,
            path.string());
  // From any folder: a path outside of the present one is written in full.
  const std::string beside = std::filesystem::relative(path).string();
  const Case relative = read_case_text(domain + replaced(body, path.string(), beside), "case.toml");
  EXPECT_EQ(relative.bodies[0].discretization.mesh, path.string());
  expect_error(domain + body + replaced(sphere, "\"-4 mm\"", "\"0 mm\""), {"overlaps body \"brick\""});
  expect_error(domain + body + "[[detonation]]\nposition = [0, 0, 0]\nbody = \"stone\"\n",
               {"there is no body \"stone\"", "with burn.lighting = \"straight\" only"});
  expect_error(domain + replaced(body, "mesh_unit", "group = \"stone\", mesh_unit"), {"stone", "brick"});
  std::filesystem::remove(path);
}

TEST(Seeding, FillsShapesWithTheirMass) {
  const std::string bodies = R"(
[[body]]
name = "disk"
material = "copper.toml"
shape = { cylinder = { center = ["0 mm", "0 mm", "-4 mm"], axis = "z", radius = "5.59 mm", height = "3.45 mm" } }
[[body]]
name = "plate"
material = "aluminium.toml"
discretization = { per_cell = 27 }
shape = { box = { lower = ["-10 mm", "-10 mm", "0 mm"], upper = ["10 mm", "10 mm", "2.87 mm"] } }
)";
  const Case setup = read_case_text(replaced(domain, "\"1 mm\"", "\"0.4 mm\"") + bodies, "case.toml");
  const Seeding seeding = seed(setup);
  ASSERT_EQ(seeding.bodies.size(), 2U);
  // Quarter of the disk: the lattice fits 3.45 mm exactly, the circle up to the staircase of the particles.
  EXPECT_NEAR(4 * seeding.bodies[0].mass, seeding.bodies[0].shape_mass, 0.01 * seeding.bodies[0].shape_mass);
  EXPECT_NEAR(4 * seeding.bodies[1].mass, seeding.bodies[1].shape_mass, 1e-9 * seeding.bodies[1].shape_mass);
  const double rho = initial_state(*setup.materials[1]).density;
  EXPECT_NEAR(seeding.bodies[1].shape_mass, rho * 0.02 * 0.02 * 2.87e-3, 1e-9);
  for (const Vector3& x : seeding.particles.position) EXPECT_TRUE(x[0] > 0 && x[1] > 0);
}

TEST(Initial, BodyStartsInTheStateThatItsTableGives) {
  const Case setup = read_case_text(
      domain + sphere + "initial = { pressure = \"1 bar\", temperature = \"600 K\" }\n", "case.toml");
  const Seeding seeding = seed(setup);
  const eos::State state = initial_state(*setup.materials[0], {}, 600.0, 1e5);
  for (const std::size_t p : {std::size_t{0}, seeding.particles.size() - 1}) {
    EXPECT_EQ(seeding.particles.temperature[p], state.temperature);
    EXPECT_EQ(seeding.particles.specific_internal_energy[p], state.specific_internal_energy);
    EXPECT_NEAR(seeding.particles.mass[p] / seeding.particles.volume[p], state.density, 1e-9 * state.density);
  }
  expect_error(domain + sphere + "initial = { pressure = \"-50 GPa\" }\n",
               {"case.toml:", "initial state", "copper"});
  expect_error(domain + sphere +
                   "initial = { pressure = \"1 bar\", temperature = \"300 K\", density = \"9 g/cm^3\" }\n",
               {"two of them"});
  expect_error(domain + sphere + "initial = { pressure = \"1 m\", temprature = \"300 K\" }\n",
               {"wrong dimension", "did you mean \"temperature\""});
  expect_error(domain + sphere + "initial = { temperature = \"-3 K\" }\n", {"'temperature'", "> 0"});
}

TEST(FailureScatter, FollowsTheWeibullDistributionOfMeanOneAndItsEffectOfSize) {
  FailureScatter scatter;
  scatter.weibull_modulus = 6.0;
  scatter.seed = 3;
  constexpr std::uint64_t n = 200000;
  double sum = 0.0;
  std::uint64_t below = 0;
  const double median = std::pow(std::numbers::ln2, 1.0 / 6.0) / std::tgamma(1.0 + 1.0 / 6.0);
  for (std::uint64_t id = 0; id < n; ++id) {
    const double k = scatter.factor(id, 1e-9);
    ASSERT_GT(k, 0.0);
    sum += k;
    if (k < median) ++below;
  }
  EXPECT_NEAR(sum / n, 1.0, 2e-3);  // five standard errors
  EXPECT_NEAR(static_cast<double>(below) / n, 0.5, 6e-3);
  FailureScatter sized = scatter;
  sized.reference_volume = 1e-9;
  EXPECT_EQ(sized.factor(7, 1e-9), scatter.factor(7, 1e-9));
  EXPECT_NEAR(sized.factor(7, 64e-9), 0.5 * scatter.factor(7, 1e-9), 1e-12);  // 64^(-1/6)
  scatter.seed = 4;
  EXPECT_NE(scatter.factor(7, 1e-9), sized.factor(7, 1e-9));
}

TEST(Bodies, ExpandAboutTheirCentre) {
  const Case setup = read_case_text(
      domain + sphere + "expansion_rate = [\"1e4 1/s\", \"0 1/s\", \"-2e4 1/s\"]\n", "case.toml");
  const Particles particles = seed(setup).particles;
  const Shape::Bounds bounds = setup.bodies[0].shape->bounds();
  const Vector3 centre = 0.5 * (bounds.lower + bounds.upper), rate(1e4, 0.0, -2e4);
  ASSERT_GT(particles.size(), 0U);
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const Vector3 expected = setup.bodies[0].velocity + rate.cwiseProduct(particles.position[p] - centre);
    EXPECT_LT((particles.velocity[p] - expected).norm(), 1e-9);
    EXPECT_LT((particles.affine_velocity[p] - Matrix3(rate.asDiagonal())).norm(), 1e-9);
  }
}

TEST(Bodies, HaveVelocityFieldsForCracksAsLongAsThereAreSome) {
  const std::string cracks = "failure = { cracks = \"fields\" }\n";
  Case setup = read_case_text(domain + sphere + cracks, "case.toml");
  EXPECT_EQ(setup.contact_fields.cracked, std::vector<std::uint8_t>{0});
  EXPECT_TRUE(setup.contact_fields.warnings.empty());
  setup.bodies.resize(5, setup.bodies[0]);  // 5 and 14 of each: four have room
  ContactFields found{.of_body = {0, 1, 2, 3, 4}, .cracked = {}, .remarks = {}, .warnings = {}};
  EXPECT_EQ(cracked_fields(setup, found), (std::vector<std::uint8_t>{0, 1, 2, 3}));
  ASSERT_EQ(found.warnings.size(), 1U);
  EXPECT_NE(found.warnings[0].find("do not part"), std::string::npos);
  found = {.of_body = {0, 0, 1, 2, 3}, .cracked = {}, .remarks = {}, .warnings = {}};
  setup.bodies[1].failure.cracks = CrackMotion::none;
  EXPECT_EQ(cracked_fields(setup, found), (std::vector<std::uint8_t>{0, 1, 2, 3}));
  ASSERT_EQ(found.remarks.size(), 1U);
  EXPECT_NE(found.remarks[0].find("cracks of either"), std::string::npos);
  expect_error(domain + sphere + cracks + "discretization = { method = \"finite_elements\" }\n",
               {"cracks", "part particles"});
  const std::string end = "end = \"4 us\"";
  expect_error(replaced(domain, end, end + "\nscheme = \"musl\"") + sphere + cracks,
               {"cracks", "symplectic"});
}

TEST(FailureScatter, KnowsTheVolumeOfParticlesInTwoDimensions) {
  for (const std::string dimension : {"plane_strain", "axisymmetric"}) {
    const Case setup = read_case_text(
        "[domain]\ndimension = \"" + dimension +
            "\"\nlower = [\"0 mm\", \"0 mm\"]\nupper = [\"8 mm\", \"8 mm\"]\ncell_size = \"1 mm\"\n"
            "[time]\nend = \"1 us\"\n[[body]]\nname = \"block\"\nmaterial = \"copper.toml\"\n"
            "shape = { box = { lower = [\"1 mm\", \"1 mm\", \"-5 mm\"], upper = [\"5 mm\", \"5 mm\", \"5 "
            "mm\"] } }\n"
            "failure_scatter = { weibull_modulus = 3, seed = 5, reference_volume = \"1 mm^3\" }\n",
        "case.toml");
    const Seeding seeding = seed(setup);
    const Particles& particles = seeding.particles;
    ASSERT_GT(particles.size(), 16U) << dimension;
    for (std::size_t p = 0; p < particles.size(); ++p) {
      const double volume = particles.volume[p];
      EXPECT_NEAR(particles.failure_threshold_factor[p],
                  setup.bodies[0].failure_scatter.factor(particles.id[p], volume), 1e-12)
          << dimension;
    }
  }
}

TEST(FailureScatter, IsTheSameForAnyNumberOfRanksAndIsReadAndWritten) {
  const Case setup = read_case_text(
      domain + sphere +
          "failure_scatter = { weibull_modulus = 8, seed = 5, reference_volume = \"1 mm^3\" }\n",
      "case.toml");
  const Seeding whole = seed(setup);
  std::size_t at = 0;
  for (int rank = 0; rank < 3; ++rank) {
    const Seeding part = seed(setup, rank, 3);
    for (std::size_t p = 0; p < part.particles.size(); ++p, ++at) {
      ASSERT_EQ(part.particles.id[p], whole.particles.id[at]);
      ASSERT_EQ(part.particles.failure_threshold_factor[p], whole.particles.failure_threshold_factor[at]);
    }
  }
  EXPECT_NE(whole.particles.failure_threshold_factor[0], whole.particles.failure_threshold_factor[1]);
  const Case again = read_case_text(to_toml(setup, {"copper.toml"}), "run.toml");
  EXPECT_EQ(again.bodies[0].failure_scatter.seed, 5);
  EXPECT_EQ(again.bodies[0].failure_scatter.weibull_modulus, 8.0);
  EXPECT_FALSE(again.bodies[0].initial.given());
  expect_error(domain + sphere + "failure_scatter = { seed = 5 }\n", {"missing key 'weibull_modulus'"});
  expect_error(domain + sphere + "failure_scatter = { weibull_modulus = 0 }\n", {"'weibull_modulus'", "> 0"});
}

// The mass of a sphere: whole particles reproduce it within per cents, partial ones within some 1e-4, and none of these
// is much lighter than its neighbours.
TEST(PartialVolumes, MeetTheMassOfACurvedBody) {
  const auto error = [](bool partial) {
    const Case setup = read_case_text(
        "[time]\nend = 1\n[domain]\nlower = [-0.01, -0.01, -0.01]\nupper = [0.01, 0.01, 0.01]\ncell_size = "
        "0.001\n[[body]]\nname "
        "= \"sphere\"\nmaterial = \"copper.toml\"\ndiscretization = { partial_volumes = " +
            std::string(partial ? "true" : "false") +
            " }\nshape = { sphere = { center = [0.0002, 0.0003, 0.0001], radius = 0.0037 } }\n",
        "case.toml");
    const Seeding seeding = seed(setup);
    Vector3 center = Vector3::Zero();
    double mass = 0, second = 0;
    const auto [lightest, heaviest] = std::ranges::minmax(seeding.particles.mass);
    EXPECT_GE(lightest, 0.125 * heaviest);
    for (std::size_t p = 0; p < seeding.particles.size(); ++p) {
      const double m = seeding.particles.mass[p];
      const SymmetricTensor& e = seeding.particles.extent[p];
      const Vector3 r = seeding.particles.position[p] - Vector3(0.0002, 0.0003, 0.0001);
      mass += m;
      center += m * r;
      second += m * (r.squaredNorm() + (e.xx + e.yy + e.zz) / 3);
    }
    EXPECT_NEAR(mass, seeding.bodies[0].mass, 1e-12 * mass);
    EXPECT_LT((center / mass).norm(), 1e-6);
    const double of_mass = mass / seeding.bodies[0].shape_mass - 1;
    const double exact = 0.6 * 0.0037 * 0.0037;  // mean square radius of a sphere
    std::printf("partial volumes %d: mass %+.2e, second moment %+.2e\n", partial, of_mass,
                second / mass / exact - 1);
    return std::pair(std::abs(of_mass), std::abs(second / mass / exact - 1));
  };
  const auto whole = error(false), partial = error(true);
  EXPECT_GT(whole.first, 2e-3);
  EXPECT_LT(partial.first, 1e-3);
  EXPECT_LT(partial.second, 1e-3);
}

// An oblique plate of a third of a particle has slivers in many cells, and conserves its mass whichever of them become
// particles.
TEST(PartialVolumes, KeepAPlateThinnerThanAParticle) {
  const Case setup = read_case_text(
      "[time]\nend = 1\n[domain]\nlower = [-0.01, -0.01, -0.01]\nupper = [0.01, 0.01, 0.01]\ncell_size = "
      "0.001\n[[body]]\nname = \"plate\"\nmaterial = \"copper.toml\"\ndiscretization = { partial_volumes = "
      "true }\n"
      "shape = { moved = { angle = \"20 deg\", axis = [0, 1, 0], shape = { box = { lower = [-0.005, -0.004, "
      "0], "
      "upper = [0.005, 0.004, 0.00017] } } } }\n",
      "case.toml");
  const Seeding seeding = seed(setup);
  const double mass = std::reduce(seeding.particles.mass.begin(), seeding.particles.mass.end());
  EXPECT_GT(seeding.particles.size(), 100U);
  EXPECT_NEAR(mass, seeding.bodies[0].mass, 1e-12 * mass);
  EXPECT_NEAR(mass, seeding.bodies[0].shape_mass, 0.1 * mass);  // sampled every 0.125 mm or less
}

}  // namespace
}  // namespace whipple::cases
