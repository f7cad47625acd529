#include "Formats/Tables/CxfTable.h"

#include "Formats/FormatError.h"
#include "Formats/Tables/ReflectanceScale.h"
#include "Formats/Text/NumberText.h"
#include "Formats/Text/TextPlace.h"
#include "Kernels/Spectra/Counted.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include <pugixml.hpp>

namespace msi
{

namespace
{
using Node = pugi::xml_node;

// The name without its namespace prefix.
std::string_view localName(const Node& node)
{
  const std::string_view name = node.name();
  const std::size_t colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

template <typename Visit>
void forEachDescendant(const Node& root, std::string_view name, const Visit& visit)
{
  // Without recursion: the depth is the file's choice.
  for (Node node = root.first_child(); node && node != root;)
  {
    if (localName(node) == name)
    {
      visit(node);
    }
    if (node.first_child())
    {
      node = node.first_child();
      continue;
    }
    while (node && node != root && !node.next_sibling())
    {
      node = node.parent();
    }
    node = node && node != root ? node.next_sibling() : Node();
  }
}

struct WavelengthRange
{
  std::optional<double> start;
  std::optional<double> increment;
};

class CxfReader
{
public:
  CxfReader(const std::string& file, const std::string& text, ReflectanceUnit unit)
    : File(file)
    , Text(text)
    , Unit(unit)
  {
  }

  SampleTable read()
  {
    const pugi::xml_parse_result parsed =
      Document.load_buffer(Text.data(), Text.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!parsed)
    {
      throw FormatError(placeOfOffset(File, Text, static_cast<std::size_t>(parsed.offset)),
        std::string("this is no XML (") + parsed.description() + ")", "a CxF3 file",
        "the file seems to be cut off or damaged");
    }
    if (localName(Document.document_element()) != "CxF")
    {
      throw FormatError(place(Document.document_element()),
        "the root element is '" + std::string(Document.document_element().name()) + "'", "CxF",
        "name a CxF3 file");
    }
    readRanges();
    forEachDescendant(Document, "Object", [this](const Node& object) { readObject(object); });
    return table();
  }

private:
  FilePlace place(const Node& node) const
  {
    return placeOfOffset(
      File, Text, static_cast<std::size_t>(std::max<std::ptrdiff_t>(node.offset_debug(), 0)));
  }

  std::optional<double> number(const Node& node, const char* attribute) const
  {
    const pugi::xml_attribute found = node.attribute(attribute);
    if (!found)
    {
      return std::nullopt;
    }
    const auto value = parseNumber(found.value());
    if (!value || !(*value > 0.0) || !std::isfinite(*value))
    {
      throw FormatError(place(node), std::string(attribute) + " is '" + found.value() + "'",
        "a wavelength in nm", "correct the attribute");
    }
    return value;
  }

  void readRanges()
  {
    forEachDescendant(Document, "ColorSpecification",
      [this](const Node& specification)
      {
        WavelengthRange range;
        forEachDescendant(specification, "WavelengthRange",
          [&](const Node& node) {
            range = { number(node, "StartWL"), number(node, "Increment") };
          });
        Ranges[specification.attribute("Id").value()] = range;
      });
  }

  void readObject(const Node& object)
  {
    Node first;
    int count = 0;
    forEachDescendant(object, "ReflectanceSpectrum",
      [&](const Node& spectrum)
      {
        first = count == 0 ? spectrum : first;
        ++count;
      });
    Several += count > 1 ? 1 : 0;
    if (count == 0)
    {
      ++WithoutSpectrum;
      return;
    }
    const std::string name = object.attribute("Name").value();
    const std::string id = object.attribute("Id").value();
    addSample(first, name.empty() ? id : name);
    Ids.push_back(id);
  }

  void addSample(const Node& spectrum, const std::string& name)
  {
    const std::vector<double> values = spectrumValues(spectrum);
    const std::vector<double> nm = wavelengths(spectrum, values.size());
    if (Spectra.empty())
    {
      Nanometres = nm;
    }
    else if (nm != Nanometres)
    {
      throw FormatError(place(spectrum), "sample '" + name + "' has " + gridText(nm),
        gridText(Nanometres) + ", as '" + Names[0] + "' has",
        "give all samples the same wavelengths");
    }
    Spectra.push_back(values);
    Names.push_back(name);
    Places.push_back(place(spectrum));
  }

  static std::string gridText(const std::vector<double>& nm)
  {
    return std::to_string(nm.size()) + " wavelengths from " + numberText(nm.front()) + " to " +
      numberText(nm.back()) + " nm";
  }

  std::vector<double> spectrumValues(const Node& spectrum) const
  {
    const std::string_view text = spectrum.child_value();
    std::vector<double> values;
    for (std::size_t at = 0;
         (at = text.find_first_not_of(" \t\r\n", at)) != std::string_view::npos;)
    {
      const std::size_t end = std::min(text.find_first_of(" \t\r\n", at), text.size());
      const auto value = parseNumber(text.substr(at, end - at));
      if (!value || !std::isfinite(*value))
      {
        throw FormatError(place(spectrum),
          "'" + std::string(text.substr(at, std::min<std::size_t>(end - at, 40))) +
            "' is no number of a spectrum",
          "numbers with blanks between them", "correct the spectrum");
      }
      values.push_back(*value);
      at = end;
    }
    if (values.empty())
    {
      throw FormatError(place(spectrum), "the spectrum is empty", "one number for each wavelength",
        "remove the object or complete it");
    }
    return values;
  }

  std::vector<double> wavelengths(const Node& spectrum, std::size_t count) const
  {
    const auto found = Ranges.find(spectrum.attribute("ColorSpecification").value());
    const WavelengthRange range = found == Ranges.end() ? WavelengthRange{} : found->second;
    const auto own = number(spectrum, "StartWL");
    const auto start = own ? own : range.start;
    const auto ownIncrement = number(spectrum, "Increment");
    const auto increment = ownIncrement ? ownIncrement : range.increment;
    if (!start || !increment)
    {
      throw FormatError(place(spectrum),
        std::string("the spectrum states no ") + (start ? "Increment" : "StartWL"),
        "a ColorSpecification with WavelengthRange StartWL and Increment", "complete the file");
    }
    std::vector<double> nm;
    for (std::size_t i = 0; i < count; ++i)
    {
      nm.push_back(*start + *increment * static_cast<double>(i));
    }
    return nm;
  }

  SampleTable table()
  {
    if (Spectra.empty())
    {
      throw FormatError(File, "holds no object with a ReflectanceSpectrum", "measured spectra",
        "export the spectra, not only color values");
    }
    SampleTable samples;
    samples.metadata = { { "sample", Names }, { "id", Ids } };
    samples.reflectance.resize(
      static_cast<Eigen::Index>(Nanometres.size()), static_cast<Eigen::Index>(Spectra.size()));
    for (std::size_t i = 0; i < Spectra.size(); ++i)
    {
      samples.reflectance.col(static_cast<Eigen::Index>(i)) =
        Eigen::Map<const Eigen::VectorXd>(Spectra[i].data(), samples.reflectance.rows());
    }
    try
    {
      samples.wavelengths = WavelengthGrid(Nanometres);
    }
    catch (const std::invalid_argument& error)
    {
      throw FormatError(Places[0], error.what(), {}, "state the wavelengths in nanometres");
    }
    if (WithoutSpectrum > 0)
    {
      samples.notes.push_back(counted(WithoutSpectrum, "object") + " without a spectrum " +
        (WithoutSpectrum == 1 ? "was" : "were") + " left out");
    }
    if (Several > 0)
    {
      samples.notes.push_back(counted(Several, "object") + (Several == 1 ? " has" : " have") +
        " several spectra: the first was read");
    }
    bringToFactor(samples, Unit,
      [this](Eigen::Index sample) { return Places[static_cast<std::size_t>(sample)]; });
    return samples;
  }

  const std::string& File;
  const std::string& Text;
  ReflectanceUnit Unit;
  pugi::xml_document Document;
  std::map<std::string, WavelengthRange> Ranges; // by ColorSpecification
  std::vector<double> Nanometres;
  std::vector<std::vector<double>> Spectra;
  std::vector<std::string> Names;
  std::vector<std::string> Ids;
  std::vector<FilePlace> Places;
  int WithoutSpectrum = 0;
  int Several = 0;
};
}

bool looksLikeXml(std::string_view text) noexcept
{
  const std::string_view start = trimmed(text.substr(0, 256));
  return !start.empty() && start.front() == '<';
}

SampleTable parseCxf(const std::string& file, const std::string& text, ReflectanceUnit unit)
{
  return CxfReader(file, text, unit).read();
}

} // namespace msi
