// Fitted transforms as vtkTables that a spreadsheet view shows and a CSV file keeps.
//
//   reflectance transform W   wavelength | C400 .. C700 | constant      one row per band
//   metamerism transform D    channel    | C400 .. C700 | constant      one row per channel
//   estimation model          matrix | row | column | value             one row per element
#ifndef TransformTable_h
#define TransformTable_h

#include "SpectralAxis.h"

#include "Kernels/Estimation/ReflectanceEstimator.h"
#include "Kernels/Numerics/AffineTransform.h"

#include <memory>
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

// Of a method that is not linear.
struct EstimationModel
{
  SpectralAxis bands;
  SpectralAxis channels;
  std::shared_ptr<const ReflectanceEstimator> estimator; // never null
};

void write(const ReflectanceTransform& transform, vtkTable* table);
void write(const MetamerismTransform& transform, vtkTable* table);
void write(const EstimationModel& model, vtkTable* table);

// Whatever the table's columns say it is; throws std::invalid_argument naming what is missing.
using TransformVariant = std::variant<ReflectanceTransform, MetamerismTransform, EstimationModel>;
TransformVariant readTransform(vtkTable* table, const std::string& nameOfTable);

// The estimator of a reflectance transform or an estimation model; a metamerism transform, which may be null, comes
// before the reflectance transform and is not used with a model. Throws std::invalid_argument.
EstimationModel readEstimator(vtkTable* transformTable, vtkTable* metamerismTable);

} // namespace msi

#endif
