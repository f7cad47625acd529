#include "vtkChannelDisplacement.h"

#include "AlgorithmSupport.h"
#include "DisplacementTable.h"
#include "ImageBlocks.h"
#include "ImageStrips.h"
#include "SpectralImage.h"
#include "ThreadedParts.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkObjectFactory.h"
#include "vtkTable.h"

#include "Kernels/Camera/Imaging/ChannelDisplacement.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkChannelDisplacement);

namespace
{
constexpr double LargestStandardError = 0.5; // pixels
// Channels of noise alone agree by 0.1 to 0.15 at the best of all places.
constexpr double LeastAgreement = 0.25;

void requireFound(const msi::ChannelDisplacement& found, const msi::SpectralAxis& axis,
  std::size_t channel, std::size_t reference)
{
  const double error = std::max(found.standardError[0], found.standardError[1]);
  if (error <= LargestStandardError && found.agreement >= LeastAgreement)
  {
    return;
  }
  std::ostringstream text;
  text << "the place of channel " << axis.names[channel] << " beside channel "
       << axis.names[reference] << " is not known: ";
  text.precision(2);
  if (!std::isfinite(error))
  {
    text << "they show no edge in common";
  }
  else if (error > LargestStandardError)
  {
    text << "its standard error is " << error << " pixels; expected at most "
         << LargestStandardError;
  }
  else
  {
    text << "their agreement is " << found.agreement << "; expected at least " << LeastAgreement;
  }
  text << "; find the displacements in an image of a chart from the same camera, or choose "
          "another Reference";
  throw std::runtime_error(text.str());
}
}

struct vtkChannelDisplacement::Tiles
{
  msi::ImageBlocks blocks;
  msi::Extent whole{};
  std::array<double, 2> spacing{ 1.0, 1.0 };
  msi::SpectralAxis axis;              // empty before the first block
  std::vector<msi::PixelBuffer> tiles; // zero where no block has come by
  std::string failure;

  msi::ImageExtent extent() const { return { whole[1] - whole[0] + 1, whole[3] - whole[2] + 1 }; }

  void add(vtkImageData* image, vtkFloatArray* values)
  {
    const auto channels = static_cast<int>(axis.size());
    if (tiles.empty())
    {
      for (const msi::ImageWindow& window : msi::displacementTiles(extent()))
      {
        tiles.emplace_back();
        tiles.back().resize(window, channels);
      }
    }
    msi::Extent held{};
    image->GetExtent(held.data());
    const msi::ImageWindow window = msi::windowOf(held, whole);
    for (msi::PixelBuffer& tile : tiles)
    {
      const int first = std::max(window.y, tile.window.y);
      const int last = std::min(window.y + window.height, tile.window.y + tile.window.height);
      for (int y = first; y < last; ++y)
      {
        const vtkIdType pixel =
          static_cast<vtkIdType>(y - window.y) * window.width + tile.window.x - window.x;
        std::copy_n(values->GetPointer(pixel * channels),
          static_cast<std::ptrdiff_t>(tile.window.width) * channels, tile.pixel(tile.window.x, y));
      }
    }
  }

  // Every rank has the rows that came by it, and zero elsewhere.
  void gather()
  {
    auto* controller = msi::controllerOfTables();
    msi::throwOnAnyRank(failure, controller);
    if (!controller)
    {
      return;
    }
    for (msi::PixelBuffer& tile : tiles)
    {
      const std::vector<float> mine = tile.values;
      controller->AllReduce(mine.data(), tile.values.data(), static_cast<vtkIdType>(mine.size()),
        vtkCommunicator::SUM_OP);
    }
  }
};

vtkChannelDisplacement::vtkChannelDisplacement()
  : Current(std::make_unique<Tiles>())
{
  this->SetNumberOfInputPorts(1);
  this->SetNumberOfOutputPorts(1);
}

vtkChannelDisplacement::~vtkChannelDisplacement() = default;

void vtkChannelDisplacement::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Reference: " << this->Reference << "\n"
     << indent << "Model: " << this->Model << "\n";
}

int vtkChannelDisplacement::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

