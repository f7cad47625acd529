#include "Formats/Images/EnviHeader.h"

#include "Formats/Images/EnviHeaderText.h"
#include "Formats/Images/EnviWavelengths.h"
#include "Formats/Text/NumberText.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>

namespace msi
{

namespace
{
constexpr std::int64_t MostSamplesPerSide = 1 << 30;
constexpr std::int64_t MostBands = 1 << 20;

struct TypeCode
{
  std::int64_t code;
  SampleType type;
};
constexpr std::array<TypeCode, 9> TypeCodes = { {
  { 1, SampleType::UInt8 },
  { 2, SampleType::Int16 },
  { 3, SampleType::Int32 },
  { 4, SampleType::Float32 },
  { 5, SampleType::Float64 },
  { 12, SampleType::UInt16 },
  { 13, SampleType::UInt32 },
  { 14, SampleType::Int64 },
  { 15, SampleType::UInt64 },
} };

constexpr std::array<std::pair<Interleave, const char*>, 3> Interleaves = { {
  { Interleave::BSQ, "bsq" },
  { Interleave::BIL, "bil" },
  { Interleave::BIP, "bip" },
} };

class EnviHeaderReader
{
public:
  EnviHeaderReader(
    const std::string& file, const std::string& text, const EnviHeaderOptions& options)
    : Text(file, text)
    , Options(options)
  {
  }

  EnviHeader read()
  {
    refuseOtherFiles();
    readLayout();
    readBandNames();
    if (Options.ownWavelengths)
    {
      readEnviWavelengths(Text, Header.info);
    }
    readBandFlags();
    readValueMeaning();
    Header.info.metadata.merge(Text.unusedKeys());
    for (const char* key : { "data gain values", "data offset values" })
    {
      if (Header.info.metadata.count(key) > 0)
      {
        note("'" + std::string(key) + "' were not applied");
      }
    }
    Header.info.notes.insert(Header.info.notes.end(), Text.notes().begin(), Text.notes().end());
    return std::move(Header);
  }

private:
  void note(std::string text) { Header.info.notes.push_back(std::move(text)); }

  void refuseOtherFiles()
  {
    if (const auto kind = Text.find("file type"))
    {
      const std::string lower = lowerCase(*kind);
      const bool library = lower.find("spectral library") != std::string::npos;
      const bool classification = lower.find("classification") != std::string::npos;
      if (Options.library && !library)
      {
        Text.refuse("file type", "is '" + *kind + "'", "'ENVI Spectral Library'", "name a library");
      }
      if (library && !Options.library)
      {
        Text.refuse("file type", "is '" + *kind + "'", "'ENVI Standard', an image of samples",
          "read it as a sample table, or name an image");
      }
      if (classification && !Options.classification)
      {
        Text.refuse("file type", "is '" + *kind + "'", "'ENVI Standard', an image of samples",
          "read it as a label image, or name an image");
      }
      Header.info.metadata.emplace("file type", *kind);
    }
    if (Text.findInteger("file compression", 0).value_or(0) != 0)
    {
      Text.refuse("file compression", "says that the data are compressed", "0",
        "unpack the data file and set the key to 0");
    }
    for (const char* key : { "major frame offsets", "minor frame offsets" })
    {
      const auto offsets = Text.findNumbers(key, 2, "before and after");
      if (offsets && ((*offsets)[0] != 0.0 || (*offsets)[1] != 0.0))
      {
        Text.refuse(key, "are not zero", "{0, 0}", "write the image without frame offsets");
      }
    }
  }

  void readLayout()
  {
    Header.info.width = size("samples", MostSamplesPerSide);
    Header.info.height = size("lines", MostSamplesPerSide);
    Header.info.bandNames.resize(static_cast<std::size_t>(size("bands", MostBands)));
    Header.headerOffset = Text.findInteger("header offset", 0).value_or(0);

    const std::int64_t code = Text.requireInteger("data type", 0);
    const auto type = std::find_if(TypeCodes.begin(), TypeCodes.end(),
      [code](const TypeCode& entry) { return entry.code == code; });
    if (type == TypeCodes.end())
    {
      Text.refuse("data type",
        "is " + std::to_string(code) + (code == 6 || code == 9 ? ", complex numbers" : ""),
        "1, 2, 3, 4, 5, 12, 13, 14 or 15", "convert the image to real numbers of these types");
    }
    Header.type = type->type;
    Header.info.sampleType = sampleTypeName(Header.type);

    const std::string interleave = lowerCase(Text.require("interleave"));
    const auto known = std::find_if(Interleaves.begin(), Interleaves.end(),
      [&interleave](const auto& entry) { return entry.second == interleave; });
    if (known == Interleaves.end())
    {
      Text.refuse("interleave", "is '" + interleave + "'", "bsq, bil or bip");
    }
    Header.interleave = known->first;
    if (Options.library)
    {
      takeSpectraAsColumns();
    }

    const auto order = Text.findInteger("byte order", 0);
    if (order && *order > 1)
    {
      Text.refuse("byte order", "is " + std::to_string(*order), "0 (little) or 1 (big)");
    }
    if (!order && sampleSize(Header.type) > 1)
    {
      note("the header states no byte order: little endian was assumed");
    }
    Header.byteOrder = order.value_or(0) == 1 ? ByteOrder::Big : ByteOrder::Little;
    requireAddressable();
  }

