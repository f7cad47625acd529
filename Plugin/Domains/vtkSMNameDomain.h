/**
 * @class   vtkSMNameDomain
 * @brief   Names of one kind to choose one of
 *
 * The attribute "of" says which (OfferedNames.h), "with" one more. The required property "Input", which may be left out, takes a table whose
 * curves are offered too. Of "arrays": nothing, for the active scalars, and the point arrays of the input. What the property holds is
 * offered always: ParaView's lists would change it silently. Of "listed": nothing, and the names in the required property "Names",
 * one a line.
 */
#ifndef vtkSMNameDomain_h
#define vtkSMNameDomain_h

#include "MultispectralDomainsModule.h"
#include "vtkSMStringListDomain.h"

#include <string>
#include <vector>

class MULTISPECTRALDOMAINS_EXPORT vtkSMNameDomain : public vtkSMStringListDomain
{
public:
  static vtkSMNameDomain* New();
  vtkTypeMacro(vtkSMNameDomain, vtkSMStringListDomain);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  void Update(vtkSMProperty* property) override;

protected:
  vtkSMNameDomain() = default;
  ~vtkSMNameDomain() override = default;

  int ReadXMLAttributes(vtkSMProperty* property, vtkPVXMLElement* element) override;

private:
  vtkSMNameDomain(const vtkSMNameDomain&) = delete;
  void operator=(const vtkSMNameDomain&) = delete;

  void OnPropertyModified() { this->Update(nullptr); }

  std::vector<std::string> Names;
  bool IsOfArrays = false;
};

#endif
