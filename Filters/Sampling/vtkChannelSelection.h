/**
 * @class   vtkChannelSelection
 * @brief   Keeps some channels of a spectral image or of a sample table's responses
 *
 * Input and output are a spectral image (its spectral array is cut to the chosen components) or a sample
 * table (columns C400, .. that were not chosen are removed; all others stay).
 */
#ifndef vtkChannelSelection_h
#define vtkChannelSelection_h

#include "MultispectralFiltersSamplingModule.h"
#include "vtkPassInputTypeAlgorithm.h"

#include <string>
#include <vector>

namespace msi
{
struct SpectralAxis;
}

class MULTISPECTRALFILTERSSAMPLING_EXPORT vtkChannelSelection : public vtkPassInputTypeAlgorithm
{
public:
  static vtkChannelSelection* New();
  vtkTypeMacro(vtkChannelSelection, vtkPassInputTypeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The channels to keep: by wavelength ("550 nm"), by name ("C2"), or counted from 1 in order of wavelength ("2"). None
   * given (default): all.
   */
  void AddChannel(const char* channel);
  void ClearChannels();
  ///@}

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
  vtkChannelSelection();
  ~vtkChannelSelection() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkChannelSelection(const vtkChannelSelection&) = delete;
  void operator=(const vtkChannelSelection&) = delete;

  // 0-based, increasing, within the number of channels.
  std::vector<std::size_t> Chosen(const msi::SpectralAxis& axis) const;

  std::vector<std::string> Channels;

  bool Preview = true;
};

#endif
