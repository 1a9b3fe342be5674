#include "io/archive/files.h"

#include <sys/stat.h>

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;

size_t file_count(const fs::path& folder) {
  return static_cast<size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(ReadTextFile, ReadsAllBytesAndRefusesTheRest) {
  const TemporaryFolder folder;
  const std::string text = "a\r\n\0b" + std::string(100'000, 'x');
  EXPECT_EQ(read_text_file(folder.write("t", text), 1 << 20), text);
  EXPECT_EQ(read_text_file(folder.write("empty", ""), 10), "");
  EXPECT_THROW(read_text_file(folder / "t", 1000), InputError);
  EXPECT_THROW(read_text_file(folder / "none", 10), InputError);
  EXPECT_THROW(read_text_file(folder.path(), 10), InputError);
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);  // without a writer: reading would hang
  EXPECT_THROW(read_text_file(folder / "pipe", 10), InputError);
}

TEST(NewTemporary, IsAFileOfItsOwnWhoseNameSaysWhatFor) {
  const TemporaryFolder folder;
  const fs::path wanted = folder.path() / "a.csv", one = new_temporary(wanted),
                 other = new_temporary(wanted, ".mp4");
  EXPECT_TRUE(fs::is_regular_file(one));
  EXPECT_EQ(name_of_temporary(one.string()), wanted.string());
  EXPECT_EQ(name_of_temporary(other.string()), wanted.string());
  for (const char* name : {"a.csv", "a.tmp", "a..tmp", ".12.tmp.csv", "12.tmp", "a.1x.tmp"})
    EXPECT_EQ(name_of_temporary(name), "") << name;
}

TEST(NewFolder, IsAnotherEachTimeAndNobodyElses) {
  const TemporaryFolder folder;
  const fs::path one = new_folder(folder.path() / "work_"), other = new_folder(folder / "work_");
  EXPECT_NE(one, other);
  EXPECT_TRUE(fs::is_empty(one));
  EXPECT_EQ(fs::status(one).permissions(), fs::perms::owner_all);
  EXPECT_THROW(new_folder(folder / "none/work_"), std::runtime_error);
}

TEST(NumberFromText, TakesCNotationAndNothingElse) {
  EXPECT_EQ(number_from_text(" -1.5e3\r"), -1500);
  EXPECT_EQ(number_from_text("+2"), 2);
  for (const char* bad : {"", " ", "nan", "inf", "1,5", "0x10", "1 2", "1.5m", "--1", "+-1"}) {
    EXPECT_EQ(number_from_text(bad), std::nullopt) << bad;
  }
}

TEST(ShortestNumber, ReadsBackTheSame) {
  for (const double value : {0.1, 1.0 / 3, -1e-300, 12345678.9, 5.0, 0.0}) {
    EXPECT_EQ(number_from_text(shortest_number(value)), value);
  }
  EXPECT_EQ(shortest_number(0.1), "0.1");
}

TEST(WriteFileAtomically, ReplacesAndLeavesNothingElse) {
  const TemporaryFolder folder;
  write_file_atomically(folder / "a", "one");
  write_file_atomically(folder / "a", "two");
  EXPECT_EQ(read_file(folder / "a"), "two");
  EXPECT_EQ(file_count(folder.path()), 1u);
}

TEST(WriteFileAtomically, SaysWhichFileCannotBeWritten) {
  const TemporaryFolder folder;
  try {
    write_file_atomically(folder / "none/a", "x");
    FAIL() << "wrote into a folder that does not exist";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("none/a"));
  }
}

TEST(RefuseExisting, AsksForPermission) {
  const TemporaryFolder folder;
  const std::string file = folder.write("a", "");
  EXPECT_THROW(refuse_existing(file, false), UsageError);
  EXPECT_NO_THROW(refuse_existing(file, true));
  EXPECT_NO_THROW(refuse_existing(folder / "b", false));
}

TEST(Resolved, IsRelativeToTheBase) {
  EXPECT_EQ(resolved("/a/b", "c/../d.mp4"), "/a/b/d.mp4");
  EXPECT_EQ(resolved("/a/b", "/c"), "/c");
  EXPECT_EQ(resolved("", "c"), "c");
}

}  // namespace
}  // namespace walktrack
