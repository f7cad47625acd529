#include "vtkCurveReader.h"

#include "AlgorithmSupport.h"
#include "SampleColumns.h"

#include "vtkObjectFactory.h"
#include "vtkTable.h"

#include "Formats/Curves.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

vtkStandardNewMacro(vtkCurveReader);

namespace
{
std::string nameWithoutSeparators(std::string name)
{
  std::replace_if(
    name.begin(), name.end(), [](char c) { return c == ' ' || c == ',' || c == '\t'; }, '-');
  return name;
}
}

vtkCurveReader::vtkCurveReader()
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(1);
}

void vtkCurveReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileNames:";
  for (const auto& name : this->FileNames)
  {
    os << ' ' << name;
  }
  os << "\n" << indent << "Notes: " << this->Notes << "\n";
}

void vtkCurveReader::AddFileName(const char* name)
{
  if (name && *name)
  {
    this->FileNames.emplace_back(name);
    this->Modified();
  }
}

void vtkCurveReader::ClearFileNames()
{
  this->FileNames.clear();
  this->Modified();
}

int vtkCurveReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  this->Notes.clear();
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      if (this->FileNames.empty())
      {
        throw std::invalid_argument("no file is given; set FileNames to tables of curves");
      }
      std::vector<msi::Curves> all;
      std::map<double, Eigen::Index> rows;
      for (const auto& file : this->FileNames)
      {
        auto curves = msi::readCurves(file);
        if (curves.names.size() == 1)
        {
          curves.names[0] = std::filesystem::path(file).stem().string();
        }
        for (const double nm : curves.wavelengths.values())
        {
          rows[nm] = 0;
        }
        for (const auto& note : curves.notes)
        {
          this->Notes += (this->Notes.empty() ? "" : "\n") + note;
        }
        all.push_back(std::move(curves));
      }
      Eigen::VectorXd wavelengths(static_cast<Eigen::Index>(rows.size()));
      Eigen::Index next = 0;
      for (auto& [nm, row] : rows)
      {
        row = next;
        wavelengths(next++) = nm;
      }
      auto* table = vtkTable::GetData(outputs, 0);
      msi::setNumbers(table, msi::WavelengthColumn, wavelengths);
      std::set<std::string> known{ msi::WavelengthColumn };
      for (std::size_t i = 0; i < all.size(); ++i)
      {
        for (Eigen::Index column = 0; column < all[i].values.cols(); ++column)
        {
          const std::string name =
            nameWithoutSeparators(all[i].names[static_cast<std::size_t>(column)]);
          if (!known.insert(name).second)
          {
            throw std::invalid_argument(this->FileNames[i] + ": a curve is named '" + name +
              "' as another one is; expected different names; rename the file or the column");
          }
          Eigen::VectorXd values =
            Eigen::VectorXd::Constant(next, std::numeric_limits<double>::quiet_NaN());
          for (Eigen::Index row = 0; row < all[i].values.rows(); ++row)
          {
            values(rows.at(all[i].wavelengths[row])) = all[i].values(row, column);
          }
          msi::setNumbers(table, name, values);
        }
      }
    });
}
