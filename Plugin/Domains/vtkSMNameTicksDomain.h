/**
 * @class   vtkSMNameTicksDomain
 * @brief   Names of one kind to tick
 *
 * ParaView's panel gives ticks to lists of arrays alone; these are no arrays.
 *
 * The attribute "of" says which (OfferedNames.h). The required property "Input", which may be left out, takes a table whose
 * curves are offered too; What the property holds is offered
 * always: ParaView's lists would change it silently.
 */
#ifndef vtkSMNameTicksDomain_h
#define vtkSMNameTicksDomain_h

#include "MultispectralDomainsModule.h"
#include "vtkSMArrayListDomain.h"

#include <string>
#include <vector>

class MULTISPECTRALDOMAINS_EXPORT vtkSMNameTicksDomain : public vtkSMArrayListDomain
{
public:
  static vtkSMNameTicksDomain* New();
  vtkTypeMacro(vtkSMNameTicksDomain, vtkSMArrayListDomain);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  void Update(vtkSMProperty* property) override;
  int SetDefaultValues(vtkSMProperty* property, bool use_unchecked_values) override;

protected:
  vtkSMNameTicksDomain() = default;
  ~vtkSMNameTicksDomain() override = default;

  int ReadXMLAttributes(vtkSMProperty* property, vtkPVXMLElement* element) override;

  std::vector<std::string> Names;

private:
  vtkSMNameTicksDomain(const vtkSMNameTicksDomain&) = delete;
  void operator=(const vtkSMNameTicksDomain&) = delete;

  void OnPropertyModified() { this->Update(nullptr); }
};

#endif
