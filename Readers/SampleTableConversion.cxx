#include "SampleTableConversion.h"

#include "SampleColumns.h"

#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkVariant.h"

#include "Formats/Text/SpectralNames.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <set>

namespace msi
{

namespace
{
vtkSmartPointer<vtkAbstractArray> columnOf(const MetadataColumn& metadata)
{
  const auto numbers = metadata.numbers();
  if (!numbers.empty())
  {
    auto column = vtkSmartPointer<vtkDoubleArray>::New();
    column->SetNumberOfValues(static_cast<vtkIdType>(numbers.size()));
    std::copy(numbers.begin(), numbers.end(), column->GetPointer(0));
    return column;
  }
  auto column = vtkSmartPointer<vtkStringArray>::New();
  for (const auto& text : metadata.text)
  {
    column->InsertNextValue(text);
  }
  return column;
}

// Named afterwards, as in setSpectra.
void addMetadata(const std::vector<MetadataColumn>& metadata, vtkTable* table)
{
  const vtkIdType first = table->GetNumberOfColumns();
  table->GetRowData()->AllocateArrays(
    static_cast<int>(first + static_cast<vtkIdType>(metadata.size())));
  for (const auto& column : metadata)
  {
    table->AddColumn(columnOf(column));
  }
  for (std::size_t i = 0; i < metadata.size(); ++i)
  {
    table->GetColumn(first + static_cast<vtkIdType>(i))->SetName(metadata[i].name.c_str());
  }
}

SpectralAxis channelAxis(const SampleTable& samples)
{
  if (samples.channelWavelengths)
  {
    return axisOf(*samples.channelWavelengths);
  }
  SpectralAxis axis;
  for (Eigen::Index i = 0; i < samples.responses.rows(); ++i)
  {
    // C1, C3, C5 stay what they are.
    const auto at = static_cast<std::size_t>(i);
    const auto number = at < samples.channelNames.size()
      ? responseColumnNumber(samples.channelNames[at])
      : std::nullopt;
    axis.names.push_back("C" + wavelengthText(number.value_or(static_cast<double>(i) + 1.0)));
  }
  return axis;
}

std::string cellText(vtkAbstractArray* column, vtkIdType row)
{
  if (auto* numbers = vtkDataArray::SafeDownCast(column))
  {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof(text), numbers->GetComponent(row, 0));
    return std::string(text, end.ptr);
  }
  return column->GetVariantValue(row).ToString();
}
}

void toVTK(const SampleTable& samples, vtkTable* table)
{
  addMetadata(samples.metadata, table);
  if (samples.hasReflectance())
  {
    setSpectra(
      table, SampleQuantity::Reflectance, axisOf(*samples.wavelengths), samples.reflectance);
  }
  if (samples.hasResponses())
  {
    setSpectra(table, SampleQuantity::Response, channelAxis(samples), samples.responses);
  }
}

SampleTable fromVTK(vtkTable* table)
{
  SampleTable samples;
  std::set<std::string> spectral;
  const auto take = [&](SampleQuantity quantity)
  {
    auto spectra = findSpectra(table, quantity);
    if (spectra)
    {
      spectral.insert(spectra->columns.begin(), spectra->columns.end());
    }
    return spectra;
  };
  if (auto reflectance = take(SampleQuantity::Reflectance))
  {
    samples.wavelengths = reflectance->axis.wavelengths;
    samples.reflectance = std::move(reflectance->values);
  }
  if (auto responses = take(SampleQuantity::Response))
  {
    samples.channelWavelengths = responses->axis.wavelengths;
    for (const auto& name : responses->axis.names)
    {
      samples.channelNames.push_back(responses->axis.wavelengths ? "C" + name : name);
    }
    samples.responses = std::move(responses->values);
  }
  for (vtkIdType i = 0; i < table->GetNumberOfColumns(); ++i)
  {
    auto* column = table->GetColumn(i);
    const std::string name = column->GetName() ? column->GetName() : "";
    if (spectral.count(name) > 0)
    {
      continue;
    }
    MetadataColumn metadata{ name, {} };
    for (vtkIdType row = 0; row < column->GetNumberOfTuples(); ++row)
    {
      metadata.text.push_back(cellText(column, row));
    }
    samples.metadata.push_back(std::move(metadata));
  }
  return samples;
}

} // namespace msi
