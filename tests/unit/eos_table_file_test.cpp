// SPDX-License-Identifier: BSD-3-Clause
// Files of tables: what is written is read back bit by bit; what is cut short, foreign, of another version or
// changed is refused with the reason.
#include <gmock/gmock.h>
#include <hdf5.h>

#include <cstdlib>
#include <fstream>

#include "eos/files/table_file.hpp"
#include "src/core/base/error.hpp"
#include "src/core/hdf5/hdf5.hpp"
#include "src/material/material_file.hpp"
#include "tests/unit/eos_support.hpp"
#include "tests/unit/folder_test.hpp"

namespace whipple::eos {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

const test::GrayEos& copper() {
  static const test::GrayEos eos(test::copper());
  return eos;
}

class TableFiles : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    path_ = folder_ / "copper.eos.h5";
    static const TableFile file{tabulate(copper(), {.error = 1e-2}),
                                {{"solid", {.states = 7, .pressure = 0.5}}}};
    table_ = &file;
    write_table(path_, file);
  }
  [[nodiscard]] std::string refusal() const {
    return message_of<InputError>([&] { (void)read_table(path_); });
  }
  fs::path path_;
  const TableFile* table_ = nullptr;
};

TEST_F(TableFiles, are_read_back_bit_by_bit) {
  const TableFile file = read_table(path_);
  EXPECT_EQ(file.verification.at("solid").states, 7U);
  EXPECT_EQ(file.verification.at("solid").pressure, 0.5);
  EXPECT_EQ(file.data.constants, copper().constants());
  const Table before(table_->data), after(file.data);
  for (const double rho : {0.2, 900.0, 6000.0, 9000.0, 20000.0}) {
    for (const double T : {100.0, 1500.0, 9000.0}) {
      const State a = before.state_at_temperature(rho, T), b = after.state_at_temperature(rho, T);
      EXPECT_EQ(a.pressure, b.pressure);
      EXPECT_EQ(a.sound_speed, b.sound_speed);
      EXPECT_EQ(a.specific_entropy, b.specific_entropy);
      EXPECT_EQ(a.vaporised_fraction, b.vaporised_fraction);
      EXPECT_EQ(a.phase, b.phase);
    }
  }
}

TEST_F(TableFiles, that_are_missing_or_cut_short_or_foreign_are_refused) {
  fs::resize_file(path_, fs::file_size(path_) / 2);
  EXPECT_THAT(refusal(), AllOf(HasSubstr(path_.string()), HasSubstr("truncated")));
  std::ofstream(path_) << "no HDF5 at all\n";
  EXPECT_THAT(refusal(), AllOf(HasSubstr(path_.string()), HasSubstr("cannot open the file")));
  hdf5::File other = hdf5::File::create(path_, hdf5::File::Compatibility::compact);
  other.close();
  EXPECT_THAT(refusal(), HasSubstr("no table of an equation of state"));
  fs::remove(path_);
  EXPECT_THAT(refusal(), HasSubstr("does not exist"));
}

TEST_F(TableFiles, of_another_version_are_refused) {
  hdf5::File file = hdf5::File::open(path_, hdf5::File::Access::modify);
  H5Adelete(file.root.id(), "version");
  file.root.set_attribute("version", std::int64_t{99});
  file.close();
  EXPECT_THAT(refusal(), HasSubstr("version 99, this program reads version 4"));
}

TEST_F(TableFiles, that_were_changed_are_refused) {
  hdf5::File file = hdf5::File::open(path_, hdf5::File::Access::modify);
  {
    const hdf5::Dataset cells = file.root.open_dataset("cells");
    std::vector<double> values = cells.read_all<double>();
    values[values.size() / 2] += 1e-9;
    ASSERT_GE(H5Dwrite(cells.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
  }
  file.close();
  EXPECT_THAT(refusal(), HasSubstr("does not match its digest"));
}

TEST_F(TableFiles, are_models_of_materials) {
  const fs::path material = folder_ / "tabulated.toml";
  const auto write = [&](const std::string& file) {
    std::ofstream(material) << "name = \"Copper\"\nsource = \"test\"\n[eos]\nmodel = \"table\"\nfile = \""
                            << file << "\"\n";
  };
  write("copper.eos.h5");
  const Material read = read_material(material);
  EXPECT_EQ(read.eos->model(), "table");
  EXPECT_THAT(read.companions, ::testing::ElementsAre("copper.eos.h5"));
  EXPECT_NEAR(read.reference.temperature, copper().reference_temperature(), 1);
  write("nothing.eos.h5");
  EXPECT_THAT(message_of<InputError>([&] { (void)read_material(material); }),
              AllOf(HasSubstr("tabulated.toml:3"), HasSubstr("nothing.eos.h5: does not exist")));
  write("../copper.eos.h5");
  EXPECT_THAT(message_of<InputError>([&] { (void)read_material(material); }), HasSubstr("below the folder"));
}

TEST_F(TableFiles, of_the_cache_are_used_again_and_built_again_when_damaged) {
  const fs::path cache = folder_ / "cache";
  const TableRequest request{.error = 1e-2};
  int built = 0;
  const auto get = [&](const TableRequest& what) {
    built = 0;
    return cached_table(copper(), what, cache, "copper", serial(), [&](double) { built = 1; });
  };
  const TableData first = get(request);
  EXPECT_EQ(built, 1);
  const TableData second = get(request);
  EXPECT_EQ(built, 0);
  EXPECT_EQ(first.cells, second.cells);
  get({.error = 2e-2});
  EXPECT_EQ(built, 1) << "another request is another table";
  for (const auto& entry : fs::directory_iterator(cache)) fs::resize_file(entry.path(), 100);
  get(request);
  EXPECT_EQ(built, 1);
  get(request);
  EXPECT_EQ(built, 0);
  // The table of another material under the name of this one.
  GrayConstants constants = test::copper();
  constants.gruneisen *= 1.1;
  const TableFile other{tabulate(test::GrayEos(constants), request), {}};
  for (const auto& entry : fs::directory_iterator(cache)) write_table(entry.path(), other);
  EXPECT_EQ(get(request).constants, copper().constants());
  EXPECT_EQ(built, 1);
}

}  // namespace
}  // namespace whipple::eos
