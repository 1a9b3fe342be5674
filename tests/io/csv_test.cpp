#include "io/tables/csv.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "tests/message_of.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

using testing::HasSubstr;

TEST(Csv, ReadsCommentsBlanksAndLineEnds) {
  const CsvTable table = csv_from_text("# note\r\n\nt, x ,side\r\n0,1.5,l\n1,,r", "f.csv");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"t", "x", "side"}));
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0].line, 4);
  EXPECT_EQ(table.number(table.rows[0], table.column("x")), 1.5);
  EXPECT_EQ(table.optional_number(table.rows[1], 1), std::nullopt);
  EXPECT_EQ(table.rows[1].cells[2], "r");
}

TEST(Csv, NamesLineAndColumn) {
  EXPECT_EQ(message_of([] { csv_from_text("# only\n", "f.csv"); }), "f.csv: found no header line");
  EXPECT_EQ(message_of([] { csv_from_text("t,t\n", "f.csv"); }),
            "f.csv:1: found a column twice, allowed: names of their own");
  EXPECT_EQ(message_of([] { csv_from_text("t,x\n1\n", "f.csv"); }),
            "f.csv:2: found 1 cells, allowed: 2, as in the header");
  const CsvTable table = csv_from_text("t,lknee_x\n0,nan\n,1\n", "f.csv");
  EXPECT_EQ(message_of([&] { table.number(table.rows[0], 1); }),
            "f.csv:2: lknee_x: found 'nan', allowed: a number");
  EXPECT_EQ(message_of([&] { table.number(table.rows[1], 0); }),
            "f.csv:3: t: found '', allowed: a number");
  EXPECT_THAT(message_of([&] { table.column("lkne_x"); }),
              HasSubstr("no column 'lkne_x', allowed: it; is 'lknee_x' meant?"));
}

TEST(CsvNumber, IsFixedAndNeverNegativeZero) {
  EXPECT_EQ(csv_number(1.23456789), "1.234568");
  EXPECT_EQ(csv_number(-1e-9), "0.000000");
  EXPECT_EQ(csv_number(-1e-6), "-0.000001");
  EXPECT_EQ(csv_number(NAN), "");
}

TEST(ReadCsvColumns, TakesWhatIsAskedForAndIsAsStrictAsTheTable) {
  const TemporaryFolder folder;
  const std::string file = folder.write("t.csv", "# note\nt,a,b\n0,1,2\n\n1,,4\n");
  const auto columns = read_csv_columns(file, {"b", "a"});
  EXPECT_THAT(columns[0], testing::ElementsAre(2, 4));
  EXPECT_EQ(columns[1][0], 1);
  EXPECT_TRUE(std::isnan(columns[1][1]));
  EXPECT_THROW(read_csv_columns(file, {"c"}), InputError);
  EXPECT_THROW(read_csv_columns(folder.write("bad", "t,a\n1,x\n"), {"a"}), InputError);
  EXPECT_THROW(read_csv_columns(folder.write("short", "t,a\n1\n"), {"a"}), InputError);
  EXPECT_THROW(read_csv_columns(folder.write("none", "# nothing\n"), {"a"}), InputError);
  EXPECT_THROW(read_csv_columns(folder / "missing", {"a"}), InputError);
}

}  // namespace
}  // namespace walktrack
