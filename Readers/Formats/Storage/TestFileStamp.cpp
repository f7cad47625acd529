#include "Formats/Storage/RandomAccessFile.h"

#include "Support/formats/TestFiles.h"

#include <array>

#include <unistd.h>

namespace
{

class ChangedFiles : public msi::testing::TemporaryFolder
{
protected:
  std::string readError(const msi::RandomAccessFile& file) const
  {
    std::array<char, 4> bytes{};
    return errorOf([&] { file.read(0, bytes.data(), bytes.size()); });
  }
};

TEST_F(ChangedFiles, CutOffAfterOpening)
{
  const msi::RandomAccessFile file(write("a.raw", "0123456789"));
  EXPECT_EQ(readError(file), "");
  ASSERT_EQ(::truncate(path("a.raw").c_str(), 6), 0);
  EXPECT_EQ(readError(file),
    "a.raw: holds 6 bytes, 4 less than when it was opened; expected a file that stays as it is; "
    "the file was cut off "
    "meanwhile; copy it again");
}

TEST_F(ChangedFiles, WrittenOverAfterOpening)
{
  write("a.raw", "0123456789");
  setTime("a.raw", 1000000000);
  const msi::RandomAccessFile file(path("a.raw"));
  write("a.raw", "abcdefghij");
  setTime("a.raw", 1000000001);
  EXPECT_EQ(readError(file),
    "a.raw: was written to while it was read; expected a file that stays as it is; wait until it "
    "is complete and read "
    "it again");
}

TEST_F(ChangedFiles, ReplacedUnderItsNameStaysWhole)
{
  const msi::RandomAccessFile file(write("a.raw", "0123456789"));
  std::filesystem::rename(write("b.raw", "ab"), path("a.raw"));
  std::array<char, 4> bytes{};
  file.read(6, bytes.data(), bytes.size());
  EXPECT_EQ(std::string(bytes.data(), 4), "6789");
}

}
