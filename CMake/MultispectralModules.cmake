# The vtk modules, in one list for both faces (plain VTK and ParaView).
set(MULTISPECTRAL_MODULES
  Multispectral::DataModel
  Multispectral::FiltersSampling
  Multispectral::FiltersCalibration
  Multispectral::FiltersColorimetry
  Multispectral::FiltersSimulation
  Multispectral::FiltersDiagnosis
  Multispectral::Readers)
set(MULTISPECTRAL_MODULE_FILES
  "${PROJECT_SOURCE_DIR}/Filters/DataModel/vtk.module"
  "${PROJECT_SOURCE_DIR}/Filters/Sampling/vtk.module"
  "${PROJECT_SOURCE_DIR}/Filters/Calibration/vtk.module"
  "${PROJECT_SOURCE_DIR}/Filters/Colorimetry/vtk.module"
  "${PROJECT_SOURCE_DIR}/Filters/Simulation/vtk.module"
  "${PROJECT_SOURCE_DIR}/Filters/Diagnosis/vtk.module"
  "${PROJECT_SOURCE_DIR}/Readers/vtk.module")
