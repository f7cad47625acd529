// Small MAT files of level 4, 5 and 7.3 (HDF5) for the tests, written by MatIO.
#pragma once

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <matio.h>

namespace msi::testing
{

class MatWriter
{
public:
  MatWriter(
    const std::string& path, mat_ft version, matio_compression compression = MAT_COMPRESSION_ZLIB)
    : File(Mat_CreateVer(path.c_str(), nullptr, version), Mat_Close)
    , Compression(compression)
  {
    if (!File)
    {
      throw std::runtime_error("cannot write " + path);
    }
  }

  // Values column by column, as MATLAB has them.
  MatWriter& add(
    const std::string& name, std::vector<std::size_t> shape, std::vector<double> values)
  {
    write(name, shape, values.data(), MAT_C_DOUBLE, MAT_T_DOUBLE);
    return *this;
  }
  MatWriter& add(
    const std::string& name, std::vector<std::size_t> shape, std::vector<unsigned short> values)
  {
    write(name, shape, values.data(), MAT_C_UINT16, MAT_T_UINT16);
    return *this;
  }
  // Rows of equal length.
  MatWriter& add(const std::string& name, const std::vector<std::string>& rows)
  {
    std::string characters;
    for (std::size_t column = 0; column < rows[0].size(); ++column)
    {
      for (const std::string& row : rows)
      {
        characters += row[column];
      }
    }
    std::vector<std::size_t> shape{ rows.size(), rows[0].size() };
    write(name, shape, characters.data(), MAT_C_CHAR, MAT_T_UINT8);
    return *this;
  }
  MatWriter& addComplex(const std::string& name)
  {
    double re[4] = { 1, 2, 3, 4 };
    double im[4] = { 0, 0, 0, 1 };
    mat_complex_split_t both{ re, im };
    std::vector<std::size_t> shape{ 2, 2 };
    write(name, shape, &both, MAT_C_DOUBLE, MAT_T_DOUBLE, MAT_F_COMPLEX);
    return *this;
  }
  // A structure with a cube of these columns and a vector of numbers.
  MatWriter& addStructure(const std::string& name, const std::string& cubeName,
    std::vector<std::size_t> shape, std::vector<unsigned short> cube, const std::string& vectorName,
    std::vector<double> vector)
  {
    const char* fields[] = { cubeName.c_str(), vectorName.c_str() };
    std::vector<std::size_t> one{ 1, 1 };
    std::vector<std::size_t> row{ 1, vector.size() };
    const std::unique_ptr<matvar_t, void (*)(matvar_t*)> structure(
      Mat_VarCreateStruct(name.c_str(), 2, one.data(), fields, 2), Mat_VarFree);
    Mat_VarSetStructFieldByName(structure.get(), fields[0], 0,
      Mat_VarCreate(nullptr, MAT_C_UINT16, MAT_T_UINT16, static_cast<int>(shape.size()),
        shape.data(), cube.data(), 0));
    Mat_VarSetStructFieldByName(structure.get(), fields[1], 0,
      Mat_VarCreate(nullptr, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, row.data(), vector.data(), 0));
    if (Mat_VarWrite(File.get(), structure.get(), Compression) != 0)
    {
      throw std::runtime_error("cannot write structure " + name);
    }
    return *this;
  }

private:
  void write(const std::string& name, std::vector<std::size_t>& shape, void* data,
    matio_classes kind, matio_types type, int flags = 0)
  {
    const std::unique_ptr<matvar_t, void (*)(matvar_t*)> variable(
      Mat_VarCreate(
        name.c_str(), kind, type, static_cast<int>(shape.size()), shape.data(), data, flags),
      Mat_VarFree);
    if (!variable || Mat_VarWrite(File.get(), variable.get(), Compression) != 0)
    {
      throw std::runtime_error("cannot write variable " + name);
    }
  }

  std::unique_ptr<mat_t, int (*)(mat_t*)> File;
  matio_compression Compression;
};

} // namespace msi::testing
