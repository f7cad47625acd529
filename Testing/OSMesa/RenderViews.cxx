// Draws one view of the demo scene with no display and compares it with a baseline.
//
//   RenderViews DATA rgb|error|spectra FACTOR BASELINE OUTPUT
//
// The comparison is the mean absolute difference of 8-bit values over all pixels and channels. Images are
// drawn without interpolation, so the same data give the same pixels; the bounds leave room for another font
// rasterizer in legend and axes. FACTOR multiplies the estimated reflectance: with 1 the view must keep within
// its bound, with any other factor (a deliberate error) it must leave it.

#include "vtkCIEDE2000Evaluator.h"
#include "vtkFlatFieldCorrection.h"
#include "vtkLabelImageReader.h"
#include "vtkPatchReferenceImage.h"
#include "vtkPatchSampler.h"
#include "vtkReflectanceCalibration.h"
#include "vtkReflectanceEstimation.h"
#include "vtkSampleTableReader.h"
#include "vtkSpectralImageReader.h"
#include "vtkSpectralToColor.h"

#include "vtkAxis.h"
#include "vtkCamera.h"
#include "vtkChartXY.h"
#include "vtkColorTransferFunction.h"
#include "vtkContextScene.h"
#include "vtkContextView.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkImageProperty.h"
#include "vtkImageSlice.h"
#include "vtkImageSliceMapper.h"
#include "vtkNew.h"
#include "vtkPNGReader.h"
#include "vtkPNGWriter.h"
#include "vtkPlot.h"
#include "vtkPointData.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkScalarBarActor.h"
#include "vtkSmartPointer.h"
#include "vtkTable.h"
#include "vtkTextProperty.h"
#include "vtkUnsignedCharArray.h"
#include "vtkWindowToImageFilter.h"

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <map>
#include <string>

namespace
{

const std::map<std::string, double> Bounds = { { "rgb", 0.05 }, { "error", 0.15 },
  { "spectra", 0.02 } };

constexpr int Enlarged = 2; // window pixels per image pixel

vtkSmartPointer<vtkSpectralImageReader> readStack(const std::string& folder)
{
  auto reader = vtkSmartPointer<vtkSpectralImageReader>::New();
  for (int nm = 400; nm <= 700; nm += 20)
  {
    reader->AddFileName((folder + "/channel_" + std::to_string(nm) + "nm.tif").c_str());
  }
  return reader;
}

// The demo's fabric with the chart's calibration, its reflectance multiplied by 'factor'.
struct Scene
{
  vtkNew<vtkLabelImageReader> labels;
  vtkNew<vtkSampleTableReader> patches;
  vtkNew<vtkImageData> reflectance;

