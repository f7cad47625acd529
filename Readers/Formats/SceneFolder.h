// A scene in a folder: the image of a material with what belongs to it, found by name and content.
#pragma once

#include <string>
#include <vector>

namespace msi
{

// Paths; empty where there is none.
struct SceneFolder
{
  std::vector<std::string> image; // one file, or one per channel
  std::vector<std::string> white; // the same for the white reference
  std::vector<std::string> dark;  // and for the frame with the lens covered
  std::string labels;             // the label image of the patches
  std::string patches;            // the measured reflectance of the patches
  std::string calibration;        // the samples of the chart: reflectance and responses
  std::string tuning;             // a few samples of the imaged material
};

// Looks into the folder, and into its folders for the frames.
//
//   image        the image files of the folder that are no label image and no frame
//   white, dark  the images in a folder white/ (or flat/) and dark/ (or black/), else those whose names start so
//   labels       the label image
//   patches      the sample table patches.*
//   calibration  the sample table chart.* or calibration.*
//   tuning       the sample table swatches.* or tuning.*
//
// Errors: FormatError naming the folder where there is no image in it, where several files are images and the name of
// one has no wavelength, and where a part is there twice.
SceneFolder findScene(const std::string& folder);

} // namespace msi
