#include "io/csv_table.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "core/errors.hpp"
#include "tests/io/full_disk.hpp"
#include "tests/support/temporary_folder.hpp"

namespace knap {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class Csv : public TemporaryFolder {
 protected:
  std::filesystem::path written(const std::string& text) {
    const std::filesystem::path path = folder / "table.csv";
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
};

TEST_F(Csv, NumbersReadBackToTheSameBits) {
  const double denormal = std::numeric_limits<double>::denorm_min();
  const std::vector<double> numbers{0.1, -0.0, 1.0 / 3.0, 1e-300, denormal, std::numeric_limits<double>::max(), -7.0};
  CsvTable table = CsvTable::create(folder / "t.csv", {"time [s]", "step"});
  for (std::size_t i = 0; i < numbers.size(); ++i) table.add_row({numbers[i], static_cast<std::int64_t>(i)});
  EXPECT_EQ(table.num_rows(), numbers.size());
  const CsvColumns read = read_csv(folder / "t.csv");
  EXPECT_THAT(read.header, ElementsAre("time [s]", "step"));
  ASSERT_EQ(read.values[0].size(), numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    EXPECT_EQ(read.values[0][i], numbers[i]);
    EXPECT_EQ(std::signbit(read.values[0][i]), std::signbit(numbers[i]));
    EXPECT_EQ(read.values[1][i], static_cast<double>(i));
  }
}

TEST_F(Csv, NotANumberAndInfinityReadBack) {
  CsvTable table = CsvTable::create(folder / "t.csv", {"x"});
  table.add_row({std::nan("")});
  table.add_row({-std::numeric_limits<double>::infinity()});
  const std::vector<double> x = read_csv(folder / "t.csv").column("x");
  EXPECT_TRUE(std::isnan(x.at(0)));
  EXPECT_EQ(x.at(1), -std::numeric_limits<double>::infinity());
}

TEST_F(Csv, EachRowIsOnDiskAtOnceAndStringsAreQuoted) {
  CsvTable table = CsvTable::create(folder / "t.csv", {"name", "mass, dry [kg]"});
  EXPECT_EQ(content(folder / "t.csv"), "name,\"mass, dry [kg]\"\n");
  table.add_row({"a \"big\" one\nhere", 0.5});
  EXPECT_EQ(content(folder / "t.csv"), "name,\"mass, dry [kg]\"\n\"a \"\"big\"\" one here\",0.5\n");
}

TEST_F(Csv, ResumeCutsLaterRowsAndAHalfWrittenLine) {
  const std::filesystem::path path = written("step,\"e, total [J]\"\n0,1\n1,2\n2,3\n3,0.12");
  CsvTable table = CsvTable::resume(path, 2);
  EXPECT_EQ(content(path), "step,\"e, total [J]\"\n0,1\n1,2\n");
  EXPECT_THAT(table.columns(), ElementsAre("step", "e, total [J]"));
  EXPECT_EQ(table.num_rows(), 2u);
  table.add_row({std::int64_t{2}, 9.0});
  EXPECT_EQ(content(path), "step,\"e, total [J]\"\n0,1\n1,2\n2,9\n");
}

TEST_F(Csv, ResumeAfterNoRowsKeepsTheHeader) {
  const std::filesystem::path path = written("step\n0\n1\n");
  CsvTable::resume(path, 0);
  EXPECT_EQ(content(path), "step\n");
}

TEST_F(Csv, ResumeWithTooFewRowsIsRefusedAndLeavesTheFile) {
  const std::string text = "step\n0\n1";
  const std::filesystem::path path = written(text);
  EXPECT_THAT(message_of<InputError>([&] { CsvTable::resume(path, 2); }), HasSubstr(path.string()));
  EXPECT_EQ(content(path), text);
  EXPECT_THROW(CsvTable::resume(folder / "missing.csv", 0), InputError);
  EXPECT_THROW(CsvTable::resume(written(""), 0), InputError);
}

TEST_F(Csv, FullDiskLeavesCompleteLines) {
  CsvTable table = CsvTable::create(folder / "t.csv", {"x"});
  const std::string message = message_of<RuntimeFailure>([&] {
    const FullDisk full(100);
    for (int i = 0; i < 100; ++i) table.add_row({1.0 / 3.0});
  });
  EXPECT_THAT(message, HasSubstr("t.csv: cannot write: File too large"));
  EXPECT_TRUE(content(folder / "t.csv").ends_with("\n"));
  EXPECT_EQ(read_csv(folder / "t.csv").column("x").size(), table.num_rows());
  table.add_row({2.0});
  EXPECT_EQ(read_csv(folder / "t.csv").column("x").back(), 2.0);
}

TEST_F(Csv, UnwritablePlaceIsNamed) {
  const std::filesystem::path path = below_a_file("t.csv");
  EXPECT_THAT(message_of<RuntimeFailure>([&] { CsvTable::create(path, {"x"}); }), HasSubstr(path.string()));
}

TEST_F(Csv, ReaderSkipsCommentsBlankLinesAndCarriageReturns) {
  const CsvColumns read = read_csv(written("\xEF\xBB\xBF# Source: a table\r\n\r\nx [m] , y\r\n# more\n 1, +2e3\n3,4"));
  EXPECT_THAT(read.header, ElementsAre("x [m]", "y"));
  EXPECT_THAT(read.column("x [m]"), ElementsAre(1, 3));
  EXPECT_THAT(read.column("y"), ElementsAre(2000, 4));
}

TEST_F(Csv, ReaderRefusesMalformedFilesNamingTheLine) {
  const auto message = [&](const std::string& text) {
    return message_of<InputError>([&] { read_csv(written(text)); });
  };
  EXPECT_THAT(message("x,y\n1,2\n# c\n3\n"), HasSubstr("table.csv:4: 1 cells, the header has 2"));
  EXPECT_THAT(message("x,y\n1,2 m\n"), HasSubstr("table.csv:2: '2 m' is not a number"));
  EXPECT_THAT(message("x,y\n1,\n"), HasSubstr("'' is not a number"));
  EXPECT_THAT(message("1,2\n3,4\n"), HasSubstr("must name the columns"));
  EXPECT_THAT(message("# nothing\n"), HasSubstr("no header line"));
  EXPECT_THAT(message_of<InputError>([&] { read_csv(folder / "missing.csv"); }), HasSubstr("missing.csv"));
  EXPECT_THROW(read_csv(folder), InputError);
}

TEST_F(Csv, MissingColumnSuggestsTheNearestName) {
  const CsvColumns read = read_csv(written("time [s],energy [J]\n"));
  EXPECT_THAT(message_of<InputError>([&] { read.column("time [m]"); }), HasSubstr("time [s]"));
}

}  // namespace
}  // namespace knap
