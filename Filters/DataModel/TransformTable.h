// Fitted transforms as vtkTables that a spreadsheet view shows and a CSV file keeps.
//
//   reflectance transform W   wavelength | C400 .. C700 | constant      one row per band
//   metamerism transform D    channel    | C400 .. C700 | constant      one row per channel
//   transfer model            matrix | row | column | value             one row per element
#ifndef TransformTable_h
#define TransformTable_h

#include "SpectralAxis.h"

#include "Kernels/Estimation/AffineTransform.h"
#include "Kernels/Estimation/TransferEstimation.h"

#include <string>
#include <variant>

class vtkTable;

namespace msi
{

struct ReflectanceTransform
{
  SpectralAxis bands;
  SpectralAxis channels;
  AffineTransform transform;
};

struct MetamerismTransform
{
  SpectralAxis channels;
  AffineTransform transform;
};

struct TransferModel
{
  SpectralAxis bands;
  SpectralAxis channels;
  TransferEstimator estimator;
};

void write(const ReflectanceTransform& transform, vtkTable* table);
void write(const MetamerismTransform& transform, vtkTable* table);
void write(const TransferModel& model, vtkTable* table);

// Whatever the table's columns say it is; throws std::invalid_argument naming what is missing.
using TransformVariant = std::variant<ReflectanceTransform, MetamerismTransform, TransferModel>;
TransformVariant readTransform(vtkTable* table, const std::string& nameOfTable);

} // namespace msi

#endif
