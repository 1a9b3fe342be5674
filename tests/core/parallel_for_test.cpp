#include "core/parallel_for.h"

#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace walktrack {
namespace {

TEST(ParallelFor, VisitsEveryIndexOnceForAnyThreadCount) {
  for (const int threads : {1, 2, 8}) {
    for (const size_t n : {size_t{0}, size_t{1}, size_t{7}, size_t{10000}}) {
      std::vector<int> visits(n, 0);
      parallel_for(n, threads, [&](size_t i) { ++visits[i]; });
      EXPECT_EQ(visits, std::vector<int>(n, 1)) << threads << " threads, n = " << n;
    }
  }
}

TEST(ParallelFor, ExceptionsReachTheCaller) {
  const auto fail = [](size_t i) {
    if (i == 50) throw std::runtime_error("50");
  };
  EXPECT_THROW(parallel_for(100, 1, fail), std::runtime_error);
  EXPECT_THROW(parallel_for(100, 4, fail), std::runtime_error);
}

TEST(RunBeside, DoesBothAlsoWhereOneSharesItsWork) {
  for (const int threads : {1, 2, 8}) {
    for (int repeat = 0; repeat < 50; ++repeat) {
      std::vector<int> here(500, 0), beside(500, 0);
      run_beside(
          threads, [&] { parallel_for(here.size(), threads, [&](size_t i) { ++here[i]; }); },
          [&] { parallel_for(beside.size(), threads, [&](size_t i) { ++beside[i]; }); });
      ASSERT_EQ(here, std::vector<int>(500, 1));
      ASSERT_EQ(beside, std::vector<int>(500, 1));
    }
  }
}

TEST(RunBeside, EndsBothBeforeAnExceptionReachesTheCaller) {
  const auto fail = [] { throw std::runtime_error("one"); };
  for (const int threads : {2, 8}) {
    bool done = false;
    EXPECT_THROW(run_beside(threads, fail, [&] { done = true; }), std::runtime_error);
    EXPECT_TRUE(done);
    done = false;
    EXPECT_THROW(run_beside(
                     threads, [&] { done = true; }, fail),
                 std::runtime_error);
    EXPECT_TRUE(done);
    EXPECT_THROW(run_beside(threads, fail, fail), std::runtime_error);
  }
}

}  // namespace
}  // namespace walktrack
