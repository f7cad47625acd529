/**
 * @class   vtkResponseDifference
 * @brief   Real minus simulated camera responses: per sample or pixel, and per channel
 *
 * Input 0 has the real responses, input 1 the simulated ones: two sample tables (columns C400, .. or C1, ..) of the
 * same rows, or two images of the same size. Channels are compared in their order.
 *
 * Output 0: the first table with the columns `simulated C400`, .. and `difference C400`, ..; or the first image with
 * the array "Difference". Output 1: one row a channel: channel, samples, mean, rms, and the line real = gain simulated
 * + offset with the rms around it (Kernels/Camera/ResponseDifference.h); empty for images.
 */
#ifndef vtkResponseDifference_h
#define vtkResponseDifference_h

#include "MultispectralFiltersSimulationModule.h"
#include "vtkPassInputTypeAlgorithm.h"

class vtkImageData;
class vtkTable;

class MULTISPECTRALFILTERSSIMULATION_EXPORT vtkResponseDifference : public vtkPassInputTypeAlgorithm
{
public:
  static vtkResponseDifference* New();
  vtkTypeMacro(vtkResponseDifference, vtkPassInputTypeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkResponseDifference();
  ~vtkResponseDifference() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkResponseDifference(const vtkResponseDifference&) = delete;
  void operator=(const vtkResponseDifference&) = delete;

  void CompareImages(vtkImageData* real, vtkImageData* simulated, vtkImageData* output);
};

#endif
