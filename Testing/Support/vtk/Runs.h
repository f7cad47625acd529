// An algorithm run under different circumstances: with errors, stopped, in pieces, in threads.
#pragma once

#include "Support/vtk/MessageLog.h"

#include "vtkAbstractArray.h"
#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace msi::testing
{

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

// Every name and every byte of the arrays, so that two strings are equal exactly where the data are.
inline std::string bytesOf(vtkFieldData* data)
{
  std::string bytes;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    auto* array = data->GetAbstractArray(i);
    bytes += std::string(array->GetName() ? array->GetName() : "") + ":" +
      std::to_string(array->GetNumberOfComponents()) + "x" +
      std::to_string(array->GetNumberOfTuples()) + "=";
    if (auto* numbers = vtkDataArray::SafeDownCast(array))
    {
      bytes.append(static_cast<const char*>(numbers->GetVoidPointer(0)),
        static_cast<std::size_t>(numbers->GetNumberOfValues() * numbers->GetDataTypeSize()));
    }
    else
    {
      for (vtkIdType value = 0; value < array->GetNumberOfValues(); ++value)
      {
        bytes += array->GetVariantValue(value).ToString() + "\n";
      }
    }
  }
  return bytes;
}

inline std::string bytesOf(vtkDataObject* data)
{
  std::string bytes = bytesOf(data->GetFieldData());
  for (const int kind : { vtkDataObject::POINT, vtkDataObject::ROW })
  {
    if (auto* attributes = data->GetAttributes(kind))
    {
      bytes += bytesOf(attributes);
    }
  }
  return bytes;
}

inline bool isEmpty(vtkDataObject* data)
{
  auto* table = vtkTable::SafeDownCast(data);
  auto* image = vtkImageData::SafeDownCast(data);
  return !data || (table && table->GetNumberOfColumns() == 0) ||
    (image && image->GetPointData()->GetNumberOfArrays() == 0);
}

// Runs the algorithm. Its first error text, empty where there was none; after an error every output has to
// be empty.
inline std::string errorOf(vtkAlgorithm* algorithm)
{
  MessageLog log(algorithm);
  algorithm->Update();
  if (!log.errors().empty())
  {
    for (int port = 0; port < algorithm->GetNumberOfOutputPorts(); ++port)
    {
      EXPECT_TRUE(isEmpty(algorithm->GetOutputDataObject(port)))
        << "output " << port << " is half made after: " << log.firstError();
    }
  }
  return log.firstError();
}

// Runs the algorithm and asks it to stop at its first sign of progress.
inline std::string errorWhenStopped(vtkAlgorithm* algorithm)
{
  struct Stopper
  {
    void stop(vtkObject* algorithm, unsigned long, void*)
    {
      static_cast<vtkAlgorithm*>(algorithm)->SetAbortExecute(1);
    }
  } stopper;
  const auto tag = algorithm->AddObserver(vtkCommand::ProgressEvent, &stopper, &Stopper::stop);
  const auto error = errorOf(algorithm);
  algorithm->RemoveObserver(tag);
  return error;
}

// The output of the algorithm under each SMP backend, in threads that outnumber the cores; all have to
// be the same bytes.
inline void expectSameBytesInThreads(vtkAlgorithm* algorithm)
{
  std::vector<std::string> results;
  const std::string before = vtkSMPTools::GetBackend();
  for (const char* backend : { "Sequential", "STDThread" })
  {
    ASSERT_TRUE(vtkSMPTools::SetBackend(backend)) << backend;
    vtkSMPTools::Initialize(4);
    algorithm->Modified();
    algorithm->Update();
    std::string bytes;
    for (int port = 0; port < algorithm->GetNumberOfOutputPorts(); ++port)
    {
      bytes += bytesOf(algorithm->GetOutputDataObject(port));
    }
    results.push_back(std::move(bytes));
  }
  vtkSMPTools::SetBackend(before.c_str());
  vtkSMPTools::Initialize();
  EXPECT_FALSE(results[0].empty());
  EXPECT_TRUE(results[0] == results[1]) << "Sequential and STDThread differ";
}

// The image of output 0, asked for in one piece and then in 'pieces'; every point has to have the same
// bytes in every array. (Neighbouring pieces share a layer of points.)
inline void expectSameBytesInPieces(vtkAlgorithm* algorithm, int pieces)
{
  ASSERT_TRUE(algorithm->UpdatePiece(0, 1, 0));
  vtkSmartPointer<vtkImageData> whole = vtkSmartPointer<vtkImageData>::New();
  whole->DeepCopy(algorithm->GetOutputDataObject(0));
  ASSERT_GT(whole->GetPointData()->GetNumberOfArrays(), 0);
  std::vector<bool> covered(static_cast<std::size_t>(whole->GetNumberOfPoints()), false);
  for (int piece = 0; piece < pieces; ++piece)
  {
    ASSERT_TRUE(algorithm->UpdatePiece(piece, pieces, 0));
    auto* part = vtkImageData::SafeDownCast(algorithm->GetOutputDataObject(0));
    ASSERT_LT(part->GetNumberOfPoints(), whole->GetNumberOfPoints()) << "the piece is the whole";
    for (vtkIdType point = 0; point < part->GetNumberOfPoints(); ++point)
    {
      double place[3];
      part->GetPoint(point, place);
      covered[static_cast<std::size_t>(whole->FindPoint(place))] = true;
    }
    vtkNew<vtkImageData> expected;
    expected->ShallowCopy(whole);
    expected->Crop(part->GetExtent());
    EXPECT_TRUE(bytesOf(expected->GetPointData()) == bytesOf(part->GetPointData()))
      << "piece " << piece << " of " << pieces << " differs";
  }
  EXPECT_EQ(std::count(covered.begin(), covered.end(), false), 0) << "points in no piece";
}

inline std::string printed(vtkObject* object)
{
  std::ostringstream text;
  object->Print(text);
  return text.str();
}

} // namespace msi::testing
