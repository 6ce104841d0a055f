# The 3D view of reports, from npm when configuring; a build without it is whole but for that view.
option(DRESSFORM_VIEWER "Take @google/model-viewer from npm for the 3D view of reports" ON)
set(viewer ${CMAKE_BINARY_DIR}/generated/model_viewer.inc)
if(DRESSFORM_VIEWER)
  execute_process(COMMAND ${Python3_EXECUTABLE} ${CMAKE_SOURCE_DIR}/scripts/fetch_viewer ${viewer}
                  OUTPUT_VARIABLE said ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(said)
    message(STATUS "${said}")
  endif()
elseif(EXISTS ${viewer})
  file(REMOVE ${viewer})
endif()
