// Images that an algorithm takes in blocks of rows, one after another, so that they never stand in memory whole.
#ifndef ImageBlocks_h
#define ImageBlocks_h

#include "ImagePieces.h"

#include "vtkSmartPointer.h"

#include <initializer_list>

class vtkImageData;
class vtkInformation;
class vtkInformationVector;

namespace msi
{

// The way of an algorithm through its images, in one or several passes. Every rank takes its own share of
// the rows, no pixel twice.
//
// RequestUpdateExtent calls request(), RequestData takes block() and calls next(); while that is true, the
// pipeline comes again with the next block.
class ImageBlocks
{
public:
  // Asks the image inputs on 'ports' for the current block; the first of them says how large blocks are. Starts
  // from the beginning, and returns true, unless the last run said that it goes on.
  bool request(vtkInformationVector** inputs, std::initializer_list<int> ports);

  // The rows to work on; none (last before first) on a rank beyond the last row.
  const Extent& block() const noexcept { return Block; }
  bool isEmpty() const noexcept { return Block[3] < Block[2]; }
  // Counted from 0.
  int pass() const noexcept { return Pass; }
  // The share of this pass that is done once the current block is.
  double progress() const noexcept;

  // Goes on to the next block, and after the last of 'passes' passes back to the first one. Says in 'request'
  // whether the pipeline has to come again, and returns it.
  bool next(vtkInformation* request, int passes = 1);
  // Ends the passes before their time.
  void stop(vtkInformation* request);

  // Takes only these rows of the image, from the next start on; clipped to the image. Last before first: all.
  void setRows(int first, int last) noexcept
  {
    FirstWanted = first;
    LastWanted = last;
  }

  // Memory in bytes that one block of floats may take; at least one row is taken.
  void setBlockBytes(long long bytes) noexcept { BlockBytes = bytes; }

private:
  void start(vtkInformation* input);
  void startPass();

  Extent Whole{};
  Extent Block{};
  int First = 0; // of this rank's rows
  int Last = -1;
  int Rows = 1; // of a block
  int Pass = 0;
  int FirstWanted = 0;
  int LastWanted = -1;
  bool GoesOn = false;
  long long BlockBytes = 64LL << 20;
};

// The image itself where it shows exactly the block, else a copy of the part. Null for null.
vtkSmartPointer<vtkImageData> partOf(vtkImageData* image, const Extent& block);

// What all of the images show, null ones aside: an input that was not computed anew may hold more than was asked for.
Extent commonExtent(std::initializer_list<vtkImageData*> images);

} // namespace msi

#endif
