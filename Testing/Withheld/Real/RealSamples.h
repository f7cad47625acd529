// Real measurements and the camera fitted to a half of them.
#pragma once

#include "Cases/CaseWriter.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace withheld
{

struct RealSamples
{
  std::vector<double> wavelengths;      // of the reflectance, N
  std::vector<double> channels;         // middle of each passband, nm
  Eigen::MatrixXd reflectance;          // N x S
  std::vector<Eigen::MatrixXd> answers; // one reading each, K x S
  std::vector<std::string> medium;      // S
  Eigen::VectorXd x, y;                 // S; empty: not known
  std::vector<double> cameraWavelengths;
  Eigen::MatrixXd camera; // K x camera wavelengths, the nominal camera
  Eigen::VectorXd dark;   // K

  // Response of the nominal camera, K x S.
  Eigen::MatrixXd simulated() const;
};

enum class Source
{
  Raw,        // fitted as Camera Model Fit does
  Linearised, // so, after each channel was made linear
  Chart,      // measured
  Ridge       // ridge regression with a penalty that is drawn: responsivities that alternate
};

// Empty without the data. media: paper, cotton or both. The samples of the other half stay.
RealSamples fittedHalf(Random& random, const std::vector<std::string>& media, Source source);
RealSamples chart(Random& random);
bool haveRealSamples();

} // namespace withheld
