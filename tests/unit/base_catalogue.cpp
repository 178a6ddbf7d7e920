// SPDX-License-Identifier: BSD-3-Clause
// A catalogue of two toy models: constants are read before anything is built, files are named as companions, and
// unknown names are answered with the nearest one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "src/core/base/catalogue.hpp"

namespace whipple {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct Spring {
  virtual ~Spring() = default;
  [[nodiscard]] virtual double force(double length) const = 0;
};

struct Linear {
  double stiffness = 2.0;
  std::string file;
  static ParameterTable<Linear> parameters() {
    return {real("stiffness", &Linear::stiffness, "N/m", range::positive(), "force over length").optional(),
            text("file", &Linear::file, "where it comes from").optional()};
  }
};

struct LinearSpring final : Spring {
  LinearSpring(const Linear& constants, double scale) : k(constants.stiffness * scale) {
    if (k > 1e3) throw InputError("too stiff");
  }
  [[nodiscard]] double force(double length) const override { return k * length; }
  double k;
};

using SpringEntry = CatalogueEntry<const Spring, double>;

Catalogue<SpringEntry> springs() {
  const auto build = [](const Linear& constants, double scale) {
    return std::make_unique<const LinearSpring>(constants, scale);
  };
  return {"spring",
          {catalogue_entry<SpringEntry>("linear", "force by length", "F = k x", &Linear::parameters, build),
           catalogue_entry<SpringEntry>(
               "filed", "linear, from a file", "", &Linear::parameters, build,
               [](const Linear& c) { return std::vector<std::filesystem::path>{c.file}; })}};
}

/// Sets the stiffness, and the file where there is one.
ParameterReader reader(double stiffness) {
  return [stiffness](std::span<const BoundParameter> parameters) {
    for (const BoundParameter& parameter : parameters) {
      if (double* const* number = std::get_if<double*>(&parameter.target)) **number = stiffness;
      if (std::string* const* word = std::get_if<std::string*>(&parameter.target)) **word = "springs.csv";
    }
  };
}

TEST(Catalogue, BuildsWhatItHasRead) {
  const Catalogue<SpringEntry> all = springs();
  const SpringEntry::Declared linear = all.at("linear").declare(reader(5.0));
  EXPECT_EQ(linear.build(2.0)->force(3.0), 30.0);
  EXPECT_TRUE(linear.companions.empty());
  const SpringEntry::Declared stiff = all.at("linear").declare(reader(1e4));  // read without a fault
  EXPECT_THROW(stiff.build(1.0), InputError);
  EXPECT_THAT(all.at("filed").declare(reader(1.0)).companions, ElementsAre("springs.csv"));
}

TEST(Catalogue, DescribesItsEntries) {
  const Catalogue<SpringEntry> all = springs();
  EXPECT_THAT(all.names(), ElementsAre("linear", "filed"));
  EXPECT_EQ(all.size(), 2U);
  EXPECT_EQ(all.find("cubic"), nullptr);
  EXPECT_EQ(all.describe(), "linear              force by length\nfiled               linear, from a file\n");
  EXPECT_THAT(all.describe("linear"), HasSubstr("linear: force by length\nF = k x\n"));
  EXPECT_THAT(all.describe("filed"), HasSubstr("stiffness"));
  try {
    static_cast<void>(all.describe("linaer"));
    FAIL() << "an unknown name was taken";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "unknown spring \"linaer\", did you mean \"linear\"?; known: linear, filed");
  }
}

}  // namespace
}  // namespace whipple
