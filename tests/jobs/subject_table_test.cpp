#include "jobs/batch/subject_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace walktrack {
namespace {

using testing::HasSubstr;
using testing::Not;

SequenceResult result(SequenceState state, double speed) {
  SequenceResult out{.state = state};
  out.figures[1] = speed;
  return out;
}

TEST(SubjectTable, KnowsTheSubjectByBidsOrByTheFirstFolder) {
  EXPECT_EQ(subject_of("anna/monday/trial1"), "anna");
  EXPECT_EQ(subject_of("trial1"), "");
  EXPECT_EQ(subject_of("results/sub-01_ses-2_task-walk_run-1"), "sub-01");
  EXPECT_EQ(subject_of("sub-01_task-walk_video"), "sub-01");
}

TEST(SubjectTable, HasMeansOverCompleteSequences) {
  SubjectSums sums;
  add_to_subject("anna/1", result(SequenceState::kComplete, 1), sums);
  add_to_subject("anna/2", result(SequenceState::kComplete, 1.5), sums);
  add_to_subject("anna/3", result(SequenceState::kDegraded, 9), sums);
  add_to_subject("b<b>/1", result(SequenceState::kFailed, 9), sums);
  add_to_subject("alone", result(SequenceState::kComplete, 9), sums);
  ASSERT_EQ(sums.size(), 2u);
  EXPECT_EQ(sums["anna"].sequences, 3);
  EXPECT_EQ(sums["anna"].complete, 2);
  const std::string html = subjects_html(sums);
  EXPECT_THAT(html, HasSubstr("<td class=\"number\">3</td><td class=\"number\">2</td>"));
  EXPECT_THAT(html, HasSubstr("<td class=\"number\">1.25</td>"));
  EXPECT_THAT(html, Not(HasSubstr("9.0")));
  EXPECT_THAT(html, HasSubstr("b&lt;b&gt;"));
}

TEST(SubjectTable, IsNotThereWhereNobodyHasTwo) {
  SubjectSums sums;
  EXPECT_EQ(subjects_html(sums), "");
  add_to_subject("anna/1", result(SequenceState::kComplete, 1), sums);
  add_to_subject("bert/1", result(SequenceState::kComplete, 1), sums);
  EXPECT_EQ(subjects_html(sums), "");
}

}  // namespace
}  // namespace walktrack
