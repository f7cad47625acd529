#include "Formats/Text/PrintableText.h"

#include <cstddef>

namespace msi
{

namespace
{
void appendEscaped(std::string& text, unsigned char byte)
{
  constexpr std::string_view digits = "0123456789ABCDEF";
  text += "\\x";
  text += digits[byte / 16];
  text += digits[byte % 16];
}
}

std::string printable(std::string_view text)
{
  constexpr unsigned char FirstPrintable = 0x20;
  constexpr unsigned char Delete = 0x7F;
  constexpr unsigned char LeadOfC1 = 0xC2;
  constexpr unsigned char EndOfC1 = 0xA0;
  std::string shown;
  shown.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    const auto byte = static_cast<unsigned char>(text[i]);
    const auto next = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : 0);
    if (byte == LeadOfC1 && next > Delete && next < EndOfC1)
    {
      appendEscaped(shown, next);
      ++i;
    }
    else if (byte < FirstPrintable || byte == Delete)
    {
      appendEscaped(shown, byte);
    }
    else
    {
      shown += text[i];
    }
  }
  return shown;
}

} // namespace msi
