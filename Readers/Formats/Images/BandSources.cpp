#include "Formats/Images/BandSources.h"

#include "Formats/FormatError.h"
#include "Formats/Images/BandOrder.h"
#include "Formats/Images/ImageMetadata.h"
#include "Formats/Images/SpectralExrName.h"
#include "Formats/Text/NumberText.h"
#include "Formats/Text/SpectralNames.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <utility>

namespace msi
{

namespace
{
constexpr double SmallestFileNameStep = 2.0; // nm; numbers closer than this are frame numbers

std::string sizeText(const OIIO::ImageSpec& spec)
{
  return std::to_string(spec.width) + " x " + std::to_string(spec.height);
}

bool isSpectralExr(const OIIO::ImageSpec& spec)
{
  return std::any_of(spec.channelnames.begin(), spec.channelnames.end(),
    [](const std::string& name) { return parseSpectralExrName(name).has_value(); });
}

bool areApart(std::vector<FileNameWavelength> named)
{
  std::sort(named.begin(), named.end(),
    [](const auto& a, const auto& b) { return a.nanometres < b.nanometres; });
  return std::adjacent_find(named.begin(), named.end(),
           [](const auto& a, const auto& b)
           { return b.nanometres - a.nanometres < SmallestFileNameStep; }) == named.end();
}

bool allHaveUnits(const std::vector<FileNameWavelength>& named)
{
  return std::all_of(named.begin(), named.end(), [](const auto& name) { return name.hasUnit; });
}

// One number of each name, of which there is at least one: the last one that tells all names apart (scene_450_gain200),
// else the last.
std::vector<FileNameWavelength> chosenNumbers(
  const std::vector<std::vector<FileNameWavelength>>& numbers)
{
  const std::size_t count = numbers.front().size();
  const bool alike = std::all_of(
    numbers.begin(), numbers.end(), [count](const auto& name) { return name.size() == count; });
  std::vector<FileNameWavelength> chosen;
  for (std::size_t fromLast = 1; fromLast <= (alike ? count : 1); ++fromLast)
  {
    std::vector<FileNameWavelength> column;
    column.reserve(numbers.size());
    for (const auto& name : numbers)
    {
      column.push_back(name[name.size() - fromLast]);
    }
    if (areApart(column))
    {
      return column;
    }
    if (chosen.empty())
    {
      chosen = std::move(column);
    }
  }
  return chosen;
}

class BandFinder
{
public:
  explicit BandFinder(const SpectralImageOptions& options)
    : Options(options)
  {
  }

  BandSources find(const std::vector<std::string>& files)
  {
    for (const std::string& file : files)
    {
      open(file);
      if (files.size() > 1)
      {
        addSingleBand();
      }
      else
      {
        addAllBands();
      }
    }
    if (!Options.wavelengths.empty())
    {
      takeGivenWavelengths();
    }
    else if (files.size() > 1)
    {
      takeFileNames();
    }
    order();
    return std::move(Found);
  }

private:
  const OpenedImage& current() const { return *Found.files.back(); }

  void open(const std::string& file)
  {
    auto opened = std::make_shared<const OpenedImage>(file);
    if (!Found.files.empty())
    {
      const OIIO::ImageSpec& first = Found.files.front()->pages()[0];
      const OIIO::ImageSpec& spec = opened->pages()[0];
      if (spec.width != first.width || spec.height != first.height)
      {
        throw FormatError(file, "is " + sizeText(spec) + " pixels",
          sizeText(first) + ", as " + Found.files.front()->path() + " is",
          "give images of one size");
      }
    }
    Found.files.push_back(std::move(opened));
  }

  void add(int page, int channel, std::string name, std::optional<double> wavelength)
  {
    Found.bands.push_back({ Found.files.size() - 1, page, channel, std::move(name), wavelength });
  }

