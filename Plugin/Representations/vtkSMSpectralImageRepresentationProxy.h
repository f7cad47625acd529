/**
 * @class   vtkSMSpectralImageRepresentationProxy
 * @brief   How ParaView shows a spectral image, its picture and its error maps
 *
 * Colors (3 or 4 bytes a pixel) are shown as they are and without a color legend; every other array is mapped by its
 * color map (SpectralColors.h): Map Scalars follows the array that is chosen. Color differences ("dE00 ..") have a legend
 * with the steps 0, 1, 2, 3 and 5; signed differences ("Difference", "Gap") have a range that is centered on zero.
 */
#ifndef vtkSMSpectralImageRepresentationProxy_h
#define vtkSMSpectralImageRepresentationProxy_h

#include "MultispectralRepresentationsModule.h"
#include "vtkSMPVRepresentationProxy.h"

class MULTISPECTRALREPRESENTATIONS_EXPORT vtkSMSpectralImageRepresentationProxy
  : public vtkSMPVRepresentationProxy
{
public:
  static vtkSMSpectralImageRepresentationProxy* New();
  vtkTypeMacro(vtkSMSpectralImageRepresentationProxy, vtkSMPVRepresentationProxy);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  using vtkSMPVRepresentationProxy::SetScalarBarVisibility;
  bool SetScalarBarVisibility(vtkSMProxy* view, bool visible) override;

  using vtkSMPVRepresentationProxy::SetRepresentationType;
  bool SetRepresentationType(const char* type) override;

protected:
  vtkSMSpectralImageRepresentationProxy();
  ~vtkSMSpectralImageRepresentationProxy() override = default;

  bool SetScalarColoringInternal(
    const char* arrayname, int attribute_type, bool useComponent, int component) override;

private:
  vtkSMSpectralImageRepresentationProxy(const vtkSMSpectralImageRepresentationProxy&) = delete;
  void operator=(const vtkSMSpectralImageRepresentationProxy&) = delete;

  void OnPropertyModified(vtkObject* caller, unsigned long event, void* name);
  // Null where the data are not known.
  vtkPVDataInformation* InputInformation();
  // The array that gives the colors, where its data are known.
  vtkPVArrayInformation* ColorArray();
  void AdaptMapScalars();

  bool IsFirstType = true;
};

#endif
