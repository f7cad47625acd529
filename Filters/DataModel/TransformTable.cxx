#include "TransformTable.h"

#include "SampleColumns.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <cmath>
#include <stdexcept>

namespace msi
{

namespace
{
constexpr const char* ChannelColumn = "channel";
constexpr const char* ConstantColumn = "constant";
constexpr const char* MatrixColumn = "matrix";
constexpr const char* RowColumn = "row";
constexpr const char* ColumnColumn = "column";
constexpr const char* ValueColumn = "value";
// Of an estimation model: what its bands and channels are, beside the estimator's own matrices.
constexpr const char* BandMatrix = "band wavelength";
constexpr const char* ChannelMatrix = "channel wavelength";

void addCoefficients(
  vtkTable* table, const SpectralAxis& channels, const AffineTransform& transform)
{
  setSpectra(table, SampleQuantity::Response, channels, transform.linear().transpose());
  setNumbers(table, ConstantColumn, transform.constant());
}

vtkDataArray* requireNumbers(vtkTable* table, const char* name, const std::string& nameOfTable)
{
  auto* column = vtkDataArray::SafeDownCast(table->GetColumnByName(name));
  if (!column)
  {
    throw std::invalid_argument(nameOfTable + " has no column of numbers '" + name +
      "'; expected the output of Reflectance Calibration or Metamerism Correction");
  }
  return column;
}

Eigen::VectorXd numbers(vtkTable* table, const char* name, const std::string& nameOfTable)
{
  auto* column = requireNumbers(table, name, nameOfTable);
  Eigen::VectorXd values(column->GetNumberOfTuples());
  for (Eigen::Index i = 0; i < values.size(); ++i)
  {
    values[i] = column->GetComponent(i, 0);
  }
  return values;
}

WavelengthGrid gridOf(const Eigen::VectorXd& values)
{
  return WavelengthGrid(std::vector<double>(values.begin(), values.end()));
}

Eigen::MatrixXd coefficients(
  vtkTable* table, const SampleSpectra& linear, const std::string& nameOfTable)
{
  Eigen::MatrixXd all(linear.values.cols(), linear.values.rows() + 1);
  all.leftCols(linear.values.rows()) = linear.values.transpose();
  all.rightCols(1) = numbers(table, ConstantColumn, nameOfTable);
  return all;
}

NamedMatrices readMatrices(vtkTable* table, const std::string& nameOfTable)
{
  auto* name = table->GetColumnByName(MatrixColumn);
  const auto row = numbers(table, RowColumn, nameOfTable);
  const auto column = numbers(table, ColumnColumn, nameOfTable);
  const auto value = numbers(table, ValueColumn, nameOfTable);
  constexpr double LargestIndex = 1e6;
  std::map<std::string, std::pair<Eigen::Index, Eigen::Index>> shapes;
  for (Eigen::Index i = 0; i < value.size(); ++i)
  {
    if (!(row[i] >= 0.0 && row[i] < LargestIndex && column[i] >= 0.0 && column[i] < LargestIndex))
    {
      throw std::invalid_argument(nameOfTable + ", row " + std::to_string(i + 1) +
        ": the columns 'row' and 'column' must count from 0");
    }
    auto& shape = shapes[name->GetVariantValue(i).ToString()];
    shape.first = std::max(shape.first, static_cast<Eigen::Index>(row[i]) + 1);
    shape.second = std::max(shape.second, static_cast<Eigen::Index>(column[i]) + 1);
  }
  Eigen::Index elements = 0;
  for (const auto& [key, shape] : shapes)
  {
    elements += shape.first * shape.second;
  }
  if (elements != value.size())
  {
    throw std::invalid_argument(nameOfTable + " keeps " + std::to_string(value.size()) +
      " matrix elements, but their rows and columns span " + std::to_string(elements) +
      "; an element is missing or stands twice");
  }
  NamedMatrices matrices;
  for (const auto& [key, shape] : shapes)
  {
    matrices[key].setConstant(shape.first, shape.second, std::nan(""));
  }
  for (Eigen::Index i = 0; i < value.size(); ++i)
  {
    matrices[name->GetVariantValue(i).ToString()](
      static_cast<Eigen::Index>(row[i]), static_cast<Eigen::Index>(column[i])) = value[i];
  }
  return matrices;
}

SpectralAxis numberedChannels(Eigen::Index count)
{
  SpectralAxis axis;
  for (Eigen::Index i = 0; i < count; ++i)
  {
    axis.names.push_back("C" + std::to_string(i + 1));
  }
  return axis;
}

EstimationModel readModel(vtkTable* table, const std::string& nameOfTable)
{
  auto matrices = readMatrices(table, nameOfTable);
  const auto bands = matrices.find(BandMatrix);
  if (bands == matrices.end())
  {
    throw std::invalid_argument(nameOfTable + " has no matrix '" + BandMatrix + "'");
  }
  SpectralAxis bandAxis = axisOf(gridOf(bands->second.col(0)));
  matrices.erase(bands);
  std::optional<SpectralAxis> channelAxis;
  const auto channels = matrices.find(ChannelMatrix);
  if (channels != matrices.end())
  {
    channelAxis = axisOf(gridOf(channels->second.col(0)));
    matrices.erase(channels);
  }
  auto estimator = estimatorFrom(matrices);
  if (!channelAxis)
  {
    channelAxis = numberedChannels(estimator->channels());
  }
  return { std::move(bandAxis), std::move(*channelAxis), std::move(estimator) };
}
}

void write(const ReflectanceTransform& transform, vtkTable* table)
{
  setNumbers(table, WavelengthColumn, transform.bands.wavelengths->vector());
  addCoefficients(table, transform.channels, transform.transform);
}

void write(const MetamerismTransform& transform, vtkTable* table)
{
  vtkNew<vtkStringArray> names;
  names->SetName(ChannelColumn);
  for (const auto& name : transform.channels.names)
  {
    names->InsertNextValue(name);
  }
  table->AddColumn(names);
  addCoefficients(table, transform.channels, transform.transform);
}

void write(const EstimationModel& model, vtkTable* table)
{
  auto matrices = model.estimator->parameters();
  matrices[BandMatrix] = model.bands.wavelengths->vector();
  if (model.channels.wavelengths)
  {
    matrices[ChannelMatrix] = model.channels.wavelengths->vector();
  }
  vtkNew<vtkStringArray> name;
  vtkNew<vtkIntArray> row;
  vtkNew<vtkIntArray> column;
  vtkNew<vtkDoubleArray> value;
  name->SetName(MatrixColumn);
  row->SetName(RowColumn);
  column->SetName(ColumnColumn);
  value->SetName(ValueColumn);
  for (const auto& [key, matrix] : matrices)
  {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
    {
      for (Eigen::Index i = 0; i < matrix.rows(); ++i)
      {
        name->InsertNextValue(key);
        row->InsertNextValue(static_cast<int>(i));
        column->InsertNextValue(static_cast<int>(j));
        value->InsertNextValue(matrix(i, j));
      }
    }
  }
  table->AddColumn(name);
  table->AddColumn(row);
  table->AddColumn(column);
  table->AddColumn(value);
}

TransformVariant readTransform(vtkTable* table, const std::string& nameOfTable)
{
  if (!table || table->GetNumberOfRows() == 0)
  {
    throw std::invalid_argument(nameOfTable +
      " is empty; expected the output of Reflectance Calibration or Metamerism Correction");
  }
  if (table->GetColumnByName(MatrixColumn))
  {
    return readModel(table, nameOfTable);
  }
  const auto linear = requireSpectra(table, SampleQuantity::Response, nameOfTable);
  AffineTransform transform(coefficients(table, linear, nameOfTable));
  if (table->GetColumnByName(ChannelColumn))
  {
    return MetamerismTransform{ linear.axis, std::move(transform) };
  }
  const auto wavelengths = numbers(table, WavelengthColumn, nameOfTable);
  return ReflectanceTransform{ axisOf(gridOf(wavelengths)), linear.axis, std::move(transform) };
}

EstimationModel readEstimator(vtkTable* transformTable, vtkTable* metamerismTable)
{
  const std::string name = "the reflectance transform";
  auto transform = readTransform(transformTable, name);
  if (std::holds_alternative<MetamerismTransform>(transform))
  {
    throw std::invalid_argument(
      name + " is a metamerism transform; connect it as Metamerism Transform instead");
  }
  if (auto* model = std::get_if<EstimationModel>(&transform))
  {
    return { model->bands, model->channels, model->estimator };
  }
  auto& reflectance = std::get<ReflectanceTransform>(transform);
  if (!metamerismTable)
  {
    return { reflectance.bands, reflectance.channels,
      std::make_shared<AffineEstimator>(reflectance.transform) };
  }
  const std::string nameOfD = "the metamerism transform";
  const auto second = readTransform(metamerismTable, nameOfD);
  const auto* metamerism = std::get_if<MetamerismTransform>(&second);
  if (!metamerism)
  {
    throw std::invalid_argument(nameOfD + " has no column 'channel'; it is something else");
  }
  requireSameChannels(metamerism->channels, nameOfD, reflectance.channels, name);
  return { reflectance.bands, metamerism->channels,
    std::make_shared<AffineEstimator>(
      AffineTransform::compose(reflectance.transform, metamerism->transform)) };
}

} // namespace msi
