#include "Formats/SampleTable.h"

#include "Formats/Storage/AtomicFile.h"
#include "Formats/Text/CsvText.h"
#include "Formats/Text/NumberText.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>

namespace msi
{

namespace
{
void requireSameCount(std::size_t count, Eigen::Index expected, const std::string& what)
{
  if (static_cast<Eigen::Index>(count) != expected)
  {
    throw std::invalid_argument(
      what + " has " + std::to_string(count) + " values; expected " + std::to_string(expected));
  }
}

void requireConsistent(const SampleTable& table)
{
  const Eigen::Index samples = table.sampleCount();
  for (const MetadataColumn& column : table.metadata)
  {
    requireSameCount(column.text.size(), samples, "metadata column '" + column.name + "'");
  }
  if (table.hasReflectance())
  {
    requireSameCount(table.wavelengths ? table.wavelengths->values().size() : 0,
      table.reflectance.rows(), "the wavelength list of the reflectance");
  }
  if (table.hasResponses())
  {
    requireSameCount(
      static_cast<std::size_t>(table.responses.cols()), samples, "the response matrix");
    requireSameCount(table.channelNames.size(), table.responses.rows(), "the channel name list");
  }
}

std::string cgatsWord(const std::string& text)
{
  if (!text.empty() && text.find_first_of(" \t\"'#") == std::string::npos)
  {
    return text;
  }
  const char quote = text.find('"') == std::string::npos ? '"' : '\'';
  std::string word = text;
  std::replace_if(
    word.begin(), word.end(), [quote](char c) { return c == quote || c == '\n' || c == '\r'; },
    ' ');
  return quote + word + quote;
}

std::string cgatsFieldName(const std::string& name)
{
  std::string word = name;
  std::transform(word.begin(), word.end(), word.begin(),
    [](char c)
    {
      const bool plain = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
      return plain ? c : '_';
    });
  return word;
}

void appendNumbers(
  std::string& text, const Eigen::MatrixXd& matrix, Eigen::Index sample, char before)
{
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
  {
    text += before + numberText(matrix(i, sample));
  }
}
}

void writeSampleTableCsv(const std::string& path, const SampleTable& table)
{
  requireConsistent(table);
  std::string text;
  const auto cell = [&text](const std::string& value)
  {
    text += csvField(value);
    text += ',';
  };
  const auto endRow = [&text]() { text.back() = '\n'; };
  for (const MetadataColumn& column : table.metadata)
  {
    cell(column.name);
  }
  for (Eigen::Index i = 0; i < table.reflectance.rows(); ++i)
  {
    cell("R" + numberText((*table.wavelengths)[i]));
  }
  for (Eigen::Index i = 0; i < table.responses.rows(); ++i)
  {
    cell(table.channelNames[static_cast<std::size_t>(i)]);
  }
  endRow();
  for (Eigen::Index sample = 0; sample < table.sampleCount(); ++sample)
  {
    for (const MetadataColumn& column : table.metadata)
    {
      cell(withoutFormula(column.text[static_cast<std::size_t>(sample)]));
    }
    for (const Eigen::MatrixXd* matrix : { &table.reflectance, &table.responses })
    {
      for (Eigen::Index i = 0; i < matrix->rows(); ++i)
      {
        cell(numberText((*matrix)(i, sample)));
      }
    }
    endRow();
  }
  AtomicFile file(path);
  file.append(text);
  file.commit();
}

void writeSampleTableCgats(const std::string& path, const SampleTable& table)
{
  requireConsistent(table);
  const MetadataColumn* identity = table.findMetadata("sample");
  std::vector<const MetadataColumn*> others;
  for (const MetadataColumn& column : table.metadata)
  {
    if (&column != identity)
    {
      others.push_back(&column);
    }
  }
  std::string fields = "SAMPLE_ID";
  for (const MetadataColumn* column : others)
  {
    fields += ' ' + cgatsFieldName(column->name);
  }
  for (Eigen::Index i = 0; i < table.reflectance.rows(); ++i)
  {
    fields += " SPECTRAL_NM" + numberText((*table.wavelengths)[i]);
  }
  for (const std::string& name : table.channelNames)
  {
    fields += ' ' + name;
  }
  std::string text = "CGATS.17\n\nORIGINATOR \"Multispectral\"\n";
  text += "NUMBER_OF_FIELDS " +
    std::to_string(1 + others.size() + static_cast<std::size_t>(table.reflectance.rows()) +
      table.channelNames.size());
  text += "\nBEGIN_DATA_FORMAT\n" + fields + "\nEND_DATA_FORMAT\n\nNUMBER_OF_SETS " +
    std::to_string(table.sampleCount()) + "\nBEGIN_DATA\n";
  const auto names = table.sampleNames();
  for (Eigen::Index sample = 0; sample < table.sampleCount(); ++sample)
  {
    const auto row = static_cast<std::size_t>(sample);
    text += cgatsWord(names[row]);
    for (const MetadataColumn* column : others)
    {
      text += ' ' + cgatsWord(column->text[row]);
    }
    appendNumbers(text, table.reflectance, sample, ' ');
    appendNumbers(text, table.responses, sample, ' ');
    text += '\n';
  }
  text += "END_DATA\n";
  AtomicFile file(path);
  file.append(text);
  file.commit();
}

} // namespace msi
