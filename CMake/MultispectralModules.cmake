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

# The generated wrappers of a module's classes for the server manager belong together too.
function(multispectral_unity_modules)
  foreach(module IN LISTS MULTISPECTRAL_MODULES)
    string(REPLACE "::" "" library "${module}")
    string(REPLACE "Multispectral::" "" target "${module}")
    multispectral_unity(${target})
    if(MULTISPECTRAL_UNITY AND TARGET ${library}CS)
      set_target_properties(${library}CS PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 12)
    endif()
  endforeach()
endfunction()