  Scene(const std::string& data, float factor)
  {
    const std::string folder = data + "/Images/demo-fabric";
    labels->SetFileName((folder + "/labels.png").c_str());
    patches->SetFileName((folder + "/patches.csv").c_str());
    const auto raw = readStack(folder);
    const auto white = readStack(folder + "/white");
    const auto dark = readStack(folder + "/dark");
    vtkNew<vtkFlatFieldCorrection> flat;
    flat->SetInputConnection(0, raw->GetOutputPort());
    flat->SetInputConnection(1, white->GetOutputPort());
    flat->SetInputConnection(2, dark->GetOutputPort());
    vtkNew<vtkSampleTableReader> chart;
    chart->SetFileName((data + "/Samples/demo-chart.csv").c_str());
    vtkNew<vtkReflectanceCalibration> fit;
    fit->SetInputConnection(chart->GetOutputPort());
    vtkNew<vtkReflectanceEstimation> estimate;
    estimate->SetInputConnection(0, flat->GetOutputPort());
    estimate->SetInputConnection(1, fit->GetOutputPort());
    estimate->Update();
    reflectance->DeepCopy(estimate->GetOutputDataObject(0));
    auto* values = vtkFloatArray::SafeDownCast(reflectance->GetPointData()->GetScalars());
    for (vtkIdType i = 0; i < values->GetNumberOfValues(); ++i)
    {
      values->SetValue(i, factor * values->GetValue(i));
    }
  }
};

// An image that fills the window, pixel for pixel times two.
void showImage(
  vtkImageData* image, vtkImageProperty* property, vtkRenderWindow* window, vtkRenderer* renderer)
{
  vtkNew<vtkImageSliceMapper> mapper;
  mapper->SetInputData(image);
  vtkNew<vtkImageSlice> slice;
  slice->SetMapper(mapper);
  slice->SetProperty(property);
  renderer->AddViewProp(slice);
  renderer->SetBackground(1.0, 1.0, 1.0);
  window->AddRenderer(renderer);
  int size[3];
  image->GetDimensions(size);
  auto* camera = renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  const double x = 0.5 * (static_cast<double>(window->GetSize()[0]) / Enlarged - 1.0);
  const double y = 0.5 * (size[1] - 1);
  camera->SetFocalPoint(x, y, 0.0);
  camera->SetPosition(x, y, 100.0);
  camera->SetParallelScale(0.5 * size[1]);
}

void drawRgb(const Scene& scene, vtkRenderWindow* window)
{
  vtkNew<vtkSpectralToColor> color;
  color->SetInputData(scene.reflectance);
  color->Update();
  vtkNew<vtkImageData> image;
  image->ShallowCopy(color->GetOutputDataObject(0));
  vtkNew<vtkImageProperty> property;
  property->SetInterpolationTypeToNearest();
  property->SetColorWindow(255.0);
  property->SetColorLevel(127.5);
  vtkNew<vtkRenderer> renderer;
  window->SetSize(Enlarged * 256, Enlarged * 192);
  showImage(image, property, window, renderer);
  window->Render();
}

void drawErrorMap(const Scene& scene, vtkRenderWindow* window)
{
  constexpr double LargestError = 7.0;
  vtkNew<vtkPatchReferenceImage> reference;
  reference->SetInputConnection(0, scene.labels->GetOutputPort());
  reference->SetInputConnection(1, scene.patches->GetOutputPort());
  vtkNew<vtkCIEDE2000Evaluator> evaluator;
  evaluator->SetInputData(0, scene.reflectance);
  evaluator->SetInputConnection(1, reference->GetOutputPort());
  evaluator->Update();
  vtkNew<vtkImageData> image;
  image->ShallowCopy(evaluator->GetOutputDataObject(0));
  image->GetPointData()->SetActiveScalars("dE00 D65");
  // Viridis, by five of its colors.
  constexpr double Viridis[5][3] = { { 0.267, 0.005, 0.329 }, { 0.230, 0.322, 0.546 },
    { 0.128, 0.567, 0.551 }, { 0.369, 0.789, 0.383 }, { 0.993, 0.906, 0.144 } };
  vtkNew<vtkColorTransferFunction> colors;
  for (int i = 0; i < 5; ++i)
  {
    colors->AddRGBPoint(0.25 * i * LargestError, Viridis[i][0], Viridis[i][1], Viridis[i][2]);
  }
  colors->SetNanColor(0.82, 0.82, 0.82);
  vtkNew<vtkImageProperty> property;
  property->SetInterpolationTypeToNearest();
  property->SetLookupTable(colors);
  property->UseLookupTableScalarRangeOn();
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkScalarBarActor> legend;
  legend->SetLookupTable(colors);
  legend->SetTitle("dE00 D65");
  legend->SetPosition(0.85, 0.1);
  legend->SetWidth(0.12);
  legend->SetHeight(0.8);
  legend->UnconstrainedFontSizeOn();
  for (auto* text : { legend->GetTitleTextProperty(), legend->GetLabelTextProperty() })
  {
    text->SetColor(0.1, 0.1, 0.1);
    text->SetFontSize(13);
    text->ItalicOff();
    text->ShadowOff();
  }
  renderer->AddViewProp(legend);
  window->SetSize(Enlarged * 256 + 120, Enlarged * 192);
  showImage(image, property, window, renderer);
  window->Render();
}

// Measured (black) and estimated spectra of the first four swatches.
void drawSpectra(const Scene& scene, vtkContextView* view)
{
  constexpr int Swatches = 4;
  const unsigned char shades[Swatches][3] = { { 0, 114, 178 }, { 213, 94, 0 }, { 0, 158, 115 },
    { 204, 121, 167 } };
  vtkNew<vtkPatchSampler> sampler;
  sampler->SetInputData(0, scene.reflectance);
  sampler->SetInputConnection(1, scene.labels->GetOutputPort());
  sampler->SetInputConnection(2, scene.patches->GetOutputPort());
  sampler->Update();
  auto* samples = sampler->GetOutput();
  vtkNew<vtkTable> table;
  vtkNew<vtkDoubleArray> wavelengths;
  wavelengths->SetName("Wavelength (nm)");
  table->AddColumn(wavelengths);
  vtkNew<vtkDoubleArray> curves[2 * Swatches];
  for (int i = 0; i < 2 * Swatches; ++i)
  {
    curves[i]->SetName((std::string(i % 2 ? "E" : "R") + std::to_string(i / 2)).c_str());
    table->AddColumn(curves[i]);
  }
  for (int nm = 400; nm <= 700; nm += 10)
  {
    wavelengths->InsertNextValue(nm);
    for (int i = 0; i < 2 * Swatches; ++i)
    {
      const std::string column = (i % 2 ? "E" : "R") + std::to_string(nm);
      curves[i]->InsertNextValue(samples->GetValueByName(i / 2, column.c_str()).ToDouble());
    }
  }
  vtkNew<vtkChartXY> chart;
  chart->SetTitle("Measured and estimated reflectance");
  chart->GetAxis(vtkAxis::BOTTOM)->SetTitle("Wavelength (nm)");
  chart->GetAxis(vtkAxis::LEFT)->SetTitle("Reflectance factor");
  for (int i = 0; i < 2 * Swatches; ++i)
  {
    auto* plot = chart->AddPlot(vtkChart::LINE);
    plot->SetInputData(table, 0, i + 1);
    plot->SetWidth(2.0f);
    const auto* shade = shades[i / 2];
    if (i % 2)
    {
      plot->SetColor(shade[0], shade[1], shade[2], 255);
    }
    else
    {
      plot->SetColor(0, 0, 0, 255);
    }
  }
  view->GetScene()->AddItem(chart);
  view->GetRenderWindow()->SetMultiSamples(0);
  view->GetRenderWindow()->SetSize(640, 420);
  view->GetRenderWindow()->Render();
}

double meanDifference(vtkImageData* a, vtkImageData* b)
{
  auto* x = vtkUnsignedCharArray::SafeDownCast(a->GetPointData()->GetScalars());
  auto* y = vtkUnsignedCharArray::SafeDownCast(b->GetPointData()->GetScalars());
  if (!x || !y || x->GetNumberOfValues() != y->GetNumberOfValues())
  {
    return std::numeric_limits<double>::infinity();
  }
  double sum = 0.0;
  for (vtkIdType i = 0; i < x->GetNumberOfValues(); ++i)
  {
    sum += std::abs(static_cast<double>(x->GetValue(i)) - static_cast<double>(y->GetValue(i)));
  }
  return sum / static_cast<double>(x->GetNumberOfValues());
}

int compare(vtkRenderWindow* window, const std::string& view, double factor, const char* baseline,
  const char* output)
{
  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(window);
  grab->ReadFrontBufferOff();
  grab->Update();
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName(output);
  writer->SetInputConnection(grab->GetOutputPort());
  writer->Write();
  std::cout << "window: " << window->GetClassName() << ", drawn to " << output << "\n";
  vtkNew<vtkPNGReader> reader;
  if (!reader->CanReadFile(baseline))
  {
    std::cout << "there is no baseline " << baseline << "\n";
    return EXIT_FAILURE;
  }
  reader->SetFileName(baseline);
  reader->Update();
  const double mean = meanDifference(grab->GetOutput(), reader->GetOutput());
  const double bound = Bounds.at(view);
  const bool deliberate = factor != 1.0;
  std::cout << "mean difference " << mean << " of 255, bound " << bound
            << (deliberate ? ", a deliberate error that must exceed it\n" : "\n");
  return (mean > bound) == deliberate ? EXIT_SUCCESS : EXIT_FAILURE;
}

}

int main(int argc, char* argv[])
{
  if (argc != 6 || Bounds.count(argv[2]) == 0)
  {
    std::cerr << "usage: RenderViews DATA rgb|error|spectra FACTOR BASELINE OUTPUT\n";
    return 2;
  }
  const std::string view = argv[2];
  const double factor = std::atof(argv[3]);
  const Scene scene(argv[1], static_cast<float>(factor));
  if (view == "spectra")
  {
    vtkNew<vtkContextView> context;
    drawSpectra(scene, context);
    return compare(context->GetRenderWindow(), view, factor, argv[4], argv[5]);
  }
  vtkNew<vtkRenderWindow> window;
  window->SetMultiSamples(0);
  if (view == "rgb")
  {
    drawRgb(scene, window);
  }
  else
  {
    drawErrorMap(scene, window);
  }
  return compare(window, view, factor, argv[4], argv[5]);
}
