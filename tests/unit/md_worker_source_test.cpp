// SPDX-License-Identifier: BSD-3-Clause
// Where the states of a simulated crystal are kept; the simulations themselves are tested through the command
// (eos_md_command_test).
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "md_fitting/simulated_crystal/worker_source.hpp"
#include "src/core/base/error.hpp"

namespace whipple::md {
namespace {

TEST(WorkerSource, StoresLieInTheCacheOfTheUser) {
  eos::SimulatedConstants constants;
  constants.element = "Cu";
  constants.potential = "/potentials/Cu_u3.eam";
  setenv("XDG_CACHE_HOME", "/cache", 1);
  EXPECT_EQ(default_store(constants), "/cache/whipple/md/Cu_Cu_u3.eam.md.h5");
  unsetenv("XDG_CACHE_HOME");
  setenv("HOME", "/home/user", 1);
  EXPECT_EQ(default_store(constants), "/home/user/.cache/whipple/md/Cu_Cu_u3.eam.md.h5");
  unsetenv("HOME");
  EXPECT_THROW(default_store(constants), InputError);
}

TEST(WorkerSource, RefusesARelativeStore) {
  eos::SimulatedConstants constants;
  constants.element = "Cu";
  constants.potential = "Cu_u3.eam";
  constants.store = "copper.md.h5";
  try {
    worker_source(constants);
    FAIL() << "a relative store was taken";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("expected an absolute path"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace whipple::md
