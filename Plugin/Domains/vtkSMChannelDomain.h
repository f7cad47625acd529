/**
 * @class   vtkSMChannelDomain
 * @brief   The channels of a spectral image or of a sample table to tick, named as the data name them
 *
 * The required property "Input" is the one that takes the data. A property that was not set yet starts with all channels.
 */
#ifndef vtkSMChannelDomain_h
#define vtkSMChannelDomain_h

#include "MultispectralDomainsModule.h"
#include "vtkSMNameTicksDomain.h"

class MULTISPECTRALDOMAINS_EXPORT vtkSMChannelDomain : public vtkSMNameTicksDomain
{
public:
  static vtkSMChannelDomain* New();
  vtkTypeMacro(vtkSMChannelDomain, vtkSMNameTicksDomain);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  void Update(vtkSMProperty* property) override;
  int SetDefaultValues(vtkSMProperty* property, bool use_unchecked_values) override;

protected:
  vtkSMChannelDomain() = default;
  ~vtkSMChannelDomain() override = default;

private:
  vtkSMChannelDomain(const vtkSMChannelDomain&) = delete;
  void operator=(const vtkSMChannelDomain&) = delete;
};

#endif
