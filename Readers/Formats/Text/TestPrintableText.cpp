#include "Formats/Text/PrintableText.h"

#include "Formats/FormatError.h"

#include <gtest/gtest.h>

namespace
{

TEST(PrintableText, PlainTextStaysAsItIs)
{
  for (const char* text : { "", "chart.csv",
         "Gr\xC3\xBC\xC3\x9F"
         "e",
         "\xE2\x82\xAC", "\xC2\xA0", "\xFF\xFE", "a\\x1B" })
  {
    EXPECT_EQ(msi::printable(text), text);
  }
}

TEST(PrintableText, ControlCharactersAreSpelledOut)
{
  EXPECT_EQ(msi::printable("a\x1B[2Jb"), "a\\x1B[2Jb");
  EXPECT_EQ(msi::printable(std::string("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(msi::printable("a\r\n\tb\x7F"), "a\\x0D\\x0A\\x09b\\x7F");
  EXPECT_EQ(msi::printable("\xC2\x9B"
                           "31m"),
    "\\x9B31m"); // the one-character form of ESC [
}

TEST(PrintableText, EveryErrorOfAFileIsPrintable)
{
  EXPECT_STREQ(msi::FormatError("a\x1B]0;x\x07.csv", "holds 'b\nc'", "", "").what(),
    "a\\x1B]0;x\\x07.csv: holds 'b\\x0Ac'");
}

}
