/**
 * @class   vtkChannelDisplacement
 * @brief   Finds how the channels of a spectral image lie beside one another
 *
 * Input 0 is a spectral image whose channels show the same scene, shifted, magnified or turned against each other: as
 * a filter wheel gives them. Output 0 is a table of one row per channel: the columns "channel", "x", "y" (displacement
 * beside the reference channel, in the image's length unit: pixels for images from files), "magnification" (relative
 * growth), "rotation" (degrees, from the axis x to the axis y), their standard errors ("x error", ..), and "agreement"
 * (0 to 1: share of the local variance of the neighbour, in the order of channels, that the channel explains; the lowest
 * on the way to the reference). Channel Registration takes it.
 *
 * The image is taken in blocks of rows. At most 16 squares of 128 pixels, spread evenly over it, are looked at.
 */
#ifndef vtkChannelDisplacement_h
#define vtkChannelDisplacement_h

#include "MultispectralFiltersSamplingModule.h"
#include "vtkTableAlgorithm.h"

#include <memory>

class MULTISPECTRALFILTERSSAMPLING_EXPORT vtkChannelDisplacement : public vtkTableAlgorithm
{
public:
  static vtkChannelDisplacement* New();
  vtkTypeMacro(vtkChannelDisplacement, vtkTableAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The channel that stays where it is, counted from 1. 0 (default): the one with the strongest edges.
   */
  vtkSetMacro(Reference, int);
  vtkGetMacro(Reference, int);
  ///@}

  enum ModelType
  {
    SHIFT = 0,
    SIMILARITY = 1
  };
  ///@{
  /**
   * Look for shifts alone, or also for magnification and rotation (default).
   */
  vtkSetClampMacro(Model, int, SHIFT, SIMILARITY);
  vtkGetMacro(Model, int);
  ///@}

protected:
  vtkChannelDisplacement();
  ~vtkChannelDisplacement() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkChannelDisplacement(const vtkChannelDisplacement&) = delete;
  void operator=(const vtkChannelDisplacement&) = delete;

  struct Tiles;
  void AddBlock(vtkInformationVector** inputs);
  void WriteTable(vtkInformationVector* outputs);

  int Reference = 0;
  int Model = SIMILARITY;
  std::unique_ptr<Tiles> Current;
};

#endif