int vtkChannelDisplacement::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  msi::declareCollective(outputs);
  return 1;
}

int vtkChannelDisplacement::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  if (this->Current->blocks.request(inputs, { 0 }))
  {
    msi::ImageBlocks blocks = this->Current->blocks;
    *this->Current = Tiles();
    this->Current->blocks = blocks;
  }
  return 1;
}

int vtkChannelDisplacement::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  auto& current = *this->Current;
  try
  {
    this->AddBlock(inputs);
    this->UpdateProgress(0.5 * current.blocks.progress());
    if (current.blocks.next(request))
    {
      return 1;
    }
  }
  catch (const std::exception& error)
  {
    current.failure = error.what();
    current.blocks.stop(request);
  }
  return msi::runAlgorithm(this, outputs, [&] { this->WriteTable(outputs); });
}

void vtkChannelDisplacement::AddBlock(vtkInformationVector** inputs)
{
  auto& current = *this->Current;
  const auto& asked = current.blocks.block();
  inputs[0]->GetInformationObject(0)->Get(
    vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), current.whole.data());
  const msi::Extent top = { current.whole[0], current.whole[1], current.whole[3], current.whole[3],
    current.whole[4], current.whole[5] };
  const auto image =
    msi::partOf(vtkImageData::GetData(inputs[0]), current.blocks.isEmpty() ? top : asked);
  auto* array = msi::requireSpectralArray(image, "the image");
  current.axis = msi::axisOf(image, array);
  current.spacing = { image->GetSpacing()[0], image->GetSpacing()[1] };
  if (current.axis.size() < 2)
  {
    throw std::invalid_argument("the image has 1 channel; expected at least 2");
  }
  if (this->Reference < 0 || this->Reference > static_cast<int>(current.axis.size()))
  {
    throw std::invalid_argument("Reference is " + std::to_string(this->Reference) +
      "; expected 0 for the channel with the strongest edges, or 1 to " +
      std::to_string(current.axis.size()));
  }
  current.add(image, msi::asFloats(array));
}

void vtkChannelDisplacement::WriteTable(vtkInformationVector* outputs)
{
  auto& current = *this->Current;
  current.gather();
  if (msi::isEmptyPiece(outputs))
  {
    *this->Current = Tiles();
    return;
  }
  int reference = this->Reference - 1;
  if (reference < 0)
  {
    std::vector<double> structure(current.axis.size());
    msi::forParts(static_cast<vtkIdType>(structure.size()),
      [&](vtkIdType k) {
        structure[static_cast<std::size_t>(k)] =
          msi::structureOf(current.tiles, static_cast<int>(k));
      });
    reference =
      static_cast<int>(std::max_element(structure.begin(), structure.end()) - structure.begin());
  }
  const msi::DisplacementSearch search(current.tiles, current.extent(),
    this->Model == SHIFT ? msi::DisplacementModel::Shift : msi::DisplacementModel::Similarity);
  // Each beside its neighbour on the way to the reference: neighbours are alike.
  const auto towards = [reference](int k) {
    return k + (k < reference ? 1 : k > reference ? -1 : 0);
  };
  std::vector<msi::ChannelDisplacement> found(current.axis.size());
  msi::forParts(
    this, static_cast<vtkIdType>(found.size()),
    [&](vtkIdType part)
    {
      const auto k = static_cast<int>(part);
      found[static_cast<std::size_t>(k)] = search(towards(k), k);
    },
    0.5);
  for (std::size_t k = 0; k < found.size(); ++k)
  {
    requireFound(found[k], current.axis, k, static_cast<std::size_t>(towards(static_cast<int>(k))));
  }
  const auto compose = [&](int k)
  {
    auto& own = found[static_cast<std::size_t>(k)];
    own = msi::composed(found[static_cast<std::size_t>(towards(k))], own);
  };
  for (int k = reference - 1; k >= 0; --k)
  {
    compose(k);
  }
  for (int k = reference + 1; k < static_cast<int>(found.size()); ++k)
  {
    compose(k);
  }
  msi::writeDisplacements(found, current.axis, current.spacing, vtkTable::GetData(outputs, 0));
  *this->Current = Tiles();
}
