#include "io/file_output.hpp"

#include <gmock/gmock.h>

#include "core/errors.hpp"
#include "tests/io/full_disk.hpp"
#include "tests/support/temporary_folder.hpp"

namespace knap {
namespace {

using testing::HasSubstr;
class FileOutput : public TemporaryFolder {};

TEST_F(FileOutput, ReplacesTheOldFileAndLeavesNoTemporary) {
  write_text_atomically(folder / "report.json", "old, and longer");
  const std::string bytes("new\0bytes", 9);
  write_text_atomically(folder / "report.json", bytes);
  EXPECT_EQ(content(folder / "report.json"), bytes);
  EXPECT_EQ(num_files(), 1u);
}

TEST_F(FileOutput, FullDiskLeavesTheOldFileAndNoTemporary) {
  write_text_atomically(folder / "report.json", "old");
  const std::string message = message_of<RuntimeFailure>([&] {
    const FullDisk full(1000);
    write_text_atomically(folder / "report.json", std::string(5000, 'x'));
  });
  EXPECT_THAT(message, HasSubstr((folder / "report.json").string()));
  EXPECT_THAT(message, HasSubstr("File too large"));
  EXPECT_EQ(content(folder / "report.json"), "old");
  EXPECT_EQ(num_files(), 1u);
}

TEST_F(FileOutput, UnwritablePlacesAreNamed) {
  const std::filesystem::path path = below_a_file("report.json");
  const std::string message = message_of<RuntimeFailure>([&] { write_text_atomically(path, "text"); });
  EXPECT_THAT(message, HasSubstr(path.string()));
  EXPECT_THAT(message, HasSubstr("Not a directory"));
  EXPECT_THROW(write_text_atomically(folder / "missing" / "report.json", "text"), RuntimeFailure);
}

TEST_F(FileOutput, AFolderInThePlaceOfTheFileIsAnError) {
  std::filesystem::create_directory(folder / "report.json");
  EXPECT_THROW(write_text_atomically(folder / "report.json", "text"), RuntimeFailure);
  EXPECT_EQ(num_files(), 1u);
}

}  // namespace
}  // namespace knap
