// Every test draws its random numbers from generators keyed by its own name, so the order of tests
// never matters and no seeding happens here. Temporary files go into a folder of this process's
// own, so that the same tests can run twice at a time.
#include <cstdlib>

#include <gtest/gtest.h>

#include "tests/run_program.h"

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  const walktrack::TemporaryFolder scratch;
  setenv("TMPDIR", scratch.path().c_str(), 1);
  setenv("TEST_TMPDIR", scratch.path().c_str(), 1);
  return RUN_ALL_TESTS();
}
