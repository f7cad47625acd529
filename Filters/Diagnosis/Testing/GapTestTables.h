// A small capture in tables: a camera of four channels and smooth reflectances, answers with a known gain.
#ifndef GapTestTables_h
#define GapTestTables_h

#include "CameraTable.h"

#include "Support/vtk/Tables.h"

#include "Kernels/Camera/CameraDesign.h"
#include "Kernels/Camera/CameraModel.h"
#include "Kernels/Numerics/CounterRandom.h"

#include <cmath>

namespace msi::testing
{

struct GapTestTables
{
  static constexpr double ReadNoise = 0.001;
  static constexpr int Samples = 40;

  vtkSmartPointer<vtkTable> camera = vtkSmartPointer<vtkTable>::New();
  vtkSmartPointer<vtkTable> samples = vtkSmartPointer<vtkTable>::New();
  vtkSmartPointer<vtkTable> responses = vtkSmartPointer<vtkTable>::New();

  // The answers are gain x the simulated ones, with noise; samples a .. in two media on a field of 8 x 5.
  explicit GapTestTables(double gain)
  {
    const auto grid = WavelengthGrid::uniform(400.0, 700.0, 10.0);
    CameraParts parts;
    parts.light = Eigen::VectorXd::Ones(grid.size());
    parts.detector = Eigen::VectorXd::Ones(grid.size());
    for (const double center : { 440.0, 510.0, 580.0, 650.0 })
    {
      parts.filters.push_back({ center, 50.0, 2.0, 1.0, 0.0 });
    }
    const CameraModel designed = designCamera(grid, parts);
    const CameraModel model(
      grid, designed.responsivity(), Eigen::VectorXd::Zero(4), { "C1", "C2", "C3", "C4" });
    CameraTable table{ model };
    table.noise = CameraNoise{};
    table.noise->read = ReadNoise;
    write(table, camera);

    const CounterRandom random(7);
    Eigen::MatrixXd reflectance(grid.size(), Samples);
    std::vector<std::string> names;
    std::vector<std::string> media;
    std::vector<double> x;
    std::vector<double> y;
    std::vector<double> order;
    for (int i = 0; i < Samples; ++i)
    {
      const auto index = static_cast<std::uint64_t>(i);
      const double height = 0.1 + 0.7 * random.uniform(index, 0);
      const double center = 400.0 + 300.0 * random.uniform(index, 1);
      const double width = 40.0 + 80.0 * random.uniform(index, 2);
      reflectance.col(i) =
        0.05 + height * (-((grid.vector().array() - center) / width).square()).exp();
      names.push_back("s" + std::to_string(i));
      media.emplace_back(i % 2 == 0 ? "paper" : "fabric");
      x.push_back(i % 8);
      y.push_back(std::floor(i / 8.0));
      order.push_back(Samples - i);
    }
    addTextColumn(samples, "sample", names);
    addTextColumn(samples, "medium", media);
    addColumn(samples, "x", x);
    addColumn(samples, "y", y);
    addColumn(samples, "order", order);
    addSpectra(samples, 'R', grid, reflectance);

    Eigen::MatrixXd answered = gain * cameraResponse(model)(reflectance);
    addTextColumn(responses, "sample", names);
    for (int k = 0; k < 4; ++k)
    {
      std::vector<double> column;
      for (int i = 0; i < Samples; ++i)
      {
        const auto index = static_cast<std::uint64_t>(1000 + 4 * i + k);
        column.push_back(answered(k, i) + ReadNoise * random.normal(index));
      }
      addColumn(responses, "C" + std::to_string(k + 1), column);
    }
  }
};

} // namespace msi::testing

#endif
