/**
 * @class   vtkSMSpectralImageInitializationHelper
 * @brief   Chooses what a view shows of a spectral image at first
 *
 * The picture ("sRGB" or another one) where there is one, else a map of color differences ("dE00 D65", else the first
 * one) or of a gap ("Gap"), else the active scalars.
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
