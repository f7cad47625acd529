/**
 * @class   vtkSampleSplit
 * @brief   Splits a sample table in two: samples to calibrate or tune with, and samples held out
 *
 * Output 0 has the chosen rows, output 1 the others, each in the order of the input. The same seed and
 * draw choose the same rows on every machine (Kernels/Estimation/SampleDraw.h).
 */
#ifndef vtkSampleSplit_h
#define vtkSampleSplit_h

#include "MultispectralFiltersSamplingModule.h"
#include "vtkTableAlgorithm.h"

class MULTISPECTRALFILTERSSAMPLING_EXPORT vtkSampleSplit : public vtkTableAlgorithm
{
public:
  static vtkSampleSplit* New();
  vtkTypeMacro(vtkSampleSplit, vtkTableAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum ModeType
  {
    EVERY_OTHER = 0,
    RANDOM = 1
  };
  ///@{
  /**
   * EVERY_OTHER (default): rows 1, 3, 5, ..; RANDOM: Count rows drawn at random.
   */
  vtkSetClampMacro(Mode, int, EVERY_OTHER, RANDOM);
  vtkGetMacro(Mode, int);
  ///@}

  ///@{
  /**
   * How many rows RANDOM chooses. At least 1 and fewer than the table has; default 16.
   */
  vtkSetClampMacro(Count, int, 1, VTK_INT_MAX);
  vtkGetMacro(Count, int);
  ///@}

  ///@{
  /**
   * Seed of the random choice, and which draw of that seed. Defaults 1 and 0.
   */
  vtkSetClampMacro(Seed, int, 0, VTK_INT_MAX);
  vtkGetMacro(Seed, int);
  vtkSetClampMacro(Draw, int, 0, VTK_INT_MAX);
  vtkGetMacro(Draw, int);
  ///@}

protected:
  vtkSampleSplit();
  ~vtkSampleSplit() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkSampleSplit(const vtkSampleSplit&) = delete;
  void operator=(const vtkSampleSplit&) = delete;

  int Mode = EVERY_OTHER;
  int Count = 16;
  int Seed = 1;
  int Draw = 0;
};

#endif
