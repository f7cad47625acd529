/**
 * @class   vtkSMIlluminantDomain
 * @brief   Names of illuminants: those that the plugin knows, and the columns of a table of the user's own
 *
 * The required property "Input" is the one that takes the table; it may be left out. The domain is an offer: a property
 * takes other names, too (D5500K, BB3200K).
 */
#ifndef vtkSMIlluminantDomain_h
#define vtkSMIlluminantDomain_h

#include "MultispectralDomainsModule.h"
#include "vtkSMStringListDomain.h"

class MULTISPECTRALDOMAINS_EXPORT vtkSMIlluminantDomain : public vtkSMStringListDomain
{
public:
  static vtkSMIlluminantDomain* New();
  vtkTypeMacro(vtkSMIlluminantDomain, vtkSMStringListDomain);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  void Update(vtkSMProperty* property) override;

protected:
  vtkSMIlluminantDomain() = default;
  ~vtkSMIlluminantDomain() override = default;

  int ReadXMLAttributes(vtkSMProperty* property, vtkPVXMLElement* element) override;

private:
  vtkSMIlluminantDomain(const vtkSMIlluminantDomain&) = delete;
  void operator=(const vtkSMIlluminantDomain&) = delete;
};

#endif
