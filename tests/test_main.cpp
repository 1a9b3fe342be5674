// Every test draws its random numbers from generators keyed by its own name, so that the order of
// tests does not matter and nothing is seeded here. Temporary files are written into a folder of
// this process, so that the same tests can run twice at a time.
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
