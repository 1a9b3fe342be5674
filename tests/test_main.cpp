// Every test draws its random numbers from generators keyed by its own name, so the order of tests
// never matters and no seeding happens here.
#include <gtest/gtest.h>

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
