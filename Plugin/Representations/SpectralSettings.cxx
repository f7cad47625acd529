#include "SpectralSettings.h"

#include "vtkSMSettings.h"

namespace msi
{

namespace
{
// ParaView's own settings have priority 0 and more.
constexpr double BelowTheUsers = -1.0;

// Names that leave no doubt: without these, ParaView asks whether its own readers shall read a channel or a chart. Three
// texts each: patterns, description, reader.
constexpr const char* ReadersByName =
  R"json({"settings": {"RepresentedArrayListSettings": {"ReaderDetails": [
"*nm.tif *nm.tiff *nm.png *nm.exr", "Spectral image (one file per channel)", "SpectralImageReader",
"*.jpg *.jpeg *.JPG *.JPEG", "Picture", "SpectralImageReader",
"labels.png labels.tif labels.tiff", "Label image", "LabelImageReader",
"*chart*.csv patches.csv *swatches*.csv tuning.csv calibration.csv", "Sample table", "SampleTableReader",
"camera.csv camera.json", "Camera", "CameraReader",
"capture.json", "Capture", "CaptureReader"]}}})json";
}

void registerSettings()
{
  vtkSMSettings::GetInstance()->AddCollectionFromString(ReadersByName, BelowTheUsers);
}

} // namespace msi