  void addSingleBand()
  {
    const OIIO::ImageSpec& spec = current().pages()[0];
    const int colors = spec.nchannels - (spec.alpha_channel >= 0 ? 1 : 0);
    if (colors != 1)
    {
      std::string names;
      for (int c = 0; c < std::min(spec.nchannels, 4); ++c)
      {
        names += (c > 0 ? ", " : "") + channelName(spec, c);
      }
      throw FormatError(current().path(),
        "has " + std::to_string(spec.nchannels) + " channels (" + names +
          (spec.nchannels > 4 ? ", ..." : "") + ")",
        "one channel in each file of a stack", "convert the file to gray, or give it alone");
    }
    if (current().pages().size() > 1)
    {
      Found.notes.push_back(current().path() + " has " + std::to_string(current().pages().size()) +
        " pages: the first was taken");
    }
    const int channel = spec.alpha_channel == 0 ? 1 : 0;
    const auto spectral = parseSpectralExrName(channelName(spec, channel));
    add(0, channel, std::filesystem::path(current().path()).stem().string(),
      spectral ? std::optional(spectral->nanometres) : metadataWavelength(spec));
  }

  void addAllBands()
  {
    const auto& pages = current().pages();
    for (std::size_t page = 0; page < pages.size(); ++page)
    {
      const OIIO::ImageSpec& spec = pages[page];
      if (spec.width != pages[0].width || spec.height != pages[0].height)
      {
        Found.notes.push_back("page " + std::to_string(page + 1) + " is " + sizeText(spec) +
          " pixels, the first is " + sizeText(pages[0]) + ": left out");
      }
      else if (isSpectralExr(spec))
      {
        addSpectralExr(static_cast<int>(page));
      }
      else
      {
        addPage(static_cast<int>(page));
      }
    }
    takeListOfAllPages();
  }

  // The first page may list the wavelengths of all.
  void takeListOfAllPages()
  {
    const std::vector<double> list = metadataWavelengths(current().pages()[0]);
    if (list.size() == Found.bands.size() && !allHaveWavelengths())
    {
      for (std::size_t b = 0; b < list.size(); ++b)
      {
        Found.bands[b].wavelength = list[b];
      }
    }
  }

  void addPage(int page)
  {
    const OIIO::ImageSpec& spec = current().pages()[static_cast<std::size_t>(page)];
    const int colors = spec.nchannels - (spec.alpha_channel >= 0 ? 1 : 0);
    const std::vector<double> list = metadataWavelengths(spec);
    const bool listed = list.size() == static_cast<std::size_t>(colors);
    const bool many = current().pages().size() > 1;
    int band = 0;
    for (int channel = 0; channel < spec.nchannels; ++channel)
    {
      if (channel == spec.alpha_channel && colors > 0)
      {
        Found.notes.emplace_back("the alpha channel was left out");
        continue;
      }
      const std::string name = channelName(spec, channel);
      std::optional<double> nm = reflectanceColumnWavelength(name);
      if (listed)
      {
        nm = list[static_cast<std::size_t>(band)];
      }
      else if (!nm && colors == 1)
      {
        nm = metadataWavelength(spec);
      }
      add(page, channel,
        many && colors == 1 ? "page " + std::to_string(page + 1)
                            : (many ? "page " + std::to_string(page + 1) + " " : "") + name,
        nm);
      ++band;
    }
  }

  // T channels, else S0 channels. What else the file holds is said.
  void addSpectralExr(int page)
  {
    const OIIO::ImageSpec& spec = current().pages()[static_cast<std::size_t>(page)];
    std::vector<std::pair<int, SpectralExrName>> channels;
    int preview = 0;
    int reradiating = 0;
    for (int channel = 0; channel < spec.nchannels; ++channel)
    {
      const auto name = parseSpectralExrName(channelName(spec, channel));
      preview += name ? 0 : 1;
      reradiating += name && name->reradiating ? 1 : 0;
      if (name && !name->reradiating)
      {
        channels.emplace_back(channel, *name);
      }
    }
    const bool reflective = std::any_of(
      channels.begin(), channels.end(), [](const auto& entry) { return entry.second.kind == 'T'; });
    int leftOut = 0;
    for (const auto& [channel, name] : channels)
    {
      if (name.kind == (reflective ? 'T' : 'S') && name.stokes == 0)
      {
        add(page, channel, channelName(spec, channel), name.nanometres);
      }
      else
      {
        ++leftOut;
      }
    }
    const bool responses = spec.get_string_attribute(QuantityAttribute) == "responses";
    Found.quantity = !reflective ? "emission" : responses ? "responses" : "reflectance";
    note(preview, " channels without a wavelength (a color preview) were left out");
    note(reradiating, " fluorescence channels were left out");
    note(leftOut,
      reflective ? " emission channels were left out" : " polarization channels were left out");
    if (Found.bands.empty())
    {
      throw FormatError(current().path(), "has no plain spectral channel",
        "channels T.<wavelength> or S0.<wavelength>", "name another file");
    }
  }

