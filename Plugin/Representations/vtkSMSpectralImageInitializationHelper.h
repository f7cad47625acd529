/**
 * @class   vtkSMSpectralImageInitializationHelper
 * @brief   Shows the colors of a spectral image as they are
 *
 * ParaView maps every array to colors by a color map, an array of colors too. This switches Map Scalars off
 * for the representations that name it in their hints.
 */
#ifndef vtkSMSpectralImageInitializationHelper_h
#define vtkSMSpectralImageInitializationHelper_h

#include "MultispectralRepresentationsModule.h"
#include "vtkSMProxyInitializationHelper.h"

class MULTISPECTRALREPRESENTATIONS_EXPORT vtkSMSpectralImageInitializationHelper
  : public vtkSMProxyInitializationHelper
{
public:
  static vtkSMSpectralImageInitializationHelper* New();
  vtkTypeMacro(vtkSMSpectralImageInitializationHelper, vtkSMProxyInitializationHelper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  void PostInitializeProxy(
    vtkSMProxy* proxy, vtkPVXMLElement* xml, vtkMTimeType initializationTimeStamp) override;

protected:
  vtkSMSpectralImageInitializationHelper() = default;
  ~vtkSMSpectralImageInitializationHelper() override = default;

private:
  vtkSMSpectralImageInitializationHelper(const vtkSMSpectralImageInitializationHelper&) = delete;
  void operator=(const vtkSMSpectralImageInitializationHelper&) = delete;
};

#endif
