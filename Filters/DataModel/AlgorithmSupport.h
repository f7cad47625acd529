// What every algorithm of ours does around its kernel.
#ifndef AlgorithmSupport_h
#define AlgorithmSupport_h

#include "ThreadedParts.h"

#include "vtkAlgorithm.h"
#include "vtkCommunicator.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkObject.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>

namespace msi
{

// Runs the work of a RequestData: an exception becomes the algorithm's error, and every output is
// left empty rather than half made. Returns what RequestData returns.
template <typename Work>
int runAlgorithm(vtkAlgorithm* algorithm, vtkInformationVector* outputs, Work&& work)
{
  const auto fail = [&](const char* what)
  {
    for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
    {
      if (auto* output = vtkDataObject::GetData(outputs, port))
      {
        output->Initialize();
      }
    }
    vtkErrorWithObjectMacro(algorithm, << what);
    return 0;
  };
  try
  {
    work();
    return 1;
  }
  catch (const std::bad_alloc&)
  {
    return fail("there is not enough memory; give it less: set Region, Stride or Bands of the "
                "image's reader");
  }
  catch (const std::exception& error)
  {
    return fail(error.what());
  }
}

// Small tables (samples, transforms) are needed whole by every piece and rank.
inline void requestWhole(vtkInformationVector** inputs, int port)
{
  for (int i = 0; i < inputs[port]->GetNumberOfInformationObjects(); ++i)
  {
    auto* information = inputs[port]->GetInformationObject(i);
    information->Set(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER(), 0);
    information->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES(), 1);
    information->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  }
}

// The controller over which an input's pieces are spread, or null where this process holds it whole.
// A reduction is due exactly where the executive split the input over as many ranks as there are.
inline vtkMultiProcessController* controllerOfPieces(vtkInformationVector* input)
{
  auto* controller = vtkMultiProcessController::GetGlobalController();
  if (!controller || controller->GetNumberOfProcesses() == 1)
  {
    return nullptr;
  }
  const int pieces = input->GetInformationObject(0)->Get(
    vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES());
  return pieces == controller->GetNumberOfProcesses() ? controller : nullptr;
}

// The controller over which an algorithm on whole tables may share its work, or null for one process.
inline vtkMultiProcessController* controllerOfTables()
{
  auto* controller = vtkMultiProcessController::GetGlobalController();
  return controller && controller->GetNumberOfProcesses() > 1 ? controller : nullptr;
}

// An algorithm whose ranks work together must run on every rank, whatever piece is asked of it.
inline void declareCollective(vtkInformationVector* outputs)
{
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    outputs->GetInformationObject(port)->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
  }
}

// Of a table in pieces the first piece has all rows, the others none.
inline bool isEmptyPiece(vtkInformationVector* outputs)
{
  return outputs->GetInformationObject(0)->Get(
           vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER()) > 0;
}

// Throws std::runtime_error on every rank where 'failure' is not empty on any, so that none waits for
// another. Collective.
inline void throwOnAnyRank(const std::string& failure, vtkMultiProcessController* controller)
{
  int mine = failure.empty() ? 0 : 1;
  int any = mine;
  if (controller)
  {
    controller->AllReduce(&mine, &any, 1, vtkCommunicator::MAX_OP);
  }
  if (any != 0)
  {
    throw std::runtime_error(failure.empty() ? "another rank failed" : failure);
  }
}

// Runs the part of a rank's work that comes before the ranks meet. Collective; throws on every rank where
// the work failed on any.
template <typename Work>
void beforeRanksMeet(vtkMultiProcessController* controller, Work&& work)
{
  std::string failure;
  try
  {
    work();
  }
  catch (const std::exception& error)
  {
    failure = error.what();
  }
  throwOnAnyRank(failure, controller);
}

// Calls work(begin, end) for blocks that cover [0, count), as forParts() does.
template <typename Work>
void forBlocks(vtkAlgorithm* algorithm, vtkIdType count, const Work& work)
{
  constexpr vtkIdType Block = 1024;
  forParts(algorithm, (count + Block - 1) / Block,
    [&](vtkIdType block) { work(block * Block, std::min(count, (block + 1) * Block)); });
}

} // namespace msi

#endif
