# Unity builds: neighbours are compiled together, so that headers and templates are read once for a dozen files. Which
# files, scripts/unity_groups says when configuring. Files with compile options of their own stay alone.
option(DRESSFORM_UNITY "Compile neighbouring files together: less than half the time from nothing, more after an edit" OFF)

function(dressform_unity target)
  if(NOT DRESSFORM_UNITY)
    return()
  endif()
  execute_process(COMMAND ${Python3_EXECUTABLE} ${CMAKE_SOURCE_DIR}/scripts/unity_groups
                          ${CMAKE_BINARY_DIR}/unity/${target}.txt ${ARGN}
                  OUTPUT_VARIABLE groups COMMAND_ERROR_IS_FATAL ANY OUTPUT_STRIP_TRAILING_WHITESPACE)
  string(REPLACE ";" "\\;" groups "${groups}")
  string(REPLACE "\n" ";" groups "${groups}")
  foreach(row IN LISTS groups)
    string(REGEX MATCH "^(.*);([0-9]+)$" found "${row}")
    set_source_files_properties(${CMAKE_MATCH_1} PROPERTIES UNITY_GROUP ${CMAKE_MATCH_2})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

# Other people's headers, read once for a target (scripts/cmake/*_headers.h).
function(dressform_precompiled target header)
  if(DRESSFORM_UNITY)
    target_precompile_headers(${target} PRIVATE ${CMAKE_SOURCE_DIR}/scripts/cmake/${header})
  endif()
endfunction()