  void note(int count, const char* text)
  {
    if (count > 0)
    {
      Found.notes.push_back(std::to_string(count) + text);
    }
  }

  void takeGivenWavelengths()
  {
    if (Options.wavelengths.size() != Found.bands.size())
    {
      throw FormatError(Found.files.front()->path(),
        std::to_string(Options.wavelengths.size()) + " wavelengths were given",
        std::to_string(Found.bands.size()) + ", one for each band", "complete the list");
    }
    requireGrid(Options.wavelengths, Found.files.front()->path());
    for (std::size_t b = 0; b < Found.bands.size(); ++b)
    {
      Found.bands[b].wavelength = Options.wavelengths[b];
    }
  }

  void takeFileNames()
  {
    if (allHaveWavelengths())
    {
      Found.notes.emplace_back("wavelengths are those in the metadata of the files");
      return;
    }
    std::vector<std::vector<FileNameWavelength>> numbers; // in each name
    for (const BandSource& band : Found.bands)
    {
      numbers.push_back(fileNameWavelengths(Found.files[band.file]->path()));
      if (numbers.back().empty())
      {
        forgetWavelengths(Found.files[band.file]->path() + " has none in its name");
        return;
      }
    }
    const auto named = chosenNumbers(numbers);
    if (!areApart(named) && !allHaveUnits(named))
    {
      forgetWavelengths("the numbers in the file names seem to count images");
      return;
    }
    for (std::size_t b = 0; b < named.size(); ++b)
    {
      Found.bands[b].wavelength = named[b].nanometres;
    }
    Found.notes.emplace_back("wavelengths are those in the file names");
  }

  bool allHaveWavelengths() const
  {
    return std::all_of(Found.bands.begin(), Found.bands.end(),
      [](const BandSource& band) { return band.wavelength.has_value(); });
  }

  void forgetWavelengths(const std::string& why)
  {
    for (BandSource& band : Found.bands)
    {
      band.wavelength.reset();
    }
    Found.notes.push_back("the wavelengths are unknown: " + why);
  }

  void order()
  {
    if (!allHaveWavelengths())
    {
      for (BandSource& band : Found.bands)
      {
        band.wavelength.reset();
      }
      if (Found.files.size() > 1)
      {
        std::stable_sort(Found.bands.begin(), Found.bands.end(),
          [](const BandSource& a, const BandSource& b) { return naturalLess(a.name, b.name); });
      }
      return;
    }
    std::stable_sort(Found.bands.begin(), Found.bands.end(),
      [](const BandSource& a, const BandSource& b) { return *a.wavelength < *b.wavelength; });
    const auto twin = std::adjacent_find(Found.bands.begin(), Found.bands.end(),
      [](const BandSource& a, const BandSource& b) { return *a.wavelength == *b.wavelength; });
    if (twin != Found.bands.end())
    {
      const BandSource& other = *(twin + 1);
      throw FormatError(Found.files[other.file]->path(),
        "'" + twin->name + "' and '" + other.name + "' both are " + numberText(*other.wavelength) +
          " nm",
        "one band for each wavelength", "leave one out, or state the wavelengths");
    }
    std::vector<double> sorted;
    for (const BandSource& band : Found.bands)
    {
      sorted.push_back(*band.wavelength);
    }
    const std::string fault = faultOfGrid(sorted);
    if (!fault.empty())
    {
      forgetWavelengths(fault);
    }
  }

  const SpectralImageOptions& Options;
  BandSources Found;
};
}

BandSources findBands(const std::vector<std::string>& files, const SpectralImageOptions& options)
{
  return BandFinder(options).find(files);
}

} // namespace msi
