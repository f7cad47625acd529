/**
 * @class   vtkChannelRegistration
 * @brief   Moves the channels of a spectral image so that they lie on one another
 *
 * Input 0 is a spectral image; input 1 a table of the displacements of its channels, as Channel Displacement finds them
 * in this image or in another one of the same camera. The output is the image with its spectral array resampled by
 * convolution with six pixels an axis: where channel k was displaced by (x, y), magnified and turned beside the reference channel, it
 * is put back. Values that a channel does not show, because they lie outside of its image, are NaN. Each piece asks for the
 * pixels around it that it reads.
 */
#ifndef vtkChannelRegistration_h
#define vtkChannelRegistration_h

#include "MultispectralFiltersSamplingModule.h"
#include "vtkImageAlgorithm.h"

class MULTISPECTRALFILTERSSAMPLING_EXPORT vtkChannelRegistration : public vtkImageAlgorithm
{
public:
  static vtkChannelRegistration* New();
  vtkTypeMacro(vtkChannelRegistration, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Add the point array "sRGB" (3 bytes a pixel), the colors that a view shows at first: sRGB under D65 where the
   * bands reach over the visible spectrum. Default on.
   */
  vtkSetMacro(Preview, bool);
  vtkGetMacro(Preview, bool);
  vtkBooleanMacro(Preview, bool);
  ///@}

protected:
  vtkChannelRegistration();
  ~vtkChannelRegistration() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkChannelRegistration(const vtkChannelRegistration&) = delete;
  void operator=(const vtkChannelRegistration&) = delete;

  // False where the image lacks pixels that are read.
  bool Resample(vtkInformationVector** inputs, vtkInformationVector* outputs);

  bool Preview = true;
  // Pixels around the output that are read, as far as known.
  int Margin = 8;
};

#endif