  // One spectrum a line: the samples of a line are its bands.
  void takeSpectraAsColumns()
  {
    if (Header.info.bands() != 1)
    {
      Text.refuse("bands", "is " + std::to_string(Header.info.bands()),
        "1: a library has one spectrum in each line");
    }
    Header.info.bandNames.assign(static_cast<std::size_t>(Header.info.width), {});
    Header.info.width = Header.info.height;
    Header.info.height = 1;
    Header.interleave = Interleave::BIP;
  }

  int size(const char* key, std::int64_t most)
  {
    const std::int64_t value = Text.requireInteger(key, 1);
    if (value > most)
    {
      Text.refuse(key, "is " + std::to_string(value), "at most " + std::to_string(most));
    }
    return static_cast<int>(value);
  }

  void requireAddressable()
  {
    std::int64_t bytes = static_cast<std::int64_t>(sampleSize(Header.type));
    if (__builtin_mul_overflow(bytes, std::int64_t{ Header.info.width }, &bytes) ||
      __builtin_mul_overflow(bytes, std::int64_t{ Header.info.height }, &bytes) ||
      __builtin_mul_overflow(bytes, std::int64_t{ Header.info.bands() }, &bytes) ||
      __builtin_add_overflow(bytes, Header.headerOffset, &bytes))
    {
      Text.refuse("samples", "times lines times bands is more than a file can hold",
        "an image of less than 8 EiB");
    }
  }

  void readBandNames()
  {
    const std::size_t bands = Header.info.bandNames.size();
    for (std::size_t b = 0; b < bands; ++b)
    {
      Header.info.bandNames[b] = "Band " + std::to_string(b + 1);
    }
    if (const auto names = Text.findList("band names"))
    {
      if (names->size() != bands) // names may hold commas
      {
        note("band names were left unread: " + std::to_string(names->size()) + " for " +
          std::to_string(bands) + " bands");
        return;
      }
      for (std::size_t b = 0; b < bands; ++b)
      {
        if (!(*names)[b].empty())
        {
          Header.info.bandNames[b] = (*names)[b];
        }
      }
    }
  }

  void readBandFlags()
  {
    const int bands = Header.info.bands();
    if (const auto good = Text.findNumbers("bbl", bands))
    {
      for (const double flag : *good)
      {
        Header.info.goodBands.push_back(flag != 0.0);
      }
    }
    const auto shown = Text.findList("default bands");
    for (const std::string& item : shown.value_or(std::vector<std::string>{}))
    {
      const auto number = parseNumber(item);
      if (!number || !(*number >= 1.0 && *number <= bands))
      {
        note("default bands were left unread: '" + item + "' is no band from 1 to " +
          std::to_string(bands));
        Header.info.displayBands.clear();
        return;
      }
      Header.info.displayBands.push_back(static_cast<int>(*number) - 1);
    }
  }

  void readValueMeaning()
  {
    Header.info.ignoreValue = Text.findNumber("data ignore value");
    const auto scale = Text.findNumber("reflectance scale factor");
    if (scale)
    {
      if (!(*scale > 0.0 && *scale < std::numeric_limits<double>::infinity()))
      {
        Text.refuse("reflectance scale factor", "is " + numberText(*scale), "a positive number");
      }
      Header.info.reflectanceScale = *scale;
      Header.info.quantity = "reflectance";
      if (*scale != 1.0)
      {
        note("values were divided by the reflectance scale factor " + numberText(*scale));
      }
    }
  }

  EnviHeaderText Text;
  EnviHeaderOptions Options;
  EnviHeader Header;
};
}

std::int64_t EnviHeader::expectedFileSize() const noexcept
{
  return headerOffset +
    static_cast<std::int64_t>(sampleSize(type)) * info.width * info.height * info.bands();
}

bool looksLikeEnviHeader(std::string_view beginning) noexcept
{
  if (beginning.substr(0, 3) == "\xEF\xBB\xBF")
  {
    beginning.remove_prefix(3);
  }
  constexpr std::string_view upper = "ENVI";
  constexpr std::string_view lower = "envi";
  return beginning.size() >= upper.size() &&
    (beginning.substr(0, upper.size()) == upper || beginning.substr(0, lower.size()) == lower) &&
    (beginning.size() == 4 ||
      std::string_view(" \t\r\n").find(beginning[4]) != std::string_view::npos);
}

EnviHeader parseEnviHeader(
  const std::string& file, const std::string& text, const EnviHeaderOptions& options)
{
  return EnviHeaderReader(file, text, options).read();
}

} // namespace msi
