// A capture: what a real camera answered to measured samples, and the camera simulated beside it.
#pragma once

#include "Formats/Curves.h"
#include "Formats/SampleTable.h"

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace msi
{

// Noise of one reading: variance = read^2 + shot^2 u, relative to white. Empty where unknown.
struct CaptureNoise
{
  std::optional<double> read;
  std::optional<double> shot;
};

// capture.json
struct CaptureDescription
{
  std::string name;
  std::optional<double> whiteLevel; // counts of the perfect white
  std::vector<double> dark; // one value for all channels, or one per channel; empty: unknown
  CaptureNoise noise;
  std::vector<std::string> notes;
};

// responses.csv: one column of the matrix per reading.
struct RepeatedResponses
{
  std::vector<std::string> sample; // of each reading
  std::vector<int> repeat;         // of each reading; 1, 2, ... where the file has no such column
  std::vector<std::string> channelNames;
  Eigen::MatrixXd responses;            // K x readings
  std::vector<MetadataColumn> metadata; // columns beside sample, repeat and the channels
};

// A folder with capture.json, camera.csv, samples.csv and responses.csv.
struct Capture
{
  CaptureDescription description; // dark has one value per channel, or none
  Curves camera;                  // u_k = sum_j camera(j, k) r(lambda_j) + dark_k
  SampleTable samples;
  RepeatedResponses readings;
  std::vector<std::string> imageFiles; // images/*, in natural order; empty without that folder
};

CaptureDescription readCaptureDescription(const std::string& path);
// The same from the text of the file, which 'file' names in messages.
CaptureDescription parseCaptureDescription(const std::string& file, const std::string& text);
// camera.csv: as readCurves, on a uniform grid.
Curves readCameraCurves(const std::string& path);
RepeatedResponses readRepeatedResponses(const std::string& path);

// Reads the whole folder and refuses parts that disagree: channel counts, samples without a
// reflectance, a dark list of another length. Channels named alike are brought to the order of the
// responses, counts to responses relative to white; description.notes tells. Errors: FormatError
// naming the file.
Capture readCapture(const std::string& folder);

// Captures of one camera as one: the samples and readings of all, each capture a scene of its own (its name) where its samples
// name none. A sample that has the name of an earlier one gets the scene's name behind it. Noise and images are the first one's.
// Errors: as readCapture; FormatError where a capture has another simulated camera, channels or wavelengths than the first.
Capture readCaptures(const std::vector<std::string>& folders);

} // namespace msi
