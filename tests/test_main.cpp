// Every test draws its random numbers from generators keyed by its own name, so the order of tests
// never matters and no seeding happens here. Temporary files go into a folder of this process's
// own, so that the same tests can run twice at a time.
//
// Ends with 77 if every test skipped itself, which CTest shows where it is told that code.
#include <cstdlib>

#include <gtest/gtest.h>

#include "tests/run_program.h"

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  const walktrack::TemporaryFolder scratch;
  setenv("TMPDIR", scratch.path().c_str(), 1);
  setenv("TEST_TMPDIR", scratch.path().c_str(), 1);
  const int failed = RUN_ALL_TESTS();
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  const bool all_skipped =
      all.test_to_run_count() > 0 && all.skipped_test_count() == all.test_to_run_count();
  return failed == 0 && all_skipped ? 77 : failed;
}
